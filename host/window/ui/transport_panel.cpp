// The transport bar: play, step, reset, the scrub bar with its loop, time, rate, frame and speed.
#include "window/ui/interface.h"
#include "window/ui/number_text.h"
#include "window/ui/shortcuts.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace glint {
namespace {

constexpr double kLeastSpan = 60.0;  // s

// The end of the scrub bar: the first of 1, 2, 5, 10 … minutes that holds the time and the loop.
double span_for(double time, const Loop& loop, bool has_loop) {
    double span = kLeastSpan;
    const double last = std::max(time, has_loop ? loop.end : 0.0);
    for (int i = 0; span < last && i < 90; ++i) span *= i % 3 == 1 ? 2.5 : 2.0;
    return std::max(span, last);
}

std::string clock_text(double seconds) {
    if (seconds < 60.0) return fmt::format("{:g} s", seconds);
    const auto whole = static_cast<long long>(seconds);
    if (seconds < 3600.0) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    if (seconds < 86400.0) return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
    return fmt::format("{:.1f} d", seconds / 86400.0);
}

// To a tenth of a second.
double rounded(double seconds) {
    return std::round(seconds * 10.0) / 10.0;
}

void wish_time(Build& build, double seconds) {
    wish(build, {.what = TimeEdit::What::seek, .number = seconds, .loop = {}});
}

void wish_loop(Build& build, const std::optional<Loop>& loop) {
    wish(build, {.what = TimeEdit::What::loop, .loop = loop});
}

void buttons(Build& build) {
    using enum TimeEdit::What;
    const Theme& theme = build.theme;
    if (icon_button(theme, "reset", Icon::reset, "Time back to zero (Ctrl+R)"))
        wish(build, {.what = reset, .loop = {}});
    ImGui::SameLine(0, theme.px(2));
    const bool playing = build.transport.playing();
    if (icon_button(theme, "play", playing ? Icon::pause : Icon::play,
                    playing ? "Pause (Ctrl+Space)" : "Play (Ctrl+Space)",
                    {.colour = colours::kAccent}))
        wish(build, {.what = playing ? pause : play, .loop = {}});
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(theme, "step", Icon::step, "One frame forward (Ctrl+.)"))
        wish(build, {.what = step, .loop = {}});
}

// The preset's time is written only where a person asks for it.
void start_entries(Build& build) {
    const std::string text = fmt::format("Start the preset at {} s", shown_time(build));
    if (ImGui::MenuItem(text.c_str())) build.wishes.start_time = StartTime{shown_time(build)};
    if (ImGui::MenuItem("Leave the preset's start", nullptr, false,
                        build.facts.start_time.has_value()))
        build.wishes.start_time = StartTime();
}

constexpr double kMostTime = 1e9;  // s

// In place of the time, until Enter or a click elsewhere. What is no time changes nothing.
void typed_time(Build& build, TransportState& state, float width) {
    ImGui::SetNextItemWidth(width);
    if (std::exchange(state.typing_begins, false)) ImGui::SetKeyboardFocusHere();
    const bool was_typing = state.is_typing;
    ImGui::InputText("##typed time", &*state.typed, ImGuiInputTextFlags_AutoSelectAll);
    state.is_typing = ImGui::IsItemActive();
    if (!was_typing || state.is_typing) return;
    const std::optional<double> time = parse_clock(*state.typed);
    if (time && *time != shown_time(build)) wish_time(build, std::min(*time, kMostTime));
    state.typed.reset();
}

void time_field(Build& build, TransportState& state, float width) {
    if (state.typed) return typed_time(build, state, width);
    double time = build.transport.time();
    const double before = time, least = 0.0;
    ImGui::SetNextItemWidth(width);
    ImGui::DragScalar("##time", ImGuiDataType_Double, &time, 0.02f, &least, &kMostTime, "%.3f s",
                      ImGuiSliderFlags_NoInput);
    if (time != before && std::isfinite(time)) wish_time(build, std::max(time, 0.0));
    const bool is_entered =
        GImGui->NavActivateInputId != 0 && GImGui->NavActivateInputId == GImGui->LastItemData.ID;
    const bool is_clicked = ImGui::IsItemDeactivated() && !ImGui::IsItemDeactivatedAfterEdit() &&
                            ImGui::IsMouseReleased(0) && ImGui::IsItemHovered();
    if (is_entered || is_clicked) {
        state.typed = fmt::format("{:g}", shown_time(build));
        state.typing_begins = true;
    }
    const std::optional<double>& start = build.facts.start_time;
    tip(build.theme,
        "Time. Drag to move it, click to type it (90, 1:30), right-click to keep it." +
            (start ? fmt::format("\nSaving writes {} s as the preset's start.", *start) : ""));
    if (ImGui::BeginPopupContextItem("time menu")) {
        start_entries(build);
        ImGui::EndPopup();
    }
}

