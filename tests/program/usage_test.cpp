// A command line that makes no sense: exit code 2, one sentence, and no picture.
#include "command.h"

namespace glint::cli {
namespace {

using Words = std::vector<std::string>;

class Usage : public InAFolder {
protected:
    Usage() {
        write(
            "scene.frag",
            "uniform float a; //@ 0.5 [0, 1]\n"
            "uniform sampler2D waves; //@ pass mainWaves\n"
            "void mainWaves(out vec4 c, in vec2 p) { c = vec4(1); }\n"
            "void mainImage(out vec4 c, in vec2 p) { c = a * texelFetch(waves, ivec2(p), 0); }\n");
    }
};

TEST_F(Usage, IsRefusedWithASentenceThatNamesTheOption) {
    const std::pair<Words, std::string_view> cases[] = {
        {{}, "error: "},
        {{"still"}, "error: "},
        {{"still", "scene.frag"}, "--output"},
        {{"still", "-o", "out.png"}, "file"},
        {{"still", "scene.frag", "-o", "out.png", "--bogus"}, "--bogus"},
        {{"still", "scene.frag", "scene.frag", "-o", "out.png"}, "scene.frag"},
        {{"still", "scene.frag", "-o"}, "--output"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "0x5"}, "--size 0x5"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "5x0"}, "--size 5x0"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "-5x5"}, "--size"},
        {{"still", "scene.frag", "-o", "out.png", "--size=-5x5"}, "--size -5x5"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "5"}, "--size 5"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "5x"}, "--size 5x"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "5x5x5"}, "--size 5x5x5"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "99999999999x1"},
         "--size 99999999999x1"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak"}, "--tweak"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "a"}, "write a=VALUE"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "a="}, "write a=VALUE"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "a=b"}, "write a=VALUE"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "a=nan"}, "write a=VALUE"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "=1"}, "it has a"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", ""}, "it has a"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "b=1"}, "it has a"},
        {{"still", "scene.frag", "-o", "out.png", "--pass", "wave"}, "it has image, waves"},
        {{"still", "scene.frag", "-o", "out.png", "--samples", "4", "--pass", "waves"},
         "--samples"},
        {{"still", "scene.frag", "-o", "out.png", "--samples", "0"}, "--samples"},
        {{"still", "scene.frag", "-o", "out.png", "--time", "-1"}, "--time"},
        {{"still", "scene.frag", "-o", "out.png", "--time", "nan"}, "--time"},
        {{"still", "scene.frag", "-o", "out.png", "--time", "inf"}, "--time"},
        {{"still", "scene.frag", "-o", "out.png", "--time", "soon"}, "--time"},
        {{"still", "scene.frag", "-o", "out.png", "--frame", "-1"}, "--frame"},
        {{"still", "scene.frag", "-o", "out.png", "--frame", "1.5"}, "--frame"},
        {{"still", "scene.frag", "-o", "out.png", "--frame", "99999999999"}, "--frame"},
        {{"still", "scene.frag", "-o", "out.png", "--fps", "0"}, "--fps"},
        {{"still", "scene.frag", "-o", "out.png", "--fps", "nan"}, "--fps"},
        {{"still", "scene.frag", "-o", "out.png", "--tile", "0"}, "--tile"},
        {{"still", "scene.frag", "-o", "out.png", "--settle", "-1"}, "--settle"},
        {{"still", "scene.frag", "-o", "out.png", "--time", "1", "--frame", "60"},
         "either --time or --frame"},
        {{"bench", "scene.frag", "--frames", "0"}, "--frames"},
        {{"bench", "scene.frag", "--compare", "--no-specialise"}, "--no-specialise"},
        {{"info", "scene.frag", "--source", "wave"}, "it has image, waves"},
        {{"stil", "scene.frag", "-o", "out.png"}, "did you mean 'still'?"},
        {{"--bogus"}, "--help"},
    };
    const auto before = names();
    for (const auto& [arguments, part] : cases) {
        std::string line = "glint";
        for (const std::string& word : arguments) line += " " + word;
        SCOPED_TRACE(line);
        const Outcome outcome = glint(arguments);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(outcome.err.starts_with("error: ")) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(names(), before);
}

TEST_F(Usage, ASizeBeyondTheDriversLimitIsAMessageAndNotACrash) {
    const std::pair<std::string, std::string> cases[] = {
        {"99999x1", "99999x1 pixels; this driver draws up to"},
        {"1x99999", "1x99999 pixels; this driver draws up to"},
        {"2147483647x2147483647", "a side may be 1 to 1000000"}};
    for (const auto& [size, words] : cases) {
        SCOPED_TRACE(size);
        const Outcome outcome = glint({"still", "scene.frag", "-o", "out.png", "--size", size});
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_EQ(names(), std::set<std::string>{"scene.frag"});
    }
}

TEST_F(Usage, AValueBeyondItsRangeIsClampedWithAWarning) {
    const Outcome outcome =
        glint({"still", "scene.frag", "-o", "out.png", "--size", "8x8", "--tweak", "a=7"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "warning: --tweak a=7: outside its range, taken as 1\n");
}

TEST_F(Usage, HelpAndVersionAreResults) {
    for (const Words& arguments : std::vector<Words>{
             {"--help"}, {"still", "--help"}, {"info", "-h"}, {"bench", "--help"}, {"--version"}}) {
        SCOPED_TRACE(arguments[0]);
        const Outcome outcome = glint(arguments);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_NE(outcome.out, "");
        EXPECT_EQ(outcome.err, "");
    }
}

TEST_F(Usage, WithoutADriverItSaysWhatToInstall) {
    const std::vector<std::pair<std::string, std::string>> environments[] = {
        {{"LIBGL_DRIVERS_PATH", "/nowhere"}},
        {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere"}},
        {{"LIBGL_DRIVERS_PATH", "/nowhere"}, {"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere"}},
    };
    for (const auto& environment : environments) {
        for (const Words& verb : std::vector<Words>{{"still", "scene.frag", "-o", "out.png"},
                                                    {"info", "scene.frag"},
                                                    {"bench", "scene.frag"}}) {
            SCOPED_TRACE(environment[0].first + " " + verb[0]);
            Command command = this->command(verb);
            command.environment = environment;
            const Outcome outcome = run(command);
            EXPECT_EQ(outcome.code, 5);
            EXPECT_EQ(outcome.out, "");
            EXPECT_NE(outcome.err.find("error: No OpenGL 4.5 context; install a GL driver"),
                      std::string::npos)
                << outcome.err;
        }
    }
    EXPECT_EQ(names(), std::set<std::string>{"scene.frag"});
}

TEST_F(Usage, AnUnknownDeviceIsToldWithThoseThatThereAre) {
    for (const std::string device : {"GeForce 9999", "99"}) {
        const Outcome outcome = glint({"still", "scene.frag", "-o", "out.png", "--device", device});
        EXPECT_EQ(outcome.code, 5);
        EXPECT_NE(outcome.err.find("on device '" + device + "'"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("surfaceless: not asked for"), std::string::npos) << outcome.err;
    }
    still({"scene.frag", "-o", "out.png", "--device", "surfaceless"});
}

}  // namespace
}  // namespace glint::cli
