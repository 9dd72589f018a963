// Files of one call that are one file: refused before anything is drawn, and nothing is replaced.
#include "command.h"

#include <iterator>
#include <sstream>

namespace glint::cli::named_files_test {
namespace {

class NamedFiles : public InAFolder {
protected:
    NamedFiles() {
        write("s.frag",
              "uniform sampler2D wood; //@ image \"wood.png\"\n"
              "vec2 mainSound(int samp, float time) { return vec2(0.5); }\n"
              "void mainImage(out vec4 c, in vec2 p) { c = texture(wood, p); }\n");
        write("plain.frag", kGradient);
        still({"plain.frag", "-o", "wood.png", "--size", "8x8"});
    }

    // Each call is a line of words.
    Outcome call(const std::string& line) const {
        std::istringstream words(line);
        std::vector<std::string> list{std::istream_iterator<std::string>(words), {}};
        return glint(std::move(list));
    }

    void expect_refused(const std::string& line) const {
        SCOPED_TRACE(line);
        const auto before = names();
        const Outcome outcome = call(line);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_TRUE(outcome.err.find(" one file; give them names of their own.") !=
                        std::string::npos ||
                    outcome.err.find("; name another file.") != std::string::npos)
            << outcome.err;
        EXPECT_EQ(names(), before);
    }
};

TEST_F(NamedFiles, APictureAndAStateOfOneNameAreRefused) {
    write("old.exr", "precious");
    fs::create_symlink("old.exr", folder() / "soft.exr");
    fs::create_hard_link(folder() / "old.exr", folder() / "hard.exr");
    fs::create_directory_symlink(".", folder() / "here");
    for (const std::string line : {
             "still plain.frag --size 8x8 -o a.exr --save-state a.exr",
             "still plain.frag --size 8x8 -o a.exr --save-state ./a.exr",
             "still plain.frag --size 8x8 -o here/a.exr --save-state a.exr",
             "still plain.frag --size 8x8 -o old.exr --save-state soft.exr",
             "still plain.frag --size 8x8 -o old.exr --save-state hard.exr",
             "still plain.frag --size 8x8 -o a12.exr --save-state a%d.exr",
             "still plain.frag --size 8x8 -o old.exr --from-state soft.exr",
             "sequence plain.frag --size 8x8 --frames 0:2 -o a%d.exr --save-state a%d.exr",
             "sequence plain.frag --size 8x8 --frames 0:2 -o a%d.exr --save-state ./a1%d.exr",
             "sequence plain.frag --size 8x8 --frames 0:2 -o a%d.exr --save-state a2.exr",
             "sequence plain.frag --size 8x8 --frames 0:2 -o a.mp4 --save-state a.mp4",
             "sequence plain.frag --size 8x8 --frames 0:2 --from-state old.exr "
             "--save-state hard.exr",
         }) {
        expect_refused(line);
    }
    EXPECT_EQ(bytes("old.exr"), "precious");
}

TEST_F(NamedFiles, WhatIsReadIsNotWrittenOver) {
    const std::string wood = bytes("wood.png");
    fs::create_hard_link(folder() / "wood.png", folder() / "hard.png");
    fs::create_symlink("wood.png", folder() / "link1.png");
    write("image.glsl", kGradient);
    write("tune.frag",
          "uniform sampler2D tune; //@ sound \"tune.wav\"\n"
          "vec2 mainSound(int samp, float time) { return texture(tune, vec2(0)).xy; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(tune, p); }\n");
    write("tune.wav", "precious");
    write("look.toml", "scene = \"s.frag\"\n");
    for (const std::string line : {
             "still s.frag --size 8x8 -o wood.png",
             "still look.toml --size 8x8 -o ./wood.png",
             "still s.frag --size 8x8 -o hard.png",
             "still s.frag --size 8x8 -o link1.png",
             "still s.frag --size 8x8 -o a.png --save-state s.frag",
             "still look.toml --size 8x8 -o a.png --save-state look.toml",
             "sequence s.frag --size 8x8 --frames 0:2 -o link%d.png",
             "sound tune.frag --seconds 1 -o tune.wav",
             "probe s.frag --size 8x8 --expr p.x@3 --map wood.png",
             "probe s.frag --size 8x8 --cost --map wood.png",
             "export image.glsl -o .",
         }) {
        expect_refused(line);
    }
    EXPECT_EQ(bytes("wood.png"), wood);
    EXPECT_EQ(bytes("image.glsl"), kGradient);
    EXPECT_EQ(bytes("tune.wav"), "precious");
    write("study.json", R"({"renderpass":[{"type":"image","name":"Image","code":")"
                        R"(void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }"}]})");
    expect_refused("study study.json -o .");
}

TEST_F(NamedFiles, AReportReplacesItsOwnFilesAndNoOther) {
    write("knob.frag",
          "uniform int knob; //@ 1 [1, 4] quality reference=4\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0 / float(knob)); }\n");
    write("page/index.html", "precious");
    write("table/study.csv", "precious");
    write("data/study.json", "{\"mine\": 1}");
    write("looks/b.png", "precious");
    for (const std::string line : {"study knob.frag --size 8x8 --seconds 0 -o page",
                                   "study knob.frag --size 8x8 --seconds 0 -o table",
                                   "study knob.frag --size 8x8 --seconds 0 -o data",
                                   "study knob.frag s.frag --size 8x8 --seconds 0 -o looks"}) {
        const Outcome outcome = call(line);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find("which is of no report of this kind; name another folder."),
                  std::string::npos)
            << outcome.err;
    }
    EXPECT_EQ(bytes("page/index.html"), "precious");
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(call("study knob.frag --size 8x8 --seconds 0 -o own").code, 0);
        EXPECT_EQ(call("study knob.frag s.frag --size 8x8 --seconds 0 -o both").code, 0);
        EXPECT_EQ(call("check plain.frag --size 8x8 --case odd --junit tests.xml").code, 0);
    }
    EXPECT_EQ(call("check plain.frag --size 8x8 --junit knob.frag").code, 2);
    EXPECT_EQ(bytes("knob.frag").find("xml"), std::string::npos);
}

TEST_F(NamedFiles, NamesThatNeverMeetAreTaken) {
    for (const std::string line : {
             "still s.frag --size 8x8 -o a.exr --save-state b.exr",
             "still plain.frag --size 8x8 -o wood2.png",
             "sequence plain.frag --size 8x8 --frames 0:2 -o a%d.exr --save-state a3.exr",
             "sequence plain.frag --size 8x8 --frames 0:2 -o a%d.exr --save-state s%d.exr",
             "sequence plain.frag --size 8x8 --frames 1:2 --from-state s2.exr "
             "--save-state s%d.exr",
         }) {
        SCOPED_TRACE(line);
        const Outcome outcome = call(line);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
}

}  // namespace
}  // namespace glint::cli::named_files_test
