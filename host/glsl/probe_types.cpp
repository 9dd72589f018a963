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
// Containers of arrays: eight times the length, and the columns of a matrix; of arrays of structs:
// the struct and, in its lowest bits, the length.
constexpr int kFirstArray = 1 << 16, kFirstStructArray = 1 << 22, kMostElements = 64;
constexpr int kLengthBits = 10;

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
    if (container >= kFirstStructArray) {
        const int length = (container - kFirstStructArray) % (1 << kLengthBits);
        const auto structure =
            static_cast<std::size_t>((container - kFirstStructArray) >> kLengthBits);
        for (int i = 0; i < std::min(length, kMostElements); ++i)
            for (const std::string& leaf : probed.structs.at(structure))
                leaves.push_back(fmt::format("[{}]{}", i, leaf));
    } else if (container >= kFirstArray) {
        const int length = std::min((container - kFirstArray) / 8, kMostElements);
        const int columns = (container - kFirstArray) % 8;
        for (int i = 0; i < length; ++i) {
            if (columns == 0) leaves.push_back(fmt::format("[{}]", i));
            for (int c = 0; c < columns; ++c) leaves.push_back(fmt::format("[{}][{}]", i, c));
        }
    } else if (container >= kProbeFirstStruct) {
        const auto structure = static_cast<std::size_t>(container - kProbeFirstStruct);
        if (structure < probed.structs.size()) leaves = probed.structs[structure];
    } else {
        for (int column = 0; column < 2 + (container - 1) / 3; ++column)
            leaves.push_back(fmt::format("[{}]", column));
    }
    return leaves;
}

