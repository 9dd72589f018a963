#include "offline/sequence.h"

#include "base/canonical_name.h"
#include "base/hash.h"
#include "base/json_text.h"
#include "base/say.h"
#include "base/terminal.h"
#include "gl/context.h"
#include "offline/frames.h"
#include "offline/input_files.h"
#include "offline/picture.h"
#include "offline/sequence_output.h"
#include "offline/sound.h"
#include "render/readback.h"
#include "render/room.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What a GPU may draw while the first of them is still on its way to memory.
constexpr std::size_t kPicturesAhead = 2;

// Of --from-pictures.
void require_pictures(const SequenceOptions& options, Target target) {
    const std::string& pictures = options.from_pictures;
    if (!numbered_name(pictures))
        throw UsageError(
            fmt::format("--from-pictures {}: name them as in frames/%06d.png.", pictures));
    if (!options.state.save.empty() || !options.state.from.empty())
        throw UsageError(
            "--from-pictures draws nothing that a state could be kept of or begin with; leave "
            "--save-state and --from-state out.");
    if (target == Target::pictures)
        throw UsageError(
            "--from-pictures joins pictures to a film; name it .mp4, .webm, .mov or .gif, or - for "
            "raw frames on stdout.");
    if (!begins_with_metadata(pictures))
        throw UsageError(
            "--from-pictures needs pictures that tell what they were made from: png, or exr to be "
            "looked through.");
    if (!options.output.empty() && ending_of(pictures) != ".png")
        throw UsageError(
            "--from-pictures joins png pictures; draw them so, as in --from-pictures "
            "frames/%06d.png.");
}

Target target_of(const SequenceOptions& options) {
    const std::string& output = options.output;
    const bool is_numbered = numbered_name(output).has_value();
    const bool only_checks = output.empty() && !options.from_pictures.empty();
    if (output.empty() && options.state.save.empty() && !only_checks) {
        throw UsageError("Name with -o where the frames go, or with --save-state where states go.");
    }
    if (options.state.save.empty() && options.state.save_every > 0) {
        throw UsageError("--save-state-every needs --save-state, which names the files.");
    }
    const Target target = output.empty()                    ? Target::states
                          : output == "-"                   ? Target::raw
                          : is_film(output) && !is_numbered ? Target::film
                                                            : Target::pictures;
    if (!options.from_pictures.empty()) require_pictures(options, target);
    if (target == Target::pictures && (!is_numbered || !can_write(output))) {
        throw UsageError(
            fmt::format("-o {}: name pictures such as out.%04d.png (or exr, jpg, tif, hdr), a film "
                        "(mp4, webm, mov, gif), or - for raw frames on stdout.",
                        output));
    }
    if (target != Target::pictures && !options.shard.empty()) {
        throw UsageError("--shard shares pictures out; a film is made of all of them.");
    }
    if (options.resume && target != Target::states) {
        if (target != Target::pictures || !begins_with_metadata(output)) {
            throw UsageError(
                "--resume needs pictures that tell what they were made from: png or "
                "exr.");
        }
    }
    const FileFormat& format = options.format;
    const bool is_chosen =
        !format.values.empty() || !format.compression.empty() || format.quality != 0;
    if (is_chosen && target != Target::pictures) {
        throw UsageError("--format, --compression and --quality are for pictures.");
    }
    const std::string refusal = is_chosen ? refusal_of(output, format) : "";
    if (!refusal.empty()) throw UsageError(refusal);
    if (target == Target::raw && (options.view.json || isatty(STDOUT_FILENO))) {
        throw UsageError("-o - writes bytes to stdout: pipe them to a program, without --json.");
    }
    return target;
}

// Before anything is drawn.
void require_size(const std::string& output, Target target, glm::ivec2 size) {
    const std::string refusal = target == Target::film       ? size_refusal_of_film(output, size)
                                : target == Target::pictures ? size_refusal(output, size)
                                                             : "";
    if (!refusal.empty()) throw std::runtime_error(refusal);
}

// All that a frame's picture follows from, but for its number and who drew it.
std::string inputs_of(const SequenceOptions& options, const Provenance& provenance) {
    Hash hash;
    hash.add(fmt::format("{} {} {} {}", options.samples, options.shutter, options.format.values,
                         options.format.compression));
    for (const auto& [name, text] : provenance) hash.add(text);
    return hash.text();
}

