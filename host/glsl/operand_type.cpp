#include "glsl/operand_type.h"

#include "glsl/operands.h"
#include "glsl/probe_types.h"

#include <fmt/format.h>

namespace glint {
namespace {

// The struct that this name is of in a function's body.
std::uint32_t struct_named(const Reading& reading, std::string_view name, std::uint32_t function) {
    std::uint32_t global = kNone;
    for (std::uint32_t i = 0; i < reading.structs.size(); ++i) {
        const Struct& one = reading.structs[i];
        if (one.name == kNone || reading.word(one.name) != name) continue;
        if (one.function == function) return i;
        if (one.function == kNone) global = i;
    }
    return global;
}

class Resolver {
public:
    Resolver(const Reading& reading, const Variables& variables, std::uint32_t function)
        : reading_(reading), variables_(variables), function_(function) {}

    std::optional<OperandType> of(TokenRange operand) const {
        operand = without_parentheses(reading_, operand);
        if (operand.empty() || !reading_.tokens[operand.begin].is_word()) return std::nullopt;
        std::uint32_t at = operand.begin + 1;
        const bool is_call = at < operand.end && reading_.tokens[at].is("(");
        auto type = is_call ? of_call(operand.begin) : of_variable(operand.begin);
        if (is_call) at = reading_.close_of(at) + 1;
        while (type && at < operand.end) {
            const Token& token = reading_.tokens[at];
            if (token.is("[") && reading_.close_of(at) != kNone) {
                type = element_of(*type);
                at = reading_.close_of(at) + 1;
            } else if (token.is(".") && at + 1 < operand.end) {
                type = member_of(*type, reading_.word(at + 1));
                at += 2;
            } else {
                return std::nullopt;
            }
        }
        return type;
    }

private:
    OperandType declared(std::uint32_t type, TokenRange array, TokenRange type_array) const {
        const std::string_view name = reading_.word(type);
        return {std::string(name), struct_named(reading_, name, function_),
                bracket_pairs(reading_, array) + bracket_pairs(reading_, type_array)};
    }

    std::optional<OperandType> of_variable(std::uint32_t name) const {
        const auto found = variables_.find(name, function_);
        if (!found.declaration) return std::nullopt;
        return declared(found.declaration->type, found.name->array, found.declaration->type_array);
    }

    // Of the text's own functions, all of that name being of one type, or a constructor.
    std::optional<OperandType> of_call(std::uint32_t name) const {
        std::optional<OperandType> type;
        for (const std::uint32_t index : reading_.functions_named(reading_.word(name))) {
            const Function& one = reading_.functions[index];
            const OperandType its = declared(one.type, {}, one.type_array);
            if (type && (type->name != its.name || type->lengths != its.lengths))
                return std::nullopt;
            type = its;
        }
        if (type) return type;
        const OperandType made = declared(name, {}, {});
        const bool is_type = made.structure != kNone || probe_type_of(made.name) >= 0 ||
                             matrix_columns(made.name) > 0;
        return is_type ? std::optional(made) : std::nullopt;
    }

    static std::optional<OperandType> element_of(OperandType type) {
        if (type.lengths > 0) return --type.lengths, type;
        if (type.structure != kNone) return std::nullopt;
        if (matrix_columns(type.name) > 0)
            return OperandType{fmt::format("vec{}", matrix_rows(type.name))};
        return part_of(type, 1);
    }

    // Of a vector: so many of its components.
    static std::optional<OperandType> part_of(const OperandType& type, std::size_t count) {
        const std::size_t vec = type.name.find("vec");
        if (vec == type.name.npos || count < 1 || count > 4) return std::nullopt;
        const std::string kind = type.name.substr(0, vec);
        if (count > 1) return OperandType{fmt::format("{}vec{}", kind, count)};
        return OperandType{kind == "i"   ? "int"
                           : kind == "u" ? "uint"
                           : kind == "b" ? "bool"
                                         : "float"};
    }

    std::optional<OperandType> member_of(const OperandType& type, std::string_view name) const {
        if (type.lengths > 0) return std::nullopt;
        if (type.structure == kNone) return part_of(type, name.size());
        for (const std::uint32_t index : reading_.structs[type.structure].members) {
            const Declaration& member = reading_.declarations[index];
            for (const Declarator& one : member.names)
                if (reading_.word(one.name) == name)
                    return declared(member.type, one.array, member.type_array);
        }
        return std::nullopt;
    }

    const Reading& reading_;
    const Variables& variables_;
    std::uint32_t function_;
};

}  // namespace

std::optional<OperandType> type_of_operand(const Reading& reading, const Variables& variables,
                                           TokenRange operand, std::uint32_t function) {
    return Resolver(reading, variables, function).of(operand);
}

}  // namespace glint
