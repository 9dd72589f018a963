#include "offline/common.h"

#include "base/canonical_name.h"
#include "base/say.h"
#include "base/terminal.h"
#include "base/words.h"
#include "media/image.h"
#include "scene/blame.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <set>

namespace glint {
namespace {

// iFrame is an int: more than a year at 60 Hz, and settling counts a little further.
constexpr double kMostFrames = 2e9;

glm::ivec2 parse_size(const std::string& text) {
    glm::ivec2 size{0};
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.x);
    const bool separated = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = separated ? std::from_chars(width.ptr + 1, end, size.y) : width;
    if (!separated || height.ec != std::errc() || height.ptr != end || size.x < 1 || size.y < 1) {
        throw UsageError(
            fmt::format("--size {}: write the width and height in pixels, as in 1280x720.", text));
    }
    return size;
}

// Returns what there is to say of a value beyond the range; "" of others.
std::string apply_tweak(Preset& preset, const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string name = assignment.substr(0, equals);
    const auto& tweaks = preset.scene.tweaks;
    const auto found = std::ranges::find(tweaks, name, &Tweak::name);
    if (found == tweaks.end()) {
        throw UsageError(
            fmt::format("--tweak {}: {}", assignment, no_such_tweak(preset.scene, name)));
    }
    const std::string_view written =
        std::string_view(assignment).substr(std::min(name.size() + 1, assignment.size()));
    const auto value = parse_value(*found, written);
    if (!value) {
        const std::string meant = did_you_mean(trimmed(written), found->names);
        throw UsageError(fmt::format("--tweak {}: write {}=VALUE with {}{}", assignment, name,
                                     expected_value(*found), meant.empty() ? "." : meant));
    }
    TweakValue& kept = preset.values[static_cast<std::size_t>(found - tweaks.begin())];
    kept = clamp_to_range(*found, *value);
    if (kept == *value) return {};
    return fmt::format("--tweak {}: outside its range, taken as {}", assignment,
                       format_value(*found, kept));
}

}  // namespace

std::string no_such_tweak(const Scene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (const Tweak& tweak : scene.tweaks) names.push_back(tweak.name);
    const std::string meant = did_you_mean(name, names);
    return fmt::format("the scene has no tweak {} (it has {}){}", in_quotes(name),
                       names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                       meant.empty() ? "." : meant);
}

Progress::Progress(std::string what, long total, Unit unit)
    : what_(std::move(what)), total_(total), unit_(unit), enabled_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (shown_) say("\r\033[K");
}

void Progress::update(long done) {
    if (!enabled_ || since_last_.ms() < (shown_ ? 100.0 : 500.0)) return;
    since_last_.restart();
    shown_ = true;
    constexpr long kWidth = 30;
    const auto filled = static_cast<std::size_t>(kWidth * done / std::max(total_, 1L));
    const double rate = static_cast<double>(done) / (since_start_.ms() / 1000.0);
    const auto left = static_cast<long>(
        rate > 0.0 ? std::min(static_cast<double>(total_ - done) / rate, 360000.0) : 360000.0);
    const std::string state = unit_ == Unit::percent
                                  ? fmt::format("{} %", 100 * done / std::max(total_, 1L))
                                  : fmt::format("{}/{}  {:.1f}/s", done, total_, rate);
    say("\r{} [{:<{}}] {}  {}:{:02} left\033[K", what_, std::string(filled, '#'), kWidth, state,
        left / 60, left % 60);
}

static bool are_warnings_hushed = false;

void hush_warnings() {
    are_warnings_hushed = true;
}

void report(const Diagnostics& diagnostics) {
    constexpr std::size_t kMostSaid = 100;
    static std::set<std::string> known;  // a text is compiled in many forms, and says it in each
    bool missing = false;
    std::size_t said = 0;
    for (const Diagnostic& diagnostic : diagnostics) {
        const bool is_hushed = are_warnings_hushed && diagnostic.severity == Severity::warning;
        if (!is_hushed && known.insert(to_string(diagnostic)).second && ++said <= kMostSaid)
            say_diagnostic(diagnostic);
        // No shader is at fault where a preset cannot be read.
        const bool unreadable =
            diagnostic.missing_file || ending_of(diagnostic.place.file) == ".toml";
        missing |= diagnostic.severity == Severity::error && unreadable;
    }
    if (said > kMostSaid) say("… and {} more\n", said - kMostSaid);
    if (has_errors(diagnostics)) throw Stop(missing ? ExitCode::missing_file : ExitCode::shader);
}

