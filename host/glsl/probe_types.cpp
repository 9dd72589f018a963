#include "glsl/probe_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace glint {
namespace {

constexpr std::array<const char*, 16> kTypes = {
    "float", "vec2",  "vec3",  "vec4",  "int",  "ivec2", "ivec3", "ivec4",
    "uint",  "uvec2", "uvec3", "uvec4", "bool", "bvec2", "bvec3", "bvec4"};
constexpr std::size_t kMostLeaves = 64;
constexpr int kMostDeep = 8;

// Containers from 1 on: matrices by columns, then rows.
int matrix_number(std::string_view type) {
    return (matrix_columns(type) - 2) * 3 + matrix_rows(type) - 1;
}

// `[3]`; 0 where it is no plain number.
int plain_length(const Reading& reading, TokenRange array) {
    int length = 0;
    if (array.size() != 3) return 0;
    const std::string_view digits = reading.word(array.begin + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), length);
    return error == std::errc() && end == digits.data() + digits.size() ? length : 0;
}

}  // namespace

int probe_type_of(std::string_view type) {
    const auto found = std::ranges::find(kTypes, type);
    return found == kTypes.end() ? -1 : static_cast<int>(found - kTypes.begin());
}

int matrix_columns(std::string_view type) {
    const bool is_matrix =
        type.starts_with("mat") && (type.size() == 4 || (type.size() == 6 && type[4] == 'x'));
    return is_matrix && type[3] >= '2' && type[3] <= '4' ? type[3] - '0' : 0;
}

int matrix_rows(std::string_view type) {
    return matrix_columns(type) == 0 ? 0 : type.back() - '0';
}

const char* probe_type(std::uint32_t tag) {
    const std::uint32_t type = tag & ((1u << kProbeContainerShift) - 1u);
    return type < kTypes.size() ? kTypes[type] : "";
}

ProbeLeaves leaves_of(std::uint32_t tag, const Probed& probed) {
    const int container = static_cast<int>(tag >> kProbeContainerShift);
    if (container == 0) return {""};
    ProbeLeaves leaves;
    if (container >= kProbeFirstStruct) {
        const auto structure = static_cast<std::size_t>(container - kProbeFirstStruct);
        if (structure < probed.structs.size()) leaves = probed.structs[structure];
    } else {
        for (int column = 0; column < 2 + (container - 1) / 3; ++column)
            leaves.push_back(fmt::format("[{}]", column));
    }
    return leaves;
}

bool StructTypes::add_leaves(std::uint32_t structure, const std::string& path, int depth,
                             std::vector<Leaf>& leaves) const {
    if (depth > kMostDeep) return false;
    for (const std::uint32_t index : reading_.structs[structure].members) {
        const Declaration& member = reading_.declarations[index];
        const std::string type(reading_.word(member.type));
        for (const Declarator& one : member.names) {
            const TokenRange array = one.array.empty() ? member.type_array : one.array;
            const int length = array.empty() ? 1 : plain_length(reading_, array);
            if (length == 0) return false;
            for (int i = 0; i < length; ++i) {
                const std::string name = fmt::format("{}.{}{}", path, reading_.word(one.name),
                                                     array.empty() ? "" : fmt::format("[{}]", i));
                for (int column = 0; column < matrix_columns(type); ++column)
                    leaves.push_back({fmt::format("{}[{}]", name, column),
                                      fmt::format("vec{}", matrix_rows(type))});
                if (matrix_columns(type) > 0) continue;
                if (probe_type_of(type) >= 0) {
                    leaves.push_back({name, type});
                    continue;
                }
                const auto inner = std::ranges::find_if(reading_.structs, [&](const Struct& s) {
                    return s.function == kNone && s.name != kNone && reading_.word(s.name) == type;
                });
                const auto number = static_cast<std::uint32_t>(inner - reading_.structs.begin());
                if (inner == reading_.structs.end() || !add_leaves(number, name, depth + 1, leaves))
                    return false;
            }
        }
    }
    return leaves.size() <= kMostLeaves;
}

