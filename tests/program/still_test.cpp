// `glint still` on files that are right: formats, odd text, time, simulations, and what it prints.
#include "media/image.h"
#include "report.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace glint::cli::still_test {
namespace {

using Json = nlohmann::json;

class Still : public InAFolder {
protected:
    Image picture(const fs::path& name) const { return read_image(folder() / name); }

    // `glint still` with --json, which must succeed.
    Json result(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "still");
        arguments.push_back("--json");
        return report_of(glint(std::move(arguments)));
    }
};

// A value of a picture, rows from the bottom; bytes from 0 to 255, or floats.
double value(const Image& image, int x, int y, int channel) {
    const auto index = (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.x) +
                        static_cast<std::size_t>(x)) *
                           static_cast<std::size_t>(image.channels) +
                       static_cast<std::size_t>(channel);
    if (image.type == ChannelType::u8) return std::to_integer<int>(image.pixels[index]);
    float result = 0;
    std::memcpy(&result, image.pixels.data() + index * sizeof result, sizeof result);
    return result;
}

constexpr std::string_view kCounter =
    "uniform sampler2D count; //@ pass mainCount\n"
    "void mainCount(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(p), 0) + vec4(1, "
    "iTimeDelta, 0, 0); }\n"
    "void mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(count, ivec2(p), 0).xy, "
    "float(iFrame), 1); }\n";

TEST_F(Still, WritesEveryKindOfFileUprightAndOfTheRightColour) {
    write("scene.frag", kGradient);
    struct Kind {
        std::string name;
        double one, tolerance;  // how 1.0 is kept, and how well
    };
    const Kind kinds[] = {{"a.png", 255, 0.5}, {"a.jpg", 255, 8},     {"a.jpeg", 255, 8},
                          {"a.PNG", 255, 0.5}, {"a.exr", 1, 1e-6},    {"a.tif", 1, 1e-6},
                          {"a.tiff", 1, 1e-6}, {"a.hdr", 1, 1 / 64.0}};  // 8-bit mantissa
    for (const auto& [name, one, tolerance] : kinds) {
        SCOPED_TRACE(name);
        still({"scene.frag", "-o", name});
        const Image image = picture(name);
        ASSERT_EQ(image.size, glm::ivec2(64, 36));
        ASSERT_EQ(image.channels, 3);
        for (const auto& [x, y] : {std::pair(1, 1), {60, 2}, {3, 33}, {62, 34}}) {
            EXPECT_NEAR(value(image, x, y, 0), one * (x + 0.5) / 64, tolerance + 1e-9);
            EXPECT_NEAR(value(image, x, y, 1), one * (y + 0.5) / 36, tolerance + 1e-9);
            EXPECT_NEAR(value(image, x, y, 2), one * 0.25, tolerance + 1e-9);
        }
    }
    EXPECT_EQ(names().size(), std::size(kinds) + 1);
}

TEST_F(Still, PrintsOneJsonObjectWithTheDocumentedKeys) {
    write("scene.frag", kGradient);
    const Json json = result({"scene.frag", "-o", "a.png", "--size", "64x36", "--time", "0.5"});
    EXPECT_EQ(json["output"], "a.png");
    EXPECT_EQ(json["size"], Json({64, 36}));
    EXPECT_EQ(json["frame"], 30);
    EXPECT_EQ(json["time"], 0.5);
    EXPECT_EQ(json["frames_rendered"], 1);
    EXPECT_EQ(json["specialised"], true);
    EXPECT_FALSE(json["renderer"].get<std::string>().empty());
    double sum = 0;
    for (const char* part : {"context", "load", "compile", "render", "read", "encode"}) {
        EXPECT_GE(json["ms"][part].get<double>(), 0.0) << part;
        sum += json["ms"][part].get<double>();
    }
    EXPECT_LE(sum, json["ms"]["total"].get<double>());
}

TEST_F(Still, PrintsOneLineOtherwise) {
    write("scene.frag", kGradient);
    const Outcome outcome = glint({"still", "scene.frag", "-o", "a.png", "--size", "64x36"});
    EXPECT_TRUE(outcome.out.starts_with("a.png  64x36  ")) << outcome.out;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
    EXPECT_EQ(outcome.err, "");
}

