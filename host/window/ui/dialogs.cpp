// What has to be answered before a person goes on: where to save, what to do with unsaved work.
#include "base/canonical_name.h"
#include "base/temporary_file.h"
#include "scene/preset.h"
#include "window/ui/interface.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSaveAs = "Save as";

bool may_write(const fs::path& folder) {
    return ::access(folder.empty() ? "." : folder.c_str(), W_OK) == 0;
}

// Where a new preset would go: beside an open preset, else into the folder of presets; where
// nothing can be written, as among installed examples, to where the program was started, or home.
fs::path proposed_path(const fs::path& file) {
    const std::string name = file.stem().string();
    if (is_preset(file) && may_write(file.parent_path()))
        return file.parent_path() / (name + "-2.toml");
    const fs::path beside = file.parent_path().parent_path() / "presets";
    std::error_code error;
    fs::path folder = fs::is_directory(beside, error) ? beside : file.parent_path();
    const char* home = std::getenv("HOME");
    if (!may_write(folder)) folder = may_write(".") || !home ? "" : home;
    const fs::path proposed = folder / (name + ".toml");
    return is_preset(file) && is_taken(proposed) ? folder / (name + "-2.toml") : proposed;
}

// In the upper middle, over all else, until it is answered. ImGui::EndPopup() follows where it is
// true.
bool begin_dialog(const char* name) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.4f * screen.y}, 0, {0.5f, 0.5f});
    return ImGui::BeginPopupModal(name, nullptr,
                                  ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
}

bool pressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
}

// Enter presses what the arrow keys have gone to.
bool button(const char* text) {
    const bool clicked = ImGui::Button(text);
    const bool is_reached = !GImGui->NavDisableHighlight && ImGui::IsItemFocused();
    return clicked || (is_reached && pressed(ImGuiKey_Enter));
}

// A heading, and a field below it that is ready to be typed into. True when Enter is pressed there.
bool path_field(const Theme& theme, const char* heading, std::string& path) {
    text_in(colours::kText, heading, theme.bold);
    const float widest = ImGui::GetIO().DisplaySize.x - theme.px(60);
    ImGui::SetNextItemWidth(std::min(theme.px(480), widest));
    if (ImGui::IsWindowAppearing()) {
        GImGui->InputTextState.ID = 0;  // it would go on where it was left, and select nothing
        ImGui::SetKeyboardFocusHere();
    }
    return ImGui::InputText("##path", &path, ImGuiInputTextFlags_EnterReturnsTrue);
}

bool has_folder(const fs::path& file) {
    std::error_code error;
    return file.parent_path().empty() || fs::is_directory(file.parent_path(), error);
}

std::string no_folder(const fs::path& file) {
    return fmt::format("There is no folder {}.", file.parent_path().string());
}

void ask_path(Build& build, SavingState& state) {
    const bool begins = build.settings.save_as;
    if (begins)
        state = {proposed_path(build.facts.file).string(), build.facts.start_time.has_value()};
    build.settings.save_as = false;
    if (begins) ImGui::OpenPopup(kSaveAs);
    if (!begin_dialog(kSaveAs)) return;
    const bool entered = path_field(build.theme, "Save as a preset", state.path);
    fs::path path(state.path);
    if (!path.empty() && !is_preset(path)) path += ".toml";
    std::error_code error;
    const bool exists = is_taken(path), is_folder = fs::is_directory(path, error);
    const bool is_named = path.has_filename() && path.filename() != ".toml" && !is_folder;
    const bool is_name = is_named && has_folder(path);
    text_in(exists || !is_name ? colours::kWarning : colours::kDim,
            is_folder   ? "This is a folder; name a file."
            : !is_named ? "Name a file."
            : !is_name  ? no_folder(path)
            : exists    ? "This file is there already and will be replaced."
                        : "A new file.");
    const double start = build.facts.start_time.value_or(shown_time(build));
    ImGui::Checkbox(fmt::format("start at {} s, the time that is shown###time", start).c_str(),
                    &state.keeps_time);
    ImGui::BeginDisabled(!is_name);
    const bool save = (button(exists ? "Replace" : "Save") || entered) && is_name;
    ImGui::EndDisabled();
    ImGui::SameLine();
    const bool cancel = button("Cancel") || pressed(ImGuiKey_Escape);
    if (save) {
        build.wishes.save_as = path;
        build.wishes.start_time = StartTime();
        if (state.keeps_time) build.wishes.start_time->seconds = start;
    }
    if (save || cancel) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

// In the folder that is open, under the first name that is free.
fs::path proposed_scene(const fs::path& folder) {
    for (int number = 1;; ++number) {
        const std::string name = number == 1 ? "new.frag" : fmt::format("new-{}.frag", number);
        if (!is_taken(folder / name)) return folder / name;
    }
}

void choose_template(Build& build, NewSceneState& state) {
    const auto& names = build.facts.templates;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        const std::string name(names[i]);
        if (ImGui::RadioButton(name.c_str(), state.from == i)) state.from = i;
    }
}

