// Error against run time: a knob is chosen, its values are measured beside the window, and a click
// on a point applies it.
#include "measure/rows/together.h"
#include "window/ui/diagram.h"
#include "window/ui/interface.h"
#include "window/ui/number_text.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <tuple>
#include <utility>

namespace glint {
namespace {

constexpr const char* kAllKnobs = "All quality tweaks";
constexpr const char* kTogether = "All together";

const Tweak* find_tweak(const Build& build, const std::string& name) {
    if (!build.facts.scene) return nullptr;
    const auto found = std::ranges::find(build.facts.scene->tweaks, name, &Tweak::name);
    return found == build.facts.scene->tweaks.end() ? nullptr : &*found;
}

// What a row sets: the knob, or each tweak of a joint setting, "a=1 b=2".
std::vector<Turned> turned_by(const Build& build, const Study& study, std::size_t row) {
    std::string list = study.rows[row].value, wrong;
    const Tweak* tweak = find_tweak(build, study.knob);
    if (!build.facts.scene || (!tweak && !study.is_joint)) return {};
    if (study.is_joint) std::ranges::replace(list, ' ', ',');
    return turned_values(build.facts.scene->tweaks, tweak ? *tweak : Tweak(), list, wrong);
}

// The row at whose value the tweak stands, as far as the shader can tell.
std::optional<std::size_t> current_row(const Build& build, const Study& study) {
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        const std::vector<Turned> turned = turned_by(build, study, i);
        const bool stands = std::ranges::all_of(turned, [&](const Turned& one) {
            if (one.tweak >= build.tweaks.size()) return false;
            const Tweak& tweak = build.facts.scene->tweaks[one.tweak];
            return tidy(tweak, one.value) == tidy(tweak, build.tweaks.value(one.tweak));
        });
        if (!turned.empty() && stands) return i;
    }
    return std::nullopt;
}

// Compares its picture, and sets the tweaks to it as a person would, in one step; how long a scene
// settles is no tweak.
void choose(Build& build, const Study& study, std::size_t row) {
    build.settings.shown_row = row;
    const std::vector<Turned> turned = turned_by(build, study, row);
    if (turned.empty() || current_row(build, study) == row) return;
    const bool several = turned.size() > 1;
    if (several) wish(build, {.what = TweakEdit::What::begin});
    for (const Turned& one : turned)
        wish(build, {.what = TweakEdit::What::set, .index = one.tweak, .value = one.value});
    if (several) wish(build, {.what = TweakEdit::What::commit});
}

std::string error_text(const StudyRow& row) {
    return row.error ? power_text(row.error->rmse) : "";
}

// Joint settings from the fastest to the nearest: each has less error than all that are faster. By
// the medians alone, so that there is something to drag on a machine whose clock tells little.
std::vector<std::size_t> frontier_stops(const Study& study) {
    std::vector<std::size_t> rows, stops;
    for (std::size_t i = 0; i < study.rows.size(); ++i)
        if (study.rows[i].failed.empty() && study.rows[i].error) rows.push_back(i);
    std::ranges::stable_sort(rows, {}, [&](std::size_t i) { return study.rows[i].ms.median; });
    for (const std::size_t i : rows)
        if (stops.empty() || study.rows[i].error->rmse < study.rows[stops.back()].error->rmse)
            stops.push_back(i);
    return stops;
}

// All quality tweaks are dragged together; one drag is one step of undo.
void along_frontier(Build& build, StudyState& state, const Study& study) {
    if (!study.is_joint) return;
    const std::vector<std::size_t> stops = frontier_stops(study);
    if (stops.size() < 2) return;
    // The handle stands at the last stop that is no slower than what is set.
    const auto current = current_row(build, study);
    const auto slower = [&](std::size_t i) {
        return current && study.rows[i].ms.median > study.rows[*current].ms.median;
    };
    const auto after = std::ranges::find_if(stops, slower);
    int at = std::max(static_cast<int>(after - stops.begin()) - 1, 0);
    const std::string text = current
                                 ? fmt::format("{:.3g} ms, RMSE {}", study.rows[*current].ms.median,
                                               error_text(study.rows[*current]))
                                 : "drag: all together";
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x, 1.0f));
    const bool moved = ImGui::SliderInt("##along", &at, 0, static_cast<int>(stops.size()) - 1,
                                        text.c_str(), ImGuiSliderFlags_NoInput);
    const std::size_t row = stops[static_cast<std::size_t>(at)];
    // The handle may stand at a stop that is not what is set: a click there sets it.
    if (moved || (ImGui::IsItemActivated() && current != row)) {
        build.settings.shown_row = row;
        for (const Turned& one : turned_by(build, study, row))
            state.edits.set(build, one.tweak, one.value);
    }
    tip(build.theme, "All quality tweaks at once, from the fastest to the nearest");
}

