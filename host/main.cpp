// The command line: one verb a mode, and errors as exit codes.
#include "gl/context.h"
#include "measure/bench.h"
#include "measure/check/check.h"
#include "offline/export.h"
#include "offline/import.h"
#include "verbs/info.h"
#include "verbs/open.h"
#include "offline/sequence.h"
#include "offline/sound.h"
#include "offline/still.h"
#include "measure/study/study.h"
#include "window/trial/trial.h"
#include "window/live/voice.h"
#include "base/say.h"
#include "base/diagnostic.h"

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>
#include <type_traits>

namespace glint {
namespace {

// What an option takes. CLI::Range lets not-a-number pass, and writes its bounds with six zeros.
template <class Number>
CLI::Validator from(Number least, Number most) {
    const std::string bounds = fmt::format("from {} to {}", least, most);
    const auto check = [least, most, bounds](const std::string& text) {
        Number value{};
        const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        const char* kind = std::is_integral_v<Number> ? "whole number" : "number";
        return fits ? std::string() : fmt::format("'{}' is not a {} {}", text, kind, bounds);
    };
    return {check, bounds};
}

void add_view(CLI::App& verb, ViewOptions& view, bool takes_json = true) {
    verb.add_option("file", view.file, "a preset (.toml), a scene (.frag), or a Shadertoy (.json)")
        ->required();
    verb.add_option("--size", view.size, "pixels, such as 1280x720; the preset's otherwise");
    verb.add_option("--tweak", view.tweaks, "name=value, as often as needed")
        ->allow_extra_args(false);
    verb.add_option("--device", view.device,
                    "which GPU: a number, a part of its name, or surfaceless");
    verb.add_flag("!--no-specialise", view.specialise,
                  "feed tweaks as uniforms instead of writing them in as constants");
    if (takes_json) verb.add_flag("--json", view.json, "one JSON object on stdout");
}

// How light is gathered over a frame, how a file keeps it, and from which state it goes on.
void add_picture(CLI::App& verb, PictureOptions& picture) {
    add_view(verb, picture.view);
    verb.add_option("--fps", picture.fps,
                    "Hz; frame k stands at k / fps, and simulations are played so")
        ->check(from(0.01, 1e5));
    verb.add_option("--samples", picture.samples, "sub-pixel positions averaged in linear light")
        ->check(from(1, 65536));
    verb.add_option("--shutter", picture.shutter,
                    "degrees of a frame, 360 all of it, over which --samples are spread in time")
        ->check(from(0.0, 360.0));
    verb.add_option("--format", picture.format.values, "of an .exr file: float, or half");
    verb.add_option("--compression", picture.format.compression,
                    "of an .exr file: zips, or none, rle, zip, piz, pxr24, b44, b44a, dwaa, dwab; "
                    "of a .tif file: zip, or none, lzw, packbits");
    verb.add_option("--quality", picture.format.quality, "of a .jpg file; 95 otherwise")
        ->check(from(1, 100));
    verb.add_option("--from-state", picture.state.from,
                    "go on from this state of the simulation; with %06d: from the newest of use");
    verb.add_option("--save-state", picture.state.save,
                    "keep the state that the last frame is drawn from in this file");
}

void add_still(CLI::App& verb, StillOptions& still) {
    add_picture(verb, still);
    verb.add_option("-o,--output", still.output, "a .png, .exr, .jpg, .tif or .hdr file")
        ->required();
    verb.add_option("--time", still.time, "s; the preset's otherwise")->check(from(0.0, 1e9));
    verb.add_option("--frame", still.frame, "instead of --time")->check(from(0, 1 << 30));
    verb.add_option("--settle", still.settle, "more frames with time held still")
        ->check(from(0, 1'000'000));
    verb.add_option("--pass", still.pass, "write this buffer instead of the picture");
    verb.add_option(
            "--tile", still.tile,
            "draw in tiles of at most so many pixels a side; huge pictures do so by themselves")
        ->check(from(1, 16384));
}

void add_sequence(CLI::App& verb, SequenceOptions& sequence) {
    add_picture(verb, sequence);
    verb.add_option("-o,--output", sequence.output,
                    "out.%04d.png (or exr, jpg, tif, hdr), out.mp4 (or webm, mov, gif), or -; "
                    "may be left out with --save-state or --from-pictures");
    verb.add_option("--frames", sequence.frames,
                    "FIRST:LAST or FIRST:LAST:STEP; the first ten seconds otherwise");
    verb.add_option("--shard", sequence.shard, "K/N: only the K-th of N shares of the pictures");
    verb.add_flag("--resume", sequence.resume,
                  "leave pictures alone that are there and are what would be written");
    verb.add_option(
        "--from-pictures", sequence.from_pictures,
        "frames/%06d.png that others have drawn: check them, and make the film of them");
    verb.add_option("--save-state-every", sequence.state.save_every,
                    "keep the state before each frame that is a multiple of this")
        ->check(from(1, 1 << 30));
}

void add_check(CLI::App& verb, CheckOptions& check) {
    verb.add_option("files", check.files, "presets (.toml), scenes (.frag), or Shadertoys (.json)")
        ->required();
    verb.add_option("--size", check.view.size, "pixels of most cases; 96x54 otherwise");
    verb.add_option("--tweak", check.view.tweaks, "name=value, as often as needed")
        ->allow_extra_args(false);
    verb.add_option("--device", check.view.device,
                    "which GPU: a number, a part of its name, or surfaceless");
    verb.add_option("--inject", check.effort.inject, "texels of a buffer poisoned at once; 0: none")
        ->check(from(0, 10'000));
    verb.add_option("--frames", check.effort.frames, "of the long run")->check(from(1, 10'000'000));
    verb.add_option("--random", check.effort.random, "sets of random tweaks")
        ->check(from(0, 1'000'000));
    verb.add_option("--seconds", check.effort.seconds,
                    "that one file's cases may take, 110 otherwise; 0: no limit")
        ->check(from(0.0, 1e6));
    verb.add_option("--case", check.only, "only cases whose name begins so");
    verb.add_option("--hang", check.hang_seconds,
                    "s that one frame may take; less where --seconds are nearly over")
        ->check(from(1.0, 1e5));
    verb.add_option("-o,--output", check.output, "a folder for the pictures of failures");
    CLI::Option* json = verb.add_flag("--json", check.view.json, "one JSON object on stdout");
    verb.add_flag("--lines", check.lines, "a JSON object a line, whenever a case ends")
        ->excludes(json);
}

void add_study(CLI::App& verb, StudyOptions& study) {
    verb.add_option("files", study.files, "presets (.toml), scenes (.frag), or Shadertoys (.json)")
        ->required();
    verb.add_option("--size", study.view.size, "pixels; 640x360 otherwise");
    verb.add_option("--tweak", study.view.tweaks, "name=value, as often as needed")
        ->allow_extra_args(false);
    verb.add_option("--device", study.view.device,
                    "which GPU: a number, a part of its name, or surfaceless");
    verb.add_flag("!--no-specialise", study.view.specialise,
                  "feed tweaks as uniforms instead of writing them in as constants");
    verb.add_option("--vary", study.vary,
                    "name, name=a,b,c or name=a,...,z: instead of all quality tweaks")
        ->allow_extra_args(false);
    verb.add_option("--reference", study.reference, "name=value that counts as the truth")
        ->allow_extra_args(false);
    verb.add_option("--second", study.second, "name=value to measure the reference by")
        ->allow_extra_args(false);
    verb.add_option("--metric", study.time_only, "error, or time alone: cost over size")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, std::string>{{"error", "false"}, {"time", "true"}}));
    verb.add_option("--pass", study.pass, "compare this buffer instead of the picture");
    verb.add_option("--frames", study.frames, "timed frames a row")->check(from(15, 100'000));
    verb.add_option("-o,--output", study.output, "a folder for the report");
    CLI::Option* csv = verb.add_flag("--csv", study.csv, "comma-separated values on stdout");
    CLI::Option* json = verb.add_flag("--json", study.view.json, "one JSON object on stdout");
    verb.add_flag("--lines", study.lines, "a JSON object a line, whenever a picture is drawn")
        ->excludes(csv)
        ->excludes(json);
}

int code(ExitCode exit_code) {
    return static_cast<int>(exit_code);
}

int fail(ExitCode exit_code, const std::string& text) {
    say("error: {}\n", text);
    return code(exit_code);
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

// CLI11's complaints in the words of all others.
std::string usage_text(const CLI::ParseError& error) {
    std::string text = error.what();
    if (text.starts_with("A subcommand")) text = "There is nothing to do";
    if (!text.empty() && text.back() == '.') text.pop_back();
    return text + "; --help tells what there is.";
}

// How a verb ended, and why; without a sentence where all has been said.
struct Ending {
    ExitCode code = ExitCode::done;
    std::string sentence{};
};

template <class Run>
Ending ending_of(Run run) {
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
template <class Run>
int guarded(SignalHandler pipe_without_reader, Run run) {
    const Ending ending = ending_of(run);
    flush_results();
    if (result_error() == EPIPE && pipe_without_reader == SIG_DFL) {
        std::signal(SIGPIPE, SIG_DFL);
        std::raise(SIGPIPE);
    }
    if (!ending.sentence.empty()) return fail(ending.code, ending.sentence);
    if (result_error() == 0) return code(ending.code);
    return fail(ending.code == ExitCode::done ? ExitCode::failure : ending.code,
                fmt::format("Cannot write to stdout: {}.",
                            std::generic_category().message(result_error())));
}

int run(int argc, char** argv) {
    const Stopwatch since_start;
    open_what_is_closed();
    const SignalHandler pipe_without_reader = ignore_signals_of_writes();
    const auto guarded = [&](auto verb) { return glint::guarded(pipe_without_reader, verb); };
    CLI::App app("glint: a shader playground. `glint FILE` opens a scene or a preset.", "glint");
    app.set_version_flag("--version", "glint " GLINT_VERSION);
    app.require_subcommand(1);
    ViewOptions open;
    StillOptions still;
    SequenceOptions sequence;
    SoundOptions sound;
    InfoOptions info;
    BenchOptions bench;
    CheckOptions check;
    StudyOptions study;

    CLI::App& open_verb = *app.add_subcommand("open", "show a scene or preset (the default verb)");
    add_view(open_verb, open);
    CLI::App& still_verb = *app.add_subcommand("still", "one frame to a picture file");
    add_still(still_verb, still);
    CLI::App& sequence_verb =
        *app.add_subcommand("sequence", "frames to pictures, a film, or another program");
    add_sequence(sequence_verb, sequence);
    CLI::App& sound_verb = *app.add_subcommand("sound", "mainSound to a wav, flac or ogg file");
    add_view(sound_verb, sound.view);
    sound_verb.add_option("-o,--output", sound.output, "a .wav, .flac or .ogg file")->required();
    sound_verb.add_option("--seconds", sound.seconds, "from the start; 180 otherwise")
        ->check(from(0.0, 1e5));
    ImportOptions import;
    CLI::App& import_verb = *app.add_subcommand("import", "a shader of Shadertoy to a scene file");
    import_verb.add_option("input", import.input, "a .json file, or a folder of tabs")->required();
    import_verb.add_option("-o,--output", import.output, "a .frag file")->required();
    import_verb.add_flag("--anywhere", import.anywhere,
                         "let it name files outside its folder, such as ../wood.png");
    ExportOptions export_options;
    CLI::App& export_verb = *app.add_subcommand("export", "a scene to the tabs of a Shadertoy");
    add_view(export_verb, export_options.view, false);
    export_verb.add_option("-o,--output", export_options.output, "a folder")->required();
    CLI::App& info_verb = *app.add_subcommand("info", "passes, tweaks, and what was left out");
    add_view(info_verb, info.view);
    info_verb.add_option("--source", info.source, "print the GLSL that the driver sees for a pass");
    CLI::App& bench_verb = *app.add_subcommand("bench", "milliseconds a frame and a pass");
    add_view(bench_verb, bench.view);
    bench_verb.add_option("--frames", bench.frames, "how many frames are timed")
        ->check(from(1, 1'000'000));
    bench_verb.add_flag("--compare", bench.compare, "time uniform-fed frames in turn as well");

    CLI::App& check_verb = *app.add_subcommand("check", "numerical stability at every extreme");
    add_check(check_verb, check);

    CLI::App& study_verb = *app.add_subcommand("study", "error against run time");
    add_study(study_verb, study);

    // What the window starts for itself stands in no help text.
    std::string trial_device;
    CLI::App& trial_verb = *app.add_subcommand("trial")->group("");
    trial_verb.add_option("device", trial_device);
    CLI::App& voice_verb = *app.add_subcommand("voice")->group("");
    voice_verb.add_option("device", trial_device);

    // `glint FILE` is `glint open FILE`.
    std::vector<std::string> arguments(argv + 1, argv + argc);
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    const bool is_file = !arguments.empty() && !arguments[0].starts_with('-') &&
                         std::find(verbs.begin(), verbs.end(), arguments[0]) == verbs.end();
    if (is_file) {
        std::error_code unknown;
        const std::string verb = nearest(arguments[0], verbs);
        if (!verb.empty() && !std::filesystem::exists(arguments[0], unknown)) {
            return fail(ExitCode::usage, fmt::format("There is no verb and no file '{}'; did you "
                                                     "mean '{}'?",
                                                     arguments[0], verb));
        }
        arguments.insert(arguments.begin(), "open");
    }
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) return fail(ExitCode::usage, usage_text(error));
        std::ostringstream text;  // of --help, --version
        app.exit(error, text, text);
        return guarded([&] { say_result("{}", text.str()); });
    }
    if (open_verb.parsed()) return guarded([&] { run_open(open, since_start); });
    if (still_verb.parsed()) return guarded([&] { run_still(still, since_start); });
    if (sequence_verb.parsed()) return guarded([&] { run_sequence(sequence); });
    if (sound_verb.parsed()) return guarded([&] { run_sound(sound); });
    if (import_verb.parsed()) return guarded([&] { run_import(import); });
    if (export_verb.parsed()) return guarded([&] { run_export(export_options); });
    if (info_verb.parsed()) return guarded([&] { run_info(info); });
    if (check_verb.parsed()) return guarded([&] { run_check(check); });
    if (study_verb.parsed()) return guarded([&] { run_study(study); });
    if (trial_verb.parsed()) return guarded([&] { run_trial(trial_device); });
    if (voice_verb.parsed()) return guarded([&] { run_voice(trial_device); });
    return guarded([&] { run_bench(bench); });
}

}  // namespace
}  // namespace glint

int main(int argc, char** argv) {
    return glint::run(argc, argv);
}
