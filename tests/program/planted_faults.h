// Faults that `glint check` has to find, each with a sound twin: small scenes, a row a pair.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace glint::cli {

struct Planted {
    std::string name;         // "kind/what"
    std::string fault, twin;  // scenes
};

namespace planting {

inline std::string image(const std::string& body) {
    return "void mainImage(out vec4 c, in vec2 p) {\n    vec2 q = p / iResolution.xy;\n    " +
           body + "\n}\n";
}

// Two or three tweaks of [0, 1]; the picture is a function of `x`, which is negative where it
// fails.
inline std::string tweaked(const std::string& declarations, const std::string& x,
                           const std::string& use) {
    return declarations + image("float x = " + x + ";\n    c = vec4(vec3(" + use + "), 1.0);");
}

// A turn in 8 s, as right after a year.
constexpr const char* kTurn = "6.2831853 * float(iTick & 524287u) / 524288.0";

constexpr const char* kA = "uniform float a; //@ 0.5 [0, 1]\n";
constexpr const char* kB = "uniform float b; //@ 0.5 [0, 1]\n";
constexpr const char* kD = "uniform float d; //@ 0.5 [0, 1]\n";

inline void add_corners(std::vector<Planted>& list) {
    const std::string ab = std::string(kA) + kB, abd = ab + kD;
    const auto add = [&](const char* name, const std::string& tweaks, const std::string& x,
                         const char* use = "sqrt(x)") {
        list.push_back({std::string("corner/") + name, tweaked(tweaks, x, use),
                        tweaked(tweaks, "max(" + x + ", 1e-3)", use)});
    };
    add("high_low", ab, "0.9 - (a - b)");
    add("low_high", ab, "0.95 - (b - a)");
    add("log", ab, "0.9 - (a - b)", "log(x)");
    add("pow", ab, "0.9 - (b - a)", "pow(x, 0.3)");
    add("small", ab, "0.99 - (a - b)");
    add("high_low_high", abd, "1.8 - (a - b + d)");
    add("low_high_low", abd, "0.9 - (b - a - d)", "inversesqrt(x)");
    add("log_slider",
        "uniform float a; //@ 10.0 [1, 100] log\nuniform float b; //@ 10.0 [1, 100] log\n",
        "90.0 - a / b");
    add("whole_numbers", "uniform int a; //@ 5 [1, 9]\nuniform int b; //@ 5 [1, 9]\n",
        "7.5 - float(a - b)");
    add("menu", "uniform int a; //@ 1 {none, some, many}\nuniform float b; //@ 0.5 [0, 1]\n",
        "a == 2 ? b - 0.05 : 1.0");
    add("switch", std::string("uniform bool a; //@ off\n") + kB, "a ? b - 0.04 : 1.0");
    add("components", "uniform vec2 v; //@ 0.5, 0.5 [0, 1]\n", "0.93 - (v.x - v.y)");
}

// Within a range, where neither its ends nor points that spread ever are.
inline void add_zeros(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const std::string& tweaks, const char* fault,
                         const char* twin) {
        const auto text = [&](const char* x) {
            return tweaks + image(fmt::format("c = vec4(0.5 + 0.4 * vec3({}), 1.0);", x));
        };
        list.push_back({std::string("zero/") + name, text(fault), text(twin)});
    };
    const std::string v = "uniform vec3 v; //@ (0.0, 1.0, 0.0) [-0.3, 1]\n";
    add("direction", v, "normalize(v)", "v / max(length(v), 1e-6)");
    add("sine", "uniform float a; //@ 1.0 [-2, 3]\n", "sin(a) / a", "a == 0.0 ? 1.0 : sin(a) / a");
    add("both", "uniform float a; //@ 1.0 [-2, 3]\nuniform float b; //@ 1.0 [-1, 1]\n",
        "min(a * a / (a * a + b * b), 0.9)", "min(a * a / (a * a + b * b + 1e-6), 0.9)");
}

inline void add_balls(std::vector<Planted>& list) {
    struct Ball {
        const char *name, *centre, *use;
        double radius;
    };
    const Ball balls[] = {{"root", "0.21, 0.77, 0.34", "sqrt(x)", 0.12},
                          {"log", "0.83, 0.41, 0.69", "log(x)", 0.1},
                          {"inverse", "0.15, 0.18, 0.86", "inversesqrt(x)", 0.1},
                          {"pow", "0.62, 0.9, 0.12", "pow(x, 1.5)", 0.11},
                          {"small", "0.31, 0.29, 0.73", "sqrt(x)", 0.07},
                          {"smaller", "0.77, 0.68, 0.24", "sqrt(x)", 0.05},
                          {"near_a_face", "0.97, 0.35, 0.61", "log2(x)", 0.1},
                          {"near_an_edge", "0.04, 0.95, 0.4", "sqrt(x)", 0.09}};
    const std::string tweaks = std::string(kA) + kB + kD;
    for (const Ball& ball : balls) {
        const std::string x = fmt::format("distance(vec3(a, b, d), vec3({}))", ball.centre);
        list.push_back({std::string("ball/") + ball.name,
                        tweaked(tweaks, fmt::format("{} - {}", x, ball.radius), ball.use),
                        tweaked(tweaks, x + " + 0.01", ball.use)});
    }
    const auto steep = [&](double radius) {
        return tweaked(tweaks, "distance(vec3(a, b, d), vec3(0.3, 0.6, 0.7))",
                       fmt::format("x < {:.2f} ? log(-1.0 - a) : x", radius));
    };
    list.push_back({"ball/steep", steep(0.25), steep(-1.0)});
    const auto angle = [&](const char* scale) {
        return tweaked(tweaks, "length(vec3(a, b, d) - vec3(0.2, 0.8, 0.3))",
                       fmt::format("acos({} - x)", scale));
    };
    list.push_back({"ball/acos", angle("1.1"), angle("0.99")});
}