TEST_F(Still, ReplacesAnOlderPictureAndKeepsItsPermissions) {
    write("scene.frag", kGradient);
    write("a.png", "old");
    fs::permissions(folder() / "a.png", fs::perms::owner_read | fs::perms::owner_write);
    still({"scene.frag", "-o", "a.png"});
    EXPECT_EQ(picture("a.png").size, glm::ivec2(64, 36));
    EXPECT_EQ(fs::status(folder() / "a.png").permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("a.png", folder() / "link.png");
    still({"scene.frag", "-o", "link.png", "--size", "8x8"});
    EXPECT_TRUE(fs::is_symlink(folder() / "link.png"));
    EXPECT_EQ(picture("a.png").size, glm::ivec2(8, 8));
}

TEST_F(Still, AFileAloneIsDrawnToItsNameInTheCurrentFolder) {
    write("scenes/garden.frag", kGradient);
    write("garden.toml", "scene = \"scenes/garden.frag\"\nsize = [8, 4]\n");
    Command plain = command({"scenes/garden.frag", "--size", "64x36"});
    plain.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
    EXPECT_EQ(run(plain).code, 0);
    EXPECT_EQ(picture("garden.png").size, glm::ivec2(64, 36));
    plain.arguments = {"open", "garden.toml"};
    EXPECT_EQ(run(plain).code, 0);
    EXPECT_EQ(picture("garden.png").size, glm::ivec2(8, 4));
}

TEST_F(Still, OddTextDrawsWhatPlainTextDraws) {
    write("plain.frag", kGradient);
    still({"plain.frag", "-o", "plain.png"});
    const Image plain = picture("plain.png");
    const std::string body(kGradient);
    const std::string no_end = body.substr(0, body.size() - 1);
    const std::pair<std::string_view, std::string> cases[] = {
        {"CRLF", "// one\r\n\r\n" + no_end + "\r\n"},
        {"old Macintosh line ends", "// one\r" + no_end + "\r"},
        {"byte order mark", "\xEF\xBB\xBF" + body},
        {"no final newline", no_end},
        {"a comment and no final newline", body + "// the end"},
        {"version", "#version 300 es\n" + body},
        {"version and precision",
         "#version 300 es\nprecision highp float;\nprecision mediump "
         "int;\n" +
             body},
        {"less precision, which the site's drivers do not have",
         "precision mediump float;\nprecision lowp sampler2D;\n" + body},
        {"the host's uniforms",
         "uniform float iTime;\nuniform vec3 iResolution;\nuniform "
         "sampler2D iChannel0;\n" +
             body},
        {"several of them at once", "uniform float iTime, iTimeDelta;\n" + body},
        {"mainImage in a comment",
         "/* void mainImage(out vec4 c, in vec2 p) { */ // mainImage(\n" + body},
        {"mainImage behind a macro",
         "#define MAIN void mainImage(out vec4 c, in vec2 p)\nMAIN { c = "
         "vec4(p / iResolution.xy, 0.25, 1.0); }\n"},
        {"a macro named as the host might name something",
         "#define color wrong(\n#define coord wrong(\n#define result (\n" + body},
        {"a line of one megabyte", std::string("// ").append(1'000'000, 'x') + "\n" + body},
        {"comments in many languages", "// höhe 高さ \xF0\x9F\x8E\x84\n" + body},
        {"bytes that are not UTF-8, in a comment", "// h\xF6he\n" + body},
        {"a comment over two lines", "// one \\\nnot code (\n" + body},
        {"an identifier that Mesa reserves", "float packed(float x) { return x; }\n" + body},
        {"what is switched off", "#if 0\nvoid wrong(\n#endif\n" + body},
        {"old names",
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.25 + "
         "iGlobalTime, 1.0); }\n"},
    };
    for (const auto& [what, text] : cases) {
        SCOPED_TRACE(what);
        write("odd.frag", text);
        still({"odd.frag", "-o", "odd.png"});
        EXPECT_EQ(picture("odd.png").pixels, plain.pixels);
    }
}

TEST_F(Still, OfAChannelThatNothingFillsTakesItForWhatTheTextDoes) {
    const std::pair<const char*, const char*> cases[] = {
        {"texture(iChannel0, normalize(vec3(p, 1.0)))", "uniform samplerCube iChannel0"},
        {"texelFetch(iChannel0, ivec3(p, 0), 0)", "uniform sampler3D iChannel0"},
        {"texture(iChannel0, p)", "uniform sampler2D iChannel0"}};
    write("filled.toml", "scene = \"a.frag\"\n[channels]\niChannel0 = { noise = \"r 8\" }\n");
    for (const auto& [place, declaration] : cases) {
        write("a.frag",
              fmt::format("void mainImage(out vec4 c, in vec2 p) {{ c = {}; }}\n", place));
        const Outcome drawn = glint({"still", "a.frag", "-o", "a.png", "--size", "16x9"});
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        EXPECT_NE(drawn.err.find(declaration), drawn.err.npos) << drawn.err;
        still({"filled.toml", "-o", "b.png"});
    }
}

TEST_F(Still, TellsOfLoopsThatTheDriverHasEnded) {
    const auto said = [&](const char* loop) {
        write("a.frag", fmt::format("void mainImage(out vec4 c, in vec2 p) {{ float s = 0.0; {} "
                                    "c = vec4(s); }}\n",
                                    loop));
        return glint({"still", "a.frag", "-o", "a.png", "--size", "16x9"}).err;
    };
    const std::string long_one = said("\nfor (int i = 0; i < 70000; i++) s += 0.1;");
    EXPECT_EQ(long_one.find("a.frag:2:1: warning: llvmpipe has ended loops of image"), 0)
        << long_one;
    EXPECT_EQ(said("\nfor (float t = iTime; t < iTime + 50.0; t += 5e-4) s += 0.1;"), long_one);
    const char* late =
        "\nfor (float t = 0.0; t < 9e4; t += 1.0) { if (t > iTime * 3e4) break; s += t; }";
    EXPECT_EQ(said(late), "");
    const std::vector<std::string> four = {"still",  "a.frag", "-o",     "a.png",
                                           "--size", "16x9",   "--time", "4"};
    EXPECT_EQ(glint(four).err, long_one) << "of the time that is drawn";
    EXPECT_EQ(said("for (int i = 0; i < 70000; i++) { s += 0.1; if (s > 9.0) break; }"), "");
    EXPECT_EQ(said("\n//@ allow long-loop\nfor (int i = 0; i < 70000; i++) s += 0.1;"), "");
    // Also of a buffer that stands once it is drawn.
    write("b.frag",
          "float unread() { float s = 0.0; for (int i = 0; i < 70000; i++) s += 0.1; return s; }\n"
          "uniform sampler2D sums; //@ pass mainSums\n"
          "void mainSums(out vec4 c, in vec2 p) {\n"
          "    float s = p.x;\n    for (int i = 0; i < 70000; i++) s += 0.1;\n    c = vec4(s);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = texelFetch(sums, ivec2(0), 0) + (p.x < 0.0 ? unread() : 0.0);\n}\n");
    const std::string of_sums = glint({"still", "b.frag", "-o", "b.png", "--size", "16x9"}).err;
    EXPECT_EQ(of_sums.find("b.frag:5:5: warning: llvmpipe has ended loops of sums"), 0) << of_sums;
    EXPECT_EQ(glint({"still", "b.frag", "-o", "b.png", "--size", "16x9", "--time", "1e5"}).err,
              of_sums)
        << "six million frames before it have nothing to do with it";
}

TEST_F(Still, FindsFilesWhateverTheirNamesAndWhereverItRuns) {
    const std::string place = "a folder/ключ 🎄 'quoted'";
    write(place + "/lib.glsl", "vec4 a(vec2 p) { return vec4(p / iResolution.xy, 0.25, 1.0); }\n");
    write(place + "/schöner Baum.frag",
          "#include \"lib.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) { c = a(p); }\n");
    write(place + "/look.toml", "scene = \"schöner Baum.frag\"\nsize = [64, 36]\n");
    write("plain.frag", kGradient);
    still({"plain.frag", "-o", "plain.png"});
    const Image plain = picture("plain.png");

    still({place + "/schöner Baum.frag", "-o", place + "/größe 1.png"});
    EXPECT_EQ(picture(place + "/größe 1.png").pixels, plain.pixels);
    still({(folder() / place / "look.toml").string(), "-o", "absolute.png"});
    EXPECT_EQ(picture("absolute.png").pixels, plain.pixels);

    fs::create_symlink(place + "/look.toml", folder() / "linked.toml");
    fs::create_directory_symlink(place, folder() / "linked");
    still({"linked/look.toml", "-o", "through-a-folder.png"});
    EXPECT_EQ(picture("through-a-folder.png").pixels, plain.pixels);

    fs::create_symlink("plain.frag", folder() / "link.frag");
    still({"link.frag", "-o", "link.png"});
    EXPECT_EQ(picture("link.png").pixels, plain.pixels);

    Command inside = command({"still", "look.toml", "-o", "../../inside.png"});
    inside.folder = folder() / place;
    EXPECT_EQ(run(inside).code, 0);
    EXPECT_EQ(picture("inside.png").pixels, plain.pixels);
}

TEST_F(Still, AStatelessSceneDrawsOneFrameWhateverItsTime) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(iTime, float(iFrame), iTimeDelta, 1); "
          "}\n");
    for (const auto& [time, frame] : {std::pair("1e6", 60e6), {"0", 0.0}, {"0.5", 30.0}}) {
        SCOPED_TRACE(time);
        const Json json = result({"scene.frag", "-o", "a.exr", "--size", "1x1", "--time", time});
        EXPECT_EQ(json["frames_rendered"], 1);
        EXPECT_EQ(json["frame"].get<double>(), frame);
        EXPECT_FLOAT_EQ(static_cast<float>(value(picture("a.exr"), 0, 0, 0)), std::stof(time));
        EXPECT_EQ(value(picture("a.exr"), 0, 0, 1), frame);
    }
    // Frame numbers end long before times do.
    const Json json = result({"scene.frag", "-o", "a.exr", "--size", "1x1", "--time", "1e9"});
    EXPECT_EQ(json["frames_rendered"], 1);
    EXPECT_GT(json["frame"].get<double>(), 1e9);
}

