#include "window/ui/theme.h"

#include <fontconfig/fontconfig.h>
#include <imgui_freetype.h>
#include <unistd.h>

#include <string>

namespace glint {
namespace {

constexpr float kFontSize = 15.0f;  // points from ascender to descender

// Latin, Greek, Cyrillic, and the signs of shader descriptions; and U+FFFD, which stands for what
// is no UTF-8. Not more: all glyphs are drawn before the first frame, some 8 us each.
constexpr ImWchar kWide[] = {0x20,   0x17f,  0x370,  0x3ff,  0x400,  0x45f,  0x2010, 0x2027, 0x2032,
                             0x2033, 0x2070, 0x208e, 0x2190, 0x2194, 0x2202, 0x2211, 0x221a, 0x221e,
                             0x2248, 0x2248, 0x2260, 0x2265, 0xfffd, 0xfffd, 0};
constexpr ImWchar kNarrow[] = {0x20, 0xff, 0x2010, 0x2027, 0xfffd, 0xfffd, 0};

// The file of the font that fontconfig holds nearest to a name such as "DejaVu Sans:bold"; "" if
// there is none.
std::string font_file(const char* name) {
    FcPattern* wanted = FcNameParse(reinterpret_cast<const FcChar8*>(name));
    if (!wanted) return {};
    FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
    FcDefaultSubstitute(wanted);
    FcResult result = FcResultNoMatch;
    FcPattern* found = FcFontMatch(nullptr, wanted, &result);
    FcChar8* file = nullptr;
    std::string path;
    if (found && FcPatternGetString(found, FC_FILE, 0, &file) == FcResultMatch)
        path = reinterpret_cast<const char*>(file);
    if (found) FcPatternDestroy(found);
    FcPatternDestroy(wanted);
    return path;
}

ImFont* add_font(const char* name, float size, const ImWchar* ranges) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const std::string file = font_file(name);
    ImFont* font = nullptr;
    // ImGui ends the program where there is none; fontconfig may know one that has gone.
    if (::access(file.c_str(), R_OK) == 0)
        font = atlas.AddFontFromFileTTF(file.c_str(), size, nullptr, ranges);
    if (font) return font;
    ImFontConfig config;
    config.SizePixels = size;
    return atlas.AddFontDefault(&config);
}

void set_sizes(const Theme& theme) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = {theme.px(12), theme.px(12)};
    style.FramePadding = {theme.px(8), theme.px(4)};
    style.ItemSpacing = {theme.px(8), theme.px(6)};
    style.ItemInnerSpacing = {theme.px(6), theme.px(4)};
    style.CellPadding = {theme.px(6), theme.px(3)};
    style.IndentSpacing = theme.px(16);
    style.ScrollbarSize = theme.px(10);
    style.GrabMinSize = theme.px(4);
    style.WindowMinSize = {1, 1};
    style.WindowRounding = style.PopupRounding = theme.px(6);
    style.ChildRounding = style.FrameRounding = theme.px(4);
    style.GrabRounding = theme.px(2);
    style.ScrollbarRounding = theme.px(5);
    style.WindowBorderSize = style.PopupBorderSize = 1.0f;
    style.FrameBorderSize = style.ChildBorderSize = 0.0f;
    style.ColorButtonPosition = ImGuiDir_Left;
    style.SelectableTextAlign = {0.0f, 0.5f};
}

void set_colours() {
    ImGui::StyleColorsDark();
    const auto set = [](ImGuiCol index, ImU32 colour) {
        ImGui::GetStyle().Colors[index] = ImGui::ColorConvertU32ToFloat4(colour);
    };
    set(ImGuiCol_WindowBg, colours::kPanel);
    set(ImGuiCol_PopupBg, colours::kPopup);
    set(ImGuiCol_Border, colours::kLine);
    set(ImGuiCol_Separator, colours::kLine);
    set(ImGuiCol_Text, colours::kText);
    set(ImGuiCol_TextDisabled, colours::kDim);
    set(ImGuiCol_TextSelectedBg, IM_COL32(105, 178, 236, 90));
    set(ImGuiCol_ModalWindowDimBg, IM_COL32(0, 0, 0, 110));
    for (const ImGuiCol index : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_TableHeaderBg})
        set(index, colours::kField);
    for (const ImGuiCol index : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered})
        set(index, colours::kFieldHovered);
    for (const ImGuiCol index : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive})
        set(index, colours::kFieldActive);
    set(ImGuiCol_Header, IM_COL32(255, 255, 255, 14));
    set(ImGuiCol_HeaderHovered, IM_COL32(255, 255, 255, 24));
    set(ImGuiCol_HeaderActive, IM_COL32(255, 255, 255, 34));
    set(ImGuiCol_CheckMark, colours::kAccent);
    // Numbers stand over the grab: it is no brighter than they can bear.
    set(ImGuiCol_SliderGrab, IM_COL32(74, 130, 176, 255));
    set(ImGuiCol_SliderGrabActive, colours::kAccent);
    set(ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0));
    set(ImGuiCol_ScrollbarGrab, IM_COL32(255, 255, 255, 40));
    set(ImGuiCol_ScrollbarGrabHovered, IM_COL32(255, 255, 255, 70));
    set(ImGuiCol_ScrollbarGrabActive, IM_COL32(255, 255, 255, 90));
    set(ImGuiCol_ResizeGrip, IM_COL32(0, 0, 0, 0));
    set(ImGuiCol_NavHighlight, colours::kAccent);
    set(ImGuiCol_ResizeGripHovered, IM_COL32(105, 178, 236, 90));
    set(ImGuiCol_ResizeGripActive, colours::kAccent);
    set(ImGuiCol_SeparatorHovered, IM_COL32(105, 178, 236, 120));
    set(ImGuiCol_SeparatorActive, colours::kAccent);
}

}  // namespace

Theme make_theme(float scale, float pixels) {
    Theme theme{.scale = scale};
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    const float size = std::round(kFontSize * scale * pixels);
    theme.text = add_font("DejaVu Sans:style=Book", size, kWide);
    theme.bold = add_font("DejaVu Sans:style=Bold", size, kNarrow);
    theme.mono = add_font("DejaVu Sans Mono:style=Book", std::round(0.94f * size), kWide);
    io.FontGlobalScale = 1.0f / pixels;
    set_sizes(theme);
    set_colours();
    return theme;
}

}  // namespace glint
