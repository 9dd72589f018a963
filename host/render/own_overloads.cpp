#include "render/own_overloads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace glint {
namespace {

struct BuiltIn {
    std::string_view name, type;
    std::vector<std::string_view> parameters;
};

// Of the samplers that a scene may have.
std::vector<BuiltIn> known_functions() {
    std::vector<BuiltIn> list = {
        {"mix", "float", {"float", "float", "float"}},
        {"mix", "float", {"float", "float", "bool"}},
        {"texelFetch", "vec4", {"sampler2D", "ivec2", "int"}},
        {"texelFetch", "vec4", {"sampler3D", "ivec3", "int"}},
        {"textureSize", "ivec2", {"sampler2D", "int"}},
        {"textureSize", "ivec2", {"samplerCube", "int"}},
        {"textureSize", "ivec3", {"sampler3D", "int"}},
    };
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kVectors = {
        {{"vec2", "bvec2"}, {"vec3", "bvec3"}, {"vec4", "bvec4"}}};
    for (const auto& [vector, bools] : kVectors)
        for (const std::string_view last : {vector, std::string_view("float"), bools})
            list.push_back({"mix", vector, {vector, vector, last}});
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kSamplers = {
        {{"sampler2D", "vec2"}, {"sampler3D", "vec3"}, {"samplerCube", "vec3"}}};
    for (const auto& [sampler, place] : kSamplers) {
        list.push_back({"texture", "vec4", {sampler, place}});
        list.push_back({"texture", "vec4", {sampler, place, "float"}});
        list.push_back({"textureLod", "vec4", {sampler, place, "float"}});
        list.push_back({"textureGrad", "vec4", {sampler, place, place, place}});
    }
    return list;
}

// A function that calls the known one.
std::string wrapped(const BuiltIn& known) {
    std::string parameters, arguments;
    for (std::size_t i = 0; i < known.parameters.size(); ++i) {
        const char* comma = i > 0 ? ", " : "";
        parameters += fmt::format("{}{} a{}", comma, known.parameters[i], i);
        arguments += fmt::format("{}a{}", comma, i);
    }
    return fmt::format("{0} glint_{1}({2}) {{ return {1}({3}); }}\n", known.type, known.name,
                       parameters, arguments);
}

std::vector<std::string_view> types_of(const Reading& reading, const Function& function) {
    std::vector<std::string_view> types;
    for (const std::uint32_t parameter : function.parameters)
        types.push_back(reading.word(reading.declarations[parameter].type));
    return types;
}

}  // namespace

std::string own_overloads(const Reading& reading) {
    std::string functions;
    std::vector<std::string_view> names;
    for (const BuiltIn& known : known_functions()) {
        const auto own = reading.functions_named(known.name);
        if (own.empty()) continue;
        if (std::ranges::find(names, known.name) == names.end()) names.push_back(known.name);
        const bool is_own = std::ranges::any_of(own, [&](std::uint32_t function) {
            return types_of(reading, reading.functions[function]) == known.parameters;
        });
        if (!is_own) functions += wrapped(known);
    }
    for (const std::string_view name : names)
        functions += fmt::format("#define {0} glint_{0}\n", name);
    return functions;
}

}  // namespace glint
