// Cubes and volumes from files, as a scene reads them.
#include "fixture.h"
#include "media/image.h"
#include "media/sound.h"

#include <fcntl.h>
#include <glm/geometric.hpp>
#include <unistd.h>

#include <cmath>
#include <cstring>

namespace glint::conformance_input_files_test {
namespace {

using InputFiles = GlTest;

std::string content_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string encoded(const char* name, const Image& image) {
    const TestFolder folder;
    write_image(folder.path() / name, image);
    return content_of(folder.path() / name);
}

// A picture of one colour but for its upper left pixel, which is white.
std::string marked_face(glm::ivec3 colour) {
    Image image{.size = {4, 4}, .channels = 3, .type = ChannelType::u8, .pixels = {}};
    for (int row = 0; row < 4; ++row)
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixels.push_back(
                    static_cast<std::byte>(row == 3 && x == 0 ? 255 : colour[c]));
    return encoded("a.png", image);
}

const glm::ivec3 kColours[6] = {{200, 0, 0}, {100, 0, 0}, {0, 200, 0},
                                {0, 100, 0}, {0, 0, 200}, {0, 0, 100}};

std::vector<File> six_faces() {
    const char* names[6] = {"px.png", "nx.png", "py.png", "ny.png", "pz.png", "nz.png"};
    std::vector<File> files;
    for (std::size_t i = 0; i < 6; ++i) files.push_back({names[i], marked_face(kColours[i])});
    return files;
}

constexpr const char* kSix = "px.png nx.png py.png ny.png pz.png nz.png";

glm::vec3 cube_colour(const char* annotation, const char* direction,
                      const std::vector<File>& files) {
    Player player(fmt::format("uniform samplerCube sky; //@ cube {}\n"
                              "void mainImage(out vec4 c, vec2 p) {{\n"
                              "    c = floor(texture(sky, {}) * 255.0 + 0.5);\n"
                              "}}\n",
                              annotation, direction),
                  {.files = files});
    player.draw(0);
    return player.colour();
}

TEST_F(InputFiles, SixFilesAreTheFacesOfACubeInGlsOrder) {
    const std::vector<File> files = six_faces();
    const char* directions[6] = {"vec3(1, .1, .1)",  "vec3(-1, .1, .1)", "vec3(.1, 1, .1)",
                                 "vec3(.1, -1, .1)", "vec3(.1, .1, 1)",  "vec3(.1, .1, -1)"};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(cube_colour(kSix, directions[i], files), glm::vec3(kColours[i])) << directions[i];
    }
    // The upper left corner of each picture, by OpenGL 4.5, table 8.19: up is +Y on the sides, -Z
    // on +Y and +Z on -Y; left is +Z on +X and so on round.
    const char* corners[6] = {"vec3(1, .8, .8)",   "vec3(-1, .8, -.8)", "vec3(-.8, 1, -.8)",
                              "vec3(-.8, -1, .8)", "vec3(-.8, .8, 1)",  "vec3(.8, .8, -1)"};
    for (const char* corner : corners)
        EXPECT_EQ(cube_colour(fmt::format("{} filter=nearest", kSix).c_str(), corner, files),
                  glm::vec3(255))
            << corner;
}

TEST_F(InputFiles, VflipStandsTheWorldOnItsHead) {
    const std::vector<File> files = six_faces();
    const std::string flipped = fmt::format("{} vflip=on filter=nearest", kSix);
    EXPECT_EQ(cube_colour(flipped.c_str(), "vec3(.1, 1, .1)", files), glm::vec3(kColours[3]));
    EXPECT_EQ(cube_colour(flipped.c_str(), "vec3(1, -.8, .8)", files), glm::vec3(255))
        << "the upper left corner of +X is below now";
}

// High dynamic range, seen through the sampler: what lies in the panorama in a direction comes back
// for that direction.
TEST_F(InputFiles, APanoramaIsSeenInItsDirections) {
    Image panorama{.size = {64, 32}, .channels = 3, .type = ChannelType::f32, .pixels = {}};
    std::vector<float> values;
    for (int row = 0; row < 32; ++row) {
        for (int x = 0; x < 64; ++x) {
            const double longitude = ((x + 0.5) / 64 - 0.5) * 2.0 * M_PI;
            const double latitude = ((row + 0.5) / 32 - 0.5) * M_PI;
            values.push_back(static_cast<float>(100 * std::cos(latitude) * std::sin(longitude)));
            values.push_back(static_cast<float>(100 * std::sin(latitude)));
            values.push_back(static_cast<float>(-100 * std::cos(latitude) * std::cos(longitude)));
        }
    }
    const auto bytes = std::as_bytes(std::span(values));
    panorama.pixels.assign(bytes.begin(), bytes.end());
    const File sky{"sky.exr", encoded("sky.exr", panorama)};
    for (const glm::vec3 d :
         {glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0.6, 0, 0.8),
          glm::normalize(glm::vec3(1, 1, 1)), glm::normalize(glm::vec3(-1, -1, 0.99))}) {
        Player player(fmt::format("uniform samplerCube sky; //@ cube sky.exr filter=linear\n"
                                  "void mainImage(out vec4 c, vec2 p) {{\n"
                                  "    c = texture(sky, vec3({}, {}, {}));\n"
                                  "}}\n",
                                  d.x, d.y, d.z),
                      {.files = {sky}});
        player.draw(0);
        // Linear filtering bends a sphere's chord by (pi / 64)^2 / 2; the poles have half a pixel.
        EXPECT_LT(glm::distance(player.colour(), d * 100.0f), 100 * M_PI / 64) << d.x << " " << d.y;
    }
}

