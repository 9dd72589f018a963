#include "glsl/probe_record.h"

#include "glsl/operand_type.h"
#include "glsl/operands.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace glint {

// A name with members and indices that can be evaluated once more: without a call of the text's.
bool ProbeRecords::is_variable(TokenRange range) const {
    if (range.empty() || !reading_.tokens[range.begin].is_word()) return false;
    for (std::uint32_t at = range.begin; at < range.end; ++at) {
        const Token& one = reading_.tokens[at];
        if (one.is("++") || one.is("--") || is_assignment(one)) return false;
        if (one.is("(") && !reading_.functions_named(reading_.word(at - 1)).empty()) return false;
    }
    return operand_end(reading_, range.begin, range.end) == range.end;
}

// Which nothing is overloaded for.
bool ProbeRecords::is_whole_array(TokenRange range, std::uint32_t function) const {
    const auto type = type_of_operand(reading_, variables_, range, function);
    return type && type->lengths > 0;
}

// Into structs: that of this variable or element, where no function takes it, since the function
// itself declares it, or not all of it can be told.
std::uint32_t ProbeRecords::bare_struct_of(TokenRange range, std::uint32_t function) const {
    for (std::uint32_t at = range.begin; at < range.end; ++at)
        if (reading_.tokens[at].is(".")) return kNone;
    const auto type = type_of_operand(reading_, variables_, range, function);
    if (!type || type->structure == kNone) return kNone;
    const std::uint32_t structure = type->structure;
    const bool is_bare =
        reading_.structs[structure].function != kNone || structs_.leaves(structure).empty();
    return is_bare ? structure : kNone;
}

// `glint0_v(8,t)`, of a variable that has its value; "" where that cannot be told.
std::string ProbeRecords::record_of(std::size_t site, TokenRange variable,
                                    std::uint32_t function) const {
    const std::string name = reading_.spelled(variable);
    if (!is_told_behind(variable, function)) return fmt::format("glint0_v({},{})", site, name);
    if (!is_whole_array(variable, function))
        return structs_.record(bare_struct_of(variable, function), std::to_string(site), name);
    const auto type = type_of_operand(reading_, variables_, variable, function);
    if (type->lengths != 1 || !is_variable(variable)) return {};
    return type->structure == kNone ? array_record(site, name, type->name)
                                    : structs_.array_record(type->structure, site, name);
}

// Whether it is the same element behind a call that hands out these, or changes globals.
bool ProbeRecords::is_steady(TokenRange variable, const std::vector<TokenRange>& outs,
                             std::uint32_t function) const {
    for (std::uint32_t at = variable.begin + 1; at < variable.end; ++at) {
        if (!reading_.tokens[at].is_word() || reading_.tokens[at - 1].is(".")) continue;
        const auto found = variables_.find(at, function);
        if (!found.declaration) continue;
        if (found.declaration->scope == Scope::global && !found.declaration->is_const &&
            !found.declaration->is_uniform)
            return false;
        if (std::ranges::any_of(outs, [&](TokenRange out) {
                return reading_.word(out.begin) == reading_.word(at);
            }))
            return false;
    }
    return true;
}

}  // namespace glint
