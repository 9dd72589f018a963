#include "render/driver_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <regex>
#include <string_view>
#include <vector>

namespace glint {
namespace {

// The end of the spaces and comments that begin at a place of a line.
std::size_t after_space(std::string_view line, std::size_t at) {
    while (at < line.size()) {
        if (line[at] == ' ' || line[at] == '\t') {
            ++at;
        } else if (line.substr(at, 2) == "/*") {
            const std::size_t end = line.find("*/", at + 2);
            at = end == line.npos ? line.size() : end + 2;
        } else {
            break;
        }
    }
    return at;
}

// Mesa counts bytes after its preprocessor, for which a run of spaces and comments is one space.
// This is the column of the text itself, in characters from 1. Macros move columns too, by what
// cannot be known here.
int column_before_preprocessing(std::string_view line, int column) {
    std::size_t at = 0;
    for (int seen = 1; seen < column && at < line.size(); ++seen) {
        const std::size_t code = after_space(line, at);
        at = code > at ? code : at + 1;
    }
    return static_cast<int>(std::count_if(line.begin(), line.begin() + static_cast<long>(at),
                                          [](char c) { return (c & 0xC0) != 0x80; })) +
           1;
}

std::string_view line_of(std::string_view text, int number) {
    std::size_t begin = 0;
    for (int line = 1; line < number && begin < text.size(); ++line) {
        begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
    }
    return text.substr(begin, text.find('\n', begin) - begin);
}

// A number of a log, however many digits it has.
int parse_count(const std::string& digits) {
    int count = 0;
    const char* end = digits.data() + digits.size();
    const bool fits = std::from_chars(digits.data(), end, count).ec == std::errc();
    return fits ? count : std::numeric_limits<int>::max();
}

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

constexpr std::string_view kCandidates = "candidates are:";

// The type of the first of what stands between brackets: `texture(sampler2D, vec3)'.
std::string_view first_type(std::string_view call) {
    const std::size_t open = std::min(call.find('('), call.size() - 1);
    return call.substr(open + 1, call.find_first_of(",)", open) - open - 1);
}

// Mesa makes an error of its own of each function that a call could have meant, whatever its
// samplers: 47 for texture(). They join the call's, those alone that take what it gives first.
Diagnostics with_candidates_joined(Diagnostics list) {
    Diagnostics joined;
    for (std::size_t i = 0; i < list.size();) {
        const std::size_t call = i++;
        const Place& place = list[call].place;
        const auto is_candidate = [&](const Diagnostic& one) {
            return one.place.line == place.line && one.place.column == place.column &&
                   one.text.ends_with(')');
        };
        if (list[call].text.ends_with(kCandidates))
            while (i < list.size() && is_candidate(list[i])) ++i;
        const auto begin = list.begin() + static_cast<std::ptrdiff_t>(call) + 1;
        const auto end = list.begin() + static_cast<std::ptrdiff_t>(i);
        const std::string given(first_type(list[call].text));
        const auto fits = [&](const Diagnostic& one) { return first_type(one.text) == given; };
        const bool any_fits = std::any_of(begin, end, fits);
        joined.push_back(std::move(list[call]));
        for (auto one = begin; one != end; ++one)
            if (!any_fits || fits(*one)) joined.back().text += "\n    " + one->text;
    }
    return joined;
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
        R"(^\d+:(\d+)\((\d+)\):\s*(?:preprocessor )?(error|warning):\s*(.*)$)");
    static const std::regex nvidia(R"(^\d+\((\d+)\) ?: (error|warning) (?:C\d+: )?(.*)$)");
    static const std::regex angle(R"(^(ERROR|WARNING): \d+:(\d+): (.*)$)");
    static const std::regex unplaced(R"(^(?:error|ERROR):\s*(.*)$)");
    static const std::regex total(R"(^ERROR: .*\d+ compilation errors?\..*$)");
    const auto place = [&](const std::string& number, int column) {
        const int line = parse_count(number);
        int wider = 0;
        for (const PassText::Widened& widened : text.widened) {
            if (widened.line == line && column > widened.column)
                wider += std::min(widened.by, column - widened.column);
        }
        return scene.place(line - text.prologue_lines, column - wider);
    };
    Diagnostics list;
    for (const std::string& line : lines_of(log)) {
        std::smatch m;
        if (std::regex_match(line, m, mesa)) {
            list.push_back(
                {m[3] == "error" ? Severity::error : Severity::warning,
                 place(m[1], column_before_preprocessing(line_of(text.text, parse_count(m[1])),
                                                         parse_count(m[2]))),
                 m[4]});
        } else if (std::regex_match(line, m, nvidia)) {
            list.push_back(
                {m[2] == "error" ? Severity::error : Severity::warning, place(m[1], 0), m[3]});
        } else if (std::regex_match(line, m, angle)) {
            list.push_back(
                {m[1] == "ERROR" ? Severity::error : Severity::warning, place(m[2], 0), m[3]});
        } else if (!std::regex_match(line, total) && std::regex_match(line, m, unplaced)) {
            list.push_back(link_diagnostic(scene, m[1]));
        }
    }
    return with_candidates_joined(std::move(list));
}

}  // namespace glint
