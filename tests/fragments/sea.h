// Pictures of our own in the scene of the sea.
#pragma once

#include "probe.h"

namespace glint {

inline const std::string kSeaFile = std::string(GLINT_REPOSITORY) + "/fragments/sea.frag";

// The scene with a picture of our own; what stands in `body` writes c from the pixel p.
inline std::string sea_picture(std::string_view body) {
    return with_picture(kSeaFile,
                        fmt::format("readFrames();\n"
                                    "    Eye e = camera();\n"
                                    "    vec3 rd = viewRay(e, p);\n"
                                    "    float angle = 1.0 / (e.lens * iResolution.y);\n"
                                    "    Surface u = surfaceAt(e, rd, ivec2(p));\n"
                                    "    bool mirrors = u.id == kWater || u.id == kGlass;\n"
                                    "    vec3 from = u.pos + 0.002 * u.nor;\n"
                                    "{}",
                                    body));
}

// Every pixel's value of such a picture, with the scene's clock at 5 s.
inline std::vector<glm::vec4> picture(std::string_view body, glm::ivec2 size,
                                      const std::string& tweaks) {
    Player player(sea_picture(body), {.size = size, .preset = "[tweaks]\n" + tweaks});
    Frame frame = player.frame(0);
    frame.time = 5.0;
    player.draw(frame);
    return pixels_of(player);
}

}  // namespace glint
