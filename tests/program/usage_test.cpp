// A command line that makes no sense: exit code 2, one sentence, and no picture.
#include "command.h"

#include <sstream>

namespace glint::cli::usage_test {
namespace {

using Words = std::vector<std::string>;

class Usage : public InAFolder {
protected:
    Usage() {
        write(
            "scene.frag",
            "uniform float a; //@ 0.5 [0, 1]\n"
            "uniform int wide; //@ 0 {off, traced} quality\n"
            "uniform sampler2D waves; //@ pass mainWaves\n"
            "void mainWaves(out vec4 c, in vec2 p) { c = vec4(1); }\n"
            "void mainImage(out vec4 c, in vec2 p) { c = a * texelFetch(waves, ivec2(p), 0); }\n");
    }
};

TEST_F(Usage, IsRefusedWithASentenceThatNamesTheOption) {
    const std::pair<Words, std::string_view> cases[] = {
        {{"still"}, "error: "},
        {{"render", "scene.frag"}, "There is no verb 'render'; `glint --help` lists those"},
        {{"scene.frag", "-o", "out.png"}, "`glint still scene.frag -o picture.png` writes a pict"},
        {{"-x", "scene.frag"}, "There is no option -x here; `glint --help` lists"},
        {{"still", "scene.frag"}, "--output"},
        {{"still", "-o", "out.png"}, "file"},
        {{"still", "scene.frag", "-o", "out.png", "--bogus"}, "--bogus"},
        {{"still", "scene.frag", "-o", "out.png", "--siz", "8x8"}, "did you mean '--size'?"},
        {{"still", "--siz=8x8", "scene.frag", "-o", "out.png"}, "did you mean '--size'?"},
        {{"still", "scene.frag", "--outptu", "out.png"}, "did you mean '--output'?"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "wdie=1"}, "did you mean 'wide'?"},
        {{"still", "scene.frag", "-o", "out.png", "--tweak", "wide=tracd"},
         "off, traced or an index from 0 to 1; did you mean 'traced'?"},
        {{"still", "scene.frag", "-o", "out.png", "--pass", "wvaes"}, "did you mean 'waves'?"},
        {{"study", "scene.frag", "--vary", "wdie"}, "did you mean 'wide'?"},
        {{"study", "scene.frag", "--vary", "wide=tracd"}, "did you mean 'traced'?"},
        {{"study", "scene.frag", "--vary", "wide", "--reference", "wdie=1"},
         "did you mean 'wide'?"},
        {{"study", "scene.frag", "--metric", "tmie"}, "did you mean 'time'?"},
        {{"new", "other", "--from", "raymach"}, "did you mean 'raymarch'?"},
        {{"still", "scene.frag", "scene.frag", "-o", "out.png"}, "scene.frag"},
        {{"still", "scene.frag", "-o"}, "--output"},
        {{"still", "scene.frag", "-o", "out.png", "--quality", ""}, "--quality: it has an empty"},
        {{"check", "scene.frag", "--junit", ""}, "--junit: it has an empty value"},
        {{"sequence", "scene.frag", "-o", "%d.png", "--shard", ""}, "--shard: it has an empty"},
        {{"sequence", "scene.frag", "-o", "%d.png", "--save-state", ""}, "--save-state: it has"},
        {{"sequence", "scene.frag", "-o", "%d.png", "--frames", ""}, "--frames: it has an empty"},
        {{"still", "scene.frag", "-o", "out.png", "--size", ""}, "--size: it has an empty value"},
        {{"still", "", "-o", "out.png"}, "file: it has an empty value"},
        {{"still", "scene.frag", "-o", ""}, "--output: it has an empty value"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "0x5"}, "--size 0x5"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "5x0"}, "--size 5x0"},
        {{"still", "scene.frag", "-o", "out.png", "--size", "-5x5"}, "--size"},
        {{"still", "scene.frag", "-o", "out.png", "--size="}, "--size= has no value"},
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
        {{"--hepl"}, "did you mean '--help'?"},
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
    for (const Words& arguments : std::vector<Words>{{"--help"},
                                                     {"still", "--help"},
                                                     {"info", "-h"},
                                                     {"bench", "--help"},
                                                     {"--version"},
                                                     {"version"},
                                                     {"help"},
                                                     {"help", "still"}}) {
        SCOPED_TRACE(arguments[0]);
        const Outcome outcome = glint(arguments);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_NE(outcome.out, "");
        EXPECT_EQ(outcome.err, "");
    }
}

TEST_F(Usage, AMistypedFileEndsWith4AndTheNearestName) {
    write("fragments/rings.frag", kGradient);
    const std::pair<Words, std::string_view> cases[] = {
        {{"still", "scnee.frag", "-o", "out.png"}, "did you mean 'scene.frag'?"},
        {{"info", "scene.fra"}, "did you mean 'scene.frag'?"},
        {{"scene"}, "did you mean 'scene.frag'?"},
        {{"open", "ring.frag"}, "cannot read 'ring.frag'"},
        {{"rings.frag"}, "did you mean 'fragments/rings.frag'?"},
        {{"check", "fragment/rings.frag"}, "did you mean 'fragments/rings.frag'?"},
        {{"import", "scene.jsn", "-o", "new.frag"}, "No such file"},
    };
    for (const auto& [arguments, part] : cases) {
        SCOPED_TRACE(arguments.back());
        const Outcome outcome = glint(arguments);
        EXPECT_EQ(outcome.code, 4);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    }
}

