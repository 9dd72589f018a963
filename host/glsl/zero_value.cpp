#include "glsl/zero_value.h"

#include "glsl/condition.h"

#include <fmt/format.h>

#include <array>

namespace glint {
namespace {

// Drivers take seconds for a constructor of hundreds of numbers, and none for a loop: those are
// for places where no statement can stand.
constexpr int kMostNumbers = 1024, kMostListed = 32;

// By FirstValue.
using Scalar = std::array<std::string_view, 4>;
constexpr Scalar kFloat = {"0.", "uintBitsToFloat(0x7FC0DEADu)", "1e9", "-1e9"},
                 kInt = {"0", "0x7FC0DEAD", "1000000000", "-1000000000"},
                 kUint = {"0u", "0x7FC0DEADu", "1000000000u", "0u"},
                 kBool = {"false", "true", "true", "true"};

const Scalar* scalar_of(std::string_view type) {
    if (type == "float") return &kFloat;
    if (type == "int") return &kInt;
    if (type == "uint") return &kUint;
    if (type == "bool") return &kBool;
    return nullptr;
}

bool is_length(std::string_view digits) {
    return digits == "2" || digits == "3" || digits == "4";
}

const Scalar* scalar_of_vector(std::string_view type) {
    const std::size_t begin = type.find("vec");
    if (begin > 1 || !is_length(type.substr(begin + 3))) return nullptr;
    const std::string_view kind = type.substr(0, begin);
    if (kind.empty()) return &kFloat;
    return kind == "i" ? &kInt : kind == "u" ? &kUint : kind == "b" ? &kBool : nullptr;
}

// "mat2x3" has 2 columns of 3.
bool is_matrix(std::string_view type) {
    return type.starts_with("mat") && type.size() > 3 && is_length(type.substr(3, 1)) &&
           (type.size() == 4 ||
            (type.size() == 6 && type[4] == 'x' && is_length(type.substr(5, 1))));
}

}  // namespace

std::string basic_value(std::string_view type, FirstValue first) {
    const auto index = static_cast<std::size_t>(first);
    if (const Scalar* scalar = scalar_of(type)) return std::string((*scalar)[index]);
    if (const Scalar* scalar = scalar_of_vector(type))
        return fmt::format("{}({})", type, (*scalar)[index]);
    if (!is_matrix(type)) return "";
    if (first == FirstValue::zero) return fmt::format("{}(0)", type);
    std::string columns;
    for (char i = '0'; i < type[3]; ++i)
        columns += fmt::format("{}vec{}({})", i == '0' ? "" : ",", type.back(), kFloat[index]);
    return fmt::format("{}({})", type, columns);
}

ZeroValues::ZeroValues(const Reading& reading) : reading_(reading) {
    for (const Struct& one : reading.structs)
        if (one.name != kNone) ++struct_names_[reading.word(one.name)];
    for (const Macro& macro : reading.macros) taken_[macro.name] = true;
    for (const Declaration& declaration : reading.declarations) {
        if (declaration.scope == Scope::member) continue;
        const std::string_view type = reading.word(declaration.type);
        for (const Declarator& one : declaration.names) {
            const std::string_view name = reading.word(one.name);
            taken_[name] = true;
            if (!declaration.is_const || (type != "int" && type != "uint")) continue;
            const auto [found, is_new] = constants_.try_emplace(name, Constant{one.initial});
            found->second.is_only &= is_new;
        }
    }
}

std::string ZeroValues::made_name(std::uint32_t structure) {
    return fmt::format("glint_unnamed{}", structure);
}

bool ZeroValues::may_be_written(std::string_view word) const {
    return !taken_.contains(word);
}

std::optional<std::int64_t> ZeroValues::constant(std::string_view name, int depth) const {
    constexpr int kDeepest = 16;
    const auto found = constants_.find(name);
    if (found == constants_.end() || !found->second.is_only || depth > kDeepest) return {};
    const TokenRange value = found->second.value;
    const auto begin = reading_.tokens.begin();
    return whole_number(std::vector<Token>(begin + value.begin, begin + value.end),
                        [&](std::string_view other) { return constant(other, depth + 1); });
}

// Of `[4]` or `[N + 1]`.
std::optional<std::int64_t> ZeroValues::length(TokenRange array) const {
    if (reading_.close_of(array.begin) + 1 != array.end) return {};  // arrays of arrays
    const auto begin = reading_.tokens.begin();
    return whole_number(std::vector<Token>(begin + array.begin + 1, begin + array.end - 1),
                        [&](std::string_view name) { return constant(name, 0); });
}

// The brace within which a token stands; kNone: outside of all.
std::uint32_t ZeroValues::brace_round(std::uint32_t token) const {
    for (std::uint32_t at = token; at-- > 0;) {
        const std::string_view word = reading_.word(at);
        if (word == "{") return at;
        if (word == "}" && reading_.partner[at] != kNone) at = reading_.partner[at];
    }
    return kNone;
}

// The one that is seen from where the type is spelled: the last before it whose block it is in.
std::uint32_t ZeroValues::find_struct(std::string_view name, std::uint32_t from) const {
    std::uint32_t found = kNone;
    for (std::uint32_t i = 0; i < reading_.structs.size(); ++i) {
        const Struct& one = reading_.structs[i];
        if (one.name == kNone || reading_.word(one.name) != name) continue;
        if (one.tokens.begin > from) break;
        const std::uint32_t open = one.function == kNone ? kNone : brace_round(one.tokens.begin);
        if (open == kNone || from < reading_.close_of(open)) found = i;
    }
    return found;
}

std::uint32_t ZeroValues::struct_of(const SpelledType& type) const {
    if (type.structure != kNone) return type.structure;
    const std::uint32_t structure = find_struct(reading_.word(type.type), type.type);
    // One that holds itself is none; of two of which a branch decides nobody knows which is meant.
    if (structure != kNone && struct_names_.at(reading_.word(type.type)) > 1 &&
        reading_.live_at(reading_.place(reading_.structs[structure].tokens.begin).begin) !=
            Live::yes)
        return kNone;
    const bool is_whole = structure != kNone && reading_.structs[structure].tokens.end <= type.type;
    return is_whole ? structure : kNone;
}

SpelledType ZeroValues::type_of(const Declaration& member, const Declarator& declarator) {
    return {.type = member.type,
            .structure = member.structure,
            .array = declarator.array,
            .type_array = member.type_array};
}

std::optional<std::string> ZeroValues::of_struct(std::uint32_t structure, FirstValue first,
                                                 int& room) const {
    const Struct& one = reading_.structs[structure];
    std::string name = made_name(structure), members;
    if (one.name != kNone) {
        name = reading_.word(one.name);
        if (!may_be_written(name) || struct_names_.at(name) > 1) return {};
    }
    for (const std::uint32_t index : one.members) {
        const Declaration& member = reading_.declarations[index];
        for (const Declarator& declarator : member.names) {
            const auto value = whole(type_of(member, declarator), first, room);
            if (!value) return {};
            members += (members.empty() ? "" : ",") + *value;
        }
    }
    if (members.empty()) return {};
    return name + "(" + members + ")";
}

std::optional<std::string> ZeroValues::element(const SpelledType& type, FirstValue first,
                                               int& room) const {
    if (--room < 0) return {};
    const std::string_view name = reading_.word(type.type);
    if (!may_be_written(name)) return {};
    if (std::string value = basic_value(name, first); !value.empty()) return value;
    const std::uint32_t structure = struct_of(type);
    if (structure == kNone) return {};
    return of_struct(structure, first, room);
}

std::optional<std::string> ZeroValues::whole(const SpelledType& type, FirstValue first,
                                             int& room) const {
    if (type.array.empty() && type.type_array.empty()) return element(type, first, room);
    if (!type.array.empty() && !type.type_array.empty()) return {};
    const auto size = length(type.array.empty() ? type.type_array : type.array);
    if (!size || *size < 1 || *size > kMostNumbers) return {};
    const int before = room;
    const auto value = element(type, first, room);
    room = before - (before - room) * static_cast<int>(*size);
    if (!value || room < 0) return {};
    std::string values = *value;
    for (std::int64_t i = 1; i < *size; ++i) values += "," + *value;
    const std::string name =
        type.type == kNone ? made_name(type.structure) : std::string(reading_.word(type.type));
    return fmt::format("{}[{}]({})", name, *size, values);
}

bool ZeroValues::set_parts(std::string& words, const std::string& what, const SpelledType& type,
                           FirstValue first, int depth) const {
    constexpr int kDeepest = 16;
    if (depth > kDeepest) return false;
    int room = kMostListed;
    if (const auto value = whole(type, first, room)) {
        words += fmt::format(" {} = {};", what, *value);
        return true;
    }
    if (!type.array.empty() || !type.type_array.empty()) {
        const TokenRange array = type.array.empty() ? type.type_array : type.array;
        const bool is_simple = reading_.close_of(array.begin) + 1 == array.end && array.size() > 2;
        if (!is_simple || (!type.array.empty() && !type.type_array.empty())) return false;
        SpelledType element = type;
        element.array = element.type_array = {};
        const std::string index = fmt::format("glint_part{}", depth);
        words += fmt::format(" for (int {0} = 0; {0} < int({1}.length()); ++{0}) {{", index, what);
        const std::string part = fmt::format("{}[{}]", what, index);
        if (!set_parts(words, part, element, first, depth + 1)) return false;
        words += " }";
        return true;
    }
    const std::uint32_t structure = struct_of(type);
    if (structure == kNone) return false;
    const Struct& one = reading_.structs[structure];
    for (const std::uint32_t index : one.members) {
        const Declaration& member = reading_.declarations[index];
        for (const Declarator& declarator : member.names) {
            const std::string_view name = reading_.word(declarator.name);
            if (reading_.defines_macro(name)) return false;
            if (!set_parts(words, fmt::format("{}.{}", what, name), type_of(member, declarator),
                           first, depth + 1))
                return false;
        }
    }
    return !one.members.empty();
}

std::optional<std::string> ZeroValues::statements(const std::string& what, const SpelledType& type,
                                                  FirstValue first) const {
    const std::array<std::string_view, 4> used = {"int", "length", "glint_part0", what};
    for (const std::string_view name : used)
        if (reading_.defines_macro(name)) return {};
    if (taken_.contains("glint_part0")) return {};
    std::string words;
    if (!set_parts(words, what, type, first, 0)) return {};
    return words;
}

std::optional<std::string> ZeroValues::value(const SpelledType& type, FirstValue first) const {
    int room = kMostNumbers;
    return whole(type, first, room);
}

bool ZeroValues::is_long(const SpelledType& type) const {
    int room = kMostListed;
    return !whole(type, FirstValue::zero, room);
}

}  // namespace glint
