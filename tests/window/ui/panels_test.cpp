// The panels under a mouse: every kind of tweak moves, one drag is one entry, nothing makes them
// fall.
#include "screen.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

// fontconfig keeps a table of 288 bytes to the end. The sanitizer asks for this by name.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig";
}

namespace glint::panels_test {
namespace {

Tweak of_type(TweakType type, TweakValue initial = {}) {
    Tweak tweak;
    tweak.name = "it";
    tweak.type = type;
    tweak.initial = initial;
    return tweak;
}

std::vector<Tweak> two_numbers() {
    return {number("left", 0.25, 0, 1), number("right", 0.5, 0, 1)};
}

ImVec2 at(const ImRect& rect, float x, float y = 0.5f) {
    return {rect.Min.x + x * rect.GetWidth(), rect.Min.y + y * rect.GetHeight()};
}

TEST(Tweaks, DraggingASliderIsOneEntryOfTheUndoList) {
    Screen screen(two_numbers());
    const auto slider = screen.find(screen.in_row(1, "##slider"));
    ASSERT_TRUE(slider);
    screen.drag(at(*slider, 0.5f), at(*slider, 0.9f));
    EXPECT_TRUE(screen.changed);
    EXPECT_NEAR(screen.tweaks.value(1)[0], 0.9, 0.03);
    EXPECT_EQ(screen.tweaks.value(0)[0], 0.25);
    EXPECT_FALSE(screen.tweaks.is_open());
    EXPECT_TRUE(screen.tweaks.undo());
    EXPECT_EQ(screen.tweaks.value(1)[0], 0.5);
    EXPECT_FALSE(screen.tweaks.can_undo());
}

TEST(Tweaks, TheEndsOfASliderAreTheEndsOfTheRange) {
    Tweak tweak = number("it", 2.0, 0.1, 100);
    tweak.log = true;
    Screen screen({tweak});
    const auto slider = screen.find(screen.in_row(0, "##slider"));
    ASSERT_TRUE(slider);
    screen.drag(at(*slider, 0.5f), at(*slider, 1.5f));
    EXPECT_EQ(screen.tweaks.value(0)[0], 100.0);
    screen.drag(at(*slider, 0.5f), at(*slider, -0.5f));
    EXPECT_EQ(screen.tweaks.value(0)[0], 0.1);
}

TEST(Tweaks, ADoubleClickOnTheLabelResets) {
    Screen screen(two_numbers());
    screen.tweaks.set(0, {0.75});
    const auto label = screen.find(screen.in_row(0, "label"));
    ASSERT_TRUE(label);
    screen.click(at(*label, 0.5f));
    EXPECT_EQ(screen.tweaks.value(0)[0], 0.75);
    screen.click(at(*label, 0.5f));
    EXPECT_EQ(screen.tweaks.value(0)[0], 0.25);
    screen.tweaks.undo();
    EXPECT_EQ(screen.tweaks.value(0)[0], 0.75);
}

TEST(Tweaks, AValueIsTypedAfterCtrlAndClick) {
    Screen screen(two_numbers());
    const auto slider = screen.find(screen.in_row(0, "##slider"));
    ASSERT_TRUE(slider);
    ImGui::GetIO().KeyCtrl = true;
    screen.click(at(*slider, 0.9f));
    ImGui::GetIO().KeyCtrl = false;
    for (int i = 0; i < 3; ++i) screen.frame();
    EXPECT_EQ(screen.tweaks.value(0)[0], 0.25) << "the click must not move the slider";
    screen.type("0.625");
    screen.press(ImGuiKey_Enter);
    EXPECT_EQ(screen.tweaks.value(0)[0], 0.625);
    screen.tweaks.undo();
    EXPECT_FALSE(screen.tweaks.can_undo()) << "typing is one entry";
}

TEST(Tweaks, HidingThePanelsEndsADrag) {
    Screen screen(two_numbers());
    const auto slider = screen.find(screen.in_row(0, "##slider"));
    ASSERT_TRUE(slider);
    screen.move(at(*slider, 0.5f));
    screen.button(true);
    screen.move(at(*slider, 0.75f));
    EXPECT_TRUE(screen.tweaks.is_open());
    screen.settings.visible = false;
    for (int i = 0; i < 3; ++i) screen.frame();
    EXPECT_FALSE(screen.tweaks.is_open());
    EXPECT_TRUE(screen.tweaks.can_undo());
    screen.button(false);
}

TEST(Tweaks, TheLockKeepsAValueFromChance) {
    Screen screen(two_numbers());
    const auto lock = screen.find(screen.in_row(1, "lock"));
    ASSERT_TRUE(lock);
    screen.click(at(*lock, 0.5f));
    EXPECT_TRUE(screen.tweaks.locked(1));
    EXPECT_FALSE(screen.tweaks.locked(0));
}

// Every kind of tweak, the control that moves it, and from where to where the mouse drags.
struct Kind {
    const char* name;
    Tweak tweak;
    const char* control;
    int component;
    float to_x, to_y;
};

std::vector<Kind> kinds() {
    const auto ranged = [](Tweak tweak) {
        tweak.min = -1;
        tweak.max = 1;
        return tweak;
    };
    Tweak stepped = number("it", 0.5, 0, 2);
    stepped.step = 0.25;
    Tweak logarithmic = number("it", 2, 0.1, 100);
    logarithmic.log = true;
    Tweak whole = number("it", 3, 1, 9);
    whole.type = TweakType::int1;
    return {
        {"linear", number("it", 0.5, 0, 1), "##slider", -1, 0.9f, 0.5f},
        {"logarithmic", logarithmic, "##slider", -1, 0.9f, 0.5f},
        {"stepped", stepped, "##slider", -1, 0.9f, 0.5f},
        {"whole", whole, "##slider", -1, 0.9f, 0.5f},
        {"no range", of_type(TweakType::float1, {0.5}), "##drag", 0, 0.9f, 0.5f},
        {"whole, no range", of_type(TweakType::int1, {3}), "##drag", 0, 1.5f, 0.5f},
        {"bool", of_type(TweakType::bool1), "##check", -1, 0.5f, 0.5f},
        {"pad", ranged(of_type(TweakType::vec2)), "##pad", -1, 0.9f, 0.9f},
        {"pad's number", ranged(of_type(TweakType::vec2)), "##drag", 1, 0.9f, 0.5f},
        {"vec2", of_type(TweakType::vec2), "##drag", 1, 0.9f, 0.5f},
        {"vec3", of_type(TweakType::vec3), "##drag", 2, 0.9f, 0.5f},
        {"ranged vec3", ranged(of_type(TweakType::vec3)), "##drag", 0, 0.9f, 0.5f},
        {"vec4", of_type(TweakType::vec4), "##drag", 3, 0.9f, 0.5f},
    };
}

TEST(Tweaks, EveryKindIsMovedByTheMouse) {
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        Screen screen({kind.tweak});
        const auto control = screen.find(screen.in_row(0, kind.control, kind.component));
        ASSERT_TRUE(control);
        screen.drag(at(*control, 0.5f), at(*control, kind.to_x, kind.to_y));
        EXPECT_TRUE(screen.tweaks.changed(0));
        EXPECT_TRUE(screen.changed);
        EXPECT_FALSE(screen.tweaks.is_open());
        EXPECT_TRUE(screen.tweaks.undo());
        EXPECT_FALSE(screen.tweaks.can_undo());
    }
}

TEST(Tweaks, APadPointsUpForMore) {
    Tweak tweak = of_type(TweakType::vec2);
    tweak.min = -1;
    tweak.max = 1;
    Screen screen({tweak});
    const auto pad = screen.find(screen.in_row(0, "##pad"));
    ASSERT_TRUE(pad);
    screen.click(at(*pad, 0.75f, 0.25f));
    EXPECT_NEAR(screen.tweaks.value(0)[0], 0.55, 0.1);
    EXPECT_NEAR(screen.tweaks.value(0)[1], 0.55, 0.1);
}

TEST(Tweaks, AMenuIsChosenFrom) {
    Tweak tweak = of_type(TweakType::int1);
    tweak.names = {"off", "screen-space", "traced"};
    Screen screen({tweak});
    const auto menu = screen.find(screen.in_row(0, "##menu"));
    ASSERT_TRUE(menu);
    screen.click(at(*menu, 0.5f));
    screen.frame();
    const ImGuiWindow* list = screen.window("##Combo");
    ASSERT_TRUE(list);
    screen.click(at(list->Rect(), 0.5f, 0.85f));
    EXPECT_EQ(screen.tweaks.value(0)[0], 2.0);
    EXPECT_TRUE(screen.tweaks.undo());
    EXPECT_FALSE(screen.tweaks.can_undo());
}

TEST(Tweaks, AColourIsPickedAndThatIsOneEntry) {
    for (const TweakType type : {TweakType::vec3, TweakType::vec4}) {
        Tweak tweak = of_type(type, {0.2, 0.4, 0.8, 1.0});
        if (type == TweakType::vec3) tweak.initial[3] = 0.0;
        tweak.is_colour = true;
        Screen screen({tweak});
        const ImGuiID group = screen.in_row(0, "##colour");
        const auto swatch = screen.find(ImHashStr("##ColorButton", 0, group));
        ASSERT_TRUE(swatch);
        screen.click(at(*swatch, 0.5f));
        screen.frame();
        const ImGuiWindow* picker = screen.window("##Popup");
        ASSERT_TRUE(picker);
        screen.drag(at(picker->Rect(), 0.1f, 0.1f), at(picker->Rect(), 0.4f, 0.3f));
        EXPECT_TRUE(screen.tweaks.changed(0));
        EXPECT_FALSE(screen.tweaks.is_open());
        EXPECT_TRUE(screen.tweaks.undo());
        EXPECT_FALSE(screen.tweaks.can_undo());
    }
}

TEST(Tweaks, TheSearchKeepsWhatMatches) {
    std::vector<Tweak> tweaks;
    for (int i = 0; i < 12; ++i) tweaks.push_back(number(fmt::format("it{}", i).c_str(), 0, 0, 1));
    tweaks[7].description = "Height of the CRESTS";
    Screen screen(tweaks);
    const auto field = screen.find(ImHashStr("##search", 0, screen.window("Tweaks")->ID));
    ASSERT_TRUE(field);
    screen.click(at(*field, 0.5f));
    screen.type("crest");
    for (int i = 0; i < 4; ++i) screen.frame();
    EXPECT_TRUE(screen.find(screen.in_row(7, "##slider")));
    EXPECT_FALSE(screen.find(screen.in_row(6, "##slider")));
}

TEST(Transport, TheScrubBarMovesTime) {
    Screen screen(two_numbers());
    const ImGuiWindow* bar = screen.window("transport");
    ASSERT_TRUE(bar);
    const auto scrub = screen.find(ImHashStr("scrub", 0, bar->ID), "transport");
    ASSERT_TRUE(scrub);
    screen.drag(at(*scrub, 0.1f), at(*scrub, 0.5f));
    EXPECT_NEAR(screen.transport.time(), 30.0, 1.0);
}

TEST(Transport, TheMarkersOfALoopAreDragged) {
    Screen screen(two_numbers());
    screen.transport.set_loop(Loop{10, 20});
    screen.frame();
    const auto marker = screen.find(ImHashStr("B", 0, screen.window("transport")->ID), "transport");
    ASSERT_TRUE(marker);
    screen.drag(at(*marker, 0.5f), {at(*marker, 0.5f).x + 100, at(*marker, 0.5f).y});
    ASSERT_TRUE(screen.transport.loop());
    EXPECT_EQ(screen.transport.loop()->begin, 10.0);
    EXPECT_GT(screen.transport.loop()->end, 21.0);
    EXPECT_EQ(screen.transport.time(), 0.0) << "the scrub bar beneath must not move";
}

// The line that a click on the last of the list opens.
int line_of_last(const Diagnostics& diagnostics) {
    Screen screen(two_numbers());
    screen.facts.diagnostics = diagnostics;
    for (int i = 0; i < 4; ++i) screen.frame();
    const ImGuiWindow* list = screen.window("diagnostics");
    if (!list) return -1;
    screen.click(at(list->Rect(), 0.5f, 0.8f));
    return screen.wishes.edit ? screen.wishes.edit->place.line : -1;
}

TEST(Errors, AClickOpensTheEditorThere) {
    EXPECT_EQ(line_of_last({{Severity::error, {"none.frag", 3, 1}, "first"},
                            {Severity::error, {"none.frag", 9, 1}, "second"}}),
              9);
}

TEST(Errors, StandBeforeWarnings) {
    EXPECT_EQ(line_of_last({{Severity::warning, {"none.frag", 3, 1}, "odd"},
                            {Severity::error, {"none.frag", 9, 1}, "wrong"}}),
              3);
}

TEST(Transport, ATimeIsTypedInMinutesToo) {
    Screen screen(two_numbers());
    const ImGuiWindow* bar = screen.window("transport");
    const auto field = screen.find(ImHashStr("##time", 0, bar->ID), "transport");
    ASSERT_TRUE(field);
    const auto type = [&](const char* text) {
        screen.click(field->GetCenter());
        screen.frame();
        screen.type(text);
        screen.press(ImGuiKey_Enter);
        screen.frame();
        return screen.transport.time();
    };
    EXPECT_EQ(type("1:30"), 90.0);
    screen.wait();
    EXPECT_EQ(type("soon"), 90.0);
    screen.wait();
    EXPECT_EQ(type("2.5"), 2.5);
    screen.drag(field->GetCenter(), {field->GetCenter().x + 60, field->GetCenter().y});
    EXPECT_GT(screen.transport.time(), 2.5) << "a drag moves it, and opens no field";
}

TEST(Errors, OneClickWishesForWhatFillsAnEmptyChannel) {
    Screen screen({});
    const Diagnostics diagnostics{{Severity::warning, {"none.frag", 3, 1}, "nothing fills it"}};
    std::vector<EmptyChannel> channels{{"iChannel2", {{"noise", {}}, {"wood.png", {}}}}};
    for (EmptyChannel::Offer& offer : channels[0].offers) offer.filler.name = "iChannel2";
    channels[0].offers[1].filler.source = Source::image;
    screen.facts.diagnostics = diagnostics;
    screen.frame();
    screen.facts.empty_channels = channels;  // once the text is drawn
    for (int i = 0; i < 4; ++i) screen.frame();
    const ImGuiWindow* list = screen.window("diagnostics");
    ASSERT_TRUE(list) << "a picture that is black for this reason says so by itself";
    const ImGuiID id = ImHashStr("wood.png", 0, ImHashStr("iChannel2", 0, list->ID));
    const auto button = screen.find(id, "diagnostics");
    ASSERT_TRUE(button);
    screen.click(at(*button, 0.5f));
    ASSERT_TRUE(screen.wishes.fill);
    EXPECT_EQ(screen.wishes.fill->name, "iChannel2");
    EXPECT_EQ(screen.wishes.fill->source, Source::image);
}

// All panels open, over what a person may meet.
void open_all(Screen& screen) {
    PanelSettings& settings = screen.settings;
    settings.passes = settings.browser = settings.help = settings.view.inspect = true;
    settings.study = settings.check = true;
    settings.wipe = true;
    for (int i = 0; i < 4; ++i) screen.frame();
}

TEST(Errors, StandOverPanelsThatAreOpenedLater) {
    Screen screen(two_numbers());
    const Diagnostics diagnostics{{Severity::error, {"none.frag", 3, 1}, "wrong"}};
    screen.facts.diagnostics = diagnostics;
    for (int i = 0; i < 4; ++i) screen.frame();
    open_all(screen);
    const ImGuiWindow* list = screen.window("diagnostics");
    ASSERT_TRUE(list);
    EXPECT_EQ(ImGui::GetCurrentContext()->Windows.back()->RootWindow, list);
}

TEST(Panels, StandWithoutAScene) {
    Screen screen({});
    screen.facts.scene = nullptr;
    screen.facts.file = "wrong.frag";
    open_all(screen);
    EXPECT_TRUE(screen.window("Tweaks"));
}

TEST(Panels, StandInAnySize) {
    const Diagnostics diagnostics{{Severity::error, {"", 0, 0}, std::string(5000, 'x')}};
    for (const ImVec2 size : {ImVec2{0, 0}, {1, 1}, {40, 30}, {200, 2000}, {2000, 60}, {640, 360}})
        for (const float scale : {1.0f, 3.0f}) {
            Screen screen(two_numbers(), size, scale);
            screen.facts.diagnostics = diagnostics;
            open_all(screen);
            for (int i = 0; i < 8; ++i) {
                screen.interface.is_behind();
                screen.frame();
            }
            EXPECT_FALSE(screen.interface.is_behind())
                << size.x << "x" << size.y << " at " << scale;
        }
}

TEST(Panels, StandWithHundredsOfTweaksAndNamesOfAnyLength) {
    std::vector<Tweak> tweaks;
    for (int i = 0; i < 300; ++i) {
        Tweak tweak = kinds()[static_cast<std::size_t>(i) % kinds().size()].tweak;
        tweak.name = std::string(static_cast<std::size_t>(1 + i * 3), 'n') + std::to_string(i);
        tweak.description = std::string(static_cast<std::size_t>(i * 40), 'd') + " %s%n \xff";
        tweak.group = i % 7 ? fmt::format("group {} %d ## \xfe", i % 7) : "";
        tweak.unit = "%s";
        tweaks.push_back(tweak);
    }
    Screen screen(tweaks);
    open_all(screen);
    screen.tweaks.randomise(1);
    for (float y = 100; y < 600; y += 20) screen.drag({1150, y}, {1200, y + 3});
}

TEST(Panels, StandWithExtremeNumbers) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kMost = std::numeric_limits<double>::max();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<Tweak> tweaks{number("all floats", 0, -3.4e38, 3.4e38),
                              number("all doubles", 0, -kMost, kMost),
                              number("tiny", 1e-40, 1e-45, 1e-38),
                              number("nan", kNan, kNan, kNan),
                              number("backwards", 0, 1, -1),
                              number("endless", 0, -kInfinity, kInfinity),
                              number("empty", 1, 1, 1),
                              of_type(TweakType::vec3, {kNan, kInfinity, kMost}),
                              of_type(TweakType::float1, {kNan})};
    tweaks[0].log = tweaks[2].log = true;
    for (const Tweak& tweak : tweaks) {
        SCOPED_TRACE(tweak.name);
        Screen screen({tweak});
        const PixelFacts facts{.nan = 1, .min = glm::vec4(-INFINITY), .max = glm::vec4(NAN)};
        screen.facts.pixel_facts = facts;
        open_all(screen);
        for (float y = 60; y < 200; y += 10) screen.drag({1100, y}, {1300, y});
        for (std::size_t i = 0; i < screen.scene.tweaks.size(); ++i)
            for (const double component : screen.tweaks.value(i))
                EXPECT_FALSE(std::isnan(component) && !std::isnan(tweak.initial[0]));
    }
}