TEST_F(Still, ASimulationIsPlayedFromTheStart) {
    write("scene.frag", kCounter);
    const Json json = result({"scene.frag", "-o", "frame.exr", "--size", "4x2", "--frame", "60"});
    EXPECT_EQ(json["frames_rendered"], 61);
    EXPECT_EQ(json["time"], 1.0);
    EXPECT_EQ(value(picture("frame.exr"), 0, 0, 0), 61);
    EXPECT_NEAR(value(picture("frame.exr"), 0, 0, 1), 61 / 60.0, 1e-5);
    EXPECT_EQ(value(picture("frame.exr"), 0, 0, 2), 60);
    still({"scene.frag", "-o", "time.exr", "--size", "4x2", "--time", "1"});
    EXPECT_EQ(bytes("frame.exr"), bytes("time.exr"));
    still({"scene.frag", "-o", "slow.exr", "--size", "4x2", "--time", "1", "--fps", "10"});
    EXPECT_EQ(value(picture("slow.exr"), 0, 0, 0), 11);
}

TEST_F(Still, SettlingDrawsMoreFramesWithTimeHeldStill) {
    write("scene.frag", kCounter);
    write("look.toml", "scene = \"scene.frag\"\ntime = 1\nsettle = 5\nsize = [4, 2]\n");
    const Json json = result({"look.toml", "-o", "a.exr"});
    EXPECT_EQ(json["time"], 1.0);
    EXPECT_EQ(json["frame"], 65);
    EXPECT_EQ(value(picture("a.exr"), 0, 0, 0), 66);
    still({"look.toml", "-o", "b.exr", "--size", "4x2", "--settle", "0"});
    EXPECT_EQ(value(picture("b.exr"), 0, 0, 0), 61);
    still({"scene.frag", "-o", "c.exr", "--size", "4x2", "--time", "1", "--settle", "5"});
    EXPECT_EQ(picture("c.exr").pixels, picture("a.exr").pixels);
}

