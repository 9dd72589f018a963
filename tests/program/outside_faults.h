// More faults that `glint check` has to find, as those who did not write it would plant them.
#pragma once

#include "planted_faults.h"

namespace glint::cli {

namespace planting {

// What GLSL leaves open without a NaN in sight: one driver says this, another that.
inline void add_open(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const std::string& tweaks, const char* fault,
                         const char* twin) {
        list.push_back({std::string("open/") + name, tweaks + image(fault), tweaks + image(twin)});
    };
    add("negative_to_unsigned", "",
        "uint n = uint(q.x * 10.0 - 3.0); c = vec4(float(n & 7u) / 8.0);",
        "uint n = uint(q.x * 10.0); c = vec4(float(n & 7u) / 8.0);");
    add("too_large_for_int", "", "ivec2 n = ivec2(q * 1e10); c = vec4(float(n.x & 255) / 256.0);",
        "ivec2 n = ivec2(q * 1e9); c = vec4(float(n.x & 255) / 256.0);");
    add("shift", "", "int n = int(q.x * 40.0); c = vec4(float((3 << n) >> 5 & 255) / 256.0);",
        "int n = int(q.x * 30.0); c = vec4(float((3 << n) >> 5 & 255) / 256.0);");
    add("equal_edges", kA, "c = vec4(smoothstep(0.5078125 - a, 0.5078125 + a, q.x));",
        "c = vec4(smoothstep(0.5 - a, 0.51 + a, q.x));");
    const std::string ab = "uniform float a; //@ 0.2 [0, 1]\nuniform float b; //@ 0.8 [0, 1]\n";
    add("reversed_clamp", ab, "c = vec4(clamp(q.x, a, b));",
        "c = vec4(clamp(q.x, min(a, b), max(a, b)));");
    add("reversed_clamp_of_whole_numbers", "uniform int n; //@ 3 [0, 9]\n",
        "c = vec4(float(clamp(int(p.x) % 7, 2, n)) / 9.0);",
        "c = vec4(float(clamp(int(p.x) % 7, min(2, n), n)) / 9.0);");
    add("angle_of_nothing", "",
        "vec2 d = floor(q * 3.0) - 1.0; c = vec4(0.5 + atan(d.y, d.x) / 6.3);",
        "vec2 d = floor(q * 3.0) - 1.0; c = vec4(d == vec2(0.0) ? 0.5 : 0.5 + atan(d.y, d.x) / "
        "6.3);");
    add("zero_to_the_zero", kA, "c = vec4(pow(floor(q.x * 2.0), a));",
        "c = vec4(pow(floor(q.x * 2.0), a + 0.01));");
    const std::string of = "uniform float a; //@ 0.9 [0, 1]\nuniform float b; //@ 0.1 [0, 1]\n";
    add("inverse", of,
        "mat2 m = inverse(mat2(a, b, b, a)); c = vec4(clamp(m * q, 0.0, 1.0), 0.0, 1.0);",
        "mat2 m = inverse(mat2(a + 1.1, b, b, a + 1.1)); c = vec4(clamp(m * q, 0.0, 1.0), 0.0, "
        "1.0);");
}

// What an outsider would think of: each at a place where few look.
inline void add_far_places(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const std::string& head, const std::string& fault,
                         const std::string& twin) {
        list.push_back({std::string("far/") + name, head + image(fault), head + image(twin)});
    };
    const auto keys = [](const char* kept) {
        return fmt::format(
            "float k = texelFetch(keys, ivec2(37, 0), 0).x * texelFetch(keys, ivec2(32, 0), 0).x "
            "* step(20.0, iTime); c = vec4(q, sqrt({} - k), 1.0);",
            kept);
    };
    add("keys_and_time", "uniform sampler2D keys; //@ keyboard\n", keys("0.5"), keys("1.5"));
    const auto minute = [](const char* off) {
        return fmt::format(
            "c = vec4(q, min(sqrt(abs(float(iTick >> 16) - 150.0) - {}), 1.0), 1.0);", off);
    };
    add("third_minute", "", minute("20.0"), minute("0.0"));
    const auto drag = [](const char* most) {
        return fmt::format(
            "vec2 d = (iMouse.xy - abs(iMouse.zw)) / iResolution.xy;"
            " c = vec4(q, iMouse.z > 0.0 ? sqrt({} - length(d)) : 0.5, 1.0);",
            most);
    };
    add("drag", "", drag("0.3"), drag("9.0"));
    const auto released = [](const char* sign) {
        return fmt::format(
            "c = vec4(q, iMouse.z < 0.0 ? sqrt(9.0 {} (iMouse.x / iResolution.x + "
            "8.5)) : 0.5, 1.0);",
            sign);
    };
    add("released", "", released("-"), released("+"));
    const std::string far = std::string(kA) + "uniform float far; //@ 1.0 [0.1, 3000] log\n";
    add("cancelling", far,
        "c = vec4(q, sqrt((far + a) * (far + a) - far * far - 2.0 * far * a), 1.0);",
        "c = vec4(q, a, 1.0);");
    const auto endless = [](const char* step) {
        return fmt::format(
            "float t = 0.0; for (int i = 0; t < 1.0; i++) t += 0.1 * {}; c = vec4(0.3 * t);", step);
    };
    add("endless_loop", kA, endless("a"), endless("max(a, 0.01)"));
    const auto unit = [](const char* cosine) {
        return fmt::format("vec3 n = normalize(vec3(q, 0.3)); c = vec4(acos({}));", cosine);
    };
    add("beyond_one_by_rounding", "", unit("dot(n, n)"), unit("min(dot(n, n), 1.0)"));
    add("midnight", "", "c = vec4(q, 0.2 + 0.05 * log(iDate.w), 1.0);",
        "c = vec4(q, 0.2 + 0.05 * log(iDate.w + 1.0), 1.0);");
    const auto mirror = [](const char* width) {
        return fmt::format(
            "uniform sampler2D state; //@ pass mainState\n"
            "void mainState(out vec4 c, in vec2 p) {{ c = vec4(p / iResolution.xy, 0.5, 1.0); }}\n"
            "void mainImage(out vec4 c, in vec2 p) {{\n    ivec2 n = ivec2(iResolution.xy);\n"
            "    c = texelFetch(state, {} - 1 - ivec2(p), 0);\n}}\n",
            width);
    };
    list.push_back({"far/mirror_at_odd_sizes", mirror("(n + 1) / 2 * 2"), mirror("n")});
    const auto helper = [](const char* x) {
        return fmt::format(
            "uniform float a; //@ 0.5 [0, 1]\n"
            "uniform sampler2D state; //@ pass mainState size=16x16\n"
            "float shaped(float x) {{ return pow({}, 0.7); }}\n"
            "void mainState(out vec4 c, in vec2 p) {{\n"
            "    c = vec4(clamp(shaped(0.97 - a * p.x / 15.5), 0.0, 1.0));\n}}\n"
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    c = texelFetch(state, ivec2(p) % 16, 0) * shaped(p.x / iResolution.x);\n}}\n",
            x);
    };
    list.push_back({"far/helper_of_two_passes", helper("x"), helper("max(x, 0.0)")});
    const auto handed_out = [](const char* first) {
        return fmt::format("void paint(float x, out float y) {{ {}if (x > 0.7) y = x; }}\n",
                           first) +
               image("float y; paint(q.x, y); c = vec4(y);");
    };
    list.push_back({"far/out_parameter", handed_out(""), handed_out("y = 0.0; ")});
    const std::string menu = "uniform int mode; //@ 0 {calm, disco, dawn}\n";
    const auto disco = [](const char* rate) {
        return fmt::format(
            "c = vec4(mode == 1 ? step(0.5, fract(float(iTick & 65535u) / 65536.0 * {})) : 0.3);",
            rate);
    };
    add("flashes_within_a_menu", menu, disco("8.0"), disco("1.0"));
    const auto unset = [](const char* first) {
        return fmt::format("float s{}; if (mode != 1) s = q.x; c = vec4(s);", first);
    };
    add("unset_within_a_menu", menu, unset(""), unset(" = 0.0"));
    const auto half = [](const char* light) {
        return fmt::format(
            "uniform float a; //@ 0.5 [0, 1]\n"
            "uniform sampler2D glow; //@ pass mainGlow format=rgba16f\n"
            "void mainGlow(out vec4 c, in vec2 p) {{ c = vec4({}); }}\n"
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    c = min(texelFetch(glow, ivec2(p), 0), 1.0);\n}}\n",
            light);
    };
    list.push_back({"far/half_float", half("a * 8e4"), half("min(a * 8e4, 65504.0)")});
    const auto pole = [&](const char* divisor) {
        return std::string(kA) + "uniform float b; //@ 0.2 [-3, 7]\n" +
               image(fmt::format("c = vec4(q, 0.5 + 0.001 / ({}), 1.0);", divisor));
    };
    list.push_back({"far/pole_of_a_round_number", pole("b - 1.843"), pole("b + 3.157")});
    list.push_back({"far/pole_of_two", pole("0.37 - b - 2.0 * a"), pole("3.37 + b + 2.0 * a")});
    const auto bytes = [](const char* fade) {
        return fed(fmt::format("c = max({}, vec4(iTime < 0.5));", fade),
                   "size=8x8 format=rgba8 step=1/60");
    };
    list.push_back({"far/trail_of_bytes", bytes("s * 0.99"), bytes("s - 1.0 / 255.0")});
    list.push_back({"far/growth_of_a_twentieth_per_mille",
                    fed("c = s.w == 0.0 ? vec4(1.0) : min(s * 1.00005, 6e4);"),
                    fed("c = s.w == 0.0 ? vec4(1.0) : s;")});
}

