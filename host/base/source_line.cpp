#include "base/source_line.h"

#include "base/readable_file.h"

#include <algorithm>
#include <clocale>
#include <cwchar>
#include <functional>
#include <numeric>
#include <sstream>
#include <vector>

namespace glint {
namespace {

constexpr int kTab = 4;                          // cells
constexpr std::size_t kLargestFile = 64u << 20;  // as of any text that is read

struct Character {
    std::string bytes;
    int cells = 1;
};

// How many bytes follow this one in UTF-8, if it is the first of a character.
int bytes_to_come(char first) {
    const auto byte = static_cast<unsigned char>(first);
    return byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : byte >= 0xc0 ? 1 : 0;
}

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// While it lasts, this thread's C library knows UTF-8, whatever the user's locale.
class Utf8Locale {
public:
    Utf8Locale() : utf8_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
        if (utf8_) before_ = ::uselocale(utf8_);
    }
    ~Utf8Locale() {
        if (!utf8_) return;
        ::uselocale(before_);
        ::freelocale(utf8_);
    }
    Utf8Locale(const Utf8Locale&) = delete;
    Utf8Locale& operator=(const Utf8Locale&) = delete;

private:
    locale_t utf8_, before_{};
};

void measure(std::vector<Character>& characters) {
    const Utf8Locale utf8;
    for (Character& character : characters) {
        if (character.bytes == "\t") continue;
        wchar_t code = 0;
        mbstate_t state{};
        const std::size_t size = character.bytes.size();
        const bool is_whole = std::mbrtowc(&code, character.bytes.data(), size, &state) == size;
        character.cells = is_whole ? ::wcwidth(code) : -1;
        if (character.cells < 0) character = {"?", 1};
    }
}

// `caret` becomes the index of the character in the column, -1 where there is none.
std::vector<Character> characters_of(std::string_view line, int column, int& caret) {
    std::vector<Character> characters;
    int read = 0, to_come = 0;
    for (const char byte : line) {
        // A byte that belongs to no character, as of Latin-1, is one of its own.
        if (to_come > 0 && continues_character(byte)) {
            characters.back().bytes += byte;
            --to_come;
            continue;
        }
        if (++read == column) caret = static_cast<int>(characters.size());
        characters.push_back({std::string(1, byte)});
        to_come = bytes_to_come(byte);
    }
    if (column > read) caret = static_cast<int>(characters.size());
    return characters;
}

void expand_tabs(std::vector<Character>& characters) {
    int at = 0;
    for (Character& character : characters) {
        if (character.bytes == "\t") {
            character.cells = kTab - at % kTab;
            character.bytes.assign(static_cast<std::size_t>(character.cells), ' ');
        }
        at += character.cells;
    }
}

}  // namespace

SourceLine shown_line(std::string_view line, int column, int width, Cells cells) {
    int caret = -1;
    std::vector<Character> characters = characters_of(line, column, caret);
    if (cells == Cells::terminal) measure(characters);
    expand_tabs(characters);
    std::vector<int> starts(characters.size() + 1, 0);
    std::transform_inclusive_scan(characters.begin(), characters.end(), starts.begin() + 1,
                                  std::plus<>(), [](const Character& c) { return c.cells; });
    const int all = starts.back();
    const int at = caret < 0 ? 0 : starts[static_cast<std::size_t>(caret)];
    const int begin = std::clamp(at - width * 2 / 3, 0, std::max(all - width, 0));
    const int end = std::min(begin + std::max(width, 1), all);
    SourceLine shown;
    if (caret >= 0) shown.caret = at - begin;
    const int first = begin > 0 ? begin + 1 : 0, last = end < all ? end - 1 : end;
    if (begin > 0) shown.text = "\u2026";
    int written = first;
    for (std::size_t i = 0; i < characters.size(); ++i) {
        if (starts[i] < first || starts[i + 1] > last) continue;
        // Half of a wide character is left of the cut.
        shown.text.append(static_cast<std::size_t>(std::max(starts[i] - written, 0)), ' ');
        shown.text += characters[i].bytes;
        written = starts[i + 1];
    }
    if (end < all) shown.text += "\u2026";
    return shown;
}

std::string read_source_line(const Place& place) {
    if (place.line <= 0) return {};
    std::string text;
    try {
        text = read_whole_file(place.file, kLargestFile);
    } catch (const Unreadable&) {
        return {};
    }
    std::istringstream lines(std::move(text));
    std::string line;
    for (int i = 0; i < place.line; ++i)
        if (!std::getline(lines, line)) return {};
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

}  // namespace glint
