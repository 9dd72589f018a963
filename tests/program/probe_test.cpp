// The command line of `glint probe`: what it answers, in which shape, and what it says of mistakes.
#include "report.h"

#include <map>

namespace glint::cli::probe_verb_test {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kScene =
    "uniform sampler2D sum; //@ pass mainSum\n"                               // 1
    "float twice(float x) {\n"                                                // 2
    "    float y = x * 2.0;\n"                                                // 3
    "    return y;\n"                                                         // 4
    "}\n"                                                                     // 5
    "void mainSum(out vec4 c, in vec2 p) {\n"                                 // 6
    "    c = texelFetch(sum, ivec2(p), 0) + 1.0;\n"                           // 7
    "}\n"                                                                     // 8
    "void mainImage(out vec4 c, in vec2 p) {\n"                               // 9
    "    float a = twice(p.x), b = twice(p.y);\n"                             // 10
    "    for (int i = 0; i < 3; i++) a += texelFetch(sum, ivec2(i), 0).x;\n"  // 11
    "    // nothing here\n"                                                   // 12
    "    if (a < 0.0) b = sqrt(a);\n"                                         // 13
    "    c = vec4(a, b, iTime, 1);\n"                                         // 14
    "}\n";

class ProbeVerb : public InAFolder {
protected:
    ProbeVerb() { write("scene.frag", kScene); }

