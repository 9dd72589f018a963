// The panels on a real window: ImGui's context, its GLFW and OpenGL backends, and its memory.
#include "ui/panels.h"

#include "ui/interface.h"
#include "ui/memory.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <string>

namespace glint {
namespace {

// Dots of the framebuffer a unit of the window: 1 but where windows are measured in points.
float pixel_ratio(GLFWwindow* window) {
    int width = 0, height = 0, dots = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &dots, &height);
    return width > 0 && dots > 0 ? static_cast<float>(dots) / static_cast<float>(width) : 1.0f;
}

// A hash of all that was built, so that two equal frames are known as such.
std::uint64_t hash_of(const ImDrawData& data) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        const auto bytes = list.VtxBuffer.size_in_bytes();
        hash ^= ImHashData(list.VtxBuffer.Data, static_cast<std::size_t>(bytes));
        hash *= 0x100000001b3u;
    }
    return hash;
}

void add(Wishes& all, Wishes more) {
    if (more.open) all.open = std::move(more.open);
    if (more.save_as) all.save_as = std::move(more.save_as);
    if (more.edit) all.edit = std::move(more.edit);
    all.save |= more.save;
    all.revert |= more.revert;
    all.still |= more.still;
    all.toggle_recording |= more.toggle_recording;
    all.toggle_full_screen |= more.toggle_full_screen;
    all.tweaks_changed |= more.tweaks_changed;
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
    GLFWwindow* window;
    std::string memory;  // ImGui keeps a pointer to it
    ImGuiContext* context;
    Interface interface;
    Memory remembered;
    std::uint64_t hash = 0;
    ImVec2 mouse{0, 0};
    int frames_to_settle = 3;

    void follow_changes();
};

// A window that opens takes two frames to find its size, and so does what depends on it.
void Panels::State::follow_changes() {
    constexpr int kFrames = 3;
    const std::uint64_t now = hash_of(*ImGui::GetDrawData());
    const ImGuiIO& io = ImGui::GetIO();
    const bool moved = io.MousePos.x != mouse.x || io.MousePos.y != mouse.y;
    frames_to_settle = now != hash || moved ? kFrames : std::max(frames_to_settle - 1, 0);
    hash = now;
    mouse = io.MousePos;
}

Panels::Panels(GLFWwindow* window, float content_scale, const std::filesystem::path& memory) {
    ImGuiContext* context = ImGui::CreateContext();
    ImGui::SetCurrentContext(context);
    const float ratio = pixel_ratio(window);
    state_ = std::unique_ptr<State>(
        new State{.window = window,
                  .memory = memory.string(),
                  .context = context,
                  .interface = Interface(make_theme(content_scale / ratio, ratio)),
                  .remembered = {}});
    configure_io();
    remember(state_->remembered, state_->memory);
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

Wishes Panels::update(const Facts& facts, History& history, Transport& transport,
                      PanelSettings& settings) {
    ImGui::SetCurrentContext(state_->context);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    Wishes wishes;
    // Frames of a slow scene are seconds apart: what stands wrong is mended before it is seen.
    // Later passes see no new events, since the mouse and the keys have not moved in between.
    constexpr int kMostPasses = 6;
    for (int pass = 0; pass < kMostPasses; ++pass) {
        if (pass > 0) ImGui::GetIO().DeltaTime = 1e-6f;
        before_frame();
        ImGui::NewFrame();
        recall(state_->remembered, state_->interface.places(), settings);
        add(wishes, state_->interface.build(facts, history, transport, settings));
        note(state_->remembered, state_->interface.places(), settings);
        ImGui::Render();
        if (!state_->interface.is_behind()) break;
    }
    state_->follow_changes();
    return wishes;
}

void Panels::draw() {
    ImGui::SetCurrentContext(state_->context);
    bind_screen();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Panels::takes_mouse() const {
    ImGui::SetCurrentContext(state_->context);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Panels::takes_keyboard() const {
    ImGui::SetCurrentContext(state_->context);
    return ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

bool Panels::is_settling() const {
    ImGui::SetCurrentContext(state_->context);
    return state_->frames_to_settle > 0 || state_->interface.is_moving();
}

}  // namespace glint
