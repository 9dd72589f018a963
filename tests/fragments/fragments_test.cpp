// The scenes beside each other: nothing is shared, so what they have in common is the same text.
#include "glsl/reading.h"
#include "scene/scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace glint::fragments_test {
namespace {

struct Found {
    std::string name;
    std::string types;  // of its parameters, with their qualifiers, which tell overloads apart
    std::string text;   // from its return type to its closing brace
};

// "float x, inout vec3 v" has the types "float,inout vec3,".
std::vector<Found> functions_of(const std::string& text) {
    const Reading reading = read_glsl(text, known_of_scene());
    std::vector<Found> found;
    for (const Function& function : reading.functions) {
        if (!function.is_defined()) continue;
        std::string types;
        for (const std::uint32_t index : function.parameters) {
            const Declaration& parameter = reading.declarations[index];
            const std::uint32_t type_end = std::max(parameter.type + 1, parameter.type_array.end);
            types += reading.spelled({parameter.tokens.begin, type_end}) + ",";
        }
        const Span span = reading.place(function.tokens);
        found.push_back({.name = std::string(reading.word(function.name)),
                         .types = types,
                         .text = text.substr(span.begin, span.end - span.begin)});
    }
    return found;
}

// Each scene's own: the same role, another scene.
bool each_scenes_own(const std::string& name) {
    constexpr std::array kRoles = {"map", "intersect", "shade", "render", "background", "camera"};
    return name.starts_with("main") || std::ranges::find(kRoles, name) != kRoles.end();
}

std::string read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::filesystem::path> shipped_scenes() {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path folder = std::filesystem::path(GLINT_REPOSITORY) / "fragments";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".frag") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

// A truth that only one way leads to is borne out by nothing.
TEST(Fragments, EachSceneNamesAnotherWayToTheTruth) {
    for (const std::filesystem::path& file : shipped_scenes()) {
        const std::vector<Tweak> tweaks = read_scene(file).scene->tweaks;
        EXPECT_TRUE(std::ranges::any_of(tweaks, [](const Tweak& tweak) {
            return tweak.quality && !tweak.second.empty();
        })) << file;
    }
}

TEST(Fragments, FunctionsAreFoundInAText) {
    const std::vector<Found> found = functions_of(
        "// float commented(float x) { return x; }\n"
        "uniform int kind; //@ 1 {off, on} \"a menu (of two)\"\n"
        "const vec2 kTwo[2] = vec2[2](vec2(0.0), vec2(1.0));\n"
        "#define TWICE(x) { x; x; }\n"
        "struct Hit { float t; int id; };\n"
        "float half1(float x) { return 0.5 * x; }   // of it\n"
        "/* } */ float half1(in  vec2 v,\n"
        "             inout Hit h) {\n"
        "    if (v.x > 0.0) { h.t = v.x; }   // {\n"
        "    return h.t;\n"
        "}\n"
        "void none() {}\n");
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].name, "half1");
    EXPECT_EQ(found[0].types, "float,");
    EXPECT_EQ(found[0].text, "float half1(float x) { return 0.5 * x; }");
    EXPECT_EQ(found[1].types, "in vec2,inout Hit,") << "with their qualifiers";
    EXPECT_TRUE(found[1].text.starts_with("float half1(in  vec2 v,"));
    EXPECT_TRUE(found[1].text.ends_with("return h.t;\n}"));
    EXPECT_EQ(found[2].name, "none");
    EXPECT_EQ(found[2].types, "");
}

TEST(Fragments, FunctionsOfOneNameAreOneText) {
    struct Seen {
        std::string file, text;
    };
    std::map<std::string, Seen> first;
    std::size_t compared = 0;
    for (const std::filesystem::path& path : shipped_scenes()) {
        const std::string file = path.filename().string();
        const std::vector<Found> functions = functions_of(read(path));
        EXPECT_FALSE(functions.empty()) << file;
        for (const Found& function : functions) {
            if (each_scenes_own(function.name)) continue;
            const auto [known, is_new] = first.try_emplace(
                function.name + "(" + function.types + ")", Seen{file, function.text});
            if (is_new) continue;
            ++compared;
            EXPECT_EQ(known->second.text, function.text)
                << function.name << " differs between " << known->second.file << " and " << file;
        }
    }
    EXPECT_GT(compared, 0u) << "nothing in common would mean that nothing was found";
}

}  // namespace
}  // namespace glint::fragments_test