// Of an array an element alone is taken hold of: that which is asked for.
std::string array_record(std::size_t site, const std::string& name, std::string_view type) {
    const int columns = matrix_columns(type), cut = std::max(columns, 1);
    const int simple =
        columns > 0 ? probe_type_of(fmt::format("vec{}", matrix_rows(type))) : probe_type_of(type);
    if (simple < 0) return {};
    const std::string at = fmt::format("(glint0_id>>{})", kProbeLeafShift);
    const std::string element =
        columns > 0 ? fmt::format("[{0}/{1}][{0}%{1}]", at, columns) : fmt::format("[{}]", at);
    return fmt::format(
        "(glint0_has({0},{1}.length()*{2})&&glint0_l(glint0_id,{3}+({1}.length()<<{4}),{1}{5}))",
        site, name, cut, simple | (kFirstArray + columns) << kProbeContainerShift,
        kProbeContainerShift + 3, element);
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

std::string StructTypes::record(std::uint32_t structure, const std::string& site,
                                const std::string& value) const {
    std::vector<Leaf> leaves;
    if (!add_leaves(structure, "", 0, leaves)) return {};
    const int container = kProbeFirstStruct + static_cast<int>(structure);
    std::string text;
    for (std::size_t i = 0; i < leaves.size(); ++i)
        text +=
            fmt::format("{}glint0_l({}+{},{},{}{})", i > 0 ? "," : "", site, i << kProbeLeafShift,
                        probe_type_of(leaves[i].type) | container << kProbeContainerShift, value,
                        leaves[i].path);
    return text;
}

std::string StructTypes::array_record(std::uint32_t structure, std::size_t site,
                                      const std::string& name) const {
    std::vector<Leaf> leaves;
    if (!add_leaves(structure, "", 0, leaves) || leaves.empty()) return {};
    const std::string at = fmt::format("(glint0_id>>{})", kProbeLeafShift);
    const int container = kFirstStructArray + (static_cast<int>(structure) << kLengthBits);
    std::string text = fmt::format("(glint0_has({},{}.length()*{})&&(", site, name, leaves.size());
    for (std::size_t i = 0; i < leaves.size(); ++i)
        text += fmt::format(
            "{}{}%{}=={}&&glint0_l(glint0_id,{}+(min({}.length(),{})<<{}),{}[{}/{}]{})",
            i > 0 ? "||" : "", at, leaves.size(), i,
            probe_type_of(leaves[i].type) | container << kProbeContainerShift, name,
            (1 << kLengthBits) - 1, kProbeContainerShift, name, at, leaves.size(), leaves[i].path);
    return text + "))";
}

std::string StructTypes::overloads(std::uint32_t structure, ProbeKind kind) const {
    std::vector<Leaf> leaves;
    const Struct& one = reading_.structs[structure];
    if (one.name == kNone) return {};
    std::string text;
    const bool is_returned = std::ranges::any_of(reading_.functions, [&](const Function& function) {
        return reading_.word(function.type) == reading_.word(one.name);
    });
    if (kind == ProbeKind::values && is_returned)  // one with a sampler cannot be
        text =
            fmt::format("{0} glint0_then({0} v,bool noted){{return v;}} ", reading_.word(one.name));
    if (!add_leaves(structure, "", 0, leaves) || leaves.empty()) return text;
    text += fmt::format("{0} glint0_v(int i,{0} v){{", reading_.word(one.name));
    if (kind == ProbeKind::values) return text + record(structure, "i", "v") + ";return v;}";
    for (const Leaf& leaf : leaves) text += fmt::format("glint0_v(i,v{});", leaf.path);
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

constexpr std::string_view kValues =
    R"(int glint0_id = 0, glint0_last = 0, glint0_hits = 0, glint0_events = 0, glint0_order = 0, glint0_tag = 0;
uvec4 glint0_bits = uvec4(0);
bool glint0_has(int i, int count) {
    bool is_asked = (glint0_id & 65535) == i && (glint0_id >> 16) < count;
    glint0_events += int(!is_asked);
    return is_asked;
}
bool glint0_keeps(int i, int tag) {
    ++glint0_events;
    bool here = i == glint0_id;
    glint0_hits += int(here);
    here = here && glint0_hits <= glint0_last;
    if (here) { glint0_tag = tag; glint0_order = glint0_events; }
    return here;
}
)";

std::string values_functions() {
    std::string text(kValues);
    text += fmt::format("void glint0_r(int i) {{ glint0_keeps(i, {}); }}\n", kProbeReached);
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
        text += fmt::format(
            "bool glint0_l(int i, int tag, {0} v) {{ if (glint0_keeps(i, tag)) glint0_bits.{1} = "
            "{2}; "
            "return true; }}\n{0} glint0_v(int i, {0} v) {{ glint0_l(i, {3}, v); return v; }}\n",
            kTypes[i], swizzle(length_of_type(i)), bits(i, "v"), i);
        text += fmt::format("{0} glint0_then({0} v, bool noted) {{ return v; }}\n", kTypes[i]);
        if (i < 12)
            text += fmt::format(
                "{0} glint0_w(int i, {0} v, {0} now) {{ glint0_l(i, {1}, now); return v; }}\n",
                kTypes[i], i);
    }
    for (const std::string_view matrix : kMatrices) {
        text += fmt::format("{0} glint0_v(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format(
                "glint0_l(i + {}, {}, v[{}]); ", c << kProbeLeafShift,
                (matrix_rows(matrix) - 1) | matrix_number(matrix) << kProbeContainerShift, c);
        text += fmt::format(
            "return v; }}\n{0} glint0_w(int i, {0} v, {0} now) {{ glint0_v(i, now); return v; "
            "}}\n{0} glint0_then({0} v, bool noted) {{ return v; }}\n",
            matrix);
    }
    return text;
}

std::string cost_functions() {
    std::string text =
        "int glint0_id = 0, glint0_last = 0, glint0_hits = 0;\n"
        "uvec4 glint0_bits = uvec4(0);\n"
        "void glint0_n(int i, int kind) { glint0_hits += int(i == glint0_id); "
        "++glint0_bits[kind]; }\n";
    for (const char* type : {"float", "vec4", "ivec4", "uvec4"})
        text += fmt::format("{0} glint0_n(int i, {0} v) {{ glint0_n(i, 1); return v; }}\n", type);
    return text;
}

constexpr std::string_view kFaults =
    R"(int glint0_id = 0, glint0_last = 0, glint0_found = 0, glint0_first = 0, glint0_worst = 0, glint0_divided = -1;