ProbeLeaves StructTypes::leaves(std::uint32_t structure) const {
    std::vector<Leaf> leaves;
    ProbeLeaves paths;
    if (!add_leaves(structure, "", 0, leaves)) return paths;
    for (Leaf& leaf : leaves) paths.push_back(std::move(leaf.path));
    return paths;
}

std::string StructTypes::overload(std::uint32_t structure, ProbeKind kind) const {
    std::vector<Leaf> leaves;
    const Struct& one = reading_.structs[structure];
    if (one.name == kNone || !add_leaves(structure, "", 0, leaves) || leaves.empty()) return {};
    std::string text = fmt::format("{0} glint_v(int i,{0} v){{", reading_.word(one.name));
    const int container = kProbeFirstStruct + static_cast<int>(structure);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const int tag = probe_type_of(leaves[i].type) | container << kProbeContainerShift;
        text += kind == ProbeKind::values ? fmt::format("glint_l(i+{},{},v{});",
                                                        i << kProbeLeafShift, tag, leaves[i].path)
                                          : fmt::format("glint_v(i,v{});", leaves[i].path);
    }
    return text + "return v;}";
}

namespace {

int length_of_type(std::size_t type) {
    return static_cast<int>(type % 4) + 1;
}

std::string swizzle(int length) {
    return std::string("xyzw").substr(0, static_cast<std::size_t>(length));
}

// The bits of a value of a type, as uints.
std::string bits(std::size_t type, const std::string& value) {
    if (type < 4) return fmt::format("floatBitsToUint({})", value);
    if (length_of_type(type) == 1) return fmt::format("uint({})", value);
    return fmt::format("uvec{}({})", length_of_type(type), value);
}

constexpr std::array<const char*, 9> kMatrices = {"mat2",   "mat2x3", "mat2x4", "mat3x2", "mat3",
                                                  "mat3x4", "mat4x2", "mat4x3", "mat4"};

constexpr std::string_view kValues = R"(bool glint_if = false;
int glint_id = 0, glint_last = 0, glint_hits = 0, glint_events = 0, glint_order = 0, glint_tag = 0;
uvec4 glint_bits = uvec4(0);
bool glint_keeps(int i, int tag) {
    ++glint_events;
    bool here = i == glint_id;
    glint_hits += int(here);
    here = here && glint_hits <= glint_last;
    if (here) { glint_tag = tag; glint_order = glint_events; }
    return here;
}
)";

std::string values_functions() {
    std::string text(kValues);
    text += fmt::format("void glint_r(int i) {{ glint_keeps(i, {}); }}\n", kProbeReached);
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
        text += fmt::format(
            "void glint_l(int i, int tag, {0} v) {{ if (glint_keeps(i, tag)) glint_bits.{1} = {2}; "
            "}}\n{0} glint_v(int i, {0} v) {{ glint_l(i, {3}, v); return v; }}\n",
            kTypes[i], swizzle(length_of_type(i)), bits(i, "v"), i);
        if (i < 12)
            text += fmt::format(
                "{0} glint_w(int i, {0} v, {0} now) {{ glint_l(i, {1}, now); return v; }}\n",
                kTypes[i], i);
    }
    for (const std::string_view matrix : kMatrices) {
        text += fmt::format("{0} glint_v(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format(
                "glint_l(i + {}, {}, v[{}]); ", c << kProbeLeafShift,
                (matrix_rows(matrix) - 1) | matrix_number(matrix) << kProbeContainerShift, c);
        text += "return v; }\n";
    }
    return text;
}

std::string cost_functions() {
    std::string text =
        "int glint_id = 0, glint_last = 0, glint_hits = 0;\n"
        "uvec4 glint_bits = uvec4(0);\n"
        "void glint_n(int i, int kind) { glint_hits += int(i == glint_id); "
        "++glint_bits[kind]; }\n";
    for (const char* type : {"float", "vec4", "ivec4", "uvec4"})
        text += fmt::format("{0} glint_n(int i, {0} v) {{ glint_n(i, 1); return v; }}\n", type);
    return text;
}

constexpr std::string_view kFaults =
    R"(int glint_id = 0, glint_last = 0, glint_found = 0, glint_first = 0, glint_worst = 0;