// What a run plays: the frames whose pictures are wanted, and where it ends.
struct Run {
    const Preset& preset;
    Renderer& renderer;
    Context& context;
    Playback playback;
    States& states;
    SequenceOutput& output;
    double exposure = 0.0;  // s, of each picture
    std::size_t room = 1;   // for pictures on their way to their files, at once
    int next = 0;           // the frame to be played next
    int simulated = 0, saved = 0;
    std::int64_t written = 0, skipped = 0;  // pictures
    std::function<void()> write_what_is_drawn{};

    // Whoever resumes relies on a state only where all pictures before it are there.
    void keep_state() {
        if (!states.is_due(next)) return;
        if (write_what_is_drawn) write_what_is_drawn();
        states.save(next);
        ++saved;
    }

    // Plays frames that are not drawn; only the simulation costs time.
    void advance_to(int frame) {
        for (; next < frame; ++next, ++simulated) {
            keep_state();
            renderer.advance(playback.frame(preset, next));
            if (next % 64 == 0) context.finish();  // keeps what is queued, and Ctrl+C, short
        }
    }
};

// Leaves out those at the front that are there already; what a simulation starts from follows from
// the first that is not.
void skip_to_first_missing(Run& run, Frames& frames) {
    Progress progress("checking", frames.count);
    for (; frames.count > 0 && run.output.has(frames[0]); --frames.count) {
        frames.first += frames.step;
        progress.update(++run.skipped);
    }
}

// Draws the frames one after the other, but for those that are there, and hands their pictures on.
void draw_frames(Run& run, const Frames& frames) {
    const bool simulates = run.renderer.graph().stateful;
    Progress progress("frame", frames.count);
    const std::size_t ahead =
        run.context.is_software() ? 0 : std::min(kPicturesAhead, (run.room - 1) / 2);
    run.output.limit(run.room - ahead);
    Readback readback(run.renderer, run.output.floats(), static_cast<int>(ahead));
    std::deque<Frame> on_the_way;
    const auto write_first = [&] {
        std::vector<std::byte> rgba = readback.take();
        run.context.check();
        run.output.write(on_the_way.front(), std::move(rgba));
        on_the_way.pop_front();
        progress.update(++run.written);
    };
    run.write_what_is_drawn = [&] {
        while (!on_the_way.empty()) write_first();
        run.output.wait();
    };
    for (std::int64_t i = 0; i < frames.count; ++i) {
        const int k = frames[i];
        if (run.output.has(k)) {
            progress.leave_out(1);
            ++run.skipped;
            continue;
        }
        if (!simulates) run.next = k;
        run.advance_to(k);
        run.keep_state();
        on_the_way.push_back(run.playback.frame(run.preset, run.next++));
        on_the_way.back().exposure = run.exposure;
        run.renderer.draw(on_the_way.back());
        run.output.wait_for_room();
        readback.send();
        if (readback.full()) write_first();
    }
    run.write_what_is_drawn();
    run.write_what_is_drawn = nullptr;
}

// Brings a simulation to just before this frame.
void simulate_to(Run& run, int frame) {
    Progress progress("simulating", frame - run.next);
    for (const int first = run.next; run.next < frame;) {
        run.advance_to(run.next + 1);
        progress.update(run.next - first);
    }
}

// Keeps what the last frame is drawn from. Frames before it count for simulations alone.
void leave_state(Run& run, int last) {
    if (!run.renderer.graph().stateful) run.next = last;
    simulate_to(run, last);
    run.keep_state();
}

// The samples that are heard while a film's frames are shown.
struct Heard {
    long first = 0, count = 0;
};

// None when the scene or the film has no sound, or frames are left out and time runs faster. Throws
// UsageError where it is longer than its file can be.
Heard heard_in(const SequenceOptions& options, const Preset& preset, const Frames& frames) {
    if (!preset.scene.has_sound || !has_sound(options.output) || frames.count == 0) return {};
    if (frames.step > 1 && frames.count > 1) return {};
    const auto sample_of = [&](double frame) {
        return std::lround(frame / options.fps * kSampleRate);
    };
    const long first = sample_of(frames[0]);
    const long count = sample_of(frames.last() + 1.0) - first;
    if (count > kMostSoundSamples) {
        throw UsageError(
            "A film's sound ends before 3 hours 20: export the film in parts, with --frames.");
    }
    return {first, count};
}

// The sound of a film as a WAV file beside it, since that of an hour is 635 MB; null when there is
// none.
std::unique_ptr<TemporaryFile> sound_of(const SequenceOptions& options, const Preset& preset,
                                        const Frames& frames) {
    const auto [first, count] = heard_in(options, preset, frames);
    if (count == 0) return nullptr;
    auto file = std::make_unique<TemporaryFile>(options.output);
    if (const int error =
            write_sound(preset, options.view.specialise, first, count, *file, "sound.wav")) {
        throw cannot_write(options.output, std::generic_category().message(error));
    }
    return file;
}

