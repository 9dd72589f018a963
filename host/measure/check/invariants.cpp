#include "measure/check/invariants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {

Invariants::Invariants(const CheckSubject& subject) {
    const auto& passes = subject.renderer().graph().passes;
    for (const Sampler& sampler : subject.scene().samplers) {
        if (!sampler.bounded && !sampler.conserves) continue;
        const auto drawn = std::ranges::find(passes, sampler.pass, &GraphPass::pass);
        if (drawn == passes.end()) continue;
        list_.push_back({.index = static_cast<std::size_t>(drawn - passes.begin()),
                         .output = sampler.output,
                         .sampler = &sampler,
                         .curve = {.buffer = sampler.name,
                                   .bounded = sampler.bounded,
                                   .conserves = sampler.conserves}});
    }
}

void Invariants::look(One& one, const std::vector<float>& values, int frame) {
    double sum = 0.0, magnitude = 0.0, drift = 0.0;
    const auto [least, most] = std::ranges::minmax(values);
    one.low = std::min(one.low, least);
    one.high = std::max(one.high, most);
    for (std::size_t i = 0; i < values.size(); i += 4) {
        sum += static_cast<double>(values[i]);
        magnitude += std::abs(static_cast<double>(values[i]));
    }
    if (!one.is_begun && magnitude > 0.0) {
        one.is_begun = true;
        one.first = sum;
    }
    if (one.is_begun) drift = std::abs(sum - one.first) / std::max(magnitude, 1e-30);
    one.drift = std::max(one.drift, drift);
    one.curve.add({frame, static_cast<double>(least), static_cast<double>(most), drift});
    const Sampler& sampler = *one.sampler;
    if (!broken_.empty()) return;
    if (sampler.bounded) {
        const auto [low, high] = *sampler.bounded;
        if (static_cast<double>(one.low) < low || static_cast<double>(one.high) > high)
            broken_ =
                fmt::format("bounded=[{}, {}] of {} does not hold: [{:.4g}, {:.4g}] in frame {}",
                            low, high, sampler.name, one.low, one.high, frame);
    }
    if (sampler.conserves && one.drift > *sampler.conserves)
        broken_ = fmt::format(
            "conserves={} of {} does not hold: the sum has changed by {:.3g} of it in frame {}",
            *sampler.conserves, sampler.name, one.drift, frame);
}

void Invariants::add(const CheckSubject& subject, int frame) {
    for (One& one : list_) look(one, subject.renderer().read_buffer(one.index, one.output), frame);
}

std::string Invariants::words() const {
    std::string words;
    for (const One& one : list_) {
        words += fmt::format("; {} within [{:.4g}, {:.4g}]", one.sampler->name, one.low, one.high);
        if (one.sampler->conserves) words += fmt::format(", its sum off by {:.2g}", one.drift);
    }
    return words;
}

std::vector<InvariantCurve> Invariants::curves() const {
    std::vector<InvariantCurve> curves;
    for (const One& one : list_) curves.push_back(one.curve);
    return curves;
}

}  // namespace glint
