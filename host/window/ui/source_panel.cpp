// Why is this pixel so? The text beside the picture, with what each line was worth at the pixel
// under the mouse.
#include "window/ui/interface.h"
#include "window/ui/number_text.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace glint {
namespace {

constexpr std::array<ImU32, 4> kComponentColours = {
    IM_COL32(255, 120, 110, 255), IM_COL32(120, 220, 120, 255), IM_COL32(120, 170, 255, 255),
    IM_COL32(190, 190, 190, 255)};

std::string short_value(const ProbeValue& value) {
    if (value.value.empty()) return "";
    std::string text;
    for (const double number : value.value) {
        if (!text.empty()) text += ", ";
        if (value.type.starts_with('b'))
            text += number != 0.0 ? "true" : "false";
        else
            text += fmt::format("{:.4g}", number);
    }
    return value.value.size() == 1 ? text : "(" + text + ")";
}

// `nor (0, 1, 0)`, `true`, `×64`: as it stands at the end of its line.
std::string chip_text(const ProbeValue& value) {
    std::string text = short_value(value);
    if (value.kind == "assigned" || value.kind == "parameter" || value.kind == "expression")
        text = value.name + " " + text;
    if (value.kind == "returned")  // `return.nor`, where that is a struct
        text = fmt::format("return{} {}", value.name.substr(value.function.size()), text);
    if (value.hits > 1) text += fmt::format("  \u00d7{}", value.hits);
    return text;
}

bool is_finite(const ProbeValue& value) {
    return std::ranges::all_of(value.value, [](double v) { return std::isfinite(v); });
}

std::string value_tip(const ProbeValue& value) {
    std::string text =
        fmt::format("{} {} = {}", value.type, value.name, shown_value(value.value, value.type));
    if (value.hits > 1) text += fmt::format("\nthe last of {}", value.hits);
    return text + "\nClick: the value in every pixel. Right click: watch it.";
}

// A value that is given a name, and can be watched.
bool can_be_watched(const ProbeValue& value) {
    return value.kind == "assigned" || value.kind == "parameter";
}

std::string watch_of(const Build& build, const ProbeValue& value) {
    const auto& files = build.facts.scene->files;
    const bool is_scene = !files.empty() && files.front().string() == value.file;
    const std::string name = std::filesystem::path(value.file).filename().string();
    return is_scene ? fmt::format("{}@{}", value.name, value.line)
                    : fmt::format("{}@{}:{}", value.name, name, value.line);
}

// Shows it in every pixel, or the scene again.
void show_everywhere(Build& build, const ProbeValue& value) {
    ProbeView& view = build.settings.probe;
    const bool again = view.value == name_of(value);
    view.value.reset();
    if (!again) view.value = name_of(value);
    view.cost = false;
}

void add_watch(Build& build, const std::string& watch) {
    std::vector<std::string> list = build.facts.probe.watch;
    if (std::ranges::find(list, watch) == list.end()) list.push_back(watch);
    build.wishes.watch = std::move(list);
}

// The value on a ground of its own, its right end at `right`. Where it begins.
float chip(Build& build, const ProbeValue& value, float left, float right, float top) {
    const Theme& theme = build.theme;
    const std::string text = chip_text(value);
    const float pad = theme.px(5), height = ImGui::GetTextLineHeight();
    const float width =
        std::min(ImGui::CalcTextSize(text.c_str()).x + 2 * pad, std::max(right - left, 1.0f));
    const ImVec2 corner{right - width, top};
    ImGui::SetCursorScreenPos(corner);
    ImGui::PushID(value.column);
    ImGui::PushID(value.name.c_str());
    if (area("value", {width, height}, ImGuiButtonFlags_MouseButtonLeft))
        show_everywhere(build, value);
    if (ImGui::IsItemClicked(1) && can_be_watched(value)) add_watch(build, watch_of(build, value));
    const bool is_shown = build.settings.probe.value == name_of(value);
    const ImU32 ground = is_shown                 ? colours::kAccentFill
                         : ImGui::IsItemHovered() ? colours::kFieldHovered
                                                  : colours::kField;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {right, top + height}, ground, theme.px(3));
    text_within(list, {corner.x + pad, top}, width - 2 * pad,
                is_finite(value) ? colours::kAccent : colours::kNotFinite, text);
    tip(theme, value_tip(value));
    ImGui::PopID();
    ImGui::PopID();
    return corner.x;
}