TEST_F(Still, AStepSimulationIsTheSameAtEveryRate) {
    write("scene.frag",
          "uniform sampler2D count; //@ pass mainCount size=1x1 step=1/240\n"
          "void mainCount(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(p), 0) + 1.0; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(0), 0); }\n");
    for (const std::string fps : {"7", "60", "1000"}) {
        still({"scene.frag", "-o", fps + ".exr", "--size", "4x2", "--time", "0.5", "--fps", fps});
        EXPECT_EQ(value(picture(fps + ".exr"), 0, 0, 0), 120) << fps;
    }
}

TEST_F(Still, TilesGiveTheSameBytes) {
    write("scene.frag", kGradient);
    still({"scene.frag", "-o", "whole.png"});
    for (const std::string tile : {"1", "7", "64", "16384"}) {
        still({"scene.frag", "-o", "tiled.png", "--tile", tile});
        EXPECT_EQ(bytes("tiled.png"), bytes("whole.png")) << tile;
    }
}

TEST_F(Still, TilesAgreeBitForBitDerivativesTooAndAlsoWhereTheTextAsksForItsPlace) {
    // Odd sizes, so that the tiles' own corners do not stand on even pixels.
    write("scene.frag",
          "uniform sampler2D small; //@ pass mainSmall size=4x4\n"
          "void mainSmall(out vec4 c, in vec2 p) { c = vec4(p / 4.0, 0, 1); }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float a = sin(p.x * p.y * 0.01);\n"
          "    c = vec4(fwidth(a), gl_FragCoord.x / iResolution.x,\n"
          "             texture(small, p / iResolution.xy).y + dFdy(a), 1);\n}\n");
    for (const std::string samples : {"1", "3"}) {
        for (const std::string name : {"exr", "png"}) {
            still({"scene.frag", "-o", "whole." + name, "--size", "75x51", "--samples", samples});
            for (const std::string tile : {"1", "16", "31"}) {
                still({"scene.frag", "-o", "tiles." + name, "--size", "75x51", "--samples", samples,
                       "--tile", tile});
                EXPECT_EQ(bytes("tiles." + name), bytes("whole." + name)) << tile << " " << name;
            }
        }
    }
}

