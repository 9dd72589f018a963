// The panels on a real window: ImGui's context, its GLFW and OpenGL backends, and its memory.
#include "window/ui/panels.h"

#include "window/ui/interface.h"
#include "window/ui/panel_memory.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace glint {
namespace {

// Dots of the framebuffer a unit of the window: 1 but where windows are measured in points.
float pixel_ratio(GLFWwindow* window) {
    int width = 0, height = 0, dots = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &dots, &height);
    return width > 0 && dots > 0 ? static_cast<float>(dots) / static_cast<float>(width) : 1.0f;
}

// A hash of what a person does with mouse and keys.
unsigned hash_of_input() {
    const ImGuiIO& io = ImGui::GetIO();
    unsigned hash = ImHashData(io.KeysDown, sizeof io.KeysDown);
    hash = ImHashData(io.MouseDown, sizeof io.MouseDown, hash);
    const float rest[] = {io.MousePos.x, io.MousePos.y, io.MouseWheel, io.MouseWheelH,
                          static_cast<float>(io.InputQueueCharacters.Size)};
    return ImHashData(rest, sizeof rest, hash);
}

// ImGui's place of one in pixels of the framebuffer, y up.
ImVec2 panel_place(glm::dvec2 position) {
    const ImGuiIO& io = ImGui::GetIO();
    return {static_cast<float>(position.x) / io.DisplayFramebufferScale.x,
            io.DisplaySize.y - static_cast<float>(position.y) / io.DisplayFramebufferScale.y};
}

void set_modifiers() {
    ImGuiIO& io = ImGui::GetIO();
    const auto either = [&](int left, int right) {
        return io.KeysDown[left] || io.KeysDown[right];
    };
    io.KeyCtrl = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    io.KeyShift = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    io.KeyAlt = either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
    io.KeySuper = either(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
}

void poll_buttons(GLFWwindow* window) {
    ImGuiIO& io = ImGui::GetIO();
    for (int button = 0; button < IM_ARRAYSIZE(io.MouseDown); ++button)
        io.MouseDown[button] = glfwGetMouseButton(window, button) == GLFW_PRESS;
}

// Whether the window does something now that changes what the panels have to say.
bool has_to_act(const Wishes& wishes) {
    return wishes.answer || wishes.open || wishes.save_as || wishes.new_scene || wishes.revert;
}

void add(Wishes& all, Wishes more) {
    if (more.open) all.open = std::move(more.open);
    if (more.save_as) all.save_as = std::move(more.save_as);
    if (more.new_scene) all.new_scene = std::move(more.new_scene);
    if (more.edit) all.edit = std::move(more.edit);
    if (more.fill) all.fill = std::move(more.fill);
    if (more.answer) all.answer = more.answer;
    if (more.study) all.study = std::move(more.study);
    if (more.start_time) all.start_time = more.start_time;
    if (more.watch) all.watch = std::move(more.watch);
    all.lines = more.lines;
    all.seen = std::move(more.seen);
    all.time.insert(all.time.end(), more.time.begin(), more.time.end());
    all.save |= more.save;
    all.revert |= more.revert;
    all.still |= more.still;
    all.toggle_recording |= more.toggle_recording;
    all.toggle_full_screen |= more.toggle_full_screen;
    all.tweaks_changed |= more.tweaks_changed;
    all.cancel_study |= more.cancel_study;
    all.check |= more.check;
    all.cancel_check |= more.cancel_check;
    all.quit |= more.quit;
}

}  // namespace

struct Panels::State {
    // What a person did: with a button of the mouse, a key, or by typing a character.
    struct Press {
        enum class Kind { button, key, character } kind;
        unsigned code;
        bool down = false;
        bool control = false;  // button: with Ctrl held
        ImVec2 at{};           // button
    };
    using Keys = std::array<bool, IM_ARRAYSIZE(ImGuiIO::KeysDown)>;
    GLFWwindow* window;
    std::string memory;  // ImGui keeps a pointer to it
    Fonts fonts;
    ImGuiContext* context;
    Interface interface;
    Memory remembered;
    std::deque<Press> presses;  // that ImGui has not seen
    Keys keys{};                // as ImGui has seen them
    unsigned input = 0;         // a hash of the last frame's
    int frames_to_settle = 3;   // an item that comes in front of another is seen a frame later

    void replay(const Press& press, const std::function<void()>& settle);
};

// ImGui looks at keys and buttons once a frame; what went down and up between two frames, or in an
// order, is shown to it one by one.
void Panels::State::replay(const Press& press, const std::function<void()>& settle) {
    ImGuiIO& io = ImGui::GetIO();
    if (press.kind == Press::Kind::character) return io.AddInputCharacter(press.code);
    if (io.InputQueueCharacters.Size > 0) settle();
    if (press.kind == Press::Kind::key) {
        io.KeysDown[press.code] = press.down;
        set_modifiers();
        before_frame();
        return settle();
    }
    const ImVec2 mouse = std::exchange(io.MousePos, press.at);
    const bool control = std::exchange(io.KeyCtrl, press.control);
    settle();  // what lies there is known a pass later
    io.MouseDown[press.code] = press.down;
    settle();
    io.MousePos = mouse;
    io.KeyCtrl = control;
}

Panels::Panels(GLFWwindow* window, float content_scale, const std::filesystem::path& memory,
               Fonts fonts) {
    if (fonts.scale != content_scale) fonts = make_fonts(content_scale);
    ImGuiContext* context = ImGui::CreateContext(fonts.atlas.get());
    ImGui::SetCurrentContext(context);
    const Theme theme = make_theme(fonts, pixel_ratio(window));
    state_ = std::unique_ptr<State>(new State{.window = window,
                                              .memory = memory.string(),
                                              .fonts = std::move(fonts),
                                              .context = context,
                                              .interface = Interface(theme),
                                              .remembered = {},
                                              .presses = {}});
    configure_io();
    remember(state_->remembered, state_->memory);
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    ImGui_ImplOpenGL3_NewFrame();  // makes its program and the letters
}