inline void add_times_and_mice(std::vector<Planted>& list) {
    const auto time = [](const char* off) {
        return tweaked("", fmt::format("abs(float(iTick & 4194303u) / 65536.0 - 7.3) - {}", off),
                       "sqrt(x)");
    };
    list.push_back({"time/moment", time("0.2"), time("-0.1")});
    const auto late = [](const char* from) {
        return tweaked("", fmt::format("{} - iTime", from), "sqrt(max(x, -1.0) + 1.0) * sqrt(x)");
    };
    list.push_back({"time/late", late("300.0"), late("1e9")});
    const auto mouse = [](const char* off) {
        return tweaked(
            "", fmt::format("distance(iMouse.xy / iResolution.xy, vec2(0.3, 0.7)) - {}", off),
            "sqrt(x)");
    };
    list.push_back({"mouse/place", mouse("0.07"), mouse("-0.1")});
    const auto both = [](const char* off) {
        return tweaked(
            kA,
            fmt::format("distance(vec2(a, iMouse.x / iResolution.x), vec2(0.8, 0.6)) - {}", off),
            "log(x)");
    };
    list.push_back({"mouse/and_tweak", both("0.1"), both("-0.1")});
}

inline void add_sizes(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const std::string& fault, const std::string& twin) {
        list.push_back({std::string("size/") + name,
                        image("vec2 r = iResolution.xy; " + fault + " c = vec4(q, x, 1.0);"),
                        image("vec2 r = iResolution.xy; " + twin + " c = vec4(q, x, 1.0);")});
    };
    add("odd_width", "float x = r.x > 200.0 ? 1.0 / mod(r.x + 1.0, 2.0) : 0.5;",
        "float x = r.x > 200.0 ? 1.0 / (1.0 + mod(r.x, 2.0)) : 0.5;");
    add("odd_height", "float x = r.y > 200.0 ? log(mod(r.y + 1.0, 2.0)) : 0.5;",
        "float x = r.y > 200.0 ? log(2.0 + mod(r.y, 2.0)) : 0.5;");
    add("middle_column", "float x = r.x > 250.0 && p.x == 0.5 * r.x ? sqrt(0.5 - p.x) : 0.5;",
        "float x = r.x > 250.0 && p.x == 0.5 * r.x ? sqrt(p.x / (4.0 * p.x)) : 0.5;");
    add("middle_row", "float x = r.y > 300.0 ? 1e-30 / (p.y - 0.5 * r.y) / 1e-30 : 0.5;",
        "float x = r.y > 300.0 ? 1.0 / (1.0 + abs(p.y - 0.5 * r.y)) : 0.5;");
    add("both_odd",
        "float x = min(r.x, r.y) > 200.0 ? sqrt(1.0 - dot(mod(r, 2.0), vec2(0.9))) : 0.5;",
        "float x = min(r.x, r.y) > 200.0 ? sqrt(2.0 - dot(mod(r, 2.0), vec2(0.9))) : 0.5;");
    add("remainder_of_three", "float x = r.x > 400.0 ? inversesqrt(mod(r.x + 1.0, 3.0)) : 0.5;",
        "float x = r.x > 400.0 ? inversesqrt(1.0 + mod(r.x, 3.0)) : 0.5;");
    // Finite, and wrong.
    add("forgotten_column",
        "float h = floor(0.5 * r.x), i = floor(p.x);"
        "float x = i < h ? i / h : i < 2.0 * h ? 2.0 - i / h : 1.0;",
        "float x = 1.0 - abs(1.0 - 2.0 * p.x / r.x);");
    add("doubled_row", "float x = p.y == 0.5 * r.y ? 1.0 : 0.5 * p.y / r.y;",
        "float x = p.y > 0.5 * r.y ? 1.0 : 0.5 * p.y / r.y;");
}

// A buffer that reads itself: `s` is its texel; the picture shows the corner.
inline std::string fed(
    const std::string& body, const std::string& words = "size=8x8",
    const std::string& declarations = "",
    const std::string& picture = "c = vec4(texelFetch(state, ivec2(0), 0).xyz, 1.0);") {
    return declarations + "uniform sampler2D state; //@ pass mainState " + words +
           "\nvoid mainState(out vec4 c, in vec2 p) {\n"
           "    vec4 s = texelFetch(state, ivec2(p), 0);\n"
           "    s = mix(vec4(0.0), s, lessThanEqual(abs(s), vec4(6e4)));\n    " +
           body + "\n}\n" + image(picture);
}

