// `glint sequence`: its frames are the stills, shared out, resumed, filmed and piped.
#include "sequence.h"

#include "media/image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>
#include <tuple>

namespace glint::cli::sequence_test {
namespace {

using Json = nlohmann::json;
using namespace std::chrono_literals;

// Depends on time and frame, and moves.
constexpr std::string_view kMoving =
    "uniform float level; //@ 0.5 [0, 1]\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    c = vec4(fract(p.x / 40.0 + iTime), level, float(iFrame) / 255.0, 1);\n}\n";

// Counts its frames in a buffer, and steps of 1/240 s in another.
constexpr std::string_view kCounting =
    "uniform sampler2D frames; //@ pass mainFrames size=1x1\n"
    "uniform sampler2D steps;  //@ pass mainSteps size=1x1 step=1/240\n"
    "void mainFrames(out vec4 c, in vec2 p) { c = texelFetch(frames, ivec2(0), 0) + 1.0; }\n"
    "void mainSteps(out vec4 c, in vec2 p) { c = texelFetch(steps, ivec2(0), 0) + 1.0; }\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    c = vec4(texelFetch(frames, ivec2(0), 0).r, texelFetch(steps, ivec2(0), 0).r, iTime, 1);\n"
    "}\n";

class Sequence : public SequenceTest {
protected:
    Sequence() : SequenceTest({"sequence"}, "40x24") {}