void rate_slider(Build& build, float width) {
    auto rate = static_cast<float>(build.transport.rate());
    const Range range{Transport::kSlowest, Transport::kFastest, 1.0, true};
    if (number_slider(build.theme, "##rate", width, rate, range,
                      fmt::format("{:.2f}\u00d7", rate))) {
        const bool is_near_one = std::abs(std::log(static_cast<double>(rate))) < 0.04;
        wish(build, {.what = TimeEdit::What::rate,
                     .number = is_near_one ? 1.0 : static_cast<double>(rate),
                     .loop = {}});
    }
    tip(build.theme, "Rate: scene seconds in a second. Right-click: 1.");
}

void loop_button(Build& build, TransportState& state) {
    if (build.transport.loop()) {
        state.loop = *build.transport.loop();
        state.has_loop = true;
    }
    const bool on = build.transport.loop().has_value();
    if (!icon_button(build.theme, "loop", Icon::loop,
                     "Loop between the markers A and B. Drag them, or right-click the scrub bar.",
                     {.on = on}))
        return;
    if (!state.has_loop) state.loop = {build.transport.time(), build.transport.time() + 10.0};
    state.has_loop = true;
    wish_loop(build, on ? std::nullopt : std::optional(state.loop));
}

constexpr float kVolumeWidth = 60;  // screen units

// The button and the slider, with the gaps before them; a scene without sound has neither.
float sound_width(const Build& build) {
    if (!build.facts.has_sound) return 0.0f;
    return ImGui::GetFrameHeight() + build.theme.px(kVolumeWidth + 10);
}

// In a line; what follows comes behind it.
void sound_controls(Build& build) {
    if (!build.facts.has_sound) return;
    const Theme& theme = build.theme;
    PanelSettings& settings = build.settings;
    const std::string& cause = build.facts.why_silent;
    const std::string tip_text = !cause.empty()   ? fmt::format("No sound: {}", cause)
                                 : settings.muted ? "Sound on (Ctrl+M)"
                                                  : "Sound off (Ctrl+M)";
    const bool silent = settings.muted || !cause.empty();
    if (icon_button(theme, "mute", silent ? Icon::muted : Icon::sound, tip_text.c_str(),
                    {.enabled = cause.empty()}))
        settings.muted = !settings.muted;
    ImGui::SameLine(0, theme.px(2));
    if (number_slider(theme, "##volume", theme.px(kVolumeWidth), settings.volume,
                      {0.0, 1.0, 1.0, false}, fmt::format("{:.0f} %", settings.volume * 100.0f)))
        settings.muted = false;
    tip(theme, "Volume. Right-click: all of it.");
    ImGui::SameLine();
}

void fixed_button(Build& build) {
    const bool fixed = build.transport.fixed_step();
    if (text_button(build.theme, "1/60", fixed,
                    "Fixed step: every frame moves time by exactly 1/60 s, as in a sequence"))
        wish(build, {.what = TimeEdit::What::fixed_step, .on = !fixed, .loop = {}});
}

// Where things lie on the scrub bar.
struct Bar {
    ImVec2 corner, end;
    double span;
    float x(double time) const {
        const double t = std::clamp(time / span, 0.0, 1.0);
        return corner.x + static_cast<float>(t) * (end.x - corner.x);
    }
    double time(float at) const {
        const double t = static_cast<double>(at - corner.x) /
                         std::max(static_cast<double>(end.x - corner.x), 1.0);
        return std::clamp(t, 0.0, 1.0) * span;
    }
};

// Lines at whole seconds, minutes …, no closer than a finger's width.
void draw_ticks(const Theme& theme, const Bar& bar, float track_bottom) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const double least = bar.time(bar.corner.x + theme.px(64));
    double step = 1.0;
    for (int i = 0; step < least && i < 90; ++i) step *= i % 3 == 1 ? 2.5 : 2.0;
    for (int k = 1; k * step < bar.span * 0.999 && k < 200; ++k) {
        const float x = std::round(bar.x(k * step));
        list.AddLine({x, track_bottom - theme.px(4)}, {x, track_bottom}, colours::kFaint);
    }
}