struct Line {
    std::string_view text;
    std::string file;
    int number = 0;
    std::uint8_t ran = 0;
};

// Those of the line, from right to left as far as there is room; where they begin.
float chips(Build& build, const Line& line, float left, float right, float top) {
    std::vector<const ProbeValue*> values;
    for (const ProbeValue& value : build.facts.probe.values)
        if (value.line == line.number && value.file == line.file && value.kind != "reached")
            values.push_back(&value);
    const float gap = build.theme.px(3), least = left + 0.25f * (right - left);
    std::size_t shown = 0;
    for (auto at = values.rbegin(); at != values.rend(); ++at, ++shown) {
        const float width = ImGui::CalcTextSize(chip_text(**at).c_str()).x + build.theme.px(10);
        if (shown > 0 && right - width < least) break;
        right = chip(build, **at, left, right, top) - gap;
    }
    return right;
}

void text_line(Build& build, const Line& line, float digits) {
    const Theme& theme = build.theme;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    const float height = ImGui::GetTextLineHeight();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::string number = fmt::format("{}", line.number);
    list.AddText({corner.x + digits - ImGui::CalcTextSize(number.c_str()).x, corner.y},
                 colours::kFaint, number.c_str());
    const float left = corner.x + digits + theme.px(10);
    const float right = chips(build, line, left, corner.x + width, corner.y);
    const std::size_t first = line.text.find_first_not_of(" \t");
    const bool is_comment = first != line.text.npos && line.text.substr(first, 2) == "//";
    const ImU32 ink = line.ran == 2 ? colours::kFaint : is_comment ? colours::kDim : colours::kText;
    text_within(list, {left, corner.y}, right - left, ink, line.text);
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy({width, height});
}

// The pass's own function first.
void follow_entry(const Build& build, SourceState& state) {
    const std::string& chosen = build.settings.probe.pass;
    const auto pass =
        std::ranges::find(build.facts.passes, chosen.empty() ? "image" : chosen, &PassFact::name);
    if (pass == build.facts.passes.end() || state.entry == pass->entry) return;
    const std::string& text = build.facts.scene->text;
    const std::size_t at = text.find("void " + pass->entry + "(");
    if (at == text.npos) return;
    state.entry = pass->entry;
    state.to = static_cast<int>(
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// The lines that are in view, and which these are.
void source(Build& build, SourceState& state) {
    const Scene& scene = *build.facts.scene;
    follow_entry(build, state);
    ImGui::PushFont(build.theme.mono);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, build.theme.px(3)});
    const float height = ImGui::GetTextLineHeightWithSpacing();
    const std::optional<int> to = state.to;
    const float digits = ImGui::CalcTextSize("00000").x;
    std::vector<std::size_t> begins = {0};
    for (std::size_t at = scene.text.find('\n'); at != scene.text.npos;
         at = scene.text.find('\n', at + 1))
        if (at + 1 < scene.text.size()) begins.push_back(at + 1);
    const std::size_t count = std::min(begins.size(), scene.origins.size());
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count));
    std::optional<std::size_t> first, last;
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const auto index = static_cast<std::size_t>(i);
            const std::size_t end = index + 1 < count ? begins[index + 1] : scene.text.size();
            std::string_view text =
                std::string_view(scene.text).substr(begins[index], end - begins[index]);
            if (text.ends_with('\n')) text.remove_suffix(1);
            const Origin& origin = scene.origins[index];
            const auto& ran = build.facts.probe.ran;
            ImGui::PushID(i);
            text_line(build,
                      {.text = text,
                       .file = scene.files[origin.file].string(),
                       .number = origin.line,
                       .ran = index < ran.size() ? ran[index] : std::uint8_t{0}},
                      digits);
            ImGui::PopID();
            if (!ImGui::IsItemVisible()) continue;  // the clipper measures the first one anywhere
            first = std::min(first.value_or(begins[index]), begins[index]);
            last = std::max(last.value_or(end), end);
        }
    }
    // Once the text has its height, which the frame before did not know.
    if (to && ImGui::GetScrollMaxY() > 0.0f) {
        ImGui::SetScrollY(std::max(static_cast<float>(*to - 2) * height, 0.0f));
        state.to.reset();
    }
    if (first && last) build.wishes.lines = Span{*first, *last};
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

// Lines of the text that keep their room, whatever stands above them.
constexpr float kLeastLines = 6.0f;

