#include "render/driver_log.h"

#include "base/words.h"
#include "glsl/preprocess.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <regex>
#include <string_view>
#include <vector>

namespace glint {
namespace {

// Where a complaint stands in the text that the driver read.
struct Spot {
    std::size_t at = 0;  // of what a person wrote: where a macro is used, not where it is defined
    std::uint32_t use = kNone;  // the macro's use that the complaint is of
    std::size_t defined = 0;    // and the place in its definition
};

// The text as the driver read it, taken apart.
class ReadText {
public:
    ReadText(const Scene& scene, const PassText& pass)
        : scene_(scene), pass_(pass), read_(preprocess(pass.text, known_of_driver())) {
        line_begins_.push_back(0);
        for (std::size_t at = 0; (at = pass.text.find('\n', at)) != pass.text.npos;)
            line_begins_.push_back(++at);
    }

    // What the driver says of a line and a column, in characters from 1. Expanded: where it counts
    // behind its preprocessor.
    Diagnostic complaint(Severity severity, int line, int column, bool is_expanded,
                         std::string words) const;

private:
    std::size_t offset(int line, int column) const;
    Spot expanded_spot(int line, int column) const;
    Place place(std::size_t at) const {
        const auto origin = pass_.origin(at);
        return origin ? scene_.place_at(*origin) : Place{scene_.files.front().string()};
    }

    const Scene& scene_;
    const PassText& pass_;
    Preprocessed read_;
    std::vector<std::size_t> line_begins_;
};

std::size_t ReadText::offset(int line, int column) const {
    const std::string& text = pass_.text;
    const auto last = static_cast<int>(line_begins_.size());
    std::size_t at = line_begins_[static_cast<std::size_t>(std::clamp(line, 1, last) - 1)];
    for (; column > 1 && at < text.size() && text[at] != '\n'; --column)
        for (++at; at < text.size() && !begins_character(text[at]);) ++at;
    return at;
}

// Mesa counts bytes of what its preprocessor makes of a line: macros expanded, and one space for a
// run of spaces and comments.
Spot ReadText::expanded_spot(int line, int column) const {
    const std::size_t begin = offset(line, 1), end = std::max(offset(line + 1, 1), begin + 1);
    Spot spot{begin};
    int at = 1;
    bool is_first = true;
    for (const Token& token : read_.tokens) {
        const Span place = token.use == kNone ? token.span() : read_.uses[token.use].span;
        if (place.begin < begin) continue;
        if (place.begin >= end) break;
        at += (is_first ? place.begin > begin : token.space_before) ? 1 : 0;
        is_first = false;
        if (at > column) break;
        const bool in_text =
            token.use == kNone || (place.begin <= token.begin && token.end <= place.end);
        spot = in_text ? Spot{token.begin} : Spot{place.begin, token.use, token.begin};
        const auto within = static_cast<std::size_t>(column - at);
        if (in_text && within < token.text.size()) spot.at += within;
        at += static_cast<int>(token.text.size());
    }
    return spot;
}

Diagnostic ReadText::complaint(Severity severity, int line, int column, bool is_expanded,
                               std::string words) const {
    const Spot spot = is_expanded ? expanded_spot(line, column) : Spot{offset(line, column)};
    Place where = place(spot.at);
    if (spot.at >= pass_.user_end) {
        const auto user = pass_.text.begin() + static_cast<long>(pass_.user_begin);
        const auto host_lines = std::count(pass_.text.begin(), user, '\n');
        where = scene_.place(line - static_cast<int>(host_lines), column);
    }
    if (column == 0) where.column = 0;
    if (spot.use != kNone && pass_.origin(spot.defined)) {
        const Place defined = place(spot.defined);
        words += fmt::format(" (in what {} stands for, {}:{}:{})",
                             read_.macros[read_.uses[spot.use].macro].name, defined.file,
                             defined.line, defined.column);
    }
    return {severity, where, std::move(words)};
}

// A number of a log, however many digits it has.
int parse_count(const std::string& digits) {
    int count = 0;
    const char* end = digits.data() + digits.size();
    const bool fits = std::from_chars(digits.data(), end, count).ec == std::errc();
    return fits ? count : std::numeric_limits<int>::max();
}

constexpr int kLastLine = 1 << 30;  // no text has as many

// The lines of a log, without white space and zeros at their ends. One that quotes a name of 300 kB
// is cut: nobody reads it, and matching a regular expression takes stack for every character.
std::vector<std::string> lines_of(const std::string& log) {
    constexpr std::size_t kLongestLine = 2000;
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < log.size();) {
        const std::size_t end = std::min(log.find('\n', begin), log.size());
        std::string line = log.substr(begin, end - begin);
        if (line.size() > kLongestLine) line.replace(kLongestLine, line.npos, "...");
        line.erase(line.find_last_not_of(std::string_view(" \t\r\0", 4)) + 1);
        lines.push_back(std::move(line));
        begin = end + 1;
    }
    return lines;
}

}  // namespace

Diagnostic link_diagnostic(const Scene& scene, std::string text) {
    if (text.find("unresolved reference to function") != text.npos &&
        text.find(scene.image_entry) != text.npos) {
        text = fmt::format(
            "there is no `void {}(out vec4 fragColor, in vec2 fragCoord)`; write one, it draws the "
            "picture",
            scene.image_entry);
    }
    return {Severity::error, {scene.files.front().string(), 0, 0}, std::move(text)};
}

Diagnostics read_driver_log(const Scene& scene, const std::string& log, const PassText& text) {
    static const std::regex mesa(
        R"(^\d+:(\d+)\((\d+)\):\s*(preprocessor )?(error|warning):\s*(.*)$)");
    static const std::regex nvidia(R"(^\d+\((\d+)\) ?: (error|warning) (?:C\d+: )?(.*)$)");
    static const std::regex angle(R"(^(ERROR|WARNING): \d+:(\d+): (.*)$)");
    static const std::regex unplaced(R"(^(?:error|ERROR):\s*(.*)$)");
    static const std::regex total(R"(^ERROR: .*\d+ compilation errors?\..*$)");
    Diagnostics list;
    std::optional<ReadText> read;  // most texts compile
    const auto add = [&](bool is_error, const std::string& line, int column, bool is_expanded,
                         std::string words) {
        if (!read) read.emplace(scene, text);
        list.push_back(read->complaint(is_error ? Severity::error : Severity::warning,
                                       std::min(parse_count(line), kLastLine), column, is_expanded,
                                       std::move(words)));
    };
    for (const std::string& line : lines_of(log)) {
        std::smatch m;
        if (std::regex_match(line, m, mesa)) {
            add(m[4] == "error", m[1], parse_count(m[2]), !m[3].matched, m[5]);
        } else if (std::regex_match(line, m, nvidia)) {
            add(m[2] == "error", m[1], 0, false, m[3]);
        } else if (std::regex_match(line, m, angle)) {
            add(m[1] == "ERROR", m[2], 0, false, m[3]);
        } else if (!std::regex_match(line, total) && std::regex_match(line, m, unplaced)) {
            list.push_back(link_diagnostic(scene, m[1]));
        }
    }
    return list;
}

}  // namespace glint
