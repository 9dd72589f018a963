// The letters of the panels.
#pragma once

#include <memory>

struct ImFont;
struct ImFontAtlas;

namespace glint {

struct Fonts {
    float scale = 1.0f;                                        // dots a point
    std::shared_ptr<ImFontAtlas> atlas;                        // drawn
    ImFont *text = nullptr, *bold = nullptr, *mono = nullptr;  // the atlas's
};

// Finds and draws them: DejaVu comes through fontconfig; without it ImGui's own font must do. On
// any thread while there is no ImGui context, which counts the memory of all.
Fonts make_fonts(float scale);

}  // namespace glint
