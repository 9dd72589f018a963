// What noisy times tell: where a median lies, and which of two rows is faster.
#pragma once

#include "measure/rows/study.h"

#include <span>
#include <vector>

namespace glint {

// Where the median lies in 95 of 100 cases, by a seeded bootstrap. Neighbouring values are drawn
// together: they were measured under the same load.
struct Interval {
    double low = 0.0, high = 0.0;
};
Interval median_interval(std::span<const double> values);

// How likely the values would be this low or lower if they lay evenly round `centre`: Wilcoxon's
// signed-rank test, one-sided.
double chance_below(std::span<const double> values, double centre);

constexpr double kAlike = 0.01;    // by which the same work differs from call to call
constexpr double kEnough = 0.025;  // nearer than this, nobody asks which is faster

// Which row is faster than which, out of times that were taken in rounds: the i-th of each row in
// the i-th round. Rows may end early.
class TimeVerdicts {
public:
    // `look`, from 0: the how manieth time it is asked, as rounds are added. Over all pairs and all
    // looks together at most one study in twenty has a wrong faster or slower. These are told by
    // more than `least`, a share of the time.
    TimeVerdicts(std::span<const std::vector<double>> times, int look, double least = kAlike);

    // What `row` is beside `than`.
    TimeVerdict of(std::size_t row, std::size_t than) const {
        return verdicts_[row * rows_ + than];
    }
    // Whether more rounds may bring a verdict: neither told apart nor known to be alike.
    bool is_open(std::size_t row) const { return open_[row]; }

private:
    std::size_t rows_;
    std::vector<TimeVerdict> verdicts_;
    std::vector<bool> open_;
};

}  // namespace glint
