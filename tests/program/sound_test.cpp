// `glint sound`, and the sound of a film.
#include "command.h"
#include "media/image.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace glint::cli::sound_test {
namespace {

// 441 Hz on the left, half as loud as can be; the sample's number on the right.
constexpr std::string_view kTone =
    "uniform float level; //@ 0.5 [0, 1]\n"
    "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n"
    "vec2 mainSound(int samp, float time) {\n"
    "    float turns = fract(float(samp % 100) / 100.0);\n"
    "    return vec2(level * sin(6.283185307 * turns), float(samp % 30000) / 32767.0);\n}\n";

class Sound : public InAFolder {
protected:
    // A value of a file of 16-bit pairs behind a head of 44 bytes.
    static int sample(const std::string& wav, long index, int channel) {
        std::int16_t value = 0;
        std::memcpy(&value, wav.data() + 44 + (index * 2 + channel) * 2, 2);
        return value;
    }
    // The pairs of any file with sound, without a head.
    std::string decoded(const std::string& name) {
        const std::string decode = fmt::format(
            "cd '{}' && ffmpeg -nostdin -loglevel error -i {} -f s16le -ac 2 -ar 44100 -y raw",
            folder().string(), name);
        EXPECT_EQ(std::system(decode.c_str()), 0);
        return bytes("raw");
    }
};

TEST_F(Sound, IsAWavOfEverySampleInOrderAcrossBlocks) {
    write("tone.frag", kTone);
    const Outcome outcome = glint({"sound", "tone.frag", "-o", "a.wav", "--seconds", "7"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string wav = bytes("a.wav");
    const long count = 7 * 44100;
    ASSERT_EQ(wav.size(), 44u + count * 4);
    EXPECT_EQ(wav.substr(0, 4) + wav.substr(8, 8) + wav.substr(36, 4), "RIFFWAVEfmt data");
    for (long i = 0; i < count; ++i) {
        ASSERT_EQ(sample(wav, i, 1), i % 30000) << i;
        const double turns = static_cast<double>(i % 100) / 100.0;
        const double wanted = 0.5 * std::sin(2 * std::numbers::pi * turns) * 32767.0;
        ASSERT_NEAR(sample(wav, i, 0), wanted, 1.0) << i;
    }
    glint({"sound", "tone.frag", "-o", "B.WAV", "--seconds", "7"});
    EXPECT_EQ(bytes("B.WAV"), wav);
    EXPECT_EQ(glint({"sound", "tone.frag", "-o", "c.wav", "--tweak", "level=0"}).code, 0);
    EXPECT_EQ(sample(bytes("c.wav"), 25, 0), 0);
    EXPECT_EQ(bytes("c.wav").size(), 44u + 180 * 44100 * 4);
}

// Every other sample 2.5 or nothing that is a number; what is not asked for is not told of.
TEST_F(Sound, ThatAFileCannotKeepIsTold) {
    write("loud.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n"
          "vec2 mainSound(int s, float t) {\n"
          "    return t > 1.0 ? vec2(9) : s % 2 == 0 ? vec2(0.5, 2.5) : vec2(sqrt(-t - 1.0), 0);\n"
          "}\n");
    const Outcome loud = glint({"sound", "loud.frag", "-o", "a.wav", "--seconds", "1"});
    EXPECT_EQ(loud.code, 0);
    EXPECT_EQ(loud.err,
              "loud.frag: warning: 25 % of the samples lie beyond -1 and 1, up to 2.5, and are cut "
              "off there; multiply them by 0.38; 25 % of the samples are NaN or infinite\n");
}

TEST_F(Sound, OfAnotherFormIsToldAtItsPlace) {
    const std::string image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";
    for (const char* sound : {"vec2 mainSound(uint s, float t) { return vec2(t); }\n",
                              "vec2 mainSound() { return vec2(0); }\n",
                              "void mainSound(out vec2 s, float t) { s = vec2(t); }\n"}) {
        write("wrong.frag", image + sound);
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"sound", "wrong.frag", "-o", "a.wav"},
              {"info", "wrong.frag"}}) {
            const Outcome told = glint(words);
            EXPECT_EQ(told.code, 3) << sound;
            EXPECT_NE(
                told.err.find("wrong.frag:2:6: error: this makes the sound, and so has to be "),
                std::string::npos)
                << told.err;
        }
    }
    write(
        "none.frag",
        "void mainImage(out vec4 c, in vec2 p) { float mainSound = 1.0; c = vec4(mainSound); }\n");
    EXPECT_EQ(glint({"sound", "none.frag", "-o", "a.wav"}).code, 2);
    write("tab.frag",
          image +
              "#ifdef PASS_sound\nvec2 mainSound(int s, float t) { return vec2(tiem); }\n#endif\n");
    EXPECT_EQ(glint({"info", "tab.frag"}).code, 3) << "info compiles it, too";
}