// What a person brings it to: the mouse, a key, patience, or a value within a range.
inline void add_situations(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const std::string& tweaks, const std::string& fault,
                         const std::string& twin) {
        list.push_back(
            {std::string("situation/") + name, tweaks + image(fault), tweaks + image(twin)});
    };
    const auto unset = [](const char* first, const char* where) {
        return fmt::format("float x{}; if ({}) x = 0.5; c = vec4(0.7 * x);", first, where);
    };
    add("unset_with_the_mouse", "", unset("", "iMouse.z <= 0.0"),
        unset(" = 0.2", "iMouse.z <= 0.0"));
    add("unset_late", "", unset("", "iTime < 50.0"), unset(" = 0.2", "iTime < 50.0"));
    add("unset_within_a_range", kA, unset("", "a < 0.6 || a > 0.85"),
        unset(" = 0.2", "a < 0.6 || a > 0.85"));
    const auto flash = [](const char* when, const char* rate) {
        return fmt::format("c = vec4({} ? step(0.5, fract({} * iTime)) : 0.5);", when, rate);
    };
    add("flash_with_the_mouse", "", flash("iMouse.z > 0.0", "10.0"),
        flash("iMouse.z > 0.0", "1.0"));
    add("flash_late", "", flash("iTime > 90.0", "10.0"), flash("iTime > 90.0", "1.0"));
    const auto loop = [](const char* turns) {
        return fmt::format(
            "float s = 0.0; for (int i = 0; i < {}; i++) s += 1e-5 * fract(q.x * "
            "float(i)); c = vec4(s);",
            turns);
    };
    add("loop_late", "", loop("100 + 1000 * int(iTime)"), loop("100 + 10 * int(min(iTime, 9.0))"));
    add("loop_within_a_range", kA, loop("(a > 0.6 && a < 0.85 ? 70000 : 100)"),
        loop("(a > 0.6 && a < 0.85 ? 700 : 100)"));
    add("assertion_within_a_range", kA, "//@ assert abs(a - 0.7) > 0.1\n    c = vec4(a);",
        "//@ assert abs(a - 0.7) < 0.8\n    c = vec4(a);");
    const auto driven = [](const char* held, const char* step) {
        return fmt::format(
            "uniform sampler2D keys; //@ keyboard\n"
            "uniform sampler2D kept; //@ pass mainKept size=4x4 format=rgba32f\n"
            "void mainKept(out vec4 c, in vec2 p) {{\n"
            "    vec4 s = texelFetch(kept, ivec2(0), 0);\n"
            "    s = mix(vec4(0), s, lessThanEqual(abs(s), vec4(1)));\n"
            "    c = {} ? fract(s + {}) : s;\n}}\n{}",
            held, step, image("c = vec4(step(abs(q.x - texelFetch(kept, ivec2(0), 0).x), 0.1));"));
    };
    const char* const mouse = "iMouse.z > 0.0";
    const char* const key = "texelFetch(keys, ivec2(39, 0), 0).x > 0.5";
    list.push_back({"situation/rate_with_the_mouse", driven(mouse, "0.01"),
                    driven(mouse, "0.6 * iTimeDelta")});
    list.push_back(
        {"situation/rate_with_a_key", driven(key, "0.01"), driven(key, "0.6 * iTimeDelta")});
    const std::string exact = "uniform bool exact; //@ true\n";
    const auto phase = [](const char* other) {
        return fmt::format(
            "float turns = exact ? float(iTick & 65535u) / 65536.0 : {}; c = "
            "vec4(0.5 + 0.5 * sin(6.2831853 * (turns + q.x)));",
            other);
    };
    add("age_of_another_entry", exact, phase("fract(iTime)"),
        phase("float(iTick >> 1 & 65535u) / 65536.0"));
    const std::string two =
        "uniform vec3 a; //@ 0.3, 0.2, 0.3 [0.1, 0.9]\nuniform vec3 b; //@ 0.5, 0.4, 0.6 [0.2, "
        "0.8]\n";
    add("two_points_that_meet", two, "c = vec4(0.5 + 0.5 * normalize(a - b), 1);",
        "c = vec4(0.5 + 0.5 * (a - b) / max(length(a - b), 1e-6), 1);");
    const std::string tilt = "uniform float tilt; //@ 0.3 [-0.8, 0.8]\n";
    add("level_row_at_odd_heights", tilt, "float y = q.y - 0.5 + tilt; c = vec4(fract(0.1 / y));",
        "float y = q.y - 0.5 + tilt; c = vec4(fract(0.1 / (abs(y) + 1e-3)));");
    const auto level = [](const char* most) {
        return fmt::format(
            "uniform int lod; //@ 0 [0, {}]\n"
            "uniform sampler2D n; //@ noise 64\n",
            most);
    };
    list.push_back({"situation/level_that_is_not",
                    level("8") + image("c = texelFetch(n, ivec2(0), lod);"),
                    level("6") + image("c = texelFetch(n, ivec2(0), lod);")});
    const std::string x = "uniform float x; //@ 0.1 [0, 1]\n";
    add("pole_of_even_order", x, "float d = x - 0.37; c = vec4(q, 1e-6 / (d * d), 1);",
        "float d = x - 0.37; c = vec4(q, 1e-6 / (d * d + 1e-6), 1);");
}