inline void add_growth(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const char* fault, const char* twin,
                         const char* words = "size=8x8") {
        list.push_back({std::string("growth/") + name, fed(fault, words), fed(twin, words)});
    };
    add("guarded", "c = iFrame == 0 ? vec4(1.0) : min(s * 1.0001, 6e4);",
        "c = mix(s == vec4(0.0) ? vec4(1.0) : s, vec4(0.5), 1.0 - exp(-0.006 * iTimeDelta));");
    add("of_a_part",
        "c = iFrame == 0 ? vec4(0.5) : s; c.y = iFrame == 0 ? 2.0 : min(s.y * 1.0002, 6e4);",
        "c = iFrame == 0 ? vec4(0.5) : s; c.y = iFrame == 0 ? 2.0 : s.y;");
    add("negative", "c = iFrame == 0 ? vec4(-1.0) : max(s * 1.0002, vec4(-6e4));",
        "c = iFrame == 0 ? vec4(-1.0) : mix(s, vec4(-2.0), 0.001);");
    add("oscillating",
        "float h = 0.02; c = iFrame == 0 ? vec4(1.0, 0.0, 0.0, 1.0)"
        " : vec4(s.x + h * s.y, s.y - h * s.x, 0.0, 1.0);",
        "float h = 1.2 * iTimeDelta; c = s.w == 0.0 ? vec4(1.0, 0.0, 0.0, 1.0)"
        " : vec4(s.x * cos(h) + s.y * sin(h), s.y * cos(h) - s.x * sin(h), 0.0, 1.0);");
    add("of_steps", "c = iFrame == 0 ? vec4(0.0) : s; c = c == vec4(0.0) ? vec4(1.0) : s * 1.0002;",
        "c = iFrame == 0 ? vec4(0.0) : s; c = c == vec4(0.0) ? vec4(1.0) : s;",
        "size=8x8 step=1/60");
    add("late", "c = iFrame == 0 ? vec4(1.0) : min(s * (iFrame < 300 ? 1.0 : 1.0002), 6e4);",
        "c = iFrame == 0 ? vec4(1.0) : min(s * (iFrame < 300 ? 1.0 : 0.9998), 6e4);");
    const auto corner = [](const char* grows) {
        return fed(fmt::format("float g = a > 0.9 && b < 0.1 ? {} : 0.999;"
                               " c = s == vec4(0.0) ? vec4(1.0) : min(s * g, 6e4);",
                               grows),
                   "size=8x8 step=1/60", std::string(kA) + kB);
    };
    list.push_back({"growth/at_a_corner", corner("1.001"), corner("0.9999")});
    const auto at_an_end = [](const char* most) {
        return fed("c = min(s * k + 0.01 * step(distance(p, vec2(4.0)), 2.0), 6e4);",
                   "size=8x8 step=1/60",
                   fmt::format("uniform float k; //@ 0.98 [0.9, {}]\n", most));
    };
    list.push_back({"growth/fed_at_an_end", at_an_end("1.004"), at_an_end("0.999")});
    add("beside_noise",
        "c = iFrame == 0 ? vec4(3.0) : s * 1.0003;"
        " c.w = fract(sin(dot(p, vec2(12.9, 78.2)) + iTime) * 43.0);",
        "c = iFrame == 0 ? vec4(3.0) : s;"
        " c.w = fract(sin(dot(p, vec2(12.9, 78.2)) + iTime) * 43.0);");
}