TEST_F(InputFiles, ACubesResolutionIsThatOfAFace) {
    Player player(
        "uniform samplerCube iChannel1; //@ cube " + std::string(kSix) +
            "\nvoid mainImage(out vec4 c, vec2 p) {\n"
            "    c = vec4(iChannelResolution[1], 1) + texture(iChannel1, vec3(1)) * 0.0;\n"
            "}\n",
        {.files = six_faces()});
    player.draw(0);
    EXPECT_EQ(player.colour(), glm::vec3(4, 4, 1));
}

// 3x2x2 voxels of two channels; x runs fastest.
std::string volume_file() {
    std::string bytes("BIN\0\3\0\0\0\2\0\0\0\2\0\0\0\2\0\0\0", 20);
    for (int i = 0; i < 12; ++i) {
        bytes += static_cast<char>(10 * i);
        bytes += static_cast<char>(i);
    }
    return bytes;
}

TEST_F(InputFiles, AVolumesVoxelsStandWhereTheirFileHasThem) {
    Player player(
        "uniform sampler3D iChannel0; //@ volume a.bin\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = floor(texelFetch(iChannel0, ivec3(p.x, p.y, 1), 0) * 255.0 + 0.5);\n"
        "    if (p.x > 3.0) c = vec4(iChannelResolution[0], 1);\n"
        "}\n",
        {.files = {{"a.bin", volume_file()}}});
    player.draw(0);
    EXPECT_EQ(player.colour(0, 0), glm::vec3(60, 6, 0));
    EXPECT_EQ(player.colour(2, 0), glm::vec3(80, 8, 0));
    EXPECT_EQ(player.colour(1, 1), glm::vec3(100, 10, 0));
    EXPECT_EQ(player.colour(3, 0), glm::vec3(3, 2, 2));
}

TEST_F(InputFiles, APresetNamesCubesAndVolumesForPastedText) {
    Player cube(
        "uniform samplerCube iChannel0;\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(iChannel0, vec3(0, 0, 1)); }\n",
        {.preset = "[channels]\niChannel0 = { cube = [\"px.png\", \"nx.png\", "
                   "\"py.png\", \"ny.png\", \"pz.png\", \"nz.png\"] }\n",
         .files = six_faces()});
    cube.draw(0);
    EXPECT_NEAR(cube.colour().b * 255, 200, 0.5);

    Player volume(
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(iChannel2, ivec3(1), 0); }\n",
        {.preset = "[channels]\niChannel2 = { volume = \"a.bin\" }\n",
         .files = {{"a.bin", volume_file()}}});
    volume.draw(0);
    EXPECT_NEAR(volume.colour().r * 255, 100, 0.5);
}

// Half a second of a square wave, half a second of silence.
File sound_file() {
    const TestFolder folder;
    const std::filesystem::path file = folder.path() / "song.wav";
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    std::vector<std::int16_t> samples(2 * 44100, 0);
    for (std::size_t i = 0; i < 44100; ++i)
        samples[i] = static_cast<std::int16_t>(i / 2 % 100 < 50 ? 16384 : -16384);
    SoundWriter writer(descriptor, file);
    writer.append(samples);
    EXPECT_EQ(writer.finish(), 0);
    ::close(descriptor);
    return {"song.wav", content_of(file)};
}

constexpr const char* kListens =
    "uniform sampler2D iChannel1; //@ sound song.wav\n"
    "void mainImage(out vec4 c, vec2 p) {\n"
    "    c = vec4(texelFetch(iChannel1, ivec2(20, 0), 0).r, texelFetch(iChannel1, ivec2(9, 1), "
    "0).r,\n"
    "             iChannelTime[1], 1);\n"
    "    if (p.x > 1.0) c = vec4(iChannelResolution[1], 1);\n"
    "}\n";