TEST_F(Still, APictureWiderThanAnyTextureIsDrawnInTiles) {
    write("scene.frag", kGradient);
    // Beyond 16384 on a side, and beyond what is drawn at once.
    for (const std::string name : {"huge.png", "huge.exr", "huge.tif"}) {
        SCOPED_TRACE(name);
        std::vector<std::string> words = {"scene.frag", "-o", name, "--size", "20000x600"};
        if (name != "huge.png")
            words.insert(words.end(), {"--compression", name == "huge.exr" ? "rle" : "lzw"});
        still(words);
        const std::string corner = "cd '" + folder().string() + "' && ffmpeg -nostdin -loglevel " +
                                   "error -i " + name +
                                   " -vf crop=2:1:19998:599,format=rgb24 -f rawvideo -y raw";
        if (name != "huge.png") continue;  // FFmpeg reads no large float pictures
        ASSERT_EQ(std::system(corner.c_str()), 0);
        const std::string raw = bytes("raw");
        ASSERT_EQ(raw.size(), 6u);
        EXPECT_EQ(static_cast<unsigned char>(raw[0]), 255);
        EXPECT_EQ(static_cast<unsigned char>(raw[1]), 0);
    }
    const Outcome too_wide = glint({"still", "scene.frag", "-o", "a.jpg", "--size", "70000x600"});
    EXPECT_EQ(too_wide.code, 1);
    EXPECT_NE(too_wide.err.find("65500"), std::string::npos) << too_wide.err;
    write("buffer.frag",
          "uniform sampler2D a; //@ pass mainA\n"
          "void mainA(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(a, ivec2(p), 0); }\n");
    const Outcome no_room = glint({"still", "buffer.frag", "-o", "a.png", "--size", "40000x1000"});
    EXPECT_EQ(no_room.code, 1);
    EXPECT_NE(no_room.err.find("a is 40000x1000 pixels; this driver draws up to"),
              std::string::npos)
        << no_room.err;
}

