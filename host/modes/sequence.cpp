#include "modes/sequence.h"

#include "gl/context.h"
#include "modes/film.h"
#include "modes/sound.h"
#include "modes/workers.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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

// "out.%04d.png" as what stands before the number, its least digits, and what stands after.
struct Pattern {
    std::string before, after;
    int digits = 0;

    fs::path name(int frame) const {
        return fmt::format("{}{:0{}}{}", before, frame, digits, after);
    }
};

std::optional<Pattern> pattern_of(const std::string& text) {
    const std::size_t percent = text.find('%');
    const std::size_t d = text.find('d', percent);
    if (percent == std::string::npos || d == std::string::npos) return std::nullopt;
    const std::string digits = text.substr(percent + 1, d - percent - 1);
    const bool is_plain = digits.size() <= 3 && std::ranges::all_of(digits, [](unsigned char c) {
                              return std::isdigit(c) != 0;
                          });
    if (!is_plain || text.find('%', d) != std::string::npos) return std::nullopt;
    return Pattern{.before = text.substr(0, percent),
                   .after = text.substr(d + 1),
                   .digits = digits.empty() ? 0 : std::stoi(digits)};
}

enum class Target { pictures, film, raw };

Target target_of(const SequenceOptions& options) {
    const std::string& output = options.output;
    const bool is_numbered = pattern_of(output).has_value();
    const Target target = output == "-"                     ? Target::raw
                          : is_film(output) && !is_numbered ? Target::film
                                                            : Target::pictures;
    if (target == Target::pictures && (!is_numbered || !can_write(output))) {
        throw UsageError(
            fmt::format("-o {}: name pictures such as out.%04d.png (or exr, jpg, tif, hdr), a film "
                        "(mp4, webm, mov, gif), or - for raw frames on stdout.",
                        output));
    }
    if (target != Target::pictures && !options.shard.empty()) {
        throw UsageError("--shard shares pictures out; a film is made of all of them.");
    }
    if (options.resume) {
        const std::string extension = fs::path(output).extension().string();
        if (target != Target::pictures || (extension != ".png" && extension != ".exr")) {
            throw UsageError(
                "--resume needs pictures that tell what they were made from: png or "
                "exr.");
        }
    }
    if (target == Target::raw && (options.view.json || isatty(STDOUT_FILENO))) {
        throw UsageError("-o - writes bytes to stdout: pipe them to a program, without --json.");
    }
    return target;
}

// FNV-1a (Fowler, Noll and Vo 1991), 64 bits.
class Hash {
public:
    void add(std::string_view text) {
        for (const char c : text)
            value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211u;
        value_ = (value_ ^ 0xffu) * 1099511628211u;  // "ab", "c" is not "a", "bc"
    }
    std::string text() const { return fmt::format("{:016x}", value_); }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

std::string content_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// All that a frame's picture follows from, but for its number.
std::string inputs_of(const SequenceOptions& options, const Preset& preset,
                      const std::string& renderer) {
    Hash hash;
    for (const std::string& part : {std::string(GLINT_VERSION), renderer, preset.scene.text}) {
        hash.add(part);
    }
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        hash.add(format_value(preset.scene.tweaks[i], preset.values[i]));
    }
    for (const Event& event : preset.events) {
        hash.add(fmt::format("{} {} {} {} {}", event.time, event.key, event.down, event.mouse.x,
                             event.mouse.y));
    }
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        if (sampler.source == Source::image) hash.add(content_of(sampler.image));
    }
    hash.add(fmt::format("{} {} {} {} {} {} {} {} {}", preset.size.x, preset.size.y, options.fps,
                         options.samples, options.view.specialise, preset.date.year,
                         preset.date.month, preset.date.day, preset.date.seconds));
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

// Draws the frames one after the other and hands their pictures to `write`.
template <class Write>
void draw_frames(const SequenceOptions& options, const Preset& preset, Renderer& renderer,
                 Context& context, const std::vector<int>& frames, bool floats, Write write) {
    if (frames.empty()) return;
    const Playback playback{.end = frames.back() / options.fps, .fps = options.fps};
    const bool simulates = renderer.graph().stateful;
    Progress progress("frame", static_cast<long>(frames.size()));
    int played = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (!simulates) played = frames[i];
        for (; played < frames[i]; ++played) renderer.advance(playback.frame(preset, played));
        const Frame frame = playback.frame(preset, played++);
        renderer.draw(frame);
        Image image = read_picture(renderer, floats);
        context.finish();
        write(frame, std::move(image));
        progress.update(static_cast<long>(i) + 1);
    }
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
    write_all(file, wav_header(count));
    render_sound(preset, options.view.specialise, first, count,
                 [&](auto samples) { write_all(file, std::as_bytes(samples)); });
    return file;
}

void print_result(const SequenceOptions& options, const Preset& preset, std::size_t written,
                  std::size_t skipped, const std::string& renderer, double ms) {
    const double rate = static_cast<double>(written) / (ms / 1000.0);
    if (options.view.json) {
        const Json json = {{"output", options.output},
                           {"scene", preset.scene.files.front().string()},
                           {"size", {preset.size.x, preset.size.y}},
                           {"renderer", renderer},
                           {"frames", written},
                           {"skipped", skipped},
                           {"specialised", options.view.specialise},
                           {"frames_per_second", rate},
                           {"ms", {{"total", ms}}}};
        fmt::print("{}\n", json.dump(2));
        return;
    }
    // Raw frames have stdout for themselves.
    fmt::print(options.output == "-" ? stderr : stdout,
               "{}  {} frames{}  {}x{}  {:.1f} s  {:.1f} frames/s\n", options.output, written,
               skipped ? fmt::format(", {} were there", skipped) : "", preset.size.x, preset.size.y,
               ms / 1000.0, rate);
}

}  // namespace

void run_sequence(const SequenceOptions& options) {
    const Stopwatch clock;
    const Target target = target_of(options);
    std::vector<int> frames = frames_of(options);
    const std::size_t wanted = frames.size();
    const Preset preset = open_preset(options.view);
    const auto context = make_egl_context(options.view.device);
    const std::string gpu = context->renderer();
    const std::string inputs = inputs_of(options, preset, gpu);
    const std::optional<Pattern> pattern = pattern_of(options.output);
    const auto made_from = [&](int frame) { return fmt::format("{}-{};", inputs, frame); };
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
                       .samples = options.samples});
    load_images(preset, renderer);

    std::optional<Film> film;
    if (target == Target::film) {
        film.emplace(options.output, preset.size, options.fps, sound_of(options, preset, frames));
    }
    // Pictures are files of their own and may overtake each other; a stream may not.
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    Workers workers(target == Target::pictures ? std::clamp(cores / 2, 1, 8) : 1);
    const auto write = [&](const Frame& frame, Image image) {
        workers.run([&, k = frame.frame, metadata = picture_metadata(preset, frame, gpu),
                     image = std::move(image)]() mutable {
            if (target == Target::film) return film->write(image);
            if (target == Target::raw) return write_all(STDOUT_FILENO, raw_frame(image));
            metadata.emplace_back("glint:samples", fmt::format("{}", options.samples));
            metadata.emplace_back("glint:inputs", made_from(k));
            write_image(pattern->name(k), image, metadata);
        });
    };
    draw_frames(options, preset, renderer, *context, frames, floats, write);
    workers.finish();
    if (film) film->finish();
    print_result(options, preset, frames.size(), wanted - frames.size(), gpu, clock.ms());
}

}  // namespace glint
