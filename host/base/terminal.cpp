#include "base/terminal.h"

#include "base/say.h"
#include "base/source_line.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace glint {
namespace {

constexpr const char* kBold = "\033[1m";
constexpr const char* kRed = "\033[1;31m";
constexpr const char* kYellow = "\033[1;33m";
constexpr const char* kPlain = "\033[0m";

const char* colour_of(Severity severity) {
    return severity == Severity::error ? kRed : kYellow;
}

// The place in bold, the severity in its colour.
std::string coloured(const Diagnostic& diagnostic) {
    const std::string plain = to_string(diagnostic);
    const std::string_view word = diagnostic.severity == Severity::error ? "error:" : "warning:";
    // Of what stands there, which need not be as long as what was said.
    const std::size_t text = harmless(diagnostic.text, '?', "\n\t").size();
    const std::size_t at = plain.size() - text - word.size() - 1;
    return fmt::format("{}{}{}{}{}{}{}", kBold, plain.substr(0, at), kPlain,
                       colour_of(diagnostic.severity), word, kPlain,
                       plain.substr(at + word.size()));
}

}  // namespace

Terminal terminal_at_stderr() {
    Terminal terminal;
    terminal.is_there = ::isatty(STDERR_FILENO) != 0;
    if (!terminal.is_there) return terminal;
    const auto is_set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    const char* kind = std::getenv("TERM");
    // Emacs compiles on a terminal that it does not emulate, whatever TERM says.
    terminal.has_colours = !is_set("NO_COLOR") && !is_set("INSIDE_EMACS") &&
                           !(kind && std::string_view(kind) == "dumb");
    winsize size{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        terminal.columns = size.ws_col;
    return terminal;
}

std::string shown(const Diagnostic& diagnostic, const Terminal& terminal) {
    if (!terminal.is_there) return to_string(diagnostic);
    std::string text = terminal.has_colours ? coloured(diagnostic) : to_string(diagnostic);
    const std::string source = read_source_line(diagnostic.place);
    if (source.empty()) return text;
    const std::string number = fmt::format("{:>5} | ", diagnostic.place.line);
    // The last column stays empty: some terminals begin a new line there.
    const int room = terminal.columns - static_cast<int>(number.size()) - 1;
    const SourceLine line =
        shown_line(source, diagnostic.place.column, std::max(room, 20), Cells::terminal);
    text += "\n" + number + line.text;
    if (line.caret < 0) return text;
    text += fmt::format("\n{:>{}}{}", "| ", number.size(),
                        std::string(static_cast<std::size_t>(line.caret), ' '));
    return text + (terminal.has_colours
                       ? fmt::format("{}^{}", colour_of(diagnostic.severity), kPlain)
                       : "^");
}

void say_diagnostic(const Diagnostic& diagnostic) {
    say("{}\n", shown(diagnostic, terminal_at_stderr()));
}

void say_error(std::string sentence) {
    say_diagnostic({Severity::error, {}, std::move(sentence)});
}

void say_warning(std::string sentence) {
    say_diagnostic({Severity::warning, {}, std::move(sentence)});
}

}  // namespace glint
