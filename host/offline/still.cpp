#include "offline/still.h"

#include "base/json_text.h"
#include "base/say.h"
#include "base/workers.h"
#include "gl/context.h"
#include "media/image.h"
#include "offline/input_files.h"
#include "offline/picture.h"
#include "render/room.h"

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

// Whether and how a picture is drawn in parts.
struct Tiling {
    glm::ivec2 tile{0};       // 0: whole
    bool tiled_file = false;  // the file is kept in tiles, too
};

// One still on its way to its file, and what all steps of that need.
struct Still {
    const StillOptions& options;
    const Preset& preset;
    PictureKind kind;
    Tiling tiling;
    Context& context;
    Renderer& renderer;
    Split ms;
    Frame frame{};
    int frames_rendered = 0;
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

// Brings the scene to just before the frame that is wanted.
void play_up_to_frame(Still& still) {
    const StillOptions& options = still.options;
    const double exposure = exposure_of(options, still.renderer.graph());
    const Playback playback = playback_of(options, still.preset);
    const int settle = options.settle.value_or(still.preset.settle);
    const int last = playback.last_frame() + settle;
    States states(options.state, still.preset, still.renderer, playback, settle,
                  provenance_of(still.preset, options.fps, options.view.specialise),
                  still.context.renderer());
    const int first = states.start(last);
    still.frame =
        play(still.preset, still.renderer, playback, settle, still.frames_rendered, first);
    if (states.is_due(last)) states.save(last);
    still.frame.exposure = exposure;
}

// A byte that a display would show for a value: clamped, rounded; not-a-number is black.
std::byte to_byte(float value) {
    return static_cast<std::byte>(value > 0.0f ? std::lround(std::min(value, 1.0f) * 255.0f) : 0);
}

Image empty_image(glm::ivec2 size, int channels, bool floats) {
    return {.size = size,
            .channels = channels,
            .type = floats ? ChannelType::f32 : ChannelType::u8,
            .pixels = {}};
}

// Float files of a buffer keep all four channels.
Image read_buffer(const Still& still) {
    const bool floats = still.kind.floats;
    Image image = empty_image(still.renderer.root_size(), floats ? 4 : 3, floats);
    const std::size_t count =
        static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y);
    const auto kept = static_cast<std::size_t>(image.channels);
    const auto& names = still.preset.scene.passes[still.kind.pass].outputs;
    const auto output =
        static_cast<std::size_t>(std::ranges::find(names, still.options.pass) - names.begin());
    const std::vector<float> rgba = still.renderer.read_floats(output);
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

void write_whole(Still& still, const Metadata& metadata) {
    Stopwatch clock;
    still.renderer.draw(still.frame);
    still.context.finish();
    still.ms.render += clock.restart();
    const bool is_picture = still.kind.pass == kImagePass;
    const Image image =
        is_picture ? read_picture(still.renderer, still.kind.floats) : read_buffer(still);
    still.context.finish();
    still.ms.read += clock.restart();
    write_image(still.options.output, image, metadata, still.options.format);
    still.ms.encode += clock.restart();
}

// A picture beyond this many pixels is drawn and written in bands, so that memory does not grow
// with it; one of 8K is not.
constexpr std::int64_t kMostAtOnce = std::int64_t{1} << 25;
constexpr int kBandBytes = 1 << 24;
constexpr int kTileWidth = 8192;

std::int64_t pixels_of(glm::ivec2 size) {
    return std::int64_t{size.x} * size.y;
}

// Of a picture that is drawn whole: where it is drawn, and its copy in memory.
std::size_t bytes_of_whole(const StillOptions& options, glm::ivec2 size) {
    const std::size_t drawn = holds_floats(options.output) ? 16 : 4;
    const std::size_t summed = options.samples > 1 ? 16 : 0;
    return static_cast<std::size_t>(pixels_of(size)) * (2 * drawn + summed);
}

// Half of the memory is left to the scene's own buffers and to the encoder. The bytes of a file do
// not depend on how much there is.
bool may_be_in_tiles(const StillOptions& options, glm::ivec2 size) {
    if (options.pass != "image") return false;
    return options.tile > 0 || pixels_of(size) > kMostAtOnce ||
           std::max(size.x, size.y) > largest_side() ||
           bytes_of_whole(options, size) > free_memory() / 2;
}

// Buffers of the picture's size are drawn anew for each sample, and would be for each tile.
bool draws_buffers_for_samples(const StillOptions& options, const Scene& scene,
                               const PassGraph& graph) {
    return options.samples > 1 && std::ranges::any_of(graph.passes, [&](const GraphPass& pass) {
               return fills_a_buffer(pass.pass) && is_jittered(scene, pass);
           });
}

// A band, which is as high as its tiles, takes about kBandBytes, however wide it is.
Tiling tiling_of(const StillOptions& options, const Preset& preset, const PassGraph& graph) {
    const glm::ivec2 size = preset.size;
    const bool is_asked_for = options.tile > 0;
    if (!is_asked_for && draws_buffers_for_samples(options, preset.scene, graph)) return {};
    const std::int64_t row = std::int64_t{size.x} * (holds_floats(options.output) ? 12 : 3);
    const auto rows = static_cast<int>(std::clamp<std::int64_t>(kBandBytes / row, 1, size.y));
    // Tiles begin at even pixels and get up to two more.
    const int asked = is_asked_for ? options.tile + options.tile % 2 : kTileWidth;
    const int most = std::min(asked, (largest_side() - 2) / 2 * 2);
    Tiling tiling{.tile = glm::min(glm::ivec2(most, std::min(rows, most)), size)};
    constexpr int kWidestTiledFile = 1 << 16;  // rows of tiles are written at once
    tiling.tiled_file = !is_asked_for && has_tiles(options.output) &&
                        pixels_of(size) > kMostAtOnce && size.x <= kWidestTiledFile;
    if (tiling.tiled_file) {
        tiling.tile.y = std::max(tiling.tile.y / kFileTile, 1) * kFileTile;
        tiling.tile.y = std::min(tiling.tile.y, size.y);
    }
    return tiling;
}

// What a still takes beside the buffers that its renderer has made. A band is written while the
// next one is drawn.
void require_memory_for_file(const Still& still) {
    const glm::ivec2 size = still.renderer.root_size();
    const auto pixels = static_cast<std::size_t>(pixels_of(size));
    const std::size_t drawn = still.kind.floats ? 16 : 4;
    Image kept = empty_image(size, still.kind.floats ? 4 : 3, still.kind.floats);
    std::size_t copies = pixels * drawn;
    if (still.kind.pass != kImagePass) copies += pixels * (still.kind.floats ? 32 : 16);
    if (still.tiling.tile != glm::ivec2(0)) {
        kept.size = {still.preset.size.x, still.tiling.tile.y};
        const auto band = static_cast<std::size_t>(pixels_of(kept.size));
        copies = static_cast<std::size_t>(pixels_of(still.tiling.tile)) * drawn +
                 2 * band * (still.kind.floats ? 12 : 3);
    }
    const std::vector<WantedMemory> wanted = {
        {"the picture on its way to the file", copies},
        {"its encoder", encoder_bytes(still.options.output, kept)}};
    require_memory(wanted, "Make the picture smaller with --size.");
}

// Lays a tile into its band, which is as high.
void place(const Image& tile, int x, Image& band) {
    const std::size_t pixel = band.pixels.size() / static_cast<std::size_t>(band.size.x) /
                              static_cast<std::size_t>(band.size.y);
    const std::size_t row = pixel * static_cast<std::size_t>(tile.size.x);
    for (std::size_t y = 0; y < static_cast<std::size_t>(tile.size.y); ++y) {
        std::byte* to = band.pixels.data() + pixel * (y * static_cast<std::size_t>(band.size.x) +
                                                      static_cast<std::size_t>(x));
        std::memcpy(to, tile.pixels.data() + y * row, row);
    }
}

// The rows from `bottom` up to `top`, drawn tile by tile.
Image draw_band(Still& still, int bottom, int top) {
    const glm::ivec2 size = still.preset.size;
    const glm::ivec2 tile = still.tiling.tile;
    Image band = empty_image({size.x, top - bottom}, 3, still.kind.floats);
    band.pixels.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(top - bottom) *
                       (still.kind.floats ? 12 : 3));
    Stopwatch clock;
    for (int x = 0; x < size.x; x += tile.x) {
        still.renderer.set_tile({x, bottom}, {std::min(tile.x, size.x - x), top - bottom});
        if (x == 0 && top == size.y)
            still.renderer.draw(still.frame);  // the first tile draws the buffers, too
        else
            still.renderer.draw_root(still.frame);
        still.context.finish();
        still.ms.render += clock.restart();
        place(read_picture(still.renderer, still.kind.floats), x, band);
        still.context.finish();
        still.ms.read += clock.restart();
    }
    return band;
}