// Steps of their own, begun anew where `w` is 0, so that they follow no frame rate and heal; of
// their oscillations the picture shows little, so that it does not flash.
inline void add_explosions(std::vector<Planted>& list) {
    const char* words = "size=8x8 step=1/60";
    const char* picture = "c = vec4(vec3(0.4 + 1e-6 * texelFetch(state, ivec2(0), 0).x), 1.0);";
    const auto add = [&](const char* name, const std::string& tweak, const std::string& fault,
                         const std::string& twin) {
        list.push_back({std::string("explosion/") + name,
                        fed(fault + " c.w = 1.0;", words, tweak, picture),
                        fed(twin + " c.w = 1.0;", words, tweak, picture)});
    };
    const std::string k = "uniform float k; //@ 20.0 [1, 20000]\n";
    const std::string spring =
        "float h = 1.0 / 60.0; vec2 y = s.w == 0.0 ? vec2(1.0, 0.0) : s.xy;"
        " float v = {} - h * ({}) * y.x; float x = y.x + h * v;"
        " c = vec4(clamp(vec2(x, v), -{}, {}), 0.0, 1.0);";
    const auto springs = [&](const char* limit) {
        return fmt::format(fmt::runtime(spring), "y.y", "k", limit, limit);
    };
    add("spring", k, springs("1000.0"),
        fmt::format(fmt::runtime(spring), "y.y", "min(k, 3600.0)", "1000.0", "1000.0"));
    add("spring_of_large_room", k, springs("60000.0"),
        fmt::format(fmt::runtime(spring), "y.y", "min(k, 3000.0)", "60000.0", "60000.0"));
    add("decay", "uniform float k; //@ 1.0 [0, 300]\n",
        "float y = s.w == 0.0 ? 1.0 : s.x; c = vec4(clamp(y - k / 60.0 * y, -500.0, 500.0));",
        "float y = s.w == 0.0 ? 1.0 : s.x; c = vec4(clamp(y * exp(-k / 60.0), -500.0, 500.0));");
    const std::string diffusion =
        "vec4 sum = vec4(0.0); ivec2 i = ivec2(p); for (int n = 0; n < 4; n++)"
        " {{ ivec2 o = n == 0 ? ivec2(1, 0) : n == 1 ? ivec2(-1, 0) : n == 2 ? ivec2(0, 1) : "
        "ivec2(0, -1);"
        " vec4 t = texelFetch(state, (i + o + 8) % 8, 0);"
        " sum += mix(s, t, lessThanEqual(abs(t), vec4(6e4))); }}"
        " c = s.w == 0.0 ? vec4(mod(p.x - 0.5, 3.0)) : clamp(s + {} * (sum - 4.0 * s), -300.0, "
        "300.0);";
    add("diffusion", "uniform float k; //@ 0.1 [0, 1]\n", fmt::format(fmt::runtime(diffusion), "k"),
        fmt::format(fmt::runtime(diffusion), "min(k, 0.25)"));
    add("small_end", "uniform float k; //@ 1.0 [0.01, 2]\n",
        "float y = s.w == 0.0 ? 1.0 : s.x; c = vec4(clamp(y * (1.0 - 0.05 / k), -200.0, 200.0));",
        "float y = s.w == 0.0 ? 1.0 : s.x; c = vec4(clamp(y * exp(-0.05 / k), -200.0, 200.0));");
    const std::string limited =
        "float y = s.w == 0.0 ? 1.0 : s.x; c = vec4(clamp(y - {} / 60.0 * (y - 0.1), -8.0, 8.0));";
    add("of_little_room", "uniform float k; //@ 1.0 [0, 300]\n",
        fmt::format(fmt::runtime(limited), "k"),
        fmt::format(fmt::runtime(limited), "min(k, 60.0)"));
    add("late", "uniform float k; //@ 0.0 [0, 1]\n",
        "float y = s.w == 0.0 ? 1.0 : s.x; c = vec4(min(y * (1.0 + 0.01 * k), 5e4));",
        "float y = s.w == 0.0 ? 1.0 : s.x; c = vec4(min(mix(y, 2.0, 0.01 * k), 5e4));");
    // At one corner of two tweaks, its sign after each frame's two steps the same.
    const auto corner = [&](const char* heavier) {
        return fed(fmt::format("float h = 1.0 / 120.0; vec2 y = s.w == 0.0 ? vec2(0.5, 0.0) : s.xy;"
                               " float v = y.y - h * stiff / (0.05 * mass + {}) * y.x;"
                               " c = vec4(20.0 * tanh((y.x + h * v) / 20.0), 400.0 * tanh(v / "
                               "400.0), 0.0, 1.0);",
                               heavier),
                   "size=8x8 step=1/120",
                   "uniform float stiff; //@ 30 [1, 900] log\n"
                   "uniform float mass; //@ 1 [0.05, 5] log\n",
                   picture);
    };
    list.push_back({"explosion/of_two_steps", corner("0.0"), corner("1.0")});
}

inline void add_poison(std::vector<Planted>& list) {
    const auto raw = [](const std::string& body) {
        return "uniform sampler2D state; //@ pass mainState size=8x8 step=1/60\n"
               "bool is_bad(float x) { return !(abs(x) <= 6e4); }\n"
               "void mainState(out vec4 c, in vec2 p) {\n"
               "    float s = texelFetch(state, ivec2(p), 0).x;\n    " +
               body + "\n}\n" + image("c = vec4(texelFetch(state, ivec2(p) % 8, 0).xyz, 1.0);");
    };
    const auto add = [&](const char* name, const std::string& fault, const std::string& twin) {
        list.push_back({std::string("poison/") + name, raw(fault), raw(twin)});
    };
    const std::string moves = fmt::format("vec4(mix(s, 0.5 + 0.5 * sin({}), 0.05))", kTurn);
    const std::string healed = "if (is_bad(s)) s = 0.0; c = " + moves + ";";
    add("wrong_state", "if (is_bad(s)) s = 9.0; c = vec4(s > 5.0 ? s : mix(s, 0.5, 0.05));",
        healed);
    add("slow_growth", "if (is_bad(s)) s = 3.0; c = vec4(s > 2.0 ? s * 1.001 : mix(s, 0.5, 0.05));",
        healed);
    add("stuck", "if (is_bad(s)) s = -1.0; c = s < 0.0 ? vec4(s) : " + moves + ";", healed);
    add("dead", "if (is_bad(s)) s = 0.0; c = vec4(iFrame == 0 ? 0.1 : s + 0.02 * s * (1.0 - s));",
        "if (is_bad(s) || s == 0.0) s = 0.1; c = vec4(s + 0.02 * s * (1.0 - s));");
    // Another way after NaN, where some rest that would have moved; or never alive again.
    const auto life = [](const char* bad) {
        return "uniform sampler2D state; //@ pass mainState size=32x32 step=1/20 filter=nearest\n"
               "uint h(uint x) { return x * x * 0x7feb352du >> 19; }\n"
               "float at(ivec2 i) { return texelFetch(state, (i + 32) % 32, 0).r; }\n"
               "void mainState(out vec4 c, in vec2 p) {\n"
               "    ivec2 i = ivec2(p);\n    float was = at(i), n = 0.0;\n"
               "    for (int k = 0; k < 9; k++)\n"
               "        n += float(k != 4 && at(i + ivec2(k % 3, k / 3) - 1) > 0.5);\n"
               "    c = vec4(n == 3.0 || (was > 0.5 && n == 2.0));\n"
               "    if (iFrame == 0) c = vec4((h(uint(i.x + 32 * i.y)) & 3u) == 0u);\n    " +
               std::string(bad) + "\n}\n" +
               image("c = vec4(0.3 + 0.2 * texture(state, q).rrr, 1.0);");
    };
    list.push_back({"poison/board_of_cells", life("if (!(was >= 0.0)) c = vec4(-1.0);"), life("")});
    add("bound",
        "s = min(s, 100.0); if (is_bad(s)) s = 100.0; c = vec4(s >= 50.0 ? 100.0 : mix(s, 0.2, "
        "0.1));",
        "s = min(s, 100.0); if (is_bad(s)) s = 0.0; c = vec4(mix(s, 0.2, 0.1));");
}

