#include "window/ui/panel_memory.h"

#include <imgui_internal.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>

namespace glint {
namespace {

constexpr const char* kPanelNames[] = {"tweaks", "passes", "browser", "study", "check", "source"};
constexpr const char* kOpenNames[] = {"tweaks", "transport", "passes", "browser",
                                      "study",  "check",     "source"};
static_assert(std::size(kPanelNames) == kPanelCount);
static_assert(std::size(kOpenNames) == std::tuple_size<decltype(Memory::open)>());

Memory& memory_of(ImGuiSettingsHandler* handler) {
    return *static_cast<Memory*>(handler->UserData);
}

void* open_section(ImGuiContext*, ImGuiSettingsHandler* handler, const char*) {
    memory_of(handler).read = true;
    return handler->UserData;
}

// One line "name=value" of our section; what is unknown or absurd is passed over.
void read_line(ImGuiContext*, ImGuiSettingsHandler* handler, void*, const char* line) {
    Memory& memory = memory_of(handler);
    char name[32] = "";
    float number = 0.0f;
    if (std::sscanf(line, "%31[a-z.]=%f", name, &number) != 2 || !std::isfinite(number)) return;
    const std::string key = name;
    if (key == "left.width") memory.places.width[0] = number;
    if (key == "right.width") memory.places.width[1] = number;
    for (std::size_t i = 0; i < kPanelCount; ++i)
        if (key == std::string(kPanelNames[i]) + ".right")
            memory.places.side[i] = number != 0.0f ? Side::right : Side::left;
    for (std::size_t i = 0; i < memory.open.size(); ++i)
        if (key == std::string(kOpenNames[i]) + ".open") memory.open[i] = number != 0.0f;
}

void write_section(ImGuiContext*, ImGuiSettingsHandler* handler, ImGuiTextBuffer* out) {
    const Memory& memory = memory_of(handler);
    out->appendf("[%s][panels]\n", handler->TypeName);
    out->appendf("left.width=%.0f\nright.width=%.0f\n", static_cast<double>(memory.places.width[0]),
                 static_cast<double>(memory.places.width[1]));
    for (std::size_t i = 0; i < kPanelCount; ++i)
        out->appendf("%s.right=%d\n", kPanelNames[i], memory.places.side[i] == Side::right);
    for (std::size_t i = 0; i < memory.open.size(); ++i)
        out->appendf("%s.open=%d\n", kOpenNames[i], memory.open[i]);
    out->append("\n");
}

}  // namespace

void remember(Memory& memory, const std::string& file) {
    std::error_code error;  // is noticed by no one: places are no work
    // ImGui would wait for a pipe.
    const bool is_other =
        std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error);
    const bool remembers = !file.empty() && !is_other;
    ImGui::GetIO().IniFilename = remembers ? file.c_str() : nullptr;
    if (!remembers) return;
    std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
    ImGuiSettingsHandler handler;
    handler.TypeName = "Glint";
    handler.TypeHash = ImHashStr("Glint");
    handler.ReadOpenFn = open_section;
    handler.ReadLineFn = read_line;
    handler.WriteAllFn = write_section;
    handler.UserData = &memory;
    ImGui::GetCurrentContext()->SettingsHandlers.push_back(handler);
}

void recall(Memory& memory, Places& places, PanelSettings& settings) {
    if (memory.recalled) return;
    memory.recalled = true;
    if (!memory.read) return;
    places = memory.places;
    settings.tweaks = memory.open[0];
    settings.transport = memory.open[1];
    settings.passes = memory.open[2];
    settings.browser = memory.open[3];
    settings.study = memory.open[4];
    settings.check = memory.open[5];
    settings.source = memory.open[6];
}

void note(Memory& memory, const Places& places, const PanelSettings& settings) {
    const std::array open{settings.tweaks, settings.transport, settings.passes, settings.browser,
                          settings.study,  settings.check,     settings.source};
    if (memory.places == places && memory.open == open) return;
    memory.places = places;
    memory.open = open;
    ImGui::MarkIniSettingsDirty();
}

void configure_io() {
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigInputTextCursorBlink = false;  // a blinking cursor would ask for frames
    io.ConfigDragClickToInputText = true;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
}

// Tab walks from field to field while one is typed in or the panels have the keyboard; otherwise it
// is the window's, which hides the panels. So is Ctrl+Space, which plays, and presses nothing.
void before_frame() {
    ImGuiIO& io = ImGui::GetIO();
    static_assert(ImGuiKey_Tab == 0);
    constexpr int kGlfwTab = 258, kGlfwSpace = 32;
    const bool is_panels =
        io.WantTextInput || (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard);
    io.KeyMap[ImGuiKey_Tab] = is_panels ? kGlfwTab : -1;
    if (io.KeyCtrl) io.KeysDown[kGlfwSpace] = false;
}

}  // namespace glint
