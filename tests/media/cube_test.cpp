// Cubes from pictures: every form gives the same six faces, and no seam shows between them.
#include "media/cube.h"

#include "media/volume.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace glint::cube_test {
namespace {

namespace fs = std::filesystem;

constexpr int kFaces = 6;
// Axis of a face's middle, in GL's order.
const glm::dvec3 kAxes[kFaces] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                  {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};

// One byte a pixel.
Image picture(glm::ivec2 size, const std::vector<int>& top_down) {
    Image image{.size = size, .channels = 1, .type = ChannelType::u8, .pixels = {}};
    for (int y = size.y - 1; y >= 0; --y)
        for (int x = 0; x < size.x; ++x)
            image.pixels.push_back(
                static_cast<std::byte>(top_down[static_cast<std::size_t>(y * size.x + x)]));
    return image;
}

std::vector<int> bytes_of(const Cube& cube) {
    std::vector<int> values;
    for (const std::byte value : cube.pixels) values.push_back(std::to_integer<int>(value));
    return values;
}

// Faces of 2x2: face f holds 10 f + 1 to 10 f + 4, as one reads.
std::vector<int> numbered() {
    std::vector<int> values;
    for (int face = 0; face < kFaces; ++face)
        for (int i = 1; i <= 4; ++i) values.push_back(10 * face + i);
    return values;
}

TEST(CubeFiles, SixPicturesAreTheFacesWithTheirUpperRowFirst) {
    std::vector<Image> faces;
    for (int f = 0; f < kFaces; ++f)
        faces.push_back(picture({2, 2}, {10 * f + 1, 10 * f + 2, 10 * f + 3, 10 * f + 4}));
    EXPECT_EQ(bytes_of(make_cube(faces)), numbered());
}

TEST(CubeFiles, ACrossHoldsTheSameFaces) {
    const Image lying = picture({8, 6}, {0,  0,  21, 22, 0, 0, 0,  0,   //
                                         0,  0,  23, 24, 0, 0, 0,  0,   //
                                         11, 12, 41, 42, 1, 2, 51, 52,  //
                                         13, 14, 43, 44, 3, 4, 53, 54,  //
                                         0,  0,  31, 32, 0, 0, 0,  0,   //
                                         0,  0,  33, 34, 0, 0, 0,  0});
    EXPECT_EQ(bytes_of(make_cube({lying})), numbered());
    const Image standing = picture({6, 8}, {0,  0,  21, 22, 0, 0,  //
                                            0,  0,  23, 24, 0, 0,  //
                                            11, 12, 41, 42, 1, 2,  //
                                            13, 14, 43, 44, 3, 4,  //
                                            0,  0,  31, 32, 0, 0,  //
                                            0,  0,  33, 34, 0, 0,  //
                                            0,  0,  54, 53, 0, 0,  // on its head
                                            0,  0,  52, 51, 0, 0});
    EXPECT_EQ(bytes_of(make_cube({standing})), numbered());
}

TEST(CubeFiles, TurningOverSwapsUpAndDownAndTurnsTheRows) {
    std::vector<Image> faces;
    for (int f = 0; f < kFaces; ++f)
        faces.push_back(picture({2, 2}, {10 * f + 1, 10 * f + 2, 10 * f + 3, 10 * f + 4}));
    Cube cube = make_cube(faces);
    turn_over(cube);
    const std::vector<int> turned = bytes_of(cube);
    EXPECT_EQ((std::vector<int>(turned.begin() + 8, turned.begin() + 12)),
              (std::vector<int>{33, 34, 31, 32}))
        << "+Y is what was -Y";
    EXPECT_EQ((std::vector<int>(turned.begin(), turned.begin() + 4)),
              (std::vector<int>{3, 4, 1, 2}));
    turn_over(cube);
    EXPECT_EQ(bytes_of(cube), numbered());
}

// A panorama whose colour is the direction that it is seen in.
Image direction_panorama(int width) {
    Image image{.size = {width, width / 2}, .channels = 3, .type = ChannelType::f32, .pixels = {}};
    std::vector<float> values;
    for (int row = 0; row < image.size.y; ++row) {
        for (int x = 0; x < width; ++x) {
            const double longitude = ((x + 0.5) / width - 0.5) * 2.0 * M_PI;
            const double latitude = ((row + 0.5) / image.size.y - 0.5) * M_PI;  // rows bottom up
            values.push_back(static_cast<float>(std::cos(latitude) * std::sin(longitude)));
            values.push_back(static_cast<float>(std::sin(latitude)));
            values.push_back(static_cast<float>(-std::cos(latitude) * std::cos(longitude)));
        }
    }
    const auto bytes = std::as_bytes(std::span(values));
    image.pixels.assign(bytes.begin(), bytes.end());
    return image;
}

glm::dvec3 value_of(const Cube& cube, int face, int x, int y) {
    std::array<float, 3> value{};
    const auto index = static_cast<std::size_t>(((face * cube.side + y) * cube.side + x) * 3);
    std::memcpy(value.data(), cube.pixels.data() + index * sizeof(float), sizeof value);
    return {value[0], value[1], value[2]};
}

// As OpenGL 4.5 reads cubes, solved for the direction of a point of a face: an independent spelling
// of table 8.19 by the face's axes to the right and down.
glm::dvec3 direction_of(int face, double s, double t) {
    const glm::dvec3 right[kFaces] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0},
                                      {1, 0, 0},  {1, 0, 0}, {-1, 0, 0}};
    const glm::dvec3 down[kFaces] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1},
                                     {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    return glm::normalize(kAxes[face] + right[face] * s + down[face] * t);
}

