#include "measure/check/drift.h"

#include "base/median.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

namespace glint {
namespace {

constexpr std::size_t kCurvesOfOutput = 9;   // of each channel, their sum, the largest of each
constexpr std::size_t kParts = 8;            // of a run
constexpr std::size_t kLeastOfGrowth = 400;  // below, a rounding looks like a growth
constexpr double kLeastGrowth = 1.02;        // from the first part to the last
constexpr double kLeastRatio = 1.01;         // from one increase to the next
// What the roots' rate has to be of that of the squares: it is half where they grow like exp(t),
// and nothing where they grow evenly, like a place.
constexpr double kLeastOfRoots = 0.35;
constexpr double kUneven = 0.1, kDust = 3e-3;  // how far these ratios may fall

// Numbers that come evenly, so many frames apart.
struct Series {
    std::vector<double> values;
    double apart = 1.0;
};

// By windows of Hann's, two parts long, whose sum is even: what swings is met in whatever phase,
// and in plain means of parts would be one more in some of them than in others.
Series means_of_parts(std::span<const double> values) {
    const std::size_t length = values.size() / (kParts + 1);
    std::vector<double> means(kParts);
    for (std::size_t part = 0; part < kParts; ++part) {
        for (std::size_t i = 0; i < 2 * length; ++i) {
            const double turn =
                std::numbers::pi * static_cast<double>(i) / static_cast<double>(length);
            means[part] += (1.0 - std::cos(turn)) * values[part * length + i];
        }
        means[part] /= 2.0 * static_cast<double>(length);
    }
    return {std::move(means), static_cast<double>(length)};
}

// The peaks of what swings, where these come evenly: of few swings a window's mean is more or less
// by the phase that it meets.
Series peaks_of(std::span<const double> values) {
    constexpr std::size_t kLeastPeaks = 5;
    constexpr double kUnevenly = 0.05;  // from one gap to the next
    Series peaks;
    std::vector<double> at, gaps;
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
        const double before = values[i - 1], here = values[i], after = values[i + 1];
        if (!(here > before) || !(here >= after)) continue;
        const double off = 0.5 * (before - after) / (before - 2.0 * here + after);  // a parabola's
        peaks.values.push_back(here - 0.25 * (before - after) * off);
        at.push_back(static_cast<double>(i) + off);
        if (at.size() > 1) gaps.push_back(at.back() - at[at.size() - 2]);
    }
    if (at.size() < kLeastPeaks) return {};
    peaks.apart = median_of(gaps);
    for (std::size_t i = 0; i + 1 < gaps.size(); ++i)
        if (std::abs(gaps[i + 1] - gaps[i]) > kUnevenly * gaps[i]) return {};
    if (at.size() < 2 * (kParts + 1)) return peaks;
    Series means = means_of_parts(peaks.values);
    means.apart *= peaks.apart;
    return means;
}

// The factor of a frame by which the values' increases grow, where that does not fall: then they
// grow like exp(t), or faster, whatever is added to them. Sums and squares of time do not.
std::optional<double> steady_factor(const Series& series, double least_ratio) {
    const std::vector<double>& means = series.values;
    if (means.empty() || !(means.back() > kLeastGrowth * means.front())) return std::nullopt;
    double least = std::numeric_limits<double>::infinity(), most = 0.0, fall = 0.0;
    for (std::size_t i = 0; i + 2 < means.size(); ++i) {
        const double one = means[i + 1] - means[i], next = means[i + 2] - means[i + 1];
        if (!(one > 0.0)) return std::nullopt;
        least = std::min(least, next / one);
        most = std::max(most, next / one);
        fall = std::max(fall, most - next / one);
    }
    if (least < least_ratio || fall > kUneven * (most - 1.0) + kDust) return std::nullopt;
    return std::pow((least + most) / 2.0, 1.0 / series.apart);
}

std::optional<double> steady_factor(std::span<const double> values,
                                    double least_ratio = kLeastRatio) {
    if (const auto factor = steady_factor(means_of_parts(values), least_ratio)) return factor;
    return steady_factor(peaks_of(values), least_ratio);
}

// The same of the values whose squares these are. With what is added in every frame it is they that
// grow steadily, and with a state of many parts their squares.
std::optional<double> factor_of_values(std::span<const double> squares) {
    std::vector<double> roots(squares.begin(), squares.end());
    for (double& value : roots) value = std::sqrt(value);
    if (const auto factor = steady_factor(squares)) {
        const auto of_roots = steady_factor(roots, 1.0);
        if (of_roots && std::log(*of_roots) > kLeastOfRoots * std::log(*factor))
            return std::sqrt(*factor);
    }
    return steady_factor(roots);
}

// Without the frames in which nothing has changed yet.
std::span<const double> without_start(std::span<const double> values) {
    constexpr double kSame = 1e-7;
    std::size_t first = 0;
    while (first + 1 < values.size() &&
           std::abs(values[first + 1] - values[first]) <= kSame * std::abs(values[first]))
        ++first;
    // From nothing to something is no growth either.
    if (first + 1 < values.size() && values[first] == 0.0) ++first;
    return values.subspan(first);
}

}  // namespace

