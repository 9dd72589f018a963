// `glint check` says which value a scene counts on that nothing has set.
#include "command.h"

#include <nlohmann/json.hpp>

namespace glint::cli::check_unset_test {
namespace {

using Json = nlohmann::json;

class CheckUnset : public InAFolder {
protected:
    // The cases for what is unset; none where there is nothing.
    Json cases(const std::string& file, int expected_code) const {
        const Outcome outcome = glint({"check", file, "--json", "--size", "32x18", "--random", "0",
                                       "--case", "uninitialised"});
        EXPECT_EQ(outcome.code, expected_code) << outcome.out << outcome.err;
        const Json json = Json::parse(outcome.out, nullptr, false);
        return json.is_object() ? json["cases"] : Json::array();
    }
    static std::string planted(const std::string& name) {
        return (fs::path(GLINT_REPOSITORY) / "tests/scenes" / (name + ".frag")).string();
    }
};

TEST_F(CheckUnset, ThePlantedValueIsNamedAndItsSoundTwinPasses) {
    const Json found = cases(planted("planted_unset"), 6);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]["note"], "counts on uninitialised values: " + planted("planted_unset") +
                                    ":17:10: `light` is read where nothing has set it; give it a "
                                    "first value");
    const Json twin = cases(planted("sound_unset"), 0);
    ASSERT_EQ(twin.size(), 1u);
    EXPECT_EQ(twin[0]["verdict"], "pass");
    EXPECT_EQ(twin[0]["note"], "3 values, none shows");
}

TEST_F(CheckUnset, EveryKindOfValueIsFound) {
    const std::pair<const char*, const char*> kinds[] = {
        {"float i; for (; i++ < 3.;) c += 0.1;", "scene.frag:2:59: `i`"},
        {"int n; c = vec4(n == 0);", "scene.frag:2:57: `n`"},
        {"bool b; c = vec4(b);", "scene.frag:2:58: `b`"},
        {"vec2 used; used.x = 0.5; float a[3]; c = vec4(used.x + a[1]);", "scene.frag:2:84: `a`"},
        // A NaN does not show in these.
        {"float most; most = max(most, 0.01 * p.x); c = vec4(most);", "scene.frag:2:59: `most`"},
        {"float least; least = min(p.x, least); c = vec4(least);", "scene.frag:2:59: `least`"},
        {"c = vec4(half_(p.x));", "scene.frag:1:7: the function `half_` may end without a return"},
    };
    for (const auto& [body, words] : kinds) {
        SCOPED_TRACE(body);
        write("scene.frag", std::string("float half_(float x) { if (x < 9.0) return 0.5; }\n"
                                        "void mainImage(out vec4 c, in vec2 p) { c = p.xyxy; ") +
                                body + " }\n");
        const Json found = cases("scene.frag", 6);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_NE(found[0]["note"].get<std::string>().find(words), std::string::npos) << found;
    }
}

TEST_F(CheckUnset, AValueOfABufferIsFoundWhereThePictureHidesIt) {
    write("scene.frag",
          "uniform sampler2D sums; //@ pass mainSums size=8x8\n"
          "void mainSums(out vec4 c, in vec2 p) { vec4 s; if (p.x > 1.0) s = vec4(1); c = s; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(sums, ivec2(5), 0); }\n");
    const Json found = cases("scene.frag", 6);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0]["note"].get<std::string>().find("scene.frag:2:45: `s`"), std::string::npos)
        << found;
}

TEST_F(CheckUnset, SaysOfWhichValuesItIsNotSure) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float big[2000], small; if (p.x < 0.0) small = 1.0;\n"
          "    switch (int(p.x)) {\n"
          "        case 0: float late; break;\n"
          "        default: late += 0.0;\n"
          "    }\n"
          "    c = vec4(p.x < -1.0 ? big[int(p.y)] + small : 1.0);\n"
          "}\n");
    const Json found = cases("scene.frag", 0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]["note"],
              "3 values, none shows; not sure of `late` (4:23, a switch may jump over its "
              "declaration)");
}