TEST(CubeFiles, APanoramaGivesEveryDirectionItsColour) {
    const Cube cube = make_cube({direction_panorama(256)});
    ASSERT_EQ(cube.side, 64);
    ASSERT_EQ(cube.channels, 3);
    double worst = 0.0;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < cube.side; ++y) {
            for (int x = 0; x < cube.side; ++x) {
                const glm::dvec3 wanted = direction_of(face, (x + 0.5) / cube.side * 2.0 - 1.0,
                                                       (y + 0.5) / cube.side * 2.0 - 1.0);
                worst = std::max(worst, glm::distance(wanted, value_of(cube, face, x, y)));
            }
        }
    }
    // Half a pixel at the poles, where the panorama ends: pi / 256. Elsewhere it is less.
    EXPECT_LT(worst, M_PI / 256.0);
}

TEST(CubeFiles, NoSeamShowsBetweenTheFacesOfAPanorama) {
    const Cube cube = make_cube({direction_panorama(256)});
    // The right column of +Z and the left one of +X are one pixel apart, as two of one face are.
    const double pixel = 2.0 / cube.side;
    for (int y = 0; y < cube.side; ++y) {
        EXPECT_LT(glm::distance(value_of(cube, 4, cube.side - 1, y), value_of(cube, 0, 0, y)),
                  pixel);
        EXPECT_LT(glm::distance(value_of(cube, 5, cube.side / 2 - 1, y),
                                value_of(cube, 5, cube.side / 2, y)),
                  pixel)
            << "where the panorama's sides meet, or its middle";
        EXPECT_LT(glm::distance(value_of(cube, 4, cube.side / 2 - 1, y),
                                value_of(cube, 4, cube.side / 2, y)),
                  pixel);
    }
}

TEST(CubeFiles, WhatIsNoCubeIsSaid) {
    const struct {
        std::vector<Image> pictures;
        const char* text;
    } cases[] = {
        {{picture({3, 2}, {1, 2, 3, 4, 5, 6})}, "3 x 2 is no cube; it is a panorama of 2:1"},
        {std::vector<Image>(6, picture({2, 1}, {1, 2})), "The face +X is 2 x 1"},
        {{picture({1, 1}, {1}), picture({1, 1}, {1}), picture({2, 2}, {1, 1, 1, 1}),
          picture({1, 1}, {1}), picture({1, 1}, {1}), picture({1, 1}, {1})},
         "The face +Y is 2 x 2"},
    };
    for (const auto& c : cases) {
        try {
            make_cube(c.pictures);
            ADD_FAILURE() << c.text;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(c.text), std::string::npos) << error.what();
        }
    }
}

class VolumeFiles : public testing::Test {
protected:
    // As the site writes them: 20 bytes of head, then the voxels.
    fs::path write(glm::uvec3 size, std::uint8_t channels, std::uint16_t format,
                   std::string_view voxels) const {
        std::string bytes = "BIN";
        bytes += '\0';
        const auto add = [&](auto number) {
            bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
        };
        add(size.x), add(size.y), add(size.z), add(channels), add(std::uint8_t{0}), add(format);
        bytes += voxels;
        std::ofstream(file_, std::ios::binary) << bytes;
        return file_;
    }
    ~VolumeFiles() override { fs::remove(file_); }

    fs::path file_ = fs::path(testing::TempDir()) /
                     (std::string("glint-volume-") +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".bin");
};

TEST_F(VolumeFiles, AreReadAsTheyStand) {
    const Volume bytes = read_volume(write({2, 1, 2}, 2, 0, "abcdefgh"));
    EXPECT_EQ(bytes.size, glm::ivec3(2, 1, 2));
    EXPECT_EQ(bytes.channels, 2);
    EXPECT_EQ(bytes.type, ChannelType::u8);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.voxels.data()), 8), "abcdefgh");

    const float numbers[2] = {0.25f, -8.0f};
    const Volume floats = read_volume(
        write({1, 2, 1}, 1, 10, {reinterpret_cast<const char*>(numbers), sizeof numbers}));
    EXPECT_EQ(floats.type, ChannelType::f32);
    EXPECT_EQ(std::memcmp(floats.voxels.data(), numbers, sizeof numbers), 0);
}

TEST_F(VolumeFiles, AreRefusedWithTheReason) {
    const auto refusal = [&](const fs::path& file) -> std::string {
        try {
            read_volume(file);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "read";
    };
    const auto expect = [&](const std::string& said, const char* text) {
        EXPECT_NE(said.find(text), std::string::npos) << said;
    };
    expect(refusal("/nowhere/a.bin"), "No such file");
    expect(refusal(testing::TempDir()), "Cannot read");
    expect(refusal(write({2, 2, 2}, 1, 0, "1234567")),
           "7 bytes of voxels where its head tells of 8");
    expect(refusal(write({2, 2, 2}, 1, 0, "123456789")), "9 bytes");
    expect(refusal(write({0, 2, 2}, 1, 0, "")), "sides from 1 to 2048");
    expect(refusal(write({1, 1, 1}, 5, 0, "12345")), "5 channels");
    expect(refusal(write({1, 1, 1}, 1, 3, "12")), "format 3");
    expect(refusal(write({0xffffffffu, 0xffffffffu, 0xffffffffu}, 4, 10, "")), "sides from 1");
    std::ofstream(file_) << "short";
    expect(refusal(file_), "too short for a volume");
}

}  // namespace
}  // namespace glint::cube_test