void draw_scrub(Build& build, const TransportState& state, const Bar& bar, bool hot) {
    const Theme& theme = build.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float round = theme.px(4);
    list.AddRectFilled(bar.corner, bar.end, hot ? colours::kFieldHovered : colours::kField, round);
    const float now = bar.x(build.transport.time());
    if (build.transport.loop())
        list.AddRectFilled({bar.x(state.loop.begin), bar.corner.y},
                           {bar.x(state.loop.end), bar.end.y}, IM_COL32(105, 178, 236, 46));
    if (now > bar.corner.x + 1)
        list.AddRectFilled(bar.corner, {now, bar.end.y}, colours::kAccentFill, round,
                           ImDrawFlags_RoundCornersLeft);
    if (build.facts.replayed < 1.0) {
        const double done = std::clamp(build.facts.replayed, 0.0, 1.0);
        const float x = bar.corner.x + static_cast<float>(done) * (now - bar.corner.x);
        list.AddRectFilled({bar.corner.x, bar.end.y - theme.px(4)}, {x, bar.end.y},
                           colours::kWarning);
    }
    draw_ticks(theme, bar, bar.end.y);
    list.AddRectFilled({now - theme.px(1.5f), bar.corner.y}, {now + theme.px(1.5f), bar.end.y},
                       colours::kAccent, theme.px(1));
    const std::string last = build.facts.replayed < 1.0
                                 ? fmt::format("replaying {:.0f} %", 100 * build.facts.replayed)
                                 : clock_text(bar.span);
    const ImVec2 size = ImGui::CalcTextSize(last.c_str());
    const float y = 0.5f * (bar.corner.y + bar.end.y - size.y);
    list.AddText({bar.end.x - size.x - theme.px(8), y}, colours::kDim, last.c_str());
}

// A marker of the loop, dragged along the bar. True while it is held.
bool marker(Build& build, const Bar& bar, const char* name, double& time) {
    const Theme& theme = build.theme;
    const float x = bar.x(time), half = theme.px(7);
    ImGui::SetCursorScreenPos({x - half, bar.corner.y - theme.px(2)});
    area(name, {2 * half, bar.end.y - bar.corner.y + theme.px(4)});
    const bool held = ImGui::IsItemActive(), hot = held || ImGui::IsItemHovered();
    if (hot) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (held) time = bar.time(ImGui::GetIO().MousePos.x);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 colour = hot ? colours::kText : colours::kWarning;
    list.AddLine({x, bar.corner.y}, {x, bar.end.y}, colour, theme.px(2));
    const float side = *name == 'A' ? 1.0f : -1.0f;
    list.AddTriangleFilled({x, bar.corner.y}, {x + side * theme.px(8), bar.corner.y},
                           {x, bar.corner.y + theme.px(9)}, colour);
    tip(theme, fmt::format("{} {:.2f} s", name, time));
    return held;
}

void markers(Build& build, TransportState& state, const Bar& bar) {
    if (!build.transport.loop()) return;
    Loop loop = state.loop;
    const bool moved_a = marker(build, bar, "A", loop.begin);
    const bool moved_b = marker(build, bar, "B", loop.end);
    if (moved_a) loop.begin = std::min(loop.begin, loop.end - 1.0 / 60);
    if (moved_b) loop.end = std::max(loop.end, loop.begin + 1.0 / 60);
    if (moved_a || moved_b) wish_loop(build, loop);
}

void loop_menu(Build& build, TransportState& state, const Bar& bar) {
    if (!ImGui::BeginPopup("loop menu")) return;
    const double at = bar.time(ImGui::GetMousePosOnOpeningCurrentPopup().x);
    Loop loop = state.has_loop ? state.loop : Loop{0.0, bar.span};
    bool chosen = false;
    if (ImGui::MenuItem("Loop from here (A)")) {
        loop = {at, loop.end > at ? loop.end : bar.span};
        chosen = true;
    }
    if (ImGui::MenuItem("Loop to here (B)")) {
        loop = {loop.begin < at ? loop.begin : 0.0, at};
        chosen = true;
    }
    if (ImGui::MenuItem("No loop", nullptr, false, build.transport.loop().has_value()))
        wish_loop(build, std::nullopt);
    if (chosen && loop.begin < loop.end) wish_loop(build, loop);
    ImGui::Separator();
    start_entries(build);
    ImGui::EndPopup();
}