    std::string pixels(const std::string& name) const {
        const Image image = read_image(folder() / name);
        return {reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size()};
    }
};

TEST_F(Sequence, FrameKIsTheStillOfFrameK) {
    write("moving.frag", kMoving);
    write("counting.frag", kCounting);
    for (const std::string scene : {"moving", "counting"}) {
        for (const std::string kind : {"png", "exr"}) {
            SCOPED_TRACE(scene + " " + kind);
            const std::string pattern = scene + "%03d." + kind;
            EXPECT_EQ(sequence({scene + ".frag", "-o", pattern, "--frames", "3:11:4", "--fps", "25",
                                "--samples", "2"})
                          .code,
                      0);
            for (const int k : {3, 7, 11}) {
                const std::string still_name = "still." + kind;
                still({scene + ".frag", "-o", still_name, "--frame", std::to_string(k), "--fps",
                       "25", "--samples", "2", "--size", "40x24"});
                EXPECT_EQ(pixels(fmt::format("{}{:03}.{}", scene, k, kind)), pixels(still_name));
            }
        }
    }
    EXPECT_EQ(names().size(), 2u + 2 * 2 * 3 + 2);
}

TEST_F(Sequence, TheShutterSmearsWhatMovesAndAgreesWithTheStill) {
    // A light of 4 pixels that moves by 16 a frame: during half a frame, by 8.
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float x = p.x - 8.0 - 400.0 * iTime;\n"
          "    c = vec4(vec3(x >= 0.0 && x < 4.0), 1);\n}\n");
    const std::vector<std::string> words = {"scene.frag", "--fps", "25",     "--samples", "64",
                                            "--shutter",  "180",   "--size", "60x2"};
    auto all = words;
    all.insert(all.end(), {"-o", "%d.exr", "--frames", "0:2"});
    ASSERT_EQ(sequence(all).code, 0);
    for (int k = 0; k < 3; ++k) {
        SCOPED_TRACE(k);
        const Image image = read_image(folder() / fmt::format("{}.exr", k));
        double sum = 0;
        for (int x = 0; x < 60; ++x) {
            float encoded = 0;
            std::memcpy(&encoded, image.pixels.data() + x * 12, sizeof encoded);
            const double light =
                encoded < 0.04045F ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
            // Of the 8 places where the light begins, one after the other, how many reach x.
            const double from_start = x + 0.5 - 8 - 16 * k;
            const double share = std::clamp(std::min(from_start, 12 - from_start), 0.0, 4.0) / 8;
            // Two samples of 64, and the corners of the ramps, which a pixel's width rounds off.
            EXPECT_NEAR(light, share, 0.05) << x;
            sum += light;
        }
        EXPECT_NEAR(sum, 4.0, 2 / 64.0) << "light is neither lost nor won";
        auto one = words;
        one.insert(one.end(), {"-o", "still.exr", "--frame", std::to_string(k)});
        still(one);
        EXPECT_EQ(pixels("still.exr"), pixels(fmt::format("{}.exr", k)));
    }
    all.push_back("--resume");
    EXPECT_EQ(result(all)["skipped"], 3);
    *std::ranges::find(all, "180") = "90";
    EXPECT_EQ(result(all)["skipped"], 0) << "another shutter is another sequence";
}

TEST_F(Sequence, TheShutterNeedsSamplesAndASceneWithoutState) {
    write("moving.frag", kMoving);
    write("counting.frag", kCounting);
    const std::vector<std::tuple<std::string, std::string, std::string>> cases = {
        {"moving.frag", "1", "--samples"}, {"counting.frag", "4", "frames before it"}};
    for (const auto& [scene, samples, why] : cases) {
        for (const std::string output : {"%d.png", "film.mp4"}) {
            const Outcome outcome = sequence(
                {scene, "-o", output, "--frames", "0:3", "--shutter", "180", "--samples", samples});
            EXPECT_EQ(outcome.code, 2) << scene;
            EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
        }
    }
    EXPECT_EQ(names(), (std::set<std::string>{"counting.frag", "moving.frag"}));
}

// The most memory that a process has held, KiB.
long peak_memory(pid_t process) {
    std::ifstream in(fmt::format("/proc/{}/status", process));
    long kib = 0;
    for (std::string line; std::getline(in, line);) {
        if (std::sscanf(line.c_str(), "VmHWM: %ld kB", &kib) == 1) break;
    }
    return kib;
}

TEST_F(Sequence, AMilliardFramesBeginAtOnce) {
    write("scene.frag", kMoving);
    for (const std::string shard : {"1/1", "2/3"}) {
        Process process(command({"sequence", "scene.frag", "-o", "%d.png", "--frames",
                                 "0:1000000000", "--size", "8x8", "--shard", shard, "--resume"}));
        const std::string second = shard == "1/1" ? "1.png" : "4.png";
        while (process.runs() && !fs::exists(folder() / second)) std::this_thread::sleep_for(1ms);
        ASSERT_TRUE(process.runs()) << process.wait().err;
        EXPECT_LT(peak_memory(process.id()), 500'000);  // a list of them would be 4 GB
    }
    // The last ones have numbers of their own.
    EXPECT_EQ(result({"scene.frag", "-o", "%d.png", "--frames", "1073741822:1073741824"})["frames"],
              3);
    EXPECT_NE(bytes("1073741823.png"), bytes("1073741824.png"));
    EXPECT_EQ(sequence({"scene.frag", "-o", "%d.png", "--frames", "0:1073741825"}).code, 2);
}

TEST_F(Sequence, SevenSharesGiveTheBytesOfOneProcess) {
    write("scene.frag", kCounting);
    EXPECT_EQ(result({"scene.frag", "-o", "one%d.png", "--frames", "0:19"})["frames"], 20);
    int drawn = 0;
    for (int k = 1; k <= 7; ++k) {
        drawn += result({"scene.frag", "-o", "all%d.png", "--frames", "0:19", "--shard",
                         fmt::format("{}/7", k)})["frames"]
                     .get<int>();
    }
    EXPECT_EQ(drawn, 20);
    for (int k = 0; k < 20; ++k) {
        EXPECT_EQ(bytes(fmt::format("all{}.png", k)), bytes(fmt::format("one{}.png", k))) << k;
    }
    const Json none =
        result({"scene.frag", "-o", "none%d.png", "--frames", "0:19", "--shard", "30/32"});
    EXPECT_EQ(none["frames"], 0) << "there may be more shares than frames";
}

TEST_F(Sequence, ResumeLeavesWhatIsWholeAndDrawsTheRest) {
    write("scene.frag", kMoving);
    for (const std::string kind : {"png", "exr"}) {
        SCOPED_TRACE(kind);
        const auto frame = [&](int k) { return fmt::format("{}.{}", k, kind); };
        const std::vector<std::string> all = {"scene.frag", "-o",  "%d." + kind,
                                              "--frames",   "0:5", "--resume"};
        EXPECT_EQ(result(all)["skipped"], 0);
        EXPECT_EQ(result(all)["skipped"], 6);
        const std::string second = bytes(frame(2));
        const std::string fourth = bytes(frame(4));
        fs::remove(folder() / frame(2));
        write(frame(4), fourth.substr(0, fourth.size() - 30));  // cut by another program
        EXPECT_EQ(result(all)["skipped"], 4);
        EXPECT_EQ(bytes(frame(2)), second);
        EXPECT_EQ(bytes(frame(4)), fourth);
        // Another scene, size or look is another sequence.
        auto other = all;
        other.insert(other.end(), {"--tweak", "level=0.25"});
        EXPECT_EQ(result(other)["skipped"], 0);
        EXPECT_EQ(result(other)["skipped"], 6);
        EXPECT_EQ(result(all)["skipped"], 0);
        write("scene.frag", std::string(kMoving) + "// changed\n");
        EXPECT_EQ(result(all)["skipped"], 0);
        write("scene.frag", kMoving);
    }
}

TEST_F(Sequence, KilledAndResumedItEndsWithTheSameBytes) {
    write("scene.frag", kMoving);
    const std::vector<std::string> words = {"sequence", "scene.frag", "-o",     "%03d.png",
                                            "--frames", "0:39",       "--size", "320x180"};
    ASSERT_EQ(glint(words).code, 0);
    std::vector<std::string> expected;
    for (int k = 0; k < 40; ++k) expected.push_back(bytes(fmt::format("{:03}.png", k)));
    for (const int signal : {SIGKILL, SIGINT, SIGTERM}) {
        for (int k = 0; k < 40; ++k) fs::remove(folder() / fmt::format("{:03}.png", k));
        Process process(command(words));
        while (process.runs() && !fs::exists(folder() / "005.png")) {
            std::this_thread::sleep_for(1ms);
        }
        process.signal(signal);
        process.wait();
        // Whatever has a name is whole, and nothing else lies about.
        for (const std::string& name : names()) {
            if (name == "scene.frag") continue;
            EXPECT_EQ(bytes(name), expected.at(static_cast<std::size_t>(std::stoi(name)))) << name;
        }
        auto resumed = words;
        resumed.push_back("--resume");
        EXPECT_EQ(glint(resumed).code, 0);
        for (int k = 0; k < 40; ++k) {
            EXPECT_EQ(bytes(fmt::format("{:03}.png", k)), expected[static_cast<std::size_t>(k)]);
        }
    }
}

TEST_F(Sequence, AFullDiskEndsItWithAWordAndWholeFiles) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    uvec3 v = uvec3(p, iFrame) * 1664525u + 1013904223u;\n"
          "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;\n"
          "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;\n"
          "    c = iFrame < 3 ? vec4(0) : vec4(vec3(v >> 8u) / 16777216.0, 1);\n}\n");
    for (const std::string name : {"%d.png", "film.mp4", "film.webm", "film.mov", "film.gif"}) {
        Command full =
            command({"sequence", "scene.frag", "-o", name, "--frames", "0:9", "--size", "256x256"});
        full.largest_file = 20'000;
        const Outcome outcome = run(full);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.err.find("annot write"), std::string::npos) << outcome.err;
    }
    for (const std::string& name : names()) {
        EXPECT_TRUE(name == "scene.frag" || std::stoi(name) < 3) << name;
    }
}

