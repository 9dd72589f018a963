#include "window/ui/fonts.h"

#include <fontconfig/fontconfig.h>
#include <imgui_freetype.h>
#include <unistd.h>

#include <cmath>
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

ImFont* add_font(ImFontAtlas& atlas, const char* name, float size, const ImWchar* ranges) {
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

}  // namespace

Fonts make_fonts(float scale) {
    Fonts fonts{.scale = scale, .atlas = std::make_shared<ImFontAtlas>()};
    ImFontAtlas& atlas = *fonts.atlas;
    atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    const float size = std::round(kFontSize * scale);
    fonts.text = add_font(atlas, "DejaVu Sans:style=Book", size, kWide);
    fonts.bold = add_font(atlas, "DejaVu Sans:style=Bold", size, kNarrow);
    fonts.mono = add_font(atlas, "DejaVu Sans Mono:style=Book", std::round(0.94f * size), kWide);
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsRGBA32(&texels, &width, &height);
    return fonts;
}

}  // namespace glint
