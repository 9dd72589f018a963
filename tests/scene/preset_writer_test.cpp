// Saving a preset: it reads back as the same, and what the person wrote stays.
#include "scene/preset_writer.h"

#include "../base/test_folder.h"
#include "base/words.h"
#include "scene/toml_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace glint::preset_writer_test {
namespace {

constexpr const char* kScene = R"(
uniform float choppiness;   //@ 0.6 [0, 1] "waves"
uniform float depth;        //@ 5 [-1e30, 1e30] "any"
uniform vec3  waterTint;    //@ #0b3a53 "colour"
uniform vec4  glow;         //@ #0b3a5380 "colour"
uniform vec2  shift;        //@ 0, 0 "pad"
uniform bool  firstPerson;  //@ off "eye"
uniform int   reflections;  //@ 1 {off, screen-space, traced} "menu"
uniform int   marchSteps;   //@ 64 [8, 1024] "steps"
uniform sampler2D waves;    //@ pass mainWaves
void mainWaves(out vec4 c, in vec2 p) { c = vec4(0); }
void mainImage(out vec4 c, in vec2 p) { c = vec4(0); }
)";

// A scene, and a preset of it at presets/look.toml.
class PresetWriter : public testing::Test {
protected:
    Preset preset() { return *read_preset(scene_).preset; }

    std::size_t tweak(std::string_view name) {
        const Scene scene = preset().scene;
        for (std::size_t i = 0; i < scene.tweaks.size(); ++i)
            if (scene.tweaks[i].name == name) return i;
        ADD_FAILURE() << name;
        return 0;
    }

    Preset with(std::string_view name, const TweakValue& value, Preset from) {
        from.values[tweak(name)] = value;
        return from;
    }

    Preset read(std::string_view text) {
        const ReadPreset result = read_preset(folder_.write("presets/look.toml", text));
        if (result.preset) return *result.preset;
        ADD_FAILURE() << text;
        return preset();
    }

    // Saves, and checks that it reads back as the same and that a second save changes nothing.
    std::string save(const Preset& preset, std::string_view existing = "") {
        const PresetText saved = write_preset(preset, file_, existing);
        if (!saved.text) {
            ADD_FAILURE() << to_string(saved.diagnostics.at(0)) << "\n" << existing;
            return {};
        }
        expect_same(read(*saved.text), preset);
        EXPECT_EQ(write_preset(preset, file_, *saved.text).text, saved.text) << "a second time";
        return *saved.text;
    }

    void expect_same(const Preset& a, const Preset& b) {
        EXPECT_EQ(a.title, b.title);
        EXPECT_EQ(a.time, b.time);
        EXPECT_EQ(a.size, b.size);
        EXPECT_EQ(a.settle, b.settle);
        EXPECT_EQ(toml_date(a.date), toml_date(b.date));
        EXPECT_EQ(a.values, b.values);
        EXPECT_TRUE(std::ranges::is_permutation(a.locked, b.locked));
        EXPECT_EQ(a.watch, b.watch);
        for (std::size_t i = 0; i < a.values.size(); ++i)
            EXPECT_EQ(std::signbit(a.values[i][0]), std::signbit(b.values[i][0]));
        for (std::size_t i = 0; i < 4; ++i) {
            const Preset* of[] = {&a, &b};
            std::string text[2];
            for (std::size_t k = 0; k < 2; ++k)
                text[k] = toml_braces(
                    toml_channel(of[k]->channels[i], a.scene, folder_.path() / "presets"));
            EXPECT_EQ(text[0], text[1]);
        }
        ASSERT_EQ(a.events.size(), b.events.size());
        for (std::size_t i = 0; i < a.events.size(); ++i)
            EXPECT_EQ(toml_braces(toml_event(a.events[i])), toml_braces(toml_event(b.events[i])));
    }

    TestFolder folder_;
    std::filesystem::path scene_ = folder_.write("fragments/boat.frag", kScene);
    std::filesystem::path file_ = folder_.path() / "presets" / "look.toml";
};

