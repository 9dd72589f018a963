#include "offline/sound.h"

#include "base/json_text.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "gl/context.h"
#include "media/sound.h"
#include "offline/input_files.h"
#include "offline/named_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace glint {
namespace {

constexpr long kBlock = SoundRenderer::kBlock;
constexpr long kMostSamples = 0x7fffffff;  // that an int counts

// What is not a number is silence.
float audible(float value) {
    return value > -1.0f ? std::min(value, 1.0f) : value <= -1.0f ? -1.0f : 0.0f;
}

// What a file cannot keep of a scene's samples.
class Lost {
public:
    void add(float value) {
        constexpr float kHeard = 1.01f;  // a rounding beyond 1 is not
        ++count_;
        none_ += std::isfinite(value) ? 0 : 1;
        if (!std::isfinite(value) || std::abs(value) <= kHeard) return;
        ++beyond_;
        largest_ = std::max(largest_, std::abs(value));
    }

    // "" for nothing.
    std::string words() const {
        std::string text;
        if (beyond_ > 0)
            text = fmt::format(
                "{} of the samples lie beyond -1 and 1, up to {:.3g}, and are cut off there; "
                "multiply them by {:.2g}",
                share(beyond_), largest_, 0.95 / static_cast<double>(largest_));
        if (none_ > 0)
            text += fmt::format("{}{} of the samples are NaN or infinite", text.empty() ? "" : "; ",
                                share(none_));
        return text;
    }

private:
    std::string share(long some) const {
        const double percent = 100.0 * static_cast<double>(some) / static_cast<double>(count_);
        return percent < 0.1 ? fmt::format("{}", some) : fmt::format("{:.3g} %", percent);
    }
    long count_ = 0, beyond_ = 0, none_ = 0;
    float largest_ = 0.0f;
};

}  // namespace

SoundRenderer::SoundRenderer(const Preset& preset, const ProgramOptions& options)
    : preset_(preset),
      renderer_(preset, compile_or_stop(preset, {.root = kSoundPass, .program = options}),
                {.size = preset.size, .picture_format = PixelFormat::rgba32f}) {
    load_inputs(preset, renderer_);
}

Frame SoundRenderer::frame_of(long index) const {
    Frame frame;
    frame.time = static_cast<double>(index * kBlock) / kSampleRate;
    frame.frame = static_cast<int>(index);
    frame.date = shadertoy_date(preset_.date, 0.0);
    return frame;
}

std::vector<float> SoundRenderer::drawn(const Frame& frame) {
    renderer_.redraw();
    renderer_.draw(frame);
    return renderer_.read_floats();
}

std::vector<float> SoundRenderer::block(long index) {
    const std::vector<float> rgba = drawn(frame_of(index));
    std::vector<float> pairs;
    pairs.reserve(2 * kBlock);
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        pairs.push_back(audible(rgba[i]));
        pairs.push_back(audible(rgba[i + 1]));
    }
    return pairs;
}

int write_sound(const Preset& preset, bool specialise, long first, long count,
                const TemporaryFile& out, const std::filesystem::path& name) {
    SoundWriter writer(out.descriptor(), name);
    SoundRenderer renderer(preset, {.specialise = specialise});
    Progress progress("sound", count);
    std::vector<std::int16_t> samples;
    Lost lost;
    long done = 0;
    // What a buffer keeps hangs on all blocks before.
    for (long block = 0; renderer.renderer().graph().stateful && block < first / kBlock; ++block)
        renderer.renderer().advance(renderer.frame_of(block));
    for (long block = first / kBlock; block * kBlock < first + count; ++block) {
        const std::vector<float> rgba = renderer.drawn(renderer.frame_of(block));
        const long begin = std::max(first - block * kBlock, 0L);
        const long end = std::min(first + count - block * kBlock, kBlock);
        samples.clear();
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
            for (const float value : {rgba[4 * i], rgba[4 * i + 1]}) {
                lost.add(value);
                samples.push_back(
                    static_cast<std::int16_t>(std::lround(audible(value) * 32767.0f)));
            }
        writer.append(samples);
        progress.update(done += end - begin);
    }
    if (first + count > kMostSamples)
        say("{}: warning: `samp` ends after 13 h 31 min, where an int does, and goes on from "
            "-2147483648\n",
            preset.scene.files.front().string());
    if (const std::string words = lost.words(); !words.empty())
        say("{}: warning: {}\n", preset.scene.files.front().string(), words);
    return writer.finish();
}

Preset run_sound(const SoundOptions& options) {
    const Stopwatch clock;
    if (!can_write_sound(options.output)) {
        throw UsageError(
            fmt::format("-o {}: name a .wav, .flac or .ogg file.", options.output.string()));
    }
    const long count = std::lround(options.seconds * kSampleRate);
    if (count < 1) throw UsageError("--seconds: it is less than a sample; name more, such as 10.");
    Preset preset = open_preset(options.view);
    if (!preset.scene.has_sound) {
        throw UsageError(fmt::format(
            "{} has no sound; it would be vec2 mainSound(int samp, float time) {{ ... }}.",
            preset.scene.files.front().string()));
    }
    require_apart({{"-o", options.output.string()}}, files_read_for(preset));
    const auto context = make_egl_context(options.view.device);
    TemporaryFile out(options.output);
    if (const int error =
            write_sound(preset, options.view.specialise, 0, count, out, options.output)) {
        out.fail(error);
    }
    out.commit();
    if (options.view.json) {
        const nlohmann::ordered_json json = {{"output", options.output.string()},
                                             {"scene", preset.scene.files.front().string()},
                                             {"seconds", options.seconds},
                                             {"rate", kSampleRate},
                                             {"channels", 2},
                                             {"renderer", context->renderer()},
                                             {"ms", {{"total", clock.ms()}}}};
        say_result("{}\n", json_text(json));
    } else {
        say_result("{}  {:.1f} s of sound  {:.0f} ms\n", options.output.string(), options.seconds,
                   clock.ms());
    }
    return preset;
}

}  // namespace glint
