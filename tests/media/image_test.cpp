// What goes into a picture's file comes back.
#include "image_files.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace glint::image_test {
namespace {

Image u8_image(glm::ivec2 size, int channels, const std::vector<int>& values) {
    Image image{.size = size, .channels = channels, .type = ChannelType::u8, .pixels = {}};
    for (const int value : values) image.pixels.push_back(static_cast<std::byte>(value));
    return image;
}

Image f32_image(glm::ivec2 size, int channels, const std::vector<float>& values) {
    Image image{.size = size, .channels = channels, .type = ChannelType::f32, .pixels = {}};
    const auto bytes = std::as_bytes(std::span(values));
    image.pixels.assign(bytes.begin(), bytes.end());
    return image;
}

std::vector<float> floats_of(const Image& image) {
    std::vector<float> values(image.pixels.size() / sizeof(float));
    std::memcpy(values.data(), image.pixels.data(), values.size() * sizeof(float));
    return values;
}

std::string big_endian(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
            static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return big_endian(static_cast<std::uint32_t>(data.size())) + body +
           big_endian(static_cast<std::uint32_t>(crc));
}

// A PNG that owes nothing to libpng. `rows` are top down, each behind its filter byte.
std::string make_png(std::uint32_t width, std::uint32_t height, char bits, char colour_type,
                     const std::string& rows, const std::string& palette = "") {
    std::string packed(rows.size() + 64, '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(rows.data()), rows.size());
    packed.resize(size);
    const std::string header = big_endian(width) + big_endian(height) + bits + colour_type;
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header + std::string(3, '\0')) +
           (palette.empty() ? "" : png_chunk("PLTE", palette)) + png_chunk("IDAT", packed) +
           png_chunk("IEND", "");
}

// ---- round trips

TEST_F(ImageFile, PngKeepsEveryByteOfOneToFourChannels) {
    for (int channels = 1; channels <= 4; ++channels) {
        Image image = u8_image({3, 2}, channels, {});
        for (int i = 0; i < 6 * channels; ++i) image.pixels.push_back(std::byte(i * 37 % 256));
        write_image(in("a.png"), image);
        const Image back = read_image(in("a.png"));
        EXPECT_EQ(back.size, image.size);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.type, ChannelType::u8);
        EXPECT_EQ(back.pixels, image.pixels) << channels << " channels";
    }
}

TEST_F(ImageFile, FloatFilesKeepEveryBit) {
    using Limits = std::numeric_limits<float>;
    const std::vector<float> values = {0.0F,
                                       -0.0F,
                                       1.0F,
                                       -1.5F,
                                       Limits::max(),
                                       Limits::lowest(),
                                       Limits::min(),
                                       1.4e-45F,
                                       -1e-40F,
                                       1.0F / 3,
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       Limits::quiet_NaN(),
                                       std::bit_cast<float>(0xFFC12345U),
                                       65504.0F,
                                       65536.0F,
                                       1e-8F,
                                       0.1F,
                                       1e30F,
                                       -2e-30F,
                                       42.0F,
                                       7.0F,
                                       8.0F,
                                       9.0F};
    for (const char* name : {"a.exr", "a.tif"}) {
        for (int channels = 1; channels <= 4; ++channels) {
            const int width = 12 / channels;
            const Image image = f32_image({width, 2}, channels, values);
            write_image(in(name), image);
            const Image back = read_image(in(name));
            EXPECT_EQ(back.size, image.size);
            EXPECT_EQ(back.channels, channels);
            EXPECT_EQ(back.type, ChannelType::f32);
            EXPECT_EQ(back.pixels, image.pixels) << name << ", " << channels << " channels";
        }
    }
}

TEST_F(ImageFile, HdrKeepsPowersOfTwoAndDropsAlpha) {
    write_image(in("a.hdr"), f32_image({1, 2}, 4, {1, 2, 0.5F, 0.25F, 1024, 512, 256, 0}));
    const Image back = read_image(in("a.hdr"));
    EXPECT_EQ(back.channels, 3);
    EXPECT_EQ(floats_of(back), (std::vector<float>{1, 2, 0.5F, 1024, 512, 256}));
}