TEST_F(PresetWriter, ANewFileIsWholeAndReadable) {
    Preset look = preset();
    look.title = "Harbour at \"dusk\"";
    look.time = 12.0;
    look = with("choppiness", {0.3}, look);
    look = with("waterTint", {1.0, 0.0, 128 / 255.0}, look);
    look = with("glow", {1.0, 0.5, 0.25, 1.0}, look);
    look = with("firstPerson", {1}, look);
    look = with("reflections", {2}, look);
    look = with("marchSteps", {100}, look);
    look.channels[1].source = Source::image;
    look.channels[1].filter = Filter::mipmap;
    look.channels[1].files = {folder_.path() / "textures/oak.png"};
    look.events = {{.time = 0.5, .key = 38, .down = true},
                   {.time = 2.0, .key = -1, .down = true, .mouse = {0.5, 0.4}}};
    EXPECT_EQ(save(look), R"(scene = "../fragments/boat.frag"
title = "Harbour at \"dusk\""
time = 12.0
size = [1280, 720]

[tweaks]
choppiness = 0.3
waterTint = "#ff0080"
glow = [1.0, 0.5, 0.25, 1.0]
firstPerson = true
reflections = "traced"
marchSteps = 100

[channels]
iChannel1 = { image = "../textures/oak.png", wrap = "clamp" }

[[events]]
t = 0.5
key = "up"
down = true
[[events]]
t = 2.0
mouse = [0.5, 0.4]
down = true
)");
}

TEST_F(PresetWriter, ALookOfDefaultsSaysWhichSceneWhenAndHowLarge) {
    EXPECT_EQ(save(preset()),
              "scene = \"../fragments/boat.frag\"\ntime = 0.0\nsize = [1280, 720]\n");
}

TEST_F(PresetWriter, ThePersonsOwnTextStays) {
    const std::string before = R"(# my harbour
scene   = '../fragments/boat.frag'   # relative

time=3
mood = "calm" # nobody knows this

# --- waves
[tweaks]
  # tuned by hand
  marchSteps  = 0x40  # sixty-four
  choppiness = 0.30   # was 0.5
  waterTint = '#0B3A53'

# the end
[other]
x = [1,
  2]
)";
    EXPECT_EQ(save(read(before), before), before) << "nothing changed";
    Preset look = with("choppiness", {0.4}, read(before));
    look = with("shift", {0.5, -1}, look);
    look.size = {640, 360};
    EXPECT_EQ(save(look, before), R"(# my harbour
scene   = '../fragments/boat.frag'   # relative

time=3
mood = "calm" # nobody knows this
size = [640, 360]

# --- waves
[tweaks]
  # tuned by hand
  marchSteps  = 0x40  # sixty-four
  choppiness = 0.4   # was 0.5
  waterTint = '#0B3A53'
  shift = [0.5, -1.0]

# the end
[other]
x = [1,
  2]
)");
}

TEST_F(PresetWriter, AddsATweakToAnyFormOfTheTable) {
    const std::string head = "scene = \"../fragments/boat.frag\"\n";
    struct Case {
        const char *before, *after;
    };
    const Case cases[] = {
        {"", "\n[tweaks]\nchoppiness = 0.3\n"},
        {"[tweaks]", "[tweaks]\nchoppiness = 0.3\n"},
        {"[tweaks] # hers\n", "[tweaks] # hers\nchoppiness = 0.3\n"},
        {"[ tweaks ]\n\n\n", "[ tweaks ]\nchoppiness = 0.3\n\n\n"},
        {"[tweaks]\nmarchSteps = 9\n", "[tweaks]\nmarchSteps = 9\nchoppiness = 0.3\n"},
        {"[tweaks]\n\tmarchSteps = 9 # é", "[tweaks]\n\tmarchSteps = 9 # é\n\tchoppiness = 0.3\n"},
        {"[tweaks]\nshift = [\n 1, # x\n 2,\n] # y\n# z\n",
         "[tweaks]\nshift = [\n 1, # x\n 2,\n] # y\nchoppiness = 0.3\n# z\n"},
        {"[tweaks]\ngone = \"\"\"\n[x]\n\"\"\"\n[b]\n",
         "[tweaks]\ngone = \"\"\"\n[x]\n\"\"\"\nchoppiness = 0.3\n[b]\n"},
        {"tweaks = {}\n", "tweaks = { choppiness = 0.3 }\n"},
        {"tweaks = { marchSteps = 9 } # t\n",
         "tweaks = { marchSteps = 9, choppiness = 0.3 } # t\n"},
        {"tweaks.marchSteps = 9 # d\n", "tweaks.marchSteps = 9 # d\ntweaks.choppiness = 0.3\n"},
        {"tweaks = 3\n", "tweaks = { choppiness = 0.3 }\n"},
        {"[tweaks.sub]\nx = 1\n", "\n[tweaks]\nchoppiness = 0.3\n[tweaks.sub]\nx = 1\n"},
        {"[tweaks]\nchoppiness = 0.5 # a\n", "[tweaks]\nchoppiness = 0.3 # a\n"},
        {"[tweaks]\n\"choppiness\" = \"0.5\"\n", "[tweaks]\n\"choppiness\" = 0.3\n"},
        {"[tweaks]\nchoppiness = [1, 2]\n", "[tweaks]\nchoppiness = 0.3\n"},
        {"[[events]]\nt = 1\nkey = \"up\"\ndown = true\n",
         "\n[tweaks]\nchoppiness = 0.3\n[[events]]\nt = 1\nkey = \"up\"\ndown = true\n"},
    };
    for (const Case& c : cases) {
        const std::string before = head + c.before;
        EXPECT_EQ(save(with("choppiness", {0.3}, read(before)), before), head + c.after);
    }
}

