#include "measure/probe/loop_turns.h"

#include "scene/passes.h"

namespace glint {

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
    renderer_.redraw();
    draw();
    renderer_.before_pass = nullptr;
}

bool ends_loops(const Context& context) {
    return context.renderer().find("llvmpipe") != std::string::npos;
}

}  // namespace glint