// As browsers hand it over; the alpha of what has none is 1.
TEST_F(InputFiles, GreyStandsInAllColours) {
    const auto grey = [](int channels) {
        Image image{.size = {2, 2}, .channels = channels, .type = ChannelType::u8, .pixels = {}};
        for (int i = 0; i < 4; ++i) {
            image.pixels.push_back(std::byte{128});
            if (channels == 2) image.pixels.push_back(std::byte{64});
        }
        return encoded("a.png", image);
    };
    const std::string text =
        "uniform sampler2D photo; //@ image a.png filter=nearest\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    vec4 v = texelFetch(photo, ivec2(0), 0);\n"
        "    c = vec4(p.x < 1.0 ? v.rgb : v.aaa, 1);\n"
        "}\n";
    for (const int channels : {1, 2}) {
        Player player(text, {.files = {{"a.png", grey(channels)}}});
        player.draw(0);
        EXPECT_EQ(player.colour(0), glm::vec3(128 / 255.0f)) << channels;
        EXPECT_EQ(player.colour(1), glm::vec3(channels == 2 ? 64 / 255.0f : 1.0f)) << channels;
    }
    std::vector<File> faces = six_faces();
    faces[2].content = [&] {
        Image image{.size = {4, 4}, .channels = 1, .type = ChannelType::u8, .pixels = {}};
        image.pixels.assign(16, std::byte{128});
        return encoded("a.png", image);
    }();
    EXPECT_EQ(cube_colour(kSix, "vec3(0, 1, 0)", faces), glm::vec3(128));
    EXPECT_EQ(cube_colour(kSix, "vec3(1, 0.2, 0.2)", faces), glm::vec3(200, 0, 0));
}

TEST_F(InputFiles, ASoundIsItsSpectrumAndItsWaveAtTheTime) {
    Player player(kListens, {.files = {sound_file()}});
    EXPECT_EQ(player.renderer().graph().passes.back().runs, Runs::every_frame);
    player.draw(15);
    const glm::vec3 loud = player.colour();
    EXPECT_GT(loud.r, 0.8) << "441 Hz, in bin 20 of 21.5 Hz each";
    EXPECT_TRUE(loud.g == 64 / 255.0f || loud.g == 192 / 255.0f) << loud.g * 255;
    EXPECT_EQ(loud.b, 0.25f);
    EXPECT_EQ(player.colour(1), glm::vec3(512, 2, 1));
    player.draw(58);
    EXPECT_LT(player.colour().r, loud.r);
    EXPECT_EQ(player.colour().g, 128 / 255.0f);
    player.draw(90);
    EXPECT_EQ(player.colour().b, 0.5f) << "it plays again and again";
}

TEST_F(InputFiles, AFrameOfASoundIsTheSameInAStillAndInASequence) {
    const File song = sound_file();
    Player walks(kListens, {.files = {song}}), jumps(kListens, {.files = {song}});
    walks.draw_frames(0, 41);
    jumps.still(40 / 60.0);
    EXPECT_EQ(walks.floats(), jumps.floats());
}

TEST_F(InputFiles, AStepOfASimulationHearsTheSoundOfItsOwnTime) {
    const char* text =
        "uniform sampler2D song; //@ sound song.wav\n"
        "uniform sampler2D sum; //@ pass mainSum size=1 step=1/60\n"
        "void mainSum(out vec4 c, vec2 p) {\n"
        "    c = texelFetch(sum, ivec2(0), 0) + texelFetch(song, ivec2(20, 0), 0);\n"
        "}\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(sum, ivec2(0), 0); }\n";
    const File song = sound_file();
    Player fine(text, {.files = {song}, .fps = 60.0}), coarse(text, {.files = {song}, .fps = 4.0});
    fine.draw_frames(0, 61);
    coarse.draw_frames(0, 5);
    EXPECT_GT(fine.colour().r, 10.0);
    EXPECT_EQ(fine.colour(), coarse.colour());
}

TEST_F(InputFiles, APresetFillsAChannelWithASound) {
    Player player(
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(iChannel3, ivec2(20, 0), 0); }\n",
        {.preset = "[channels]\niChannel3 = { sound = \"song.wav\" }\n", .files = {sound_file()}});
    player.draw(20);
    EXPECT_GT(player.colour().r, 0.8);
}

}  // namespace
}  // namespace glint::conformance_input_files_test