TEST_F(PresetWriter, LocksAreAListThatIsWrittenWhereItStands) {
    const std::string text =
        "scene = \"../fragments/boat.frag\"\nlocked = [\"depth\", \"gone\"] # mine\n";
    Preset preset = read(text);
    EXPECT_EQ(preset.locked, (std::vector<std::string>{"depth", "gone"})) << "some day it is back";
    EXPECT_EQ(save(preset, text), text);
    preset.locked = {"shift"};
    EXPECT_NE(save(preset, text).find("locked = [\"shift\"] # mine\n"), std::string::npos);
    preset.locked.clear();
    EXPECT_NE(save(preset, text).find("locked = [] # mine\n"), std::string::npos);
    EXPECT_EQ(save(preset).find("locked"), std::string::npos) << "none, and none was written";
}

TEST_F(PresetWriter, AListKeepsTheCommentsInIt) {
    const std::string head = "scene = \"../fragments/boat.frag\"\n";
    const auto saved = [&](const std::string& list, const std::vector<std::string>& names) {
        Preset preset = read(head + list);
        preset.locked = names;
        return save(preset, head + list).substr(head.size());
    };
    const std::string list =
        "locked = [  # mine\n  \"depth\",  # of the sea\n  \"shift\"   # of the sun\n]\n";
    EXPECT_EQ(saved(list, {"depth", "shift", "gone"}),
              "locked = [  # mine\n  \"depth\",  # of the sea\n  \"shift\",   # of the sun\n"
              "  \"gone\",\n]\n");
    EXPECT_EQ(saved(list, {"shift"}), "locked = [  # mine\n  \"shift\"   # of the sun\n]\n");
    EXPECT_EQ(saved(list, {"depth"}), "locked = [  # mine\n  \"depth\",  # of the sea\n]\n");
    EXPECT_EQ(saved(list, {"shift", "depth"}), list) << "their order says nothing";
    EXPECT_EQ(saved(list, {"gone", "shift"}),
              "locked = [  # mine\n  \"shift\",   # of the sun\n  \"gone\",\n]\n");
    EXPECT_EQ(saved(list, {}), "locked = [  # mine\n]\n");
    const std::string row = "locked = [ # both\n\"depth\", \"shift\" ]\n";
    EXPECT_EQ(saved(row, {"shift", "gone"}), "locked = [ # both\n\"shift\", \"gone\" ]\n");
    EXPECT_EQ(saved(row, {"depth"}), "locked = [ # both\n\"depth\", ]\n");
    EXPECT_EQ(saved("locked = [ # none\n]\n", {"depth"}), "locked = [ # none\n    \"depth\",\n]\n");
    const std::string comma = "locked = [ # both\n\"depth\" # one\n, \"shift\" ]\n";
    EXPECT_EQ(saved(comma, {"shift"}), "locked = [\"shift\"]\n");
    const std::string last = "locked = [ # one\n\"depth\" # it\n, ]\n";
    EXPECT_EQ(saved(last, {"depth", "shift"}), "locked = [\"depth\", \"shift\"]\n");
}