    Outcome probe(std::vector<std::string> arguments) const {
        for (const char* word : {"8x4", "--size", "scene.frag", "probe"})
            arguments.insert(arguments.begin(), word);
        return glint(std::move(arguments));
    }
    Json json(std::vector<std::string> arguments) const {
        arguments.push_back("--json");
        return report_of(probe(std::move(arguments)));
    }
    static Json values_of(const Json& series) {
        Json values = Json::array();
        for (const Json& row : series["rows"]) values.push_back(row["value"]);
        return values;
    }
    // Exit code 2, and these words on stderr alone.
    void expect_usage(std::vector<std::string> arguments, std::string_view words) const {
        const Outcome outcome = probe(std::move(arguments));
        EXPECT_EQ(outcome.code, 2) << words;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
};

TEST_F(ProbeVerb, TellsEveryValueAtAPixelInTheShapeThatScriptsRelyOn) {
    const Json all = json({"--at", "3,1", "--frame", "2", "--fps", "10"});
    EXPECT_EQ(all["pixel"], Json({3, 1}));
    EXPECT_EQ(all["size"], Json({8, 4}));
    EXPECT_EQ(all["frame"], 2);
    EXPECT_EQ(all["pass"], "image");
    EXPECT_EQ(all["same"], "bits");
    std::map<std::string, Json> last;
    for (const Json& row : all["values"]) {
        for (const char* key :
             {"file", "line", "column", "function", "name", "kind", "type", "hit"})
            EXPECT_TRUE(row.contains(key)) << key;
        EXPECT_TRUE(row["value"].is_array());
        last[row["name"]] = row;
    }
    EXPECT_EQ(last["y"]["line"], 3);
    EXPECT_EQ(last["y"]["value"], Json({3.0}));  // of the last call, with p.y
    EXPECT_EQ(last["y"]["hit"], 2);
    EXPECT_EQ(last["b"]["value"], Json({3.0}));
    EXPECT_EQ(last["a"]["value"], Json({7.0 + 3 * 3}));  // the third frame's sum three times
    EXPECT_EQ(last["a"]["hits"], 3);
    EXPECT_EQ(last["c"]["type"], "vec4");
    EXPECT_FALSE(last.contains("b = sqrt(a)"));
}

TEST_F(ProbeVerb, TellsALineAHitAndAnExpressionInTheOrderOfTheCalls) {
    const Json line = json({"--at", "3,1", "--line", "3"})["values"];
    ASSERT_EQ(line.size(), 2u);
    EXPECT_EQ(line[0]["value"], Json({7.0}));
    EXPECT_EQ(line[1]["value"], Json({3.0}));
    const Json second = json({"--at", "3,1", "--line", "3", "--hit", "2"})["values"];
    ASSERT_EQ(second.size(), 1u);
    EXPECT_EQ(second[0]["value"], Json({3.0}));
    const Json turns = json({"--at", "3,1", "--expr", "i * 2@11"})["values"];
    ASSERT_EQ(turns.size(), 3u);
    EXPECT_EQ(turns[2]["value"], Json({4}));
    EXPECT_EQ(turns[2]["type"], "int");
    const Json of_pass = json({"--pass", "sum", "--frame", "3", "--line", "7"});
    EXPECT_EQ(of_pass["pass"], "sum");
    EXPECT_EQ(of_pass["values"][0]["value"], Json({4, 4, 4, 4}));
}

TEST_F(ProbeVerb, TellsAValueAlongARowAColumnAndOverFrames) {
    const Json row = json({"--at", "3,1", "--line", "10", "--along", "x"})["series"][0];
    EXPECT_EQ(row["along"], "x");
    ASSERT_EQ(values_of(row).size(), 8u);  // of b, the last that the line gives a value
    const Json column = json({"--at", "3,1", "--line", "10", "--along", "y"})["series"][0];
    EXPECT_EQ(values_of(column), Json({{1.0}, {3.0}, {5.0}, {7.0}}));
    EXPECT_EQ(column["min"], Json({1.0}));
    EXPECT_EQ(column["max"], Json({7.0}));
    const Json second =
        json({"--at", "3,1", "--line", "3", "--hit", "9", "--along", "y"})["series"][0];
    EXPECT_EQ(second["unreached"], 4);
    const Json time = json({"--at", "0,0", "--line", "7", "--pass", "sum", "--along", "time",
                            "--frames", "1:5:2"})["series"][0];
    EXPECT_EQ(values_of(time), Json({{2, 2, 2, 2}, {4, 4, 4, 4}, {6, 6, 6, 6}}));
}

TEST_F(ProbeVerb, ASeriesNamesWhatItIsOf) {
    write("parts.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    mat2 m = mat2(p.x, 2, 3, iTime);\n"
          "    float a = 0.0; for (int i = 0; i < 3; i++) a += 1.0;\n"
          "    c = vec4(m) + a;\n"
          "}\n");
    const auto series = [&](std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"probe", "parts.frag", "--size", "4x2", "--at", "1,0", "--json"});
        return report_of(glint(std::move(more)))["series"][0];
    };
    const Json row = series({"--line", "2", "--along", "x"});
    EXPECT_EQ(row["name"], "m[0]");
    EXPECT_EQ(values_of(row), Json({{0.5, 2}, {1.5, 2}, {2.5, 2}, {3.5, 2}}));
    const Json time = series({"--line", "2", "--along", "time", "--frames", "0:1"});
    EXPECT_EQ(time["name"], "m[0]");
    EXPECT_EQ(values_of(time), Json({{1.5, 2}, {1.5, 2}}));
    const Json loop = series({"--line", "3", "--along", "time", "--frames", "0:1"});
    EXPECT_EQ(loop["name"], "a");
    EXPECT_EQ(values_of(loop), Json({{3.0}, {3.0}})) << "not the loop's condition, which is last";
}

TEST_F(ProbeVerb, WritesAMapCountsCostAndFindsFaults) {
    const Json map = json({"--line", "10", "--map", "b.exr"});
    EXPECT_TRUE(fs::exists(folder() / "b.exr"));
    EXPECT_EQ(map["series"][0]["max"], Json({7.0}));
    const Json cost = json({"--cost"})["cost"];
    for (const char* key : {"loops", "reads", "calls"}) EXPECT_TRUE(cost.contains(key)) << key;
    EXPECT_EQ(glint({"probe", "scene.frag", "--cost", "--size", "3x1"}).code, 0);
    EXPECT_EQ(json({"--faults"})["first_bad"], nullptr);
    write("bad.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(sqrt(1.0 - p.x));\n}\n");
    const Outcome bad = glint({"probe", "bad.frag", "--faults", "--size", "4x2", "--json"});
    const Json first = report_of(bad)["first_bad"];
    EXPECT_EQ(first["line"], 2);
    EXPECT_EQ(first["expression"], "sqrt(1.0 - p.x)");
    EXPECT_EQ(first["operands"], Json({-0.5}));
}