// A sound and a cube are watched as a picture is.
inline void add_other_passes(std::vector<Planted>& list) {
    const auto sound = [](const char* body) {
        return image("c = vec4(q, 0.5, 1);") + "vec2 mainSound(int samp, float time) {\n    " +
               body + "\n    return vec2(x * sin(6.2831853 * 440.0 * fract(time)));\n}\n";
    };
    list.push_back({"other/sound_index",
                    sound("float v[4] = float[](.1, .2, .3, .4); float x = v[int(time) % 5];"),
                    sound("float v[4] = float[](.1, .2, .3, .4); float x = v[int(time) % 4];")});
    list.push_back({"other/sound_unset", sound("float x; if (samp < 0) x = 0.5;"),
                    sound("float x = 0.0; if (samp < 0) x = 0.5;")});
    list.push_back({"other/sound_hidden", sound("float x = max(0.0, sqrt(0.5 - fract(time)));"),
                    sound("float x = sqrt(max(0.0, 0.5 - fract(time)));")});
    const auto cube = [](const char* light) {
        return "uniform samplerCube sky; //@ pass mainCubemap size=32\n"
               "void mainCubemap(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) {\n    c = vec4(" +
               std::string(light) + ");\n}\n" +
               image("c = texture(sky, normalize(vec3(q - 0.5, 1)));");
    };
    list.push_back(
        {"other/cube_hidden", cube("max(0.0, sqrt(rd.y))"), cube("sqrt(max(0.0, rd.y))")});
}

