// `glint check --case rounding` and `one ulp`: where digits are lost that are known to be lost.
#include "report.h"

namespace glint::cli {
namespace {

using Json = nlohmann::json;

class RoundingCheck : public InAFolder {
protected:
    Json found(const std::string& body, const std::string& only = "rounding") const {
        write("scene.frag",
              "void mainImage(out vec4 c, in vec2 p) {\n    vec2 q = p / iResolution.xy;\n" + body +
                  "\n}\n");
        const Json report = report_of(glint(
            {"check", "scene.frag", "--case", only, "--json", "--size", "32x18", "-o", "out"}));
        return report["cases"].empty() ? Json() : report["cases"][0];
    }
};

// 1e-4 of 1 is left: four digits of seven are gone.
TEST_F(RoundingCheck, NamesTheLineInWhichASumCancels) {
    const Json one = found(
        "    float x = 1e-4 * (1.0 + q.x);\n"
        "    float y = (1.0 + x) - 1.0;\n"
        "    c = vec4(4000.0 * y);");
    ASSERT_TRUE(one.contains("where")) << one;
    EXPECT_EQ(one["where"]["line"], 4) << one;
    EXPECT_EQ(one["where"]["expression"], "(1.0 + x)") << one;
    EXPECT_NE(one["note"].get<std::string>().find("`(1.0 + x)` loses 3."), std::string::npos)
        << one;
}

TEST_F(RoundingCheck, TellsAPictureOfWhichNothingIsLeft) {
    const Json one = found(
        "    float y = sqrt(9010203.0 + 0.4 * q.x) - sqrt(9010203.0);\n"
        "    c = vec4(vec3(3000.0 * y), 1.0);");
    EXPECT_EQ(one["max"], 0.0) << one;
    EXPECT_NE(one["note"].get<std::string>().find(" digits of 7.2"), std::string::npos) << one;
}

// A buffer that nothing changes has been drawn when the check begins.
TEST_F(RoundingCheck, LooksIntoBuffersOfNoState) {
    write("scene.frag",
          "uniform sampler2D sum; //@ pass mainSum\n"
          "void mainSum(out vec4 c, in vec2 p) {\n"
          "    c = vec4(((1.0 + p.x * 1e-7) - 1.0) * 1e5); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(sum, ivec2(p), 0); }\n");
    const Json report = report_of(glint(
        {"check", "scene.frag", "--case", "rounding", "--json", "--size", "32x18", "-o", "out"}));
    ASSERT_EQ(report["cases"].size(), 1u) << report;
    EXPECT_EQ(report["cases"][0]["where"]["line"], 3) << report;
}

// x^2 + b x + 1 = 0 with a large b: the textbook's small root cancels, the other way to write it
// does not (Higham, "Accuracy and Stability of Numerical Algorithms", 1.8).
TEST_F(RoundingCheck, TellsTheStableFormOfAQuadraticFromTheTextbooks) {
    const std::string begin =
        "    float b = 900.0 + 99.7 * q.x;\n    float root = sqrt(b * b - 4.0);\n";
    const Json textbook =
        found(begin + "    float x = (root - b) / 2.0;\n    c = vec4(-900.0 * x);");
    ASSERT_TRUE(textbook.contains("where")) << textbook;
    const int line = textbook["where"]["line"];
    EXPECT_TRUE(line == 4 || line == 5) << textbook;
    const Json stable =
        found(begin + "    float x = -2.0 / (root + b);\n    c = vec4(-900.0 * x);");
    EXPECT_FALSE(stable.contains("where")) << stable;
}

TEST_F(RoundingCheck, FindsNothingInAPictureWithoutCancellation) {
    EXPECT_FALSE(found("    c = vec4(q * q, sin(q.x * 3.0), 1.0);").contains("where"));
}

TEST_F(RoundingCheck, DrawsAMapWhereOneUlpMovesThePicture) {
    const Json one = found("    c = vec4(fract(1e6 * q.x) );", "one ulp");
    EXPECT_NE(one["note"].get<std::string>().find("the place of pixels"), std::string::npos) << one;
    EXPECT_NE(one["note"].get<std::string>().find("float itself is at fault"), std::string::npos);
    ASSERT_TRUE(one.contains("picture")) << one;
    EXPECT_TRUE(fs::exists(folder() / one["picture"].get<std::string>()));
    EXPECT_FALSE(found("    c = vec4(q, 0.5, 1.0);", "one ulp").contains("picture"));
}

}  // namespace
}  // namespace glint::cli