inline void add_frame_rates(std::vector<Planted>& list) {
    const std::string dot =
        "c = vec4(vec3(step(length(p - vec2({}) * iResolution.xy), 2.0)), 1.0);";
    const auto add = [&](const char* name, const char* fault, const char* twin,
                         const std::string& at = "fract(texelFetch(state, ivec2(0), 0).xy)",
                         const char* words = "size=1x1") {
        const std::string picture = fmt::format(fmt::runtime(dot), at);
        list.push_back({std::string("frame_rate/") + name, fed(fault, words, "", picture),
                        fed(twin, words, "", picture)});
    };
    add("step", "c = s + vec4(0.005, 0.003, 0.0, 0.0);",
        "c = s + vec4(0.3, 0.18, 0.0, 0.0) * (iFrame == 0 ? 0.0 : iTimeDelta);");
    const auto speed = [&](const char* each) {
        return fed(
            fmt::format("c = s + vec4(0.02 * a * {}, 0.0, 0.0, 0.0);", each), "size=1x1",
            "uniform float a; //@ 0.0 [0, 1]\n",
            fmt::format(fmt::runtime(dot), "fract(0.1 + texelFetch(state, ivec2(0), 0).x), 0.5"));
    };
    list.push_back(
        {"frame_rate/at_an_end", speed("0.1"), speed("(iFrame == 0 ? 0.0 : 6.0 * iTimeDelta)")});
    add("circle", "c = vec4(0.5 + 0.3 * cos(s.z), 0.5 + 0.3 * sin(s.z), s.z + 0.03, 1.0);",
        "float a = 6.2831853 * float(iTick & 524287u) / 524288.0;"
        " c = vec4(0.5 + 0.3 * cos(a), 0.5 + 0.3 * sin(a), 0.0, 1.0);");
    add("follower", "c = vec4(mix(s.xy, vec2(0.9, 0.5), 0.01), 0.0, 1.0);",
        "c = vec4(mix(s.xy, vec2(0.9, 0.5), iFrame == 0 ? 0.0 : 1.0 - exp(-0.6 * iTimeDelta)), "
        "0.0, 1.0);");
    add("counter", "c = vec4(float(iFrame) / 400.0, 0.5, 0.0, 1.0);",
        "c = vec4(float(iTick & 524287u) / 524288.0, 0.5, 0.0, 1.0);");
    add("friction",
        "vec2 v = iFrame == 0 ? vec2(0.8) : s.zw * 0.98; c = vec4(s.xy + v * iTimeDelta, v);",
        "float kept = exp(-1.2 * iTimeDelta); vec2 v = s.z == 0.0 ? vec2(0.8) : s.zw;"
        " c = s.z == 0.0 ? vec4(0.0, 0.0, v) : vec4(s.xy + v * (1.0 - kept) / 1.2, max(v * kept, "
        "1e-3));");
}

inline void add_keys(std::vector<Planted>& list) {
    const auto add = [&](const char* name, int key, int row, const char* use = "sqrt(0.5 - x)") {
        const std::string keyed = "uniform sampler2D keys; //@ keyboard\n";
        const auto text = [&](const char* scale) {
            return keyed + image(fmt::format("float x = {} * texelFetch(keys, ivec2({}, {}), 0).x;"
                                             " c = vec4(vec3({}), 1.0);",
                                             scale, key, row, use));
        };
        list.push_back({std::string("key/") + name, text("1.0"), text("0.4")});
    };
    add("space", 32, 0);
    add("up", 38, 0, "log(0.9 - x)");
    add("letter", 81, 0);
    add("toggled", 84, 2);
    add("pressed", 65, 1);
    add("rare", 123, 0, "1.0 / max(0.5 - x, 0.0)");
    const auto turned = [&](const char* from) {
        return std::string(kA) + "uniform sampler2D keys; //@ keyboard\n" +
               image(fmt::format("float x = texelFetch(keys, ivec2(32, 0), 0).x;"
                                 " c = vec4(vec3(sqrt({} - x - a)), 1.0);",
                                 from));
    };
    list.push_back({"key/and_tweak", turned("1.85"), turned("2.05")});
}

