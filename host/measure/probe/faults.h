// Where what is not finite is born, and where an assertion of the text does not hold.
#pragma once

#include "measure/probe/probe.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace glint {

// Watches all passes of a renderer for the first fault, frame by frame, while it lives. Of a pass
// with some hundreds of operations only what may have no result counts (unwatched()), and what made
// a pixel not finite; which that is may take some more programs, so that draws may throw
// ProbeRefused, too.
class FaultWatch {
public:
    // Throws ProbeRefused.
    FaultWatch(const Preset& preset, Renderer& renderer, const ProgramOptions& options);
    ~FaultWatch();
    FaultWatch(const FaultWatch&) = delete;
    FaultWatch& operator=(const FaultWatch&) = delete;

    // The frame that is drawn next.
    void begin(const Frame& frame) { frame_ = &frame; }
    // Whether a pixel that has a fault is not finite either: the first such is then `first()`.
    bool is_seen() const { return first_ && first_->is_seen; }
    // Of what is seen in a pixel, or else of all.
    const std::optional<ProbeFault>& first() const { return first_; }

    // How many operations of all passes count only where they made a pixel not finite.
    std::size_t unwatched() const;

    // Called after each program that a draw has taken.
    std::function<void()> after_program;

private:
    void look(std::size_t index);
    void look_at_once(std::size_t index, int face);
    void look_in_parts(std::size_t index, int face);
    bool has_fault(const ProbeCell& cell) const;
    Probe probe_of(std::size_t index, std::vector<Span> only) const;
    Probe& part(std::size_t index, std::size_t number);
    std::optional<std::size_t> faulty_pixel(std::size_t index, int face);
    void note(std::size_t index, const Probe& probe, const std::vector<ProbeCell>& cells,
              std::size_t found, int face);
    ProbeFault fault_of(std::size_t index, const Probe& probe, const std::vector<ProbeCell>& cells,
                        std::size_t found, int face) const;

    const Preset& preset_;
    Renderer& renderer_;
    const ProgramOptions options_;
    // By pass, in the order of the graph: what is watched together, and the program that watches
    // all, or, where there are several parts, what may have no result.
    std::vector<std::vector<Span>> parts_;
    std::vector<Probe> probes_;
    std::vector<std::vector<std::unique_ptr<Probe>>> part_probes_;  // those that were asked for
    const Frame* frame_ = nullptr;
    std::optional<ProbeFault> first_;
    bool is_marked_;
};

// How near each operation of a frame comes to where it is undefined, over all passes: what a search
// goes by; and what is undefined and shows in a colour. Of a pass with some hundreds of operations,
// those that may have no result.
class FaultSurvey {
public:
    // Throws ProbeRefused.
    FaultSurvey(const Preset& preset, Renderer& renderer, const ProgramOptions& options);
    ~FaultSurvey();
    FaultSurvey(const FaultSurvey&) = delete;
    FaultSurvey& operator=(const FaultSurvey&) = delete;

    // Frames that are drawn in between are looked at; `frame` is the one. `anew`: in all passes,
    // not only in those that something has changed for.
    void begin(const Frame& frame, bool anew);
    // The frame that is drawn next is looked at, too, for passes that the ones before did not draw.
    void go_on(const Frame& frame) { frame_ = &frame; }
    void end();
    // Of that frame, by site: the smallest distance, or infinity.
    const std::vector<float>& distances() const { return distances_; }
    // What was undefined in it and counts: an index out of range, a division of whole numbers by 0,
    // or what gives a pixel another colour than it has with a result.
    const std::optional<ProbeFault>& fault() const { return fault_; }

private:
    void look(std::size_t index);
    void look_at(std::size_t index, std::size_t group, int face);
    void judge(Probe& probe, std::size_t index, int face, const std::vector<ProbeCell>& cells);

    const Preset& preset_;
    Renderer& renderer_;
    std::vector<std::vector<Probe>> probes_;  // in the order of the graph, by group of operations
    const Frame* frame_ = nullptr;
    std::vector<float> distances_;
    std::vector<bool> looked_at_;  // passes
    std::optional<ProbeFault> fault_;
    int turn_ = 0;
};

}  // namespace glint
