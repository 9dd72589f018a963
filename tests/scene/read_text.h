// Scenes read from a text in a test.
#pragma once

#include "../base/test_folder.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace glint {

inline const std::string kImage = "void mainImage(out vec4 c, in vec2 f) { c = vec4(1); }\n";

inline std::string all(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) text += to_string(diagnostic) + "\n";
    return text;
}

inline ReadScene read(std::string_view text) {
    const TestFolder folder;
    return read_scene(folder.write("a.frag", text));
}

// The scene of a text that is right; an empty one, and a failure, when it is not.
inline Scene good(std::string_view text) {
    ReadScene result = read(text);
    EXPECT_EQ(all(result.diagnostics), "") << text;
    return result.scene.value_or(Scene{});
}

inline std::string tweak_names(const Scene& scene) {
    std::string names;
    for (const Tweak& tweak : scene.tweaks) names += tweak.name + " ";
    return names;
}

}  // namespace glint
