// A picture that cannot be written: exit code 1, the cause, and everything stays as it was.
#include "command.h"

namespace glint::cli {
namespace {

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
        {"gone/out.png", "No such file or directory"},
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
    for (const std::string name : {"out.gif", "out", "out.png.", "", "png", "folder.png/"}) {
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
}  // namespace glint::cli
