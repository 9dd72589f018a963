#include "render/own_overloads.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace glint {
namespace {

// Functions of GLSL ES 3.00, chapter 8, by what they take, and before the colon give: g stands for
// float and its vectors, i, u and b for those of int, uint and bool; V, I, U and B for the vectors
// alone, v for vec3, m for square matrices; f, s, w and l for float, int, uint and bool; x for a
// sampler, p for a place in it, t for a texel there, z for its size, 4 for vec4.
struct Family {
    std::string_view signature, names;
};
constexpr Family kFamilies[] = {
    {"g:g",
     " radians degrees sin cos tan asin acos atan exp log exp2 log2 sqrt inversesqrt abs sign "
     "floor ceil fract normalize round roundEven trunc sinh cosh tanh asinh acosh atanh dFdx dFdy "
     "fwidth "},
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
    {"v:vv", " cross "},
    {"b:g", " isnan isinf "},
    {"l:B", " any all "},
    {"B:B", " not "},
    {"B:VV", " lessThan lessThanEqual greaterThan greaterThanEqual equal notEqual "},
    {"B:II", " lessThan lessThanEqual greaterThan greaterThanEqual equal notEqual "},
    {"B:UU", " lessThan lessThanEqual greaterThan greaterThanEqual equal notEqual "},
    {"B:BB", " equal notEqual "},
    {"m:m", " inverse transpose "},
    {"m:mm", " matrixCompMult "},
    {"f:m", " determinant "},
    {"m:VV", " outerProduct "},
    {"i:g", " floatBitsToInt "},
    {"u:g", " floatBitsToUint "},
    {"g:i", " intBitsToFloat "},
    {"g:u", " uintBitsToFloat "},
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
// Functions without a family here that GLSL ES 1.00 has not.
constexpr std::string_view kNewer =
    " modf textureProj textureOffset packHalf2x16 unpackHalf2x16 packSnorm2x16 unpackSnorm2x16 "
    "packUnorm2x16 unpackUnorm2x16 ";

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
    const bool is_vector = numbers > 1;
    switch (letter) {
        case 'V':
            return is_vector ? "vec" + length : "";
        case 'I':
            return is_vector ? "ivec" + length : "";
        case 'U':
            return is_vector ? "uvec" + length : "";
        case 'B':
            return is_vector ? "bvec" + length : "";
        case 'm':
            return is_vector ? "mat" + length : "";
        case 'v':
            return numbers == 3 ? "vec3" : "";
        case 'l':
            return "bool";
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

bool is_in(std::string_view names, std::string_view name) {
    return names.find(fmt::format(" {} ", name)) != names.npos;
}

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

// What GLSL's functions of a name take, and what they give.
std::map<Types, std::string> known(std::string_view name) {
    std::map<Types, std::string> found;
    for (const Family& family : kFamilies) {
        if (!is_in(family.names, name)) continue;
        const bool is_sampled = family.signature.find('x') != family.signature.npos;
        const int count = is_sampled ? static_cast<int>(std::size(kSampled)) : 4;
        for (int k = 0; k < count; ++k) {
            const Sampled& sampled = kSampled[is_sampled ? k : 0];
            Types types;
            for (const char letter : family.signature.substr(2))
                types.push_back(type_of(letter, k + 1, sampled));
            if (std::ranges::find(types, "") == types.end())
                found.emplace(types, type_of(family.signature.front(), k + 1, sampled));
        }
    }
    return found;
}

// GLSL ES 1.00 and desktop GLSL, which have a main(), allow all names.
bool is_allowed(const Reading& reading, std::string_view name) {
    if (is_in(kAllowed, name)) return true;
    if (reading.functions_named("main").empty()) return false;
    return is_in(kNewer, name) || std::ranges::any_of(kFamilies, [&](const Family& family) {
               return is_in(family.names, name);
           });
}

// Names of the text's functions that GLSL has; not those for which the driver may leave out what
// stands for GLSL's own.
std::set<std::string_view> overloaded_names(const Reading& reading) {
    std::set<std::string_view> names, others;
    for (const Function& function : reading.functions) {
        const std::string_view name = reading.word(function.name);
        if (!is_allowed(reading, name)) continue;
        const bool is_sure = reading.live_at(reading.place(function.name).begin) == Live::yes;
        names.insert(name);
        if (!is_sure && (is_in(kNewer, name) || known(name).contains(types_of(reading, function))))
            others.insert(name);
    }
    for (const std::string_view name : others) names.erase(name);
    return names;
}

// Where a name of these can only be GLSL's: before the text's own, behind a dot, where members are
// declared; and in values that must be constant, which calls of the text's own are not. A word of a
// macro is where the macro is used.
class Kept {
public:
    Kept(const Reading& reading, std::string_view name) {
        const std::uint32_t own = reading.functions_named(name).front();
        first_ = reading.place(reading.functions[own].name).begin;
        is_macro_ = reading.defines_macro(name);
        const auto add = [&](TokenRange range) {
            if (!range.empty()) spans_.push_back(reading.place(range));
        };
        for (const Declaration& declaration : reading.declarations) {
            const bool is_member = declaration.scope == Scope::member;
            for (const Declarator& one : declaration.names) {
                if (is_member) add({one.name, one.name + 1});
                if (declaration.is_const) add(one.initial);
                add(one.array);
            }
            add(declaration.type_array);
        }
        for (std::uint32_t i = 0; i < reading.tokens.size(); ++i) {
            if (!reading.tokens[i].is(name)) continue;
            const bool is_kept =
                (i > 0 && reading.tokens[i - 1].is(".")) || is_kept_place(reading.place(i).begin);
            const auto [seen, is_new] = kept_.emplace(reading.tokens[i].begin, is_kept);
            seen->second &= is_kept;
        }
    }

    // By the byte where the word is spelled.
    bool holds(std::size_t at) const {
        const auto seen = kept_.find(at);
        return seen != kept_.end() ? seen->second : is_kept_place(at);
    }
    // What is a macro's name, too, needs no other one.
    bool any() const {
        return is_macro_ || std::ranges::any_of(kept_, [](const auto& one) { return one.second; });
    }

private:
    bool is_kept_place(std::size_t at) const {
        return at < first_ || std::ranges::any_of(spans_, [&](const Span& span) {
                   return span.begin <= at && at < span.end;
               });
    }

    std::size_t first_ = 0;
    bool is_macro_ = false;
    std::vector<Span> spans_;
    std::map<std::size_t, bool> kept_;
};

}  // namespace

Types types_of(const Reading& reading, const Function& function) {
    Types types;
    for (const std::uint32_t parameter : function.parameters) {
        const Declaration& one = reading.declarations[parameter];
        const bool is_array =
            !one.type_array.empty() || (!one.names.empty() && !one.names.front().array.empty());
        types.push_back(std::string(reading.word(one.type)) + (is_array ? "[]" : ""));
    }
    return types;
}

std::string own_overloads(const Reading& reading) {
    std::string functions, macros;
    for (const std::string_view name : overloaded_names(reading)) {
        std::set<Types> own;
        for (const std::uint32_t index : reading.functions_named(name))
            own.insert(types_of(reading, reading.functions[index]));
        for (const auto& [types, result] : known(name))
            if (!own.contains(types)) functions += wrapped(name, result, types);
        if (!Kept(reading, name).any()) macros += fmt::format("#define {0} glint_{0}\n", name);
    }
    return functions + macros;
}

void rename_overloads(const Reading& reading, Edits& edits) {
    for (const std::string_view name : overloaded_names(reading)) {
        const Kept kept(reading, name);
        if (!kept.any()) continue;
        for (const Token& token : reading.written)
            if (token.is(name) && !kept.holds(token.begin))
                edits.replace_bytes(token.span(), fmt::format("glint_{}", name));
    }
}

}  // namespace glint
