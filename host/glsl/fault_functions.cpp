#include "glsl/fault_functions.h"

#include "glsl/probe_types.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace glint {
namespace {

constexpr std::string_view kFaults =
    R"(int glint0_id = 0, glint0_last = 0, glint0_found = 0, glint0_first = 0, glint0_worst = 0, glint0_divided = -1;
bool glint0_mends = false;
float glint0_scale = 7.0, glint0_inside = 0.37, glint0_side = 1.0;
uvec4 glint0_bits = uvec4(0u, 0u, 0x7F7FFFFFu, 0u);
vec4 glint0_divisor = vec4(1.0);
void glint0_f(int i, bool is_wrong, uint a, uint b) {
    if (is_wrong && glint0_found == 0) { glint0_first = i + 1; glint0_bits.xy = uvec2(a, b); }
    glint0_found += int(is_wrong);
}
void glint0_f(int i, bool is_wrong, float a) { glint0_f(i, is_wrong, floatBitsToUint(a), 0u); }
void glint0_f(int i, bool is_wrong, float a, float b) { glint0_f(i, is_wrong, floatBitsToUint(a), floatBitsToUint(b)); }
void glint0_u(int i, bool is_undefined, uint a, float off) {
    if (is_undefined && glint0_worst == 0) { glint0_worst = i + 1; glint0_bits.w = a; }
    if (i == glint0_id && off < uintBitsToFloat(glint0_bits.z)) glint0_bits.z = floatBitsToUint(max(off, 0.0));
}
void glint0_u(int i, bool is_undefined, float a, float off) { glint0_u(i, is_undefined, floatBitsToUint(a), off); }
float glint0_v(int i, float v) {
    glint0_f(i, (floatBitsToUint(v) & 0x7F800000u) == 0x7F800000u, v);
    bool is_nan = (floatBitsToUint(v) & 0x7FFFFFFFu) > 0x7F800000u;
    glint0_u(i, is_nan, v, 3e38);
    return glint0_mends && is_nan ? 0.05 * glint0_scale * glint0_side : v;
}
float glint0_d(int i, float b) {
    glint0_divided = i;
    glint0_divisor = vec4(b);
    glint0_f(i, b == 0.0, b);
    glint0_u(i, false, b, abs(b));
    return b;
}
float glint0_q(int i, float v, float b) {
    bool is_none = b == 0.0 && glint0_divided == i && (floatBitsToUint(v) & 0x7FFFFFFFu) != 0x7F800000u;
    glint0_u(i, is_none, 0x7FC00000u, 3e38);
    return glint0_mends && is_none ? 0.05 * glint0_scale * glint0_side : v;
}
float glint0_q(int i, float v) { return glint0_q(i, v, glint0_divisor.x); }
int glint0_d(int i, int b) { glint0_f(i, b == 0, uint(b), 0u); glint0_u(i, b == 0, uint(b), abs(float(b))); return b; }
uint glint0_d(int i, uint b) { glint0_f(i, b == 0u, b, 0u); glint0_u(i, b == 0u, b, float(b)); return b; }
int glint0_by(int i, int b) {
    glint0_f(i, b <= 0, uint(b), 0u);
    glint0_u(i, b <= 0, uint(b), b == 0 ? 0.0 : 3e38);
    return glint0_mends && b < 0 ? int(min(glint0_scale, 2e9)) : b;
}
uint glint0_by(int i, uint b) { return glint0_d(i, b); }
int glint0_rest(int i, int a) {
    glint0_f(i, a < 0, uint(a), 0u);
    glint0_u(i, a < 0, uint(a), 3e38);
    return glint0_mends && a < 0 ? int(min(glint0_scale, 2e9)) : a;
}
uint glint0_rest(int i, uint a) { return a; }
int glint0_i(int i, int at, int count) {
    bool is_out = at < 0 || at >= count;
    glint0_f(i, is_out, uint(at), uint(count));
    glint0_u(i, is_out, uint(at), min(float(at) + 1.0, float(count) - float(at)));
    return at;
}
uint glint0_i(int i, uint at, int count) { glint0_i(i, at > 2147483647u ? 2147483647 : int(at), count); return at; }
ivec2 glint0_t(int i, ivec2 at, ivec2 size) {
    bool is_out = at.x < 0 || at.x >= size.x;
    glint0_u(i, is_out || at.y < 0 || at.y >= size.y, uint(is_out ? at.x : at.y), 3e38);
    return glint0_mends ? clamp(at, ivec2(0), size - 1) : at;
}
ivec3 glint0_t(int i, ivec3 at, ivec3 size) {
    bool is_out = at.z < 0 || at.z >= size.z;
    glint0_u(i, is_out, uint(at.z), 3e38);
    at.xy = glint0_t(i, at.xy, size.xy);
    return glint0_mends ? clamp(at, ivec3(0), size - 1) : at;
}
ivec2 glint0_t(int i, ivec2 at, ivec2 size, ivec2 by) { return glint0_t(i, at + by, size) - by; }
ivec3 glint0_t(int i, ivec3 at, ivec3 size, ivec3 by) { return glint0_t(i, at + by, size) - by; }
float glint0_to_int(int i, float v) {
    bool is_out = !(v >= -2147483648.0 && v < 2147483648.0);
    glint0_f(i, is_out, v);
    glint0_u(i, is_out, v, 2147483648.0 - abs(v));
    return glint0_mends && is_out ? min(glint0_scale, 2e9) * glint0_side : v;
}
float glint0_to_uint(int i, float v) {
    bool is_out = !(v > -1.0 && v < 4294967296.0);
    glint0_f(i, is_out, v);
    glint0_u(i, is_out, v, min(v + 1.0, 4294967296.0 - v));
    return glint0_mends && is_out ? min(glint0_scale, 2e9) : v;
}
int glint0_s(int i, int n) {
    bool is_out = n < 0 || n > 31;
    glint0_f(i, is_out, float(n));
    glint0_u(i, is_out, float(n), min(float(n) + 1.0, 32.0 - float(n)));
    return glint0_mends && is_out ? int(min(glint0_scale, 31.0)) : n;
}
uint glint0_s(int i, uint n) { return uint(glint0_s(i, n > 2147483647u ? 2147483647 : int(n))); }
)";

