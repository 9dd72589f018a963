#include "measure/check/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr double kLongest = 60.0;  // s; a scene without a state is seen at any time up to this

bool is_logarithmic(const Tweak& tweak, const Range& range) {
    return tweak.log && range.min > 0.0;
}

double share_of(const Tweak& tweak, const Range& range, double value) {
    if (range.max <= range.min) return 0.0;
    const double share =
        is_logarithmic(tweak, range)
            ? std::log(std::max(value, range.min) / range.min) / std::log(range.max / range.min)
            : (value - range.min) / (range.max - range.min);
    return std::clamp(share, 0.0, 1.0);
}

}  // namespace

std::optional<Range> range_of(const Tweak& tweak) {
    if (!tweak.names.empty()) return Range{0.0, static_cast<double>(tweak.names.size() - 1)};
    if (tweak.type == TweakType::bool1 || tweak.is_colour) return Range{0.0, 1.0};
    if (tweak.safe) return Range{(*tweak.safe)[0], (*tweak.safe)[1]};
    if (tweak.min && tweak.max) return Range{*tweak.min, *tweak.max};
    return std::nullopt;
}

double at_share(const Tweak& tweak, const Range& range, double share) {
    if (is_logarithmic(tweak, range)) return range.min * std::pow(range.max / range.min, share);
    return std::lerp(range.min, range.max, share);
}

Space::Space(const CheckSubject& subject) {
    const auto& tweaks = subject.scene().tweaks;
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const auto range = range_of(tweaks[i]);
        const auto count = static_cast<std::size_t>(component_count(tweaks[i].type));
        for (std::size_t c = 0; range && c < count; ++c) {
            axes_.push_back({Axis::Of::tweak, i, c});
            usual_.push_back(share_of(tweaks[i], *range, subject.opened().values[i][c]));
        }
    }
    if (!subject.stateful() && subject.moves()) {
        axes_.push_back({Axis::Of::time, 0, 0});
        usual_.push_back(std::clamp(subject.opened().time / kLongest, 0.0, 1.0));
    }
    if (subject.renderer().reads_mouse()) {
        for (const std::size_t c : {0u, 1u}) {
            axes_.push_back({Axis::Of::mouse, 0, c});
            usual_.push_back(0.5);
        }
    }
}

double Space::apply(const Point& point, CheckSubject& subject) const {
    double time = subject.opened().time;
    glm::dvec2 mouse(0.5);
    bool is_moved = false;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (point[i] == usual_[i]) continue;  // what the preset has, to the last digit
        const Axis& axis = axes_[i];
        if (axis.of == Axis::Of::time) {
            time = std::round(point[i] * kLongest * 60.0) / 60.0;
        } else if (axis.of == Axis::Of::mouse) {
            mouse[static_cast<int>(axis.component)] = point[i];
            is_moved = true;
        } else {
            const Tweak& tweak = subject.scene().tweaks[axis.index];
            TweakValue& value = subject.preset.values[axis.index];
            value[axis.component] = at_share(tweak, *range_of(tweak), point[i]);
            value = clamp_to_range(tweak, value);
        }
    }
    if (is_moved) subject.preset.events = {{.time = 0.0, .down = true, .mouse = mouse}};
    return time;
}

std::string Space::words(const Point& point, const CheckSubject& subject) const {
    std::string words;
    const auto add = [&](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
    std::size_t told = SIZE_MAX;
    glm::dvec2 mouse(0.5);
    bool is_moved = false;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (point[i] == usual_[i]) continue;
        const Axis& axis = axes_[i];
        if (axis.of == Axis::Of::time) add(fmt::format("time {:.4g}", point[i] * kLongest));
        if (axis.of == Axis::Of::mouse) {
            mouse[static_cast<int>(axis.component)] = point[i];
            is_moved = true;
        }
        if (axis.of != Axis::Of::tweak || told == axis.index) continue;
        told = axis.index;
        const Tweak& tweak = subject.scene().tweaks[axis.index];
        add(tweak.name + "=" + format_value(tweak, subject.preset.values[axis.index]));
    }
    if (is_moved) add(fmt::format("mouse {:.3g},{:.3g}", mouse.x, mouse.y));
    return words.empty() ? "the preset as it is" : words;
}

}  // namespace glint