TEST(Panels, AreDraggedToTheOtherSideByTheirHeading) {
    Screen screen(two_numbers());
    const ImGuiWindow* panel = screen.window("Tweaks");
    ASSERT_TRUE(panel);
    EXPECT_GT(panel->Pos.x, 640.0f);
    screen.drag({panel->Pos.x + 40, panel->Pos.y + 20}, {200, 200});
    EXPECT_LT(panel->Pos.x, 100.0f);
    EXPECT_EQ(screen.interface.places().side[0], Side::left);
}

TEST(Panels, AreMadeWiderAtTheirInnerBorder) {
    Screen screen(two_numbers());
    const ImGuiWindow* panel = screen.window("Tweaks");
    ASSERT_TRUE(panel);
    const float right = panel->Rect().Max.x, width = panel->Size.x;
    screen.drag({panel->Pos.x, panel->Pos.y + 60}, {panel->Pos.x - 80, panel->Pos.y + 60});
    screen.frame();
    EXPECT_NEAR(panel->Size.x, width + 80, 2);
    EXPECT_NEAR(panel->Rect().Max.x, right, 1);
}

TEST(Panels, RememberTheirPlaces) {
    std::string written;
    for (const bool again : {false, true}) {
        Screen screen(two_numbers());
        Memory memory;
        remember(memory, "panels.ini");
        ImGui::GetIO().IniFilename = nullptr;
        if (again) ImGui::LoadIniSettingsFromMemory(written.c_str());
        recall(memory, screen.interface.places(), screen.settings);
        if (!again) {
            screen.interface.places() = {{Side::left, Side::right, Side::left, Side::right},
                                         {250, 400}};
            screen.settings.passes = screen.settings.check = true;
            note(memory, screen.interface.places(), screen.settings);
            written = ImGui::SaveIniSettingsToMemory();
        }
        EXPECT_EQ(screen.interface.places().side[0], Side::left);
        EXPECT_EQ(screen.interface.places().width[1], 400.0f);
        EXPECT_EQ(screen.interface.places().side[3], Side::right);
        EXPECT_TRUE(screen.settings.passes);
        EXPECT_TRUE(screen.settings.check);
        EXPECT_FALSE(screen.settings.study);
    }
}