// Colour is kept for squares of four pixels.
TEST_F(Sequence, AFilmOfOddSidesRepeatsItsLastColumnAndRow) {
    write("scene.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.8, 0.5, 0.3, 1); }\n");
    for (const std::string name : {"film.mp4", "film.webm", "film.mov"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(result({"scene.frag", "-o", name, "--frames", "0:2", "--size", "17x5"})["size"],
                  Json({18, 6}));
        const std::string decode = fmt::format(
            "cd '{}' && ffmpeg -nostdin -loglevel error -i {} -vf format=rgb24 -f rawvideo -y raw",
            folder().string(), name);
        ASSERT_EQ(std::system(decode.c_str()), 0);
        const std::string raw = bytes("raw");
        ASSERT_EQ(raw.size(), 3u * 18 * 6 * 3);
        for (std::size_t i = 0; i < raw.size(); i += 3)
            ASSERT_NEAR(static_cast<unsigned char>(raw[i]), 204, 6) << i / 3;
    }
}

TEST_F(Sequence, AFilmHasEveryFrameInItsColours) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    vec2 u = p / iResolution.xy;\n"
          "    c = vec4(u.x < 0.5 ? vec3(0.8, 0.2, 0.1) : vec3(0.1, 0.3, u.y < 0.5 ? 0.9 : 0.2), "
          "1);\n}\n");
    for (const std::string name : {"film.mp4", "film.webm", "film.mov", "film.gif"}) {
        SCOPED_TRACE(name);
        ASSERT_EQ(result({"scene.frag", "-o", name, "--frames", "0:11", "--fps", "25", "--size",
                          "128x96"})["frames"],
                  12);
        const std::string decode = fmt::format(
            "cd '{}' && ffmpeg -nostdin -loglevel error -i {} -vf format=rgb24 -f rawvideo -y raw",
            folder().string(), name);
        ASSERT_EQ(std::system(decode.c_str()), 0);
        const std::string raw = bytes("raw");
        ASSERT_EQ(raw.size(), 12u * 128 * 96 * 3);
        const auto value = [&](int x, int y, int channel) {
            return static_cast<unsigned char>(
                raw[static_cast<std::size_t>(((11 * 96 + y) * 128 + x) * 3 + channel)]);
        };
        // The codecs' own rounding, far from edges; upside down or with another colour matrix it
        // would be tens.
        EXPECT_NEAR(value(20, 20, 0), 204, 5);
        EXPECT_NEAR(value(20, 20, 1), 51, 5);
        EXPECT_NEAR(value(100, 10, 2), 51, 5);
        EXPECT_NEAR(value(100, 80, 2), 230, 5);
    }
    // The same call gives the same bytes.
    const std::string before = bytes("film.mp4");
    sequence(
        {"scene.frag", "-o", "film.mp4", "--frames", "0:11", "--fps", "25", "--size", "128x96"});
    EXPECT_EQ(bytes("film.mp4"), before);
}