// Buffers that are as large as the picture cannot be drawn in tiles.
TEST_F(Still, ABufferForWhichThereIsNoRoomIsNamed) {
    write("scene.frag",
          "uniform sampler2D a; //@ pass mainA\n"
          "uniform sampler2D b; //@ pass mainB scale=0.25\n"
          "uniform bool useA; //@ on\n"
          "void mainA(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }\n"
          "void mainB(out vec4 c, in vec2 p) { c = vec4(0.5); }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = texelFetch(b, ivec2(p) / 4, 0);\n"
          "    if (useA) c += texelFetch(a, ivec2(p), 0);\n}\n");
    for (const std::string size : {"32768x18432", "16384x16384"}) {
        const Outcome outcome =
            glint({"still", "scene.frag", "-o", "a.png", "--size", size, "--samples", "4"});
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.err.find("a is " + size + " pixels"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("scale="), std::string::npos) << "tells what to do";
    }
    EXPECT_EQ(names(), std::set<std::string>{"scene.frag"});
    // Without that buffer it goes in tiles, samples or not.
    still({"scene.frag", "-o", "a.png", "--size", "20000x600", "--samples", "2", "--tweak",
           "useA=off"});
}

TEST_F(Still, TheShutterSpreadsSamplesOverTime) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(iTime < 2.005 ? 1.0 : 0.0, iTime, "
          "float(iFrame), 1); }\n");
    const std::vector<std::string> call = {
        "scene.frag", "-o", "a.exr",  "--time", "2",         "--fps", "50",
        "--samples",  "64", "--size", "4x2",    "--shutter", "180"};
    still(call);
    // Open for 10 ms; during half of it the red light is on. Encoded for a display, so the green
    // mean of about 2.005 is decoded first. Each of 64 parts has a sample: the halves are exact.
    const auto decoded = [](double v) { return std::pow((v + 0.055) / 1.055, 2.4); };
    EXPECT_NEAR(decoded(value(picture("a.exr"), 0, 0, 0)), 0.5, 1e-4);
    EXPECT_NEAR(value(picture("a.exr"), 0, 0, 1), 2.005, 1e-3);
    EXPECT_NEAR(value(picture("a.exr"), 0, 0, 2), 100, 1e-3);
    const std::string first = bytes("a.exr");
    still(call);
    EXPECT_EQ(bytes("a.exr"), first);
    const auto refused = [&](std::vector<std::string> words, const std::string& why) {
        words.insert(words.begin(), "still");
        const Outcome outcome = glint(words);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    refused({"scene.frag", "-o", "b.png", "--shutter", "90"}, "--samples");
    write("state.frag", kCounter);
    refused({"state.frag", "-o", "b.png", "--shutter", "90", "--samples", "4"}, "frames before it");
    EXPECT_FALSE(fs::exists(folder() / "b.png"));
}

TEST_F(Still, AFileIsKeptAsItIsTold) {
    write("scene.frag", kGradient);
    still({"scene.frag", "-o", "float.exr", "--size", "256x256", "--compression", "none"});
    still({"scene.frag", "-o", "half.exr", "--size", "256x256", "--compression", "none", "--format",
           "half"});
    EXPECT_LT(fs::file_size(folder() / "half.exr"), fs::file_size(folder() / "float.exr") * 3 / 5);
    EXPECT_NEAR(value(picture("half.exr"), 200, 30, 0), 200.5 / 256, 1.0 / 2048);  // 11 bits
    for (const auto& [option, given] :
         {std::pair("--format", "double"), {"--compression", "zipp"}, {"--quality", "50"}}) {
        const Outcome outcome = glint({"still", "scene.frag", "-o", "b.exr", option, given});
        EXPECT_EQ(outcome.code, 2) << option;
        EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(fs::exists(folder() / "b.exr"));
}

TEST_F(Still, EverySizeIsDrawn) {
    write("scene.frag", kGradient);
    for (const auto& [w, h] : {std::pair(1, 1), {7, 3}, {1, 512}, {512, 1}, {333, 5}}) {
        SCOPED_TRACE(w);
        const std::string size = std::to_string(w) + "x" + std::to_string(h);
        for (const std::string name : {"a.png", "a.exr", "a.jpg"}) {
            still({"scene.frag", "-o", name, "--size", size});
            EXPECT_EQ(picture(name).size, glm::ivec2(w, h));
        }
        EXPECT_NEAR(value(picture("a.exr"), w - 1, h - 1, 0), (w - 0.5) / w, 1e-6);
        EXPECT_NEAR(value(picture("a.exr"), w - 1, h - 1, 1), (h - 0.5) / h, 1e-6);
    }
}

TEST_F(Still, SamplesAverageInLinearLight) {
    // The left half of every pixel is black, the right half white.
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(step(0.5, fract(p.x))); }\n");
    still({"scene.frag", "-o", "a.exr", "--samples", "64"});
    // Half the light, encoded for a display (IEC 61966-2-1); 64 positions halve within 1/64.
    const double half = 1.055 * std::pow(0.5, 1 / 2.4) - 0.055;
    EXPECT_NEAR(value(picture("a.exr"), 30, 20, 0), half, 0.01);
    still({"scene.frag", "-o", "a.png", "--samples", "64"});
    EXPECT_NEAR(value(picture("a.png"), 30, 20, 0), 255 * half, 3);
}

