#include "window/ui/viewer_controls.h"

#include "window/ui/number_text.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr std::array kChannelNames = {"RGB", "R", "G", "B", "A"};
constexpr std::array<ImU32, 4> kChannelColours = {
    IM_COL32(255, 110, 110, 255), IM_COL32(110, 220, 120, 255), IM_COL32(110, 160, 255, 255),
    IM_COL32(210, 210, 210, 255)};

void channels(Build& build) {
    PassView& view = build.settings.view;
    for (int i = 0; i < static_cast<int>(kChannelNames.size()); ++i) {
        if (i > 0) ImGui::SameLine(0, build.theme.px(2));
        const char* name = kChannelNames[static_cast<std::size_t>(i)];
        if (text_button(build.theme, name, view.channel == i, "")) view.channel = i;
    }
}

void zooms(Build& build) {
    PassView& view = build.settings.view;
    constexpr std::array<std::pair<const char*, double>, 5> kZooms = {
        {{"Fit", 0.0}, {"1:1", 1.0}, {"8\u00d7", 8.0}, {"32\u00d7", 32.0}, {"64\u00d7", 64.0}}};
    for (std::size_t i = 0; i < kZooms.size(); ++i) {
        if (i > 0) ImGui::SameLine(0, build.theme.px(2));
        const auto& [name, zoom] = kZooms[i];
        if (text_button(build.theme, name, view.zoom == zoom, "")) {
            view.zoom = zoom;
            if (zoom == 0.0) view.centre = glm::dvec2(0.5);
        }
    }
}

void exposure(Build& build) {
    PassView& view = build.settings.view;
    number_slider(build.theme, "##exposure", ImGui::GetContentRegionAvail().x, view.exposure,
                  {-10.0, 10.0, 0.0}, fmt::format("exposure {:+.1f} stops", view.exposure));
    tip(build.theme, "Right-click: 0");
    ImGui::Checkbox("tone curve", &view.tone_curve);
    tip(build.theme, "Bends what is brighter than white into the picture");
    same_line_if_fits(ImGui::CalcTextSize("mark NaN, Inf").x + ImGui::GetFrameHeight());
    ImGui::Checkbox("mark NaN, Inf", &view.mark_not_finite);
    tip(build.theme, "Pixels that are no number are magenta");
}

void counts(const PixelFacts& facts) {
    if (facts.nan == 0 && facts.infinite == 0)
        return text_in(colours::kDim, "every value is finite");
    text_in(colours::kNotFinite, fmt::format("{} NaN, {} Inf", facts.nan, facts.infinite));
}

void histogram(const Theme& theme, const PixelFacts& facts) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = theme.px(72);
    ImGui::Dummy({width, height});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {corner.x + width, corner.y + height}, colours::kField, theme.px(4));
    int most = 1;
    for (const auto& bins : facts.histogram) most = std::max(most, *std::ranges::max_element(bins));
    const float inset = theme.px(4);
    for (std::size_t channel = 0; channel < 4; ++channel) {
        const auto& bins = facts.histogram[channel];
        for (std::size_t i = 0; i < bins.size(); ++i) {
            // Square roots, so that a small number of pixels shows beside a large one.
            const float share =
                std::sqrt(static_cast<float>(std::max(bins[i], 0)) / static_cast<float>(most));
            const float x =
                corner.x + inset +
                (width - 2 * inset) * static_cast<float>(i) / static_cast<float>(bins.size() - 1);
            list.PathLineTo({x, corner.y + height - inset - share * (height - 2 * inset)});
        }
        list.PathStroke(kChannelColours[channel], ImDrawFlags_None, theme.px(1.5f));
    }
}

// A table of four numbers a line, under each other in all tables of the panel.
bool begin_numbers(const Theme& theme, const char* id) {
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {theme.px(2), theme.px(2)});
    const bool open = ImGui::BeginTable(id, 5, ImGuiTableFlags_SizingStretchSame);
    ImGui::PopStyleVar();
    if (open) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.px(30));
    return open;
}

// The tip has the digits that tell any two floats apart.
void numbers(const Theme& theme, const glm::vec4& value) {
    for (int i = 0; i < 4; ++i) {
        ImGui::TableNextColumn();
        const bool finite = std::isfinite(value[i]);
        const auto number = static_cast<double>(value[i]);
        text_in(finite ? colours::kText : colours::kNotFinite, short_number(number), theme.mono);
        tip(theme, fmt::format("{:.9g}", value[i]));
    }
}

void extremes(const Theme& theme, const PixelFacts& facts) {
    if (!begin_numbers(theme, "extremes")) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    for (std::size_t i = 0; i < 4; ++i) {
        ImGui::TableNextColumn();
        text_in(kChannelColours[i], kChannelNames[i + 1], theme.bold);
    }
    for (const auto& [name, value] : {std::pair("min", facts.min), std::pair("max", facts.max)}) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        text_in(colours::kDim, name);
        numbers(theme, value);
    }
    ImGui::EndTable();
}

void pixel_value(const Theme& theme, const PixelValue& pixel) {
    text_in(colours::kText, pixel.sampler.empty() ? "image" : pixel.sampler);
    ImGui::SameLine();
    text_in(colours::kDim, fmt::format("{}, {}", pixel.pixel.x, pixel.pixel.y));
    if (!begin_numbers(theme, "value")) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const float side = ImGui::GetTextLineHeight();
    const glm::vec4 c = pixel.value;
    ImGui::ColorButton("##swatch", {c.r, c.g, c.b, 1.0f},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoAlpha, {side, side});
    numbers(theme, pixel.value);
    ImGui::EndTable();
}

void values(Build& build) {
    if (build.facts.pixel_values.empty())
        return text_in(colours::kDim, "Move the mouse over the picture to read its pixels.");
    for (const PixelValue& pixel : build.facts.pixel_values) {
        ImGui::PushID(&pixel);
        pixel_value(build.theme, pixel);
        ImGui::PopID();
    }
}

}  // namespace

void viewer_controls(Build& build) {
    channels(build);
    zooms(build);
    exposure(build);
    ImGui::Checkbox("inspect", &build.settings.view.inspect);
    tip(build.theme, "Counts, histogram, and the values under the mouse in every buffer");
    if (!build.settings.view.inspect) return;
    if (build.facts.pixel_facts) {
        counts(*build.facts.pixel_facts);
        histogram(build.theme, *build.facts.pixel_facts);
        extremes(build.theme, *build.facts.pixel_facts);
    }
    values(build);
}

}  // namespace glint