bool glint0_mends = false;
float glint0_scale = 7.0, glint0_inside = 0.37;
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
    return glint0_mends && is_nan ? 0.05 * glint0_scale : v;
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
    return glint0_mends && is_none ? 0.05 * glint0_scale : v;
}
float glint0_q(int i, float v) { return glint0_q(i, v, glint0_divisor.x); }
int glint0_d(int i, int b) { glint0_f(i, b == 0, uint(b), 0u); glint0_u(i, b == 0, uint(b), abs(float(b))); return b; }
uint glint0_d(int i, uint b) { glint0_f(i, b == 0u, b, 0u); glint0_u(i, b == 0u, b, float(b)); return b; }
int glint0_by(int i, int b) {
    glint0_f(i, b <= 0, uint(b), 0u);
    glint0_u(i, b <= 0, uint(b), b == 0 ? 0.0 : 3e38);
    return glint0_mends && b < 0 ? int(glint0_scale) : b;
}
uint glint0_by(int i, uint b) { return glint0_d(i, b); }
int glint0_rest(int i, int a) {
    glint0_f(i, a < 0, uint(a), 0u);
    glint0_u(i, a < 0, uint(a), 3e38);
    return glint0_mends && a < 0 ? int(glint0_scale) : a;
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
    glint0_u(i, at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y, uint(at.x), 3e38);
    return glint0_mends ? clamp(at, ivec2(0), size - 1) : at;
}
ivec3 glint0_t(int i, ivec3 at, ivec3 size) { return at; }
float glint0_to_int(int i, float v) {
    bool is_out = !(abs(v) < 2147483648.0);
    glint0_f(i, is_out, v);
    glint0_u(i, is_out, v, 2147483648.0 - abs(v));
    return glint0_mends && is_out ? min(glint0_scale, 2e9) : v;
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

// A result that is rounded may as well be the next float above or below. What ends in twelve zeros,
// as whole numbers and their halves do, is taken for exact. glint0_id: the site, -1 for all, -2 for
// none; -3 moves the pixels themselves.
constexpr std::string_view kRounding =
    R"(int glint0_id = 0, glint0_last = 0, glint0_hits = 0;
uvec4 glint0_bits = uvec4(0);
uint glint0_chance = 0u;
float glint0_v(int i, float v) {
    uint bits = floatBitsToUint(v), power = bits & 0x7F800000u;
    if ((glint0_id != i && glint0_id != -1) || power == 0u || power == 0x7F800000u || (bits & 0xFFFu) == 0u) return v;
    ++glint0_hits;
    glint0_chance = glint0_chance * 747796405u + 2891336453u;
    uint word = ((glint0_chance >> ((glint0_chance >> 28u) + 4u)) ^ glint0_chance) * 277803737u;
    return uintBitsToFloat((word >> 30u) % 2u == 0u ? bits - 1u : bits + 1u);
}
vec2 glint0_v(int i, vec2 v) { return vec2(glint0_v(i, v.x), glint0_v(i, v.y)); }
vec3 glint0_v(int i, vec3 v) { return vec3(glint0_v(i, v.xy), glint0_v(i, v.z)); }
vec4 glint0_v(int i, vec4 v) { return vec4(glint0_v(i, v.xy), glint0_v(i, v.zw)); }
)";