// Raw frames have stdout for themselves.
void say_line(const SequenceOptions& options, const std::string& line) {
    if (options.output == "-")
        say("{}\n", line);
    else
        say_result("{}\n", line);
}

glm::ivec2 size_of_output(const SequenceOptions& options, const Preset& preset) {
    return is_film(options.output) ? size_in_film(options.output, preset.size) : preset.size;
}

// "1 frame", "3 frames".
std::string counted(std::int64_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void print_result(const SequenceOptions& options, const Run& run, double ms) {
    const double rate = static_cast<double>(run.written) / (ms / 1000.0);
    const glm::ivec2 size = size_of_output(options, run.preset);
    if (options.view.json) {
        const Json json = {{"output", options.output},
                           {"scene", run.preset.scene.files.front().string()},
                           {"size", {size.x, size.y}},
                           {"renderer", run.context.renderer()},
                           {"frames", run.written},
                           {"skipped", run.skipped},
                           {"simulated", run.simulated},
                           {"states_saved", run.saved},
                           {"specialised", options.view.specialise},
                           {"frames_per_second", rate},
                           {"ms", {{"total", ms}}}};
        say_result("{}\n", json_text(json));
        return;
    }
    if (options.output.empty()) {
        say_result("{}  {}  {} simulated  {:.1f} s\n", options.state.save,
                   counted(run.saved, "state"), counted(run.simulated, "frame"), ms / 1000.0);
        return;
    }
    say_line(options, fmt::format("{}  {}{}  {}x{}  {:.1f} s  {:.1f} frames/s", options.output,
                                  counted(run.written, "frame"),
                                  run.skipped ? fmt::format(", {} were there", run.skipped) : "",
                                  size.x, size.y, ms / 1000.0, rate));
}

void print_joined(const SequenceOptions& options, const Preset& preset, std::int64_t frames,
                  double ms) {
    const std::string output =
        options.output.empty() ? options.from_pictures + ": all there" : options.output;
    if (options.view.json) {
        const Json json = {{"output", options.output},
                           {"scene", preset.scene.files.front().string()},
                           {"frames", frames},
                           {"missing", Json::array()},
                           {"ms", {{"total", ms}}}};
        say_result("{}\n", json_text(json));
        return;
    }
    say_line(options,
             fmt::format("{}  {}  {:.1f} s", output, counted(frames, "frame"), ms / 1000.0));
}

// The frames whose pictures are not there, not whole, or made from something else, no matter by
// which renderer.
std::vector<int> missing_frames(const NumberedName& pictures, const Frames& frames,
                                const std::string& inputs, glm::uvec2 size) {
    std::vector<int> missing;
    std::mutex mutex;
    Workers workers(static_cast<int>(std::thread::hardware_concurrency()));
    workers.limit(free_memory() / 2 / (std::size_t{3} * size.x * size.y + 1));
    Progress progress("checking", frames.count);
    for (std::int64_t i = 0; i < frames.count; ++i) {
        workers.run([&, k = frames[i]] {
            if (is_made_from(pictures.name(k), fmt::format("{}-{}-", inputs, k))) return;
            const std::lock_guard lock(mutex);
            missing.push_back(k);
        });
        progress.update(i);
    }
    workers.finish();
    std::ranges::sort(missing);
    return missing;
}

// Without the folder that they would be in, nobody has begun, and there is no list to go through.
void require_folder(const SequenceOptions& options, const NumberedName& pictures,
                    const Frames& frames) {
    const fs::path folder = pictures.name(frames[0]).parent_path();
    std::error_code error;
    if (options.view.json || folder.empty() || fs::is_directory(folder, error)) return;
    say_error(fmt::format("all {} pictures are missing: there is no folder {}.", frames.count,
                          folder.string()));
    throw Stop(ExitCode::check_failed);
}

[[noreturn]] void stop_for_missing(const SequenceOptions& options, const std::vector<int>& missing,
                                   std::int64_t wanted) {
    if (options.view.json) say_result("{}\n", json_text(Json({{"missing", missing}})));
    if (!options.view.json && options.output != "-") say_result("{}\n", fmt::join(missing, "\n"));
    say_error(fmt::format("{} of {} pictures are missing, not whole, or of another sequence.",
                          missing.size(), wanted));
    throw Stop(ExitCode::check_failed);
}

// Of a film whose folder may come with its last picture: what no waiting mends.
void require_no_folder(const fs::path& film) {
    std::error_code error;
    if (fs::is_directory(film, error)) throw cannot_write(film, "Is a directory");
    const fs::path folder = film.parent_path();
    if (!folder.empty() && fs::exists(folder, error) && !fs::is_directory(folder, error))
        throw cannot_write(film, "Not a directory");
}

// The pictures of this very sequence, which others have drawn, become the film that drawing them
// here would have given. Only their sound is computed.
void join_pictures(const SequenceOptions& options, Target target, const Preset& preset,
                   const Frames& frames, const std::string& inputs) {
    const Stopwatch clock;
    const NumberedName pictures = *numbered_name(options.from_pictures);
    if (target == Target::film) require_no_folder(options.output);
    require_folder(options, pictures, frames);
    const std::vector<int> missing =
        missing_frames(pictures, frames, inputs, glm::uvec2(preset.size));
    if (!missing.empty()) stop_for_missing(options, missing, frames.count);
    std::unique_ptr<Context> context;
    if (preset.scene.has_sound) context = make_egl_context(options.view.device);
    std::optional<Film> film;
    if (target == Target::film) {
        film.emplace(options.output, preset.size, options.fps, sound_of(options, preset, frames));
    }
    Progress progress("frame", frames.count);
    for (std::int64_t i = 0; i < frames.count && !options.output.empty(); ++i) {
        const Image image = read_image(pictures.name(frames[i]));
        if (image.type != ChannelType::u8 || image.channels != 3) {
            throw std::runtime_error("A film is joined from pictures of three times 8 bits.");
        }
        film ? film->write(image) : write_to_stdout(image);
        progress.update(i + 1);
    }
    if (film) film->finish();
    print_joined(options, preset, frames.count, clock.ms());
}

void warn_of_settle(const Preset& preset) {
    if (preset.settle > 0)
        say_warning(fmt::format("{}: settle is for stills; each frame of a sequence is drawn once.",
                                preset.file.string()));
}

}  // namespace

