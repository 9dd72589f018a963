// The worst of many cases, by the search of `glint check` (measure/check/search.h): what a test may
// turn spans the space, and it goes on from where a bar came nearest to its limit.
#pragma once

#include "bar.h"
#include "measure/check/search.h"

#include <cmath>
#include <functional>
#include <set>
#include <vector>

namespace glint {

// The numbers of one case, each a share of its range; to be taken in the same order in every case.
class Dials {
public:
    Dials(const Point& point, unsigned case_number) : number(case_number), point_(point) {}

    double share() { return point_.at(next_++); }
    double between(double low, double high) { return std::lerp(low, high, share()); }
    double between_logs(double low, double high) { return low * std::pow(high / low, share()); }

    const unsigned number;  // of the case, from 0: a seed of what it draws by chance
    const Point& point() const { return point_; }

private:
    const Point& point_;
    std::size_t next_ = 0;
};

// Tries so many cases of so many numbers; each tells the bars what it saw, or nothing where it does
// not count. The first has all numbers in the middle of their ranges.
inline void search_worst(std::size_t ranges, unsigned cases, const std::vector<Worst*>& bars,
                         const std::function<void(Dials&)>& try_one) {
    Search search(Point(ranges, 0.5));
    for (unsigned k = 0; k < cases; ++k) {
        const Point point = search.next();
        Dials dials(point, k);
        try_one(dials);
        Trial trial;
        for (Worst* bar : bars) trial.distances.push_back(bar->distance_since_asked());
        search.tell(point, trial);
    }
}

// The same for shares of what is drawn by chance, which are off by chance: the search goes by few,
// and bars see 16 times as many of the worst case of each.
inline void search_worst_share(
    std::size_t ranges, unsigned cases, const std::vector<Worst*>& bars,
    const std::function<void(Dials&, unsigned times, const std::vector<Worst*>&)>& try_one) {
    std::vector<Worst> few;
    for (const Worst* bar : bars) few.push_back(bar->unseen());
    std::vector<Worst*> seen;
    for (Worst& one : few) seen.push_back(&one);
    std::vector<Point> worst(bars.size());
    search_worst(ranges, cases, seen, [&](Dials& dials) {
        const std::vector<Worst> before = few;
        try_one(dials, 1, seen);
        for (std::size_t i = 0; i < few.size(); ++i)
            if (worst[i].empty() || few[i].worst() != before[i].worst()) worst[i] = dials.point();
    });
    for (const Point& point : std::set<Point>(worst.begin(), worst.end())) {
        Dials dials(point, 1000);
        try_one(dials, 16, bars);
    }
}

}  // namespace glint