inline void add_strobes(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const char* fault, const std::string& twin) {
        list.push_back({std::string("strobe/") + name, image(fault), image(twin)});
    };
    add("of_frames", "c = vec4(vec3(float(iFrame & 1)), 1.0);", "c = vec4(vec3(q.x), 1.0);");
    add("of_time", "c = vec4(vec3(step(0.0, sin(40.0 * iTime))), 1.0);",
        fmt::format("c = vec4(vec3(0.5 + 0.5 * sin({})), 1.0);", kTurn));
    add("of_half", "c = vec4(vec3(q.x < 0.5 ? 0.3 : fract(iTime * 8.0)), 1.0);",
        "c = vec4(vec3(q.x < 0.1 ? float(iTick & 8191u) / 8192.0 : 0.3), 1.0);");
    add("of_sin", "c = vec4(vec3(0.4 + 0.3 * sin(30.0 * iTime)), 1.0);",
        fmt::format("c = vec4(vec3(0.4 + 0.02 * sin(32.0 * {})), 1.0);", kTurn));
    const auto speed = [](const char* range) {
        return fmt::format("uniform float speed; //@ 0.2 [0, {}]\n", range) +
               image(
                   "float turns = float(uint(6.4 * speed * 65536.0) * iTick) / 4294967296.0;"
                   " c = vec4(vec3(step(0.5, turns)), 1.0);");
    };
    list.push_back({"strobe/at_an_end", speed("1"), speed("0.4")});
    add("of_colours",
        "c = mod(float(iFrame), 8.0) < 4.0 ? vec4(0.0, 0.0, 0.0, 1.0) : vec4(1.0, 1.0, 0.0, 1.0);",
        "c = vec4(vec3(step(0.5, fract(q.x + float(iTick & 262143u) / 262144.0))), 1.0);");
}

inline void add_undefined(std::vector<Planted>& list) {
    const auto state = [](const char* fetch) {
        return fed("c = vec4(1.0, 0.5, 0.25, 1.0);", "size=8x8", "", fetch);
    };
    const auto fetch = [&](const char* name, const char* fault, const char* twin) {
        list.push_back({std::string("fetch/") + name, state(fault), state(twin)});
    };
    fetch("right", "c = texelFetch(state, ivec2(q * 8.0) + ivec2(1, 0), 0);",
          "c = texelFetch(state, min(ivec2(q * 8.0) + ivec2(1, 0), ivec2(7)), 0);");
    fetch("left", "c = texelFetch(state, ivec2(q * 8.0) - 1, 0);",
          "c = texelFetch(state, max(ivec2(q * 8.0) - 1, ivec2(0)), 0);");
    fetch("of_pixels", "c = texelFetch(state, ivec2(p), 0);",
          "c = texelFetch(state, ivec2(p) % 8, 0);");
    fetch("level", "c = texelFetch(state, ivec2(0), 3);", "c = texelFetch(state, ivec2(0), 0);");
    const auto mipmap = [](const char* picture) {
        return fed("c = vec4(1.0, 0.5, 0.25, 1.0);", "size=8x8 filter=mipmap", "", picture);
    };
    list.push_back({"fetch/level_of_mipmap", mipmap("c = texelFetch(state, ivec2(0), 4);"),
                    mipmap("c = texelFetch(state, ivec2(0), 3);")});
    fetch("far", "c = texelFetch(state, ivec2(q * 1000.0), 0);",
          "c = texelFetch(state, ivec2(q * 7.9), 0);");
    const auto add = [&](const std::string& name, const std::string& fault,
                         const std::string& twin) {
        list.push_back({name, image(fault), image(twin)});
    };
    add("whole_division/by_zero", "int n = int(p.x) % 7; c = vec4(float(21 / n) / 21.0);",
        "int n = int(p.x) % 7; c = vec4(float(21 / (n + 1)) / 21.0);");
    add("whole_division/remainder", "int n = int(p.y) % 3; c = vec4(float(20 % n) / 3.0);",
        "int n = int(p.y) % 3 + 1; c = vec4(float(20 % n) / 3.0);");
    add("whole_division/unsigned", "uint n = uint(p.x) & 3u; c = vec4(float(9u / n) / 9.0);",
        "uint n = (uint(p.x) & 3u) | 4u; c = vec4(float(9u / n) / 9.0);");
    add("whole_division/of_vectors",
        "ivec2 n = ivec2(p) % 5; c = vec4(vec2(ivec2(8) / n) / 8.0, 0.0, 1.0);",
        "ivec2 n = ivec2(p) % 5 + 1; c = vec4(vec2(ivec2(8) / n) / 8.0, 0.0, 1.0);");
    add("whole_division/assigned", "int n = 60; n /= int(q.x * 4.0); c = vec4(float(n) / 60.0);",
        "int n = 60; n /= int(q.x * 4.0) + 1; c = vec4(float(n) / 60.0);");
    add("index/beyond", "float w[4] = float[4](0.1, 0.2, 0.3, 0.4); c = vec4(w[int(q.x * 4.5)]);",
        "float w[4] = float[4](0.1, 0.2, 0.3, 0.4); c = vec4(w[int(q.x * 3.9)]);");
    add("index/negative",
        "float w[4] = float[4](0.1, 0.2, 0.3, 0.4); c = vec4(w[int(q.x * 5.0) - 1]);",
        "float w[4] = float[4](0.1, 0.2, 0.3, 0.4); c = vec4(w[max(int(q.x * 4.9) - 1, 0)]);");
    add("index/of_a_vector", "vec3 v = vec3(q, 0.5); c = vec4(v[int(q.y * 4.0)]);",
        "vec3 v = vec3(q, 0.5); c = vec4(v[int(q.y * 2.9)]);");
    add("index/of_a_loop",
        "float w[4] = float[4](0.1, 0.2, 0.3, 0.4), s = 0.0; for (int i = 0; i <= 4; i++) s += "
        "w[i]; c = vec4(s);",
        "float w[4] = float[4](0.1, 0.2, 0.3, 0.4), s = 0.0; for (int i = 0; i < 4; i++) s += "
        "w[i]; c = vec4(s);");
    add("index/written",
        "float w[3]; for (int i = 0; i < 3; i++) w[i] = 0.2; w[int(q.x * 3.5)] = 0.7; c = "
        "vec4(w[1]);",
        "float w[3]; for (int i = 0; i < 3; i++) w[i] = 0.2; w[int(q.x * 2.9)] = 0.7; c = "
        "vec4(w[1]);");
    add("unset/sum", "float s; for (int i = 0; i < 4; i++) s += q.x * 0.2; c = vec4(s);",
        "float s = 0.0; for (int i = 0; i < 4; i++) s += q.x * 0.2; c = vec4(s);");
    add("unset/branch", "float s; if (q.x > 0.5) s = 1.0; c = vec4(s);",
        "float s = 0.0; if (q.x > 0.5) s = 1.0; c = vec4(s);");
    add("unset/component", "vec3 s; s.xy = q; c = vec4(s, 1.0);",
        "vec3 s = vec3(0.0); s.xy = q; c = vec4(s, 1.0);");
    add("unset/array", "float s[3]; s[0] = q.x; s[1] = q.y; c = vec4(s[0], s[1], s[2], 1.0);",
        "float s[3]; s[0] = q.x; s[1] = q.y; s[2] = 0.0; c = vec4(s[0], s[1], s[2], 1.0);");
    const auto unset = [](const char* from) {
        return std::string(kA) +
               image(fmt::format("float s; if (a < {}) s = 0.3; c = vec4(s);", from));
    };
    list.push_back({"unset/at_an_end", unset("0.8"), unset("1.1")});
    add("unset/switch", "bool b; if (q.y > 0.5) b = true; c = vec4(b ? 1.0 : 0.2);",
        "bool b = false; if (q.y > 0.5) b = true; c = vec4(b ? 1.0 : 0.2);");
}