TEST_F(ImageFile, JpgIsNearAndDropsAlpha) {
    Image image = u8_image({16, 16}, 4, {});
    for (int i = 0; i < 256; ++i) {
        for (const int value : {200, 40, 90, 7}) image.pixels.push_back(std::byte(value));
    }
    write_image(in("a.jpg"), image);
    const Image back = read_image(in("a.jpg"));
    ASSERT_EQ(back.channels, 3);
    for (std::size_t i = 0; i < back.pixels.size(); ++i) {
        const int expected = std::to_integer<int>(image.pixels[i / 3 * 4 + i % 3]);
        // One colour over the whole block loses only the rounding of YCbCr.
        EXPECT_NEAR(std::to_integer<int>(back.pixels[i]), expected, 2);
    }
}

TEST_F(ImageFile, AlphaIsNeverMultipliedInNorDividedOut) {
    const Image bytes = u8_image({2, 1}, 4, {102, 51, 255, 128, 102, 51, 255, 0});
    write_image(in("a.png"), bytes);
    EXPECT_EQ(read_image(in("a.png")).pixels, bytes.pixels);

    const Image floats = f32_image({2, 1}, 4, {0.4F, 0.2F, 1.0F, 0.5F, 3.0F, 2.0F, 1.0F, 0.0F});
    for (const char* name : {"a.exr", "a.tif"}) {
        write_image(in(name), floats);
        EXPECT_EQ(floats_of(read_image(in(name))), floats_of(floats)) << name;
    }
}

TEST_F(ImageFile, OnePixelFitsEveryKindOfFile) {
    for (const char* name : kWritable) {
        write_image(in(name), noise_for(name, {1, 1}));
        EXPECT_EQ(read_image(in(name)).size, glm::ivec2(1, 1)) << name;
    }
}

// libpng would make room for two rows before anybody is asked.
TEST_F(ImageFile, SidesThatAPngOnlyClaimsTakeNoMemory) {
    const auto most_kib = [] {
        rusage used{};
        getrusage(RUSAGE_SELF, &used);
        return used.ru_maxrss;
    };
    put_content(in("a.png"), make_png(0x7fffffff, 0x7fffffff, 8, 6, "short"));
    const long before = most_kib();
    EXPECT_TRUE(contains(complaint([&] { read_image(in("a.png")); }), "16384"));
    EXPECT_LT(most_kib() - before, 64 << 10);
}

TEST_F(ImageFile, TheLongestSideThatIsReadIs16384AndLongerOnesAreWritten) {
    for (const char* name : kWritable) {
        write_image(in(name), noise_for(name, {16384, 1}));
        EXPECT_EQ(read_image(in(name)).size, glm::ivec2(16384, 1)) << name;
        write_image(in(name), noise_for(name, {1, 16384}));
        EXPECT_EQ(read_image(in(name)).size, glm::ivec2(1, 16384)) << name;
        write_image(in(name), noise_for(name, {16385, 1}));
        EXPECT_TRUE(contains(complaint([&] { read_image(in(name)); }), "16384"));
    }
    EXPECT_TRUE(contains(complaint([&] {
                             write_image(in("a.jpg"), noise_for("a.jpg", {65501, 1}));
                         }),
                         "65500"));
    put_content(in("b.png"), make_png(16385, 1, 8, 0, std::string(16386, '\0')));
    EXPECT_TRUE(contains(complaint([&] { read_image(in("b.png")); }), "16384"));
}

// Rows from the bottom, as pictures have them.
Image rows_of(const Image& image, int first, int count) {
    const auto row = image.pixels.size() / static_cast<std::size_t>(image.size.y);
    const auto begin = image.pixels.begin() + static_cast<std::ptrdiff_t>(row) * first;
    return {.size = {image.size.x, count},
            .channels = image.channels,
            .type = image.type,
            .pixels = {begin, begin + static_cast<std::ptrdiff_t>(row) * count}};
}