void StateCurves::add(const CheckSubject& subject) {
    std::size_t number = 0;
    float largest = 0.0f;
    const auto put = [&](const std::string& name, double square) {
        if (number == curves_.size()) curves_.push_back({name, {}});
        curves_[number++].means.push_back(square);
    };
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!subject.is_fed_back(i)) continue;
        const auto names = output_names(subject.scene(), passes[i].pass);
        for (std::size_t output = 0; output < names.size(); ++output) {
            std::array<double, 4> squares{}, most{};
            const std::vector<float> values = subject.renderer().read_buffer(i, output);
            for (std::size_t k = 0; k < values.size(); ++k) {
                if (!std::isfinite(values[k])) continue;
                if (std::abs(values[k]) > std::abs(largest)) largest = values[k];
                const double square =
                    static_cast<double>(values[k]) * static_cast<double>(values[k]);
                squares[k % 4] += square;
                most[k % 4] = std::max(most[k % 4], square);
            }
            const double texels = std::max(static_cast<double>(values.size()) / 4.0, 1.0);
            for (std::size_t c = 0; c < 4; ++c)
                put(names[output] + "." + "xyzw"[c], squares[c] / texels);
            put(names[output], 0.0);  // see sum_of_moving()
            // What grows in one place is nothing beside all others.
            for (std::size_t c = 0; c < 4; ++c)
                put("the largest of " + names[output] + "." + "xyzw"[c], most[c]);
        }
    }
    largest_.push_back(std::abs(largest));
    signed_.push_back(largest);
}

// Of the four curves before this one, those that change; of one alone nothing, for it stands there.
std::vector<double> StateCurves::sum_of_moving(std::size_t index) const {
    constexpr std::ptrdiff_t kBegun = 8;  // frames, after which all have their first values
    if (frames() < kLeastOfGrowth) return {};
    std::vector<double> sum(frames());
    int moving = 0;
    for (std::size_t c = index - 4; c < index; ++c) {
        const std::vector<double>& means = curves_[c].means;
        const auto [least, most] = std::minmax_element(means.begin() + kBegun, means.end());
        if (*least == *most) continue;
        ++moving;
        std::ranges::transform(sum, means, sum.begin(), std::plus());
    }
    return moving > 1 ? sum : std::vector<double>();
}