bool has_room(float height) {
    return ImGui::GetContentRegionAvail().y - height >= kLeastLines * ImGui::GetTextLineHeight();
}

float button_width(const std::string& label) {
    const ImGuiStyle& style = ImGui::GetStyle();
    return ImGui::CalcTextSize(label.c_str()).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
}

// One line: buttons where they fit, else a menu.
void pass_choice(Build& build) {
    const auto& passes = build.facts.probe.passes;
    ProbeView& view = build.settings.probe;
    const auto choose = [&](const std::string& pass) {
        view.pass = pass == "image" ? "" : pass;
        view.value.reset();
    };
    const std::string chosen = view.pass.empty() ? "image" : view.pass;
    float width = button_width("Cost");
    for (const std::string& pass : passes) width += button_width(pass);
    const bool fits = width <= ImGui::GetContentRegionAvail().x;
    if (passes.size() > 1 && !fits) {
        ImGui::SetNextItemWidth(
            std::max(ImGui::GetContentRegionAvail().x - button_width("Cost"), 1.0f));
        if (ImGui::BeginCombo("##pass", chosen.c_str())) {
            for (const std::string& pass : passes)
                if (ImGui::Selectable(pass.c_str(), pass == chosen)) choose(pass);
            ImGui::EndCombo();
        }
        tip(build.theme, "Whose text runs");
    }
    for (std::size_t i = 0; passes.size() > 1 && fits && i < passes.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        if (text_button(build.theme, passes[i].c_str(), passes[i] == chosen, "Whose text runs"))
            choose(passes[i]);
    }
    if (passes.size() > 1) ImGui::SameLine();
    if (text_button(build.theme, "Cost", view.cost,
                    "Turns of loops, reads of textures and calls of every pixel, as a heat map")) {
        view.cost = !view.cost;
        view.value.reset();
    }
}

// Which pixel it is, and what is amiss.
void pixel_line(Build& build) {
    const ProbeFact& probe = build.facts.probe;
    ProbeView& view = build.settings.probe;
    const std::string place = probe.pixel
                                  ? pixel_text(*probe.pixel, probe.size, probe.full_pixel)
                                  : "Move the mouse over the picture; a click pins a pixel.";
    const char* const compiling = "compiling\u2026";
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float padding = ImGui::GetStyle().FramePadding.y;
    float room = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    if (view.pinned) room -= button_width("pinned");
    if (probe.compiles) room -= button_width(compiling);
    const float width =
        std::clamp(ImGui::CalcTextSize(place.c_str()).x, 1.0f, std::max(room, 1.0f));
    ImGui::Dummy({width, ImGui::GetFrameHeight()});
    tip(build.theme, place);
    text_within(*ImGui::GetWindowDrawList(), {corner.x, corner.y + padding}, width,
                probe.pixel ? colours::kText : colours::kDim, place);
    if (view.pinned) {
        ImGui::SameLine();
        if (text_button(build.theme, "pinned", true, "Click, or Esc: follow the mouse again"))
            view.pinned.reset();
    }
    if (probe.compiles) {
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        text_in(colours::kDim, compiling);
    }
    ImGui::PushTextWrapPos(0.0f);
    if (!probe.problem.empty()) text_in(colours::kError, probe.problem);
    for (const std::string& note : probe.notes) text_in(colours::kWarning, note);
    ImGui::PopTextWrapPos();
}

// Whether the value comes from this watch, `hit@412`: it may be a part of that, `hit.nor`.
bool tells(const ProbeValue& value, const std::string& watch) {
    const std::size_t at = watch.rfind('@');
    const std::string place = watch.substr(at + 1);
    return value.name.starts_with(watch.substr(0, at)) &&
           place.substr(place.rfind(':') + 1) == std::to_string(value.line);
}

// One line, with a cross where it is one of the preset's. True when the line was pressed.
bool watched_line(Build& build, int id, const std::string& text, ImU32 ink,
                  std::optional<std::size_t> watch) {
    const float height = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width =
        std::max(ImGui::GetContentRegionAvail().x - (watch ? height + gap : 0.0f), 1.0f);
    ImGui::PushID(id);
    const bool pressed = area("watched", {width, height});
    text_within(*ImGui::GetWindowDrawList(), corner, width, ink, text);
    tip(build.theme, text);
    if (watch) {
        ImGui::SameLine();
        if (icon_button(build.theme, "end", Icon::close, "Watch it no longer",
                        {.colour = colours::kDim, .side = height})) {
            std::vector<std::string> list = build.facts.probe.watch;
            list.erase(list.begin() + static_cast<std::ptrdiff_t>(*watch));
            build.wishes.watch = std::move(list);
        }
    }
    ImGui::PopID();
    return pressed;
}