TEST_F(ImageFile, BandsFromTheTopMakeTheSameFileAsTheWhole) {
    for (const char* name : kWritable) {
        SCOPED_TRACE(name);
        const Image image = noise_for(name, {70, 150});
        write_image(in("whole") += fs::path(name).extension(), image);
        const fs::path banded = in("bands") += fs::path(name).extension();
        ImageWriter writer(banded, image);
        for (const auto& [first, count] : {std::pair(149, 1), {86, 63}, {80, 6}, {0, 80}}) {
            writer.write(rows_of(image, first, count));
        }
        EXPECT_FALSE(fs::exists(banded));
        writer.finish();
        EXPECT_EQ(content_of(banded), content_of(in("whole") += fs::path(name).extension()));
    }
    for (const char* name : {"tiled.exr", "tiled.tif"}) {
        const Image image = noise_for(name, {70, 150});
        ImageWriter writer(in(name), image, {}, {.tiled = true});
        for (const auto& [first, count] : {std::pair(86, 64), {0, 86}}) {
            writer.write(rows_of(image, first, count));
        }
        writer.finish();
        EXPECT_EQ(floats_of(read_image(in(name))), floats_of(image)) << name;
    }
}

TEST_F(ImageFile, AnExrKeepsHalvesAndIsPackedAsItIsTold) {
    const Image image = noise_for("a.exr", {64, 64});
    write_image(in("float.exr"), image, {}, {.compression = "none"});
    for (const std::string name :
         {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab", "zip:1"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(refusal_of("a.exr", {.values = "half", .compression = name}), "");
        write_image(in("half.exr"), image, {}, {.values = "half", .compression = name});
        EXPECT_LT(fs::file_size(in("half.exr")), fs::file_size(in("float.exr")) * 3 / 5);
        if (name.starts_with("b44") || name.starts_with("dwa")) continue;  // lossy
        const auto kept = floats_of(read_image(in("half.exr")));
        const auto expected = floats_of(image);
        for (std::size_t i = 0; i < kept.size(); ++i) {
            ASSERT_NEAR(kept[i], expected[i], std::abs(expected[i]) / 1024 + 1e-7);  // 11 bits
        }
    }
    for (const char* name : {"none", "lzw", "zip", "packbits"}) {
        EXPECT_EQ(refusal_of("a.tif", {.compression = name}), "");
        write_image(in("a.tif"), image, {}, {.compression = name});
        EXPECT_EQ(floats_of(read_image(in("a.tif"))), floats_of(image)) << name;
    }
    EXPECT_TRUE(contains(refusal_of("a.exr", {.compression = "zipp"}), "dwaa"));
    EXPECT_TRUE(contains(refusal_of("a.exr", {.compression = "piz:3"}), "dwaa"));
    EXPECT_TRUE(contains(refusal_of("a.tif", {.compression = "piz"}), "lzw"));
    EXPECT_TRUE(contains(refusal_of("a.png", {.compression = "zip"}), ".exr and .tif"));
    EXPECT_TRUE(contains(refusal_of("a.tif", {.values = "half"}), "--format"));
    EXPECT_TRUE(contains(refusal_of("a.png", {.quality = 80}), "--quality"));
}

TEST_F(ImageFile, QualityMakesASmallerJpeg) {
    const Image image = noise_for("a.jpg", {64, 64});
    write_image(in("usual.jpg"), image);
    write_image(in("95.jpg"), image, {}, {.quality = 95});
    write_image(in("20.jpg"), image, {}, {.quality = 20});
    EXPECT_EQ(content_of(in("usual.jpg")), content_of(in("95.jpg")));
    EXPECT_LT(fs::file_size(in("20.jpg")), fs::file_size(in("95.jpg")) / 2);
}

// ---- orientation

TEST_F(ImageFile, TheLastRowOfAFileIsTheFirstOfTheImage) {
    // Two pixels, black over white.
    put_content(in("a.png"), make_png(1, 2, 8, 0, std::string("\0\x00\0\xff", 4)));
    EXPECT_EQ(read_image(in("a.png")).pixels, (std::vector{std::byte{255}, std::byte{0}}));

    put_content(in("a.hdr"), std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n"
                                         "\x00\x00\x00\x00\x80\x80\x80\x81",
                                         54));
    EXPECT_EQ(floats_of(read_image(in("a.hdr"))), (std::vector<float>{1, 1, 1, 0, 0, 0}));
}