// From the nearest state that is kept, or from the start.
std::string cost_text(const Build& build, double time) {
    const auto& kept = build.facts.kept_states;
    const auto after = std::ranges::upper_bound(kept, time);
    const double from = after == kept.begin() ? 0.0 : *(after - 1);
    std::string text =
        after == kept.begin()
            ? fmt::format("{}: no state is kept before; plays {} again", clock_text(rounded(time)),
                          clock_text(rounded(time)))
            : fmt::format("{}: plays {} again, from a state kept at {}", clock_text(rounded(time)),
                          clock_text(rounded(time - from)), clock_text(rounded(from)));
    const double rate = build.facts.replay_rate;
    const double cost = rate > 0.0 ? rounded((time - from) / rate) : 0.0;
    if (rate > 0.0) text += cost > 0.0 ? ", about " + clock_text(cost) : ", at once";
    return text;
}

// Where a jump begins without playing from the start.
void kept_marks(Build& build, const Bar& bar) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const double time : build.facts.kept_states) {
        if (time > bar.span) continue;
        const float x = std::round(bar.x(time));
        list.AddLine({x, bar.corner.y}, {x, bar.corner.y + build.theme.px(3)}, colours::kDim);
    }
}

void scrub_bar(Build& build, TransportState& state, float width) {
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    // The markers, which come later, go before it.
    area("scrub", {std::max(width, 1.0f), height}, ImGuiButtonFlags_AllowItemOverlap);
    ImGui::SetItemAllowOverlap();
    const bool held = ImGui::IsItemActive(), hot = held || ImGui::IsItemHovered();
    if (ImGui::IsItemClicked(1)) ImGui::OpenPopup("loop menu");
    if (!ImGui::IsAnyMouseDown())
        state.span =
            span_for(build.transport.time(), state.loop, build.transport.loop().has_value());
    const Bar bar{corner, {corner.x + std::max(width, 1.0f), corner.y + height}, state.span};
    if (held) wish_time(build, bar.time(ImGui::GetIO().MousePos.x));
    if (build.facts.simulates)
        tip(build.theme, cost_text(build, bar.time(ImGui::GetIO().MousePos.x)));
    draw_scrub(build, state, bar, hot);
    kept_marks(build, bar);
    markers(build, state, bar);
    loop_menu(build, state, bar);
    ImGui::SetCursorScreenPos(corner);  // what follows in the line follows the bar, not a marker
    ImGui::Dummy({std::max(width, 1.0f), height});
}

std::string speed_text(const Build& build) {
    const Instant& instant = build.facts.instant;
    if (build.facts.frame_ms == 0.0) return "no frame yet";
    // The rate is measured twice a second; a frame that took long tells sooner.
    const double fps = std::min(instant.frame_rate, 1000.0 / build.facts.frame_ms);
    return fmt::format("frame {}   {:.0f} fps   {:.1f} ms", instant.frame, fps,
                       build.facts.frame_ms);
}

// How many pixels are drawn, where that is not all there is to say; "" otherwise.
std::string resolution_text(const Build& build) {
    const Facts& facts = build.facts;
    if (facts.refined_of > 0) return fmt::format("{} of {}", facts.refined, facts.refined_of);
    const bool is_small = facts.full_size.x > 0 && facts.picture_size.x < facts.full_size.x;
    if (is_small) {
        const double share = static_cast<double>(facts.picture_size.x) / facts.full_size.x;
        return fmt::format("{} {:.0f} %", facts.resolution_is_fixed ? "fixed at" : "held at",
                           100.0 * share);
    }
    const double wanted_ms = 1000.0 / static_cast<double>(build.settings.frame_rate);
    const bool is_slow = std::max(facts.full_ms, facts.frame_ms) > wanted_ms;
    return !build.settings.hold_frame_rate && is_slow ? "full size" : "";
}

