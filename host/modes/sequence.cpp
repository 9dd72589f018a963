#include "modes/sequence.h"

#include "gl/context.h"
#include "modes/film.h"
#include "modes/hash.h"
#include "modes/input_files.h"
#include "modes/numbered_name.h"
#include "modes/sound.h"
#include "modes/workers.h"
#include "render/readback.h"
#include "sound/sound.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <deque>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What a GPU may draw while the first of them is still on its way to memory.
constexpr int kPicturesAhead = 2;

// The whole numbers of a text such as "10:20:2"; empty when it is not made of them.
std::vector<int> numbers_in(const std::string& text, char separator) {
    std::vector<int> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (;;) {
        const auto [rest, error] = std::from_chars(at, end, numbers.emplace_back());
        if (error != std::errc()) return {};
        if (rest == end) return numbers;
        if (*rest != separator) return {};
        at = rest + 1;
    }
}

struct Share {
    int number = 1, count = 1;
};

Share share_of(const std::string& text) {
    if (text.empty()) return {};
    const std::vector<int> numbers = numbers_in(text, '/');
    if (numbers.size() != 2 || numbers[0] < 1 || numbers[0] > numbers[1]) {
        throw UsageError(fmt::format("--shard {}: write K/N with K from 1 to N, as in 2/7.", text));
    }
    return {numbers[0], numbers[1]};
}

// The frames to be written, in order.
std::vector<int> frames_of(const SequenceOptions& options) {
    std::vector<int> range = {0, std::max(static_cast<int>(options.fps * 10.0) - 1, 0), 1};
    if (!options.frames.empty()) {
        range = numbers_in(options.frames, ':');
        if (range.size() == 2) range.push_back(1);
        if (range.size() != 3 || range[0] < 0 || range[1] < range[0] || range[2] < 1) {
            throw UsageError(fmt::format(
                "--frames {}: write FIRST:LAST or FIRST:LAST:STEP, as in 0:299.", options.frames));
        }
    }
    const Share share = share_of(options.shard);
    std::vector<int> frames;
    for (std::int64_t k = range[0], i = 0; k <= range[1]; k += range[2], ++i) {
        if (i % share.count == share.number - 1) frames.push_back(static_cast<int>(k));
    }
    return frames;
}

