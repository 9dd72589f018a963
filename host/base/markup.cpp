#include "base/markup.h"

#include "base/names.h"

#include <cstddef>

namespace glint {
namespace {

constexpr Names<char, 8> kEntities = {{{'&', "&amp;"},
                                       {'<', "&lt;"},
                                       {'>', "&gt;"},
                                       {'"', "&quot;"},
                                       {'\'', "&#39;"},
                                       {'\t', "&#9;"},
                                       {'\n', "&#10;"},
                                       {'\r', "&#13;"}}};

// Bytes of the character that begins the text; 0 where none does that XML allows.
std::size_t character_bytes(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    char32_t code = first & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    const bool allowed = code >= kLeast[length] && code <= 0x10ffff && !surrogate &&
                         code != 0xfffe && code != 0xffff;
    return allowed ? length : 0;
}

}  // namespace

std::string markup_escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::string_view entity = kEntities.of(text.front());
        const std::size_t bytes = entity.empty() ? character_bytes(text) : 1;
        if (!entity.empty())
            result += entity;
        else if (bytes > 0)
            result += text.substr(0, bytes);
        else
            result += "\xEF\xBF\xBD";
        text.remove_prefix(bytes > 0 ? bytes : 1);
    }
    return result;
}

}  // namespace glint
