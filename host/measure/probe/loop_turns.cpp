#include "measure/probe/loop_turns.h"

#include "render/pass_text.h"
#include "render/program.h"
#include "scene/passes.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

namespace glint {
namespace {

bool is_tried(int x, int y) {
    return (x & 7) == (5 * (y >> 3) & 7) && (y & 7) == (3 * (x >> 3) & 7);
}
// The same in a shader.
constexpr const char* kTriedAlone =
    "void main() {\n    ivec2 at = ivec2(gl_FragCoord.xy), block = at >> 3;\n"
    "    if ((at.x & 7) == (5 * block.y & 7) && (at.y & 7) == (3 * block.x & 7)) glint0_draw();\n"
    "}\n";

// What asks neighbours, and what leaves a pixel as it was.
constexpr const char* kHinders[] = {"dFdx",          "dFdy",      "fwidth",      "texture(",
                                    "texture (",     "texture2D", "textureCube", "textureProj",
                                    "textureOffset", "discard"};

// A pass that draws those pixels alone.
std::optional<PassProgram> compile_alone(const Preset& preset, std::size_t pass,
                                         const ProgramOptions& options) {
    for (const char* word : kHinders)
        if (preset.scene.text.find(word) != std::string::npos) return std::nullopt;
    PassText text = pass_text(preset, pass, options);
    constexpr std::string_view kMain = "void main()";
    const std::size_t main = text.text.rfind(kMain);
    if (main == text.text.npos) return std::nullopt;
    text.text.replace(main, kMain.size(), "void glint0_draw()") += kTriedAlone;
    return compile_text(preset, pass, std::move(text)).program;
}

}  // namespace

LoopTurns::LoopTurns(const Preset& preset, Renderer& renderer, const ProgramOptions& options,
                     const std::function<void()>& compiled)
    : preset_(preset), renderer_(renderer) {
    for (const GraphPass& one : renderer.graph().passes) {
        probes_.emplace_back(preset, one.pass, options, ProbeWish{.kind = ProbeKind::cost});
        if (compiled) compiled();
    }
}

void LoopTurns::count(const Frame& frame, const std::function<void()>& draw) {
    turns_ = 0.0;
    pixels_ = static_cast<double>(preset_.size.x) * preset_.size.y;
    renderer_.before_pass = [&](std::size_t index) {
        if (probes_[index].probed().sites.empty()) return;
        for (const ProbeCell& cell : probes_[index].map(renderer_, frame, 0, 0)) {
            turns_ += cell.kept[0];
            if (cell.kept[0] <= most_) continue;
            most_ = cell.kept[0];
            pass_ = pass_name(preset_.scene, renderer_.graph().passes[index].pass);
        }
    };
    renderer_.redraw_all();
    draw();
    renderer_.before_pass = nullptr;
}

bool differs_alone(const Preset& preset, Renderer& renderer, const ProgramOptions& options,
                   const Frame& frame) {
    const std::size_t root = renderer.scene().root;
    const auto program = compile_alone(preset, renderer.scene().programs[root].pass, options);
    const BufferShape& drawn = renderer.buffer(root).shape();
    if (!program || drawn.cube) return false;
    const std::vector<float> together = renderer.read_buffer(root, 0);
    const Buffer buffer({.size = drawn.size, .format = drawn.format, .outputs = drawn.outputs});
    renderer.draw_variant({.program = *program, .framebuffer = buffer.target(), .size = drawn.size},
                          frame);
    std::vector<float> alone(together.size());
    glGetTextureImage(buffer.texture(0), 0, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(alone.size() * sizeof(float)), alone.data());
    for (std::size_t i = 0; i < alone.size(); i += 4) {
        const auto pixel = static_cast<int>(i / 4);
        if (is_tried(pixel % drawn.size.x, pixel / drawn.size.x) &&
            std::memcmp(&alone[i], &together[i], 3 * sizeof(float)) != 0)
            return true;
    }
    return false;
}

bool ends_loops(const Context& context) {
    return context.renderer().find("llvmpipe") != std::string::npos;
}

}  // namespace glint