TEST_F(ProbeVerb, AsksWhereABlockBegins) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float x = 1.0;\n"
          "    {\n"
          "        x = 3.0;\n"
          "    }\n"
          "    switch (int(x)) {\n"
          "        case 3: {\n"
          "            x = 5.0;\n"
          "            break;\n"
          "        }\n"
          "    }\n"
          "    switch (int(x))\n"
          "    {\n"
          "        case 5: x = 5.0;\n"
          "    }\n"
          "    do\n"
          "    { x += 1.0;\n"
          "    }\n"
          "    while (x < 7.0);\n"
          "    c = vec4(x);\n}\n");
    const auto told = [&](int line) {
        const Json all = json({"--expr", fmt::format("x@{}", line)});
        Json values = Json::array();
        for (const Json& row : all["values"]) values.push_back(row["value"][0]);
        return values;
    };
    EXPECT_EQ(told(3), Json({1.0}));
    EXPECT_EQ(told(7), Json({3.0}));
    EXPECT_EQ(told(13), Json({5.0})) << "a switch has no place at its head";
    EXPECT_EQ(told(19), Json({6.0, 7.0}));
}

TEST_F(ProbeVerb, OfAMacrosAssignmentsTellsThatWhichIsNamed) {
    write("scene.frag",
          "#define S for (int i = 0; i < 3; i++) { acc2 = float(i); if (i == 1) acc = 7.0; }\n"
          "#define T acc = 1.0; if (p.x > 99.0) acc = 2.0;\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float acc = 0.0, acc2 = 0.0;\n"
          "    S\n"
          "    T\n"
          "    c = vec4(acc, acc2, 0, 1);\n}\n");
    const auto series = [&](const char* line) {
        return json({"--line", line, "--along", "time", "--frames", "0:1"})["series"][0];
    };
    EXPECT_EQ(series("5")["name"], "acc");
    EXPECT_EQ(values_of(series("5")), Json({{7.0}, {7.0}}));
    EXPECT_EQ(series("6")["unreached"], 2);
}

TEST_F(ProbeVerb, OfAFaultTellsThePassTheFaceAndTheOutputThatIsNotGiven) {
    const auto fault = [&](const std::string& text) {
        write("scene.frag", text);
        return probe({"--faults"}).out;
    };
    const std::string cube = fault(
        "uniform samplerCube sky; //@ pass mainSky size=4\n"
        "float root(float x) { return sqrt(x); }\n"
        "void mainSky(out vec4 c, in vec2 p, in vec3 o, in vec3 d) {\n"
        "    c = vec4(root(d.y < -0.9 && d.z > 0.1 ? -1.0 : 1.0));\n}\n"
        "void mainImage(out vec4 c, in vec2 p) { c = texture(sky, vec3(p, 1)); }\n");
    EXPECT_NE(cube.find("sqrt(-1), in root, pass sky, face 3, pixel "), cube.npos) << cube;
    const std::string unset =
        fault("void mainImage(out vec4 c, in vec2 p) { c.xy = p; c.r += c.z; c.zw = p; }\n");
    EXPECT_NE(unset.find(":1: c.z: a value that nothing has given it"), unset.npos) << unset;
    const std::string sound = fault("void mainImage(out vec4 c, in vec2 p) { c = p.xyxy; }\n");
    EXPECT_NE(sound.find("no fault"), sound.npos) << sound;
}

TEST_F(ProbeVerb, OfAPassWithoutAStepSaysSoAndOfAComponentThatIsNeverFiniteNoRange) {
    write("scene.frag",
          "uniform sampler2D sum; //@ pass mainSum size=8x4 step=1/30\n"
          "void mainSum(out vec4 c, in vec2 p) {\n"
          "    vec2 v = vec2(sqrt(-p.x), p.x);\n"
          "    c = texelFetch(sum, ivec2(p), 0) + v.y;\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(sum, ivec2(0), 0); }\n");
    const Outcome early = probe({"--pass", "sum", "--frame", "0", "--expr", "v@4"});
    EXPECT_EQ(early.code, 1);
    EXPECT_TRUE(early.err.starts_with("error: Pass sum has taken no step")) << early.err;
    const Json row =
        json({"--pass", "sum", "--frame", "9", "--expr", "v@4", "--along", "x"})["series"][0];
    EXPECT_EQ(row["min"], Json({nullptr, 0.5}));
    EXPECT_EQ(row["max"], Json({nullptr, 7.5}));
}