std::string StateCurves::growth(std::size_t from) const {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        const Curve& curve = curves_[i];
        const bool is_sum = i % kCurvesOfOutput == 4;
        const std::vector<double> means = is_sum ? sum_of_moving(i) : curve.means;
        const auto values = without_start(std::span(means).subspan(std::min(from, means.size())));
        if (values.size() < kLeastOfGrowth) continue;
        const auto factor = factor_of_values(values);
        if (!factor) continue;
        return fmt::format("{} grows steadily, by {:.2g} % a frame", curve.name,
                           100.0 * std::log(*factor));
    }
    return "";
}

// Of the frames of the last quarter, those whose largest value is that of the frame before.
std::size_t StateCurves::unchanged() const {
    std::size_t same = 0;
    for (std::size_t k = frames() - frames() / 4 + 1; k < frames(); ++k)
        same += largest_[k] == largest_[k - 1];
    return same;
}

bool StateCurves::stands_beyond(float usual) const {
    constexpr float kFactor = 4.0f;
    const std::size_t steps = frames() / 4;
    return usual > 0.0f && largest() >= kFactor * usual && steps > 4 &&
           4 * unchanged() >= 3 * (steps - 1);
}

// An unstable step that is clamped: in the last quarter the largest value is mostly the same, but
// for its sign.
bool StateCurves::chatters() const {
    const std::size_t steps = frames() / 4;
    std::size_t turned = 0;
    for (std::size_t k = frames() - steps + 1; k < frames(); ++k)
        turned += signed_[k] == -signed_[k - 1] && signed_[k] != 0.0f;
    return steps > 4 && 4 * unchanged() >= 3 * (steps - 1) && 4 * turned >= steps;
}

bool StateCurves::rests() const {
    constexpr double kStill = 1e-3;
    const auto late = static_cast<std::ptrdiff_t>(frames() - frames() / 8);
    return frames() >= 8 && std::ranges::all_of(curves_, [&](const Curve& curve) {
               const auto [least, most] =
                   std::minmax_element(curve.means.begin() + late, curve.means.end());
               return *most - *least <= kStill * *most;
           });
}

bool StateCurves::explodes(float usual) const {
    constexpr float kFactor = 4.0f, kBeyondUsual = 8.0f, kLeast = 10.0f;
    if (stands_beyond(usual) && chatters()) return true;
    constexpr double kLonger = 1.5;  // of x^n the second factor takes 4^(1/n) times as long
    if (largest() < std::max(kLeast, kBeyondUsual * usual)) return false;
    for (std::size_t a = 0; a < largest_.size(); ++a) {
        if (largest_[a] <= 0.0f) continue;
        const auto reach = [&](std::size_t from, float wanted) {
            while (from < largest_.size() && largest_[from] < wanted) ++from;
            return from;
        };
        const std::size_t b = reach(a, kFactor * largest_[a]);
        if (b >= largest_.size()) continue;
        const std::size_t c = reach(b, kFactor * largest_[b]);
        if (c >= largest_.size() || largest_[c] < std::max(kLeast, usual)) continue;
        if (static_cast<double>(c - b) <= kLonger * static_cast<double>(b - a)) return true;
    }
    return false;
}

bool StateCurves::multiplies() const {
    constexpr float kLeast = 1.1f, kLeap = 30.0f, kRise = 100.0f;
    constexpr std::size_t kFrames = 4;
    std::size_t from = 0;
    for (std::size_t k = 1; k < frames(); ++k) {
        const float before = largest_[k - 1];
        if (!(largest_[k] > kLeast * before && largest_[k] <= kLeap * before)) from = k;
        if (k - from >= kFrames && largest_[k] >= kRise * largest_[from]) return true;
    }
    return false;
}

float StateCurves::largest() const {
    return largest_from(0);
}

float StateCurves::largest_from(std::size_t frame) const {
    return frame < frames()
               ? *std::max_element(largest_.begin() + static_cast<long>(frame), largest_.end())
               : 0.0f;
}

float StateCurves::largest_before(std::size_t frame) const {
    return *std::max_element(largest_.begin(), largest_.begin() + static_cast<long>(frame));
}

}  // namespace glint