void ask_new_scene(Build& build, NewSceneState& state) {
    constexpr const char* kNewScene = "New scene";
    const bool begins = std::exchange(build.settings.new_scene, false);
    if (begins) state.path = proposed_scene(build.facts.folder).string();
    if (begins) ImGui::OpenPopup(kNewScene);
    if (!begin_dialog(kNewScene)) return;
    const bool entered = path_field(build.theme, "A new scene", state.path);
    choose_template(build, state);
    fs::path path(state.path);
    if (!path.empty() && ending_of(path) != ".frag") path += ".frag";
    const bool exists = is_taken(path), is_free = !exists && has_folder(path);
    text_in(is_free ? colours::kDim : colours::kWarning,
            exists    ? "This file is there already; name another."
            : is_free ? "It is written, and opened."
                      : no_folder(path));
    ImGui::BeginDisabled(!is_free);
    const bool create = (button("Create") || entered) && is_free && path.has_filename();
    ImGui::EndDisabled();
    ImGui::SameLine();
    const bool cancel = button("Cancel") || pressed(ImGuiKey_Escape);
    if (create && state.from < build.facts.templates.size())
        build.wishes.new_scene = {path, std::string(build.facts.templates[state.from])};
    if (create || cancel) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

// A button that Enter or Esc presses too, wherever no other is reached; that of Enter is lit.
bool choice(const char* text, ImGuiKey key = ImGuiKey_COUNT) {
    const ImU32 rest = ImGui::GetColorU32(ImGuiCol_Button);
    ImGui::PushStyleColor(ImGuiCol_Button, key == ImGuiKey_Enter ? colours::kAccentFill : rest);
    const bool is_free = key == ImGuiKey_Escape || GImGui->NavDisableHighlight;
    const bool chosen = button(text) || (key != ImGuiKey_COUNT && is_free && pressed(key));
    ImGui::PopStyleColor();
    ImGui::SameLine();
    return chosen;
}

// What is not saved is not left without a question; a path is asked for where there is none yet.
void leave_choices(Build& build) {
    const bool has_file = is_preset(build.facts.file);
    if (choice(has_file ? "Save" : "Save as\u2026", ImGuiKey_Enter)) {
        if (has_file) build.wishes.answer = Answer::save;
        build.settings.save_as = !has_file;
    }
    if (choice("Discard")) build.wishes.answer = Answer::discard;
    if (choice("Cancel", ImGuiKey_Escape)) build.wishes.answer = Answer::cancel;
}

void overwrite_choices(Build& build) {
    if (choice("Save over it")) build.wishes.answer = Answer::save;
    if (choice("Cancel", ImGuiKey_Escape)) build.wishes.answer = Answer::cancel;
}

void restore_choices(Build& build) {
    if (choice("Restore", ImGuiKey_Enter)) build.wishes.answer = Answer::restore;
    if (choice("Discard")) build.wishes.answer = Answer::discard;
}

struct QuestionText {
    std::string heading, explanation;
};

QuestionText text_of(const Facts& facts) {
    switch (facts.question) {
        case Question::none:
            break;
        case Question::leave:
            return {facts.title + " has changes that are not saved.",
                    "Tweaks and recorded events are lost without saving."};
        case Question::restore:
            return {
                "Unsaved changes of the last run",
                "Glint ended before the tweaks or recorded events of this file were saved. They "
                "have been kept."};
        case Question::overwrite:
            return {facts.file.filename().string() + " was changed meanwhile.",
                    "It says something else than when it was read. Saving over it writes what "
                    "stands here where the two differ; comments stay."};
    }
    return {};
}

void ask(Build& build) {
    constexpr const char* kQuestion = "question";
    const Question question = build.facts.question;
    const bool waits = build.settings.save_as || ImGui::IsPopupOpen(kSaveAs);
    if (question != Question::none && !waits && !ImGui::IsPopupOpen(kQuestion))
        ImGui::OpenPopup(kQuestion);
    if (!begin_dialog(kQuestion)) return;
    const QuestionText text = text_of(build.facts);
    ImGui::PushTextWrapPos(build.theme.px(420));
    text_in(colours::kText, text.heading, build.theme.bold);
    text_in(colours::kDim, text.explanation);
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, build.theme.px(2)});
    if (question == Question::leave) leave_choices(build);
    if (question == Question::overwrite) overwrite_choices(build);
    if (question == Question::restore) restore_choices(build);
    if (question == Question::none || build.wishes.answer || build.settings.save_as)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace

void dialogs(Build& build, SavingState& saving, NewSceneState& new_scene) {
    ask(build);
    ask_path(build, saving);
    ask_new_scene(build, new_scene);
}

}  // namespace glint