std::string rounding_functions() {
    std::string text(kRounding);
    for (std::size_t i = 4; i < kTypes.size(); ++i)
        text += fmt::format("{0} glint0_v(int i, {0} v) {{ return v; }}\n", kTypes[i]);
    for (const std::string_view matrix : kMatrices) {
        text += fmt::format("{0} glint0_v(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format("v[{0}] = glint0_v(i, v[{0}]); ", c);
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
    {{"pow", "a < 0.0 || (a == 0.0 && b <= 0.0)", "a < 0.0 || (a == 0.0 && b == 0.0)", "a",
      "max(v, -glint0_scale * v) + glint0_scale * (1.0 - step(1e-30, abs(v) + abs(w))), "
      "w + (1.0 - step(1e-30, abs(v) + abs(w)))"},
     {"mod", "b == 0.0", "b == 0.0", "abs(b)", "v, w + 1.0"},
     {"atan", "a == 0.0 && b == 0.0", "a == 0.0 && b == 0.0", "3e38",
      "v + glint0_scale, w + 1.0"}}};

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
    for (std::size_t i = 4; i < kTypes.size(); ++i)
        for (const char* name : {"v", "q", "to_int", "to_uint"})
            text += fmt::format("{0} glint0_{1}(int i, {0} v) {{ return v; }}\n", kTypes[i], name);
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
    // `v %= by`, where v is looked at.
    for (const std::string one : {"int", "uint"})
        for (int n = 1; n <= 4; ++n) {
            const std::string type = n == 1 ? one : fmt::format("{}vec{}", one[0], n);
            for (int k = 0; k < (n == 1 ? 1 : 2); ++k)
                text += fmt::format(
                    "{0} glint0_rest(int i, {0} by, {1} v) {{ glint0_rest(i, v); return by; }}\n",
                    k == 0 ? type : one, type);
        }
    for (const std::string_view matrix : kMatrices) {
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
    for (const std::string_view matrix : kMatrices) {
        text += fmt::format("{0} glint0_m(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format("glint0_m(i, v[{}]); ", c);
        text += "return v; }\n";
    }
    return text;
}

std::string faults_functions() {
    std::string text(kFaults);
    for (int n = 1; n <= 4; ++n) {
        const std::string type = kTypes[static_cast<std::size_t>(n) - 1];
        if (n > 1) {
            text += fmt::format(
                "{0} glint0_d(int i, {0} v) {{ {1}glint0_divisor.{2} = v; return v; }}\n"
                "{0} glint0_q(int i, {0} v) {{ {3}return v; }}\n",
                type, for_each(n, "glint0_d(i, v{of}); "),
                std::string_view("xyzw").substr(0, static_cast<std::size_t>(n)),
                for_each(n, "v{of} = glint0_q(i, v{of}, glint0_divisor{of}); "));
            for (const char* name : {"v", "to_int", "to_uint"})
                text += fmt::format(
                    "{0} glint0_{1}(int i, {0} v) {{ {2}return v; }}\n", type, name,
                    for_each(n, fmt::format("v{{of}} = glint0_{}(i, v{{of}}); ", name)));
        }
        for (const Domain& one : kOne)
            text += fmt::format(
                "void glint0_is_{0}(int i, {1} v) {{ {2}}}\n{1} glint0_{0}(int i, {1} v) {{ "
                "glint0_is_{0}(i, v); if (glint0_mends) v = {3}; return {0}(v); }}\n",
                one.name, type,
                for_each(n, fmt::format("{{{{ float a = v{{of}}; glint0_f(i, {}, a); "
                                        "glint0_u(i, {}, a, {}); }}}} ",
                                        one.is_wrong, one.is_undefined, one.off)),
                one.mended);
        for (const Domain& one : kTwo)
            for (const bool is_scalar : {false, true}) {
                if (is_scalar && (n == 1 || one.name != std::string_view("mod"))) continue;
                text += fmt::format(
                    "{1} glint0_{0}(int i, {1} v, {3} w) {{ bool was = glint0_worst != 0; "
                    "{2}return glint0_mends && !was && glint0_worst == i + 1 ? {0}({4}) : {0}(v, "
                    "w); "
                    "}}\n",
                    one.name, type,
                    for_each(n, fmt::format("{{{{ float a = v{{of}}, b = w{}; glint0_f(i, {}, a, "
                                            "b); glint0_u(i, {}, a, {}); }}}} ",
                                            is_scalar ? "" : "{of}", one.is_wrong, one.is_undefined,
                                            one.off)),
                    is_scalar ? "float" : type, one.mended);
            }
        text += fmt::format(
            "{0} glint0_normalize(int i, {0} v) {{ float a = length(v); glint0_f(i, dot(v, v) == "
            "0.0, "
            "a); glint0_u(i, a == 0.0, a, a); return normalize(glint0_mends && a == 0.0 ? v + 1.0 "
            ": "
            "v); }}\n",
            type);
    }
    for (const char* matrix : {"mat2", "mat3", "mat4"})
        text += fmt::format(
            "{0} glint0_inverse(int i, {0} v) {{ float a = determinant(v); glint0_f(i, a == 0.0, "
            "a); glint0_u(i, a == 0.0, a, abs(a)); return inverse(glint0_mends && a == 0.0 ? v + "
            "{0}(glint0_scale) : v); }}\n",
            matrix);
    return text + faults_of_all_bounds() + faults_of_other_types() + faults_of_marks();
}

std::string functions_of(ProbeKind kind) {
    switch (kind) {
        case ProbeKind::values:
            return values_functions();
        case ProbeKind::cost:
            return cost_functions();
        case ProbeKind::faults:
            return faults_functions();
        case ProbeKind::rounding:
            return rounding_functions();
        case ProbeKind::assertions:
            return "int glint0_id = 0, glint0_last = 0; uvec4 glint0_bits = uvec4(0u);\n"
                   "void glint0_a(int i, bool holds) { if (!holds) glint0_bits[i >> 5] |= 1u << (i "
                   "& 31); }\n";
    }
    return "";
}

}  // namespace

std::string probe_declarations(ProbeKind kind) {
    return "uniform ivec4 glint0_ask, glint0_place;\nvec4 glint0_coord = vec4(0.0);\n" +
           functions_of(kind);
}

}  // namespace glint