TEST_F(ImageFile, EveryKindOfFileComesBackTheSameWayUp) {
    for (const char* name : kWritable) {
        // Eight rows and columns of each, so that JPG's blocks do not mix them.
        Image image{.size = {16, 16}, .channels = 3, .type = ChannelType::u8, .pixels = {}};
        std::vector<float> values;
        for (int i = 0; i < 256; ++i) {
            for (const int level : {i / 16 < 8 ? 0 : 128, i % 16 < 8 ? 0 : 128, 0}) {
                image.pixels.push_back(std::byte(level));
                values.push_back(static_cast<float>(level));
            }
        }
        if (holds_floats(name)) image = f32_image({16, 16}, 3, values);
        write_image(in(name), image);
        const Image back = read_image(in(name));
        const auto at = [&](int x, int y, int c) {
            const auto i = static_cast<std::size_t>((y * 16 + x) * 3 + c);
            return holds_floats(name) ? static_cast<int>(floats_of(back)[i])
                                      : std::to_integer<int>(back.pixels[i]);
        };
        EXPECT_NEAR(at(0, 0, 0), 0, 3) << name;
        EXPECT_NEAR(at(0, 15, 0), 128, 3) << name;
        EXPECT_NEAR(at(0, 15, 1), 0, 3) << name;
        EXPECT_NEAR(at(15, 0, 1), 128, 3) << name;
    }
}

// ---- files of others

TEST_F(ImageFile, APaletteBecomesColours) {
    put_content(in("a.png"),
                make_png(2, 1, 8, 3, std::string("\0\x01\x00", 3), std::string("\1\2\3\4\5\6")));
    const Image back = read_image(in("a.png"));
    EXPECT_EQ(back.channels, 3);
    EXPECT_EQ(back.pixels, u8_image({2, 1}, 3, {4, 5, 6, 1, 2, 3}).pixels);
}

TEST_F(ImageFile, OneBitOfGreyBecomesAByte) {
    put_content(in("a.png"), make_png(3, 1, 1, 0, std::string("\0\xa0", 2)));
    EXPECT_EQ(read_image(in("a.png")).pixels, u8_image({3, 1}, 1, {255, 0, 255}).pixels);
}

TEST_F(ImageFile, SixteenBitsBecomeFloats) {
    put_content(in("a.png"), make_png(2, 2, 16, 0,
                                      std::string("\0\x00\x00\xff\xff"
                                                  "\0\x12\x34\x80\x00",
                                                  10)));
    const Image back = read_image(in("a.png"));
    EXPECT_EQ(back.type, ChannelType::f32);
    const float unit = 65535.0F;
    EXPECT_EQ(floats_of(back), (std::vector<float>{0x1234 / unit, 0x8000 / unit, 0, 1}));
}

TEST_F(ImageFile, TheContentDecidesNotTheName) {
    write_image(in("a.jpg"), noise({8, 8}, ChannelType::u8));
    fs::rename(in("a.jpg"), in("b.png"));
    EXPECT_EQ(read_image(in("b.png")).size, glm::ivec2(8, 8));
}

// ---- names and text

TEST(ImageName, AnExtensionCountsInAnyCase) {
    EXPECT_TRUE(can_write("dir.d/A.PNG"));
    EXPECT_TRUE(can_write("a.jpeg"));
    EXPECT_TRUE(can_write("a.TIFF"));
    EXPECT_FALSE(can_write("a.gif"));
    EXPECT_FALSE(can_write("png"));
    EXPECT_FALSE(can_write(".png"));
    EXPECT_TRUE(holds_floats("a.exr"));
    EXPECT_TRUE(holds_floats("a.hdr"));
    EXPECT_FALSE(holds_floats("a.jpg"));
    EXPECT_FALSE(holds_floats("a.mp4"));
}

