// What a scene's text is read with: the names that Glint defines, and its tabs.
#pragma once

#include "glsl/reading.h"
#include "scene/scene.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

namespace glint {

// How the names begin that say which pass a text is compiled for.
inline constexpr std::string_view kPassPrefix = "PASS_";

// For all passes at once: what hangs on a PASS_x may be compiled.
Known known_of_scene();

// Where an #if without an end is told, and how: at an `#ednif`, if the text has one.
std::pair<std::size_t, std::string> about_open_condition(const Reading& reading);
// For one pass, by the names of its outputs, "image" or "sound".
Known known_of_pass(std::span<const std::string> outputs);
// The lines that say so to a driver.
std::string definitions_of_pass(std::span<const std::string> outputs);

// `#ifdef PASS_bufferA … #endif`: text that is compiled for one pass alone, a tab of the site.
struct Tab {
    Span span;
    std::string_view pass;  // "bufferA"
};

// In the order of their ends. What stands behind an #else or #elif is no tab.
std::vector<Tab> find_tabs(const Reading& reading);

// One name of a uniform's declaration: `iChannelTime[4]`.
struct UniformName {
    std::string_view name;
    std::string array;  // what stands between the brackets
    bool is_array = false;
    bool has_initial = false;  // `= 0.5`, which GLSL ES forbids for uniforms
    Span span;                 // from the name up to the comma or semicolon
};

// `uniform … ;`
struct Uniform {
    Span span;  // from its first word through the semicolon
    std::string_view type;
    std::size_t type_at = 0;
    std::vector<UniformName> names;
    bool is_plain = true;    // no macro has a part in it
    bool is_block = false;   // `uniform Name { … }`, or a struct
    bool is_broken = false;  // no semicolon, or something else that the compiler will explain; also
                             // one within a macro that holds more
    std::optional<std::size_t> no_semicolon{};  // where it is missing, of a line of words alone
};
std::vector<Uniform> find_uniforms(const Reading& reading);

// What follows each `//@` in live text, up to the comment's end or to a `//@ allow` in it.
std::vector<Span> find_notes(const Reading& reading);

// The names behind `allow`; nothing where a note begins otherwise.
std::optional<std::vector<std::string_view>> parse_allow(std::string_view note);

// The functions that fill a buffer or are the picture, `void NAME(out vec4 …`, each once, in order.
std::vector<std::string> find_pass_functions(const Reading& reading);

// What a pass asks of its function.
struct PassCall {
    std::string entry;
    std::vector<std::string> outputs{};
    bool cube = false;
};
// `void mainSky(out vec4 sky, in vec2 coord, in vec3 rayOri, in vec3 rayDir)`.
std::string signature(const PassCall& call);
// The name of a function that has no twin which can be called so; nothing where one can, where the
// text has none at all, or names types that are not the language's own.
std::optional<Span> find_uncallable(const Reading& reading, const PassCall& call);

// Whether it makes sound: a function mainSound, or the word where a macro may make one of it.
bool has_sound(const Reading& reading, const std::unordered_set<std::string_view>& words);

// Where mainSound stands, if none is vec2 mainSound(int, float) or vec2 mainSound(float).
std::optional<Span> find_wrong_sound(const Reading& reading);

// The first character that the compiler would see and GLSL does not have.
std::optional<Token> find_strange(const Reading& reading);
// What to say of it: many come with a pasted text, and cannot be seen.
std::string about_strange(const Reading& reading, const Token& token);
// That this pass has none, in words, with those there are and the nearest.
std::string no_pass_function(const Reading& reading, const Pass& pass);

// The words that stand in live text, those of directives too.
std::unordered_set<std::string_view> find_words(const Reading& reading);

// What is to be done about a uniform of this type that nothing fills.
std::string what_fills(std::string_view type, bool is_array);

}  // namespace glint