bool glint_mends = false;
float glint_scale = 7.0, glint_inside = 0.37;
uvec4 glint_bits = uvec4(0u, 0u, 0x7F7FFFFFu, 0u);
void glint_f(int i, bool is_wrong, uint a, uint b) {
    if (is_wrong && glint_found == 0) { glint_first = i + 1; glint_bits.xy = uvec2(a, b); }
    glint_found += int(is_wrong);
}
void glint_f(int i, bool is_wrong, float a) { glint_f(i, is_wrong, floatBitsToUint(a), 0u); }
void glint_f(int i, bool is_wrong, float a, float b) { glint_f(i, is_wrong, floatBitsToUint(a), floatBitsToUint(b)); }
void glint_u(int i, bool is_undefined, uint a, float off) {
    if (is_undefined && glint_worst == 0) { glint_worst = i + 1; glint_bits.w = a; }
    if (i == glint_id && off < uintBitsToFloat(glint_bits.z)) glint_bits.z = floatBitsToUint(max(off, 0.0));
}
void glint_u(int i, bool is_undefined, float a, float off) { glint_u(i, is_undefined, floatBitsToUint(a), off); }
void glint_a(int i, bool holds) { glint_f(i, !holds, 0u, 0u); }
float glint_v(int i, float v) {
    glint_f(i, (floatBitsToUint(v) & 0x7F800000u) == 0x7F800000u, v);
    bool is_nan = (floatBitsToUint(v) & 0x7FFFFFFFu) > 0x7F800000u;
    glint_u(i, is_nan, v, 3e38);
    return glint_mends && is_nan ? 0.05 * glint_scale : v;
}
float glint_w(int i, float v, float now) { glint_v(i, now); return v; }
float glint_d(int i, float b) { glint_f(i, b == 0.0, b); glint_u(i, false, b, abs(b)); return b; }
int glint_d(int i, int b) { glint_f(i, b == 0, uint(b), 0u); glint_u(i, b == 0, uint(b), abs(float(b))); return b; }
uint glint_d(int i, uint b) { glint_f(i, b == 0u, b, 0u); glint_u(i, b == 0u, b, float(b)); return b; }
int glint_i(int i, int at, int count) {
    bool is_out = at < 0 || at >= count;
    glint_f(i, is_out, uint(at), uint(count));
    glint_u(i, is_out, uint(at), min(float(at) + 1.0, float(count) - float(at)));
    return at;
}
uint glint_i(int i, uint at, int count) { glint_i(i, at > 2147483647u ? 2147483647 : int(at), count); return at; }
ivec2 glint_t(int i, ivec2 at, ivec2 size) {
    glint_u(i, at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y, uint(at.x), 3e38);
    return glint_mends ? clamp(at, ivec2(0), size - 1) : at;
}
ivec3 glint_t(int i, ivec3 at, ivec3 size) { return at; }
)";

// A result that is rounded may as well be the next float above or below. What ends in twelve zeros,
// as whole numbers and their halves do, is taken for exact. glint_id: the site, -1 for all, -2 for
// none; -3 moves the pixels themselves.
constexpr std::string_view kRounding =
    R"(int glint_id = 0, glint_last = 0, glint_hits = 0;
uvec4 glint_bits = uvec4(0);
uint glint_chance = 0u;
float glint_v(int i, float v) {
    uint bits = floatBitsToUint(v), power = bits & 0x7F800000u;
    if ((glint_id != i && glint_id != -1) || power == 0u || power == 0x7F800000u || (bits & 0xFFFu) == 0u) return v;
    ++glint_hits;
    glint_chance = glint_chance * 747796405u + 2891336453u;
    uint word = ((glint_chance >> ((glint_chance >> 28u) + 4u)) ^ glint_chance) * 277803737u;
    return uintBitsToFloat((word >> 30u) % 2u == 0u ? bits - 1u : bits + 1u);
}
vec2 glint_v(int i, vec2 v) { return vec2(glint_v(i, v.x), glint_v(i, v.y)); }
vec3 glint_v(int i, vec3 v) { return vec3(glint_v(i, v.xy), glint_v(i, v.z)); }
vec4 glint_v(int i, vec4 v) { return vec4(glint_v(i, v.xy), glint_v(i, v.zw)); }
)";