enum class Target { pictures, film, raw, states };

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
    if (!options.from_pictures.empty() && !numbered_name(options.from_pictures)) {
        throw UsageError(fmt::format("--from-pictures {}: name them as in frames/%06d.png.",
                                     options.from_pictures));
    }
    if (!options.from_pictures.empty() && target == Target::pictures) {
        throw UsageError("--from-pictures joins pictures that are there to a film.");
    }
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
        const std::string extension = fs::path(output).extension().string();
        if (target != Target::pictures || (extension != ".png" && extension != ".exr")) {
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

// All that a frame's picture follows from, but for its number and who drew it.
std::string inputs_of(const SequenceOptions& options, const Provenance& provenance) {
    Hash hash;
    hash.add(fmt::format("{} {} {} {}", options.samples, options.shutter, options.format.values,
                         options.format.compression));
    for (const auto& [name, text] : provenance) hash.add(text);
    return hash.text();
}

// Whether the file is there, whole, and says that it was made from these inputs; pictures tell of
// their making before their pixels.
bool is_made_from(const fs::path& file, const std::string& inputs) {
    std::ifstream in(file, std::ios::binary);
    std::string head(64 * 1024, '\0');
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    if (head.find(inputs) == std::string::npos) return false;
    try {
        read_image(file);
        return true;
    } catch (const std::runtime_error&) {
        return false;  // cut short by somebody else
    }
}

// What a run plays: the frames whose pictures are wanted, and where it ends.
struct Run {
    const Preset& preset;
    Renderer& renderer;
    Context& context;
    Playback playback;
    States& states;
    Workers& workers;
    double exposure = 0.0;  // s, of each picture
    int next = 0;           // the frame to be played next
    int simulated = 0, saved = 0;
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

// Draws the frames one after the other and hands their pictures, as RGBA, to `write`.
template <class Write>
void draw_frames(Run& run, const std::vector<int>& frames, bool floats, Write write) {
    const bool simulates = run.renderer.graph().stateful;
    Progress progress("frame", static_cast<long>(frames.size()));
    Readback readback(run.renderer, floats, run.context.is_software() ? 0 : kPicturesAhead);
    std::deque<Frame> on_the_way;
    long written = 0;
    const auto write_first = [&] {
        std::vector<std::byte> rgba = readback.take();
        run.context.check();
        write(on_the_way.front(), std::move(rgba));
        on_the_way.pop_front();
        progress.update(++written);
    };
    run.write_what_is_drawn = [&] {
        while (!on_the_way.empty()) write_first();
        run.workers.finish();
    };
    for (const int k : frames) {
        if (!simulates) run.next = k;
        run.advance_to(k);
        run.keep_state();
        on_the_way.push_back(run.playback.frame(run.preset, run.next++));
        on_the_way.back().exposure = run.exposure;
        run.renderer.draw(on_the_way.back());
        readback.send();
        if (readback.full()) write_first();
    }
    run.write_what_is_drawn();
    run.write_what_is_drawn = nullptr;
}

// Walks on to where the last state is saved.
void walk_to(Run& run, int last) {
    if (run.next > last) return;
    Progress progress("simulating", last - run.next);
    for (const int first = run.next; run.next < last;) {
        run.advance_to(run.next + 1);
        progress.update(run.next - first);
    }
    run.keep_state();
}

// The sound of a film as a WAV file without a name; -1 when the scene has none, or frames are left
// out and time runs faster.
int sound_of(const SequenceOptions& options, const Preset& preset, const std::vector<int>& frames) {
    if (!preset.scene.has_sound || frames.empty()) return -1;
    if (frames.back() - frames.front() + 1 != static_cast<int>(frames.size())) return -1;
    const auto sample_of = [&](double frame) {
        return std::lround(frame / options.fps * kSampleRate);
    };
    const long first = sample_of(frames.front());
    const long count = sample_of(frames.back() + 1.0) - first;
    const int file = ::memfd_create("sound", MFD_CLOEXEC);
    if (file < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
    SoundWriter writer(file, "sound.wav");
    render_sound(preset, options.view.specialise, first, count,
                 [&](auto samples) { writer.append(samples); });
    if (const int error = writer.finish())
        throw std::system_error(error, std::generic_category(), "the film's sound");
    return file;
}

void print_result(const SequenceOptions& options, const Preset& preset, const Run& run,
                  std::size_t written, std::size_t skipped, const std::string& renderer,
                  double ms) {
    const double rate = static_cast<double>(written) / (ms / 1000.0);
    if (options.view.json) {
        const Json json = {{"output", options.output},
                           {"scene", preset.scene.files.front().string()},
                           {"size", {preset.size.x, preset.size.y}},
                           {"renderer", renderer},
                           {"frames", written},
                           {"skipped", skipped},
                           {"simulated", run.simulated},
                           {"states_saved", run.saved},
                           {"specialised", options.view.specialise},
                           {"frames_per_second", rate},
                           {"ms", {{"total", ms}}}};
        fmt::print("{}\n", json.dump(2));
        return;
    }
    if (options.output.empty()) {
        fmt::print("{}  {} states  {} frames simulated  {:.1f} s\n", options.state.save, run.saved,
                   run.simulated, ms / 1000.0);
        return;
    }
    // Raw frames have stdout for themselves.
    fmt::print(options.output == "-" ? stderr : stdout,
               "{}  {} frames{}  {}x{}  {:.1f} s  {:.1f} frames/s\n", options.output, written,
               skipped ? fmt::format(", {} were there", skipped) : "", preset.size.x, preset.size.y,
               ms / 1000.0, rate);
}

void print_joined(const SequenceOptions& options, const Preset& preset, std::size_t frames,
                  double ms) {
    const std::string output =
        options.output.empty() ? options.from_pictures + ": all there" : options.output;
    if (options.view.json) {
        const Json json = {{"output", options.output},
                           {"scene", preset.scene.files.front().string()},
                           {"frames", frames},
                           {"missing", Json::array()},
                           {"ms", {{"total", ms}}}};
        fmt::print("{}\n", json.dump(2));
        return;
    }
    fmt::print(options.output == "-" ? stderr : stdout, "{}  {} frames  {:.1f} s\n", output, frames,
               ms / 1000.0);
}

// The frames whose pictures are not there, not whole, or made from something else, no matter by
// which renderer.
std::vector<int> missing_frames(const NumberedName& pictures, const std::vector<int>& frames,
                                const std::string& inputs) {
    std::vector<char> is_there(frames.size());  // each written by one thread
    Workers workers(static_cast<int>(std::thread::hardware_concurrency()));
    Progress progress("checking", static_cast<long>(frames.size()));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        workers.run([&, i] {
            is_there[i] =
                is_made_from(pictures.name(frames[i]), fmt::format("{}-{}-", inputs, frames[i]));
        });
        progress.update(static_cast<long>(i));
    }
    workers.finish();
    std::vector<int> missing;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (!is_there[i]) missing.push_back(frames[i]);
    }
    return missing;
}

[[noreturn]] void stop_for_missing(const SequenceOptions& options, const std::vector<int>& missing,
                                   std::size_t wanted) {
    if (options.view.json) fmt::print("{}\n", Json({{"missing", missing}}).dump(2));
    if (!options.view.json && options.output != "-") fmt::print("{}\n", fmt::join(missing, "\n"));
    fmt::print(stderr, "error: {} of {} pictures are missing, not whole, or of another sequence.\n",
               missing.size(), wanted);
    throw Stop(ExitCode::check_failed);
}

// The pictures of this very sequence, which others have drawn, become the film that drawing them
// here would have given. Only their sound is computed.
void join_pictures(const SequenceOptions& options, Target target, const Preset& preset,
                   const std::vector<int>& frames, const std::string& inputs) {
    const Stopwatch clock;
    const NumberedName pictures = *numbered_name(options.from_pictures);
    const std::vector<int> missing = missing_frames(pictures, frames, inputs);
    if (!missing.empty()) stop_for_missing(options, missing, frames.size());
    std::unique_ptr<Context> context;
    if (preset.scene.has_sound) context = make_egl_context(options.view.device);
    std::optional<Film> film;
    if (target == Target::film) {
        film.emplace(options.output, preset.size, options.fps, sound_of(options, preset, frames));
    }
    Progress progress("frame", static_cast<long>(frames.size()));
    for (std::size_t i = 0; i < frames.size() && !options.output.empty(); ++i) {
        const Image image = read_image(pictures.name(frames[i]));
        if (image.type != ChannelType::u8 || image.channels != 3) {
            throw std::runtime_error("A film is joined from png pictures.");
        }
        film ? film->write(image) : write_all(STDOUT_FILENO, raw_frame(image));
        progress.update(static_cast<long>(i) + 1);
    }
    if (film) film->finish();
    print_joined(options, preset, frames.size(), clock.ms());
}

}  // namespace

