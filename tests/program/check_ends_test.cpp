// Faults that wait at an end: of the tick, of a tweak's range, of the picture under the mouse.
#include "report.h"

namespace glint::cli::check_ends_test {
namespace {

using Json = nlohmann::json;

class CheckEnds : public InAFolder {
protected:
    // The verdict of a case on this scene, which fails or not.
    std::string note_of(const std::string& scene, const std::string& name, int code) {
        write("s.frag", scene);
        const Json report =
            report_of(glint({"check", "s.frag", "--size", "16x9", "--json", "--case", name}), code);
        for (const Json& one : report["cases"])
            if (one["case"] == name) return one["note"];
        return "none";
    }
};

TEST_F(CheckEnds, ATickThatIsUsedSoThatItJumpsWhereItWraps) {
    const auto scene = [](const std::string& phase) {
        return "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(vec3(0.5 + 0.4 * "
               "sin(6.2831853 "
               "* fract(" +
               phase + "))), 1);\n}\n";
    };
    EXPECT_EQ(note_of(scene("float(iTick & 0xFFFFFu) / 1048576.0"), "tick wraps", 0), "");
    EXPECT_NE(note_of(scene("float(iTick % 218453u) / 218453.0"), "tick wraps", 6).find("65536 s"),
              std::string::npos);
    EXPECT_NE(note_of(scene("float(int(iTick) / 66) / 50000.0"), "tick wraps", 6).find("32768 s"),
              std::string::npos);
}

// What jumps at the end of each of its periods, as slides do, jumps at those of the tick as well.
TEST_F(CheckEnds, ATickWhoseOwnPeriodEndsWithACutIsUsedWell) {
    const char* slides =
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    uint slide = (iTick >> 19) & 3u;\n"
        "    c = vec4(vec3(slide == 0u ? 0.9 : 0.2 * float(slide)), 1);\n}\n";
    EXPECT_EQ(note_of(slides, "tick wraps", 0), "");
}

TEST_F(CheckEnds, WhatIsAssertedDoesNotHoldWithAnotherValue) {
    const std::string scene =
        "uniform float r; //@ 1 [0, 2]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    //@ assert r > 0.0 \"a radius\"\n"
        "    c = vec4(vec3(r * 0.3), 1);\n}\n";
    EXPECT_EQ(note_of(scene, "asserted values", 0), "");
    const std::string found = note_of(scene, "asserted at the ranges' ends", 6);
    EXPECT_NE(found.find("s.frag:3:5: assert r > 0.0"), std::string::npos) << found;
    EXPECT_TRUE(found.ends_with("; at r=0")) << found;
}

TEST_F(CheckEnds, AnEdgeThatTheMouseIsDraggedTo) {
    const std::string found = note_of(
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(vec3(iMouse.z > 0.0 && iMouse.z != iMouse.x ? 1.0 / iMouse.x : 0.5), 1);\n"
        "}\n",
        "mouse bottom left", 6);
    EXPECT_NE(found.find("Inf"), std::string::npos) << found;
}

}  // namespace
}  // namespace glint::cli::check_ends_test
