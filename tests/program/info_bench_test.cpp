// `glint info` tells what a scene really needs; `glint bench` how long it takes.
#include "report.h"

#include <algorithm>
#include <map>

namespace glint::cli::info_bench_test {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kScene =
    "uniform float a;      //@ 0.5 [0, 1] quality reference=1 \"how much\"\n"
    "uniform float idle;   //@ 0.5 [0, 1]\n"
    "uniform bool  haze;   //@ off\n"
    "uniform int   kind;   //@ 1 {off, low, high}\n"
    "uniform vec3  tint;   //@ #ff0000\n"
    "uniform sampler2D still; //@ pass mainStill size=8x4 format=rgba16f\n"
    "uniform sampler2D trail; //@ pass mainTrail\n"
    "uniform sampler2D ticks; //@ pass mainTicks size=1x1 step=1/240\n"
    "uniform sampler2D fog;   //@ pass mainFog\n"
    "uniform sampler2D lost;  //@ pass mainLost\n"
    "uniform sampler2D grain; //@ noise rgba 16\n"
    "uniform sampler2D wood;  //@ image gone.png\n"
    "void mainStill(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }\n"
    "void mainTrail(out vec4 c, in vec2 p) { c = texelFetch(trail, ivec2(p), 0) + iTime; }\n"
    "void mainTicks(out vec4 c, in vec2 p) { c = texelFetch(ticks, ivec2(p), 0) + 1.0; }\n"
    "void mainFog(out vec4 c, in vec2 p) { c = texture(grain, p) * float(kind); }\n"
    "void mainLost(out vec4 c, in vec2 p) { c = texture(wood, p) * idle; }\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    c = a * texture(still, p) + texelFetch(trail, ivec2(p), 0) + texelFetch(ticks, ivec2(0), "
    "0);\n"
    "    c.rgb *= tint;\n"
    "    if (haze) c += texelFetch(fog, ivec2(p), 0);\n"
    "}\n";

class InfoAndBench : public InAFolder {
protected:
    InfoAndBench() { write("scene.frag", kScene); }

    Json json(std::vector<std::string> arguments) const {
        arguments.push_back("--json");
        const Outcome outcome = glint(std::move(arguments));
        EXPECT_EQ(outcome.err, "");
        return report_of(outcome);
    }

    // Of a scene that is warned of.
    Json json_of(std::vector<std::string> arguments) const {
        arguments.push_back("--json");
        return report_of(glint(std::move(arguments)));
    }

    static std::map<std::string, std::string> left_out(const Json& info) {
        std::map<std::string, std::string> list;
        for (const Json& item : info["left_out"]) list[item["what"]] = item["why"];
        return list;
    }

