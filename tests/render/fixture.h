// Scenes of a few lines, drawn through the host without a window.
//
// A scene that shows one sentence stands beside its expected value, as text in the test.
#pragma once

#include "../base/test_folder.h"
#include "gl/context.h"
#include "offline/common.h"
#include "offline/input_files.h"
#include "render/renderer.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glm {

// How a failed comparison shows them.
inline void PrintTo(const vec4& v, std::ostream* out) {
    *out << fmt::format("({:.9g}, {:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z, v.w);
}
inline void PrintTo(const vec3& v, std::ostream* out) {
    *out << fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z);
}

}  // namespace glm

namespace glint {

// The program's one context, made by the first test that draws.
struct SharedContext {
    std::unique_ptr<Context> context;
    std::string why_none;
};
inline SharedContext shared_context;

// Ends the context before the driver's own objects go.
class ContextEnd : public testing::Environment {
    void TearDown() override { shared_context.context.reset(); }
};
inline testing::Environment* const context_end = testing::AddGlobalTestEnvironment(new ContextEnd);

// A test that draws. Anything that GL complained about fails it at its end.
class GlTest : public testing::Test {
protected:
    void SetUp() override {
        if (!shared_context.context && shared_context.why_none.empty()) {
            try {
                shared_context.context = make_egl_context();
            } catch (const NoContext& error) {
                shared_context.why_none = error.what();
            }
        }
        if (!shared_context.context) GTEST_SKIP() << shared_context.why_none;
    }
    void TearDown() override {
        if (shared_context.context) shared_context.context->finish();
    }
};

struct File {
    std::string name, content;
};

// What a test says beside the scene's text.
struct PlayerOptions {
    glm::ivec2 size{4, 2};
    std::string preset{};       // TOML that follows `scene = …`
    std::vector<File> files{};  // beside the scene
    std::string pass = "image";
    bool specialise = true;
    int samples = 1;
    bool in_strips = false;
    PixelFormat format = PixelFormat::rgba32f;  // of the picture
    double fps = 60.0;
    bool side_by_side = false;
};

inline std::string to_text(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) text += to_string(diagnostic) + "\n";
    return text;
}

// A scene, or a preset of it, with its files in a folder of its own.
inline ReadPreset read_scene_text(const TestFolder& folder, std::string_view text,
                                  const PlayerOptions& options) {
    for (const File& file : options.files) folder.write(file.name, file.content);
    const auto scene = folder.write("scene.frag", text);
    ReadPreset read =
        options.preset.empty()
            ? read_preset(scene)
            : read_preset(folder.write("preset.toml", "scene = \"scene.frag\"\n" + options.preset));
    if (read.preset) read.preset->size = options.size;
    return read;
}

// Of two pictures in RGBA bytes of one size.
struct Differences {
    double share = 0.0;   // of pixels that differ by more than `step` of 255
    bool is_dark = true;  // the first, which would prove nothing
};
inline Differences compare(const std::vector<std::byte>& a, const std::vector<std::byte>& b,
                           int step) {
    int different = 0, bright = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        int worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int value = std::to_integer<int>(a[i + c]);
            worst = std::max(worst, std::abs(value - std::to_integer<int>(b[i + c])));
            bright += value > 20;
        }
        different += worst > step;
    }
    return {4.0 * different / static_cast<double>(a.size()), bright == 0};
}

// A scene that is drawn frame by frame. Throws with the diagnostics where it does not compile.
class Player {
public:
    explicit Player(std::string_view text, PlayerOptions options = {})
        : options_(std::move(options)) {
        ReadPreset read = read_scene_text(folder_, text, options_);
        if (!read.preset) throw std::runtime_error(to_text(read.diagnostics));
        preset = std::move(*read.preset);
        const std::size_t root = find_pass(preset.scene, options_.pass);
        CompileResult compiled = compile_scene(
            preset, {.root = root,
                     .program = {.specialise = options_.specialise,
                                 .average = options_.samples > 1,
                                 .clamp_to_bytes = options_.format == PixelFormat::rgba8},
                     .side_by_side = options_.side_by_side});
        if (!compiled.scene) throw std::runtime_error(to_text(compiled.diagnostics));
        if (root != kImagePass) {
            const auto& names = preset.scene.passes[root].outputs;
            output_ = static_cast<std::size_t>(
                std::find(names.begin(), names.end(), options_.pass) - names.begin());
        }
        renderer_.emplace(preset, std::move(*compiled.scene),
                          RenderOptions{.size = options_.size,
                                        .picture_format = options_.format,
                                        .samples = options_.samples,
                                        .in_strips = options_.in_strips});
        load_inputs(preset, *renderer_);
    }

    Renderer& renderer() { return *renderer_; }
    const Renderer& renderer() const { return *renderer_; }

    // Frame k of an endless sequence at options.fps.
    Frame frame(int k) const { return Playback{.end = 1e6, .fps = options_.fps}.frame(preset, k); }

    // With the tweaks as `preset` has them now.
    bool draw(const Frame& frame) {
        renderer_->set_values(preset.values);
        return renderer_->draw(frame);
    }
    bool draw(int k) { return draw(frame(k)); }
    void draw_frames(int first, int end) {
        for (int k = first; k < end; ++k) draw(k);
    }

    // What `still` shows at a time; returns the number of frames that it drew.
    int still(double time, int settle = 0) {
        int frames = 0;
        renderer_->set_values(preset.values);
        draw(play(preset, *renderer_, {.end = time, .fps = options_.fps}, settle, frames));
        return frames;
    }

    std::vector<float> floats() { return renderer_->read_floats(output_); }
    glm::vec4 pixel(int x, int y) {
        const std::vector<float> values = floats();
        const std::size_t i =
            (static_cast<std::size_t>(y) * static_cast<std::size_t>(renderer_->root_size().x) +
             static_cast<std::size_t>(x)) *
            4;
        return {values.at(i), values.at(i + 1), values.at(i + 2), values.at(i + 3)};
    }
    glm::vec3 colour(int x = 0, int y = 0) { return glm::vec3(pixel(x, y)); }

    // Which pass of the scene stands where in the graph.
    std::size_t graph_index(std::string_view name) const {
        const auto& passes = renderer_->graph().passes;
        for (std::size_t i = 0; i < passes.size(); ++i) {
            if (pass_name(preset.scene, passes[i].pass) == name) return i;
        }
        throw std::runtime_error(fmt::format("no pass {} is drawn", name));
    }

    Preset preset;

private:
    TestFolder folder_;
    PlayerOptions options_;
    std::size_t output_ = 0;
    std::optional<Renderer> renderer_;
};

// The picture's colour where a scene of one expression is drawn, at frame k of a sequence.
inline glm::vec3 colour_of(std::string_view expression, int k = 0, PlayerOptions options = {}) {
    Player player(
        fmt::format("void mainImage(out vec4 c, in vec2 p) {{ c = vec4({}); }}", expression),
        std::move(options));
    player.draw(k);
    return player.colour();
}

}  // namespace glint