// Where there is but one, nothing is compared.
TEST_F(Sequence, AFilmHasTheSameBytesWhateverTheNumberOfProcessors) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    vec2 u = p / 40.0 + iTime * vec2(3, 2);\n"
          "    c = vec4(0.5 + 0.5 * sin(u.x * u.y + iTime * 9.0), fract(u), 1);\n}\n");
    cpu_set_t all, one;
    ASSERT_EQ(::sched_getaffinity(0, sizeof(all), &all), 0);
    CPU_ZERO(&one);
    CPU_SET(::sched_getcpu(), &one);
    for (const std::string kind : {".mp4", ".webm"}) {
        const auto film_on = [&](const cpu_set_t& processors, const std::string& name) {
            EXPECT_EQ(::sched_setaffinity(0, sizeof(processors), &processors), 0);
            sequence({"scene.frag", "-o", name + kind, "--frames", "0:4", "--size", "320x180"});
            return bytes(name + kind);
        };
        const std::string on_all = film_on(all, "all");
        EXPECT_TRUE(film_on(one, "one") == on_all) << kind;
    }
    ::sched_setaffinity(0, sizeof(all), &all);
}

// Players show what is to stand for less than 1/50 s for 1/10 s, as FFmpeg's reader does.
TEST_F(Sequence, AGifLastsAsLongAsItsFramesAtEveryRate) {
    write("scene.frag", kMoving);
    for (const int rate : {25, 60, 150}) {
        result({"scene.frag", "-o", "film.gif", "--frames", fmt::format("0:{}", rate - 1), "--fps",
                fmt::format("{}", rate), "--size", "16x16"});
        const std::string probe = fmt::format(
            "cd '{}' && ffprobe -v error -show_entries format=duration -of csv=p=0 film.gif "
            ">seconds",
            folder().string());
        ASSERT_EQ(std::system(probe.c_str()), 0);
        EXPECT_NEAR(std::stod(bytes("seconds")), 1.0, 0.021) << rate << " Hz";  // a frame
    }
}

