// The command line: a table of verbs, and errors as exit codes.
#include "base/diagnostic.h"
#include "base/say.h"
#include "base/terminal.h"
#include "gl/context.h"
#include "verbs/show.h"
#include "verbs/verb.h"
#include "verbs/version.h"

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <sstream>
#include <system_error>

namespace glint {
namespace {

struct VerbEntry {
    const char* name;
    const char* help;  // null: stands in no help text, for no person calls it
    std::unique_ptr<Verb> (*make)();
};

constexpr VerbEntry kVerbs[] = {
#ifdef GLINT_WINDOW
    {"open", "show a scene or preset (the default verb)", open_verb},
#endif
    {"new", "a commented scene to begin with", new_verb},
    {"still", "one frame to a picture file", still_verb},
    {"sequence", "frames to pictures, a film, or another program", sequence_verb},
    {"sound", "mainSound to a wav, flac or ogg file", sound_verb},
    {"import", "a shader of Shadertoy to a scene file", import_verb},
    {"export", "a scene to a web page or to the tabs of a Shadertoy", export_verb},
    {"info", "passes, tweaks, and what was left out", info_verb},
    {"bench", "milliseconds a frame and a pass", bench_verb},
    {"check", "numerical stability at every extreme", check_verb},
    {"study", "error against run time", study_verb},
    {"probe", "any value of the shader, at a pixel", probe_verb},
    {"complete", nullptr, complete_verb},
    {"manual", nullptr, manual_verb},
#ifdef GLINT_WINDOW
    {"trial", nullptr, trial_verb},
    {"voice", nullptr, voice_verb},
    {"refine", nullptr, refine_verb},
    {"sketch", nullptr, sketch_verb},
    {"probing", nullptr, probing_verb},
#endif
};

int code(ExitCode exit_code) {
    return static_cast<int>(exit_code);
}

// A file that is opened while stdin, stdout or stderr is closed would get its number, and messages
// would land in a picture. What stands there instead refuses them, as what is closed does.
void open_what_is_closed() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0) continue;
        // The lowest number that is free: this one.
        (void)::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

using SignalHandler = void (*)(int);

// A write that fails says so, to whoever can still keep the picture; a signal would end all at
// once. Returns what a pipe without a reader did before.
SignalHandler ignore_signals_of_writes() {
    std::signal(SIGXFSZ, SIG_IGN);
    return std::signal(SIGPIPE, SIG_IGN);
}

// An option that the verb does not have; it explains whatever else is missing, and comes first.
std::string unknown_option(const CLI::App& app) {
    const std::vector<std::string> left = app.remaining(true);
    const auto word = std::ranges::find_if(left, [](const std::string& text) {
        return text.starts_with('-') && text != "-" && text != "--";
    });
    if (word == left.end()) return {};
    const auto parsed = app.get_subcommands();
    const CLI::App& asked = parsed.empty() ? app : *parsed.front();
    std::vector<std::string> known;
    for (const CLI::Option* option : asked.get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    const std::string name = word->substr(0, word->find('='));
    const std::string verb = parsed.empty() ? "" : parsed.front()->get_name() + " ";
    const std::string meant = did_you_mean(name, known);
    return fmt::format(
        "There is no option {} here{}", name,
        meant.empty() ? fmt::format("; `glint {}--help` lists those there are.", verb) : meant);
}

// A file whose name looks like options.
std::string file_like_option(const CLI::App& app) {
    for (const std::string& word : app.remaining(true)) {
        std::error_code none;
        if (word.size() > 2 && word[0] == '-' && std::filesystem::exists(word, none))
            return fmt::format("{} is taken for an option; of a file of that name write ./{}", word,
                               word);
    }
    return {};
}

// CLI11's complaints in the words of all others.
std::string usage_text(const CLI::App& app, const CLI::ParseError& error) {
    if (const std::string file = file_like_option(app); !file.empty()) return file;
    if (const std::string unknown = unknown_option(app); !unknown.empty()) return unknown;
    std::string text = error.what();
    if (!text.empty() && text.back() == '.') text.pop_back();
    if (text.ends_with('?')) return text;
    return text + "; --help tells what there is.";
}

// How a verb ended, and why; without a sentence where all has been said.
struct Ending {
    ExitCode code = ExitCode::done;
    std::string sentence{};
};

Ending ending_of(const std::function<void()>& run) {
    try {
        run();
        return {};
    } catch (const Stop& stop) {
        return {stop.code};
    } catch (const UsageError& error) {
        return {ExitCode::usage, error.what()};
    } catch (const NoContext& error) {
        return {ExitCode::no_context, error.what()};
    } catch (const ContextLost& error) {
        return {ExitCode::context_lost, error.what()};
    } catch (const std::bad_alloc&) {
        return {ExitCode::failure, "Out of memory; try a smaller --size."};
    } catch (const std::exception& error) {
        return {ExitCode::failure, error.what()};
    }
}

// Runs a verb and turns what it throws into an exit code; the sentence goes to stderr. A result
// that stdout refused, because a disk is full, is one that nobody has. Where its reader went away,
// which is what pipes are for, the program ends as all do, once its files are written.
int guarded(SignalHandler pipe_without_reader, const std::function<void()>& run) {
    const Ending ending = ending_of(run);
    flush_results();
    if (result_error() == EPIPE && pipe_without_reader == SIG_DFL) {
        std::signal(SIGPIPE, SIG_DFL);
        std::raise(SIGPIPE);
    }
    if (!ending.sentence.empty()) say_error(ending.sentence);
    if (!ending.sentence.empty() || result_error() == 0) return code(ending.code);
    say_error(fmt::format("Cannot write to stdout: {}.",
                          std::generic_category().message(result_error())));
    return code(ending.code == ExitCode::done ? ExitCode::failure : ending.code);
}

// One verb of the table on the command line.
struct DeclaredVerb {
    CLI::App* app;
    std::unique_ptr<Verb> verb;
};

std::vector<DeclaredVerb> declare_verbs(CLI::App& app) {
    std::vector<DeclaredVerb> verbs;
    for (const VerbEntry& entry : kVerbs) {
        CLI::App* part = app.add_subcommand(entry.name, entry.help ? entry.help : "");
        if (!entry.help) part->group("");
        verbs.push_back({part, entry.make()});
        verbs.back().verb->declare(*part);
    }
    return verbs;
}

// Throws UsageError where another verb than `open` was meant.
void require_open(const std::vector<std::string>& arguments, std::span<const std::string> verbs) {
    const std::string& file = arguments[0];
    std::error_code unknown;
    const bool is_there = std::filesystem::exists(file, unknown);
    const bool is_word = file.find_first_of("./") == file.npos;
    const bool has_operand = arguments.size() > 1 && !arguments[1].starts_with('-');
    if (const std::string verb = nearest(file, verbs); !verb.empty() && !is_there)
        throw UsageError(
            fmt::format("There is no verb and no file '{}'; did you mean '{}'?", file, verb));
    if (!is_there && is_word && has_operand)
        throw UsageError(
            fmt::format("There is no verb '{}'; `glint --help` lists those there are.", file));
    for (const std::string_view output : {"-o", "--output"})
        if (std::ranges::find(arguments, output) != arguments.end())
            throw UsageError(
                fmt::format("`glint {}` opens a window; `glint still {} -o picture.png` writes a "
                            "picture, and `glint sequence` a film.",
                            file, file));
}

// `glint FILE` is `glint open FILE`, `glint` alone `glint open`, `glint help still` `glint still
// --help`, and `glint version` `glint --version`. Throws UsageError where a verb was meant.
void add_default_verb(std::vector<std::string>& arguments) {
    if (arguments.empty()) return arguments.push_back("open");
    if (arguments[0].starts_with('-') && arguments[0] != "--") return;
    std::vector<std::string> verbs;
    for (const VerbEntry& entry : kVerbs) verbs.emplace_back(entry.name);
    if (std::ranges::find(verbs, arguments[0]) != verbs.end()) return;
    std::error_code unknown;
    if (arguments[0] == "help" && !std::filesystem::exists("help", unknown)) {
        arguments.erase(arguments.begin());
        return arguments.push_back("--help");
    }
    if (arguments[0] == "version" && !std::filesystem::exists("version", unknown)) {
        arguments[0] = "--version";
        return;
    }
    if (arguments[0] != "--") require_open(arguments, verbs);
    if (std::ranges::find(verbs, "open") == verbs.end()) {
        throw UsageError(
            fmt::format("This glint was built without its window; draw a picture by "
                        "`glint still {} -o picture.png`.",
                        arguments[0]));
    }
    arguments.insert(arguments.begin(), "open");
}

// `--size=$SIZE` of an empty variable, for which the next word would be taken.
void require_values(std::span<const std::string> arguments) {
    for (const std::string& word : arguments) {
        if (word == "--") return;
        if (word.starts_with("--") && word.find('=') == word.size() - 1)
            throw UsageError(fmt::format("{} has no value behind the `=`.", word));
    }
}

// Such as a shell's variable that is not set: what it asks for would not be done, and nothing said.
// The hidden verbs are spoken to by programs.
void require_no_empty_values(const CLI::App& verb) {
    if (verb.get_group().empty()) return;
    for (const CLI::Option* option : verb.get_options())
        if (std::ranges::find(option->results(), "") != option->results().end())
            throw UsageError(fmt::format("{}: it has an empty value; leave it out, or say what",
                                         option->get_name()));
}

int run(int argc, char** argv) {
    const Stopwatch since_start;
    open_what_is_closed();
    const SignalHandler pipe_without_reader = ignore_signals_of_writes();
    CLI::App app("glint: a shader playground. `glint FILE` opens a scene or a preset.", "glint");
    app.set_version_flag("--version", version_text,
                         "version and commit, the driver, and the libraries it was built with");
    app.require_subcommand(1);
    const std::vector<DeclaredVerb> verbs = declare_verbs(app);
    app.footer(
        "Examples:\n  glint\n  glint presets/christmas.toml\n  glint new rings\n"
        "  glint still presets/christmas.toml -o christmas.png\n"
        "`glint VERB --help` has more.");
    std::vector<std::string> arguments(argv + 1, argv + argc);
    return guarded(pipe_without_reader, [&] {
#ifndef GLINT_WINDOW
        if (arguments.empty()) return say_first_commands({});
#endif
        add_default_verb(arguments);
        require_values(arguments);
        std::ranges::reverse(arguments);  // CLI11 takes them from the back
        try {
            app.parse(std::move(arguments));
        } catch (const CLI::ParseError& error) {
            if (error.get_exit_code() != 0) throw UsageError(usage_text(app, error));
            std::ostringstream text;  // of --help, --version
            app.exit(error, text, text);
            return say_result("{}", text.str());
        }
        for (const DeclaredVerb& declared : verbs) {
            if (!declared.app->parsed()) continue;
            require_no_empty_values(*declared.app);
            declared.verb->run(since_start);
        }
    });
}

}  // namespace
}  // namespace glint

int main(int argc, char** argv) {
    return glint::run(argc, argv);
}
