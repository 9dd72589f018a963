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

// What is not a number is silence.
float audible(float value) {
    return value > -1.0f ? std::min(value, 1.0f) : value <= -1.0f ? -1.0f : 0.0f;
}

}  // namespace

SoundRenderer::SoundRenderer(const Preset& preset, const ProgramOptions& options)
    : preset_(preset),
      renderer_(
          preset, compile_or_stop(preset, {.root = kSoundPass, .program = options}),
          {.size = {kSoundBlockWidth, kSoundBlockRows}, .picture_format = PixelFormat::rgba32f}) {
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
    long done = 0;
    for (long block = first / kBlock; block * kBlock < first + count; ++block) {
        const std::vector<float> pairs = renderer.block(block);
        const long begin = std::max(first - block * kBlock, 0L);
        const long end = std::min(first + count - block * kBlock, kBlock);
        samples.clear();
        for (auto i = static_cast<std::size_t>(2 * begin); i < static_cast<std::size_t>(2 * end);
             ++i)
            samples.push_back(static_cast<std::int16_t>(std::lround(pairs[i] * 32767.0f)));
        writer.append(samples);
        progress.update(done += end - begin);
    }
    return writer.finish();
}

void run_sound(const SoundOptions& options) {
    const Stopwatch clock;
    if (!can_write_sound(options.output)) {
        throw UsageError(
            fmt::format("-o {}: name a .wav, .flac or .ogg file.", options.output.string()));
    }
    const long count = std::lround(options.seconds * kSampleRate);
    if (count < 1) throw UsageError("--seconds: it is less than a sample; name more, such as 10.");
    const Preset preset = open_preset(options.view);
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
}

}  // namespace glint