// What other words do the same by, and results of either sign, which a clamp hides.
inline void add_other_words(std::vector<Planted>& list) {
    const auto add = [&](const char* name, const std::string& fault, const std::string& twin,
                         const std::string& head = "") {
        list.push_back({std::string("words/") + name, head + image(fault), head + image(twin)});
    };
    const std::string cells = "vec2 v = floor(q * 4.0); float k = v.y; ";
    add("divided_in_place", cells + "k /= v.x; c = vec4(clamp(k, 0.0, 1.0));",
        cells + "k /= max(v.x, 1.0); c = vec4(clamp(k, 0.0, 1.0));");
    add("component_divided_in_place", cells + "v.y /= v.x; c = vec4(k > 0.5 ? v.y : 1.0 - v.y);",
        cells + "v.y /= v.x + 1.0; c = vec4(k > 0.5 ? v.y : 1.0 - v.y);");
    const auto rest = [](const char* begin) {
        return fmt::format("int n = int(9.0 * q.x) - {}; n %= 3; c = vec4(0.5 + 0.2 * float(n));",
                           begin);
    };
    add("rest_in_place", rest("4"), rest("0"));
    add("quotient_to_whole", "int n = int(8.0 / floor(q.y * 3.0)); c = vec4(float(n & 7) / 7.0);",
        "int n = int(8.0 / floor(q.y * 3.0 + 1.0)); c = vec4(float(n & 7) / 7.0);");
    const auto light = [](const char* way) {
        return fmt::format(
            "vec2 v = floor(q * 6.0) - 3.0; "
            "c = vec4(max(0.0, dot({}, vec2(-0.6, -0.8))));",
            way);
    };
    add("direction_of_nothing", light("normalize(v)"), light("v / max(length(v), 1e-3)"));
    const std::string of = "uniform float cells; //@ 6 [0, 12]\n";
    add("rest_of_nothing", "c = vec4(step(0.5, 0.25 * mod(8.0 * q.x, floor(cells))));",
        "c = vec4(step(0.5, 0.25 * mod(8.0 * q.x, 1.0 + floor(cells))));", of);
    const std::string noise = "uniform sampler2D t; //@ noise rgba 16\n";
    add("fetch_beside", "c = texelFetchOffset(t, ivec2(q * 16.0), 0, ivec2(1, 0));",
        "c = texelFetchOffset(t, ivec2(q * 15.0), 0, ivec2(1, 0));", noise);
    const std::string volume = "uniform sampler3D t; //@ noise rgba 8x8x8\n";
    add("fetch_of_a_volume", "c = texelFetch(t, ivec3(3, 3, q.x * 9.0), 0);",
        "c = texelFetch(t, ivec3(3, 3, q.x * 8.0), 0);", volume);
    const auto held = [](const char* sum) {
        return fmt::format(
            "float m = iMouse.z > 0.0 ? iMouse.y {} iMouse.w : 0.0; "
            "c = vec4(max(0.0, sqrt(1.0 - m / iResolution.y)));",
            sum);
    };
    add("mouse_held", held("-"), held("- iMouse.y + 0.0 *"));
    const auto released = [](const char* bound) {
        return fmt::format(
            "float m = iMouse.z < 0.0 ? (iMouse.x - iMouse.z) * {} : 0.0; "
            "c = vec4(max(0.0, sqrt(1.0 - m / iResolution.x)));",
            bound);
    };
    add("mouse_let_go", released("1.0"), released("0.4"));
    const auto month = [](const char* count) {
        return fmt::format(
            "float light[{}]; for (int i = 0; i < light.length(); ++i) light[i] = 0.08 * float(i); "
            "c = vec4(light[int(iDate.y)]);",
            count);
    };
    add("last_month", month("11"), month("12"));
    const auto comet = [](const char* share) {
        return fed(fmt::format("vec2 at = 0.5 + 0.3 * vec2(cos({0}), sin({0})); "
                               "c = max(s * {1}, vec4(smoothstep(0.05, 0.0, "
                               "distance(p / iResolution.xy, at))));",
                               kTurn, share),
                   "", "", "c = texelFetch(state, ivec2(p), 0);");
    };
    list.push_back({"words/comet", comet("0.97"), comet("exp(-1.8 * iTimeDelta)")});
}