TEST_F(Sequence, ResumeKnowsAnExtensionHoweverItIsWritten) {
    write("scene.frag", kMoving);
    const std::vector<std::string> words = {"scene.frag", "-o",  "%d.PNG",
                                            "--frames",   "0:2", "--resume"};
    EXPECT_EQ(result(words)["frames"], 3);
    EXPECT_EQ(result(words)["skipped"], 3);
}

TEST_F(Sequence, PicturesOfOthersBecomeTheFilmThatDrawingGives) {
    write("scene.frag", std::string(kMoving) +
                            "vec2 mainSound(int s, float t) { return vec2(sin(t * 2000.0)); }\n");
    const std::vector<std::string> all = {"scene.frag", "--frames", "3:22", "--fps", "20"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), all.begin(), all.end());
        return more;
    };
    result(with({"-o", "drawn.mp4"}));
    result(with({"-o", "p%02d.png", "--shard", "1/2"}));
    const Outcome half = sequence(with({"--from-pictures", "p%02d.png", "-o", "joined.mp4"}));
    EXPECT_EQ(half.code, 6);
    EXPECT_TRUE(half.out.starts_with("4\n6\n8\n")) << half.out;
    EXPECT_NE(half.err.find("10 of 20 pictures are missing"), std::string::npos) << half.err;
    EXPECT_FALSE(fs::exists(folder() / "joined.mp4"));

    result(with({"-o", "p%02d.png", "--shard", "2/2"}));
    EXPECT_EQ(result(with({"--from-pictures", "p%02d.png"}))["missing"].size(), 0);
    EXPECT_EQ(result(with({"--from-pictures", "p%02d.png", "-o", "joined.mp4"}))["frames"], 20);
    EXPECT_EQ(bytes("joined.mp4"), bytes("drawn.mp4"));

    const std::string fifth = bytes("p05.png");
    const auto missing = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--from-pictures", "p%02d.png", "--json"});
        return report_of(sequence(with(more)), 6)["missing"];
    };
    write("p05.png", fifth.substr(0, fifth.size() / 2));
    EXPECT_EQ(missing({}), Json({5}));
    write("p05.png", bytes("p06.png"));
    EXPECT_EQ(missing({}), Json({5}));
    write("p05.png", fifth);
    EXPECT_EQ(missing({"--tweak", "level=0.1"}).size(), 20);
}

// A run has read its files when it begins; what happens to them then does not matter to it.
TEST_F(Sequence, APresetThatVanishesMeanwhileIsMissedByTheNextRunOnly) {
    write("scene.frag", kMoving);
    write("scene.toml", "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.7\n");
    const std::vector<std::string> words = {"sequence", "scene.toml", "-o",     "%02d.png",
                                            "--frames", "0:59",       "--size", "320x180"};
    Process process(command(words));
    while (process.runs() && !fs::exists(folder() / "00.png")) std::this_thread::sleep_for(1ms);
    fs::remove(folder() / "scene.toml");
    fs::remove(folder() / "scene.frag");
    EXPECT_EQ(process.wait().code, 0);
    EXPECT_EQ(names().size(), 60u);
    auto resumed = words;
    resumed.push_back("--resume");
    EXPECT_EQ(glint(resumed).code, 4);
    EXPECT_EQ(names().size(), 60u) << "what was done is kept";
}

TEST_F(Sequence, AFullDiskInTheMiddleIsResumedToTheSameBytes) {
    const fs::path disk = folder() / "disk";
    fs::create_directory(disk);
    if (!mount_small_disk(disk, "200k")) GTEST_SKIP() << "mounting needs root";
    write("scene.frag", kMoving);
    const auto words = [&](const std::string& to) {
        return std::vector<std::string>{"sequence",       "scene.frag", "-o",
                                        to + "/%02d.exr", "--frames",   "0:19",
                                        "--size",         "80x60",      "--resume"};
    };
    EXPECT_EQ(glint(words(".")).code, 0);
    const Outcome full = glint(words("disk"));
    EXPECT_EQ(full.code, 1);
    EXPECT_TRUE(full.err.starts_with("error: Cannot write disk/")) << full.err;
    std::size_t kept = 0;
    for (const auto& entry : fs::directory_iterator(disk)) {
        EXPECT_EQ(bytes_of(entry.path()), bytes(entry.path().filename()));
        ++kept;
    }
    EXPECT_GT(kept, 0u);
    EXPECT_LT(kept, 20u);
    EXPECT_TRUE(grow_small_disk(disk, "8m"));
    EXPECT_EQ(glint(words("disk")).code, 0);
    for (int k = 0; k < 20; ++k) {
        const std::string name = fmt::format("{:02}.exr", k);
        EXPECT_EQ(bytes("disk/" + name), bytes(name)) << k;
    }
    unmount(disk);
}