// `is_undefined`: what no driver owes a result. `off`: how far from that. `mended`: an operand that
// has a result, another one than what is undefined may come to: a usual, a small, a large or a
// negative one.
struct Domain {
    const char *name, *is_wrong, *is_undefined, *off, *mended;
};
constexpr std::array<Domain, 8> kOne = {
    {{"sqrt", "a < 0.0", "a < 0.0", "a", "max(v, -glint0_scale * v)"},
     {"inversesqrt", "a <= 0.0", "a < 0.0", "a", "max(v, -glint0_scale * v)"},
     {"log", "a <= 0.0", "a < 0.0", "a", "max(v, -glint0_scale * v)"},
     {"log2", "a <= 0.0", "a < 0.0", "a", "max(v, -glint0_scale * v)"},
     {"acos", "abs(a) > 1.0", "abs(a) > 1.0", "1.0 - abs(a)",
      "v - (v - glint0_inside) * step(1.0000001, abs(v))"},
     {"asin", "abs(a) > 1.0", "abs(a) > 1.0", "1.0 - abs(a)",
      "v - (v - glint0_inside) * step(1.0000001, abs(v))"},
     {"acosh", "a < 1.0", "a < 1.0", "a - 1.0", "1.0 + abs(v - 1.0)"},
     {"atanh", "abs(a) >= 1.0", "abs(a) > 1.0", "1.0 - abs(a)",
      "v - (v - glint0_inside) * step(1.0, abs(v))"}}};
constexpr std::array<Domain, 3> kTwo = {
    {{"pow", "a < 0.0 || (a == 0.0 && b <= 0.0)", "a < 0.0 || (a == 0.0 && b <= 0.0)", "a",
      "max(v, -glint0_scale * v) + glint0_scale * (1.0 - step(1e-30, abs(v) + max(w, 0.0))), "
      "w + (1.0 - step(1e-30, abs(v) + abs(w)))"},
     {"mod", "b == 0.0", "b == 0.0", "abs(b)",
      "v, w + glint0_scale * glint0_side * (1.0 - step(1e-30, abs(w)))"},
     {"atan", "a == 0.0 && b == 0.0", "a == 0.0 && b == 0.0", "3e38",
      "v + glint0_scale * glint0_side * (1.0 - step(1e-30, abs(v) + abs(w))), "
      "w + (1.0 - step(1e-30, abs(v) + abs(w)))"}}};

// What is done for each component of a vector.
std::string for_each(int length, const std::string& call) {
    std::string text;
    for (int c = 0; c < length; ++c) {
        const std::string of = length == 1 ? "" : fmt::format(".{}", "xyzw"[c]);
        text += fmt::format(fmt::runtime(call), fmt::arg("of", of));
    }
    return text;
}

