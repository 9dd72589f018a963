#include "window/ui/theme.h"

namespace glint {
namespace {

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

Theme make_theme(const Fonts& fonts, float pixels) {
    const Theme theme{
        .scale = fonts.scale / pixels, .text = fonts.text, .bold = fonts.bold, .mono = fonts.mono};
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts = fonts.atlas.get();
    io.FontGlobalScale = 1.0f / pixels;
    set_sizes(theme);
    set_colours();
    return theme;
}

}  // namespace glint