TEST_F(PresetWriter, WhatIsWatchedIsAListOfItsOwn) {
    const std::string text = "scene = \"../fragments/boat.frag\"\nwatch = [\"nor@12\"] # mine\n";
    Preset preset = read(text);
    EXPECT_EQ(preset.watch, (std::vector<std::string>{"nor@12"}));
    EXPECT_EQ(save(preset, text), text);
    preset.watch.push_back("dot(nor, rd)@shared.glsl:3");
    EXPECT_NE(
        save(preset, text).find("watch = [\"nor@12\", \"dot(nor, rd)@shared.glsl:3\"] # mine"),
        std::string::npos);
    preset.watch.clear();
    EXPECT_EQ(save(preset).find("watch"), std::string::npos);
}

TEST_F(PresetWriter, LineEndsAndByteOrderMarksStay) {
    const std::string before =
        "\xEF\xBB\xBFscene = \"../fragments/boat.frag\" # \xC3\xA9\r\n\r\n[tweaks]\r\ndepth = "
        "1\r\n";
    Preset look = with("choppiness", {0.3}, read(before));
    look.title = "\xC3\xA9";
    EXPECT_EQ(
        save(with("depth", {2}, look), before),
        "\xEF\xBB\xBFscene = \"../fragments/boat.frag\" # \xC3\xA9\r\ntitle = \"\xC3\xA9\"\r\n"
        "\r\n[tweaks]\r\ndepth = 2.0\r\nchoppiness = 0.3\r\n");
}

TEST_F(PresetWriter, AValueBackAtItsDefaultKeepsItsLine) {
    const std::string before =
        "scene = \"../fragments/boat.frag\"\n[tweaks]\nchoppiness = 0.3 # x\n";
    EXPECT_EQ(save(preset(), before),
              "scene = \"../fragments/boat.frag\"\n[tweaks]\nchoppiness = 0.6 # x\n");
}

TEST_F(PresetWriter, AFaultyLineStaysUntilItsValueChanges) {
    const std::string before =
        "scene = \"../fragments/boat.frag\"\ntime = \"soon\"\n[tweaks]\nfirstPerson = 3\n";
    EXPECT_EQ(save(read(before), before), before);
}

TEST_F(PresetWriter, EveryNumberReadsBackToTheBit) {
    std::mt19937_64 random(1);
    std::vector<double> numbers = {
        -0.0, 0.0, 1e-300, 5e-324, 1.0 / 3, 1e20, -1e20, 1e30, 123456789012345680000.0, 0.1 + 0.2};
    for (int k = 0; k < 200; ++k) {
        const auto exponent = static_cast<int>(random() % 180) - 90;
        numbers.push_back(std::ldexp(static_cast<double>(random() % (1ull << 53)), exponent - 53));
    }
    std::string text;
    for (const double number : numbers) {
        Preset look = with("depth", {number}, preset());
        look.time = std::min(std::abs(number), 1e9);
        text = save(look, text);
    }
}

TEST_F(PresetWriter, AMenuWithTheSameNameTwiceIsWrittenByItsIndex) {
    Tweak menu;
    menu.type = TweakType::int1;
    menu.names = {"a", "b", "a", " c"};
    const char* expected[] = {"\"a\"", "\"b\"", "2", "3"};
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(toml_value(menu, {static_cast<double>(i)}), expected[i]);
}

TEST_F(PresetWriter, DatesKeepTheirFractions) {
    struct Case {
        double seconds;
        const char* text;
    };
    const Case cases[] = {{0.0, "2024-02-29T00:00:00"},
                          {43200.5, "2024-02-29T12:00:00.5"},
                          {86399.999999999, "2024-02-29T23:59:59.999999999"}};
    for (const Case& c : cases) {
        Preset look = preset();
        look.date = {.year = 2024, .month = 2, .day = 29, .seconds = c.seconds};
        EXPECT_NE(save(look).find(c.text), std::string::npos) << c.text;
    }
}