void knob_menu(Build& build, StudyState& state) {
    const Scene* scene = build.facts.scene;
    if (state.knob != kAllTogether && !find_tweak(build, state.knob)) state.knob.clear();
    const float button = ImGui::CalcTextSize("Cancel").x + build.theme.px(24);
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - button, 1.0f));
    const char* shown = state.knob.empty()           ? kAllKnobs
                        : state.knob == kAllTogether ? kTogether
                                                     : state.knob.c_str();
    if (!ImGui::BeginCombo("##knob", shown)) return;
    if (ImGui::Selectable(kAllKnobs, state.knob.empty())) state.knob.clear();
    if (ImGui::Selectable(kTogether, state.knob == kAllTogether)) state.knob = kAllTogether;
    tip(build.theme, "The joint settings with the least error for their time");
    for (std::size_t i = 0; scene && i < scene->tweaks.size(); ++i) {
        const Tweak& tweak = scene->tweaks[i];
        if (!tweak.quality) continue;
        if (ImGui::Selectable(tweak.name.c_str(), tweak.name == state.knob))
            state.knob = tweak.name;
        tip(build.theme, tweak.description);
    }
    ImGui::EndCombo();
}

void run_button(Build& build, const StudyState& state) {
    const bool running = build.facts.study_work.running;
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.0f), 0};
    ImGui::BeginDisabled(!build.facts.scene);
    if (running && ImGui::Button("Cancel", size)) build.wishes.cancel_study = true;
    if (!running && ImGui::Button("Run", size)) {
        build.wishes.study = state.knob;
        build.settings.shown = Shown::scene;
        build.settings.shown_study = 0;
        build.settings.shown_row.reset();
    }
    ImGui::EndDisabled();
}

// Which knob's diagram is seen, where there are several.
void study_choice(Build& build) {
    const auto& studies = build.facts.studies;
    if (studies.size() < 2) return;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const char* name = studies[i].knob.c_str();
        if (i > 0) same_line_if_fits(ImGui::CalcTextSize(name).x + build.theme.px(16));
        if (text_button(build.theme, name, build.settings.shown_study == i, "")) {
            build.settings.shown_study = i;
            build.settings.shown_row.reset();
        }
        ImGui::PopID();
    }
}

// The value; of a joint setting what differs from the preset's own, for all of it is long.
std::string short_value(const Study& study, const StudyRow& row) {
    const auto own = std::ranges::find_if(study.rows, &StudyRow::is_preset);
    if (!study.is_joint || own == study.rows.end()) return row.value;
    if (row.is_preset) return "own";
    std::istringstream parts(row.value), own_parts(own->value);
    std::string text, part, own_part;
    while (parts >> part && own_parts >> own_part)
        if (part != own_part) text += (text.empty() ? "" : " ") + part;
    return text;
}

std::string psnr_text(const StudyRow& row) {
    if (!row.error) return "";
    return std::isfinite(row.error->psnr) ? fmt::format("{:.1f}", row.error->psnr) : "\u221e";
}

void row_tip(Build& build, const Study& study, const StudyRow& row) {
    const Theme& theme = build.theme;
    // Beside the panel, where it hides no other point.
    const Area& panel = build.layout.areas[static_cast<std::size_t>(PanelId::study)];
    const bool left = panel.corner.x + 0.5f * panel.size.x < 0.5f * ImGui::GetIO().DisplaySize.x;
    ImGui::SetNextWindowPos({left ? panel.right() + theme.px(8) : panel.corner.x - theme.px(8),
                             ImGui::GetIO().MousePos.y},
                            0, {left ? 0.0f : 1.0f, 0.5f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(10), theme.px(8)});
    ImGui::BeginTooltip();
    text_in(colours::kText, study.is_joint ? row.value : study.knob + " " + row.value, theme.bold);
    if (!row.failed.empty()) text_in(colours::kError, row.failed);
    text_in(colours::kText, fmt::format("{:.4g} ms, 95 of 100 within {:.4g} to {:.4g}",
                                        row.ms.median, row.ms.low, row.ms.high));
    if (row.verdict) text_in(colours::kDim, to_string(*row.verdict));
    if (row.error) {
        text_in(colours::kText, fmt::format("RMSE {}, at most {}", power_text(row.error->rmse),
                                            power_text(row.error->max)));
        text_in(colours::kText, fmt::format("PSNR {} dB, {:.2f} % off by more than 1/255",
                                            psnr_text(row), 100.0 * row.error->share_off));
        text_in(colours::kText, fmt::format("FLIP {}", power_text(row.error->flip)));
    }
    if (row.is_reference) text_in(colours::kDim, "the reference");
    if (row.pareto) text_in(colours::kDim, "no other value is told to be better");
    if (row.near_reference) text_in(colours::kDim, "within ten times of the reference's own error");
    if (study.is_joint || find_tweak(build, study.knob))
        text_in(colours::kAccent, "Click to apply");
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

void row_line(Build& build, StudyState& state, const Study& study, std::size_t index) {
    const StudyRow& row = study.rows[index];
    const ImU32 colour = !row.failed.empty() ? colours::kError
                         : row.pareto        ? colours::kText
                                             : colours::kDim;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(index));
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    const bool lit = state.hovered == index || build.settings.shown_row == index;
    if (ImGui::Selectable("##row", lit, ImGuiSelectableFlags_SpanAllColumns))
        choose(build, study, index);
    if (ImGui::IsItemHovered()) state.hovering = index;
    ImGui::PopStyleColor();
    ImGui::SameLine(0, 0);
    ImGui::PushFont(current_row(build, study) == index ? build.theme.bold : nullptr);
    text_within(*ImGui::GetWindowDrawList(), ImGui::GetCursorScreenPos(),
                ImGui::GetContentRegionAvail().x, colour, short_value(study, row));
    ImGui::PopFont();
    for (const std::string& text :
         {fmt::format("{:.4g}", row.ms.median), error_text(row), psnr_text(row)}) {
        ImGui::TableNextColumn();
        text_in(colour, text);
    }
    ImGui::PopID();
}