TEST_F(CheckUnset, APictureThatIsNotWrittenEverywhereIsFound) {
    const std::pair<const char*, const char*> texts[] = {
        {"void mainImage(out vec4 c, in vec2 p) { if (p.x > 9.0) c = vec4(1); }\n", "1:25: `c`"},
        {"void mainImage(out vec4 c, in vec2 p) { c.rg = p / 99.0; c.a = 1.0; }\n", "1:25: `c`"},
        {"void mainImage(out vec4 c, in vec2 p) { c += p.xyxy / 99.0; }\n", "1:25: `c`"},
        {"void main() { if (gl_FragCoord.x > 9.0) gl_FragColor = vec4(1); }\n",
         "1:41: `gl_FragColor`"},
        {"#version 330\nout vec3 light;\nvoid main() { light.xy = gl_FragCoord.xy; }\n",
         "2:10: `light`"},
    };
    for (const auto& [text, words] : texts) {
        SCOPED_TRACE(text);
        write("scene.frag", text);
        const Json found = cases("scene.frag", 6);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_NE(found[0]["note"].get<std::string>().find(words), std::string::npos) << found;
    }
}

TEST_F(CheckUnset, WhatIsUnsetForAWhileIsFound) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float light, phase = fract(iTime / 16.0);\n"
          "    if (phase < 0.5) light = phase; else if (phase < 0.8) light = 1.0;\n"
          "    c = vec4(light);\n}\n");
    const Json found = cases("scene.frag", 6);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0]["note"].get<std::string>().find("2:11: `light`"), std::string::npos)
        << found;
}

TEST_F(CheckUnset, OfALateWhileAndOfASoundToo) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float light;\n    if (iTime < 46.5 || iTime > 49.0) light = 0.5;\n"
          "    c = vec4(light);\n}\n");
    EXPECT_EQ(cases("scene.frag", 6).size(), 1u) << "three seconds of the first minute";
    const auto heard = [&](const std::string& statements) {
        write("scene.frag",
              "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n"
              "vec2 mainSound(int samp, float time) {\n" +
                  statements + "}\n");
        return glint({"check", "scene.frag", "--case", "sound", "--size", "8x8"});
    };
    const Outcome unset = heard(
        "    float loud;\n    if (mod(time, 8.0) < 6.0) loud = 0.3;\n"
        "    return vec2(loud * sin(1000.0 * fract(time)));\n");
    EXPECT_EQ(unset.code, 6);
    EXPECT_NE(unset.out.find("scene.frag:3:11: `loud`"), std::string::npos) << unset.out;
    const Outcome late = heard(
        "    float scale[2] = float[2](1.0, 1.5);\n"
        "    int k = time > 10.0 && time < 12.0 ? 2 : 1;\n"
        "    return vec2(0.3 * scale[k]);\n");
    EXPECT_EQ(late.code, 6);
    EXPECT_NE(late.out.find("index 2 out of range"), std::string::npos) << late.out;
}

// Each reading of it begins with the same buffers.
TEST_F(CheckUnset, ASoundOfABufferThatChangesCountsOnNothingUnset) {
    write("scene.frag",
          "uniform sampler2D sum; //@ pass mainSum format=rgba32f\n"
          "void mainSum(out vec4 c, in vec2 p) {\n"
          "    c = mod(texelFetch(sum, ivec2(p), 0) + 0.01, 1.0);\n}\n"
          "vec2 mainSound(int samp, float time) {\n"
          "    float x;\n    if (samp >= 0) x = 0.25;\n    if (time > 1e6) x += 1.0;\n"
          "    return vec2(x * texelFetch(sum, ivec2(0), 0).x);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n");
    const Outcome sound = glint({"check", "scene.frag", "--case", "sound", "--size", "8x8"});
    EXPECT_EQ(sound.code, 0) << sound.out;
}

TEST_F(CheckUnset, WhatNothingReadsOfABufferMayStayUnset) {
    const auto scene = [&](const char* read) {
        write("scene.frag", std::string("uniform sampler2D trail; //@ pass mainTrail\n"
                                        "void mainTrail(out vec4 c, in vec2 p) {\n"
                                        "    c.x = 0.9 * texelFetch(trail, ivec2(p), 0).x + 0.01;\n"
                                        "}\n"
                                        "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    c.rgb = texelFetch(trail, ivec2(p), 0).") +
                                read + ";\n}\n");
    };
    scene("xxx");
    const Json found = cases("scene.frag", 0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]["note"], "2 values, none shows");
    scene("xxy");
    EXPECT_NE(cases("scene.frag", 6)[0]["note"].get<std::string>().find(
                  "2:25: `c` is not written everywhere"),
              std::string::npos);
}

}  // namespace
}  // namespace glint::cli::check_unset_test