TEST_F(PresetWriter, ChannelsAreSetChangedAndTurnedOff) {
    const std::string head = "scene = \"../fragments/boat.frag\"\n";
    struct Case {
        const char *before, *after;
    };
    // Channel 0 becomes noise, channel 1 is turned off.
    const Case cases[] = {
        {"", "\n[channels]\niChannel0 = { noise = \"rg 64\" }\n"},
        {"[channels]\niChannel0 = { image = \"x.png\" } # a\niChannel1 = { keyboard = true }\n# "
         "b\n",
         "[channels]\niChannel0 = { noise = \"rg 64\" } # a\n# b\n"},
        {"[channels]\niChannel1 = { keyboard = true }\n",
         "[channels]\niChannel0 = { noise = \"rg 64\" }\n"},
        {"[tweaks]\ndepth = 1\n[channels.iChannel1]\nkeyboard = true\n[other]\n",
         "[tweaks]\ndepth = 1\n\n[channels]\niChannel0 = { noise = \"rg 64\" }\n[other]\n"},
        {"[channels.iChannel2]\nbuffer = \"waves\"\n",
         "\n[channels]\niChannel0 = { noise = \"rg 64\" }\n[channels.iChannel2]\nbuffer = "
         "\"waves\"\n"},
        {"channels = { iChannel1 = { keyboard = true }, iChannel2 = { buffer = \"waves\" } }\n",
         "channels = { iChannel0 = { noise = \"rg 64\" }, iChannel2 = { buffer = \"waves\" } }\n"},
        {"channels.iChannel1.keyboard = true\n", "channels.iChannel0 = { noise = \"rg 64\" }\n"},
    };
    for (const Case& c : cases) {
        const std::string before = head + c.before;
        Preset look = read(before);
        Sampler& noise = look.channels[0] = {};
        noise.source = Source::noise;
        noise.filter = Filter::mipmap;
        noise.wrap = Wrap::repeat;
        noise.noise_channels = 2;
        noise.noise_size = {64, 64, 1};
        look.channels[1] = {};
        EXPECT_EQ(save(look, before), head + c.after);
    }
}

TEST_F(PresetWriter, EveryKindOfChannelReadsBack) {
    const char* channels[] = {
        "image = \"../a b/oak.png\", filter = \"nearest\", vflip = false",
        "noise = \"r 64x32\", wrap = \"mirror\"",
        "noise = \"rgba 32x16x8\"",
        "noise = \"r 512x2\", filter = \"linear\", plays = true",
        "keyboard = true",
        "buffer = \"waves\", filter = \"mipmap\"",
        "cube = \"../sky.hdr\", vflip = true",
        "cube = [\"px.png\", \"nx.png\", \"py.png\", \"ny.png\", \"pz.png\", \"nz.png\"]",
        "volume = \"../clouds.bin\", filter = \"linear\"",
        "sound = \"song.ogg\"",
    };
    for (const char* channel : channels) {
        const Preset look = read("scene = \"../fragments/boat.frag\"\nchannels = { iChannel3 = { " +
                                 std::string(channel) + " } }\n");
        ASSERT_NE(look.channels[3].source, Source::none) << channel;
        save(look);
    }
}

TEST_F(PresetWriter, EventsAreWrittenAnewOnlyWhereTheyDiffer) {
    const std::string head = "scene = \"../fragments/boat.frag\"\n";
    const char* const kNew = "[[events]]\nt = 7.0\nkey = \"a\"\ndown = true\n";
    const std::string one = "[[events]] # x\nt = 1\nkey = \"up\"\ndown = true\n";
    struct Case {
        std::string before, after;
    };
    const Case cases[] = {
        {"", std::string("\n") + kNew},
        {"title = \"x\"", std::string("title = \"x\"\n\n") + kNew},
        {one, kNew},
        {one + "\n# then\n\n" + one + "# end\n", kNew + std::string("# end\n")},
        {one + "[tweaks]\ndepth = 2\n" + one, kNew + std::string("[tweaks]\ndepth = 2\n")},
        {"events = []\n", "events = [\n    { t = 7.0, key = \"a\", down = true },\n]\n"},
        {"events = 3\n", "events = [\n    { t = 7.0, key = \"a\", down = true },\n]\n"},
    };
    for (const Case& c : cases) {
        Preset look = read(head + c.before);
        EXPECT_EQ(save(look, head + c.before), head + c.before) << "nothing changed";
        look.events = {{.time = 7.0, .key = 65, .down = true}};
        EXPECT_EQ(save(look, head + c.before), head + c.after);
    }
    Preset look = read(head + one + "[other]\n");
    look.events.clear();
    EXPECT_EQ(save(look, head + one + "[other]\n"), head + "[other]\n");
}