// From the top down; a band is written while the next is drawn.
void write_in_bands(Still& still, const Metadata& metadata) {
    const StillOptions& options = still.options;
    const glm::ivec2 size = still.preset.size;
    FileFormat format = options.format;
    format.tiled = still.tiling.tiled_file;
    ImageWriter writer(options.output, empty_image(size, 3, still.kind.floats), metadata, format);
    Workers workers(1);
    workers.limit(1);
    Stopwatch clock;
    for (int top = size.y, bottom = 0; top > 0; top = bottom) {
        bottom = std::max(top - still.tiling.tile.y, 0);
        Image band = draw_band(still, bottom, top);
        clock.restart();
        workers.run([&writer, band = std::move(band)] { writer.write(band); });
        still.ms.encode += clock.restart();
    }
    workers.finish();
    writer.finish();
    still.ms.encode += clock.restart();
}

void write_file(Still& still) {
    const glm::ivec2 size = still.preset.size;
    std::int64_t drawn = 0;
    Progress progress("drawing", long{size.x} * size.y * still.options.samples,
                      Progress::Unit::percent);
    still.renderer.after_strip = [&](std::int64_t pixels) {
        still.context.finish();
        progress.update(drawn += pixels);
    };
    Metadata metadata =
        metadata_of(still.options, still.preset, still.frame, still.context.renderer());
    metadata.emplace_back("glint:pass", still.options.pass);
    if (still.options.unasked) metadata.emplace(metadata.begin(), kUnasked, "yes");
    if (still.tiling.tile == glm::ivec2(0))
        write_whole(still, metadata);
    else
        write_in_bands(still, metadata);
    still.renderer.after_strip = nullptr;
}

