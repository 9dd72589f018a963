// A picture that cannot be written: exit code 1, the cause, and everything stays as it was.
#include "command.h"

#include <nlohmann/json.hpp>

namespace glint::cli::broken_output_test {
namespace {

using Json = nlohmann::json;

// Hard to compress, so that its file is as large as its pixels.
constexpr std::string_view kNoise =
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    uvec3 v = uvec3(p, 1) * 1664525u + 1013904223u;\n"
    "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;\n"
    "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;\n"
    "    c = vec4(vec3(v >> 8u) / 16777216.0, 1);\n"
    "}\n";

class BrokenOutput : public InAFolder {
protected:
    BrokenOutput() {
        write("scene.frag", kGradient);
        write("noise.frag", kNoise);
    }

    void expect_refused(const Command& command, std::string_view cause) const {
        const auto before = names();
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(outcome.err.starts_with("error: Cannot write ")) << outcome.err;
        EXPECT_NE(outcome.err.find(cause), std::string::npos) << outcome.err;
        EXPECT_EQ(names(), before);
    }
};

TEST_F(BrokenOutput, TellsWhyThePlaceCannotBeWritten) {
    fs::create_directory(folder() / "folder.png");
    const std::pair<std::string, std::string_view> cases[] = {
        {"gone/out.png", "No such file or directory; make the folder gone first."},
        {"gone/out.tif", "No such file or directory"},
        {"scene.frag/out.png", "Not a directory"},
        {"folder.png", "Is a directory"},
        {"folder.png/", "Is a directory"},
        {std::string(300, 'x') + ".png", "File name too long"},
    };
    for (const auto& [output, cause] : cases) {
        SCOPED_TRACE(output);
        if (output.ends_with('/')) continue;  // has no extension: a usage error
        expect_refused(command({"still", "scene.frag", "-o", output, "--size", "64x36"}), cause);
    }
    EXPECT_EQ(bytes("scene.frag"), kGradient);
    EXPECT_TRUE(fs::is_empty(folder() / "folder.png"));
}

// Hours may lie between the first frame and the file.
TEST_F(BrokenOutput, IsToldBeforeAnythingIsDrawn) {
    fs::create_directory(folder() / "folder.png");
    fs::create_directory(folder() / "folder.exr");
    write("file", "precious");
    const std::vector<std::string> cases[] = {
        {"still", "scene.frag", "-o", "gone/out.png"},
        {"still", "scene.frag", "-o", "folder.png"},
        {"still", "scene.frag", "-o", std::string(252, 'x') + ".png"},
        {"still", "scene.frag", "-o", "out.png", "--save-state", "gone/state.exr"},
        {"still", "scene.frag", "-o", "out.png", "--save-state", "folder.exr"},
        {"sequence", "scene.frag", "-o", "out%d.png", "--save-state", "gone/state.exr"},
        {"sequence", "scene.frag", "-o", "out%d.png", "--save-state", "gone/state%d.exr"},
        {"sequence", "scene.frag", "--save-state", "gone/state.exr"},
        {"sequence", "scene.frag", "-o", "gone/out%d.png"},
        {"sequence", "scene.frag", "-o", "gone/out.mp4"},
    };
    for (std::vector<std::string> arguments : cases) {
        SCOPED_TRACE(arguments[0] + " " + arguments[3].substr(0, 20) + " " + arguments.back());
        // Without a context nothing can be drawn: what is wrong with the place is told before.
        arguments.insert(arguments.end(), {"--device", "no such GPU"});
        expect_refused(command(std::move(arguments)), "");
    }
    EXPECT_EQ(bytes("file"), "precious");
}

// What is no UTF-8 in a name cannot stand in JSON as it is: no reason to lose a result.
TEST_F(BrokenOutput, ANameThatIsNoUtf8LosesNoJson) {
    write("n\xFF.frag",
          "uniform float level; //@ 0.5 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(level); }\n");
    const std::vector<std::string> cases[] = {
        {"still", "n\xFF.frag", "-o", "o\xFF.png", "--size", "8x8", "--json"},
        {"sequence", "n\xFF.frag", "-o", "o\xFF%d.png", "--frames", "0:0", "--size", "8x8",
         "--json"},
        {"info", "n\xFF.frag", "--json"},
        {"bench", "n\xFF.frag", "--frames", "1", "--size", "8x8", "--json"},
        {"study", "n\xFF.frag", "--vary", "level=0.2,0.5", "--frames", "15", "--size", "8x8",
         "--json", "-o", "study"},
        {"check", "n\xFF.frag", "--case", "size 1x1", "--json"},
        {"export", "n\xFF.frag", "-o", "tabs"},
    };
    for (const std::vector<std::string>& arguments : cases) {
        SCOPED_TRACE(arguments[0]);
        const Outcome outcome = glint(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const bool is_json = arguments[0] != "export";
        EXPECT_EQ(Json::accept(outcome.out), is_json) << outcome.out;
    }
    EXPECT_TRUE(fs::exists(folder() / "study/index.html"));
}

TEST_F(BrokenOutput, ADiskThatFillsUpKeepsTheOldPicture) {
    const fs::path disk = folder() / "disk";
    fs::create_directory(disk);
    if (!mount_small_disk(disk, "64k")) GTEST_SKIP() << "mounting needs root";
    for (const std::string name : {"out.png", "out.exr", "out.tif", "out.jpg", "out.hdr"}) {
        SCOPED_TRACE(name);
        write("disk/" + name, "precious");
        // At once, and in bands.
        for (const auto& way : std::vector<std::vector<std::string>>{{}, {"--tile", "64"}}) {
            Command full =
                command({"still", "noise.frag", "-o", "disk/" + name, "--size", "512x512"});
            full.arguments.insert(full.arguments.end(), way.begin(), way.end());
            expect_refused(full, "No space left on device");
            EXPECT_EQ(bytes("disk/" + name), "precious");
        }
        fs::remove(disk / name);
        EXPECT_TRUE(fs::is_empty(disk));
    }
    unmount(disk);
}

TEST_F(BrokenOutput, AFileThatMayNotGrowKeepsTheOldPicture) {
    for (const std::string name : {"out.png", "out.exr", "out.tif", "out.jpg", "out.hdr"}) {
        SCOPED_TRACE(name);
        write(name, "precious");
        Command full = command({"still", "noise.frag", "-o", name, "--size", "256x256"});
        full.largest_file = 16384;
        full.environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}};
        expect_refused(full, "File too large");
        EXPECT_EQ(bytes(name), "precious");
    }
}

TEST_F(BrokenOutput, AnUnknownKindOfFileIsAUsageErrorBeforeAnythingIsDrawn) {
    for (const std::string name : {"out.gif", "out", "out.png.", "png", "folder.png/"}) {
        SCOPED_TRACE(name);
        const auto before = names();
        const Outcome outcome = glint({"still", "gone.frag", "-o", name});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find(".png, .exr, .jpg, .tif or .hdr"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(names(), before);
    }
}

TEST_F(BrokenOutput, AFullStdoutIsAFailure) {
    for (const auto& arguments : std::vector<std::vector<std::string>>{
             {"still", "scene.frag", "-o", "out.png", "--size", "8x8", "--json"},
             {"info", "scene.frag"},
             {"info", "scene.frag", "--json"},
             {"--help"}}) {
        SCOPED_TRACE(arguments[0]);
        Command full = command(arguments);
        full.out_to = "/dev/full";
        const Outcome outcome = run(full);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.err.find("error: "), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace glint::cli::broken_output_test
