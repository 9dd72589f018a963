// The scenes beside each other: nothing is shared, so what they have in common is the same text.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace glint {
namespace {

struct Function {
    std::string name;
    std::string types;  // of its parameters, which tell overloads apart
    std::string text;   // from its return type to its closing brace
};

// The text with comments and directives blanked, every place kept.
std::string without_comments(std::string_view text) {
    std::string code(text);
    const auto blank = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < std::min(to, code.size()); ++i) {
            if (code[i] != '\n') code[i] = ' ';
        }
        return to;
    };
    bool line_start = true;
    for (std::size_t i = 0; i < code.size();) {
        if (code.compare(i, 2, "//") == 0 || (line_start && code[i] == '#')) {
            i = blank(i, std::min(code.find('\n', i), code.size()));
        } else if (code.compare(i, 2, "/*") == 0) {
            const std::size_t end = code.find("*/", i + 2);
            i = blank(i, end == std::string::npos ? code.size() : end + 2);
        } else {
            line_start = code[i] == '\n' || (line_start && code[i] == ' ');
            ++i;
        }
    }
    return code;
}

bool is_space(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}
bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// "float x, inout vec3 v" has the types "float,inout vec3,".
std::string types_of(std::string_view parameters) {
    std::string types, one;
    for (const char c : std::string(parameters) + ",") {
        if (c != ',') {
            one += is_space(c) ? ' ' : c;
            continue;
        }
        while (!one.empty() && one.back() == ' ') one.pop_back();
        while (!one.empty() && is_word(one.back())) one.pop_back();
        while (!one.empty() && one.back() == ' ') one.pop_back();
        types += one.substr(std::min(one.find_first_not_of(' '), one.size())) + ",";
        one.clear();
    }
    return types;
}

// What stands outside all braces and ends in ") { … }".
std::vector<Function> functions_of(std::string_view text) {
    const std::string code = without_comments(text);
    std::vector<Function> functions;
    std::size_t start = 0;  // of the declaration that is being read
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i] == ';') start = i + 1;
        if (code[i] != '{') continue;
        std::size_t close = i;
        while (close > start && is_space(code[close - 1])) --close;
        const bool function = close > start && code[close - 1] == ')';
        int depth = 0;
        std::size_t end = i;
        do {
            depth += code[end] == '{' ? 1 : code[end] == '}' ? -1 : 0;
            ++end;
        } while (depth > 0 && end < code.size());
        if (function) {
            while (is_space(code[start])) ++start;
            const std::size_t open = code.rfind('(', close);
            std::size_t name = open;
            while (name > start && is_word(code[name - 1])) --name;
            functions.push_back({.name = code.substr(name, open - name),
                                 .types = types_of(code.substr(open + 1, close - open - 2)),
                                 .text = std::string(text.substr(start, end - start))});
        }
        start = i = end;
        --i;
    }
    return functions;
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

TEST(Fragments, FunctionsAreFoundInAText) {
    const std::vector<Function> found = functions_of(
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
    EXPECT_EQ(found[1].types, "in  vec2,inout Hit,") << "with their qualifiers";
    EXPECT_TRUE(found[1].text.starts_with("float half1(in  vec2 v,"));
    EXPECT_TRUE(found[1].text.ends_with("return h.t;\n}"));
    EXPECT_EQ(found[2].name, "none");
    EXPECT_EQ(found[2].types, ",");
}

TEST(Fragments, FunctionsOfOneNameAreOneText) {
    struct Seen {
        std::string file, text;
    };
    std::map<std::string, Seen> first;
    std::size_t compared = 0;
    const std::filesystem::path folder = std::filesystem::path(GLINT_REPOSITORY) / "fragments";
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".frag") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const std::filesystem::path& path : files) {
        const std::string file = path.filename().string();
        const std::vector<Function> functions = functions_of(read(path));
        EXPECT_FALSE(functions.empty()) << file;
        for (const Function& function : functions) {
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
}  // namespace glint
