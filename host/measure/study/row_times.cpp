#include "measure/study/row_times.h"

#include "base/median.h"
#include "measure/study/rounds.h"
#include "measure/study/statistics.h"

#include <algorithm>
#include <vector>

namespace glint {
namespace {

Timing median_and_ends(const std::vector<double>& times) {
    if (times.empty()) return {};
    const auto [least, most] = std::ranges::minmax(times);
    return {.median = median_of(times), .min = least, .max = most};
}

// By how much the rounds after the first so many took longer, as those tell that were in all.
double later_share(const std::vector<double>& all, std::size_t count) {
    if (count == 0 || count >= all.size()) return 1.0;
    const double first = median_of({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)});
    return first > 0.0 ? median_of(all) / first : 1.0;
}

}  // namespace

void take_times(Study& study, bool on_software) {
    std::vector<FrameTimes> timed;
    for (const StudyRow& row : study.rows)
        if (!row.times.wall.empty()) timed.push_back(row.times);
    study.clock = best_clock(timed, on_software);
    const std::vector<double>* all = nullptr;
    for (const StudyRow& row : study.rows) {
        const std::vector<double>& times = times_by(study.clock, row.times);
        if (!all || times.size() > all->size()) all = &times;
    }
    for (StudyRow& row : study.rows) {
        row.wall = median_and_ends(row.times.wall);
        row.gpu = median_and_ends(row.times.gpu);
        row.processor = median_and_ends(row.times.processor);
        const std::vector<double>& times = times_by(study.clock, row.times);
        const Interval interval = median_interval(times);
        row.ms = median_and_ends(times);
        row.ms.low = interval.low;
        row.ms.high = interval.high;
        const double later = later_share(*all, times.size());
        for (double* ms : {&row.ms.median, &row.ms.min, &row.ms.max, &row.ms.low, &row.ms.high})
            *ms *= later;
    }
}

}  // namespace glint