// What hides behind a guard, and what only a sound does.
// What is switched on at whole seconds; rates that are read; what changes once a second.
inline void add_seconds(std::vector<Planted>& list) {
    const auto follower = [](const char* to, const char* share) {
        return fed(fmt::format(
            "float t = float(iTick & 524287u) / 65536.0; c = mix(s, vec4({}), {});", to, share));
    };
    for (const auto& [name, to] :
         {std::pair("seconds", "step(0.5, fract(0.5 * t))"), std::pair("after_two", "step(2.0, t)"),
          std::pair("each_second", "fract(0.37 * floor(t))")})
        list.push_back({std::string("frame_rate/") + name, follower(to, "0.05"),
                        follower(to, "iFrame == 0 ? 0.0 : 1.0 - exp(-3.0 * iTimeDelta)")});
    const auto waves = [](const char* rate) {
        return image(
            fmt::format("float t = float(iTick & 524287u) / 65536.0; "
                        "c = vec4(0.5 + 0.5 * sin(9.0 * q.x + 0.78539816 * t * {}));",
                        rate));
    };
    list.push_back({"frame_rate/read", waves("round(iFrameRate / 60.0)"), waves("1.0")});
    const auto hashed = [](const char* second) {
        return image(
            fmt::format("c = vec4(fract(sin(dot(floor(p / 4.0) + {}, vec2(12.9898, "
                        "78.233))) * 43758.5453));",
                        second));
    };
    list.push_back({"time/hash_of_seconds", hashed("2e3 * floor(iTime)"),
                    hashed("float((iTick >> 16) & 63u)")});
}