TEST_F(PresetWriter, SavingElsewhereKeepsTheTextAndMovesThePaths) {
    const std::string before =
        "# mine\nscene = \"../fragments/boat.frag\" # s\n"
        "[channels]\niChannel0 = { image = \"oak.png\" }\n";
    const Preset look = read(before);
    const std::string expected =
        "# mine\nscene = \"../../fragments/boat.frag\" # s\n"
        "[channels]\niChannel0 = { image = \"../oak.png\" }\n";
    EXPECT_EQ(*write_preset(look, folder_.path() / "presets/deep/look.toml", before).text,
              expected);
}

TEST_F(PresetWriter, ASceneBehindLinksIsFoundAgain) {
    namespace fs = std::filesystem;
    folder_.write("far/away/x", "");
    fs::create_directory_symlink(folder_.path() / "far/away", folder_.path() / "looks");
    fs::create_symlink(scene_, folder_.path() / "fragments/linked.frag");
    const Preset look = *read_preset(folder_.path() / "fragments/linked.frag").preset;
    const fs::path file = folder_.path() / "looks/look.toml";
    const std::string text = *write_preset(look, file).text;
    EXPECT_TRUE(text.starts_with("scene = \"../../fragments/linked.frag\"\n")) << text;
    EXPECT_TRUE(read_preset(folder_.write("looks/look.toml", text)).preset);
}

// As on a command line: names are seen from the current folder.
TEST_F(PresetWriter, BareAndRelativeNamesLeadFromOneFolderToTheOther) {
    namespace fs = std::filesystem;
    const fs::path before = fs::current_path();
    fs::current_path(folder_.path() / "fragments");
    const Preset look = *read_preset("boat.frag").preset;
    const struct {
        const char *file, *scene;
    } cases[] = {{"look.toml", "boat.frag"},
                 {"./look.toml", "boat.frag"},
                 {"../look.toml", "fragments/boat.frag"},
                 {"../presets/look.toml", "../fragments/boat.frag"}};
    for (const auto& [file, scene] : cases) {
        const PresetText bare = write_preset(look, file);
        const PresetText whole = write_preset(look, fs::absolute(file));
        ASSERT_TRUE(bare.text && whole.text) << file;
        EXPECT_EQ(*bare.text, *whole.text);
        EXPECT_NE(bare.text->find(std::string("scene = \"") + scene + "\"\n"), std::string::npos)
            << *bare.text;
    }
    fs::current_path(before);
}

TEST_F(PresetWriter, WhatIsNoTomlIsAnErrorAtItsPlace) {
    const PresetText saved = write_preset(preset(), file_, "scene = \"x\"\ntime = \n");
    EXPECT_FALSE(saved.text);
    ASSERT_EQ(saved.diagnostics.size(), 1u);
    EXPECT_EQ(saved.diagnostics[0].place.line, 2);
}

TEST_F(PresetWriter, WhatCannotBeWrittenIsAnErrorAndNoBrokenFile) {
    Preset look = preset();
    look.title = "\xFF";
    const PresetText saved = write_preset(look, file_);
    EXPECT_FALSE(saved.text);
    EXPECT_FALSE(saved.diagnostics.empty());
}

TEST_F(PresetWriter, ATitleThatIsNoneTakesItsLineAlong) {
    EXPECT_EQ(
        save(preset(), "scene = \"../fragments/boat.frag\"\ntitle = \"Dusk\"  # mine\ntime = 2\n")
            .find("title"),
        std::string::npos);
}

TEST_F(PresetWriter, ATitleThatStandsThereEmptyOrWrongStays) {
    for (const char* title : {"title = \"\"  # later\n", "title = 7\n"}) {
        const std::string text = "scene = \"../fragments/boat.frag\"\n" + std::string(title);
        EXPECT_EQ(write_preset(read(text), file_, text).text, text);
    }
}

TEST_F(PresetWriter, TellsAPresetOfTheSameSceneFromOthers) {
    const Scene scene = preset().scene;
    EXPECT_TRUE(names_scene("# a\nscene = \"../x/../fragments/boat.frag\"\n", file_, scene));
    for (const char* text : {"scene = \"../other.frag\"\n", "scene = 3\n", "scene = \n", ""})
        EXPECT_FALSE(names_scene(text, file_, scene)) << text;
    std::string deep = "a";
    for (int i = 0; i < 300'000; ++i) deep += ".a";
    EXPECT_FALSE(names_scene(deep + " = 1", file_, scene)) << "what would overflow the stack";
}

}  // namespace
}  // namespace glint::preset_writer_test