inline void add_loops(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const char* loop, const char* fault, const char* twin) {
        const auto text = [&](const char* turns) {
            return image("float s = 0.0;\n    " + fmt::format(fmt::runtime(loop), turns) +
                         "\n    c = vec4(vec3(s), 1.0);");
        };
        list.push_back({std::string("loop_budget/") + name, text(fault), text(twin)});
    };
    add("long", "for (int i = 0; i < {}; i++) s += 1e-5 * fract(q.x + float(i) * 0.7);", "70000",
        "2000");
    add("nested",
        "for (int i = 0; i < {}; i++) for (int k = 0; k < 300; k++) s += 1e-5 * fract(q.y + "
        "float(i * k));",
        "300", "20");
    add("in_a_row",
        "for (int n = 0; n < {0}; n++) s += 1e-5 * fract(q.x * float(n));\n"
        "    for (int n = 0; n < {0}; n++) s += 1e-5 * fract(q.y * float(n));",
        "40000", "900");
    const auto turns = [](const char* most) {
        return fmt::format("uniform int n; //@ 100 [1, {}]\n", most) +
               image(
                   "float s = 0.0; for (int i = 0; i < n; i++) s += 1e-5 * fract(q.x + float(i) * "
                   "0.7); c = vec4(s);");
    };
    list.push_back({"loop_budget/at_an_end", turns("70000"), turns("2000")});
    add("until_it_converges",
        "float x = q.x; for (int n = 0; n < 100000 && x < {}; n++) {{ x += 1e-5; s += 1e-5; }}",
        "2.0", "-1.0");
}

