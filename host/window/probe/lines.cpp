#include "window/probe/lines.h"

#include <algorithm>

namespace glint {
namespace {

// Where each line of the text begins.
std::vector<std::size_t> line_begins(const std::string& text) {
    std::vector<std::size_t> begins = {0};
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1))
        begins.push_back(at + 1);
    return begins;
}

std::size_t line_at(const std::vector<std::size_t>& begins, std::size_t byte) {
    return static_cast<std::size_t>(std::ranges::upper_bound(begins, byte) - begins.begin()) - 1;
}

// From its first site to its end; before that it is as that site.
void fill(std::vector<LineState>& states, std::size_t first, std::size_t last) {
    LineState now = LineState::unknown;
    for (std::size_t i = first; i <= last && now == LineState::unknown; ++i) now = states[i];
    for (std::size_t i = first; i <= last; ++i) {
        if (states[i] == LineState::unknown) states[i] = now;
        now = states[i];
    }
}

}  // namespace

std::vector<LineState> line_states(const Scene& scene, const Reading& reading,
                                   const std::vector<bool>& reached, const Probed& probed,
                                   const std::vector<std::uint32_t>& hits, Span asked) {
    const std::vector<std::size_t> begins = line_begins(scene.text);
    std::vector<LineState> states(begins.size(), LineState::unknown);
    for (std::size_t i = 0; i < probed.sites.size() && i < hits.size(); ++i) {
        LineState& state = states[line_at(begins, probed.sites[i].at)];
        if (hits[i] > 0)
            state = LineState::ran;
        else if (state == LineState::unknown)
            state = LineState::did_not_run;
    }
    for (std::size_t f = 0; f < reading.functions.size(); ++f) {
        const Function& function = reading.functions[f];
        if (!function.is_defined()) continue;
        const Span place = reading.place(function.tokens);
        if (place.end <= asked.begin || place.begin >= asked.end) continue;
        const std::size_t first = line_at(begins, std::max(place.begin, asked.begin));
        const std::size_t last = line_at(begins, std::min(place.end, asked.end) - 1);
        if (!reached[f])
            std::fill(states.begin() + static_cast<std::ptrdiff_t>(first),
                      states.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                      LineState::did_not_run);
        fill(states, first, last);
    }
    return states;
}

}  // namespace glint