// Values of what is watched, and what of it has none.
void watched_lines(Build& build) {
    const ProbeFact& probe = build.facts.probe;
    std::vector<bool> has_value(probe.watch.size());
    int id = 0;
    for (const ProbeValue& value : probe.watched) {
        std::optional<std::size_t> watch;
        for (std::size_t i = 0; i < probe.watch.size() && !watch; ++i)
            if (!has_value[i] && tells(value, probe.watch[i])) watch = i;
        if (watch) has_value[*watch] = true;
        const bool is_shown = build.settings.probe.value == name_of(value);
        const ImU32 ink = is_shown           ? colours::kText
                          : is_finite(value) ? colours::kAccent
                                             : colours::kNotFinite;
        if (watched_line(build, id++, fmt::format("{}: {}", value.line, chip_text(value)), ink,
                         watch))
            show_everywhere(build, value);
    }
    for (std::size_t i = 0; i < probe.watch.size(); ++i)
        if (!has_value[i]) watched_line(build, id++, probe.watch[i], colours::kDim, i);
}

void watch_field(Build& build, SourceState& state) {
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x, 1.0f));
    std::array<char, 256> typed{};
    state.watch.copy(typed.data(), typed.size() - 1);
    const bool entered =
        ImGui::InputTextWithHint("##watch", "watch dot(nor, rd)@412, or go to line 412",
                                 typed.data(), typed.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    state.watch = typed.data();
    const bool is_line = !state.watch.empty() &&
                         state.watch.find_first_not_of("0123456789") == std::string::npos &&
                         state.watch.size() < 8;
    if (entered && is_line) {
        const auto& origins = build.facts.scene->origins;
        const auto line = std::ranges::find_if(origins, [&](const Origin& origin) {
            return origin.file == 0 && origin.line == std::stoi(state.watch);
        });
        if (line != origins.end()) state.to = static_cast<int>(line - origins.begin());
        return state.watch.clear();
    }
    if (!entered || state.watch.find('@') == std::string::npos) return;
    add_watch(build, state.watch);
    state.watch.clear();
}

// Lines from the smallest value to the largest, a colour a component, over pixels or bins.
template <class Value>
void curves(Build& build, const char* what, std::size_t count, int components, const Value& value) {
    const Theme& theme = build.theme;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = theme.px(56);
    ImGui::Dummy({width, height});
    tip(theme, what);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {corner.x + width, corner.y + height}, colours::kField, theme.px(4));
    const float inset = theme.px(4);
    for (int c = 0; c < components; ++c) {
        for (std::size_t i = 0; i < count; ++i) {
            const float share = value(i, static_cast<std::size_t>(c));
            const bool is_there = std::isfinite(share);
            if (is_there)
                list.PathLineTo({corner.x + inset +
                                     (width - 2 * inset) * static_cast<float>(i) /
                                         static_cast<float>(std::max<std::size_t>(count - 1, 1)),
                                 corner.y + height - inset - share * (height - 2 * inset)});
            if (!is_there || i + 1 == count)
                list.PathStroke(kComponentColours[static_cast<std::size_t>(c)], ImDrawFlags_None,
                                theme.px(1.5f));
        }
    }
}

// In line with buttons beside it.
void name_within(const Theme& theme, const std::string& name, float room) {
    ImGui::PushFont(theme.bold);
    const float width =
        std::clamp(ImGui::CalcTextSize(name.c_str()).x, 1.0f, std::max(room, theme.px(24)));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy({width, ImGui::GetFrameHeight()});
    text_within(*ImGui::GetWindowDrawList(),
                {corner.x, corner.y + ImGui::GetStyle().FramePadding.y}, width, colours::kText,
                name);
    ImGui::PopFont();
    tip(theme, name);
}

