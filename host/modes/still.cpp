#include "modes/still.h"

#include "gl/context.h"
#include "image/image.h"
#include "modes/input_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

// How the time of a `still` splits, in milliseconds.
struct Split {
    double load = 0, context = 0, compile = 0, render = 0, read = 0, encode = 0, total = 0;
};

void check_options(const StillOptions& options) {
    if (!can_write(options.output)) {
        throw UsageError(fmt::format("-o {}: name a .png, .exr, .jpg, .tif or .hdr file.",
                                     options.output.string()));
    }
    if (options.time && options.frame) throw UsageError("Give either --time or --frame, not both.");
    if (options.samples > 1 && options.pass != "image") {
        throw UsageError("--samples averages the picture; a buffer is written as it is.");
    }
}

Playback playback_of(const StillOptions& options, const Preset& preset) {
    if (options.frame) return {.end = *options.frame / options.fps, .fps = options.fps};
    return {.end = options.time.value_or(preset.time), .fps = options.fps};
}

// A byte that a display would show for a value: clamped, rounded; not-a-number is black.
std::byte to_byte(float value) {
    return static_cast<std::byte>(value > 0.0f ? std::lround(std::min(value, 1.0f) * 255.0f) : 0);
}

// Float files of a buffer keep all four channels.
Image read_back(Renderer& renderer, const Preset& preset, std::size_t pass,
                const StillOptions& options) {
    const bool floats = holds_floats(options.output);
    if (pass == kImagePass) return read_picture(renderer, floats);
    const int channels = floats ? 4 : 3;
    Image image{.size = renderer.root_size(),
                .channels = channels,
                .type = floats ? ChannelType::f32 : ChannelType::u8,
                .pixels = {}};
    const std::size_t count =
        static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y);
    const auto kept = static_cast<std::size_t>(channels);
    const auto& names = preset.scene.passes[pass].outputs;
    const auto output = static_cast<std::size_t>(
        std::find(names.begin(), names.end(), options.pass) - names.begin());
    const std::vector<float> rgba = renderer.read_floats(output);
    image.pixels.resize(count * kept * (floats ? sizeof(float) : 1));
    for (std::size_t i = 0; i < count * kept; ++i) {
        const float value = rgba[i / kept * 4 + i % kept];
        if (floats)
            std::memcpy(image.pixels.data() + i * sizeof(float), &value, sizeof value);
        else
            image.pixels[i] = to_byte(value);
    }
    return image;
}

void print_result(const StillOptions& options, const Preset& preset, const Image& image,
                  const Frame& frame, int frames_rendered, const std::string& renderer,
                  const Split& ms) {
    if (!options.view.json) {
        fmt::print("{}  {}x{}  {:.0f} ms\n", options.output.string(), image.size.x, image.size.y,
                   ms.total);
        return;
    }
    const Json json = {{"output", options.output.string()},
                       {"scene", preset.scene.files.front().string()},
                       {"size", {image.size.x, image.size.y}},
                       {"frame", frame.frame},
                       {"time", frame.time},
                       {"renderer", renderer},
                       {"frames_rendered", frames_rendered},
                       {"samples", options.samples},
                       {"specialised", options.view.specialise},
                       {"ms",
                        {{"context", ms.context},
                         {"load", ms.load},
                         {"compile", ms.compile},
                         {"render", ms.render},
                         {"read", ms.read},
                         {"encode", ms.encode},
                         {"total", ms.total}}}};
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

void run_still(const StillOptions& options, const Stopwatch& since_start) {
    check_options(options);
    Split ms;
    Stopwatch clock;
    const Preset preset = open_preset(options.view);
    const std::size_t pass = find_pass(preset.scene, options.pass);
    ms.load = clock.restart();

    const auto context = make_egl_context(options.view.device);
    const std::string gpu = context->renderer();
    prepare_image_library(options.output);
    ms.context = clock.restart();

    const bool floats = holds_floats(options.output);
    CompiledScene compiled =
        compile_or_stop(preset, {.root = pass,
                                 .program = {.specialise = options.view.specialise,
                                             .average = options.samples > 1,
                                             .clamp_to_bytes = !floats}});
    ms.compile = clock.restart();

    Renderer renderer(preset, std::move(compiled),
                      {.size = preset.size,
                       .picture_format = floats ? PixelFormat::rgba32f : PixelFormat::rgba8,
                       .samples = options.samples,
                       .tile = options.tile});
    load_inputs(preset, renderer);
    ms.load += clock.restart();

    const Playback playback = playback_of(options, preset);
    const int settle = options.settle.value_or(preset.settle);
    const int last = playback.last_frame() + settle;
    States states(options.state, preset, renderer, playback, settle,
                  provenance_of(preset, options.fps, options.view.specialise), gpu);
    int frames_rendered = 0;
    const int first = states.start(last);
    const Frame frame = play(preset, renderer, playback, settle, frames_rendered, first);
    if (states.is_due(last)) states.save(last);
    Progress progress("sampling", options.samples);
    renderer.after_sample = [&](int done) {
        context->finish();
        progress.update(done);
    };
    renderer.draw(frame);
    context->finish();
    ms.render = clock.restart();

    const Image image = read_back(renderer, preset, pass, options);
    context->finish();
    ms.read = clock.restart();
    Metadata metadata = picture_metadata(preset, frame, gpu);
    metadata.emplace_back("glint:pass", options.pass);
    metadata.emplace_back("glint:samples", fmt::format("{}", options.samples));
    write_image(options.output, image, metadata);
    ms.encode = clock.restart();
    ms.total = since_start.ms();
    print_result(options, preset, image, frame, frames_rendered, gpu, ms);
}

}  // namespace glint
