// `[expect]` of a preset as a case of `glint check`, and its report for pipelines.
#include "report.h"

#include <cstdlib>

namespace glint::cli {
namespace {

using Json = nlohmann::json;

// A simulation that has to be played, with a value that shows.
constexpr const char* kScene =
    "uniform float level; //@ 0.4 [0, 1]\n"
    "uniform sampler2D sums; //@ pass mainSums\n"
    "void mainSums(out vec4 c, in vec2 p) {\n"
    "    c = texelFetch(sums, ivec2(p), 0) + vec4(0.01, 0, 0, 0);\n"
    "}\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    c = vec4(texelFetch(sums, ivec2(p), 0).r, p.x / iResolution.x, level, 1);\n"
    "}\n";

class CheckExpect : public InAFolder {
protected:
    CheckExpect() {
        write("s.frag", kScene);
        preset("");
        still({"look.toml", "-o", "look.png", "--size", "40x30"});
    }

    // A preset whose picture is look.png, with this below [expect].
    void preset(const std::string& expect, const std::string& tweaks = "") {
        write("look.toml", "scene = \"s.frag\"\ntime = 0.5\nsettle = 3\n[tweaks]\n" + tweaks +
                               "[expect]\npicture = \"look.png\"\n" + expect);
    }

    Json check(int code, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"check", "look.toml", "--case", "expected", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Json json = report_of(glint(std::move(arguments)), code);
        EXPECT_EQ(json["cases"].size(), 1u);
        EXPECT_EQ(json["cases"][0]["case"], "expected picture");
        return json["cases"][0];
    }
};

TEST_F(CheckExpect, ThePictureOfTheStillIsWhatIsExpected) {
    EXPECT_EQ(check(0)["note"], "RMSE 0, FLIP 0") << "at its own size, played and settled";
    still({"look.toml", "-o", "look.exr", "--size", "40x30"});
    write("look.toml",
          "scene = \"s.frag\"\ntime = 0.5\nsettle = 3\n[expect]\npicture = "
          "\"look.exr\"\n");
    EXPECT_EQ(check(0)["note"], "RMSE 0, FLIP 0") << "floats";
    EXPECT_FALSE(fs::exists(folder() / "glint-check"));
}

TEST_F(CheckExpect, AnotherPictureFailsWithAllThatIsLookedAt) {
    preset("", "level = 0.5\n");
    const Json found = check(6, {"-o", "failures"});
    EXPECT_EQ(found["verdict"], "fail");
    const std::string note = found["note"];
    EXPECT_NE(note.find("without rmse and flip it shall be the same"), std::string::npos) << note;
    EXPECT_EQ(found["reproduce"], "glint check look.toml --case 'expected picture'");
    for (const char* kind : {"", "-expected", "-difference", "-flip"}) {
        const std::string name = "failures/look-expected-picture" + std::string(kind) + ".png";
        EXPECT_TRUE(fs::exists(folder() / name)) << name;
    }
    EXPECT_EQ(found["picture"], "failures/look-expected-picture.png");
    // The pixels of what was drawn, and of what was expected.
    EXPECT_NE(bytes("failures/look-expected-picture.png"),
              bytes("failures/look-expected-picture-expected.png"));
}

// Blue of 0.4 and 0.5 are 0.133 and 0.214 in light, so that one channel of three is 0.081 off: an
// RMSE of 0.047, or 0.048 from the bytes 102 and 128.
TEST_F(CheckExpect, BoundsAreHeldOneByOne) {
    const std::string other = "level = 0.5\n";
    preset("rmse = 0.05\nflip = 1\n", other);
    EXPECT_EQ(check(0)["verdict"], "pass");
    preset("rmse = 0.045\n", other);
    EXPECT_NE(check(6)["note"].get<std::string>().find(", 0.045 is expected at most"),
              std::string::npos);
    preset("flip = 0.01\n", other);
    const std::string note = check(6)["note"];
    EXPECT_EQ(note.find("RMSE"), std::string::npos) << note;
    EXPECT_NE(note.find("0.01 is expected at most"), std::string::npos) << note;
    preset("flip = 0.5\n", other);
    EXPECT_EQ(check(0)["verdict"], "pass");
}

TEST_F(CheckExpect, AnotherLookIsNotHeldAgainstIt) {
    EXPECT_EQ(check(0, {"--tweak", "level=1"})["verdict"], "skip");
}

TEST_F(CheckExpect, APictureThatIsMissingIsAFailureThatSaysHowToWriteIt) {
    fs::remove(folder() / "look.png");
    const std::string note = check(6)["note"];
    EXPECT_NE(note.find("look.png"), std::string::npos) << note;
    EXPECT_NE(note.find("glint still look.toml -o look.png"), std::string::npos) << note;
}

// A hundred loops of work beside one: no load of the machine, which meets both, makes that 2.
TEST_F(CheckExpect, ALookIsHeldToTheTimeOfAnother) {
    write("work.frag",
          "uniform int turns; //@ 1 [1, 500]\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float s = p.x;\n"
          "    for (int i = 0; i < turns; ++i) s = sin(s + p.y);\n"
          "    c = vec4(s);\n"
          "}\n");
    write("calm.toml", "scene = \"work.frag\"\n");
    const auto expect = [&](const char* most) {
        write("look.toml",
              "scene = \"work.frag\"\n[tweaks]\nturns = 400\n[expect]\nms_ratio = { "
              "of = \"calm.toml\", most = " +
                  std::string(most) + " }\n");
        return glint(
            {"check", "look.toml", "--case", "expected time", "--size", "160x90", "--json"});
    };
    const Json slow = report_of(expect("2"), 6)["cases"][0];
    EXPECT_EQ(slow["case"], "expected time");
    EXPECT_FALSE(slow.contains("picture")) << "there is none to see";
    const std::string note = slow["note"];
    EXPECT_NE(note.find("of the time of calm.toml"), std::string::npos) << note;
    EXPECT_NE(note.find("2 is expected at most"), std::string::npos) << note;
    EXPECT_EQ(report_of(expect("1000"))["cases"][0]["verdict"], "pass");
    fs::remove(folder() / "calm.toml");
    const Outcome gone = expect("2");
    EXPECT_EQ(gone.code, 6);
    EXPECT_NE(gone.out.find("there is no calm.toml"), std::string::npos) << gone.out;
}

// Python's own parser takes it, and finds each case as it was.
// However many processes share its cases.
TEST_F(CheckExpect, WhatAPresetWarnsOfIsToldOnce) {
    write("s.frag", kGradient);
    write("s.toml",
          "scene = \"s.frag\"\nfoo = 1\n[expect]\nms_ratio = { of = \"s.frag\", most = 9 }\n");
    const Outcome outcome = glint({"check", "s.toml", "--size", "16x9"});
    const std::size_t first = outcome.err.find("unknown key 'foo'");
    EXPECT_NE(first, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("unknown key 'foo'", first + 1), std::string::npos) << outcome.err;
}

TEST_F(CheckExpect, JUnitIsReadByOthers) {
    write("<a & 'b'>.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.0 / 0.0); }\n");
    write("wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    const Outcome outcome =
        glint({"check", "look.toml", "<a & 'b'>.frag", "wrong.frag", "--seconds", "1", "--random",
               "0", "--inject", "0", "--frames", "5", "--junit", "check.xml"});
    EXPECT_EQ(outcome.code, 3) << outcome.out;
    write("read.py",
          "import json, xml.etree.ElementTree as xml\n"
          "root = xml.parse('check.xml').getroot()\n"
          "assert root.tag == 'testsuites'\n"
          "suites = {}\n"
          "for suite in root:\n"
          "    cases = suite.findall('testcase')\n"
          "    count = lambda kind: sum(c.find(kind) is not None for c in cases)\n"
          "    assert int(suite.get('tests')) == len(cases)\n"
          "    assert int(suite.get('failures')) == count('failure')\n"
          "    assert int(suite.get('errors')) == count('error')\n"
          "    assert int(suite.get('skipped')) == count('skipped')\n"
          "    assert all(c.get('classname') == suite.get('name') for c in cases)\n"
          "    suites[suite.get('name')] = [count(k) for k in ('failure', 'error')]\n"
          "    for c in cases:\n"
          "        if c.find('failure') is not None: assert 'again: glint' in "
          "c.find('failure').text\n"
          "assert sum(int(s.get('tests')) for s in root) == int(root.get('tests'))\n"
          "assert suites['look.toml'][1] == 0, suites\n"
          "assert suites[\"<a & 'b'>.frag\"][0] > 0, suites\n"
          "assert suites['wrong.frag'] == [0, 1], suites\n");
    const std::string command = "cd '" + folder().string() + "' && python3 read.py";
    EXPECT_EQ(std::system(command.c_str()), 0) << bytes("check.xml");
}

// What is shipped looks as it says, and a look that is off by three bounces or a shadow is told.
TEST_F(CheckExpect, AShippedPresetIsHeldToItsPicture) {
    const fs::path shipped = fs::path(GLINT_REPOSITORY) / "presets/analytic.toml";
    const Outcome outcome =
        glint({"check", shipped.string(), "--case", "expected", "--junit", "check.xml"});
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    const std::string cases = bytes("check.xml");
    EXPECT_NE(cases.find("name=\"expected picture\""), std::string::npos) << cases;
    EXPECT_NE(cases.find("tests=\"1\" failures=\"0\""), std::string::npos) << cases;
    for (const char* tweak : {"bounces = 3\n", "shadows = false\n"}) {
        std::string text = bytes_of(shipped);
        const auto put = [&](const std::string& before, const std::string& after) {
            ASSERT_NE(text.find(before), std::string::npos) << before;
            text.replace(text.find(before), before.size(), after);
        };
        put("../", std::string(GLINT_REPOSITORY) + "/");
        put("expected/", std::string(GLINT_REPOSITORY) + "/presets/expected/");
        put("[tweaks]\n", std::string("[tweaks]\n") + tweak);
        write("off.toml", text);
        EXPECT_EQ(glint({"check", "off.toml", "--case", "expected"}).code, 6) << tweak;
    }
}

TEST_F(CheckExpect, AReportNeverStandsInAScenesPlace) {
    EXPECT_EQ(glint({"check", "look.toml", "--junit", "s.frag"}).code, 2);
    EXPECT_EQ(bytes("s.frag"), kScene);
    write("file", "");
    EXPECT_EQ(glint({"check", "look.toml", "--junit", "file/check.xml"}).code, 1);
}

TEST_F(CheckExpect, NothingIsWrittenInThePlaceOfWhatIsExpected) {
    write("other.frag", kScene);
    preset("ms_ratio = { of = \"other.frag\", most = 1000 }\n");
    const std::string expected = bytes("look.png");
    EXPECT_EQ(glint({"check", "look.toml", "--junit", "look.png"}).code, 2);
    EXPECT_EQ(glint({"check", "look.toml", "--junit", "other.frag"}).code, 2);
    EXPECT_EQ(glint({"probe", "look.toml", "--map", "look.png", "--expr", "p@6"}).code, 2);
    EXPECT_EQ(bytes("look.png"), expected);
    EXPECT_EQ(bytes("other.frag"), kScene);
    // By the pictures of a failure itself, after which there would be none.
    fs::create_directory(folder() / "glint-check");
    fs::rename(folder() / "look.png", folder() / "glint-check/look-expected-picture.png");
    write("look.toml",
          "scene = \"s.frag\"\n[tweaks]\nlevel = 0.5\n[expect]\npicture = "
          "\"glint-check/look-expected-picture.png\"\n");
    const Outcome refused = glint({"check", "look.toml", "--case", "expected"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("keep it in another folder"), std::string::npos) << refused.err;
    EXPECT_EQ(bytes("glint-check/look-expected-picture.png"), expected);
    EXPECT_EQ(glint({"check", "look.toml", "--case", "expected", "-o", "failures"}).code, 6);
}

}  // namespace
}  // namespace glint::cli