constexpr std::string_view kBits =
    "uniform float a; //@ 0.25 [0, 1]\n"
    "uniform sampler2D bits; //@ pass mainBits\n"
    "uniform sampler2D more; //@ pass mainBits\n"
    // Every exponent from 2^-126 on, with many mantissas; both signs.
    "uint word(vec2 p, uint c) { uint x = uint(p.x), y = uint(p.y);\n"
    "    return (c & 1u) << 31 | (1u + (x * 36u + y + c * 7u) % 254u) << 23 | (x * 77777u + y * "
    "1234567u) "
    "& 0x7fffffu; }\n"
    "void mainBits(out vec4 c, out vec4 d, in vec2 p) {\n"
    "    c = uintBitsToFloat(uvec4(word(p, 0u), word(p, 1u), word(p, 2u), word(p, 3u)));\n"
    "    d = vec4(p, a, -1e30); }\n"
    "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(bits, ivec2(p), 0) + texelFetch(more, "
    "ivec2(p), 0); }\n";

std::uint32_t expected_word(std::uint32_t x, std::uint32_t y, std::uint32_t c) {
    return (c & 1u) << 31 | (1u + (x * 36u + y + c * 7u) % 254u) << 23 |
           ((x * 77777u + y * 1234567u) & 0x7fffffu);
}

TEST_F(Still, ABufferInAnExrIsExactAndTellsWhereItComesFrom) {
    write("scene.frag", kBits);
    write("look.toml", "scene = \"scene.frag\"\ntime = 2\n[tweaks]\na = 0.75\n");
    still({"look.toml", "-o", "bits.exr", "--pass", "bits"});
    const Image image = picture("bits.exr");
    ASSERT_EQ(image.channels, 4);
    ASSERT_EQ(image.size, glm::ivec2(64, 36));
    std::vector<std::uint32_t> words(image.pixels.size() / 4);
    std::memcpy(words.data(), image.pixels.data(), image.pixels.size());
    int different = 0;
    for (std::uint32_t i = 0; i < words.size(); ++i) {
        different += words[i] != expected_word(i / 4 % 64, i / 4 / 64, i % 4);
    }
    EXPECT_EQ(different, 0);
    still({"look.toml", "-o", "more.exr", "--pass", "more"});
    EXPECT_EQ(value(picture("more.exr"), 5, 9, 0), 5.5);
    EXPECT_EQ(value(picture("more.exr"), 5, 9, 2), 0.75);
    EXPECT_EQ(static_cast<float>(value(picture("more.exr"), 5, 9, 3)), -1e30f);

    for (const std::string name : {"bits.exr", "look.png"}) {
        if (name == "look.png") still({"look.toml", "-o", name});
        const std::string file = bytes(name);
        for (const std::string part :
             {"Software", "glint ", "glint:scene", "scene.frag", "glint:preset", "look.toml",
              "glint:time", "glint:frame", "glint:renderer", "glint:tweak:a", "0.75"}) {
            EXPECT_NE(file.find(part), std::string::npos) << name << " " << part;
        }
        EXPECT_EQ(file.find(folder().string()), std::string::npos) << "names a folder";
    }
}

