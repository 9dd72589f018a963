// The `//@` grammar, one line at a time.
#include "scene/annotation.h"

#include "base/words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace glint::annotation_test {
namespace {

struct ReadTweak {
    Tweak tweak;
    std::vector<Complaint> complaints;
};

ReadTweak tweak(TweakType type, std::string_view annotation) {
    ReadTweak read;
    read.tweak.name = "x";
    read.tweak.type = type;
    read.tweak = parse_tweak(read.tweak, annotation, read.complaints);
    return read;
}

struct ReadSampler {
    SamplerAnnotation annotation;
    std::vector<Complaint> complaints;
};

ReadSampler sampler(SamplerType type, std::string_view annotation) {
    ReadSampler read;
    Sampler named;
    named.name = "x";
    named.type = type;
    read.annotation = parse_sampler(named, annotation, read.complaints);
    return read;
}

std::string all(const std::vector<Complaint>& complaints) {
    std::string text;
    for (const Complaint& complaint : complaints)
        text += std::to_string(complaint.at) + ": " + complaint.text + "\n";
    return text;
}

TEST(TweakAnnotation, GivesTheDefaultOfEachType) {
    const struct {
        TweakType type;
        const char* annotation;
        TweakValue value;
    } cases[] = {
        {TweakType::float1, "0.6", {0.6}},
        {TweakType::float1, "1/240", {1.0 / 240}},
        {TweakType::float1, "-.5 [-1, 1]", {-0.5}},
        {TweakType::float1, "+2e-3", {0.002}},
        {TweakType::int1, "64 [8, 1024]", {64}},
        {TweakType::int1, "1e3", {1000}},
        {TweakType::bool1, "off", {0}},
        {TweakType::bool1, "true \"yes\"", {1}},
        {TweakType::vec2, "0.1, 0.2", {0.1, 0.2}},
        {TweakType::vec2, "(0.1 ,0.2) [0, 1]", {0.1, 0.2}},
        {TweakType::vec3, "0.1,0.2 , 0.3 \"a tuple\"", {0.1, 0.2, 0.3}},
        {TweakType::vec3, "#0b3a53", {11 / 255.0, 58 / 255.0, 83 / 255.0}},
        {TweakType::vec3, "\"#0B3A53\" \"deep\"", {11 / 255.0, 58 / 255.0, 83 / 255.0}},
        {TweakType::vec4, "#ff000080", {1, 0, 0, 128 / 255.0}},
        {TweakType::vec4, "#ff0000", {1, 0, 0, 1}},
        {TweakType::int1, "1 {off, screen-space, traced}", {1}},
        {TweakType::int1, "traced {off, screen-space, traced}", {2}},
    };
    for (const auto& c : cases) {
        const ReadTweak read = tweak(c.type, c.annotation);
        EXPECT_EQ(all(read.complaints), "") << c.annotation;
        EXPECT_EQ(read.tweak.initial, c.value) << c.annotation;
    }
}

TEST(TweakAnnotation, ReadsEveryWordInAnyOrder) {
    for (
        const char* annotation :
        {R"(2.0 [0.1, 100] log unit=1/m step=0.5 group="Deep water" quality norandom reference=50 "how far")",
         R"(2 "how far" norandom quality group="Deep water" reference = 50 step=1/2 unit="1/m" log [.1,100])"}) {
        const auto [t, complaints] = tweak(TweakType::float1, annotation);
        EXPECT_EQ(all(complaints), "");
        EXPECT_EQ(t.initial[0], 2.0);
        EXPECT_EQ(t.min, 0.1);
        EXPECT_EQ(t.max, 100.0);
        EXPECT_TRUE(t.log);
        EXPECT_TRUE(t.quality);
        EXPECT_TRUE(t.no_random);
        EXPECT_EQ(t.step, 0.5);
        EXPECT_EQ(t.unit, "1/m");
        EXPECT_EQ(t.group, "Deep water");
        EXPECT_EQ(t.description, "how far");
        ASSERT_TRUE(t.reference);
        EXPECT_EQ((*t.reference)[0], 50.0);
    }
}

TEST(TweakAnnotation, AReferenceMayBeAMenuNameOrLieBeyondTheSlider) {
    const auto menu = tweak(TweakType::int1, "off {off, traced} reference=traced");
    ASSERT_EQ(all(menu.complaints), "");
    EXPECT_EQ((*menu.tweak.reference)[0], 1.0);
    const auto steps = tweak(TweakType::int1, "64 [8, 1024] log quality reference=4096");
    ASSERT_EQ(all(steps.complaints), "");
    EXPECT_EQ((*steps.tweak.reference)[0], 4096.0);
}

TEST(TweakAnnotation, AnOrdinaryCommentEndsIt) {
    const auto read = tweak(TweakType::float1, "0.5 [0, 1] // was 0.7");
    EXPECT_EQ(all(read.complaints), "");
    EXPECT_EQ(read.tweak.max, 1.0);
}

TEST(TweakAnnotation, SaysWhatIsWrongAndWhere) {
    const struct {
        TweakType type;
        const char* annotation;
        std::size_t at;
        const char* words;  // part of the complaint
    } cases[] = {
        {TweakType::float1, "", 0, "default is missing"},
        {TweakType::float1, "[0, 1]", 0, "default is missing"},
        {TweakType::float1, "0.5x", 0, "'0.5x'"},
        {TweakType::float1, "inf", 0, "'inf'"},
        {TweakType::float1, "nan", 0, "'nan'"},
        {TweakType::float1, "1e999", 0, "'1e999'"},
        {TweakType::float1, "1e39", 0, "'1e39'"},  // finite in double, not in GLSL
        {TweakType::float1, "1/0", 0, "'1/0'"},
        {TweakType::float1, "0,5", 0, "'0,5'"},
        {TweakType::float1, "#ff0000", 0, "'#ff0000'"},
        {TweakType::int1, "1.5", 0, "whole number"},
        {TweakType::int1, "3000000000", 0, "whole number"},
        {TweakType::int1, "1/240", 0, "whole number"},
        {TweakType::bool1, "maybe", 0, "on or off"},
        {TweakType::vec3, "0.5", 0, "three numbers"},
        {TweakType::vec3, "0.1, 0.2", 0, "three numbers"},
        {TweakType::vec2, "1, 2, 3", 0, "two numbers"},
        {TweakType::vec3, "(1, 2, 3", 0, "three numbers"},
        {TweakType::vec3, "#12345", 0, "three numbers"},
        {TweakType::vec3, "#12345g", 0, "three numbers"},
        {TweakType::vec3, "#11223344", 0, "three numbers"},
        {TweakType::float1, "0.5 [1, 0]", 4, "[0, 1]"},
        {TweakType::float1, "0.5 [1", 4, "never closed"},
        {TweakType::float1, "0.5 [1]", 4, "two finite numbers"},
        {TweakType::float1, "0.5 [0, inf]", 4, "two finite numbers"},
        {TweakType::float1, "0.5 [0, 1, 2]", 4, "two finite numbers"},
        {TweakType::float1, "0.5 [0, 1] [0, 2]", 11, "second range"},
        {TweakType::float1, "2 [0, 1]", 0, "outside [0, 1]"},
        {TweakType::vec2, "0.5, 2 [0, 1]", 0, "outside [0, 1]"},
        {TweakType::int1, "1 [0.5, 2]", 2, "whole numbers"},
        {TweakType::bool1, "on [0, 1]", 3, "range"},
        {TweakType::float1, "1 log", 2, "begins above 0"},
        {TweakType::float1, "1 [0, 2] log", 9, "begins above 0"},
        {TweakType::bool1, "on log", 3, "log is for numbers"},
        {TweakType::float1, "1 step=0", 7, "above 0"},
        {TweakType::float1, "1 step=-1", 7, "above 0"},
        {TweakType::float1, "1 step=", 7, "above 0"},
        {TweakType::int1, "1 step=0.5", 7, "whole number"},
        {TweakType::int1, "3 {off, on}", 0, "off, on"},
        {TweakType::int1, "of {off, on}", 0, "off, on"},
        {TweakType::int1, "0 {off, on", 2, "never closed"},
        {TweakType::int1, "0 {off,, on}", 2, "empty"},
        {TweakType::int1, "0 {off, off}", 2, "twice"},
        {TweakType::int1, "0 {off, on} reference=2", 22, "off, on"},
        {TweakType::float1, "0 {off, on}", 2, "uniform int"},
        {TweakType::float1, "1 qualty", 2, "did you mean 'quality'"},
        {TweakType::float1, "1 unti=m", 2, "did you mean 'unit'"},
        {TweakType::float1, "1 unit=", 2, "no value"},
        {TweakType::float1, "1 unit= \"how fast\"", 2, "unit= has no value"},
        {TweakType::float1, "1 group= log", 2, "group= has no value"},
        {TweakType::vec3, "vec3(1.0)", 0, "without 'vec3'"},
        {TweakType::float1, "noise rgba 256", 0, "noise fills a sampler"},
        {TweakType::float1, "1 2", 2, "unknown word '2'"},
        {TweakType::float1, "1 [0, 2] quality=1", 9, "quality has no value; write quality alone"},
        {TweakType::int1, "1 [0, 99999999999]", 2, "two whole numbers, from -2147483648 to"},
        {TweakType::float1, "1 \"open", 2, "never closed"},
        {TweakType::float1, "1 \"a\" \"b\"", 6, "second description"},
        {TweakType::float1, "1 ] x", 2, "']'"},
        {TweakType::float1, "1 unit=a unit=b", 9, "second unit="},
        {TweakType::float1, "1 group Water", 2, "group has no value"},
    };
    for (const auto& c : cases) {
        const std::vector<Complaint> complaints = tweak(c.type, c.annotation).complaints;
        ASSERT_FALSE(complaints.empty()) << c.annotation;
        EXPECT_EQ(complaints.front().at, c.at) << c.annotation << "\n" << all(complaints);
        EXPECT_NE(complaints.front().text.find(c.words), std::string::npos) << c.annotation << "\n"
                                                                            << all(complaints);
    }
}

TEST(TweakAnnotation, ReportsEveryMistakeOfALine) {
    EXPECT_EQ(tweak(TweakType::float1, "x [1, 0] log step=0 whatever").complaints.size(), 5u);
}

TEST(TweakAnnotation, AMistakeBehindManyUnknownWordsIsOne) {
    std::string words = "1";
    for (int i = 0; i < 40; ++i) words += " what";
    const auto is_error = [](const Complaint& one) { return one.severity == Severity::error; };
    EXPECT_TRUE(std::ranges::none_of(tweak(TweakType::float1, words).complaints, is_error));
    EXPECT_TRUE(
        std::ranges::any_of(tweak(TweakType::float1, words + " step=0").complaints, is_error));
}

TEST(TweakAnnotation, OfOneMistakeIsToldOnce) {
    EXPECT_EQ(tweak(TweakType::vec3, "vec3(1.0) \"x\"").complaints.size(), 1u);
    EXPECT_EQ(tweak(TweakType::float1, "noise rgba 256").complaints.size(), 1u);
    EXPECT_EQ(tweak(TweakType::bool1, "pass mainX").complaints.size(), 1u);
    EXPECT_EQ(tweak(TweakType::float1, "0.5 [0, 1 \"x\"").complaints.size(), 1u);
    EXPECT_EQ(tweak(TweakType::int1, "noise {noise, image}").complaints.size(), 0u);
    EXPECT_EQ(tweak(TweakType::float1, "1 unit = \"m\"").complaints.size(), 0u);
}

TEST(TweakAnnotation, ANameInQuotesMayHoldAnySignAndBeTheDefault) {
    const ReadTweak warm = tweak(TweakType::int1, "1 {\"red, warm\", blue} \"which\"");
    EXPECT_EQ(all(warm.complaints), "");
    EXPECT_EQ(warm.tweak.names, (std::vector<std::string>{"red, warm", "blue"}));
    EXPECT_EQ(warm.tweak.description, "which");
    EXPECT_EQ(tweak(TweakType::int1, "0 {\"a}b\", c}").tweak.names,
              (std::vector<std::string>{"a}b", "c"}));
    const ReadTweak screen =
        tweak(TweakType::int1, "\"screen space\" quality {off, screen space} \"how\"");
    EXPECT_EQ(all(screen.complaints), "");
    EXPECT_EQ(screen.tweak.initial[0], 1.0);
    EXPECT_EQ(screen.tweak.description, "how");
    const ReadTweak inches = tweak(TweakType::int1, "0 {off, 5\" screen} \"size\"");
    EXPECT_EQ(all(inches.complaints), "");
    EXPECT_EQ(inches.tweak.names.back(), "5\" screen");
    const ReadTweak described = tweak(TweakType::int1, "\"how\" 1 {off, on}");
    EXPECT_EQ(all(described.complaints), "");
    EXPECT_EQ(described.tweak.description, "how");
}

TEST(TweakAnnotation, SaysWhereItIsSafe) {
    const ReadTweak read = tweak(TweakType::float1, "0.5 [0, 1] safe=[0, 0.8]");
    EXPECT_EQ(all(read.complaints), "");
    EXPECT_EQ(read.tweak.safe, (std::array{0.0, 0.8}));
    for (const char* wrong : {"0.5 [0, 1] safe=0.8", "0.5 [0, 1] safe=[0.8, 0]",
                              "0.5 [0, 1] safe=[0, 2]", "0.5 safe=[0, 1]"})
        EXPECT_EQ(tweak(TweakType::float1, wrong).complaints.size(), 1u) << wrong;
    const ReadTweak menu = tweak(TweakType::int1, "2 {explicit, implicit, exact} safe=[1, 2]");
    EXPECT_EQ(all(menu.complaints), "");
    EXPECT_EQ(menu.tweak.safe, (std::array{1.0, 2.0}));
    for (const char* wrong : {"0 {a, b} safe=[0, 2]", "0 {a, b} safe=[-1, 1]",
                              "0 {a, b} safe=[0, 0.5]", "0 {a, b} safe=[a, b]"})
        EXPECT_TRUE(all(tweak(TweakType::int1, wrong).complaints)
                        .ends_with("write safe=[0, 1] for the first two of its names\n"))
            << wrong;
}

TEST(GroupAnnotation, HeadsWhatFollows) {
    EXPECT_EQ(parse_group(" group Water"), "Water");
    EXPECT_EQ(parse_group("group \"Deep water\" "), "Deep water");
    EXPECT_EQ(parse_group("group Deep water"), "Deep water");
    EXPECT_EQ(parse_group("group"), "");
    EXPECT_FALSE(parse_group("groups x"));
    EXPECT_FALSE(parse_group("0.5 group=x"));
}

TEST(SamplerAnnotation, FilterAndWrapAreTheSitesUnlessWritten) {
    const struct {
        SamplerType type;
        const char* annotation;
        Source source;
        Filter filter;
        Wrap wrap;
    } cases[] = {
        {SamplerType::sampler2D, "pass mainA", Source::buffer, Filter::linear, Wrap::clamp},
        {SamplerType::samplerCube, "pass mainA", Source::buffer, Filter::linear, Wrap::clamp},
        {SamplerType::sampler2D, "image a.png", Source::image, Filter::mipmap, Wrap::repeat},
        {SamplerType::samplerCube, "cube a.png", Source::cube, Filter::mipmap, Wrap::clamp},
        {SamplerType::sampler3D, "volume a.bin", Source::volume, Filter::mipmap, Wrap::repeat},
        {SamplerType::sampler2D, "sound a.ogg", Source::sound, Filter::linear, Wrap::clamp},
        {SamplerType::sampler2D, "noise 64", Source::noise, Filter::mipmap, Wrap::repeat},
        {SamplerType::sampler3D, "noise 32", Source::noise, Filter::mipmap, Wrap::repeat},
        {SamplerType::sampler2D, "keyboard", Source::keyboard, Filter::nearest, Wrap::clamp},
        {SamplerType::sampler2D, "buffer other filter=nearest wrap=mirror", Source::buffer,
         Filter::nearest, Wrap::mirror},
        {SamplerType::sampler2D, "image a.png wrap = clamp filter=linear", Source::image,
         Filter::linear, Wrap::clamp},
    };
    for (const auto& c : cases) {
        const auto read = sampler(c.type, c.annotation);
        EXPECT_EQ(all(read.complaints), "") << c.annotation;
        EXPECT_EQ(read.annotation.sampler.source, c.source) << c.annotation;
        EXPECT_EQ(read.annotation.sampler.filter, c.filter) << c.annotation;
        EXPECT_EQ(read.annotation.sampler.wrap, c.wrap) << c.annotation;
    }
}

TEST(SamplerAnnotation, ReadsTheOptionsOfAPass) {
    const auto read =
        sampler(SamplerType::sampler2D, "pass mainA size=64x32 step=1/240 format=rgba8");
    ASSERT_EQ(all(read.complaints), "");
    EXPECT_EQ(read.annotation.target, "mainA");
    EXPECT_EQ(read.annotation.size->value, glm::ivec2(64, 32));
    EXPECT_EQ(read.annotation.step->value, (Step{1, 240}));
    EXPECT_EQ(read.annotation.format->value, PixelFormat::rgba8);
    EXPECT_EQ(sampler(SamplerType::sampler2D, "pass a scale=1/4").annotation.scale->value, 0.25);
}

TEST(SamplerAnnotation, SaysWhatABufferKeepsTo) {
    const ReadSampler read =
        sampler(SamplerType::sampler2D, "pass mainWaves bounded=[-1, 2.5] conserves=1e-6");
    EXPECT_EQ(all(read.complaints), "");
    EXPECT_EQ(read.annotation.sampler.bounded, (std::array{-1.0, 2.5}));
    EXPECT_EQ(read.annotation.sampler.conserves, 1e-6);
    for (const char* wrong : {"pass mainWaves bounded=2", "pass mainWaves bounded=[2, 1]",
                              "pass mainWaves conserves=0", "image wood.png conserves=1e-6"})
        EXPECT_EQ(sampler(SamplerType::sampler2D, wrong).complaints.size(), 1u) << wrong;
}

TEST(SamplerAnnotation, ACubeIsReadFromOneFileOrFromSix) {
    using Files = std::vector<std::filesystem::path>;
    const struct {
        const char* annotation;
        Files files;
        bool vflip;
    } cases[] = {
        {"cube sky.hdr", {"sky.hdr"}, false},
        {"cube sky.hdr \"a panorama\"", {"sky.hdr"}, false},
        {"cube \"my sky.hdr\" vflip=on \"a panorama\"", {"my sky.hdr"}, true},
        {"cube a b c d e f filter=linear", {"a", "b", "c", "d", "e", "f"}, false},
        {"cube a b c \"my d\" e \"f\" \"six faces\"", {"a", "b", "c", "my d", "e", "f"}, false},
    };
    for (const auto& c : cases) {
        const auto read = sampler(SamplerType::samplerCube, c.annotation);
        EXPECT_EQ(all(read.complaints), "") << c.annotation;
        EXPECT_EQ(read.annotation.sampler.files, c.files) << c.annotation;
        EXPECT_EQ(read.annotation.sampler.vflip, c.vflip) << c.annotation;
    }
}

TEST(SamplerAnnotation, SaysWhatIsWrongWithFiles) {
    const struct {
        SamplerType type;
        const char* annotation;
        std::size_t at;
        const char* text;
    } cases[] = {
        {SamplerType::samplerCube, "cube", 4, "a cube is one file, or six"},
        {SamplerType::samplerCube, "cube a b c", 5, "and not 3"},
        {SamplerType::samplerCube, "cube a b c d e f g", 5, "and not 7"},
        {SamplerType::samplerCube, "image a.png", 6, "write cube sky.hdr here"},
        {SamplerType::sampler2D, "cube a.png", 5, "a cube is a samplerCube"},
        {SamplerType::sampler2D, "volume a.bin", 7, "is a sampler3D"},
        {SamplerType::sampler3D, "sound a.ogg", 6, "write volume clouds.bin here"},
        {SamplerType::sampler2D, "sound", 5, "the path is missing; write sound song.ogg"},
        {SamplerType::sampler3D, "volume", 6, "the path is missing; write volume clouds.bin"},
        {SamplerType::sampler3D, "volume a.bin vflip=on", 13, "unknown word 'vflip'"},
    };
    for (const auto& c : cases) {
        const auto read = sampler(c.type, c.annotation);
        ASSERT_EQ(read.complaints.size(), 1u) << c.annotation;
        EXPECT_EQ(read.complaints[0].at, c.at) << c.annotation;
        EXPECT_NE(read.complaints[0].text.find(c.text), std::string::npos)
            << c.annotation << ": " << read.complaints[0].text;
    }
}

TEST(SamplerAnnotation, ReadsImagesAndNoise) {
    const auto image = sampler(SamplerType::sampler2D, "image \"my wood.png\" vflip=off");
    ASSERT_EQ(all(image.complaints), "");
    EXPECT_EQ(image.annotation.sampler.files.at(0), "my wood.png");
    EXPECT_FALSE(image.annotation.sampler.vflip);

    const struct {
        SamplerType type;
        const char* annotation;
        int channels;
        glm::ivec3 size;
    } cases[] = {
        {SamplerType::sampler2D, "noise 256", 4, {256, 256, 1}},
        {SamplerType::sampler2D, "noise rgb 64x32 wrap=clamp", 3, {64, 32, 1}},
        {SamplerType::sampler2D, "noise gray 8", 1, {8, 8, 1}},
        {SamplerType::sampler3D, "noise rg 8x16x32", 2, {8, 16, 32}},
        {SamplerType::sampler3D, "noise r 32", 1, {32, 32, 32}},
    };
    for (const auto& c : cases) {
        const auto read = sampler(c.type, c.annotation);
        EXPECT_EQ(all(read.complaints), "") << c.annotation;
        EXPECT_EQ(read.annotation.sampler.noise_channels, c.channels) << c.annotation;
        EXPECT_EQ(read.annotation.sampler.noise_size, c.size) << c.annotation;
    }
}

TEST(SamplerAnnotation, SaysWhatIsWrongAndWhere) {
    const struct {
        SamplerType type;
        const char* annotation;
        std::size_t at;
        const char* words;
    } cases[] = {
        {SamplerType::sampler2D, "", 0,
         "write pass, buffer, image, cube, volume, sound, noise or keyboard"},
        {SamplerType::sampler2D, "0.5", 0, "write pass"},
        {SamplerType::sampler2D, "pas mainA", 0, "did you mean 'pass'"},
        {SamplerType::sampler2D, "pass", 4, "name of a function"},
        {SamplerType::sampler2D, "pass 3d", 5, "name of a function"},
        {SamplerType::sampler2D, "pass a b", 7, "unknown word 'b'"},
        {SamplerType::sampler2D, "pass a conserves", 7, "conserves has no value; write conserves="},
        {SamplerType::sampler2D, "pass a step 1/60", 7, "step has no value; write step= and what"},
        {SamplerType::sampler2D, "pass format=rgba16f", 5, "the name of a function"},
        {SamplerType::sampler2D, "buffer wrap=repeat", 7, "the name of a sampler"},
        {SamplerType::sampler2D, "pass a sise=1", 7, "did you mean 'size'"},
        {SamplerType::sampler2D, "pass a size=0", 12, "from 1 to 16384"},
        {SamplerType::sampler2D, "pass a size=16385", 12, "from 1 to 16384"},
        {SamplerType::sampler2D, "pass a size=4x", 12, "from 1 to 16384"},
        {SamplerType::sampler2D, "pass a size=4x4x4", 12, "from 1 to 16384"},
        {SamplerType::sampler2D, "pass a size=99999999999", 12, "from 1 to 16384"},
        {SamplerType::sampler2D, "pass a size=", 12, "from 1 to 16384"},
        {SamplerType::sampler2D, "pass a scale=0", 13, "above 0"},
        {SamplerType::sampler2D, "pass a scale=nan", 13, "above 0"},
        {SamplerType::sampler2D, "pass a size=8 scale=0.5", 20, "contradict"},
        {SamplerType::sampler2D, "pass a step=0", 12, "1/65536"},
        {SamplerType::sampler2D, "pass a step=-1/60", 12, "1/65536"},
        {SamplerType::sampler2D, "pass a step=1/0", 12, "1/65536"},
        {SamplerType::sampler2D, "pass a format=rgba64", 14, "rgba16f"},
        {SamplerType::sampler2D, "pass a format=r16", 14, "did you mean 'r16f'?"},
        {SamplerType::sampler2D, "pass a filter=blurry", 14, "nearest, linear or mipmap"},
        {SamplerType::sampler2D, "pass a wrap=round", 12, "clamp, repeat or mirror"},
        {SamplerType::sampler2D, "pass a wrap=clamp wrap=clamp", 18, "second wrap="},
        {SamplerType::sampler2D, "buffer a size=4", 9, "unknown word 'size'"},
        {SamplerType::sampler2D, "image", 5, "path is missing"},
        {SamplerType::sampler2D, "image \"a", 6, "never closed"},
        {SamplerType::sampler2D, "image a vflip=maybe", 14, "on or off"},
        {SamplerType::sampler2D, "noise 8 plays=now", 14, "on or off"},
        {SamplerType::sampler2D, "keyboard plays=on", 9, "unknown word 'plays'"},
        {SamplerType::sampler2D, "noise", 5, "size of the noise is missing"},
        {SamplerType::sampler2D, "noise rgba", 6, "size of the noise is missing"},
        {SamplerType::sampler2D, "noise 0", 6, "from 1 to"},
        {SamplerType::sampler2D, "noise 4x4x4", 6, "no noise"},
        {SamplerType::sampler3D, "noise 4x4", 6, "no noise"},
        {SamplerType::sampler3D, "noise 16384", 6, "more noise than memory"},
        {SamplerType::samplerCube, "noise 4x4", 6, "noise rgba 64"},
        {SamplerType::samplerCube, "keyboard", 0, "sampler2D"},
        {SamplerType::sampler3D, "pass a", 0, "no sampler3D"},
        {SamplerType::samplerCube, "pass a size=4x8", 12, "square"},
        {SamplerType::samplerCube, "pass a scale=0.5", 13, "no scale"},
    };
    for (const auto& c : cases) {
        const std::vector<Complaint> complaints = sampler(c.type, c.annotation).complaints;
        ASSERT_FALSE(complaints.empty()) << c.annotation;
        EXPECT_EQ(complaints.front().at, c.at) << c.annotation << "\n" << all(complaints);
        EXPECT_NE(complaints.front().text.find(c.words), std::string::npos) << c.annotation << "\n"
                                                                            << all(complaints);
    }
}

TEST(Step, IsExactAndReduced) {
    EXPECT_EQ(parse_step("1/240"), (Step{1, 240}));
    EXPECT_EQ(parse_step("2/480"), (Step{1, 240}));
    EXPECT_EQ(parse_step("0.005"), (Step{1, 200}));
    EXPECT_EQ(parse_step("1.5/60"), (Step{1, 40}));
    EXPECT_EQ(parse_step("2"), (Step{2, 1}));
    for (const char* wrong : {"", "/", "1/", "/2", "0", "1/0", "-1", "1e-3", "1//2", "1/2/3",
                              "99999999999999999999", "."})
        EXPECT_FALSE(parse_step(wrong)) << wrong;
}

TEST(TweakValue, ReadsBackExactlyWhatItWrote) {
    Tweak number, colour, vector, integer, menu, boolean;
    colour.type = TweakType::vec4;
    colour.is_colour = true;
    vector.type = TweakType::vec3;
    integer.type = TweakType::int1;
    menu.type = TweakType::int1;
    menu.names = {"1", "0", "screen space"};  // names that look like indices are names first
    boolean.type = TweakType::bool1;
    const struct {
        const Tweak& tweak;
        TweakValue value;
        const char* text;
    } cases[] = {
        {number, {0.1}, "0.1"},
        {number, {1.0 / 3}, "0.3333333333333333"},
        {number, {1e-7}, "1e-07"},
        {number, {-0.0}, "-0"},
        {number, {std::numeric_limits<float>::max()}, "3.4028234663852886e+38"},
        {vector, {0.1, -2, 1e-9}, "0.1, -2, 1e-09"},
        {colour, {1, 0, 128 / 255.0, 1}, "#ff0080ff"},
        {colour, {1, 0, 0.5, 1}, "1, 0, 0.5, 1"},
        {colour, {2, 0, 0, 1}, "2, 0, 0, 1"},
        {integer, {1000000}, "1000000"},
        {integer, {-2147483648.0}, "-2147483648"},
        {menu, {1}, "0"},
        {menu, {2}, "screen space"},
        {boolean, {1}, "on"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(format_value(c.tweak, c.value), c.text);
        EXPECT_EQ(parse_value(c.tweak, c.text), c.value) << c.text;
    }
    for (int i = 0; i < 256; ++i) {
        const TweakValue grey{i / 255.0, i / 255.0, i / 255.0, i / 255.0};
        EXPECT_EQ(parse_value(colour, format_value(colour, grey)), grey);
    }
}

TEST(TweakValue, IsMovedIntoItsRange) {
    Tweak number, integer, menu, boolean;
    number.initial = {0.25};
    number.min = 0.0;
    number.max = 1.0;
    integer.type = TweakType::int1;
    menu.type = TweakType::int1;
    menu.names = {"a", "b"};
    boolean.type = TweakType::bool1;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const struct {
        const Tweak& tweak;
        double value, clamped;
    } cases[] = {
        {number, 0.5, 0.5},  {number, -kInf, 0.0},           {number, 7, 1.0}, {number, kNan, 0.25},
        {integer, 2.6, 3.0}, {integer, 1e300, 2147483647.0}, {menu, 5.0, 1.0}, {menu, -1.0, 0.0},
        {boolean, 0.7, 1.0}, {boolean, -3.0, 0.0},
    };
    for (const auto& c : cases)
        EXPECT_EQ(clamp_to_range(c.tweak, {c.value, 9, 9, 9}), (TweakValue{c.clamped}));
}

}  // namespace
}  // namespace glint::annotation_test