TEST_F(Usage, AMenuInAPresetIsToldTheNearestName) {
    write("look.toml", "scene = \"scene.frag\"\n[tweaks]\nwide = \"tracd\"\n");
    const Outcome outcome = glint({"info", "look.toml"});
    EXPECT_NE(outcome.err.find("did you mean 'traced'?"), std::string::npos) << outcome.err;
}

// The verbs that `glint --help` lists.
Words verbs_in(const std::string& help) {
    Words verbs;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    for (std::string line; std::getline(lines, line) && line.rfind("Examples", 0) != 0;)
        if (line.starts_with("  ") && line[2] != ' ')
            verbs.push_back(line.substr(2, line.find(' ', 2) - 2));
    return verbs;
}

TEST_F(Usage, EveryHelpHasExamplesWhoseOptionsItListsAndLeaksNoDefault) {
    const Words verbs = verbs_in(glint({"--help"}).out);
    ASSERT_GE(verbs.size(), 11u);
    for (const std::string& verb : verbs) {
        SCOPED_TRACE(verb);
        const std::string help = glint({verb, "--help"}).out;
        EXPECT_EQ(help.find('{'), std::string::npos) << help;
        const std::size_t examples = help.find("Examples:\n");
        ASSERT_NE(examples, std::string::npos) << help;
        std::istringstream words(help.substr(examples));
        std::string word;
        words >> word >> word;
        EXPECT_EQ(word, "glint");
        for (; words >> word && word != "|";) {
            const bool is_file = word.starts_with("presets/") || word.starts_with("fragments/");
            const bool is_option = word.starts_with("--");
            EXPECT_TRUE(!is_option || help.find("  " + word) < examples) << word;
            EXPECT_TRUE(!is_file || word.find('*') != word.npos ||
                        fs::exists(fs::path(GLINT_REPOSITORY) / word))
                << word;
        }
    }
}

TEST_F(Usage, AloneAndWithoutADisplayItNamesThreeCommandsThatWork) {
    Command alone = command({});
    alone.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
    const Outcome outcome = run(alone);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    std::istringstream lines(outcome.out);
    int commands = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("  ")) continue;
        ++commands;
        std::istringstream words(line);
        Words arguments;
        for (std::string word; words >> word;) arguments.push_back(word);
        EXPECT_TRUE(fs::exists(folder() / arguments[0])) << arguments[0];
        arguments.erase(arguments.begin());
        if (arguments[0] == "still") arguments.back() = "64x36";
        Command next = command(arguments);
        next.environment = alone.environment;
        EXPECT_EQ(run(next).code, 0) << line;
    }
    EXPECT_EQ(commands, 3) << outcome.out;
    EXPECT_TRUE(names().contains("rings.frag"));
}

TEST_F(Usage, WithoutADisplayNoPictureThatIsThereGoes) {
    write("rings.frag", kGradient);
    write("rings.png", "precious");
    Command open = command({"rings.frag", "--size", "64x36"});
    open.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
    for (const char* name : {"rings-0001.png", "rings-0002.png"}) {
        const Outcome outcome = run(open);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        EXPECT_TRUE(fs::exists(folder() / name));
    }
    EXPECT_EQ(bytes("rings.png"), "precious");
}

TEST_F(Usage, AFileWhoseNameLooksLikeAnOptionIsToldHowToBeNamed) {
    write("-dash.frag", kGradient);
    for (const std::vector<std::string>& words : {std::vector<std::string>{"-dash.frag"},
                                                  {"info", "-dash.frag"},
                                                  {"still", "-dash.frag", "-o", "a.png"}}) {
        const Outcome outcome = glint(words);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find("write ./-dash.frag"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(glint({"info", "./-dash.frag"}).code, 0);
}

// What such a call drew goes for what the next one draws; what a person had drawn stays.
TEST_F(Usage, WithoutADisplayAStillOfTheSameNameStays) {
    write("rings.frag", kGradient);
    Command open = command({"rings.frag", "--size", "64x36"});
    open.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
    still({"rings.frag", "-o", "rings.png", "--size", "80x45", "--samples", "4"});
    const std::string asked = bytes("rings.png");
    for (int i = 0; i < 2; ++i) {
        const Outcome outcome = run(open);
        EXPECT_NE(outcome.err.find("rings-0001.png"), std::string::npos) << outcome.err;
        fs::remove(folder() / "rings-0001.png");
    }
    EXPECT_EQ(bytes("rings.png"), asked);
    fs::remove(folder() / "rings.png");
    for (int i = 0; i < 2; ++i)
        EXPECT_NE(run(open).err.find("goes to rings.png"), std::string::npos);
    open.arguments.insert(open.arguments.end(), {"--tweak", "none=1"});
    const Outcome wrong = run(open);
    EXPECT_EQ(wrong.code, 2);
    EXPECT_EQ(wrong.err.find("goes to"), std::string::npos) << wrong.err;
}

TEST_F(Usage, AFolderWithoutADisplayIsToldWithAFileOfIts) {
    write("looks/rings.frag", kGradient);
    Command folder = command({"looks"});
    folder.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
    const Outcome outcome = run(folder);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.out.find("still looks/rings.frag -o "), std::string::npos) << outcome.out;
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
        EXPECT_NE(outcome.err.find("no device '" + device + "'"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(", surfaceless"), std::string::npos) << outcome.err;
    }
    still({"scene.frag", "-o", "out.png", "--device", "surfaceless"});
}

}  // namespace
}  // namespace glint::cli::usage_test
