#include "modes/still.h"

#include "gl/context.h"
#include "image/image.h"
#include "modes/input_files.h"
#include "modes/workers.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
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
    const std::string refusal = refusal_of(options.output, options.format);
    if (!refusal.empty()) throw UsageError(refusal);
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

// A picture beyond this many pixels is drawn and written in bands, so that memory does not grow
// with it; one of 8K is not.
constexpr std::int64_t kMostAtOnce = std::int64_t{1} << 25;
constexpr int kBandPixels = 1 << 22;
constexpr int kPartWidth = 8192;  // within every driver's limit

// Buffers of the picture's size are drawn anew for each sample, and would be for each part.
bool draws_buffers_for_samples(const StillOptions& options, const Scene& scene) {
    return options.samples > 1 && std::ranges::any_of(scene.passes, [](const Pass& pass) {
               return !pass.cube && !pass.size && pass.scale == 1.0;
           });
}

// The parts in which the picture is drawn; 0: whole.
glm::ivec2 part_size(const StillOptions& options, const Preset& preset) {
    const glm::ivec2 size = preset.size;
    if (options.pass != "image") return glm::ivec2(0);
    if (options.tile > 0) return glm::min(glm::ivec2(options.tile + options.tile % 2), size);
    const bool small = std::int64_t{size.x} * size.y <= kMostAtOnce;
    if (small || draws_buffers_for_samples(options, preset.scene)) return glm::ivec2(0);
    const int rows = std::max(kBandPixels / size.x / kFileTile, 1) * kFileTile;
    return glm::min(glm::ivec2(kPartWidth, rows), size);
}

// Lays a part into its band, which is as high.
void place(const Image& part, int x, Image& band) {
    const std::size_t pixel = band.pixels.size() / static_cast<std::size_t>(band.size.x) /
                              static_cast<std::size_t>(band.size.y);
    const std::size_t row = pixel * static_cast<std::size_t>(part.size.x);
    for (std::size_t y = 0; y < static_cast<std::size_t>(part.size.y); ++y) {
        std::byte* to = band.pixels.data() + pixel * (y * static_cast<std::size_t>(band.size.x) +
                                                      static_cast<std::size_t>(x));
        std::memcpy(to, part.pixels.data() + y * row, row);
    }
}

// Draws the picture part by part, from the top, and hands band after band to `write`.
template <class Write>
void draw_bands(Renderer& renderer, Context& context, const Frame& frame, glm::ivec2 size,
                glm::ivec2 most, bool floats, Split& ms, Write write) {
    Stopwatch clock;
    for (int top = size.y, bottom = 0; top > 0; top = bottom) {
        bottom = std::max(top - most.y, 0);
        Image band{.size = {size.x, top - bottom},
                   .channels = 3,
                   .type = floats ? ChannelType::f32 : ChannelType::u8,
                   .pixels = {}};
        band.pixels.resize(static_cast<std::size_t>(size.x) *
                           static_cast<std::size_t>(top - bottom) * (floats ? 12 : 3));
        for (int x = 0; x < size.x; x += most.x) {
            renderer.set_part({x, bottom}, {std::min(most.x, size.x - x), top - bottom});
            if (x == 0 && top == size.y)
                renderer.draw(frame);
            else
                renderer.draw_root(frame);
            context.finish();
            ms.render += clock.restart();
            place(read_picture(renderer, floats), x, band);
            context.finish();
            ms.read += clock.restart();
        }
        write(std::move(band));
        ms.encode += clock.restart();
    }
}

void print_result(const StillOptions& options, const Preset& preset, glm::ivec2 size,
                  const Frame& frame, int frames_rendered, const std::string& renderer,
                  const Split& ms) {
    if (!options.view.json) {
        fmt::print("{}  {}x{}  {:.0f} ms\n", options.output.string(), size.x, size.y, ms.total);
        return;
    }
    const Json json = {{"output", options.output.string()},
                       {"scene", preset.scene.files.front().string()},
                       {"size", {size.x, size.y}},
                       {"frame", frame.frame},
                       {"time", frame.time},
                       {"renderer", renderer},
                       {"frames_rendered", frames_rendered},
                       {"samples", options.samples},
                       {"shutter", options.shutter},
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
    const glm::ivec2 part = part_size(options, preset);
    CompiledScene compiled =
        compile_or_stop(preset, {.root = pass,
                                 .program = {.specialise = options.view.specialise,
                                             .average = options.samples > 1,
                                             .parts = part != glm::ivec2(0),
                                             .clamp_to_bytes = !floats}});
    ms.compile = clock.restart();

    Renderer renderer(preset, std::move(compiled),
                      {.size = preset.size,
                       .picture_format = floats ? PixelFormat::rgba32f : PixelFormat::rgba8,
                       .samples = options.samples,
                       .part = part,
                       .in_strips = true});
    load_inputs(preset, renderer);
    ms.load += clock.restart();

    const Playback playback = playback_of(options, preset);
    const int settle = options.settle.value_or(preset.settle);
    const int last = playback.last_frame() + settle;
    States states(options.state, preset, renderer, playback, settle,
                  provenance_of(preset, options.fps, options.view.specialise), gpu);
    int frames_rendered = 0;
    const int first = states.start(last);
    const double exposure =
        exposure_of(options.shutter, options.fps, options.samples, renderer.graph());
    Frame frame = play(preset, renderer, playback, settle, frames_rendered, first);
    if (states.is_due(last)) states.save(last);
    frame.exposure = exposure;
    const glm::ivec2 size = pass == kImagePass ? preset.size : renderer.root_size();
    std::int64_t drawn = 0;
    Progress progress("drawing", long{size.x} * size.y * options.samples, Progress::Unit::percent);
    renderer.after_strip = [&](std::int64_t pixels) {
        context->finish();
        progress.update(drawn += pixels);
    };
    Metadata metadata = picture_metadata(preset, frame, gpu);
    metadata.emplace_back("glint:pass", options.pass);
    metadata.emplace_back("glint:samples", fmt::format("{}", options.samples));
    if (options.shutter > 0.0) {
        metadata.emplace_back("glint:shutter", fmt::format("{}", options.shutter));
    }
    if (part == glm::ivec2(0)) {
        renderer.draw(frame);
        context->finish();
        ms.render = clock.restart();
        const Image image = read_back(renderer, preset, pass, options);
        context->finish();
        ms.read = clock.restart();
        write_image(options.output, image, metadata, options.format);
    } else {
        FileFormat format = options.format;
        format.tiled = floats && options.tile == 0 && has_tiles(options.output);
        const Image shape{.size = size,
                          .channels = 3,
                          .type = floats ? ChannelType::f32 : ChannelType::u8,
                          .pixels = {}};
        ImageWriter writer(options.output, shape, metadata, format);
        Workers workers(1);
        draw_bands(renderer, *context, frame, size, part, floats, ms, [&](Image band) {
            workers.run([&, band = std::move(band)] { writer.write(band); });
        });
        clock.restart();
        workers.finish();
        writer.finish();
    }
    ms.encode += clock.restart();
    ms.total = since_start.ms();
    print_result(options, preset, size, frame, frames_rendered, gpu, ms);
}

}  // namespace glint