glm::ivec2 size_of(const ViewOptions& options, glm::ivec2 otherwise) {
    return options.size.empty() ? otherwise : parse_size(options.size);
}

namespace {

void apply_quality(Preset& preset, const std::string& name) {
    const auto found = std::ranges::find(preset.qualities, name, &QualitySet::name);
    if (found == preset.qualities.end()) {
        std::vector<std::string> names;
        for (const QualitySet& set : preset.qualities) names.push_back(set.name);
        throw UsageError(
            fmt::format("--quality: {} has no [quality.{}] (it has {}){}", preset.file.string(),
                        name, names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                        did_you_mean(name, names)));
    }
    for (const Turned& turned : found->values) preset.values[turned.tweak] = turned.value;
}

}  // namespace

std::vector<std::string> tweak_words(const ViewOptions& view) {
    std::vector<std::string> words;
    if (!view.quality.empty()) words = {"--quality", view.quality};
    for (const std::string& tweak : view.tweaks) words.insert(words.end(), {"--tweak", tweak});
    return words;
}

std::vector<std::string> lay_over(Preset& preset, const ViewOptions& options) {
    std::vector<std::string> clamped;
    preset.size = size_of(options, preset.size);
    preset.has_size |= !options.size.empty();
    if (!options.quality.empty()) apply_quality(preset, options.quality);
    for (const std::string& tweak : options.tweaks) {
        std::string warning = apply_tweak(preset, tweak);
        if (!warning.empty()) clamped.push_back(std::move(warning));
    }
    return clamped;
}

Preset open_preset(const ViewOptions& options) {
    ReadPreset read = read_preset(options.file);
    report(read.diagnostics);
    if (!read.preset) throw Stop(ExitCode::failure);
    for (const std::string& warning : lay_over(*read.preset, options)) say_warning(warning);
    return std::move(*read.preset);
}

Preset open_preset_again(const ViewOptions& options) {
    ReadPreset read = read_preset(options.file);
    if (!read.preset) throw Stop(ExitCode::failure);
    lay_over(*read.preset, options);
    return std::move(*read.preset);
}

std::size_t find_pass(const Scene& scene, const std::string& name, bool or_sound) {
    if (name == "image") return kImagePass;
    std::vector<std::string> names = {"image"};
    if (or_sound && scene.has_sound) {
        if (name == "sound") return kSoundPass;
        names.emplace_back("sound");
    }
    for (std::size_t i = 0; i < scene.passes.size(); ++i) {
        for (const std::string& output : scene.passes[i].outputs) {
            if (output == name) return i;
            names.push_back(output);
        }
    }
    const std::string meant = did_you_mean(name, names);
    throw UsageError(fmt::format("The scene has no pass {}; it has {}{}", in_quotes(name),
                                 fmt::join(names, ", "), meant.empty() ? "." : meant));
}

Diagnostic given_up(const Preset& preset, std::size_t pass, const std::string& why) {
    const std::string name = pass_name(preset.scene, pass);
    // Mesa 22.3 divides constants with the processor, which has no answer to -2147483648 / -1.
    const bool divides = why.find(::strsignal(SIGFPE)) != std::string::npos;
    return {Severity::error, entry_place(preset.scene, name),
            fmt::format(
                "pass {}: the driver {}; is there {}?", name, why,
                divides ? "a division or a remainder of the int -2147483648 by -1, both constants"
                        : "a huge array, a macro that grows, or an expression or a chain "
                          "of calls nested too deep")};
}

namespace {

// The driver works on, so that nothing is taken down in order: the process ends. What is written
// has its name only when it is whole.
void end_compiling(const Preset& preset, std::size_t pass, const std::string& why) {
    const std::string line = shown(given_up(preset, pass, why), terminal_at_stderr()) + "\n";
    std::fflush(stdout);
    if (::write(STDERR_FILENO, line.data(), line.size()) < 0) {
        // Nobody listens; the exit code tells.
    }
    ::_exit(static_cast<int>(ExitCode::shader));
}

}  // namespace

CompiledScene compile_or_stop(const Preset& preset, CompileOptions options) {
    options.side_by_side = true;
    CompileResult result = compile_scene(preset, options, nullptr, end_compiling);
    report(result.diagnostics);
    if (!result.scene) throw Stop(ExitCode::shader);
    return std::move(*result.scene);
}

