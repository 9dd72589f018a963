// Texts and pictures of our own in the scene of the block of land.
#pragma once

#include "probe.h"

#include <cstring>

namespace glint {

inline const std::string kTerrainFile = std::string(GLINT_REPOSITORY) + "/fragments/terrain.frag";

inline std::string terrain_text(std::string_view more) {
    return fmt::format("#include \"{}\"\n{}", kTerrainFile, more);
}
// The scene with a picture of our own.
inline std::string with_picture(std::string_view body) {
    return fmt::format(
        "#define mainImage scene_image\n#include \"{}\"\n#undef mainImage\n"
        "void mainImage(out vec4 c, in vec2 p) {{\n{}}}\n",
        kTerrainFile, body);
}
inline std::vector<glm::vec4> pixels_of(Player& player) {
    const std::vector<float> values = player.floats();
    std::vector<glm::vec4> pixels(values.size() / 4);
    std::memcpy(pixels.data(), values.data(), values.size() * sizeof(float));
    return pixels;
}
// A buffer, or a picture, at 5 s.
inline std::vector<glm::vec4> drawn(std::string_view text, PlayerOptions options,
                                    double time = 5.0) {
    Player player(text, std::move(options));
    Frame frame = player.frame(0);
    frame.time = time;
    player.draw(frame);
    return pixels_of(player);
}

}  // namespace glint
