// Odd bytes and odd line ends.
#include "glsl/raw_text.h"

#include "base/readable_file.h"

#include <algorithm>

namespace glint {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 64u << 20;  // no scene is near it

// The length of the valid UTF-8 character at the front, or 0.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool surrogate = lead == 0xED && byte(1) > 0x9F;
    const bool too_far = lead == 0xF4 && byte(1) > 0x8F;
    return overlong || surrogate || too_far ? 0 : length;
}

}  // namespace

std::optional<std::string> read_bytes(const fs::path& file, std::string& why_not) {
    try {
        return read_whole_file(file, kLargestFile);
    } catch (const Unreadable& unreadable) {
        why_not = unreadable.cause;
        return std::nullopt;
    }
}

CleanText clean_text(std::string_view raw) {
    if (raw.starts_with("\xEF\xBB\xBF")) raw.remove_prefix(3);
    CleanText cleaned;
    std::string& text = cleaned.text;
    text.reserve(raw.size() + 1);
    std::size_t line_begin = 0;
    int line = 1;
    for (std::size_t i = 0; i < raw.size();) {
        const char c = raw[i];
        const std::size_t length = utf8_length(raw.substr(i, 4));
        if (c == '\0') {
            if (cleaned.nul_line == 0) {
                cleaned.nul_line = line;
                cleaned.nul_column = static_cast<int>(text.size() - line_begin) + 1;
            }
            text += ' ';
        } else if (c == '\r' || c == '\n') {
            text += '\n';
            ++line;
            line_begin = text.size();
            if (c == '\r' && i + 1 < raw.size() && raw[i + 1] == '\n') ++i;
        } else if (length == 0) {
            text += "\uFFFD";
        } else {
            text.append(raw, i, length);
        }
        i += std::max<std::size_t>(length, 1);
    }
    // A backslash at the very end would join the file with what includes it.
    if (!text.empty() && text.back() == '\\') text.back() = ' ';
    if (!text.empty() && text.back() != '\n') text += '\n';
    return cleaned;
}

}  // namespace glint