void print_result(const Still& still) {
    const StillOptions& options = still.options;
    const Split& ms = still.ms;
    const bool is_picture = still.kind.pass == kImagePass;
    const glm::ivec2 size = is_picture ? still.preset.size : still.renderer.root_size();
    if (!options.view.json) {
        say_result("{}  {}x{}  {:.0f} ms\n", options.output.string(), size.x, size.y, ms.total);
        return;
    }
    const Json json = {{"output", options.output.string()},
                       {"scene", still.preset.scene.files.front().string()},
                       {"size", {size.x, size.y}},
                       {"frame", still.frame.frame},
                       {"time", still.frame.time},
                       {"renderer", still.context.renderer()},
                       {"frames_rendered", still.frames_rendered},
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
    say_result("{}\n", json_text(json));
}

}  // namespace

Preset run_still(const StillOptions& options, const Stopwatch& since_start) {
    check_options(options);
    Split ms;
    Stopwatch clock;
    Preset preset = open_preset(options.view);
    const NamedFile output{"-o", options.output.string()};
    require_files_apart(options, output, {}, preset);
    require_files_writable(options, output);
    PictureKind kind{.pass = find_pass(preset.scene, options.pass),
                     .floats = holds_floats(options.output)};
    const bool is_picture = kind.pass == kImagePass;
    const std::string refusal = is_picture ? size_refusal(options.output, preset.size) : "";
    if (!refusal.empty()) throw std::runtime_error(refusal);
    ms.load = clock.restart();
    const auto context = make_egl_context(options.view.device);
    prepare_image_library(options.output);
    prepare_states(options.state);
    ms.context = clock.restart();
    kind.tiles = may_be_in_tiles(options, preset.size);
    CompiledScene compiled = compile_or_stop(preset, compile_options(options, kind));
    ms.compile = clock.restart();
    RenderOptions render = render_options(options, kind, preset.size);
    const Tiling tiling = kind.tiles ? tiling_of(options, preset, compiled.graph) : Tiling{};
    render.tile = tiling.tile;
    Renderer renderer(preset, std::move(compiled), render);
    load_inputs(preset, renderer);
    renderer.compile_ahead();
    ms.load += clock.restart();

    Still still{.options = options,
                .preset = preset,
                .kind = kind,
                .tiling = tiling,
                .context = *context,
                .renderer = renderer,
                .ms = ms};
    context->finish();  // the buffers count as taken only once they are cleared
    require_memory_for_file(still);
    play_up_to_frame(still);
    still.ms.render = clock.restart();
    write_file(still);
    still.ms.total = since_start.ms();
    print_result(still);
    return preset;
}

}  // namespace glint