// Bounds may not be reversed; of smoothstep they may be what everybody means by it, but not the
// same. What comes of others is one of the two, in the order in which a driver compares them.
std::string faults_of_bounds(const std::string& type, const std::string& bound, int length) {
    const bool has_parts = bound.find("vec") != bound.npos;
    const auto each = [&](const char* call) {
        std::string text;
        for (int c = 0; c < (has_parts ? length : 1); ++c)
            text += fmt::format(fmt::runtime(call),
                                has_parts ? fmt::format(".{}", "xyzw"[c]) : std::string());
        return text;
    };
    std::string text = fmt::format(
        "{0} glint0_clamp(int i, {0} v, {1} low, {1} high) {{ bool was = glint0_worst != 0; "
        "{2}if (!glint0_mends || was || glint0_worst != i + 1) return clamp(v, low, high); "
        "return glint0_scale < 1.0 ? min(max(v, low), high) : max(min(v, high), low); }}\n",
        type, bound,
        each("glint0_f(i, low{0} > high{0}, float(low{0}), float(high{0})); glint0_u(i, low{0} > "
             "high{0}, float(low{0}), float(high{0}) - float(low{0})); "));
    if (type.find("vec") == 0 || type == "float")
        text += fmt::format(
            "{0} glint0_smoothstep(int i, {1} low, {1} high, {0} v) {{ bool was = glint0_worst != "
            "0; {2}return glint0_mends && !was && glint0_worst == i + 1 ? v * 0.0 + "
            "clamp(glint0_inside, 0.0, 1.0) : smoothstep(low, high, v); }}\n",
            type, bound,
            each("glint0_f(i, low{0} == high{0}, low{0}, high{0}); glint0_u(i, low{0} == high{0}, "
                 "low{0}, abs(high{0} - low{0})); "));
    return text;
}

std::string faults_of_all_bounds() {
    std::string text;
    for (const char* kind : {"", "i", "u"})
        for (int n = 1; n <= 4; ++n) {
            const std::string one = *kind == 'i' ? "int" : *kind == 'u' ? "uint" : "float";
            const std::string type = n == 1 ? one : fmt::format("{}vec{}", kind, n);
            text += faults_of_bounds(type, type, n);
            if (n > 1) text += faults_of_bounds(type, one, n);
        }
    return text;
}

