// A screen without a window: panels are built on it, and the test holds the mouse.
#pragma once

#include "window/ui/interface.h"
#include "window/ui/panel_memory.h"

#include <imgui_internal.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace glint {

// A float with a range.
inline Tweak number(const char* name, double initial, double min, double max) {
    Tweak tweak;
    tweak.name = name;
    tweak.initial = {initial};
    tweak.min = min;
    tweak.max = max;
    return tweak;
}

class Screen {
public:
    explicit Screen(std::vector<Tweak> declared, ImVec2 size = {1280, 720}, float scale = 1.0f)
        : fonts_(make_fonts(scale)),
          context_(ImGui::CreateContext(fonts_.atlas.get())),
          interface(make_theme(fonts_)) {
        scene.tweaks = std::move(declared);
        tweaks = TweakValues(scene.tweaks);
        facts.scene = &scene;
        transport.pause();
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = size;
        io.DeltaTime = 1.0f / 60;
        io.IniFilename = nullptr;
        io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
        for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
        configure_io();
        for (int i = 0; i < 4; ++i) frame();
    }
    ~Screen() { ImGui::DestroyContext(context_); }
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    Wishes frame() {
        ImGui::NewFrame();
        Wishes now = interface.build(facts, tweaks, transport, settings);
        ImGui::Render();
        for (const TweakEdit& edit : now.tweaks) now.tweaks_changed |= tweaks.apply(edit);
        for (const TimeEdit& edit : now.time) transport.apply(edit);
        changed = changed || now.tweaks_changed;
        if (now.open) wishes.open = now.open;
        if (now.save_as) wishes.save_as = now.save_as;
        if (now.new_scene) wishes.new_scene = now.new_scene;
        if (now.edit) wishes.edit = now.edit;
        if (now.fill) wishes.fill = now.fill;
        if (now.answer) wishes.answer = now.answer;
        if (now.study) wishes.study = now.study;
        wishes.cancel_study = wishes.cancel_study || now.cancel_study;
        wishes.check = wishes.check || now.check;
        wishes.cancel_check = wishes.cancel_check || now.cancel_check;
        if (now.start_time) wishes.start_time = now.start_time;
        wishes.save = wishes.save || now.save;
        wishes.revert = wishes.revert || now.revert;
        return now;
    }
    void move(ImVec2 to) {
        ImGui::GetIO().MousePos = to;
        frame();
    }
    void button(bool down, int which = 0) {
        ImGui::GetIO().MouseDown[which] = down;
        frame();
    }
    void click(ImVec2 at, int which = 0) {
        move(at);
        button(true, which);
        button(false, which);
        frame();
    }
    void drag(ImVec2 from, ImVec2 to) {
        move(from);
        button(true);
        for (int i = 1; i <= 8; ++i) {
            const float t = static_cast<float>(i) / 8.0f;
            move({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
        }
        button(false);
        frame();
    }
    void type(const char* text) {
        ImGui::GetIO().AddInputCharactersUTF8(text);
        frame();
    }
    void press(ImGuiKey key) {
        ImGui::GetIO().KeysDown[key] = true;
        frame();
        ImGui::GetIO().KeysDown[key] = false;
        frame();
    }
    // Long enough ago that the next press is no double-click.
    void wait() {
        move({-1000, -1000});
        for (int i = 0; i < 60; ++i) frame();
    }

    // The open window whose name begins so; "/" parts a child's from its parent's. Null: none.
    static ImGuiWindow* window(const std::string& name) {
        for (ImGuiWindow* candidate : GImGui->Windows)
            if (candidate->Active && std::string(candidate->Name).starts_with(name))
                return candidate;
        return nullptr;
    }

    // The id of a control in the tweak's row, such as "##slider".
    ImGuiID in_row(std::size_t index, const char* control, int component = -1) const {
        const ImGuiWindow* body = window("Tweaks/body");
        if (!body) return 0;
        ImGuiID id = ImHashStr(scene.tweaks[index].name.c_str(), 0, body->ID);
        if (component >= 0) id = ImHashData(&component, sizeof component, id);
        return ImHashStr(control, 0, id);
    }

    // Where the mouse hovers this item: its middle; nothing if it is not on the screen. Looked for
    // from top to bottom of a window.
    std::optional<ImRect> find(ImGuiID id, const char* in = "Tweaks") {
        const ImGuiWindow* place = window(in);
        if (!place || !id) return std::nullopt;
        const ImRect area = place->Rect();
        for (float y = area.Min.y + 2; y < area.Max.y; y += 4)
            for (float x = area.Min.x + 3; x < area.Max.x; x += 12) {
                move({x, y});
                if (GImGui->HoveredId == id) return extent(id, {x, y});
            }
        return std::nullopt;
    }

    Scene scene;
    TweakValues tweaks{{}};
    Transport transport;
    PanelSettings settings;
    Facts facts;
    Wishes wishes;  // all that was asked for
    bool changed = false;

private:
    ImRect extent(ImGuiID id, ImVec2 at) {
        ImRect rect(at, at);
        const auto reach = [&](float dx, float dy) {
            ImVec2 edge = at;
            for (int i = 0; i < 3000; ++i) {
                move({edge.x + dx, edge.y + dy});
                if (GImGui->HoveredId != id) break;
                edge = {edge.x + dx, edge.y + dy};
            }
            rect.Add(edge);
        };
        reach(-1, 0), reach(1, 0), reach(0, -1), reach(0, 1);
        return rect;
    }

    Fonts fonts_;
    ImGuiContext* context_;

public:
    Interface interface;
};

}  // namespace glint