inline void add_guarded(std::vector<Planted>& list) {
    // A wave whose largest stable share is a half; a value that grew too large counts as 0.
    const auto wave = [](const char* share) {
        return fmt::format(
            "uniform sampler2D buf; //@ pass mainBuf size=32x32 step=1/60\n"
            "float at(ivec2 i) {{\n"
            "    float v = texelFetch(buf, clamp(i, ivec2(0), ivec2(31)), 0).x;\n"
            "    return abs(v) <= 6e4 ? v : 0.0;\n}}\n"
            "void mainBuf(out vec4 c, in vec2 p) {{\n"
            "    ivec2 i = ivec2(p);\n    vec4 s = texelFetch(buf, i, 0);\n"
            "    s = mix(vec4(0.0), s, lessThanEqual(abs(s), vec4(6e4)));\n"
            "    float h = s.x, lap = at(i + ivec2(1, 0)) + at(i - ivec2(1, 0)) +\n"
            "                         at(i + ivec2(0, 1)) + at(i - ivec2(0, 1)) - 4.0 * h;\n"
            "    float w = 0.99 * (2.0 * h - s.y + {} * 3600.0 * iTimeDelta * iTimeDelta * lap);\n"
            "    if (s.w == 0.0) w = h = exp(-0.2 * dot(p - 16.0, p - 16.0));\n"
            "    c = vec4(w, h, 0.0, 1.0);\n}}\n"
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    c = vec4(0.5 + 0.1 * tanh(1e-3 * texture(buf, p / iResolution.xy).x));\n}}\n",
            share);
    };
    list.push_back({"growth/behind_a_guard", wave("0.81"), wave("0.4")});
    const auto loops = [](int turns) {
        return fmt::format(
            "vec2 mainSound(int samp, float time) {{\n    int n = 0;\n"
            "    for (int k = 0; k < {}; k++) n += (k ^ samp) >= 0 ? 1 : 2;\n"
            "    return vec2(float(n % 1000) * 1e-3 - 0.5);\n}}\n"
            "void mainImage(out vec4 c, in vec2 p) {{ c = vec4(0.5); }}\n",
            turns);
    };
    list.push_back({"sound/loops", loops(100'000), loops(500)});
}

}  // namespace planting

inline std::vector<Planted> outside_faults() {
    std::vector<Planted> list;
    planting::add_open(list);
    planting::add_far_places(list);
    planting::add_situations(list);
    planting::add_other_passes(list);
    planting::add_other_words(list);
    planting::add_guarded(list);
    planting::add_seconds(list);
    return list;
}

inline std::vector<Planted> all_planted_faults() {
    std::vector<Planted> list = planted_faults();
    for (Planted& one : outside_faults()) list.push_back(std::move(one));
    return list;
}

}  // namespace glint::cli
