// Where what is not finite is born, and where an assertion of the text does not hold.
#pragma once

#include "measure/probe/probe.h"

#include <optional>
#include <vector>

namespace glint {

// Watches all passes of a renderer for the first fault, frame by frame, while it lives.
class FaultWatch {
public:
    // `wish` is of ProbeKind::faults. Throws ProbeRefused.
    FaultWatch(const Preset& preset, Renderer& renderer, const ProgramOptions& options,
               const ProbeWish& wish = {.kind = ProbeKind::faults});
    ~FaultWatch();
    FaultWatch(const FaultWatch&) = delete;
    FaultWatch& operator=(const FaultWatch&) = delete;

    // The frame that is drawn next.
    void begin(const Frame& frame) { frame_ = &frame; }
    // Whether a pixel that has a fault is not finite either: the first such is then `first()`.
    bool is_seen() const { return first_ && first_->is_seen; }
    // Of what is seen in a pixel, or else of all.
    const std::optional<ProbeFault>& first() const { return first_; }

private:
    void look(std::size_t index);
    ProbeFault fault_of(const Probe& probe, const ProbeCell& cell) const;

    const Preset& preset_;
    Renderer& renderer_;
    std::vector<Probe> probes_;  // in the order of the graph
    const Frame* frame_ = nullptr;
    std::optional<ProbeFault> first_;
    bool is_marked_;
};

}  // namespace glint
