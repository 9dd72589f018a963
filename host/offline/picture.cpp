#include "offline/picture.h"

#include "base/numbered_name.h"
#include "base/temporary_file.h"

#include <fmt/format.h>

namespace glint {

namespace fs = std::filesystem;

CompileOptions compile_options(const PictureOptions& options, const PictureKind& kind) {
    return {.root = kind.pass,
            .program = {.specialise = options.view.specialise,
                        .average = options.samples > 1,
                        .tiles = kind.tiles,
                        .clamp_to_bytes = !kind.floats}};
}

RenderOptions render_options(const PictureOptions& options, const PictureKind& kind,
                             glm::ivec2 size) {
    return {.size = size,
            .picture_format = kind.floats ? PixelFormat::rgba32f : PixelFormat::rgba8,
            .samples = options.samples,
            .in_strips = true};
}

void require_files_apart(const PictureOptions& options, const NamedFile& output,
                         const NamedFile& pictures, const Preset& preset) {
    const NamedFile from{"--from-state", options.state.from};
    const NamedFile saved{"--save-state", options.state.save};
    std::vector<NamedFile> inputs = files_read_for(preset);
    inputs.push_back(pictures);
    require_apart({output, saved}, inputs);
    require_apart({output}, {from});
    // What goes on from one of numbered states writes that one again, the same to the last bit.
    if (!numbered_name(from.name) && !numbered_name(saved.name)) require_apart({saved}, {from});
}

void require_files_writable(const PictureOptions& options, const NamedFile& output) {
    for (const NamedFile& file : {output, NamedFile{"--save-state", options.state.save}}) {
        if (file.name.empty()) continue;
        const auto numbered = numbered_name(file.name);
        require_writable(numbered ? numbered->name(file.first) : fs::path(file.name));
    }
}

double exposure_of(const PictureOptions& options, const PassGraph& graph) {
    if (options.shutter <= 0.0) return 0.0;
    if (options.samples < 2) {
        throw UsageError(
            "--shutter spreads the samples over the time that it is open; add "
            "--samples 16, or more.");
    }
    if (graph.stateful) {
        throw UsageError(
            "--shutter draws moments between two frames; this scene's picture follows "
            "from the frames before it, and has none there.");
    }
    return options.shutter / 360.0 / options.fps;
}

Metadata metadata_of(const PictureOptions& options, const Preset& preset, const Frame& frame,
                     const std::string& renderer) {
    Metadata metadata = picture_metadata(preset, frame, renderer);
    metadata.emplace_back("glint:samples", fmt::format("{}", options.samples));
    if (options.shutter > 0.0) {
        metadata.emplace_back("glint:shutter", fmt::format("{}", options.shutter));
    }
    return metadata;
}

}  // namespace glint
