// What is large is drawn in little memory, or refused by name before anything is written. The
// system kills whatever takes more than its control group has.
#include "memory_group.h"

#include <array>
#include <cstdint>
#include <memory>

namespace glint::cli::memory_test {
namespace {

constexpr std::size_t kMebibyte = 1 << 20;

class LittleMemory : public InAFolder {
protected:
    void SetUp() override {
        write("scene.frag", kGradient);
        allow(400);
    }

    void allow(std::size_t mebibytes) {
#ifdef __SANITIZE_ADDRESS__
        GTEST_SKIP() << "the address sanitizer takes memory of its own";
#endif
        group_.reset();  // both have one name
        group_ = std::make_unique<MemoryGroup>(mebibytes * kMebibyte);
        if (!group_->is_there())
            GTEST_SKIP() << "no control group for memory can be made here: that takes root, and "
                            "/sys/fs/cgroup to write to";
    }

    Outcome in_group(std::vector<std::string> arguments) const {
        const Outcome outcome = group_->run(command(std::move(arguments)));
        EXPECT_EQ(outcome.signal, 0) << "killed for its memory";
        return outcome;
    }

    // Says who takes how much and what is free, and leaves nothing behind.
    void expect_refused(std::vector<std::string> arguments, const std::string& name) {
        const std::set<std::string> before = names();
        const Outcome outcome = in_group(std::move(arguments));
        EXPECT_EQ(outcome.code, 1) << outcome.err;
        EXPECT_NE(outcome.err.find("of memory is needed"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("is free. Make "), std::string::npos) << outcome.err;
        EXPECT_EQ(names(), before);
    }

    std::unique_ptr<MemoryGroup> group_;
};

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 255u);
    return bytes;
}

// A PNG that says it has so many pixels and holds `data`; no reader gets as far as its checksums.
std::string png_of(std::uint32_t width, std::uint32_t height, char bits, char colour,
                   const std::string& data) {
    const auto chunk = [](const std::string& name, const std::string& content) {
        std::uint32_t crc = ~0u;
        for (const char c : name + content) {
            crc ^= static_cast<unsigned char>(c);
            for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1u ? 0xEDB88320u : 0u);
        }
        return big_endian(static_cast<std::uint32_t>(content.size())) + name + content +
               big_endian(~crc);
    };
    const std::string head =
        big_endian(width) + big_endian(height) + bits + colour + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", head) + chunk("IDAT", data) + chunk("IEND", "");
}

constexpr std::string_view kShowsPicture =
    "uniform sampler2D a; //@ image a.png\n"
    "void mainImage(out vec4 c, in vec2 p) { c = texture(a, p / iResolution.xy); }\n";

TEST_F(LittleMemory, AHugeStillIsDrawnInBands) {
    const Outcome outcome = in_group(
        {"still", "scene.frag", "-o", "a.exr", "--size", "16384x2049", "--compression", "rle"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(LittleMemory, LargeTilesTakeNoMoreOfAWidePicture) {
    allow(200);
    const Outcome outcome =
        in_group({"still", "scene.frag", "-o", "a.png", "--size", "65536x1024", "--tile", "4096"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(LittleMemory, AStillThatWouldBeDrawnWholeGetsTheSameBytesInBands) {
    const std::vector<std::string> arguments = {"still",     "scene.frag",    "--size",
                                                "3072x3072", "--compression", "rle",
                                                "--format",  "half",          "-o"};
    std::vector<std::string> whole = arguments, bands = arguments;
    whole.push_back("whole.exr"), bands.push_back("bands.exr");
    EXPECT_EQ(glint(whole).code, 0);
    const Outcome outcome = in_group(bands);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(bytes("bands.exr") == bytes("whole.exr"), true) << "bands change the file";
}

TEST_F(LittleMemory, AnInputThatUnpacksToTooMuchIsNamed) {
    write("picture.frag", kShowsPicture);
    write("a.png", png_of(16384, 16384, 1, 0, std::string(33000, '\0')));
    expect_refused({"still", "picture.frag", "-o", "b.png", "--size", "16x9"}, "a.png");
}

TEST_F(LittleMemory, AnInputThatIsCutShortIsFoundBeforeItsRoomIsMade) {
    write("picture.frag", kShowsPicture);
    write("a.png", png_of(16384, 16384, 16, 6, std::string(1000, '\0')));
    const Outcome outcome = in_group({"still", "picture.frag", "-o", "b.png", "--size", "16x9"});
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_EQ(outcome.err, "picture.frag:1:19: error: Cannot read a.png: It is cut short.\n");
}

TEST_F(LittleMemory, AVolumeThatTakesTooMuchIsNamed) {
    write("volume.frag",
          "uniform sampler3D a; //@ volume a.bin\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(a, vec3(p, 0.0)); }\n");
    const std::string sides = std::string("\0\2\0\0\0\2\0\0\0\2\0\0", 12);  // 512 of each
    write("a.bin", "BIN\1" + sides + std::string("\2\0\0\0", 4));           // two bytes a voxel
    fs::resize_file(folder() / "a.bin", 256 * kMebibyte + 20);  // without a byte on the disk
    expect_refused({"still", "volume.frag", "-o", "b.png", "--size", "16x9"}, "a.bin");
}

TEST_F(LittleMemory, PicturesOfASequenceWaitForMemory) {
    const Outcome outcome = in_group({"sequence", "scene.frag", "-o", "a.%04d.exr", "--size",
                                      "2000x2000", "--frames", "0:6", "--compression", "none"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder() / "a.0006.exr"));
}

TEST_F(LittleMemory, WhatCannotBeDrawnInItIsRefusedByName) {
    expect_refused({"sequence", "scene.frag", "-o", "a.%04d.exr", "--size", "4096x4096"},
                   "a picture on its way to its file");
    expect_refused({"sequence", "scene.frag", "-o", "a.mp4", "--size", "2000x2000"}, "FFmpeg");
    write("buffer.frag",
          "uniform sampler2D waves; //@ pass mainWaves\n"
          "void mainWaves(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(waves, ivec2(p), 0); }\n");
    expect_refused({"still", "buffer.frag", "-o", "a.png", "--size", "6000x6000"}, "waves");
    expect_refused(
        {"still", "buffer.frag", "-o", "a.exr", "--size", "3000x3000", "--pass", "waves"},
        "the picture on its way to the file");
}

}  // namespace
}  // namespace glint::cli::memory_test
