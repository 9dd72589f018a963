#include "render/own_overloads.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace glint {
namespace {

// Functions of GLSL ES 3.00, chapter 8, by what they take, and before the colon give: g stands for
// float and its vectors, i, u and b for those of int, uint and bool; f, s and w for float, int and
// uint; 2, 3, C for a sampler, p for a place in it, t for a texel there, z for its size.
struct Family {
    std::string_view signature, names;
};
constexpr Family kFamilies[] = {
    {"g:g",
     " radians degrees sin cos tan asin acos atan exp log exp2 log2 sqrt inversesqrt abs sign "
     "floor ceil fract normalize "},
    {"g:gg", " atan pow mod min max step reflect "},
    {"g:gf", " mod min max "},
    {"g:fg", " step "},
    {"g:ggg", " clamp smoothstep faceforward mix "},
    {"g:gff", " clamp "},
    {"g:ffg", " smoothstep "},
    {"g:ggf", " refract mix "},
    {"g:ggb", " mix "},
    {"f:g", " length "},
    {"f:gg", " distance dot "},
    {"i:i", " abs sign "},
    {"i:ii", " min max "},
    {"i:is", " min max "},
    {"i:iii", " clamp "},
    {"i:iss", " clamp "},
    {"u:uu", " min max "},
    {"u:uw", " min max "},
    {"u:uuu", " clamp "},
    {"u:uww", " clamp "},
    {"4:xp", " texture "},
    {"4:xpf", " texture textureLod "},
    {"4:xppp", " textureGrad "},
    {"4:xts", " texelFetch "},
    {"z:xs", " textureSize "},
};
// What a text for the web's GLSL ES 3.00 may define.
constexpr std::string_view kAllowed = " mix texture textureLod textureGrad texelFetch textureSize ";

// Of the samplers that a scene may have.
struct Sampled {
    std::string_view sampler, place, texel, size;
};
constexpr Sampled kSampled[] = {{"sampler2D", "vec2", "ivec2", "ivec2"},
                                {"sampler3D", "vec3", "ivec3", "ivec3"},
                                {"samplerCube", "vec3", "", "ivec2"}};

// Of one letter, with so many numbers, or with such a sampler; "" where there is none.
std::string type_of(char letter, int numbers, const Sampled& sampled) {
    const std::string length = std::to_string(numbers);
    const auto vector = [&](const char* scalar, const char* name) {
        return numbers == 1 ? std::string(scalar) : name + length;
    };
    switch (letter) {
        case 'g':
            return vector("float", "vec");
        case 'i':
            return vector("int", "ivec");
        case 'u':
            return vector("uint", "uvec");
        case 'b':
            return vector("bool", "bvec");
        case 'f':
            return "float";
        case 's':
            return "int";
        case 'w':
            return "uint";
        case 'x':
            return std::string(sampled.sampler);
        case 'p':
            return std::string(sampled.place);
        case 't':
            return std::string(sampled.texel);
        case 'z':
            return std::string(sampled.size);
        default:
            return "vec4";
    }
}

using Types = std::vector<std::string>;

// A function of another name that calls the known one.
std::string wrapped(std::string_view name, const std::string& result, const Types& types) {
    std::string parameters, arguments;
    for (std::size_t i = 0; i < types.size(); ++i) {
        const char* comma = i > 0 ? ", " : "";
        parameters += fmt::format("{}{} a{}", comma, types[i], i);
        arguments += fmt::format("{}a{}", comma, i);
    }
    return fmt::format("{0} glint_{1}({2}) {{ return {1}({3}); }}\n", result, name, parameters,
                       arguments);
}

Types types_of(const Reading& reading, const Function& function) {
    Types types;
    for (const std::uint32_t parameter : function.parameters)
        types.emplace_back(reading.word(reading.declarations[parameter].type));
    return types;
}

// All of this name that the text does not define itself.
std::string wrapped_all(std::string_view name, std::set<Types> taken) {
    std::string text;
    const std::string word = fmt::format(" {} ", name);
    for (const Family& family : kFamilies) {
        if (family.names.find(word) == family.names.npos) continue;
        const bool is_sampled = family.signature.find('x') != family.signature.npos;
        const int count = is_sampled ? static_cast<int>(std::size(kSampled)) : 4;
        for (int k = 0; k < count; ++k) {
            const Sampled& sampled = kSampled[is_sampled ? k : 0];
            Types types;
            for (const char letter : family.signature.substr(2))
                types.push_back(type_of(letter, k + 1, sampled));
            const bool is_whole = std::ranges::find(types, "") == types.end();
            if (is_whole && taken.insert(types).second)
                text += wrapped(name, type_of(family.signature.front(), k + 1, sampled), types);
        }
    }
    return text;
}

// `a.length()`: a macro would take it for the function.
bool asks_for_lengths(const Reading& reading) {
    const auto& tokens = reading.written;
    for (std::size_t i = 1; i < tokens.size(); ++i)
        if (tokens[i].is("length") && tokens[i - 1].is(".")) return true;
    return false;
}

// GLSL ES 1.00 and desktop GLSL, which have a main(), allow all names.
bool is_allowed(const Reading& reading, std::string_view name) {
    const std::string word = fmt::format(" {} ", name);
    if (kAllowed.find(word) != kAllowed.npos) return true;
    if (reading.functions_named("main").empty() || (name == "length" && asks_for_lengths(reading)))
        return false;
    return std::ranges::any_of(kFamilies, [&](const Family& family) {
        return family.names.find(word) != family.names.npos;
    });
}

}  // namespace

std::string own_overloads(const Reading& reading) {
    std::string functions, macros;
    std::set<std::string_view> names;
    for (const Function& function : reading.functions) {
        const std::string_view name = reading.word(function.name);
        if (!is_allowed(reading, name) || !names.insert(name).second) continue;
        std::set<Types> own;
        for (const std::uint32_t index : reading.functions_named(name))
            own.insert(types_of(reading, reading.functions[index]));
        functions += wrapped_all(name, own);
        macros += fmt::format("#define {0} glint_{0}\n", name);
    }
    return functions + macros;
}

}  // namespace glint