// The picture does not hang on it, so the driver leaves it out, and nobody draws the buffer.
TEST_F(ProbeVerb, TellsAValueOfABufferThatTweaksSwitchOff) {
    write("off.frag",
          "uniform float strength; //@ 0 [0, 1]\n"
          "uniform sampler2D trail; //@ pass mainTrail\n"
          "void mainTrail(out vec4 c, in vec2 p) { c = vec4(0.25); }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    vec4 t = texelFetch(trail, ivec2(p), 0);\n"
          "    //@ assert t.x > 0.5\n"
          "    c = vec4(0.5) + strength * t;\n}\n");
    const Outcome told = glint({"probe", "off.frag", "--size", "8x4", "--line", "5"});
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_NE(told.out.find("t = (0.25, 0.25, 0.25, 0.25)"), std::string::npos) << told.out;
    EXPECT_EQ(glint({"probe", "off.frag", "--size", "8x4", "--faults"}).code, 0);
    EXPECT_EQ(glint({"probe", "off.frag", "--size", "8x4", "--line", "5", "--map", "m.png"}).code,
              0);
    const Outcome still = glint({"still", "off.frag", "-o", "x.png", "--size", "8x4"});
    EXPECT_NE(still.err.find("assert t.x > 0.5 does not hold in 32 pixels of image"),
              std::string::npos)
        << still.err;
    EXPECT_EQ(glint({"check", "off.frag", "--case", "rounding"}).code, 0);
}

TEST_F(ProbeVerb, OfASimulationTellsStepsThatItTakes) {
    write("steps.frag",
          "uniform sampler2D s; //@ pass mainS size=1x1 step=1\n"
          "void mainS(out vec4 c, in vec2 p) {\n"
          "    c = texelFetch(s, ivec2(0), 0) + vec4(1, 0, 0, 0);\n"
          "    c.y = iTime;\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(s, ivec2(0), 0) * 0.1; }\n");
    const auto at = [&](const char* frame) {
        return glint({"probe", "steps.frag", "--pass", "s", "--at", "0,0", "--frame", frame});
    };
    const Outcome between = at("121");
    EXPECT_NE(between.out.find("c.y = 2\n"), std::string::npos) << between.out;
    EXPECT_NE(between.err.find("takes no step in frame 121; shown is frame 120"), std::string::npos)
        << between.err;
    const Outcome before = at("30");
    EXPECT_NE(before.code, 0);
    EXPECT_NE(before.err.find("has taken no step by frame 30"), std::string::npos) << before.err;
}

TEST_F(ProbeVerb, SaysWhatCannotBeAsked) {
    expect_usage({"--at", "8,0"}, "from 0,0 at the bottom left to 7,3");
    expect_usage({"--at", "3"}, "write X,Y");
    expect_usage({"--pass", "sun"}, "no pass 'sun'");
    expect_usage({"--line", "12"}, "scene.frag:12:5: error: In pass image, this line gives no");
    expect_usage({"--line", "99"}, "no line 99");
    expect_usage({"--expr", "nobody@10"}, "scene.frag:10:5: error: --expr 'nobody': ");
    expect_usage({"--expr", "float[2](a, b)@10"}, "--expr 'float[2](a, b)': it is of a type");
    expect_usage({"--expr", "a = 1.0@10"}, "it would change a variable");
    expect_usage({"--expr", "a"}, "its line");
    expect_usage({"--hit", "1"}, "name it by --line or --expr");
    expect_usage({"--line", "10", "--expr", "a@10"}, "not both");
    expect_usage({"--face", "2"}, "pass image fills no cube");
}