std::string rounding_functions() {
    std::string text(kRounding);
    for (std::size_t i = 4; i < kTypes.size(); ++i)
        text += fmt::format("{0} glint_v(int i, {0} v) {{ return v; }}\n", kTypes[i]);
    for (const std::string_view matrix : kMatrices) {
        text += fmt::format("{0} glint_v(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format("v[{0}] = glint_v(i, v[{0}]); ", c);
        text += "return v; }\n";
    }
    return text;
}

// `is_undefined`: what no driver owes a result. `off`: how far from that. `mended`: an operand that
// has a result, another one than what is undefined may come to: a usual, a small or a large one.
struct Domain {
    const char *name, *is_wrong, *is_undefined, *off, *mended;
};
constexpr std::array<Domain, 8> kOne = {
    {{"sqrt", "a < 0.0", "a < 0.0", "a", "max(v, -glint_scale * v)"},
     {"inversesqrt", "a <= 0.0", "a < 0.0", "a", "max(v, -glint_scale * v)"},
     {"log", "a <= 0.0", "a < 0.0", "a", "max(v, -glint_scale * v)"},
     {"log2", "a <= 0.0", "a < 0.0", "a", "max(v, -glint_scale * v)"},
     {"acos", "abs(a) > 1.0", "abs(a) > 1.0", "1.0 - abs(a)",
      "v - (v - glint_inside) * step(1.0000001, abs(v))"},
     {"asin", "abs(a) > 1.0", "abs(a) > 1.0", "1.0 - abs(a)",
      "v - (v - glint_inside) * step(1.0000001, abs(v))"},
     {"acosh", "a < 1.0", "a < 1.0", "a - 1.0", "1.0 + abs(v - 1.0)"},
     {"atanh", "abs(a) >= 1.0", "abs(a) > 1.0", "1.0 - abs(a)",
      "v - (v - glint_inside) * step(1.0, abs(v))"}}};
constexpr std::array<Domain, 3> kTwo = {
    {{"pow", "a < 0.0 || (a == 0.0 && b <= 0.0)", "a < 0.0", "a", "max(v, -glint_scale * v), w"},
     {"mod", "b == 0.0", "b == 0.0", "abs(b)", "v, w + 1.0"},
     {"atan", "a == 0.0 && b == 0.0", "false", "3e38", "v, w"}}};

// What is done for each component of a vector.
std::string for_each(int length, const std::string& call) {
    std::string text;
    for (int c = 0; c < length; ++c) {
        const std::string of = length == 1 ? "" : fmt::format(".{}", "xyzw"[c]);
        text += fmt::format(fmt::runtime(call), fmt::arg("of", of));
    }
    return text;
}

std::string faults_functions() {
    std::string text(kFaults);
    for (int n = 1; n <= 4; ++n) {
        const std::string type = kTypes[static_cast<std::size_t>(n) - 1];
        if (n > 1) {
            for (const char* name : {"v", "d"})
                text +=
                    fmt::format("{0} glint_{1}(int i, {0} v) {{ {2}return v; }}\n", type, name,
                                for_each(n, fmt::format("v{{of}} = glint_{}(i, v{{of}}); ", name)));
            text += fmt::format(
                "{0} glint_w(int i, {0} v, {0} now) {{ glint_v(i, now); return v; }}\n", type);
        }
        for (const Domain& one : kOne)
            text += fmt::format(
                "void glint_is_{0}(int i, {1} v) {{ {2}}}\n{1} glint_{0}(int i, {1} v) {{ "
                "glint_is_{0}(i, v); if (glint_mends) v = {3}; return {0}(v); }}\n",
                one.name, type,
                for_each(n, fmt::format("{{{{ float a = v{{of}}; glint_f(i, {}, a); "
                                        "glint_u(i, {}, a, {}); }}}} ",
                                        one.is_wrong, one.is_undefined, one.off)),
                one.mended);
        for (const Domain& one : kTwo)
            for (const bool is_scalar : {false, true}) {
                if (is_scalar && (n == 1 || one.name != std::string_view("mod"))) continue;
                text += fmt::format(
                    "{1} glint_{0}(int i, {1} v, {3} w) {{ bool was = glint_worst != 0; "
                    "{2}return glint_mends && !was && glint_worst == i + 1 ? {0}({4}) : {0}(v, w); "
                    "}}\n",
                    one.name, type,
                    for_each(n, fmt::format("{{{{ float a = v{{of}}, b = w{}; glint_f(i, {}, a, "
                                            "b); glint_u(i, {}, a, {}); }}}} ",
                                            is_scalar ? "" : "{of}", one.is_wrong, one.is_undefined,
                                            one.off)),
                    is_scalar ? "float" : type, one.mended);
            }
        text += fmt::format(
            "{0} glint_normalize(int i, {0} v) {{ float a = length(v); glint_f(i, dot(v, v) == "
            "0.0, "
            "a); glint_u(i, a == 0.0, a, a); return normalize(glint_mends && a == 0.0 ? v + 1.0 : "
            "v); }}\n",
            type);
    }
    for (std::size_t i = 4; i < kTypes.size(); ++i)
        text += fmt::format("{0} glint_v(int i, {0} v) {{ return v; }}\n", kTypes[i]);
    for (const char* type : {"ivec2", "ivec3", "ivec4", "uvec2", "uvec3", "uvec4"}) {
        const int n = type[4] - '0';
        text += fmt::format("{0} glint_d(int i, {0} v) {{ {1}return v; }}\n", type,
                            for_each(n, "glint_d(i, v{of}); "));
    }
    for (const std::string_view matrix : kMatrices) {
        text += fmt::format("{0} glint_v(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format("glint_v(i, v[{}]); ", c);
        text += fmt::format("return v; }}\n{0} glint_d(int i, {0} v) {{ return v; }}\n", matrix);
    }
    return text;
}

constexpr std::string_view kMain = R"(void main() {{
    ivec2 cell = ivec2(gl_FragCoord.xy);
    int n = 0;
    glint_coord = gl_FragCoord;
    if (glint_place.z > 0) {{
        n = (cell.y >> 1) * glint_place.z + (cell.x >> 1);
        glint_coord.xy = vec2(glint_place.xy + (cell & 1)) + 0.5;
    }}
    glint_id = glint_ask.x + n * glint_ask.z;
    glint_last = glint_ask.y + n * glint_ask.w;
    {}
    glint_draw();
    glint_kept = glint_bits;
    glint_told = uvec4({}, 1u);
}}
)";

}  // namespace