TEST_F(Sound, TheChannelsOfTheSitesNewerFormAreThere) {
    write("ich.frag",
          "void mainImage(out vec4 c, vec2 p) { c = vec4(iCh1.size, iCh2.time); }\n"
          "vec2 mainSound(float t) { return vec2(sin(t)); }\n");
    const Outcome made = glint({"sound", "ich.frag", "-o", "a.wav", "--seconds", "0.1"});
    EXPECT_EQ(made.code, 0) << made.err;
}

TEST_F(Sound, TheSitesOlderFormAndItsFreeNamesWork) {
    write("old.frag",
          "#ifdef PASS_sound\n"
          "float iTime;\n"
          "vec2 mainSound(float time) {\n"
          "    iTime = time; vec2 iMouse = vec2(0.25);\n"
          "    return vec2(iTime < 0.5 ? 1.0 : -1.0, iMouse.x);\n}\n"
          "#endif\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0, 1); }\n");
    ASSERT_EQ(glint({"sound", "old.frag", "-o", "a.wav", "--seconds", "1"}).code, 0);
    const std::string wav = bytes("a.wav");
    EXPECT_EQ(sample(wav, 100, 0), 32767);
    EXPECT_EQ(sample(wav, 44000, 0), -32767);
    EXPECT_EQ(sample(wav, 44000, 1), 8192);
}

// The older form is for texts that have no other; one of other parameters is a function of theirs.
TEST_F(Sound, OfSeveralFunctionsOfItsNameTheSitesIsPlayed) {
    const std::string image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";
    const std::pair<const char*, const char*> texts[] = {
        {"vec2 mainSound(float t) { return vec2(0.25); }\n",
         "vec2 mainSound(int samp, float t) { return 2.0 * mainSound(t); }\n"},
        {"vec2 mainSound(float t, float pan) { return vec2(pan); }\n",
         "vec2 mainSound(const in int samp, const in float t) { return mainSound(t, 0.5); }\n"}};
    for (const auto& [other, own] : texts) {
        write("two.frag", std::string(other) + own + image);
        const Outcome made = glint({"sound", "two.frag", "-o", "a.wav", "--seconds", "0.01"});
        ASSERT_EQ(made.code, 0) << made.err;
        EXPECT_EQ(sample(bytes("a.wav"), 100, 0), 16384) << own;
    }
}

TEST_F(Sound, WhatIsNoNumberIsSilentAndWhatIsTooLoudIsClipped) {
    write(
        "bad.frag",
        "uniform float zero; //@ 0 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n"
        "vec2 mainSound(int samp, float time) {\n"
        "    return vec2(samp < 10 ? sqrt(zero - 1.0) : 9.0, samp < 10 ? 1.0 / zero : -9.0);\n}\n");
    ASSERT_EQ(glint({"sound", "bad.frag", "-o", "a.wav", "--seconds", "0.1"}).code, 0);
    const std::string wav = bytes("a.wav");
    EXPECT_EQ(sample(wav, 5, 0), 0);
    EXPECT_EQ(sample(wav, 5, 1), 32767);
    EXPECT_EQ(sample(wav, 20, 0), 32767);
    EXPECT_EQ(sample(wav, 20, 1), -32767);
}