// What is in view alone is instrumented: a whole text takes ten times as long.
TEST(Panels, TheSourceAsksForTheLinesInViewAlone) {
    Screen screen({});
    for (int line = 1; line <= 400; ++line) {
        screen.scene.text += line == 350 ? "void mainImage(\n" : "// another\n";
        screen.scene.origins.push_back({0, line});
    }
    screen.scene.files = {"scene.frag"};
    const std::vector<PassFact> passes = {
        {.name = "image", .entry = "mainImage", .outputs = {}, .runs = {}}};
    screen.facts.passes = passes;
    screen.settings.source = true;
    std::optional<Span> seen;
    for (int i = 0; i < 4; ++i) seen = screen.frame().lines;
    ASSERT_TRUE(seen);
    const std::size_t entry = screen.scene.text.find("void mainImage(");
    EXPECT_LE(seen->begin, entry);
    EXPECT_GT(seen->end, entry);
    EXPECT_GT(seen->begin, screen.scene.text.size() / 2);
}

// What a window of 1280x800 holds on a screen of twice the dots: half of that.
TEST(Panels, TheSourceLeavesRoomForItsLinesInALowWindow) {
    Screen screen({}, {1280, 800}, 2.0f);
    for (int line = 1; line <= 400; ++line) {
        screen.scene.text += "// another\n";
        screen.scene.origins.push_back({0, line});
    }
    screen.scene.files = {"scene.frag"};
    const ValueFacts picture{.components = 3};
    ProbeFact& probe = screen.facts.probe;
    probe.passes = {"sky", "ambient", "screen", "poses", "albedo", "lightBuffer", "image"};
    probe.pixel = glm::ivec2(125, 32);
    probe.size = {160, 90};
    probe.full_pixel = glm::ivec2(1000, 260);
    probe.watch = {"dot(fragCoord, fragCoord)@12", "nobody@13"};
    const std::vector<ProbeValue> watched = {
        {.line = 12, .name = "dot(fragCoord, fragCoord)", .kind = "expression", .value = {1.0}}};
    probe.watched = watched;
    probe.picture = &picture;
    screen.settings.source = true;
    screen.settings.tweaks = false;
    for (const bool is_shown : {false, true}) {
        if (is_shown) screen.settings.probe.value = ValueName{.line = 12};
        std::optional<Span> seen;
        for (int i = 0; i < 8; ++i) seen = screen.frame().lines;
        ASSERT_TRUE(seen) << is_shown;
        constexpr std::size_t kALine = 11;  // bytes
        EXPECT_GE(seen->end - seen->begin, (is_shown ? 3 : 6) * kALine) << is_shown;
    }
}

TEST(Panels, ComeToRestWhenNothingMoves) {
    Screen screen(two_numbers());
    screen.wait();
    EXPECT_FALSE(screen.interface.is_moving());
    screen.facts.notice = "written";
    screen.frame();
    EXPECT_TRUE(screen.interface.is_moving());
    for (int i = 0; i < 300; ++i) screen.frame();
    EXPECT_FALSE(screen.interface.is_moving());
}

}  // namespace
}  // namespace glint::panels_test
