// What a text (`//@ watch nor`) and its preset (`watch = ["nor@412"]`) ask to be told first.
#pragma once

#include "measure/probe/probe.h"

#include <functional>
#include <string>
#include <vector>

namespace glint {

// Those of the expressions that the driver takes, each tried alone; `refuse` hears of the others.
std::vector<ProbeExpression> accepted(
    const Preset& preset, std::size_t pass, const ProgramOptions& options, const ProbeWish& wish,
    const std::function<void(const ProbeExpression&, const std::string& why)>& refuse);

class Watches {
public:
    // Compiles all of them at once. What names no line, or the driver does not take, is left out,
    // and told by refused(). `preset` must outlive this.
    Watches(const Preset& preset, std::size_t pass, const ProgramOptions& options);

    // In the order of the text; none of what this pass does not reach.
    std::vector<ProbeValue> values_at(Renderer& renderer, const Frame& frame,
                                      const ProbePlace& place);
    // Null where nothing is watched.
    Probe* probe() { return probe_ ? &*probe_ : nullptr; }
    const std::vector<std::string>& refused() const { return refused_; }

private:
    std::optional<Probe> probe_;
    std::vector<std::string> refused_;
};

}  // namespace glint