Metadata picture_metadata(const Preset& preset, const Frame& frame, const std::string& renderer) {
    Metadata list = {{"Software", "glint " GLINT_VERSION},
                     {"glint:scene", preset.scene.files.front().filename().string()},
                     {"glint:time", fmt::format("{}", frame.time)},
                     {"glint:frame", fmt::format("{}", frame.frame)},
                     {"glint:renderer", renderer}};
    if (preset.file != preset.scene.files.front()) {
        list.emplace_back("glint:preset", preset.file.filename().string());
    }
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = preset.scene.tweaks[i];
        list.emplace_back("glint:tweak:" + tweak.name, format_value(tweak, preset.values[i]));
    }
    return list;
}

namespace {

// Each pixel moves to the front, or stays.
template <class Value>
void leave_out_alpha(std::byte* pixels, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        std::array<std::byte, 3 * sizeof(Value)> rgb;
        std::memcpy(rgb.data(), pixels + i * 4 * sizeof(Value), rgb.size());
        std::memcpy(pixels + i * 3 * sizeof(Value), rgb.data(), rgb.size());
    }
}

}  // namespace

Image picture_without_alpha(std::vector<std::byte> rgba, glm::ivec2 size, ChannelType type) {
    const std::size_t count = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    if (type == ChannelType::f32)
        leave_out_alpha<float>(rgba.data(), count);
    else
        leave_out_alpha<std::byte>(rgba.data(), count);
    rgba.resize(rgba.size() / 4 * 3);
    return {.size = size, .channels = 3, .type = type, .pixels = std::move(rgba)};
}

Image read_picture(Renderer& renderer, bool floats) {
    const glm::ivec2 size = renderer.root_size();
    std::vector<std::byte> rgba(static_cast<std::size_t>(size.x) *
                                static_cast<std::size_t>(size.y) * (floats ? 16 : 4));
    renderer.read_picture(floats, rgba.data());
    return picture_without_alpha(std::move(rgba), size,
                                 floats ? ChannelType::f32 : ChannelType::u8);
}

Frame frame_at(const Preset& preset, double previous, double time, double delta, int index) {
    Frame frame;
    frame.time = time;
    frame.time_delta = delta;
    frame.frame_rate = 1.0 / delta;
    frame.frame = index;
    frame.date = shadertoy_date(preset.date, time);
    frame.input = replay(preset.events, previous, time, preset.size);
    frame.events = preset.events;
    return frame;
}

int Playback::last_frame() const {
    // The tolerance forgives times such as 7/60 s, which lie a rounding off a whole frame.
    return static_cast<int>(std::clamp(std::ceil(end * fps - 1e-6), 0.0, kMostFrames));
}

Frame Playback::frame(const Preset& preset, int index) const {
    // The last frames are one frame apart, also where those before cannot be counted.
    const double uncounted = std::max(end - kMostFrames / fps, 0.0);
    const auto time_of = [&](int k) { return k >= last_frame() ? end : uncounted + k / fps; };
    const double time = time_of(index);
    const double previous =
        index == 0 ? -std::numeric_limits<double>::infinity() : time_of(index - 1);
    Frame frame =
        frame_at(preset, previous, time, index == 0 ? 1.0 / 60.0 : time - previous, index);
    if (mouse_size != glm::ivec2(0)) {
        frame.mouse_size = mouse_size;
        frame.input = replay(preset.events, previous, time, mouse_size);
    }
    if (uncounted > 0.0) frame.longest_catch_up = 2.0 / fps;  // no frame makes up for those
    return frame;
}

Frame settled_frame(const Preset& preset, const Playback& playback, int extra) {
    Frame frame = playback.frame(preset, playback.last_frame());
    if (extra == 0) return frame;
    frame.frame += extra;
    frame.time_delta = 1.0 / 60.0;
    frame.frame_rate = 60.0;
    frame.input = replay(preset.events, frame.time, frame.time, preset.size);
    return frame;
}

Frame play(const Preset& preset, Renderer& renderer, const Playback& playback, int settle,
           int& frames_rendered, int first) {
    if (renderer.graph().stateful) {
        const int last = playback.last_frame();
        Progress progress("simulating", last + settle - first);
        for (int k = first; k < last + settle; ++k) {
            renderer.advance(k <= last ? playback.frame(preset, k)
                                       : settled_frame(preset, playback, k - last));
            progress.update(k - first);
        }
        frames_rendered += last + settle - first;
    }
    ++frames_rendered;
    return settled_frame(preset, playback, settle);
}

}  // namespace glint