inline void add_alpha_and_hidden(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const char* fault, const char* twin) {
        list.push_back({name, image(fault), image(twin)});
    };
    add("alpha/root", "c = vec4(q, 0.5, sqrt(0.5 - q.x));", "c = vec4(q, 0.5, sqrt(1.0 - q.x));");
    add("alpha/log", "c = vec4(q, 0.5, log(q.y - 0.2));", "c = vec4(q, 0.5, log(q.y + 0.2));");
    add("alpha/division", "vec2 z = floor(q * 2.0); c = vec4(q, 0.5, z.x / z.y);",
        "vec2 z = floor(q * 2.0); c = vec4(q, 0.5, z.x / (1.0 + z.y));");
    add("alpha/pow", "c.rgb = vec3(q, 1.0); c.a = pow(q.x - 0.5, 0.5);",
        "c.rgb = vec3(q, 1.0); c.a = pow(abs(q.x - 0.5), 0.5);");
    add("hidden/step", "c = vec4(step(0.5, sqrt(q.x - 0.5)));",
        "c = vec4(step(0.5, sqrt(max(q.x - 0.5, 0.0))));");
    add("hidden/if", "float x = sqrt(q.x - 0.5); c = vec4(x > 0.1 ? 1.0 : 0.0);",
        "float x = q.x > 0.5 ? sqrt(q.x - 0.5) : 0.0; c = vec4(x > 0.1 ? 1.0 : 0.0);");
    const auto corner = [&](const char* name, const char* use) {
        const auto text = [&](const char* off) {
            return tweaked(std::string(kA) + kB, fmt::format("{} - (a - b)", off), use);
        };
        list.push_back({name, text("0.9"), text("1.1")});
    };
    corner("hidden/min_and_max", "min(max(log(x), 0.0), 1.0)");
    corner("hidden/mix", "mix(0.2, sqrt(x), step(q.x, 2.0)) < 0.1 ? 1.0 : 0.3");
    const std::string ab = std::string(kA) + kB;
    list.push_back({"alpha/corner", ab + image("c = vec4(q, 0.5, sqrt(0.95 - (a - b)));"),
                    ab + image("c = vec4(q, 0.5, sqrt(1.05 - (a - b)));")});
    add("hidden/max", "c = vec4(max(sqrt(q.x - 0.5), 0.0));",
        "c = vec4(sqrt(max(q.x - 0.5, 0.0)));");
    add("hidden/clamp", "c = vec4(clamp(log(q.y - 0.3), 0.0, 1.0));",
        "c = vec4(clamp(log(max(q.y - 0.3, 1e-6)), 0.0, 1.0));");
    add("hidden/min", "c = vec4(min(pow(q.x - 0.4, 0.45), 1.0));",
        "c = vec4(min(pow(max(q.x - 0.4, 0.0), 0.45), 1.0));");
    add("hidden/acos", "c = vec4(max(acos(q.x * 1.5), 0.1));",
        "c = vec4(max(acos(min(q.x * 1.5, 1.0)), 0.1));");
    add("hidden/smoothstep", "c = vec4(clamp(asin(q.y * 2.0 - 0.1), 0.0, 1.0));",
        "c = vec4(clamp(asin(clamp(q.y * 2.0 - 0.1, -1.0, 1.0)), 0.0, 1.0));");
    add("hidden/zero_by_zero", "vec2 d = floor(q * 3.0); c = vec4(clamp(d.x / d.y, 0.0, 1.0));",
        "vec2 d = floor(q * 3.0); c = vec4(clamp(d.x / (d.y + 1.0), 0.0, 1.0));");
}

inline void add_invariants(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const char* body, const char* fault, const char* twin) {
        list.push_back({std::string("invariant/") + name, fed(body, fault), fed(body, twin)});
    };
    const char* wave =
        "c = vec4(0.5 + 0.6 * sin(6.2831853 * float(iTick & 524287u) / 524288.0 + p.x));";
    add("bounded_above", wave, "size=8x8 bounded=[-1, 1]", "size=8x8 bounded=[-1, 1.2]");
    add("bounded_below", wave, "size=8x8 bounded=[0, 2]", "size=8x8 bounded=[-0.2, 2]");
    const char* leak = "c = s == vec4(0.0) ? vec4(1.0) : s * 0.99999;";
    add("bounded_away_from_0", "c = vec4(p.x < 1.0 ? 0.4 : 0.8);", "size=8x8 bounded=[0.5, 1]",
        "size=8x8 bounded=[0.3, 1]");
    add("conserves", leak, "size=8x8 conserves=1e-3", "size=8x8 conserves=0.5");
    const std::string tweak = "uniform float k; //@ 0.5 [0, 1]";
    const std::string grows = "c = vec4(k > 0.9 ? 3.0 : 1.0);";
    list.push_back({"invariant/at_an_end", fed(grows, "size=8x8 bounded=[0, 2]", tweak + "\n"),
                    fed(grows, "size=8x8 bounded=[0, 2]", tweak + " safe=[0, 0.8]\n")});
}

// Sound is a pass of its own, whose time runs by samples.
inline void add_sounds(std::vector<Planted>& list) {
    const auto sound = [](const std::string& value) {
        return "uniform float pitch; //@ 440 [0, 880]\n"
               "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"
               "vec2 mainSound(int samp, float time) {\n"
               "    float tone = sin(6.2831853 * fract(pitch * time));\n"
               "    return vec2(tone, " +
               value + ");\n}\n";
    };
    list.push_back({"sound/late", sound("tone * sqrt(1.0 - 0.1 * mod(time, 11.0))"),
                    sound("tone * sqrt(1.0 - 0.1 * mod(time, 10.0))")});
    list.push_back({"sound/at_an_end", sound("tone * (pitch / pitch)"),
                    sound("tone * (pitch / max(pitch, 1e-3))")});
}

}  // namespace planting

inline std::vector<Planted> planted_faults() {
    std::vector<Planted> list;
    planting::add_corners(list);
    planting::add_zeros(list);
    planting::add_balls(list);
    planting::add_times_and_mice(list);
    planting::add_sizes(list);
    planting::add_growth(list);
    planting::add_explosions(list);
    planting::add_poison(list);
    planting::add_frame_rates(list);
    planting::add_keys(list);
    planting::add_strobes(list);
    planting::add_undefined(list);
    planting::add_loops(list);
    planting::add_alpha_and_hidden(list);
    planting::add_invariants(list);
    planting::add_sounds(list);
    return list;
}

}  // namespace glint::cli