TEST_F(Sound, AFilmCarriesItFromItsFirstFrameOn) {
    write("tone.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n"
          "vec2 mainSound(int samp, float time) {\n"
          "    return vec2(time < 1.0 ? 0.5 * sin(0.0628318530 * float(samp % 100)) : 0.0);\n}\n");
    for (const std::string name : {"film.mov", "film.mp4", "film.webm"}) {
        SCOPED_TRACE(name);
        const Outcome outcome = glint({"sequence", "tone.frag", "-o", name, "--frames", "15:44",
                                       "--fps", "30", "--size", "64x36"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const std::string samples = std::string(44, ' ') + decoded(name);
        const auto loudest = [&](long from, long to) {
            int most = 0;
            for (long i = from; i < to; ++i) most = std::max(most, std::abs(sample(samples, i, 0)));
            return most;
        };
        // One second long, to a block of the codec; loud in the first half, silent in the second.
        EXPECT_NEAR(static_cast<double>(samples.size() - 44) / 4, 44100.0, 2100.0);
        EXPECT_NEAR(loudest(10000, 15000), 16384, 1000);
        EXPECT_LT(loudest(28000, 40000), 300);
    }
}

// A film's sound begins with its first frame, and what buffers keep is of all blocks before.
TEST_F(Sound, OfABufferThatRemembersIsTheSameWhereverAFilmBegins) {
    write("sums.frag",
          "uniform sampler2D sum; //@ pass mainSum format=rgba32f\n"
          "void mainSum(out vec4 c, in vec2 p) { c = texelFetch(sum, ivec2(p), 0) + 0.01; }\n"
          "vec2 mainSound(int samp, float time) { return texelFetch(sum, ivec2(0), 0).xx; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    ASSERT_EQ(glint({"sound", "sums.frag", "-o", "a.wav", "--seconds", "3"}).code, 0);
    const Outcome film = glint(
        {"sequence", "sums.frag", "-o", "film.mov", "--frames", "120:130", "--size", "16x16"});
    ASSERT_EQ(film.code, 0) << film.err;
    EXPECT_EQ(decoded("film.mov").substr(0, 400), bytes("a.wav").substr(44 + 2 * 44100 * 4, 400));
}

TEST_F(Sound, TheBuffersThatItReadsAreAsLargeAsThePicture) {
    write("tab.frag",
          "uniform sampler2D tab; //@ pass mainTab\n"
          "void mainTab(out vec4 c, in vec2 p) { c = vec4(p.x / 1000.0); }\n"
          "vec2 mainSound(int samp, float time) {\n"
          "    return texelFetch(tab, ivec2(samp % 640, 0), 0).xx;\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    ASSERT_EQ(glint({"sound", "tab.frag", "-o", "a.wav", "--seconds", "1", "--size", "640x4"}).code,
              0);
    EXPECT_NEAR(sample(bytes("a.wav"), 600, 0), 0.6005 * 32767.0, 8.0);  // half a float's digits
}

TEST_F(Sound, LoopsThatTheDriverEndsAreTold) {
    write("cut.frag",
          "float quiet() { int n = 0; for (int i = 0; i < 200000; i++) n += i; return float(n); }\n"
          "vec2 mainSound(int samp, float time) {\n    int n = 0;\n"
          "    for (int i = 0; i < 100000; i++) n += (samp + i) & 1;\n"
          "    return vec2(float(n) / 100000.0);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(p.x < -1.0 ? quiet() : 1.0); }\n");
    for (const auto& words :
         {std::vector<std::string>{"sound", "cut.frag", "-o", "a.wav", "--seconds", "0.1"},
          {"sequence", "cut.frag", "-o", "a.mov", "--frames", "0:1", "--size", "16x16"}}) {
        const Outcome made = glint(words);
        EXPECT_EQ(made.code, 0);
        EXPECT_NE(made.err.find("cut.frag:4:5: warning: llvmpipe has ended loops of sound"),
                  std::string::npos)
            << made.err;
    }
}

TEST_F(Sound, BeyondWhatAnIntCountsIsToldAndItsTimeGoesOn) {
    write("late.frag",
          "vec2 mainSound(int samp, float time) { return vec2(samp < 0 ? -0.5 : 0.5, time < 0.0 ? "
          "-0.25 : 0.25); }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    const Outcome film = glint({"sequence", "late.frag", "-o", "film.mov", "--frames",
                                "3000000:3000001", "--size", "16x16"});
    ASSERT_EQ(film.code, 0) << film.err;
    EXPECT_NE(film.err.find("`samp` ends after 13 h 31 min"), std::string::npos) << film.err;
    EXPECT_NEAR(sample(std::string(44, ' ') + decoded("film.mov"), 9, 1), 0.25 * 32767.0, 1.0);
}

// 0.3 s lies a rounding below three rounds of 0.1 s.
TEST_F(Sound, WhereARoundBeginsItsTimeIsThatOfTheTextureZero) {
    write("tone.frag", kTone);
    ASSERT_EQ(glint({"sound", "tone.frag", "-o", "a.wav", "--seconds", "0.1"}).code, 0);
    write(
        "a.frag",
        "uniform sampler2D iChannel0; //@ sound a.wav\nvoid mainImage(out vec4 c, in vec2 p) { c = "
        "vec4(iChannelTime[0] * 5.0 + 0.0 * texture(iChannel0, p).x); }\n");
    for (const char* time : {"0.1", "0.3", "0.6", "0.7", "1.2"}) {
        ASSERT_EQ(glint({"still", "a.frag", "-o", "a.png", "--size", "4x4", "--time", time}).code,
                  0);
        EXPECT_EQ(read_image(folder() / "a.png").pixels[0], std::byte{0}) << time;
    }
}

TEST_F(Sound, FlacHoldsTheSameSamplesAndOggTheSameSound) {
    write("tone.frag", kTone);
    for (const char* name : {"a.wav", "a.flac", "a.ogg"})
        ASSERT_EQ(glint({"sound", "tone.frag", "-o", name, "--seconds", "2"}).code, 0) << name;
    EXPECT_EQ(decoded("a.flac"), bytes("a.wav").substr(44));
    EXPECT_NEAR(static_cast<double>(decoded("a.ogg").size()), 2 * 44100 * 4, 4);
}

TEST_F(Sound, OfAnyKindHasTheSameBytesEachTime) {
    write("tone.frag", kTone);
    for (const std::string kind : {"wav", "flac", "ogg"}) {
        for (const std::string name : {"a.", "b."})
            ASSERT_EQ(glint({"sound", "tone.frag", "-o", name + kind, "--seconds", "2"}).code, 0);
        EXPECT_EQ(bytes("a." + kind), bytes("b." + kind)) << kind;
    }
}

TEST_F(Sound, ASceneHearsAFileAndLoadsItsLibraryForThatAlone) {
    write("tone.frag", kTone);
    ASSERT_EQ(glint({"sound", "tone.frag", "-o", "song.ogg", "--seconds", "1"}).code, 0);
    write("listens.frag",
          "uniform sampler2D song; //@ sound song.ogg\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(song, ivec2(p), 0).rrrr; }\n");
    // The dynamic linker tells of every library.
    const auto libraries = [&](const std::string& scene) {
        Command asked = command({"still", scene, "-o", "a.png", "--size", "8x2", "--time", "0.5"});
        asked.environment.emplace_back("LD_DEBUG", "files");
        const Outcome outcome = run(asked);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err;
    };
    EXPECT_NE(libraries("listens.frag").find("libsndfile"), std::string::npos);
    EXPECT_EQ(libraries("tone.frag").find("libsndfile"), std::string::npos);

    write("gone.frag",
          "uniform sampler2D song; //@ sound gone.ogg\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(song, ivec2(p), 0); }\n");
    const Outcome gone = glint({"still", "gone.frag", "-o", "b.png", "--size", "8x2"});
    EXPECT_EQ(gone.code, 4);
    EXPECT_EQ(
        gone.err,
        "gone.frag:1:19: error: Cannot read gone.ogg: No such file or directory; did you mean "
        "'song.ogg'?\n");
}

TEST_F(Sound, WhatCannotBeIsSaid) {
    write("silent.frag", kGradient);
    write("tone.frag", kTone);
    write("typo.frag", "vec2 mainSound(int samp, float time) { return vec2(1.0) }\n");
    EXPECT_EQ(glint({"sound", "silent.frag", "-o", "a.wav"}).code, 2);
    EXPECT_EQ(glint({"sound", "tone.frag", "-o", "a.mp3"}).code, 2);
    EXPECT_EQ(glint({"sound", "tone.frag", "-o", "a.wav", "--seconds", "20000"}).code, 2);
    EXPECT_EQ(glint({"sound", "tone.frag", "-o", "nowhere/a.wav"}).code, 1);
    const Outcome typo = glint({"sound", "typo.frag", "-o", "a.wav"});
    EXPECT_EQ(typo.code, 3);
    EXPECT_TRUE(typo.err.starts_with("typo.frag:1:")) << typo.err;
    EXPECT_FALSE(names().contains("a.wav"));
}

}  // namespace
}  // namespace glint::cli::sound_test
