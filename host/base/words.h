// Numbers and the words for them, read the same way in annotations, presets and on the command
// line, whatever the locale.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

// "0.5", "-3", "1e-3", ".5" or a fraction "1/240". Nothing for any other text, and for numbers that
// are not finite in double precision.
std::optional<double> parse_number(std::string_view text);

// The shortest decimal that reads back as the same double.
std::string format_number(double value);

// "on" or "true", "off" or "false".
std::optional<bool> parse_switch(std::string_view text);

// Whether a byte of UTF-8 is a character's first: columns count these.
inline bool begins_character(char byte) {
    return (byte & '\xC0') != '\x80';
}

// In quotation marks, with each mark within written as `inner`.
std::string quoted(std::string_view text, char mark, std::string_view inner);

// As a shell has to be told it; a file's name never as an option.
std::string shell_word(const std::string& word);
std::string shell_file(const std::string& name);

// Names of files and what a shader says in #error may hold what a terminal obeys: control
// characters but those that are kept, U+0080 to U+009F among them, and marks that turn the
// direction of text.
std::string harmless(std::string_view text, char instead, std::string_view kept = "");

// With ASCII's capitals made small.
std::string in_small_letters(std::string_view text);

// Without the white space at both ends.
std::string_view trimmed(std::string_view text);

// Where a word stands, from a byte on, that is no part of a longer one: letters, digits and '_';
// npos for nowhere.
std::size_t find_whole_word(std::string_view text, std::string_view word, std::size_t from = 0);

// Each place of `what`, which is not empty, from left to right.
void replace_all(std::string& text, std::string_view what, std::string_view by);

}  // namespace glint
