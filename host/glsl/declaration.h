// The uniforms that a text declares, and the words that stand in it; just enough GLSL for that.
#pragma once

#include "glsl/raw_text.h"

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace glint {

// The reader's own words, of another shape, must not be taken for these by a linker.
inline namespace uniforms {

// One name of a declaration: `iChannelTime[4]`.
struct Declarator {
    std::string_view name;
    std::string_view array;  // what stands between the brackets
    bool is_array = false;
    bool has_initial = false;  // `= 0.5`, which GLSL ES forbids for uniforms
    Span span;                 // from the name up to the comma or semicolon
};

// `uniform … ;`
struct Declaration {
    Span span;  // from `uniform` (or a layout before it) through the semicolon
    std::string_view type;
    std::size_t type_at = 0;
    std::vector<Declarator> names;
    bool is_block = false;   // `uniform Name { … }`, or a struct
    bool is_broken = false;  // no semicolon, or something else that the compiler will explain
};

}  // namespace uniforms

// `code` is a text without comments. Preprocessor lines are passed over. Views point into `code`.
std::vector<Declaration> find_uniforms(std::string_view code);

// `#ifdef PASS_bufferA … #endif`: text that is compiled for one pass alone, a tab of the site.
struct Tab {
    Span span;
    std::string_view pass;  // "bufferA"
};

// In the order of their ends. What stands behind an #else or #elif is no tab.
std::vector<Tab> find_tabs(std::string_view code);

// The functions that fill a buffer or are the picture, `void NAME(out vec4 …`, each once, in order.
std::vector<std::string> find_pass_functions(std::string_view code);

// Whether a character may stand in an identifier.
bool is_word(char c);

// Where an identifier stands for the first time from `from` on; npos where it does not.
std::size_t find_word(std::string_view text, std::string_view word, std::size_t from = 0);

// Every identifier, those of preprocessor lines too.
std::unordered_set<std::string_view> find_identifiers(std::string_view code);

}  // namespace glint