TEST_F(Sequence, AFolderThatNobodyMayWriteEndsItWithAWord) {
    write("scene.frag", kMoving);
    const std::string sealed = "/proc/sys/kernel/%d.png";  // also where root runs the tests
    const Outcome outcome = sequence({"scene.frag", "-o", sealed, "--frames", "0:3"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(outcome.err.starts_with("error: Cannot write /proc/sys/kernel/")) << outcome.err;
}

TEST_F(Sequence, AnEncoderThatWritesNothingLeavesNoFilm) {
    write("scene.frag", kMoving);
    write("bin/ffmpeg", "#!/bin/sh\ncat >/dev/null\n");
    fs::permissions(folder() / "bin/ffmpeg", fs::perms::owner_all);
    Command asked = command({"sequence", "scene.frag", "-o", "film.mp4", "--frames", "0:3"});
    asked.environment.emplace_back(
        "PATH", (folder() / "bin").string() + ":" + std::string(std::getenv("PATH")));
    const Outcome outcome = run(asked);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(outcome.err.ends_with("Cannot write film.mp4: FFmpeg gave up.\n")) << outcome.err;
    EXPECT_FALSE(fs::exists(folder() / "film.mp4"));
}

TEST_F(Sequence, RawFramesGoToStdoutTopRowFirst) {
    write("scene.frag", kGradient);
    Command piped =
        command({"sequence", "scene.frag", "-o", "-", "--frames", "0:2", "--size", "8x4"});
    write("raw", "");
    piped.out_to = (folder() / "raw").string();
    const Outcome outcome = run(piped);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string raw = bytes("raw");
    ASSERT_EQ(raw.size(), 3u * 8 * 4 * 3);
    EXPECT_EQ(static_cast<unsigned char>(raw[1]), 223);  // green of the top row: 3.5 / 4
    EXPECT_EQ(static_cast<unsigned char>(raw[3 * 8 * 3 + 1]), 32);
}

TEST_F(Sequence, AReaderOfStdoutThatGoesAwayOrIsFullEndsIt) {
    write("scene.frag", kMoving);
    write("script", fmt::format("cd '{}' && '{}' sequence scene.frag -o - --size 320x180 2>err "
                                "| head -c 1000 >head\nexit ${{PIPESTATUS[0]}}\n",
                                folder().string(), GLINT_BINARY));
    const int status = std::system(("bash '" + (folder() / "script").string() + "'").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 128 + SIGPIPE) << "as every program in a pipe";
    EXPECT_EQ(bytes("head").size(), 1000u);
    EXPECT_EQ(bytes("err"), "");
    Command full = command({"sequence", "scene.frag", "-o", "-", "--frames", "0:3"});
    full.out_to = "/dev/full";
    const Outcome outcome = run(full);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err, "error: Cannot write to stdout: No space left on device.\n");
}

TEST_F(Sequence, AGifTakesEveryRateHoweverShort) {
    write("scene.frag", kMoving);
    const std::pair<std::vector<std::string>, int> cases[] = {
        {{"--fps", "120", "--frames", "0:0"}, 1},
        {{"--fps", "100000", "--frames", "0:8"}, 1},
        {{"--fps", "120", "--frames", "0:11"}, 5},
        {{"--fps", "30", "--frames", "0:2"}, 3},
    };
    for (auto [words, shown] : cases) {
        SCOPED_TRACE(words[1]);
        words.insert(words.end(), {"scene.frag", "-o", "film.gif"});
        result(words);
        const std::string film = bytes("film.gif");
        int pictures = 0;  // each has a block that tells how long it is shown
        for (std::size_t at = 0; (at = film.find("\x21\xF9\x04", at)) != std::string::npos; ++at)
            ++pictures;
        EXPECT_EQ(pictures, shown);
    }
}

TEST_F(Sequence, WhatMakesNoSenseIsSaidBeforeAnythingIsDrawn) {
    write("scene.frag", kGradient);
    const std::vector<std::vector<std::string>> wrong = {
        {"-o", "out.png"},
        {"-o", "out%s.png"},
        {"-o", "out%04d.txt"},
        {"-o", "%d%d.png"},
        {"-o", "%d.png", "--frames", "5:2"},
        {"-o", "%d.png", "--frames", "-1:2"},
        {"-o", "%d.png", "--frames", "1"},
        {"-o", "%d.png", "--frames", "0:9:0"},
        {"-o", "%d.png", "--shard", "0/3"},
        {"-o", "%d.png", "--shard", "4/3"},
        {"-o", "%d.png", "--shard", "3"},
        {"-o", "out.mp4", "--shard", "1/3"},
        {"-o", "out.mp4", "--resume"},
        {"-o", "%d.jpg", "--resume"},
        {"-o", "-", "--json"},
        {},
        {"-o", "%d.png", "--save-state-every", "10"},
    };
    for (std::vector<std::string> words : wrong) {
        words.insert(words.begin(), "scene.frag");
        const Outcome outcome = sequence(words);
        EXPECT_EQ(outcome.code, 2) << fmt::format("{}", fmt::join(words, " "));
        EXPECT_TRUE(outcome.err.starts_with("error: ")) << outcome.err;
    }
    EXPECT_EQ(names(), std::set<std::string>{"scene.frag"});
    EXPECT_EQ(sequence({"scene.frag", "-o", "nowhere/%d.png", "--frames", "0:3"}).code, 1);
    EXPECT_EQ(sequence({"absent.frag", "-o", "%d.png"}).code, 4);
}

// A picture's head says what it is made of, however much else it says.
TEST_F(Sequence, ThousandsOfTweaksDoNotHideWhatAPictureIsMadeOf) {
    std::string text;
    for (int i = 0; i < 1200; ++i)
        text += fmt::format(
            "uniform float aTweakWithALongNameThatFillsTheHeadOfTheFile{}; //@ 0.5\n", i);
    write("many.frag", text + "void mainImage(out vec4 c, in vec2 p) { c = vec4(iTime); }\n");
    const std::vector<std::string> words = {"sequence", "many.frag", "--size",   "16x9",
                                            "-o",       "m%d.png",   "--frames", "0:2",
                                            "--resume", "--json"};
    EXPECT_EQ(report_of(glint(words))["frames"], 3);
    EXPECT_EQ(report_of(glint(words))["skipped"], 3);
}

TEST_F(Sequence, JoiningPicturesRefusesWhatItWouldLeaveOutOrCouldNeverWrite) {
    fs::create_directory(folder() / "film.mp4");
    write("file", "");
    write("scene.frag", kMoving);
    for (const char* film : {"film.mp4", "file/film.mp4"}) {
        const Outcome outcome = sequence(
            {"scene.frag", "--frames", "0:1", "--from-pictures", "/dev/null/%d.png", "-o", film});
        EXPECT_EQ(outcome.code, 1) << film << outcome.err;
        EXPECT_NE(outcome.err.find("directory"), outcome.err.npos) << outcome.err;
    }
    for (const char* pictures : {"n%d.jpg", "n%d.tif"})
        EXPECT_EQ(sequence({"scene.frag", "--frames", "0:1", "--from-pictures", pictures}).code, 2);
    EXPECT_EQ(
        sequence({"scene.frag", "--frames", "0:1", "--from-pictures", "n%d.exr", "-o", "other.mp4"})
            .code,
        2);
    for (const char* option : {"--save-state", "--from-state"})
        EXPECT_EQ(sequence({"scene.frag", "--frames", "0:1", "--from-pictures", "n%d.png", option,
                            "s.exr"})
                      .code,
                  2);
}

}  // namespace
}  // namespace glint::cli::sequence_test
