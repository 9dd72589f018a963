// One file's text, its bytes made even.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

// Bytes [begin, end) of a text.
struct Span {
    std::size_t begin = 0, end = 0;
};

// The bytes of a file, or nothing and words that say why not.
std::optional<std::string> read_bytes(const std::filesystem::path& file, std::string& why_not);

struct CleanText {
    std::string text;
    int nul_line = 0, nul_column = 0;  // of the first NUL byte, from 1; 0 if there is none
};

// Takes off a byte order mark, makes every line end '\n' and every byte printable in a message:
// what is not UTF-8 (an old comment in Latin-1) becomes U+FFFD, a character for a byte.
CleanText clean_text(std::string_view raw);

}  // namespace glint
