#include "glsl/probe_types.h"

#include "glsl/fault_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace glint {
namespace {

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
    const auto found = std::ranges::find(kProbeTypes, type);
    return found == kProbeTypes.end() ? -1 : static_cast<int>(found - kProbeTypes.begin());
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
    return type < kProbeTypes.size() ? kProbeTypes[type] : "";
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
    for (std::size_t i = 0; i < kProbeTypes.size(); ++i) {
        text += fmt::format(
            "bool glint0_l(int i, int tag, {0} v) {{ if (glint0_keeps(i, tag)) glint0_bits.{1} = "
            "{2}; "
            "return true; }}\n{0} glint0_v(int i, {0} v) {{ glint0_l(i, {3}, v); return v; }}\n",
            kProbeTypes[i], swizzle(length_of_type(i)), bits(i, "v"), i);
        text += fmt::format("{0} glint0_then({0} v, bool noted) {{ return v; }}\n", kProbeTypes[i]);
        if (i < 12)
            text += fmt::format(
                "{0} glint0_w(int i, {0} v, {0} now) {{ glint0_l(i, {1}, now); return v; }}\n",
                kProbeTypes[i], i);
    }
    for (const std::string_view matrix : kProbeMatrices) {
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
    for (std::size_t i = 4; i < kProbeTypes.size(); ++i)
        text += fmt::format("{0} glint0_v(int i, {0} v) {{ return v; }}\n", kProbeTypes[i]);
    for (const std::string_view matrix : kProbeMatrices) {
        text += fmt::format("{0} glint0_v(int i, {0} v) {{ ", matrix);
        for (int c = 0; c < matrix_columns(matrix); ++c)
            text += fmt::format("v[{0}] = glint0_v(i, v[{0}]); ", c);
        text += "return v; }\n";
    }
    return text;
}

std::string functions_of(ProbeKind kind) {
    switch (kind) {
        case ProbeKind::values:
            return values_functions();
        case ProbeKind::cost:
            return cost_functions();
        case ProbeKind::faults:
            return fault_functions();
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