// What is no float is handed through as it is, but for whole divisors and shifts.
std::string faults_of_other_types() {
    std::string text;
    for (std::size_t i = 4; i < kProbeTypes.size(); ++i)
        for (const char* name : {"v", "q", "to_int", "to_uint"})
            text +=
                fmt::format("{0} glint0_{1}(int i, {0} v) {{ return v; }}\n", kProbeTypes[i], name);
    for (const char* type : {"ivec2", "ivec3", "ivec4", "uvec2", "uvec3", "uvec4"})
        text += fmt::format("{0} glint0_s(int i, {0} v) {{ {1}return v; }}\n", type,
                            for_each(type[4] - '0', "v{of} = glint0_s(i, v{of}); "));
    for (const char* type : {"ivec2", "ivec3", "ivec4", "uvec2", "uvec3", "uvec4"}) {
        const int n = type[4] - '0';
        text += fmt::format("{0} glint0_d(int i, {0} v) {{ {1}return v; }}\n", type,
                            for_each(n, "glint0_d(i, v{of}); "));
        for (const char* name : {"by", "rest"})
            text +=
                fmt::format("{0} glint0_{1}(int i, {0} v) {{ {2}return v; }}\n", type, name,
                            for_each(n, fmt::format("v{{of}} = glint0_{}(i, v{{of}}); ", name)));
    }
    for (const std::string_view matrix : kProbeMatrices) {
        text += fmt::format("{0} glint0_v(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format("glint0_v(i, v[{}]); ", c);
        text += fmt::format("return v; }}\n", matrix);
        for (const char* name : {"d", "q"})
            text += fmt::format("{0} glint0_{1}(int i, {0} v) {{ return v; }}\n", matrix, name);
    }
    return text;
}

// What hands a mark through and notes it; glsl/zero_value.h writes these.
std::string faults_of_marks() {
    std::string text =
        "void glint0_x(int i, uint bits) { bool is_mark = bits == 0x7FC0DEADu; "
        "glint0_f(i, is_mark, bits, 0u); glint0_u(i, is_mark, bits, 3e38); }\n"
        "float glint0_m(int i, float v) { glint0_x(i, floatBitsToUint(v)); return v; }\n"
        "int glint0_m(int i, int v) { glint0_x(i, uint(v)); return v; }\n"
        "uint glint0_m(int i, uint v) { glint0_x(i, v); return v; }\n";
    for (const char* kind : {"", "i", "u"})
        for (int n = 2; n <= 4; ++n)
            text += fmt::format("{0}vec{1} glint0_m(int i, {0}vec{1} v) {{ {2}return v; }}\n", kind,
                                n, for_each(n, "glint0_m(i, v{of}); "));
    for (const std::string_view matrix : kProbeMatrices) {
        text += fmt::format("{0} glint0_m(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format("glint0_m(i, v[{}]); ", c);
        text += "return v; }\n";
    }
    return text;
}

// Of vectors: each component through the function of floats.
std::string faults_of_vectors() {
    std::string text;
    for (int n = 2; n <= 4; ++n) {
        const std::string type = kProbeTypes[static_cast<std::size_t>(n) - 1];
        text += fmt::format(
            "{0} glint0_d(int i, {0} v) {{ {1}glint0_divisor.{2} = v; return v; }}\n"
            "{0} glint0_q(int i, {0} v) {{ {3}return v; }}\n",
            type, for_each(n, "glint0_d(i, v{of}); "),
            std::string_view("xyzw").substr(0, static_cast<std::size_t>(n)),
            for_each(n, "v{of} = glint0_q(i, v{of}, glint0_divisor{of}); "));
        for (const char* name : {"v", "to_int", "to_uint"})
            text +=
                fmt::format("{0} glint0_{1}(int i, {0} v) {{ {2}return v; }}\n", type, name,
                            for_each(n, fmt::format("v{{of}} = glint0_{}(i, v{{of}}); ", name)));
    }
    return text;
}

// Of functions of one operand: `glint0_sqrt(7, v)`, and what notes alone.
std::string faults_of_one(const std::string& type, int n) {
    std::string text;
    for (const Domain& one : kOne)
        text += fmt::format(
            "void glint0_is_{0}(int i, {1} v) {{ {2}}}\n"
            "{1} glint0_{0}(int i, {1} v) {{ "
            "glint0_is_{0}(i, v); if (glint0_mends) v = {3}; return {0}(v); }}\n",
            one.name, type,
            for_each(n, fmt::format("{{{{ float a = v{{of}}; glint0_f(i, {}, a); "
                                    "glint0_u(i, {}, a, {}); }}}} ",
                                    one.is_wrong, one.is_undefined, one.off)),
            one.mended);
    return text;
}

// Of two, of which the second may be a float for all components.
std::string faults_of_two(const std::string& type, int n) {
    std::string text;
    for (const Domain& one : kTwo)
        for (const bool is_scalar : {false, true}) {
            if (is_scalar && (n == 1 || one.name != std::string_view("mod"))) continue;
            text += fmt::format(
                "{1} glint0_{0}(int i, {1} v, {3} w) {{ bool was = glint0_worst != 0; {2}"
                "return glint0_mends && !was && glint0_worst == i + 1 ? {0}({4}) : {0}(v, w); }}\n",
                one.name, type,
                for_each(n, fmt::format("{{{{ float a = v{{of}}, b = w{}; glint0_f(i, {}, a, b); "
                                        "glint0_u(i, {}, a, {}); }}}} ",
                                        is_scalar ? "" : "{of}", one.is_wrong, one.is_undefined,
                                        one.off)),
                is_scalar ? "float" : type, one.mended);
        }
    return text;
}

// What has no direction may be given any: by turns to all sides.
constexpr std::array<const char*, 4> kDirections = {
    "glint0_side", "glint0_side * vec2(1.0, glint0_scale - 6.0)",
    "glint0_side * vec3(1.0, glint0_scale - 6.0, 1.0)",
    "glint0_side * vec4(1.0, glint0_scale - 6.0, 1.0, glint0_scale - 6.0)"};

}  // namespace

std::string fault_functions() {
    std::string text(kFaults);
    text += faults_of_vectors();
    for (int n = 1; n <= 4; ++n) {
        const std::string type = kProbeTypes[static_cast<std::size_t>(n) - 1];
        text += faults_of_one(type, n) + faults_of_two(type, n);
        text += fmt::format(
            "{0} glint0_normalize(int i, {0} v) {{ float a = length(v); "
            "glint0_f(i, dot(v, v) == 0.0, a); glint0_u(i, a == 0.0, a, a); "
            "return normalize(glint0_mends && a == 0.0 ? v + {1} : v); }}\n",
            type, kDirections[static_cast<std::size_t>(n) - 1]);
    }
    for (const char* matrix : {"mat2", "mat3", "mat4"})
        text += fmt::format(
            "{0} glint0_inverse(int i, {0} v) {{ float a = determinant(v); "
            "glint0_f(i, a == 0.0, a); glint0_u(i, a == 0.0, a, abs(a)); "
            "return inverse(glint0_mends && a == 0.0 ? v + {0}(glint0_scale) : v); }}\n",
            matrix);
    return text + faults_of_all_bounds() + faults_of_other_types() + faults_of_marks();
}

}  // namespace glint
