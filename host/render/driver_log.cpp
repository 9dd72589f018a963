#include "render/driver_log.h"

#include "glsl/preprocess.h"
#include "render/advice.h"
#include "render/consequences.h"
#include "render/nvidia_words.h"
#include "render/own_words.h"
#include "render/read_text.h"
#include "render/syntax_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <regex>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace glint {
namespace {

// A number of a log, however many digits it has.
int parse_count(const std::string& digits) {
    int count = 0;
    const char* end = digits.data() + digits.size();
    const bool fits = std::from_chars(digits.data(), end, count).ec == std::errc();
    return fits ? count : std::numeric_limits<int>::max();
}

constexpr int kLastLine = 1 << 30;  // no text has as many

constexpr std::size_t kLongestComplaint = 200;  // that names something

// The name that a complaint does not know, or "".
std::string unknown_name(const std::string& complaint) {
    static const std::regex mesa(R"(^(?:`(\w+)' undeclared|no function with name '(\w+)')$)");
    std::smatch m;
    if (complaint.size() > kLongestComplaint || !std::regex_match(complaint, m, mesa)) return {};
    return m[1].matched ? m[1] : m[2];
}

// All that a log does not know: of two mistyped names one does not mean the other.
std::set<std::string, std::less<>> unknown_names(const std::string& log) {
    static const std::regex said(
        R"re(`(\w+)' undeclared|no function with name '(\w+)'|undefined variable "(\w+)")re");
    std::set<std::string, std::less<>> names;
    for (const std::string& line : lines_of(log)) {
        std::smatch m;
        if (line.size() > kLongestComplaint || !std::regex_search(line, m, said)) continue;
        names.insert(m.str(1) + m.str(2) + m.str(3));  // one of them
    }
    return names;
}

// The f of "function `float f(float)' has static recursion", which Mesa says of line 0, and of
// NVIDIA's "recursive call to function "float f(float){", which goes on with its body.
std::string recursive_name(const std::string& complaint) {
    static const std::regex said(
        R"re(^(?:function `|recursive call to function ")(?:\w+ )?(\w+)\(.*)re");
    std::smatch m;
    const bool is_told =
        complaint.starts_with("recursive call") || complaint.ends_with("' has static recursion");
    return is_told && std::regex_match(complaint, m, said) ? std::string(m[1]) : "";
}

// The function that a linker finds nowhere; "" where it complains of something else.
std::string bodiless_function(const std::string& words) {
    static const std::regex said(
        R"re(unresolved reference to function `(\w+)'|call to undefined function "(?:\w+ )?(\w+)\()re");
    std::smatch m;
    return std::regex_search(words, m, said) ? m.str(1) + m.str(2) : std::string();
}

// "Too many fragment shader texture samplers", of which Mesa tells no line.
bool has_too_many_samplers(const std::string& words) {
    return words.starts_with("Too many ") && words.ends_with(" samplers");
}

// The v of "fragment shader input `v' has no matching output in the previous stage", of which Mesa
// tells no line.
std::string unfed_input(const std::string& complaint) {
    static const std::regex mesa(
        R"(^fragment shader input [`'](\w+)'.* has no matching output.*$)");
    std::smatch m;
    return std::regex_match(complaint, m, mesa) ? std::string(m[1]) : "";
}

// A log, line by line.
class LogReader {
public:
    LogReader(const Scene& scene, const std::string& log, const PassText& text)
        : scene_(scene), text_(text), unknown_(unknown_names(log)) {}

    void read(const std::string& line) {
        static const std::regex mesa(
            R"(^\d+:(\d+)\((\d+)\):\s*(preprocessor )?(error|warning):\s*(.*)$)");
        static const std::regex nvidia(R"(^\d*\((\d+)\) ?: (error|warning) (?:C\d+: )?(.*)$)");
        static const std::regex angle(R"(^(ERROR|WARNING): \d+:(\d+): (.*)$)");
        static const std::regex unplaced(R"(^(?:error|ERROR):\s*(.*)$)");
        static const std::regex total(R"(^ERROR: .*\d+ compilation errors?\..*$)");
        std::smatch m;
        if (std::regex_match(line, m, mesa)) {
            const bool is_expanded = !m[3].matched;
            add({severity(m[4] == "error"), at(m[1]), parse_count(m[2]), is_expanded,
                 is_expanded ? m.str(5) : read_preprocessor_error(m[5])});
        } else if (std::regex_match(line, m, nvidia)) {
            if (!bodiless_function(m[3]).empty()) return add_of_link(m[3]);
            auto told = taken_apart().from_nvidia(
                {.severity = severity(m[2] == "error"), .line = at(m[1]), .words = m[3]});
            if (told) add(std::move(*told));
        } else if (std::regex_match(line, m, angle)) {
            add({.severity = severity(m[1] == "ERROR"), .line = at(m[2]), .words = m[3]});
        } else if (!std::regex_match(line, total) && std::regex_match(line, m, unplaced)) {
            add_of_link(m[1]);
        }
    }

    Diagnostics list;

private:
    static Severity severity(bool is_error) {
        return is_error ? Severity::error : Severity::warning;
    }
    static int at(const std::string& line) { return std::min(parse_count(line), kLastLine); }
    // Most texts compile.
    const ReadText& taken_apart() { return apart_ ? *apart_ : apart_.emplace(scene_, text_); }
    void add(Said said);
    void add_of_link(const std::string& words);

    const Scene& scene_;
    const PassText& text_;
    std::set<std::string, std::less<>> unknown_;
    std::set<std::pair<std::string, std::ptrdiff_t>> told_;  // of these, and in which block
    bool is_recursion_told_ = false;
    std::optional<ReadText> apart_;
};

void LogReader::add(Said said) {
    if (said.words.starts_with("Error: ")) said.words.erase(0, 7);  // which it is anyway
    auto words = said_of_remainder(std::move(said.words));
    if (!words) return;
    said.words = std::move(*words);
    said.words += advice_on_types(said.words);
    if (const std::string name = unknown_name(said.words); !name.empty()) {
        const bool is_called = said.words.starts_with("no function");
        said.words += taken_apart().help_with(said, name, is_called, unknown_);
        // Of a name that a function does not know it is told once.
        if (!told_.emplace(name, taken_apart().block_of(said)).second) said.words += kAgain;
    }
    if (const std::string name = recursive_name(said.words); !name.empty()) {
        if (!std::exchange(is_recursion_told_, true))  // all functions of one circle follow
            list.push_back({Severity::error, taken_apart().first(name),
                            name + " calls itself, at once or by way of others; GLSL has no "
                                   "recursion, write a loop"});
        return;
    }
    list.push_back(taken_apart().complaint(std::move(said)));
}

void LogReader::add_of_link(const std::string& words) {
    list.push_back(link_diagnostic(scene_, text_.pass, words));
    Diagnostic& told = list.back();
    if (has_too_many_samplers(words) && !scene_.samplers.empty()) {
        told.place = taken_apart().first(scene_.samplers.back().name);
        told.text += " for this driver; put what several of them hold into one";
    }
    const std::string input = unfed_input(words), bare = bodiless_function(words);
    if (!input.empty()) {
        told.place = taken_apart().first(input);
        told.text = "nothing feeds " + input +
                    ": no vertices stand before a picture; write a value of its own, such as " +
                    (draws_by_main(scene_, text_.pass) ? "gl_FragCoord.xy" : "fragCoord") +
                    " / iResolution.xy";
    } else if (!bare.empty() && bare != entry_of(scene_, text_.pass)) {
        told.place = taken_apart().first(bare);
        told.text = bare + " is declared and called, but has no body; write one";
    }
}

}  // namespace

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

Diagnostic link_diagnostic(const Scene& scene, std::size_t pass, std::string text) {
    const bool is_image = pass == kImagePass;
    const std::string entry = entry_of(scene, pass);
    Place place{scene.files.front().string(), 0, 0};
    if (bodiless_function(text) == entry) {
        if (!is_image) place = scene.passes[pass].place;
        text = fmt::format(
            "there is no `void {}(out vec4 fragColor, in vec2 fragCoord)`{}; write "
            "one, it draws the {}",
            entry, is_image ? "" : " for " + scene.passes[pass].name,
            is_image ? "picture" : "buffer");
    }
    return {Severity::error, std::move(place), std::move(text)};
}

Diagnostics read_driver_log(const Scene& scene, const std::string& log, const PassText& text) {
    LogReader reader(scene, log, text);
    for (const std::string& line : lines_of(log)) reader.read(line);
    for (Diagnostic& one : reader.list) one.text = in_own_words(one.text);
    return without_consequences(with_vectors_named(with_candidates_joined(std::move(reader.list))));
}

Diagnostic refusal_without_words(const Scene& scene, const PassText& text) {
    if (auto open = ReadText(scene, text).open_bracket()) return std::move(*open);
    return link_diagnostic(scene, text.pass, "the driver refused the shader without a word");
}

}  // namespace glint
