// Texts and pictures of our own in the scene of the block of land.
#pragma once

#include "probe.h"

namespace glint {

inline const std::string kTerrainFile = std::string(GLINT_REPOSITORY) + "/fragments/terrain.frag";

inline std::string terrain_text(std::string_view more) {
    return fmt::format("#include \"{}\"\n{}", kTerrainFile, more);
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