Panels::~Panels() {
    ImGui::SetCurrentContext(state_->context);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(state_->context);
}

void Panels::rescale(float content_scale) {
    ImGui::SetCurrentContext(state_->context);
    Fonts fonts = make_fonts(content_scale);
    state_->interface.set_theme(make_theme(fonts, pixel_ratio(state_->window)));
    state_->fonts = std::move(fonts);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    state_->frames_to_settle = 3;
}

void Panels::compile() {
    ImGui::SetCurrentContext(state_->context);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {1, 1};
    ImGui::NewFrame();
    ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, {1, 1}, IM_COL32_WHITE);
    ImGui::Render();
    draw();
}

Wishes Panels::update(const Facts& facts, TweakValues& tweaks, const Transport& transport,
                      PanelSettings& settings) {
    ImGui::SetCurrentContext(state_->context);
    ImGuiIO& io = ImGui::GetIO();
    ImGui_ImplOpenGL3_NewFrame();
    const std::vector<bool> held(std::begin(io.MouseDown), std::end(io.MouseDown));
    ImGui_ImplGlfw_NewFrame();
    const unsigned input = hash_of_input();
    const bool is_touched = input != state_->input || !state_->presses.empty();
    state_->input = input;
    std::ranges::copy(held, std::begin(io.MouseDown));
    std::ranges::copy(state_->keys, std::begin(io.KeysDown));
    io.InputQueueCharacters.resize(0);  // they are among the presses
    set_modifiers();
    before_frame();
    Wishes wishes;
    Transport shown = transport;  // as it will be once the wishes are granted
    bool is_behind = true;
    const auto build = [&] {
        ImGui::NewFrame();
        recall(state_->remembered, state_->interface.places(), settings);
        Wishes more = state_->interface.build(facts, tweaks, shown, settings);
        for (const TweakEdit& edit : more.tweaks) more.tweaks_changed |= tweaks.apply(edit);
        for (const TimeEdit& edit : more.time) shown.apply(edit);
        is_behind = more.tweaks_changed || !more.time.empty() || state_->interface.is_behind();
        add(wishes, std::move(more));
        note(state_->remembered, state_->interface.places(), settings);
        ImGui::Render();
        io.DeltaTime = 1e-6f;  // what follows is the same instant
    };
    // Frames of a slow scene are seconds apart: what stands wrong is mended before it is seen.
    // Later passes see no new events, since the mouse and the keys have not moved in between.
    const auto settle = [&] {
        constexpr int kMostPasses = 6;
        is_behind = true;
        for (int pass = 0; pass < kMostPasses && is_behind; ++pass) build();
    };
    // What comes after an answer is meant for what the window shows then.
    while (!state_->presses.empty() && !has_to_act(wishes)) {
        state_->replay(state_->presses.front(), settle);
        state_->presses.pop_front();
    }
    if (state_->presses.empty()) poll_buttons(state_->window);
    settle();
    std::ranges::copy(io.KeysDown, state_->keys.begin());
    state_->frames_to_settle =
        is_touched || is_behind ? 2 : std::max(state_->frames_to_settle - 1, 0);
    return wishes;
}

void Panels::draw() {
    ImGui::SetCurrentContext(state_->context);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Panels::mouse_button(glm::dvec2 position, int button, bool down, bool control) {
    ImGui::SetCurrentContext(state_->context);
    if (button >= IM_ARRAYSIZE(ImGui::GetIO().MouseDown)) return;
    state_->presses.push_back({.kind = State::Press::Kind::button,
                               .code = static_cast<unsigned>(button),
                               .down = down,
                               .control = control,
                               .at = panel_place(position)});
}

void Panels::key(int code, bool down) {
    if (code < 0 || code >= IM_ARRAYSIZE(ImGuiIO::KeysDown)) return;
    state_->presses.push_back(
        {.kind = State::Press::Kind::key, .code = static_cast<unsigned>(code), .down = down});
}

void Panels::character(unsigned code) {
    state_->presses.push_back({.kind = State::Press::Kind::character, .code = code});
}

bool Panels::takes_mouse() const {
    ImGui::SetCurrentContext(state_->context);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Panels::takes_keyboard() const {
    ImGui::SetCurrentContext(state_->context);
    const ImGuiIO& io = ImGui::GetIO();
    return io.WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) ||
           (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard);
}

bool Panels::takes_mouse_at(glm::dvec2 position) const {
    ImGui::SetCurrentContext(state_->context);
    if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return true;
    const ImVec2 at = panel_place(position);
    return std::ranges::any_of(GImGui->Windows, [&](const ImGuiWindow* window) {
        return window->Active && !window->Hidden && !(window->Flags & ImGuiWindowFlags_NoInputs) &&
               window->OuterRectClipped.Contains(at);
    });
}

bool Panels::takes_text() const {
    ImGui::SetCurrentContext(state_->context);
    return ImGui::GetIO().WantTextInput;
}

bool Panels::is_typing() const {
    return takes_text() && state_->interface.is_typing();
}

void Panels::end_typing() {
    ImGui::SetCurrentContext(state_->context);
    ImGui::ClearActiveID();
}

bool Panels::is_settling() const {
    ImGui::SetCurrentContext(state_->context);
    return state_->frames_to_settle > 0 || state_->interface.is_moving();
}

}  // namespace glint