void run_sequence(const SequenceOptions& options) {
    const Stopwatch clock;
    const Target target = target_of(options);
    std::vector<int> frames = frames_of(options);
    const int last = frames.empty() ? 0 : frames.back();
    if (target == Target::states && options.from_pictures.empty()) frames.clear();
    const std::size_t wanted = frames.size();
    const Preset preset = open_preset(options.view);
    const Provenance provenance = provenance_of(preset, options.fps, options.view.specialise);
    const std::string inputs = inputs_of(options, provenance);
    if (!options.from_pictures.empty()) {
        return join_pictures(options, target, preset, frames, inputs);
    }
    const auto context = make_egl_context(options.view.device);
    const std::string gpu = context->renderer();
    Hash drawer;
    drawer.add(gpu);
    const std::optional<NumberedName> pattern = numbered_name(options.output);
    const auto made_from = [&](int frame) {
        return fmt::format("{}-{}-{};", inputs, frame, drawer.text());
    };
    if (options.resume) {
        std::erase_if(frames, [&](int k) { return is_made_from(pattern->name(k), made_from(k)); });
    }

    prepare_image_library(options.output);
    const bool floats = target == Target::pictures && holds_floats(options.output);
    Renderer renderer(preset,
                      compile_or_stop(preset, {.program = {.specialise = options.view.specialise,
                                                           .average = options.samples > 1,
                                                           .clamp_to_bytes = !floats}}),
                      {.size = preset.size,
                       .picture_format = floats ? PixelFormat::rgba32f : PixelFormat::rgba8,
                       .samples = options.samples,
                       .in_strips = true});
    load_inputs(preset, renderer);

    std::optional<Film> film;
    if (target == Target::film) {
        film.emplace(options.output, preset.size, options.fps, sound_of(options, preset, frames));
    }
    // Pictures are files of their own and may overtake each other; a stream may not.
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    Workers workers(target == Target::pictures ? std::clamp(cores, 1, 16) : 1);
    const auto write = [&](const Frame& frame, std::vector<std::byte> rgba) {
        workers.run([&, k = frame.frame, metadata = picture_metadata(preset, frame, gpu),
                     rgba = std::move(rgba)]() mutable {
            const Image image = picture_without_alpha(rgba, preset.size,
                                                      floats ? ChannelType::f32 : ChannelType::u8);
            if (target == Target::film) return film->write(image);
            if (target == Target::raw) return write_all(STDOUT_FILENO, raw_frame(image));
            metadata.emplace_back("glint:samples", fmt::format("{}", options.samples));
            metadata.emplace_back("glint:inputs", made_from(k));
            if (options.shutter > 0.0) {
                metadata.emplace_back("glint:shutter", fmt::format("{}", options.shutter));
            }
            write_image(pattern->name(k), image, metadata, options.format);
        });
    };
    const Playback playback{.end = last / options.fps, .fps = options.fps};
    States states(options.state, preset, renderer, playback, 0, provenance, gpu, options.resume);
    Run run{
        .preset = preset,
        .renderer = renderer,
        .context = *context,
        .playback = playback,
        .states = states,
        .workers = workers,
        .exposure = exposure_of(options.shutter, options.fps, options.samples, renderer.graph())};
    run.next = states.start(frames.empty() ? last : frames.front());
    draw_frames(run, frames, floats, write);
    if (!options.state.save.empty()) walk_to(run, last);
    workers.finish();
    if (film) film->finish();
    print_result(options, preset, run, frames.size(), wanted - frames.size(), gpu, clock.ms());
}

}  // namespace glint