Preset run_sequence(const SequenceOptions& options) {
    const Stopwatch clock;
    const Target target = target_of(options);
    Frames frames = frames_of(options.frames, options.shard, options.fps);
    const int last = frames.last();
    Preset preset = open_preset(options.view);
    require_size(options.output, target, preset.size);
    const int first = frames[0];
    const NamedFile written{"-o", options.output == "-" ? "" : options.output, first, last};
    require_files_apart(options, written, {"--from-pictures", options.from_pictures, first, last},
                        preset);
    // A joined film's folder may come with its last picture.
    if (options.from_pictures.empty()) require_files_writable(options, written);
    if (target == Target::film) heard_in(options, preset, frames);  // says what is too long
    const Provenance provenance = provenance_of(preset, options.fps, options.view.specialise);
    const std::string inputs = inputs_of(options, provenance);
    if (!options.from_pictures.empty()) {
        join_pictures(options, target, preset, frames, inputs);
        return preset;
    }
    const bool has_work = frames.count > 0;  // a share of few frames may be none
    if (target == Target::states) frames.count = 0;
    warn_of_settle(preset);

    const auto context = make_egl_context(options.view.device);
    const std::string gpu = context->renderer();
    Hash drawer;
    drawer.add(gpu);
    prepare_image_library(options.output);
    prepare_states(options.state);
    SequenceOutput output(options, target, preset, gpu,
                          {.inputs = inputs, .drawer = drawer.text()});
    const PictureKind kind{.floats = output.floats()};
    Renderer renderer(preset, compile_or_stop(preset, compile_options(options, kind)),
                      render_options(options, kind, preset.size));
    load_inputs(preset, renderer);
    renderer.compile_ahead();
    if (target == Target::film) output.begin_film(sound_of(options, preset, frames));

    const Playback playback{.end = last / options.fps, .fps = options.fps};
    States states(options.state, preset, renderer, playback, 0, provenance, gpu, options.resume);
    Run run{.preset = preset,
            .renderer = renderer,
            .context = *context,
            .playback = playback,
            .states = states,
            .output = output,
            .exposure = exposure_of(options, renderer.graph())};
    context->finish();  // the buffers count as taken only once they are cleared
    if (frames.count > 0) run.room = output.pictures_in_memory();
    skip_to_first_missing(run, frames);
    if (has_work) run.next = states.start(frames.count > 0 ? frames[0] : last);
    if (renderer.graph().stateful && frames.count > 0) simulate_to(run, frames[0]);
    draw_frames(run, frames);
    if (has_work && !options.state.save.empty() && run.next <= last) leave_state(run, last);
    output.finish();
    print_result(options, run, clock.ms());
    preset.time = playback.end;
    return preset;
}

}  // namespace glint
