#include "render/advice.h"

#include "base/diagnostic.h"
#include "glsl/remainder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <span>
#include <utility>

namespace glint {
namespace {

using Foreign = std::pair<std::string_view, std::string_view>;

// Of HLSL, Metal, WGSL and languages that are none of shaders.
constexpr Foreign kTypes[] = {
    {"float1", "float"},  {"float2", "vec2"},   {"float3", "vec3"},
    {"float4", "vec4"},   {"half", "float"},    {"half2", "vec2"},
    {"half3", "vec3"},    {"half4", "vec4"},    {"int2", "ivec2"},
    {"int3", "ivec3"},    {"int4", "ivec4"},    {"uint2", "uvec2"},
    {"uint3", "uvec3"},   {"uint4", "uvec4"},   {"bool2", "bvec2"},
    {"bool3", "bvec3"},   {"bool4", "bvec4"},   {"float2x2", "mat2"},
    {"float3x3", "mat3"}, {"float4x4", "mat4"}, {"vec2f", "vec2"},
    {"vec3f", "vec3"},    {"vec4f", "vec4"},    {"f32", "float"},
    {"i32", "int"},       {"u32", "uint"},      {"real", "float"},
    {"scalar", "float"},  {"boolean", "bool"},  {"integer", "int"},
    {"unsigned", "uint"}, {"number", "float"},  {"Texture2D", "sampler2D"}};
constexpr std::array<std::string_view, 5> kWithoutType = {"let", "var", "auto", "def", "fn"};

constexpr Foreign kFunctions[] = {{"lerp", "mix"},
                                  {"frac", "fract"},
                                  {"saturate", "clamp(x, 0.0, 1.0)"},
                                  {"fmod", "mod"},
                                  {"atan2", "atan"},
                                  {"rsqrt", "inversesqrt"},
                                  {"ddx", "dFdx"},
                                  {"ddy", "dFdy"},
                                  {"mul", "the operator *"},
                                  {"mad", "a * b + c"},
                                  {"fma", "a * b + c"},
                                  {"rcp", "1.0 / x"},
                                  {"tex2D", "texture"},
                                  {"tex2Dlod", "textureLod"},
                                  {"texCUBE", "texture"},
                                  {"clip", "discard"},
                                  {"dist", "distance"},
                                  {"fabs", "abs"},
                                  {"fmin", "min"},
                                  {"fmax", "max"},
                                  {"powf", "pow"},
                                  {"sqrtf", "sqrt"},
                                  {"sinf", "sin"},
                                  {"cosf", "cos"},
                                  {"asfloat", "uintBitsToFloat"},
                                  {"asuint", "floatBitsToUint"},
                                  {"asint", "floatBitsToInt"}};

constexpr std::size_t kLongest = 200;  // of a complaint that is taken apart
constexpr const char* kElement = "type error in array constructor: expected: {}, found {}";
constexpr const char* kAssigned = "{} of type {} cannot be assigned to variable of type {}";

std::string found(std::span<const Foreign> list, std::string_view name) {
    const auto entry = std::ranges::find(list, name, &Foreign::first);
    return entry == list.end() ? "" : fmt::format("; GLSL's is {}", entry->second);
}

// Of arguments as the driver lists them: "(int, vec2)".
bool mixes_int_and_float(std::string_view arguments) {
    bool has_int = false, has_float = false;
    while (!arguments.empty()) {
        const std::size_t end = std::min(arguments.find_first_of("(, )"), arguments.size());
        const std::string_view type = arguments.substr(0, end);
        has_int |= type == "int";
        has_float |= type == "float" || type.starts_with("vec") || type.starts_with("mat");
        arguments.remove_prefix(std::min(end + 1, arguments.size()));
    }
    return has_int && has_float;
}

std::string said_of_method(std::string_view name) {
    // Of HLSL's textures.
    constexpr Foreign kMethods[] = {{"Sample", "texture"},
                                    {"SampleLevel", "textureLod"},
                                    {"SampleGrad", "textureGrad"},
                                    {"Load", "texelFetch"},
                                    {"GetDimensions", "textureSize"}};
    const auto* const ours = std::ranges::find(kMethods, name, &Foreign::first);
    return fmt::format("GLSL has no methods; write {}(\u2026) of what stands before the '.'",
                       ours == std::end(kMethods) ? name : ours->second);
}

// Of a call that mixes whole numbers and floats.
std::string advice_on_arguments(std::string_view call) {
    if (call.starts_with("texelFetch("))
        return "; the place is in whole texels, write ivec2(p), and the level an int";
    return fmt::format("{}2.0 for 2, or float(i)", kNoChange);
}

}  // namespace

std::string advice_on_foreign_name(std::string_view name) {
    constexpr Foreign kEscapes[] = {{"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}};
    const auto escape = std::ranges::find(kEscapes, name, &Foreign::first);
    if (escape != std::end(kEscapes))
        return fmt::format("; where &{}; stands for {} in what was copied, write that",
                           escape->first, escape->second);
    if (name == "gl_FragColor") return "; a mainImage writes its first parameter";
    if (name == "gl_FragData")
        return "; one picture is drawn: a main() writes gl_FragData[0], a mainImage its first "
               "parameter, and a buffer is a pass of its own";
    constexpr std::string_view kEmpty[] = {"None", "NULL", "null", "nullptr", "nil", "undefined"};
    if (std::ranges::find(kEmpty, name) != std::end(kEmpty))
        return "; GLSL has no empty value: write 0, 0.0 or false";
    constexpr Foreign kTruths[] = {
        {"True", "true"}, {"TRUE", "true"}, {"False", "false"}, {"FALSE", "false"}};
    if (name.starts_with("Key_") || name.starts_with("isKey"))
        return "; a line '#iKeyboard' above has it, as VS Code's Shader Toy does";
    const std::string truth = found(kTruths, name);
    return truth.empty() ? found(kFunctions, name) : truth;
}

std::string advice_on_foreign_type(std::string_view name) {
    if (std::ranges::find(kWithoutType, name) != kWithoutType.end())
        return "; write the type, such as float";
    return found(kTypes, name);
}

std::string said_better(std::string complaint) {
    // Before the list of the candidates, which says nothing to who wrote max(0, x).
    constexpr std::string_view kNoFunction = "no matching function for call to `";
    const std::size_t end = complaint.find('\'', kNoFunction.size());
    if (complaint.starts_with(kNoFunction) && end != complaint.npos &&
        mixes_int_and_float(
            std::string_view(complaint).substr(0, end).substr(std::min(complaint.find('('), end))))
        complaint.insert(end + 1, advice_on_arguments(complaint.substr(kNoFunction.size())));
    if (complaint.starts_with("no matching function for call to `mod(int, int)'"))
        complaint.insert(end + 1, "; mod is of floats; of whole numbers a % b is left");
    if (complaint.starts_with("function `mainImage' parameter `"))
        return "mainImage has to be void mainImage(out vec4 fragColor, in vec2 fragCoord)";
    if (complaint == "function `mainImage' redefined")
        complaint +=
            "; of several tabs each is a file of its own, for `glint import FOLDER`, or stands "
            "behind an #ifdef PASS_\u2026";
    if (complaint == "extra tokens at end of directive")
        complaint += "; #ifdef takes one name, #if defined(A) || defined(B) takes more";
    if (complaint.ends_with("return type doesn't match prototype"))
        complaint +=
            "; functions of one name differ in what they are given, not in what they "
            "give back";
    if (complaint.starts_with("redeclaration of `") && complaint.ends_with("' has incorrect type"))
        complaint += "; it is declared here already: give this one another name";
    if (complaint.starts_with("cannot access field `length'"))
        complaint += "; an array tells its own by .length()";
    else if (complaint.ends_with("' of non-structure / non-vector"))
        complaint += "; an array's elements have members, a[0].x, and a number has none";
    if (complaint.starts_with("operands of `") && complaint.ends_with("must have the same type"))
        complaint +=
            "; beside an int write 0, beside a float 0.0 or float(i), and vectors have one size";
    if (complaint.starts_with("A shader cannot redefine or overload built-in function `"))
        complaint += "; give yours another name";
    if (complaint.starts_with("GL_OES_shader_io_blocks"))
        return "nothing feeds this block: no vertices stand before a picture; write values of "
               "your own";
    if (complaint == "\"defined\" not followed by an identifier") return std::string(kNoName);
    if (complaint == "error index must be >= 0") return "an index must be >= 0";
    if (complaint.ends_with(" is not an lvalue")) {
        complaint.erase(complaint.size() - std::string_view(" is not an lvalue").size());
        return complaint + " gives a value back: pass a variable";
    }
    if (complaint == "function name is not an identifier")
        return "this is no function; write an operator, such as *, between it and the '(' behind "
               "it";
    if (complaint.starts_with("C-style initialization requires"))
        return "GLSL ES has no lists in braces; write the type and its values, such as "
               "float[](1.0, 2.0), or Ray(\u2026) of a struct";
    if (complaint.starts_with("length method on matrix"))
        return "an array tells its number by .length(); how long a vector is tells length(v)";
    constexpr std::string_view kNoMacro = "#define followed by a non-identifier: ";
    if (complaint.starts_with(kNoMacro))
        return fmt::format("a macro's name begins with a letter or _; {} does not",
                           in_quotes(complaint.substr(kNoMacro.size())));
    constexpr std::string_view kMethod = "unknown method: `";
    if (complaint.starts_with(kMethod))
        return said_of_method(
            complaint.substr(kMethod.size(), complaint.size() - kMethod.size() - 1));
    return complaint;
}

std::optional<std::string> said_of_remainder(std::string complaint) {
    const std::string name = std::string(kRemainder) + "(";
    if (complaint.find(name) == complaint.npos) return complaint;
    if (!complaint.starts_with("no matching function")) return std::nullopt;
    static const std::regex call(R"(\w+\(([^,()]+), ?([^,()]+)\))");
    std::smatch types;
    if (!std::regex_search(complaint, types, call)) return "type mismatch";
    const auto is_unsigned = [](const std::string& type) { return type.starts_with('u'); };
    const auto is_whole = [&](const std::string& type) {
        return type == "int" || type == "uint" || type.starts_with("ivec") ||
               type.starts_with("uvec");
    };
    const std::string left = types[1], right = types[2];
    if (left == "error" || right == "error") return "type mismatch";
    if (!is_whole(left)) return "LHS of operator % must be an integer";
    if (!is_whole(right)) return "RHS of operator % must be an integer";
    return is_unsigned(left) != is_unsigned(right)
               ? "could not implicitly convert operands to modulus (%) operator"
               : "type mismatch";
}

namespace {

// The number of a vector's components, 1 of a float; 0 of what is neither.
int count_of(std::string_view type) {
    if (type == "float") return 1;
    const bool is_vector = type.size() == 4 && type.starts_with("vec");
    return is_vector ? type[3] - '0' : 0;
}

// How a value of one type becomes one of another.
std::string advice_on_conversion(const std::string& given, const std::string& wanted) {
    const int from = count_of(given), to = count_of(wanted);
    const bool is_number = given == "int" || given == "uint" || given == "float";
    if (wanted == "void") return "; write return; alone, or another type for the function";
    if (wanted == "bool" && is_number) return "; compare it, such as x > 0";
    if (given == "bool" && (wanted == "float" || wanted == "int"))
        return fmt::format("; write {}(b)", wanted);
    if (from > 1 && to == 1) return "; take one of its components, such as .x";
    if (from > to && to > 1)
        return fmt::format("; leave components out: .{}",
                           std::string_view("xyzw").substr(0, std::size_t(to)));
    if (to > from && from > 1)
        return fmt::format("; add what is missing: {}(v{})", wanted,
                           to - from == 1 ? ", 0.0" : ", 0.0, 0.0");
    if (to > 1 && given.ends_with("vec" + std::to_string(to)))
        return fmt::format("; write {}(v)", wanted);
    return "";
}

std::string advice_on_conversion(std::string_view complaint) {
    static const std::regex said(
        R"(^(?:(?:value|initializer) of type (\w+) cannot be assigned to variable of type (\w+)|)"
        R"(`return' with wrong type (\w+), in function `\w+' returning (\w+)|)"
        R"(a value of type (\w+) cannot stand for one of type (\w+))$)");
    std::match_results<std::string_view::const_iterator> m;
    if (complaint.size() > kLongest ||
        !std::regex_match(complaint.begin(), complaint.end(), m, said))
        return "";
    return advice_on_conversion(m.str(1) + m.str(3) + m.str(5), m.str(2) + m.str(4) + m.str(6));
}

// Of "xyq'", of which not all letters are components, or not of this vector.
std::string advice_on_components(std::string_view letters) {
    letters = letters.substr(0, letters.find('\''));
    constexpr std::string_view kSets[] = {"xyzw", "rgba", "stpq"};
    const bool is_of_one = std::ranges::any_of(kSets, [&](std::string_view set) {
        return letters.find_first_not_of(set) == letters.npos;
    });
    return is_of_one ? "; a vec2 has x and y, a vec3 z as well, and a vec4 w"
                     : "; components are called by letters of one set: xyzw, rgba or stpq";
}

// Of complaints that stand alone.
constexpr Foreign kWhatToDo[] = {
    {"switch-statement expression must be scalar integer", "; write int(x)"},
    {"' must be a constant expression",
     "; leave out the const, and give it its value in a function"},
    {"arrays passed as parameters must have a declared size", ", such as float a[4]"},
    {"size mismatch for matrix multiplication", "; a mat3 is multiplied by a vec3, and so on"},
};

}  // namespace

std::string advice_on_types(std::string_view complaint) {
    constexpr std::string_view kOperands = "could not implicitly convert operands to ";
    if (complaint.starts_with(kOperands)) {
        const std::string_view sign = complaint.substr(kOperands.size());
        const auto names = [&](std::string_view part) { return sign.find(part) != sign.npos; };
        const bool is_of_bits = (names("&") && !names("&&")) || (names("|") && !names("||")) ||
                                names("^") || names("%") || names("<<") || names(">>");
        if (is_of_bits)
            return "; GLSL ES makes no int a uint by itself: write 2u for 2, or uint(i)";
        return fmt::format("{}2.0 for 2, or float(i); beside a uint, 2u or uint(i)", kNoChange);
    }
    const auto mistakes = [&](std::string_view given, std::string_view wanted) {
        return complaint == fmt::format(kTypeForAnother, given, wanted) ||
               complaint == fmt::format(kElement, wanted, given) ||
               complaint == fmt::format(kAssigned, "value", given, wanted) ||
               complaint.starts_with(fmt::format(kAssigned, "initializer", given, wanted)) ||
               (complaint.starts_with(fmt::format("`return' with wrong type {},", given)) &&
                complaint.ends_with(" returning " + std::string(wanted)));
    };
    if (mistakes("int", "uint")) return "; write 1u for 1, or uint(i)";
    if (mistakes("int", "float")) return fmt::format("{}1.0 for 1, or float(i)", kNoChange);
    if (mistakes("float", "int")) return "; write int(x)";
    if (complaint.starts_with("illegal use of reserved word `varying'") ||
        complaint.starts_with("'varying' is deprecated"))
        return "; nothing feeds it, for no vertices stand before a picture: write a value of its "
               "own, such as gl_FragCoord.xy / iResolution.xy";
    if (complaint.ends_with("of type double")) return "; write float, there is no double here";
    constexpr std::string_view kIdle[] = {"static", "inline", "extern", "public", "volatile"};
    for (const std::string_view word : kIdle)
        if (complaint == fmt::format("illegal use of reserved word `{}'", word))
            return "; leave it out, GLSL has no such word";
    if (complaint == "illegal use of reserved word `class'") return "; write struct";
    if (complaint == "illegal use of reserved word `attribute'")
        return "; a vertex shader has such, and here is the fragment shader alone";
    if (complaint == "illegal use of reserved word `sampler1D'")
        return "; a texture has rows here: write sampler2D, and read it at vec2(x, 0.5)";
    if (complaint.ends_with("HS of `^' must be an integer")) return "; a power is pow(a, b)";
    if (complaint.ends_with("of operator % must be an integer"))
        return "; of floats mod(a, b) is left";
    if (complaint.starts_with("initializer of global variable `"))
        return "; give it its value in a function";
    const auto known = std::ranges::find_if(
        kWhatToDo, [&](const Foreign& one) { return complaint.ends_with(one.first); });
    if (known != std::end(kWhatToDo)) return std::string(known->second);
    constexpr std::string_view kFew = "too few components to construct `",
                               kMask = "invalid swizzle / mask `";
    if (complaint.starts_with(kFew))
        return fmt::format("; add what is missing, such as {}(v, 0.0)",
                           complaint.substr(kFew.size(), complaint.size() - kFew.size() - 1));
    if (complaint.starts_with(kMask)) return advice_on_components(complaint.substr(kMask.size()));
    return advice_on_conversion(complaint);
}

}  // namespace glint