// It would count on with each look.
TEST_F(ProbeVerb, AsksNothingThatWouldChangeTheText) {
    write("count.frag",
          "int count = 0;\n"
          "float next() { ++count; return float(count); }\n"
          "float two() { return next() + next(); }\n"
          "void add(inout float x) { x += 1.0; }\n"
          "float same(float x) { float y = x; y *= 1.0; return y; }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float a = next();\n"
          "    c = vec4(a);\n}\n");
    const auto asked = [&](const char* expression) {
        return glint({"probe", "count.frag", "--size", "8x4", "--expr", expression});
    };
    for (const char* expression : {"next()@8", "two()@8", "add(a)@8"}) {
        const Outcome outcome = asked(expression);
        EXPECT_EQ(outcome.code, 2) << expression;
        EXPECT_NE(outcome.err.find("would change a variable"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(asked("same(a)@8").code, 0);
}

TEST_F(ProbeVerb, KnowsTheNamesOfATextWithAMainOfItsOwn) {
    write("own.frag",
          "#version 150\n"
          "layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;\n"
          "uniform vec2 resolution;\n"
          "vec2 first = gl_FragCoord.xy;\n"
          "float count = 0.0;\nfloat next() { count += 0.25; return count; }\n"
          "float begun = next(); float twice() { return next() + next(); }\n"
          "void main() {\n"
          "    float more = next();\n"
          "    gl_FragColor = vec4(first / resolution, more, 1.0);\n}\n");
    const auto value = [&](const char* expression) {
        return report_of(glint({"probe", "own.frag", "--size", "8x4", "--at", "3,1", "--json",
                                "--expr", expression}),
                         0)["values"][0]["value"];
    };
    EXPECT_EQ(value("gl_FragCoord.xy@10"), Json({3.0, 2.0})) << "from above, at corners";
    EXPECT_EQ(value("first@10"), Json({3.0, 2.0}));
    EXPECT_EQ(value("gl_FragColor@10"), Json({0.375, 0.5, 0.5, 1.0}));
    EXPECT_EQ(value("more@9"), Json({0.5})) << "what globals begin with is none of its calls";
    const Outcome calls = glint({"probe", "own.frag", "--size", "8x4", "--expr", "twice()@9"});
    EXPECT_EQ(calls.code, 2);
    EXPECT_NE(calls.err.find("next would change a variable"), std::string::npos) << calls.err;
}

TEST_F(ProbeVerb, KnowsTheHostsNamesThoughTheTextHasNoneOfThem) {
    for (const char* name : {"iTick", "iTime", "iDate.w", "iFrame", "iGlobalTime"}) {
        write("scene.frag",
              "void mainImage(out vec4 c, in vec2 p) {\n"
              "    float t = 1.0;\n"
              "    c = vec4(t);\n}\n");
        const Json told = json({"--frame", "60", "--expr", fmt::format("float({})@2", name)});
        EXPECT_EQ(told["values"].size(), 1u) << name << told;
    }
}

TEST_F(ProbeVerb, SaysThatThereAreFewerHits) {
    const Outcome outcome = probe({"--line", "3", "--hit", "99"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("there is no hit 99 at this pixel, but 2"), std::string::npos)
        << outcome.err;
}

TEST_F(ProbeVerb, StillNamesEachAssertionThatFailsAndReadsItsPresetOnce) {
    write("asserts.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    //@ assert p.x > 1.0 \"far\"\n"
          "    //@ assert p.x > 2.0\n"
          "    //@ assert nobody\n"
          "    //@ assert p.x\n"
          "    c = vec4(1);\n"
          "}\n");
    write("asserts.toml", "scene = \"asserts.frag\"\nunknown = 1\n");
    const Outcome still = glint({"still", "asserts.toml", "-o", "a.png", "--size", "4x2"});
    EXPECT_EQ(still.code, 0);
    for (const char* words :
         {"asserts.frag:2:5: warning: assert p.x > 1.0 \"far\" does not hold in 2 pixels of image",
          "asserts.frag:3:5: warning: assert p.x > 2.0 does not hold in 4 pixels of image",
          "asserts.frag:4:5: warning: assert nobody cannot be evaluated",
          "asserts.frag:5:5: warning: assert p.x cannot be evaluated, and was not: 'p.x': it is "
          "neither"})
        EXPECT_NE(still.err.find(words), std::string::npos) << still.err;
    const std::size_t once = still.err.find("unknown");
    EXPECT_NE(once, std::string::npos);
    EXPECT_EQ(still.err.find("asserts.toml:2", still.err.find("asserts.toml:2") + 1),
              std::string::npos)
        << still.err;
}

}  // namespace
}  // namespace glint::cli::probe_verb_test