std::string resolution_tip(const Build& build) {
    const Facts& facts = build.facts;
    const std::string pixels =
        fmt::format("{} \u00d7 {} of {} \u00d7 {} pixels", facts.picture_size.x,
                    facts.picture_size.y, facts.full_size.x, facts.full_size.y);
    const std::string cost =
        facts.full_ms > 0.0
            ? fmt::format(" A full-size frame takes about {:.0f} ms.", facts.full_ms)
            : "";
    const float rate = build.settings.frame_rate;
    if (facts.refined_of > 0)
        return fmt::format(
            "Nothing moves: {} of {} samples a pixel are averaged at the full size, "
            "as `glint still --samples {}` does.{} Click: {} while it moves",
            facts.refined, facts.refined_of, facts.refined_of, cost,
            build.settings.hold_frame_rate ? "the full size"
                                           : fmt::format("{:.0f} frames a second", rate));
    if (!build.settings.hold_frame_rate)
        return fmt::format(
            "The full size, however slow.{} Click: hold {:.0f} frames a second by a "
            "lower resolution",
            cost, rate);
    if (facts.resolution_is_fixed)
        return fmt::format(
            "{}, chosen before the first frame: another size would crop what its "
            "buffers hold.{} Click: begin again at the full size",
            pixels, cost);
    return fmt::format("{}, so that {:.0f} frames a second are held.{} Click: the full size",
                       pixels, rate, cost);
}

float resolution_width(const Build& build) {
    if (resolution_text(build).empty()) return 0.0f;
    return ImGui::CalcTextSize("fixed at 100 %").x + build.theme.px(16 + 8);
}

// In a line, in a place of its own width; what follows comes behind it.
void resolution_button(Build& build) {
    const std::string text = resolution_text(build);
    if (text.empty()) return;
    const float end = ImGui::GetCursorPosX() + resolution_width(build);
    bool& held = build.settings.hold_frame_rate;
    const std::string label = text + "###resolution";
    if (text_button(build.theme, label.c_str(), held, resolution_tip(build).c_str())) held = !held;
    ImGui::SameLine(end);
}

// Keeps its place while the digits change.
void speed(Build& build, float width) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float top = corner.y + ImGui::GetStyle().FramePadding.y;
    text_within(*ImGui::GetWindowDrawList(), {corner.x, top}, width, colours::kDim,
                speed_text(build));
    ImGui::Dummy({width, ImGui::GetFrameHeight()});
    tip(build.theme, build.facts.renderer);
}

void how_it_plays(Build& build, TransportState& state) {
    loop_button(build, state);
    ImGui::SameLine();
    rate_slider(build, build.theme.px(80));
    ImGui::SameLine();
    fixed_button(build);
    ImGui::SameLine();
    sound_controls(build);
    resolution_button(build);
}

void in_one_line(Build& build, TransportState& state, float side, float speed_width) {
    const Theme& theme = build.theme;
    buttons(build);
    ImGui::SameLine();
    time_field(build, state, theme.px(96));
    ImGui::SameLine();
    scrub_bar(build, state, ImGui::GetContentRegionAvail().x - side - speed_width);
    ImGui::SameLine();
    how_it_plays(build, state);
    speed(build, speed_width);
}

void in_two_lines(Build& build, TransportState& state, float speed_width) {
    const Theme& theme = build.theme;
    scrub_bar(build, state, ImGui::GetContentRegionAvail().x);
    buttons(build);
    ImGui::SameLine();
    time_field(build, state, theme.px(96));
    ImGui::SameLine();
    how_it_plays(build, state);
    const float room = ImGui::GetContentRegionAvail().x;
    if (room >= speed_width)
        speed(build, speed_width);
    else
        ImGui::NewLine();
}

}  // namespace

double shown_time(const Build& build) {
    return std::round(build.transport.time() * 1000.0) / 1000.0;
}

void transport_panel(Build& build, TransportState& state) {
    const Theme& theme = build.theme;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float margin = theme.px(8);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(8), theme.px(8)});
    ImGui::SetNextWindowPos({margin, screen.y - margin}, 0, {0.0f, 1.0f});
    const float width = std::max(screen.x - 2 * margin, 1.0f);
    const float line = ImGui::GetFrameHeight();
    const float speed_width = ImGui::CalcTextSize("frame 000000   000 fps   000.0 ms").x;
    // Loop, rate, fixed step and the gaps before each of them.
    const float side = line + theme.px(80) + ImGui::CalcTextSize("1/60").x + theme.px(16 + 5 * 8) +
                       sound_width(build) + resolution_width(build);
    const bool is_wide = width > side + speed_width + 3 * line + theme.px(96 + 240);
    const float lines = is_wide ? line : 2 * line + ImGui::GetStyle().ItemSpacing.y;
    ImGui::SetNextWindowSize({width, lines + theme.px(16)});
    ImGui::Begin("transport", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollWithMouse);
    if (is_wide)
        in_one_line(build, state, side, speed_width);
    else
        in_two_lines(build, state, speed_width);
    build.layout.transport = {ImGui::GetWindowPos(), ImGui::GetWindowSize()};
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace glint