    static const Json& named(const Json& list, const std::string& name) {
        for (const Json& item : list) {
            if (item["name"] == name) return item;
        }
        ADD_FAILURE() << "no " << name << " in " << list;
        return list;
    }
};

TEST_F(InfoAndBench, InfoTellsWhatWasLeftOutAndWhy) {
    auto list = left_out(json({"info", "scene.frag"}));
    EXPECT_EQ(list["pass lost"], "nothing reads it");
    EXPECT_EQ(list["sampler wood"], "nothing reads it");
    EXPECT_EQ(list["tweak idle"], "nothing reads it");
    EXPECT_EQ(list["pass fog"], "these tweak values switch off all that reads it");
    EXPECT_EQ(list["sampler grain"], "these tweak values switch off all that reads it");
    EXPECT_EQ(list["second buffer of still"], "it does not read itself back");
    EXPECT_FALSE(list.contains("second buffer of trail"));
    EXPECT_FALSE(list.contains("tweak a"));
    EXPECT_FALSE(list.contains("tweak haze"));

    list = left_out(json({"info", "scene.frag", "--tweak", "haze=on"}));
    EXPECT_TRUE(list.contains("pass lost"));
    EXPECT_FALSE(list.contains("pass fog"));
    EXPECT_FALSE(list.contains("sampler grain"));
}

TEST_F(InfoAndBench, InfoLeavesNothingOutThatTheSoundReads) {
    write("heard.frag",
          "uniform float hz; //@ 440 [20, 2000]\nuniform float idle; //@ 1 [0, 2]\n"
          "uniform sampler2D grain; //@ noise rgba 16\nuniform sampler2D tab; //@ pass mainTab\n"
          "void mainTab(out vec4 c, in vec2 p) { c = texelFetch(grain, ivec2(p) % 16, 0); }\n"
          "vec2 mainSound(int samp, float time) {\n"
          "    return texelFetch(tab, ivec2(samp % 8, 0), 0).xy * fract(time * hz);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    const auto list = left_out(json({"info", "heard.frag"}));
    EXPECT_EQ(list.size(), 1u);
    EXPECT_TRUE(list.contains("tweak idle"));
}

TEST_F(InfoAndBench, InfoTellsOfFilesThatAreMissing) {
    write("im.frag",
          "uniform sampler2D b; //@ image wod.jpg\nuniform sampler2D c; //@ image unread.jpg\n"
          "void mainImage(out vec4 o, in vec2 p) { o = texture(b, p / iResolution.xy); }\n");
    const Outcome info = glint({"info", "im.frag", "--json"});
    EXPECT_EQ(info.code, 4);
    EXPECT_TRUE(info.err.starts_with("im.frag:1:19: error: Cannot read wod.jpg")) << info.err;
    EXPECT_EQ(info.err.find("unread"), std::string::npos) << info.err;
    EXPECT_EQ(Json::parse(info.out)["passes"].size(), 1u);
}

TEST_F(InfoAndBench, InfoHasTheDocumentedKeys) {
    const Json info = json({"info", "scene.frag", "--size", "64x36"});
    EXPECT_EQ(info["scene"], "scene.frag");
    ASSERT_EQ(info["passes"].size(), 4u);
    const Json& still = named(info["passes"], "still");
    EXPECT_EQ(still["entry"], "mainStill");
    EXPECT_EQ(still["samplers"], Json({"still"}));
    EXPECT_EQ(still["size"], Json({8, 4}));
    EXPECT_EQ(still["format"], "rgba16f");
    EXPECT_EQ(still["bytes"], 8 * 4 * 8);
    EXPECT_EQ(still["feedback"], false);
    EXPECT_EQ(still["reads"], Json::array());
    EXPECT_EQ(still["runs"], "on change");
    const Json& trail = named(info["passes"], "trail");
    EXPECT_EQ(trail["feedback"], true);
    EXPECT_EQ(trail["size"], Json({64, 36}));
    EXPECT_EQ(trail["reads"], Json({"trail"}));
    EXPECT_EQ(trail["runs"], "every frame");
    const Json& ticks = named(info["passes"], "ticks");
    EXPECT_EQ(ticks["runs"], "every step");
    EXPECT_NEAR(ticks["step"].get<double>(), 1 / 240.0, 1e-12);
    EXPECT_EQ(named(info["passes"], "image")["entry"], "mainImage");

    const Json& a = named(info["tweaks"], "a");
    EXPECT_EQ(a["type"], "float");
    EXPECT_EQ(a["default"], 0.5);
    EXPECT_EQ(a["min"], 0);
    EXPECT_EQ(a["max"], 1);
    EXPECT_EQ(a["quality"], true);
    EXPECT_EQ(a["reference"], 1.0);
    EXPECT_EQ(named(info["tweaks"], "haze")["default"], false);
    EXPECT_EQ(named(info["tweaks"], "tint")["default"], Json({1.0, 0.0, 0.0}));
    const auto uniforms = info["uniforms"].get<std::set<std::string>>();
    EXPECT_TRUE(uniforms.contains("a") && uniforms.contains("iTime")) << info["uniforms"];
    EXPECT_FALSE(uniforms.contains("iMouse"));
}

TEST_F(InfoAndBench, InfoForPeopleAndTheTextThatTheDriverSees) {
    const Outcome tables = glint({"info", "scene.frag"});
    EXPECT_EQ(tables.code, 0);
    for (const std::string part :
         {"passes", "tweaks", "left out", "pass fog", "how much", "{off, low, high}", "findings"}) {
        EXPECT_NE(tables.out.find(part), std::string::npos) << part;
    }
    const Outcome source = glint({"info", "scene.frag", "--source", "trail"});
    EXPECT_EQ(source.code, 0);
    EXPECT_TRUE(source.out.starts_with("#version 300 es\n"));
    EXPECT_NE(source.out.find("const float a = 0.5;"), std::string::npos);
    const Outcome fed = glint({"info", "scene.frag", "--source", "image", "--no-specialise"});
    EXPECT_NE(fed.out.find("uniform float a;"), std::string::npos);
}

TEST_F(InfoAndBench, BenchHasTheDocumentedKeys) {
    const Json bench = json({"bench", "scene.frag", "--size", "64x36", "--frames", "5"});
    EXPECT_FALSE(bench["renderer"].get<std::string>().empty());
    EXPECT_EQ(bench["size"], Json({64, 36}));
    EXPECT_EQ(bench["frames"], 5);
    EXPECT_EQ(bench["specialised"], true);
    EXPECT_GE(bench["host_ms"].get<double>(), 0.0);
    EXPECT_GT(bench["processor_ms"]["median"].get<double>(), 0.0);
    const Json& ms = bench["ms"];
    EXPECT_GT(ms["min"].get<double>(), 0.0);
    EXPECT_LE(ms["min"], ms["median"]);
    EXPECT_LE(ms["median"], ms["p95"]);
    ASSERT_EQ(bench["passes"].size(), 4u);
    EXPECT_EQ(named(bench["passes"], "still")["runs"], "on change");
    EXPECT_EQ(named(bench["passes"], "ticks")["drawn"], 20);
    const Outcome told = glint({"bench", "scene.frag", "--size", "64x36", "--frames", "5"});
    EXPECT_NE(told.out.find("every step, 4 a frame of "), std::string::npos) << told.out;
    EXPECT_EQ(named(bench["passes"], "ticks")["runs"], "every step");
    EXPECT_GT(named(bench["passes"], "image")["ms"].get<double>(), 0.0);
}

TEST_F(InfoAndBench, BenchComparesConstantsWithUniforms) {
    const Json bench =
        json({"bench", "scene.frag", "--size", "64x36", "--frames", "5", "--compare"});
    EXPECT_GT(bench["uniform_ms"]["median"].get<double>(), 0.0);
    EXPECT_NEAR(bench["ratio"].get<double>(),
                bench["uniform_ms"]["median"].get<double>() / bench["ms"]["median"].get<double>(),
                1e-9);
    const Json fed =
        json({"bench", "scene.frag", "--size", "64x36", "--frames", "3", "--no-specialise"});
    EXPECT_EQ(fed["specialised"], false);
    EXPECT_NE(glint({"bench", "scene.frag", "--size", "64x36", "--frames", "3"}).out.find("median"),
              std::string::npos);
}

TEST_F(InfoAndBench, MistakesHaveTheSameCodesAsAStill) {
    write("wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    for (const std::string verb : {"info", "bench"}) {
        EXPECT_EQ(glint({verb, "wrong.frag"}).code, 3) << verb;
        EXPECT_EQ(glint({verb, "gone.frag"}).code, 4) << verb;
        EXPECT_EQ(glint({verb, "scene.frag", "--size", "0x0"}).code, 2) << verb;
        EXPECT_EQ(glint({verb, "scene.frag", "--device", "none such"}).code, 5) << verb;
    }
}

// Whether glslang and spirv-opt are there to count words.
bool counts_words() {
    return std::system(
               "glslangValidator --version >/dev/null 2>&1 && "
               "spirv-opt --version >/dev/null 2>&1") == 0;
}

constexpr std::string_view kCopies =
    "float heavy(vec2 p) { float s = 0.0; for (int i = 0; i < 9; ++i) s += sin(p.x * s + p.y); "
    "return s; }\n"
    "float light(vec2 p) { return heavy(p) + heavy(p.yx); }\n"
    "void mainImage(out vec4 c, in vec2 p) { c = vec4(light(p), heavy(2.0 * p), 0, 1); }\n";

TEST_F(InfoAndBench, InfoNamesTheFunctionWhoseCopiesCostMost) {
    if (!counts_words()) GTEST_SKIP() << "no glslangValidator or spirv-opt";
    write("copies.frag", kCopies);
    const Json copies = json({"info", "copies.frag"})["copies"];
    EXPECT_EQ(copies["function"], "heavy");
    EXPECT_EQ(copies["pass"], "image");
    EXPECT_EQ(copies["copies"], 3);
    EXPECT_EQ(copies["saved_by_one_call"], 2 * copies["words"].get<int>());
    EXPECT_NE(
        glint({"info", "copies.frag"}).out.find("the costliest: heavy in image, 3 copies of "),
        std::string::npos);
}

TEST_F(InfoAndBench, WithoutGlslangOnlyTheWordsAreMissing) {
    write("copies.frag", kCopies);
    Command command = this->command({"info", "copies.frag", "--json"});
    command.environment = {{"PATH", "/nowhere"}};
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0);
    const Json copies = Json::parse(outcome.out, nullptr, false)["copies"];
    EXPECT_TRUE(copies["function"].is_null());
    EXPECT_NE(copies["why_not"].get<std::string>().find("not installed"), std::string::npos);
}

TEST_F(InfoAndBench, WithoutATemporaryFolderOnlyWhatNeedsOneIsMissing) {
    write("copies.frag", kCopies);
    Command command = this->command({"info", "copies.frag", "--json"});
    command.environment = {{"TMPDIR", "/nowhere"}};
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out, nullptr, false);
    EXPECT_NE(json["copies"]["why_not"].get<std::string>().find("TMPDIR"), std::string::npos);
    command = this->command({"bench", "copies.frag", "--compile"});
    command.environment = {{"TMPDIR", "/nowhere"}};
    const Outcome bench = run(command);
    EXPECT_EQ(bench.code, 1);
    EXPECT_NE(bench.err.find("TMPDIR names no folder"), std::string::npos) << bench.err;
}