TEST_F(Still, APassInAPngIsWhatADisplayWouldShow) {
    write("scene.frag",
          "uniform sampler2D a; //@ pass mainA size=2x1\n"
          "void mainA(out vec4 c, in vec2 p) { c = p.x < 1.0 ? vec4(-5, 0.5, 7, 0) : vec4(1); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(a, ivec2(0), 0); }\n");
    still({"scene.frag", "-o", "a.png", "--pass", "a"});
    const Image image = picture("a.png");
    ASSERT_EQ(image.size, glm::ivec2(2, 1));
    EXPECT_EQ(value(image, 0, 0, 0), 0);
    EXPECT_EQ(value(image, 0, 0, 1), 128);
    EXPECT_EQ(value(image, 0, 0, 2), 255);
    still({"scene.frag", "-o", "b.png"});
    still({"scene.frag", "-o", "c.png", "--pass", "image"});
    EXPECT_EQ(bytes("b.png"), bytes("c.png"));
}

TEST_F(Still, APresetFillsChannelsAndReplaysEvents) {
    fs::create_directory(folder() / "textures");
    Image wood{.size = {2, 2}, .channels = 3, .type = ChannelType::u8, .pixels = {}};
    for (const int v : {10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120}) {
        wood.pixels.push_back(static_cast<std::byte>(v));
    }
    write_image(folder() / "textures" / "wood.png", wood);
    write("pasted.frag",
          "uniform vec3 tint; //@ #000000\n"
          "uniform sampler2D count; //@ pass mainCount size=1x1\n"
          "void mainCount(out vec4 c, in vec2 p) { c = vec4(0.125); }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    int i = int(p.x);\n"
          "    c = i == 0 ? texelFetch(iChannel0, ivec2(1, 0), 0)\n"
          "      : i == 1 ? texelFetch(iChannel1, ivec2(3, 5), 0)\n"
          "      : i == 2 ? vec4(texelFetch(iChannel2, ivec2(38, 0), 0).x, texelFetch(iChannel2, "
          "ivec2(40, 0), 0).x, texelFetch(iChannel2, ivec2(38, 2), 0).x, 1)\n"
          "      : i == 3 ? texelFetch(iChannel3, ivec2(0), 0)\n"
          "      : i == 4 ? iMouse\n"
          "      : i == 5 ? vec4(tint, 1)\n"
          "      : vec4(iChannelResolution[0].xy, iChannelResolution[2].xy);\n"
          "    c += 0.0 * texelFetch(count, ivec2(0), 0);\n"
          "}\n");
    write("look.toml",
          "scene = \"pasted.frag\"\nsize = [8, 4]\ntime = 1\n"
          "[tweaks]\ntint = \"#ff8000\"\n"
          "[channels]\n"
          "iChannel0 = { image = \"textures/wood.png\", vflip = true }\n"
          "iChannel1 = { noise = \"rgba 16\" }\n"
          "iChannel2 = { keyboard = true }\n"
          "iChannel3 = { buffer = \"count\" }\n"
          "[[events]]\nt = 0.25\nkey = \"up\"\ndown = true\n"
          "[[events]]\nt = 0.5\nmouse = [0.5, 0.25]\ndown = true\n"
          "[[events]]\nt = 1.5\nkey = \"down\"\ndown = true\n");
    still({"look.toml", "-o", "a.exr", "--size", "8x4"});
    const Image image = picture("a.exr");
    const auto expect = [&](int x, std::vector<double> wanted) {
        for (std::size_t c = 0; c < wanted.size(); ++c) {
            EXPECT_NEAR(value(image, x, 0, static_cast<int>(c)), wanted[c], 1e-6)
                << "column " << x << " channel " << c;
        }
    };
    expect(0, {40 / 255.0, 50 / 255.0, 60 / 255.0});
    EXPECT_NE(value(image, 1, 0, 0), value(image, 1, 0, 1));
    expect(2, {1, 0, 1});
    expect(3, {0.125, 0.125, 0.125});
    expect(4, {4, 1, 4});
    expect(5, {1, 128 / 255.0, 0});
    expect(6, {2, 2, 256});
    still({"look.toml", "-o", "b.exr", "--size", "8x4", "--time", "0.25"});
    EXPECT_EQ(value(picture("b.exr"), 2, 0, 0), 1);
    EXPECT_EQ(value(picture("b.exr"), 4, 0, 0), 0);
    still({"look.toml", "-o", "c.exr", "--size", "8x4", "--tweak", "tint=#0000ff"});
    EXPECT_EQ(value(picture("c.exr"), 5, 0, 2), 1);
}

}  // namespace
}  // namespace glint::cli::still_test