void value_picture(Build& build) {
    const ValueFacts* found = build.facts.probe.picture;
    ProbeView& view = build.settings.probe;
    if (!found || (!view.value && !view.cost)) return;
    constexpr std::array<std::pair<const char*, ValueLook>, 3> kLooks = {
        {{"Range", ValueLook::range},
         {"Sign", ValueLook::sign},
         {"Isolines", ValueLook::isolines}}};
    float room = ImGui::GetContentRegionAvail().x - button_width("Scene");
    for (const auto& [word, look] : kLooks)
        if (!view.cost) room -= button_width(word);
    name_within(build.theme, view.cost ? "cost" : view.value->name, room);
    for (const auto& [word, look] : kLooks) {
        if (view.cost) break;
        ImGui::SameLine(0, build.theme.px(4));
        if (text_button(build.theme, word, view.look == look, "How the value is shown"))
            view.look = look;
    }
    ImGui::SameLine(0, build.theme.px(4));
    if (text_button(build.theme, "Scene", false, "The scene again")) {
        view.value.reset();
        view.cost = false;
        return;
    }
    std::string facts;
    for (int c = 0; c < found->components; ++c)
        facts += fmt::format("{}{} to {}", c > 0 ? "; " : "",
                             short_number(static_cast<double>(found->min[c])),
                             short_number(static_cast<double>(found->max[c])));
    ImGui::PushTextWrapPos(0.0f);
    text_in(colours::kDim, facts);
    if (found->nan + found->infinite > 0)
        text_in(colours::kNotFinite, fmt::format("{} NaN, {} Inf", found->nan, found->infinite));
    if (found->unreached > 0)
        text_in(colours::kDim, fmt::format("not reached in {} pixels", found->unreached));
    ImGui::PopTextWrapPos();
    int most = 1;
    for (int c = 0; c < found->components; ++c)
        most = std::max(most,
                        *std::ranges::max_element(found->histogram[static_cast<std::size_t>(c)]));
    const float height = 2 * (build.theme.px(56) + ImGui::GetStyle().ItemSpacing.y);
    if (!has_room(height)) return;
    curves(
        build, "How often each value comes, from the smallest to the largest", 64,
        found->components, [&](std::size_t i, std::size_t c) {
            return std::sqrt(static_cast<float>(found->histogram[c][i]) / static_cast<float>(most));
        });
    float low = found->min[0], high = found->max[0];
    for (int c = 0; c < found->components; ++c)
        low = std::min(low, found->min[c]), high = std::max(high, found->max[c]);
    curves(build, "Along the row of the pixel", found->row.size(), found->components,
           [&](std::size_t i, std::size_t c) {
               const float v = found->row[i][static_cast<int>(c)];
               return high > low ? (v - low) / (high - low) : v - v + 0.5f;
           });
}

void dearest_lines(Build& build) {
    const ProbeCost* cost = build.facts.probe.cost;
    if (!cost || !build.settings.probe.cost) return;
    text_in(colours::kDim, fmt::format("a pixel: {:.0f} turns, {:.0f} reads, {:.0f} calls",
                                       cost->mean[0], cost->mean[1], cost->mean[2]));
    constexpr std::size_t kLeast = 3;
    for (std::size_t i = 0; i < cost->lines.size(); ++i) {
        const ProbeLineCost& line = cost->lines[i];
        if (i >= kLeast && !has_room(ImGui::GetTextLineHeightWithSpacing())) return;
        text_in(colours::kText,
                fmt::format("{:>5}  {} {}  {:.1f} a pixel", line.line, line.kind, line.name,
                            line.a_pixel),
                build.theme.mono);
    }
}

}  // namespace

void source_panel(Build& build, SourceState& state) {
    begin_panel(build, PanelId::source, "Source", build.settings.source);
    pass_choice(build);
    pixel_line(build);
    watched_lines(build);
    watch_field(build, state);
    value_picture(build);
    dearest_lines(build);
    begin_body();
    if (build.facts.scene) source(build, state);
    end_panel(build, PanelId::source);
}

// Where the pinned pixel is.
void probe_mark(Build& build) {
    const glm::dvec2 mark = build.facts.probe.mark;
    const ImGuiIO& io = ImGui::GetIO();
    if (!build.settings.source || mark.x < 0.0 || io.DisplayFramebufferScale.x <= 0.0f) return;
    const ImVec2 at{static_cast<float>(mark.x) / io.DisplayFramebufferScale.x,
                    io.DisplaySize.y - static_cast<float>(mark.y) / io.DisplayFramebufferScale.y};
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float radius = build.theme.px(7);
    list.AddCircle(at, radius + 1.0f, IM_COL32(0, 0, 0, 200), 0, build.theme.px(3));
    list.AddCircle(at, radius, colours::kAccent, 0, build.theme.px(1.5f));
}

}  // namespace glint
