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

// Presses keys that went down and up again since the last frame, which ImGui's backend misses;
// GLFW's sticky keys know of them. Returns those that are to be let go after the frame.
std::vector<int> press_tapped(GLFWwindow* window) {
    ImGuiIO& io = ImGui::GetIO();
    std::vector<int> tapped;
    for (const int key : io.KeyMap) {
        if (key < 0 || glfwGetKey(window, key) != GLFW_PRESS || io.KeysDown[key]) continue;
        io.KeysDown[key] = true;
        tapped.push_back(key);
    }
    return tapped;
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

void bind_screen() {
    using BindFramebuffer = void (*)(unsigned, unsigned);
    constexpr unsigned kFramebuffer = 0x8D40;  // GL_FRAMEBUFFER
    static const auto bind =
        reinterpret_cast<BindFramebuffer>(glfwGetProcAddress("glBindFramebuffer"));
    if (bind) bind(kFramebuffer, 0);
}

}  // namespace

struct Panels::State {
    struct Press {
        ImVec2 at;
        int button;
        bool down, control;
    };
    GLFWwindow* window;
    std::string memory;  // ImGui keeps a pointer to it
    ImGuiContext* context;
    Interface interface;
    Memory remembered;
    std::vector<Press> presses;  // since the last frame
    unsigned input = 0;          // a hash of the last frame's
    int frames_to_settle = 3;    // an item that comes in front of another is seen a frame later
};

Panels::Panels(GLFWwindow* window, float content_scale, const std::filesystem::path& memory) {
    ImGuiContext* context = ImGui::CreateContext();
    ImGui::SetCurrentContext(context);
    const float ratio = pixel_ratio(window);
    state_ = std::unique_ptr<State>(
        new State{.window = window,
                  .memory = memory.string(),
                  .context = context,
                  .interface = Interface(make_theme(content_scale / ratio, ratio)),
                  .remembered = {},
                  .presses = {}});
    configure_io();
    remember(state_->remembered, state_->memory);
    glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE);
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Panels::~Panels() {
    ImGui::SetCurrentContext(state_->context);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(state_->context);
}

void Panels::rescale(float content_scale) {
    ImGui::SetCurrentContext(state_->context);
    const float ratio = pixel_ratio(state_->window);
    state_->interface.set_theme(make_theme(content_scale / ratio, ratio));
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    state_->frames_to_settle = 3;
}

Wishes Panels::update(const Facts& facts, TweakValues& tweaks, const Transport& transport,
                      PanelSettings& settings) {
    ImGui::SetCurrentContext(state_->context);
    ImGuiIO& io = ImGui::GetIO();
    ImGui_ImplOpenGL3_NewFrame();
    const std::vector<bool> held(std::begin(io.MouseDown), std::end(io.MouseDown));
    ImGui_ImplGlfw_NewFrame();
    before_frame();
    const std::vector<int> tapped = press_tapped(state_->window);
    const unsigned input = hash_of_input();
    const bool is_touched = input != state_->input || !state_->presses.empty();
    state_->input = input;
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
        for (const int key : tapped) io.KeysDown[key] = false;
        io.DeltaTime = 1e-6f;  // what follows is the same instant
    };
    const ImVec2 mouse = io.MousePos;
    const bool control = io.KeyCtrl;
    std::ranges::copy(held, std::begin(io.MouseDown));
    for (const State::Press& press : std::exchange(state_->presses, {})) {
        io.MousePos = press.at;
        io.KeyCtrl = press.control;
        build();  // what lies there is known a pass later
        io.MouseDown[press.button] = press.down;
        build();
    }
    io.MousePos = mouse;
    io.KeyCtrl = control;
    for (int button = 0; button < IM_ARRAYSIZE(io.MouseDown); ++button) {
        io.MouseDown[button] = glfwGetMouseButton(state_->window, button) == GLFW_PRESS;
    }
    is_behind = true;
    // Frames of a slow scene are seconds apart: what stands wrong is mended before it is seen.
    // Later passes see no new events, since the mouse and the keys have not moved in between.
    constexpr int kMostPasses = 6;
    for (int pass = 0; pass < kMostPasses && is_behind; ++pass) {
        build();
    }
    state_->frames_to_settle =
        is_touched || is_behind ? 2 : std::max(state_->frames_to_settle - 1, 0);
    return wishes;
}

void Panels::draw() {
    ImGui::SetCurrentContext(state_->context);
    bind_screen();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Panels::mouse_button(glm::dvec2 position, int button, bool down, bool control) {
    ImGui::SetCurrentContext(state_->context);
    if (button >= IM_ARRAYSIZE(ImGui::GetIO().MouseDown)) return;
    state_->presses.push_back({panel_place(position), button, down, control});
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