std::string probe_declarations(ProbeKind kind) {
    const std::string functions = kind == ProbeKind::values     ? values_functions()
                                  : kind == ProbeKind::cost     ? cost_functions()
                                  : kind == ProbeKind::rounding ? rounding_functions()
                                                                : faults_functions();
    return "uniform ivec4 glint_ask, glint_place;\nvec4 glint_coord = vec4(0.0);\n" + functions;
}

std::string probe_main(ProbeKind kind, std::size_t outputs) {
    const char* told = kind == ProbeKind::values   ? "glint_hits, glint_order, glint_tag"
                       : kind != ProbeKind::faults ? "glint_hits, 0, 0"
                                                   : "glint_found, glint_first, glint_worst";
    // Every fragment watches another site.
    const char* survey =
        kind == ProbeKind::faults
            ? "if (glint_place.w > 0) { glint_id = (glint_ask.x + cell.x + 37 * "
              "cell.y) % glint_place.w; glint_mends = glint_ask.y != 0; "
              "if (glint_ask.y == 2) { glint_scale = 7e-9; glint_inside = -0.99; } "
              "if (glint_ask.y == 3) { glint_scale = 7e9; glint_inside = 0.99; } }"
            : "";
    if (kind == ProbeKind::rounding)
        survey =
            "glint_chance = uint(glint_last) * 747796405u + uint(cell.x + 4096 * cell.y);\n"
            "    if (glint_id == -3) glint_coord.xy = "
            "uintBitsToFloat(floatBitsToUint(glint_coord.xy) "
            "+ uvec2(1));";
    return fmt::format(
               "layout(location = {}) out uvec4 glint_kept;\nlayout(location = {}) out uvec4 "
               "glint_told;\n",
               outputs, outputs + 1) +
           fmt::format(fmt::runtime(kMain), survey, told);
}

}  // namespace glint
