#include "window/ui/source_line.h"

#include "glsl/raw_text.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace glint {
namespace {

constexpr int kTab = 4;  // characters

bool begins_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) != 0x80;
}

}  // namespace

SourceLine shown_line(std::string_view line, int column, int width) {
    std::vector<std::string> characters;
    int caret = -1, read = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool starts = begins_character(line[i]) || characters.empty();
        if (starts && ++read == column) caret = static_cast<int>(characters.size());
        if (line[i] == '\t') do
                characters.emplace_back(" ");
            while (characters.size() % kTab != 0);
        else if (starts)
            characters.emplace_back(1, line[i]);
        else
            characters.back() += line[i];
    }
    if (column > read) caret = static_cast<int>(characters.size());

    const int count = static_cast<int>(characters.size());
    const int begin = std::clamp(std::max(caret, 0) - width * 2 / 3, 0, std::max(count - width, 0));
    const int end = std::min(begin + std::max(width, 1), count);
    SourceLine shown;
    if (begin > 0) shown.text = "\u2026";
    const int last = end < count ? end - 1 : end;
    for (int i = begin + (begin > 0 ? 1 : 0); i < last; ++i)
        shown.text += characters[static_cast<std::size_t>(i)];
    if (end < count) shown.text += "\u2026";
    if (caret >= 0) shown.caret = caret - begin;
    return shown;
}

std::string read_source_line(const Place& place) {
    if (place.line <= 0) return {};
    std::string why_not;
    const auto text = read_bytes(place.file, why_not);
    std::istringstream lines(text.value_or(""));
    std::string line;
    for (int i = 0; i < place.line; ++i)
        if (!std::getline(lines, line)) return {};
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

}  // namespace glint