void row_table(Build& build, StudyState& state, const Study& study) {
    if (study.rows.empty()) return;
    if (!ImGui::BeginTable("rows", 4, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableNextRow();
    for (const char* name : {study.knob.c_str(), "ms", "RMSE", "PSNR, dB"}) {
        ImGui::TableNextColumn();
        text_in(colours::kDim, name);
    }
    for (std::size_t i = 0; i < study.rows.size(); ++i) row_line(build, state, study, i);
    ImGui::EndTable();
}

// The scene itself, or the pictures that were measured.
void view_choice(Build& build, const Study& study) {
    PanelSettings& settings = build.settings;
    constexpr std::array<std::tuple<const char*, Shown, const char*>, 3> kChoices = {
        {{"Scene", Shown::scene, "The scene itself, live"},
         {"Wipe", Shown::wipe, "The measured picture left of a line, the reference right of it"},
         {"Heat map", Shown::map, "How far the measured picture is from the reference"}}};
    for (const auto& [name, shown, meaning] : kChoices) {
        if (shown != Shown::scene) ImGui::SameLine(0, build.theme.px(2));
        if (!text_button(build.theme, name, settings.shown == shown, meaning)) continue;
        settings.shown = shown;
        if (!settings.shown_row) settings.shown_row = current_row(build, study).value_or(0);
    }
}

void study_facts(const Study& study) {
    ImGui::PushTextWrapPos(0.0f);
    const double own = study.reference_rmse();
    text_in(colours::kDim, "Reference " + study.reference);
    if (own > 0.0) text_in(colours::kDim, "Itself within " + power_text(own));
    if (const auto order = study.told_order())
        text_in(colours::kDim, fmt::format("Order {:.2f}", *order));
    for (const std::string& finding : study.findings) text_in(colours::kWarning, finding);
    ImGui::PopTextWrapPos();
}

void one_study(Build& build, StudyState& state, const Study& study) {
    if (study.rows.empty()) return text_in(colours::kDim, "Drawing the reference\u2026");
    // The height does not hang on whether there is a scroll bar, which hangs on the height.
    const float width = std::max(ImGui::GetContentRegionAvail().x, build.theme.px(120));
    const auto& panel = build.layout.areas[static_cast<std::size_t>(PanelId::study)];
    const float height = std::max(std::round(0.7f * panel.size.x), build.theme.px(100));
    const bool compares = build.settings.shown != Shown::scene;
    const DiagramLook look{.size = {width, height},
                           .hovered = state.hovered,
                           .current = current_row(build, study),
                           .chosen = compares ? build.settings.shown_row : std::nullopt};
    const auto under = diagram(build.theme, study, look);
    if (under) state.hovering = under;
    if (under && ImGui::IsItemClicked()) choose(build, study, *under);
    along_frontier(build, state, study);
    view_choice(build, study);
    row_table(build, state, study);
    study_facts(study);
}

void introduce_study() {
    ImGui::PushTextWrapPos(0.0f);
    text_in(colours::kDim,
            "Draws the scene as it stands with each value of its quality tweaks, and compares the "
            "pictures with that of the reference: how much error for how many milliseconds.");
    ImGui::PopTextWrapPos();
}

}  // namespace

void study_panel(Build& build, StudyState& state) {
    begin_panel(build, PanelId::study, "Study", build.settings.study);
    knob_menu(build, state);
    ImGui::SameLine(0, build.theme.px(4));
    run_button(build, state);
    work_line(build.theme, build.facts.study_work);
    begin_body();
    study_choice(build);
    const auto& studies = build.facts.studies;
    state.hovered = std::exchange(state.hovering, std::nullopt);
    if (build.settings.shown_study < studies.size()) {
        const Study& study = studies[build.settings.shown_study];
        one_study(build, state, study);
        if (state.hovering && *state.hovering < study.rows.size())
            row_tip(build, study, study.rows[*state.hovering]);
    } else if (!build.facts.study_work.running) {
        introduce_study();
    }
    end_panel(build, PanelId::study);
    state.edits.follow(build.wishes);
}

}  // namespace glint
