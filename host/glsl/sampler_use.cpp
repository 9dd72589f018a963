#include "glsl/sampler_use.h"

#include "glsl/finding.h"
#include "glsl/operand_type.h"
#include "glsl/operands.h"
#include "glsl/probe_types.h"

#include <algorithm>
#include <array>
#include <optional>

namespace glint {
namespace {

// Their value has as many components as the largest of their arguments.
constexpr std::array<std::string_view, 26> kAsTheirArguments = {
    "abs",       "acos",  "asin",        "atan",    "ceil",  "clamp", "cos", "exp", "exp2",
    "floor",     "fract", "inversesqrt", "log",     "log2",  "max",   "min", "mix", "mod",
    "normalize", "pow",   "reflect",     "refract", "round", "sign",  "sin", "sqrt"};

class Places {
public:
    explicit Places(const Reading& reading) : reading_(reading), variables_(reading) {}

    // The components of what an expression gives: 2 to 4, or 0 where that is not known, as where a
    // matrix of another number of rows than columns may make fewer of them.
    std::size_t components(TokenRange range, std::uint32_t function, int depth = 0) const {
        constexpr int kDeepest = 16;
        if (depth > kDeepest) return 0;
        std::size_t most = 0;
        for (std::uint32_t at = range.begin; at < range.end;) {
            const std::uint32_t end = operand_end(reading_, at, range.end);
            if (end <= at) {
                ++at;  // an operator
                continue;
            }
            if (changes_length({at, end}, function)) return 0;
            most = std::max(most, of_operand({at, end}, function, depth));
            at = end;
        }
        return most;
    }

private:
    // `mat3x2`, which makes two components of three.
    bool changes_length(TokenRange operand, std::uint32_t function) const {
        const auto type = type_of_operand(reading_, variables_, operand, function);
        return type && matrix_columns(type->name) != matrix_rows(type->name);
    }

    std::size_t of_operand(TokenRange operand, std::uint32_t function, int depth) const {
        while (!operand.empty() && (is(operand.begin, "-") || is(operand.begin, "+")))
            ++operand.begin;
        if (operand.empty()) return 0;
        if (const auto type = type_of_operand(reading_, variables_, operand, function))
            return components_of(type->name);
        const std::uint32_t last = operand.end - 1;
        if (operand.end - operand.begin > 2 && is(last - 1, ".")) return reading_.word(last).size();
        if (is(operand.begin, "("))
            return reading_.close_of(operand.begin) == last
                       ? components({operand.begin + 1, last}, function, depth + 1)
                       : 0;
        const bool is_call = operand.begin < last && is(operand.begin + 1, "(") &&
                             reading_.close_of(operand.begin + 1) == last;
        if (!is_call) return 0;
        const std::string_view name = reading_.word(operand.begin);
        if (name == "cross") return 3;
        return is_one_of(name, kAsTheirArguments)
                   ? components({operand.begin + 2, last}, function, depth + 1)
                   : 0;
    }

    static std::size_t components_of(std::string_view type) {
        const std::size_t vec = type.find("vec");
        return vec == type.npos ? 0 : static_cast<std::size_t>(type.back() - '0');
    }
    bool is(std::uint32_t at, std::string_view text) const { return reading_.tokens[at].is(text); }

    const Reading& reading_;
    Variables variables_;
};

// The type of a function's parameter; nothing where functions of one name differ in it.
std::optional<std::string_view> parameter_type(const Reading& reading, std::string_view function,
                                               std::size_t index) {
    std::optional<std::string_view> type;
    for (const std::uint32_t one : reading.functions_named(function)) {
        const auto& parameters = reading.functions[one].parameters;
        if (index >= parameters.size()) continue;
        const std::string_view its = reading.word(reading.declarations[parameters[index]].type);
        if (type && *type != its) return std::nullopt;
        type = its;
    }
    return type;
}

// What a call says of the sampler that is its argument; nothing where it says nothing.
std::optional<std::string_view> said_by(const Reading& reading, const Places& places,
                                        const Call& call, std::size_t index) {
    const std::string_view name = reading.word(call.name);
    if (!reading.functions_named(name).empty()) return parameter_type(reading, name, index);
    const auto arguments = reading.arguments_of(call);
    if (index != 0 || arguments.size() < 2) return std::nullopt;
    if (name.starts_with("texture2D")) return "sampler2D";  // of older GLSL
    if (name.starts_with("texture3D")) return "sampler3D";
    if (name.starts_with("textureCube")) return "samplerCube";
    const std::size_t count = places.components(arguments[1], call.function);
    if (name == "texelFetch" || name == "texelFetchOffset")
        return count == 0 ? std::nullopt : std::optional(count == 3 ? "sampler3D" : "sampler2D");
    static constexpr std::array<std::string_view, 4> kSampling = {"texture", "textureLod",
                                                                  "textureGrad", "textureOffset"};
    if (!is_one_of(name, kSampling) || count == 0) return std::nullopt;
    return count == 3 ? "samplerCube" : "sampler2D";
}

}  // namespace

std::string_view sampler_used_as(const Reading& reading, std::string_view name) {
    const Places places(reading);
    bool is_cube = false, is_volume = false;
    for (const Call& call : reading.calls) {
        const auto arguments = reading.arguments_of(call);
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            const TokenRange argument = arguments[i];
            if (argument.end - argument.begin != 1 || reading.word(argument.begin) != name)
                continue;
            const auto said = said_by(reading, places, call, i);
            if (said == "sampler2D") return "";
            is_cube |= said == "samplerCube";
            is_volume |= said == "sampler3D";
        }
    }
    return is_volume ? "sampler3D" : is_cube ? "samplerCube" : "";
}

}  // namespace glint
