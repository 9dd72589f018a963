// Scenes in which `glint check` has to find nothing, beside the twins of planted_faults.h.
#pragma once

#include "planted_faults.h"

namespace glint::cli {

// Scenes that look suspicious and are sound.
inline std::vector<std::pair<std::string, std::string>> honest_scenes() {
    using namespace planting;
    return {
        {"progressive_average", fed("vec4 now = vec4(fract(sin(dot(p, vec2(12.9, 78.2)) + "
                                    "float(iFrame) * 1.7) * 43758.5));"
                                    " float n = iFrame == 0 ? 0.0 : s.w; c = vec4(mix(s.xyz, "
                                    "now.xyz, 1.0 / (n + 1.0)), n + 1.0);",
                                    "", "", "c = vec4(texelFetch(state, ivec2(p), 0).xyz, 1.0);")},
        {"counted_average", fed("float n = iFrame == 0 ? 0.0 : s.w; c = vec4(mix(s.xyz, vec3(0.5), "
                                "1.0 / (n + 1.0)), n "
                                "+ 1.0);")},
        {"population", fed("c = s + 0.004 * s * (1.0 - s); if (s.x == 0.0) c = vec4(0.01);",
                           "size=8x8 step=1/60")},
        {"oscillator",
         fed("float w = sqrt(k), h = 1.0 / 60.0; vec2 y = s.xy == vec2(0.0) ? vec2(1.0, "
             "0.0) : s.xy; c = vec4(y.x * cos(w * h) + y.y / w * sin(w * h), y.y * cos(w "
             "* h) - y.x * w * sin(w * h), 0.0, 1.0);",
             "size=8x8 step=1/60", "uniform float k; //@ 4.0 [1, 40]\n")},
        {"sum_of_steps", fed("c = s + 0.001;", "size=8x8 step=1/60")},
        {"counted_bytes",
         fed("c = vec4(s.x <= 0.0 ? 1.0 : s.x - 5.0 / 255.0);", "size=8x8 format=rgba8 step=1/60")},
        {"meter", image("c = vec4(q, 0.4, 1.0); if (q.y < 0.05 && q.x * 300.0 < 1.0 / "
                        "max(iTimeDelta, 1e-3)) c = vec4(0.2, 0.9, 0.2, 1.0);")},
        {"full_bytes", fed("c = s + 0.02 * step(3.0, p.x);", "size=8x8 format=rgba8 step=1/60")},
        {"clock", fed("float h = iFrame == 0 ? 12.0 : s.x; h += iTimeDelta * 0.1; "
                      "c = vec4(h >= 24.0 ? h - 24.0 : h, 0.3, 0.0, 1.0);",
                      "size=8x8", "",
                      "c = vec4(vec3(0.4 - 0.3 * cos(0.2617994 * texelFetch(state, ivec2(0), "
                      "0).x)), 1.0);")},
        {"car", fed("float x = iFrame == 0 ? 0.5 : s.x; x += 0.003 * iTimeDelta; "
                    "c = vec4(x > 0.9 ? 0.1 : x, 0.3, 0.0, 1.0);",
                    "size=8x8 step=1/120")},
        {"trail", fed("vec2 at = 0.5 + 0.4 * vec2(cos(" + std::string(kTurn) + "), sin(" + kTurn +
                          ")); c = max(s * exp(-1.5 * iTimeDelta), vec4(smoothstep(0.2, 0.0, "
                          "distance(p / iResolution.xy, at))));",
                      "", "", "c = texelFetch(state, ivec2(p), 0);")},
        {"polar",
         image("vec2 d = (p - 0.5 * iResolution.xy) / iResolution.y; c = vec4(0.5 + atan(d.y, d.x) "
               "/ 6.3, length(d), 0.5, 1.0);")},
        {"reversed_edges",
         image("c = vec4(smoothstep(0.32, 0.3, distance(q, vec2(0.5))), 0.0, 0.0, 1.0);")},
        {"lightning", image("float t = float(iTick & 0x7ffffu) / 65536.0;"
                            " c = vec4(vec3(0.1 + 0.8 * exp(-9.0 * abs(t - 4.0))), 1.0);")},
        {"daylight", image("c = vec4(q, 0.5 + 0.4 * sin(6.2831853 * iTime / 86400.0), 1.0);")},
        {"slower", image("c = vec4(q, 0.5 + 0.4 * sin(log(iTime + 1.0)), 1.0);")},
        {"slower_by_the_root",
         image("c = vec4(q, 0.5 + 0.4 * sin(sqrt(iTime) + 6.0 * q.x), 1.0);")},
        {"sunrise", "uniform float dawn; //@ 300 [100, 600]\n" +
                        image("c = vec4(q, smoothstep(0.0, dawn, iTime), 1.0);")},
        {"smoke", fed("c = s * 0.99 + vec4(exp(-dot(p - 4.0, p - 4.0)));", "size=8x8 step=1/60")},
    };
}

}  // namespace glint::cli