TEST_F(ImageFile, AnUnknownExtensionIsToldTheKnownOnes) {
    const auto text = complaint([&] { write_image(in("a.gif"), noise({2, 2}, ChannelType::u8)); });
    for (const char* known : {"a.gif", ".png", ".exr", ".jpg", ".tif", ".hdr"}) {
        EXPECT_TRUE(contains(text, known)) << text;
    }
    EXPECT_TRUE(names().empty());
}

TEST_F(ImageFile, TextIsKeptInTheFile) {
    const Metadata text = {{"Title", "Harbour at dusk"},
                           {"Place", "Malmö, 12 °C"},
                           {"channels", "a name that EXR uses itself"},
                           {"", "no name"},
                           {std::string(300, 'n'), "a name too long"}};
    for (const char* name : {"a.png", "a.exr"}) {
        write_image(in(name), noise_for(name, {2, 2}), text);
        const std::string content = content_of(in(name));
        EXPECT_TRUE(contains(content, "Harbour at dusk")) << name;
        EXPECT_TRUE(contains(content, "Malmö, 12 °C")) << name;
        EXPECT_TRUE(contains(content, "a name too long")) << name;
        EXPECT_EQ(read_image(in(name)).size, glm::ivec2(2, 2)) << name;
    }
}

TEST_F(ImageFile, EqualPicturesAreEqualFiles) {
    const auto contents = [&] {
        std::vector<std::string> list;
        for (const char* name : kWritable) {
            write_image(in(name), noise_for(name, {40, 30}),
                        {{"Title", "x"}, {"Software", "glint"}});
            list.push_back(content_of(in(name)));
        }
        return list;
    };
    const std::vector<std::string> first = contents();
    // Long enough for a date in seconds to change.
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));
    const std::vector<std::string> second = contents();
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i], second[i]) << kWritable[i];
}

// ---- what cannot be read

TEST_F(ImageFile, ACutFileIsAnErrorWithItsName) {
    for (const char* name : {"a.png", "a.exr", "a.jpg", "a.tif", "a.hdr"}) {
        write_image(in(name), noise_for(name, {64, 64}));
        const std::string whole = content_of(in(name));
        for (const double part : {0.1, 0.5, 0.9}) {
            const auto bytes = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
            put_content(in(name), std::string_view(whole).substr(0, bytes));
            const auto text = complaint([&] { read_image(in(name)); });
            EXPECT_TRUE(contains(text, name)) << name << " cut to " << part << ": " << text;
        }
    }
}

TEST_F(ImageFile, WhatIsNoPictureIsToldByName) {
    put_content(in("empty.png"), "");
    put_content(in("text.png"), "void mainImage(out vec4 c, in vec2 p) {}\n");
    fs::create_directory(in("folder.png"));
    const struct {
        const char* name;
        const char* cause;
    } cases[] = {{"empty.png", "is empty"},
                 {"text.png", "not a png, jpg, exr, hdr or tif"},
                 {"folder.png", "it is a folder"},
                 {"missing.png", "No such file"}};
    for (const auto& [name, cause] : cases) {
        const auto text = complaint([&] { read_image(in(name)); });
        EXPECT_TRUE(contains(text, name) && contains(text, cause)) << text;
    }
}

TEST_F(ImageFile, DamagedBytesNeverCrash) {
    for (const char* name : kWritable) {
        write_image(in(name), noise_for(name, {24, 24}));
        const std::string whole = content_of(in(name));
        std::uint32_t state = 7;
        for (int round = 0; round < 60; ++round) {
            std::string damaged = whole;
            for (int i = 0; i < 4; ++i) {
                state = state * 747796405U + 2891336453U;
                damaged[(state >> 4) % std::min<std::size_t>(whole.size(), 600)] =
                    static_cast<char>(state >> 24);
            }
            put_content(in(name), damaged);
            complaint([&] { read_image(in(name)); });
        }
    }
}

}  // namespace
}  // namespace glint::image_test
