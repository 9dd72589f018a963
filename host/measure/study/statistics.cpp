#include "measure/study/statistics.h"

#include "base/median.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>

namespace glint {
namespace {

constexpr double kErrors = 0.05;  // studies that may have a wrong verdict
constexpr int kResamples = 1000;
constexpr std::size_t kExact = 40;  // values, beyond which the normal distribution will do

// By signed ranks, with a sum of ranks of at most `sum` on one side of the centre.
double exact_chance(std::size_t count, std::size_t sum) {
    std::vector<double> chance(count * (count + 1) / 2 + 1, 0.0);
    chance[0] = 1.0;
    for (std::size_t rank = 1; rank <= count; ++rank) {
        for (std::size_t s = chance.size(); s-- > 0;) {
            chance[s] = 0.5 * (chance[s] + (s >= rank ? chance[s - rank] : 0.0));
        }
    }
    return std::accumulate(chance.begin(), chance.begin() + static_cast<std::ptrdiff_t>(sum) + 1,
                           0.0);
}

double normal_chance(std::size_t count, std::size_t sum) {
    const auto n = static_cast<double>(count);
    const double mean = n * (n + 1.0) / 4.0;
    const double deviation = std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
    const double z = (static_cast<double>(sum) + 0.5 - mean) / deviation;
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

struct Pair {
    std::size_t a, b, rounds;
    double faster, slower;  // chances of this if a were not faster than b, or not slower
    bool alike;
    double chance() const { return std::min(1.0, 2.0 * std::min(faster, slower)); }
};

Pair compare(std::span<const std::vector<double>> times, std::size_t a, std::size_t b,
             double least) {
    // Loads come and go for both, as factors.
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(times[a].size(), times[b].size()); ++i) {
        if (times[a][i] > 0.0 && times[b][i] > 0.0)
            ratios.push_back(std::log(times[a][i] / times[b][i]));
    }
    const auto above = [&](double centre) {
        std::vector<double> turned = ratios;
        for (double& ratio : turned) ratio = -ratio;
        return chance_below(turned, -centre);
    };
    return {.a = a,
            .b = b,
            .rounds = ratios.size(),
            .faster = chance_below(ratios, -least),
            .slower = above(least),
            .alike = chance_below(ratios, kEnough) < kErrors && above(-kEnough) < kErrors};
}

}  // namespace

Interval median_interval(std::span<const double> values) {
    if (values.empty()) return {};
    const std::size_t count = values.size();
    const auto block = static_cast<std::size_t>(std::cbrt(static_cast<double>(count)) + 0.5);
    std::mt19937_64 random(count);
    std::vector<double> medians, sample;
    for (int i = 0; i < kResamples; ++i) {
        sample.clear();
        while (sample.size() < count) {
            const std::size_t begin = random() % count;
            for (std::size_t k = 0; k < block && sample.size() < count; ++k)
                sample.push_back(values[(begin + k) % count]);
        }
        medians.push_back(median_of(sample));
    }
    std::ranges::sort(medians);
    return {.low = medians[kResamples / 40], .high = medians[kResamples - 1 - kResamples / 40]};
}

double chance_below(std::span<const double> values, double centre) {
    std::vector<double> off;
    for (const double value : values)
        if (value != centre) off.push_back(value - centre);
    std::ranges::stable_sort(off, {}, [](double v) { return std::abs(v); });
    std::size_t above = 0;
    for (std::size_t i = 0; i < off.size(); ++i) above += off[i] > 0.0 ? i + 1 : 0;
    if (off.empty()) return 1.0;
    return off.size() <= kExact ? exact_chance(off.size(), above)
                                : normal_chance(off.size(), above);
}

TimeVerdicts::TimeVerdicts(std::span<const std::vector<double>> times, int look, double least)
    : rows_(times.size()),
      verdicts_(rows_ * rows_, TimeVerdict::not_told_apart),
      open_(rows_, false) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < rows_; ++a)
        for (std::size_t b = a + 1; b < rows_; ++b) pairs.push_back(compare(times, a, b, least));
    // Holm's bound for all pairs; each look has half of what the one before had. A pair that was
    // told apart at an earlier one, and has had no rounds since, is judged by that.
    std::size_t most = 1;
    for (const Pair& pair : pairs) most = std::max(most, pair.rounds);
    const auto share = [&](const Pair& pair) {
        // Rounds double from look to look, but for the last, which may end early.
        const auto since = std::bit_width((most - 1) / std::max<std::size_t>(pair.rounds, 1));
        const int told_at = std::max(look - static_cast<int>(since), 0);
        return pair.chance() * std::pow(2.0, told_at + 1);
    };
    std::ranges::sort(pairs, {}, share);
    bool is_told = true;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Pair& pair = pairs[i];
        is_told &= share(pair) * static_cast<double>(pairs.size() - i) <= kErrors;
        if (is_told) {
            const bool faster = pair.faster < pair.slower;
            verdicts_[pair.a * rows_ + pair.b] = faster ? TimeVerdict::faster : TimeVerdict::slower;
            verdicts_[pair.b * rows_ + pair.a] = faster ? TimeVerdict::slower : TimeVerdict::faster;
        } else if (!pair.alike) {
            open_[pair.a] = open_[pair.b] = true;
        }
    }
}

}  // namespace glint
