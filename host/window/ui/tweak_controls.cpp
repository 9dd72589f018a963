#include "window/ui/tweak_controls.h"

#include "base/words.h"
#include "window/ui/number_text.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

namespace glint {
namespace {

// The tweak that is drawn, its value made fit to show.
struct Row {
    Build& build;
    TweaksState& state;
    std::size_t index;
    const Tweak& tweak;
    TweakValue value;
    float width;

    void set(const TweakValue& to) {
        state.edits.set(build, index, to);
        tell_of(to);
    }
    void tell(std::string words, const TweakValue& stands) {
        state.told = std::move(words);
        state.told_of = tweak.name;
        state.told_at = stands;
    }
    // What a person wanted, and does not get.
    void tell_of(const TweakValue& wanted);
    void set(int component, double to) {
        TweakValue whole = value;
        whole[static_cast<std::size_t>(component)] = to;
        set(whole);
    }
    double at(int component) const { return value[static_cast<std::size_t>(component)]; }
};

void Row::tell_of(const TweakValue& wanted) {
    state.told_of.clear();
    if (!tweak.min) return;
    for (int i = 0; i < component_count(tweak.type); ++i) {
        const double number = wanted[static_cast<std::size_t>(i)];
        if (number >= *tweak.min && number <= *tweak.max) continue;
        tell(fmt::format("{} is beyond [{}, {}]; clamped to {}", format_number(number),
                         format_number(*tweak.min), format_number(*tweak.max),
                         format_number(std::clamp(number, *tweak.min, *tweak.max))),
             clamp_to_range(tweak, wanted));
    }
}

// The control just drawn takes the keyboard, where that is meant for this tweak.
void take_focus(Row& row) {
    if (row.state.focus != row.tweak.name && !row.state.focus_first) return;
    row.state.focus.clear();
    row.state.focus_first = false;
    focus_last_item();
}

std::string with_unit(const Tweak& tweak, std::string text) {
    return tweak.unit.empty() ? text : text + " " + tweak.unit;
}

// A field in which the whole value is typed, in place of the slider until Enter or a click
// elsewhere.
void typed_field(Row& row) {
    ImGui::SetNextItemWidth(row.width);
    if (row.state.typing_begins) ImGui::SetKeyboardFocusHere();
    row.state.typing_begins = false;
    const bool was_typing = row.state.is_typing;
    ImGui::InputText("##typed", &row.state.typed_text, ImGuiInputTextFlags_AutoSelectAll);
    // ImGui forgets one that a dialog or a closed panel took the keyboard from.
    row.state.is_typing = ImGui::IsItemActive();
    if (!was_typing || row.state.is_typing) return;
    if (row.state.typed_text != format_value(row.tweak, row.value)) {
        if (const auto value = parse_value(row.tweak, row.state.typed_text))
            row.set(*value);
        else
            row.tell(fmt::format("'{}' is not {}; it stays {}", row.state.typed_text,
                                 expected_value(row.tweak), format_value(row.tweak, row.value)),
                     row.value);
    }
    row.state.typed.clear();
    if (row.build.settings.keys) row.state.focus = row.tweak.name;
}

void begin_typing(Row& row) {
    row.state.typed = row.tweak.name;
    row.state.typed_text = format_value(row.tweak, row.value);
    row.state.typing_begins = true;
}

// Where a key moves it by less than one step, it goes by one.
double moved_value(const Row& row, double fraction) {
    const double value = value_at(row.tweak, fraction);
    const bool whole = row.tweak.type == TweakType::int1;
    const double step = row.tweak.step > 0.0 ? row.tweak.step : whole ? 1.0 : 0.0;
    if (value != row.value[0] || GImGui->ActiveIdSource != ImGuiInputSource_Nav) return value;
    const double sign = fraction < fraction_of(row.tweak, row.value[0]) ? -1.0 : 1.0;
    return std::clamp(value + sign * step, *row.tweak.min, *row.tweak.max);
}

void range_slider(Row& row) {
    if (row.state.typed == row.tweak.name) return typed_field(row);
    const std::string text = with_unit(row.tweak, number_text(row.tweak, row.value[0]));
    const double origin = fraction_of(row.tweak, 0.0);
    double fraction = fraction_of(row.tweak, row.value[0]);
    const bool moved = slider(row.build.theme, "##slider", row.width, fraction, text, origin);
    const bool is_entered =
        GImGui->NavActivateInputId != 0 && GImGui->NavActivateInputId == GImGui->LastItemData.ID;
    const bool wants_typing = is_entered || (ImGui::IsItemClicked() && ImGui::GetIO().KeyCtrl);
    if (wants_typing) begin_typing(row);
    if (moved && !wants_typing) row.set(0, moved_value(row, fraction));
    take_focus(row);
}

// One number that is dragged or typed.
bool drag_field(Row& row, int component, float width, double& number) {
    const Tweak& tweak = row.tweak;
    const bool ranged = has_range(tweak);
    const double span = ranged ? *tweak.max - *tweak.min : std::max(std::abs(number), 1.0);
    const bool whole = tweak.type == TweakType::int1;
    const double speed = std::min(span / 300.0, 1e30);
    const std::string unit = component_count(tweak.type) == 1 && !tweak.unit.empty()
                                 ? " " + escaped(tweak.unit)
                                 : std::string();
    const std::string format = (whole ? "%.0f" : "%.4g") + unit;
    ImGui::PushID(component);
    ImGui::SetNextItemWidth(width);
    const bool changed = ImGui::DragScalar(
        "##drag", ImGuiDataType_Double, &number, static_cast<float>(std::max(speed, 1e-30)),
        ranged ? &*tweak.min : nullptr, ranged ? &*tweak.max : nullptr, format.c_str());
    if (component == 0) take_focus(row);
    ImGui::PopID();
    return changed && std::isfinite(number);
}

// The numbers of a vector side by side; four make two lines.
void drag_fields(Row& row, float width) {
    const int count = component_count(row.tweak.type);
    const int columns = count == 4 ? 2 : count;
    const float gap = row.build.theme.px(4);
    const float each =
        std::floor((width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
    ImGui::BeginGroup();
    for (int i = 0; i < count; ++i) {
        if (i % columns) ImGui::SameLine(0.0f, gap);
        double number = row.at(i);
        if (drag_field(row, i, each, number)) row.set(i, number);
    }
    ImGui::EndGroup();
}

double pad_fraction(const Tweak& tweak, double value) {
    return std::clamp(fraction_of(tweak, value), 0.0, 1.0);
}

void draw_pad(const Row& row, ImVec2 corner, float side) {
    const Theme& theme = row.build.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + side, corner.y + side};
    const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemActive();
    list.AddRectFilled(corner, end, hovered ? colours::kFieldHovered : colours::kField,
                       theme.px(4));
    const float inset = theme.px(6), travel = side - 2 * inset;
    const float x =
        corner.x + inset + travel * static_cast<float>(pad_fraction(row.tweak, row.value[0]));
    const float y =
        end.y - inset - travel * static_cast<float>(pad_fraction(row.tweak, row.value[1]));
    for (int i = 1; i < 4; ++i) {
        const float t = inset + travel * static_cast<float>(i) / 4.0f;
        list.AddLine({corner.x + t, corner.y}, {corner.x + t, end.y}, colours::kLine);
        list.AddLine({corner.x, corner.y + t}, {end.x, corner.y + t}, colours::kLine);
    }
    list.AddLine({x, corner.y}, {x, end.y}, colours::kAccentFill);
    list.AddLine({corner.x, y}, {end.x, y}, colours::kAccentFill);
    list.AddCircleFilled({x, y}, theme.px(5), colours::kAccent);
    list.AddCircle({x, y}, theme.px(5), colours::kPanel, 0, theme.px(1));
}

// A square in which a point is moved, x to the right and y up, and its two numbers.
void pad(Row& row) {
    const Theme& theme = row.build.theme;
    const float side = std::min(std::floor(0.52f * row.width), theme.px(110));
    const float inset = theme.px(6), gap = theme.px(6);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    area("##pad", {side, side});
    take_focus(row);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ImGui::IsItemActive() && (ImGui::IsItemActivated() || ImGui::IsMouseDragging(0, 0.0f))) {
        const float travel = std::max(side - 2 * inset, 1.0f);
        TweakValue to = row.value;
        to[0] = value_at(row.tweak, (mouse.x - corner.x - inset) / travel);
        to[1] = value_at(row.tweak, (corner.y + side - inset - mouse.y) / travel);
        row.set(to);
        row.value = to;
    }
    draw_pad(row, corner, side);
    ImGui::SameLine(0.0f, gap);
    ImGui::BeginGroup();
    for (int i = 0; i < 2; ++i) {
        double number = row.at(i);
        if (drag_field(row, i, row.width - side - gap, number)) row.set(i, number);
    }
    if (!row.tweak.unit.empty()) text_in(colours::kDim, row.tweak.unit);
    ImGui::EndGroup();
}

// What stands in the text field that was drawn last, or in one of those of a group, while it has
// the keyboard.
std::optional<std::string> active_text() {
    const ImGuiInputTextState& field = GImGui->InputTextState;
    if (!ImGui::IsItemActive() || field.ID == 0 || field.ID != ImGui::GetActiveID())
        return std::nullopt;
    std::array<char, 64> text{};
    ImTextStrToUtf8(text.data(), static_cast<int>(text.size()), field.TextW.Data, nullptr);
    return text.data();
}

// ImGui takes "12" for #120000. Of fewer digits than a colour has nothing comes, and it is said.
bool is_whole_colour(const std::string& text, int components) {
    const auto digits =
        std::ranges::count_if(text, [](unsigned char c) { return std::isxdigit(c) != 0; });
    return digits == 2 * components;
}

// False while too few digits are typed.
bool takes_digits(Row& row) {
    TweaksState& state = row.state;
    const int count = component_count(row.tweak.type);
    if (const auto text = active_text()) {
        state.hex_of = row.tweak.name;
        state.hex = *text;
        return is_whole_colour(state.hex, count);
    }
    if (state.hex_of != row.tweak.name) return true;
    state.hex_of.clear();
    if (is_whole_colour(state.hex, count)) return true;
    row.tell(fmt::format("'{}' is not {}; it stays {}", state.hex, expected_value(row.tweak),
                         format_value(row.tweak, row.value)),
             row.value);
    return false;
}

// Colours beyond 1 (light, not paint) are shown as numbers.
void colour(Row& row) {
    const int count = component_count(row.tweak.type);
    std::array<float, 4> rgba{0, 0, 0, 1};
    bool is_light = row.tweak.max && *row.tweak.max > 1.0;
    for (int i = 0; i < count; ++i) {
        rgba[static_cast<std::size_t>(i)] = static_cast<float>(row.at(i));
        is_light = is_light || row.at(i) > 1.0;
    }
    ImGuiColorEditFlags flags = ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoOptions;
    flags |= is_light ? ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_Float
                      : ImGuiColorEditFlags_DisplayHex;
    ImGui::SetNextItemWidth(row.width);
    const bool changed = count == 4 ? ImGui::ColorEdit4("##colour", rgba.data(),
                                                        flags | ImGuiColorEditFlags_AlphaBar |
                                                            ImGuiColorEditFlags_AlphaPreviewHalf)
                                    : ImGui::ColorEdit3("##colour", rgba.data(), flags);
    const bool is_whole = is_light || takes_digits(row);
    take_focus(row);
    if (!changed || !is_whole) return;
    TweakValue to = row.value;
    for (int i = 0; i < count; ++i)
        to[static_cast<std::size_t>(i)] = rgba[static_cast<std::size_t>(i)];
    row.set(to);
}

void menu(Row& row) {
    const auto& names = row.tweak.names;
    const double last = static_cast<double>(names.size()) - 1.0;
    const auto chosen = static_cast<std::size_t>(std::clamp(row.value[0], 0.0, last));
    ImGui::SetNextItemWidth(row.width);
    const bool is_open = ImGui::BeginCombo("##menu", names[chosen].c_str());
    if (!is_open) return take_focus(row);
    for (std::size_t i = 0; i < names.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(names[i].c_str(), i == chosen)) row.set(0, static_cast<double>(i));
        if (i == chosen) ImGui::SetItemDefaultFocus();
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

void checkbox(Row& row) {
    bool on = row.value[0] != 0.0;
    if (ImGui::Checkbox("##check", &on)) row.set(0, on ? 1.0 : 0.0);
    take_focus(row);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    text_in(colours::kDim, on ? "on" : "off");
}

}  // namespace

void tweak_control(Build& build, TweaksState& state, std::size_t index, float width) {
    const Tweak& tweak = build.facts.scene->tweaks[index];
    Row row{build, state, index, tweak, build.tweaks.value(index), std::max(width, 1.0f)};
    for (double& component : row.value)
        if (!std::isfinite(component)) component = 0.0;
    if (!tweak.names.empty()) return menu(row);
    if (tweak.type == TweakType::bool1) return checkbox(row);
    const int count = component_count(tweak.type);
    if (tweak.is_colour && count >= 3) return colour(row);
    if (count == 1 && has_range(tweak)) return range_slider(row);
    if (count == 2 && has_range(tweak)) return pad(row);
    drag_fields(row, row.width);
}

}  // namespace glint