// "scene.frag:3:7 unused-function" for each finding of a scene.
std::vector<std::string> names_of(const Json& findings) {
    std::vector<std::string> list;
    for (const Json& one : findings)
        list.push_back(one["file"].get<std::string>() + ":" + one["line"].dump() + ":" +
                       one["column"].dump() + " " + one["name"].get<std::string>());
    return list;
}

TEST_F(InfoAndBench, InfoTellsFindingsWithTheirPlaces) {
    write("found.frag",
          "float lost() { return 1.0; }\n"
          "uniform float level; //@ 0.5 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    for (int i = 0; i < 70000; ++i) c += level;\n"
          "}\n");
    const Json info = json({"info", "found.frag"});
    EXPECT_EQ(names_of(info["findings"]),
              (std::vector<std::string>{"found.frag:1:7 unused-function",
                                        "found.frag:2:15 undescribed-tweak",
                                        "found.frag:4:5 long-loop"}));
    const Outcome outcome = glint({"info", "found.frag"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(
        outcome.out.find("  found.frag:1:7: warning: nothing that is drawn calls the function "
                         "`lost` [unused-function]\n"),
        std::string::npos)
        << outcome.out;
}

TEST_F(InfoAndBench, InfoPrintsSomeOfManyFindingsAndSaysHowManyMore) {
    std::string text;
    for (int i = 0; i < 300; ++i) text += "float f" + std::to_string(i) + "() { return 1.0; }\n";
    write("many.frag", text + "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    const Outcome outcome = glint({"info", "many.frag"});
    EXPECT_NE(outcome.out.find("  and 292 more [unused-function]"), std::string::npos);
    EXPECT_EQ(outcome.out.find("f8`"), std::string::npos);
    EXPECT_EQ(json({"info", "many.frag"})["findings"].size(), 300u);
}

TEST_F(InfoAndBench, InfoTellsNothingOfWhatBrowsersTakeAndTheValidatorDoesNot) {
    if (!counts_words()) GTEST_SKIP() << "no glslangValidator or spirv-opt";
    const std::string image =
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(turned[0], 0, 1); }\n";
    write("inverse.frag", "const mat2 turned = inverse(mat2(1, 2, 3, 4));\n" + image);
    EXPECT_TRUE(json({"info", "inverse.frag"})["findings"].empty());
    write("sound.frag",
          "const mat2 turned = mat2(1);\n#ifdef PASS_sound\nfloat iTime;\nvec2 mainSound(float t) "
          "{ iTime = t; return vec2(sin(iTime)); }\n#endif\n" +
              image);
    EXPECT_TRUE(json({"info", "sound.frag"})["findings"].empty());
}

TEST_F(InfoAndBench, InfoTellsWhatWebGlWouldRefuse) {
    if (!counts_words()) GTEST_SKIP() << "no glslangValidator or spirv-opt";
    write("lib.glsl", "vec4 read(vec2 at) { return texture2D(grain, at); }\n");
    write("refused.frag",
          "#define texture(s, at) texture2D(s, at)\n"  // so that texture2D is not texture
          "uniform float level; //@ 0.5 [0, 1] \"how much\"\n"
          "uniform sampler2D grain; //@ noise r 8\n"
          "// The next line is another file's.\n"
          "#include \"lib.glsl\"\n"
          "float unused() { return texture2D(grain, vec2(0)).x; } //@ allow unused-function\n"
          "void mainImage(out vec4 c, in vec2 p) { c = read(p) * level; }\n");
    EXPECT_EQ(names_of(json({"info", "refused.frag"})["findings"]),
              std::vector<std::string>{"lib.glsl:1:29 webgl"});
    write("macro.frag",
          "#define texture(s, at) READ(at)\n#define READ(x) texture2D(grain, x)\n"
          "uniform sampler2D grain; //@ noise r 8\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(1) *\n        READ(p);\n}\n");
    EXPECT_EQ(names_of(json({"info", "macro.frag"})["findings"]),
              std::vector<std::string>{"macro.frag:6:9 webgl"});
    write("twice.frag",
          "/* one */ #define K 2.0\n"
          "/* two\n"
          "*/ #if 1\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    int n; switch (3) { case 3: n = 2; } /* switch\n"
          "    */ switch (n) { case 2: n = 9; break; default: ; }\n    c = vec4(n) * K; }\n"
          "/* three */ #endif\n");
    EXPECT_EQ(names_of(json({"info", "twice.frag"})["findings"]),
              std::vector<std::string>{"twice.frag:6:8 webgl"});
    write("taken.frag",
          "const float k = determinant(inverse(mat2(1)));\nuniform sampler2D mine;;\n"
          "mat2 mix(mat2 a, mat2 b, float t) { return a + t * (b - a); } "
          "//@ allow shadowed-name\n"
          "void mainImage(out vec4 c, in vec2 p) { float a; vec2 d = iResolution.xy;\n"
          "    c = vec4(mix(mat2(1), mat2(a), 0.5)[0] + d / 0.0, texture(iChannel0, p)"
          ".xy) * float(iTick) + texture2DLodEXT(mine, p, 0.0) + texture2D(mine, p) * k; }\n");
    EXPECT_EQ(names_of(json_of({"info", "taken.frag"})["findings"]), std::vector<std::string>{});
}

TEST_F(InfoAndBench, InfoSaysWhatItHasNotLookedInto) {
    write("plain.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    Command command = this->command({"info", "plain.frag"});
    command.environment = {{"PATH", "/nowhere"}};
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.out.find("  plain.frag: warning: nothing is said of what WebGL 2 refuses: "
                               "glslangValidator is not installed\n"),
              std::string::npos)
        << outcome.out;
}

TEST_F(InfoAndBench, CompileTellsOfEveryPassWithTheCacheEmptyAndFull) {
    const Json bench = json({"bench", "scene.frag", "--compile", "--size", "32x18"});
    ASSERT_EQ(bench["passes"].size(), 4u);
    for (const Json& pass : bench["passes"]) {
        for (const char* key : {"cold_ms", "warm_ms", "first_draw_ms", "first_draw_warm_ms"})
            EXPECT_GT(pass[key].get<double>(), 0.0) << key;
        EXPECT_EQ(pass["words"].is_number(), counts_words()) << pass;
    }
    EXPECT_EQ(bench["passes"].back()["name"], "image");
    EXPECT_GT(bench["rounds"].get<int>(), 0);
}

// A median of sums is no less than the median of any part, which is all that is certain of clocks.
TEST_F(InfoAndBench, CompileTellsOfAllPassesTogether) {
    const Json bench = json({"bench", "scene.frag", "--compile", "--size", "32x18"});
    std::size_t words = 0;
    for (const Json& pass : bench["passes"]) {
        for (const char* key : {"cold_ms", "warm_ms", "first_draw_ms", "first_draw_warm_ms"})
            EXPECT_GE(bench["total"][key].get<double>(), pass[key].get<double>()) << key;
        if (counts_words()) words += pass["words"].get<std::size_t>();
    }
    EXPECT_EQ(bench["total"]["words"], counts_words() ? Json(words) : Json());
    for (const char* key : {"together_ms", "together_warm_ms"})
        EXPECT_GT(bench["total"][key].get<double>(), 0.0) << key;
    const Outcome table = glint({"bench", "scene.frag", "--compile", "--size", "32x18"});
    EXPECT_NE(table.out.find("\nall passes "), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("\nside by side, clock "), std::string::npos) << table.out;
}

TEST_F(InfoAndBench, CompileSaysOnceWhatDoesNotCompile) {
    write("wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    const Outcome outcome = glint({"bench", "wrong.frag", "--compile"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err.find("error:"), outcome.err.rfind("error:")) << outcome.err;
    EXPECT_EQ(glint({"bench", "gone.frag", "--compile"}).code, 4);
    EXPECT_EQ(glint({"bench", "scene.frag", "--compile", "--device", "none such"}).code, 5);
}

}  // namespace
}  // namespace glint::cli::info_bench_test
