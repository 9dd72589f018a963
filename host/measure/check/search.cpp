#include "measure/check/search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace glint {
namespace {

constexpr double kLeastStep = 1e-3;
constexpr std::size_t kRare = 4;

// The positive root of x^(d+1) = x + 1: 1.618… for one range, 1.3247… for two.
double root_of(std::size_t dimensions) {
    double x = 2.0;
    for (int i = 0; i < 64; ++i)
        x = std::pow(1.0 + x, 1.0 / (static_cast<double>(dimensions) + 1.0));
    return x;
}

}  // namespace

Point Search::end_point(std::size_t row) const {
    const std::size_t rows = std::bit_ceil(often_ + 1);
    Point point = usual_;
    for (std::size_t i = 0; i < often_; ++i) {
        const bool is_high = (std::popcount((row % rows) & (i + 1)) % 2 == 0) == (row < rows);
        point[i] = is_high ? 1.0 : 0.0;
    }
    return point;
}

// A sequence each of the ranges that change often and rarely, so that none is the coarser for the
// other.
Point Search::spread_point() {
    const auto number = static_cast<double>(++spread_);
    Point point = usual_;
    const auto spread = [&](std::size_t begin, std::size_t end) {
        const double root = root_of(end - begin);
        double share = 1.0;
        for (std::size_t i = begin; i < end; ++i) {
            share /= root;
            point[i] = std::fmod(0.5 + number * share, 1.0);
        }
    };
    spread(0, often_);
    if (often_ == 0 || spread_ % kRare == 0) spread(often_, point.size());
    return point;
}

// From the best point of the next operation whose distance can be changed at all.
std::optional<Point> Search::moved_point() {
    for (std::size_t i = 0; i < goals_.size(); ++i) {
        const std::size_t at = turn_++ % goals_.size();
        Goal& goal = goals_[at];
        if (!goal.varies || goal.nearest <= 0.0f || goal.step < kLeastStep) continue;
        moving_ = at;
        Point point = goal.best;
        const bool is_rare = often_ == 0 || (often_ < point.size() && ++moves_ % kRare == 0);
        const std::size_t room = is_rare ? point.size() : often_;
        const auto count = std::min<std::size_t>(1 + random_() % 3, room);
        for (std::size_t k = 0; k < count; ++k) {
            double& component = point[random_() % room];
            component = std::clamp(component + goal.step * (2.0 * drawn() - 1.0), 0.0, 1.0);
        }
        return point;
    }
    return std::nullopt;
}

Point Search::next() {
    const std::size_t number = asked_++;
    moving_ = SIZE_MAX;
    if (number == 0 || usual_.empty()) return usual_;
    const std::size_t ends = often_ == 0 ? 0 : 2 * std::bit_ceil(often_ + 1);
    if (number <= ends) return end_point(number - 1);
    // Two moves for one that explores, once anything is known to vary.
    if (number % 3 != 0)
        if (auto moved = moved_point()) return *moved;
    return spread_point();
}

void Search::tell(const Point& point, const Trial& trial) {
    if (goals_.empty()) goals_.resize(trial.distances.size());
    for (std::size_t i = 0; i < std::min(goals_.size(), trial.distances.size()); ++i) {
        Goal& goal = goals_[i];
        const float distance = trial.distances[i];
        const bool moved = i == moving_;
        if (!std::isfinite(distance)) {
            if (moved) goal.step *= 0.9;
            continue;
        }
        if (goal.best.empty()) {
            goal.best = point;
            goal.nearest = goal.first = distance;
            continue;
        }
        goal.varies |= distance != goal.first;
        if (distance < goal.nearest) {
            goal.nearest = distance;
            goal.best = point;
            if (moved) goal.step = std::min(goal.step * 1.6, 0.5);
        } else if (moved) {
            goal.step *= 0.88;
        }
    }
}

std::vector<Search::Near> Search::nearest() const {
    std::vector<Near> list;
    for (std::size_t i = 0; i < goals_.size(); ++i)
        if (goals_[i].varies && goals_[i].nearest > 0.0f)
            list.push_back({i, goals_[i].best, goals_[i].nearest});
    std::ranges::stable_sort(list, {}, [&](const Near& near) {
        return near.distance / std::max(goals_[near.operation].first, 1e-30f);
    });
    return list;
}

std::optional<Point> follow_to_zero(const Search::Near& from, const Try& attempt,
                                    const Rounded& rounded, int most) {
    constexpr int kSteps = 5;
    constexpr double kFirstStep = 1e-3;
    for (std::size_t axis = 0; axis < from.point.size() && most > 0; ++axis) {
        double nearer = from.point[axis], other = nearer;
        double nearer_distance = from.distance, other_distance = nearer_distance;
        double share = nearer < 0.5 ? nearer + kFirstStep : nearer - kFirstStep;
        for (int step = 0; step <= kSteps && most > 0; ++step, --most) {
            Point point = from.point;
            point[axis] = share;
            if (step > 0) {  // of a step from a place, not the place that gives the slope
                const Point round = rounded(point, axis);
                if (round != point && attempt(round).fails) return round;
            }
            const Trial trial = attempt(point);
            if (trial.fails) return point;
            const double distance = trial.distances[from.operation];
            if (!std::isfinite(distance)) break;
            const bool is_nearer = distance < nearer_distance;
            other = is_nearer ? nearer : share;
            other_distance = is_nearer ? nearer_distance : distance;
            if (is_nearer) nearer = share, nearer_distance = distance;
            if (other_distance == nearer_distance) break;
            share =
                nearer + (nearer - other) * nearer_distance / (other_distance - nearer_distance);
            if (share < 0.0 || share > 1.0 || share == nearer) break;
        }
    }
    return std::nullopt;
}

namespace {

// Where the parabola through three places is least; nothing where it is not.
std::optional<double> least_of(const std::array<double, 3>& x, const std::array<double, 3>& y) {
    const double left = (y[1] - y[0]) / (x[1] - x[0]), right = (y[2] - y[1]) / (x[2] - x[1]);
    const double bend = (right - left) / (x[2] - x[0]);
    if (!(bend > 0.0)) return std::nullopt;
    return (x[0] + x[1]) / 2.0 - left / (2.0 * bend);
}

}  // namespace

std::optional<Point> descend_to_zero(Point from, std::size_t operation, const Try& attempt,
                                     const Rounded& rounded, int most) {
    constexpr double kStep = 0.1;
    const auto distance_at = [&](const Point& point, bool& fails) {
        const Trial trial = attempt(point);
        fails = trial.fails;
        --most;
        return fails ? 0.0 : static_cast<double>(trial.distances[operation]);
    };
    bool fails = false;
    double here = distance_at(from, fails);
    for (std::size_t axis = 0; axis < from.size() && most > 0 && !fails; ++axis) {
        std::array<double, 3> x{}, y{};
        const double step = from[axis] < 0.5 ? kStep : -kStep;
        for (std::size_t i = 0; i < 3 && !fails; ++i) {
            Point point = from;
            point[axis] = x[i] = from[axis] + static_cast<double>(i) * step;
            y[i] = i == 0 ? here : distance_at(point, fails);
            if (fails) return point;
            if (i > 0 && (y[i] == y[0] || !std::isfinite(y[i]))) break;
        }
        if (y[2] == 0.0) continue;
        const Point start = from;
        for (const double power : {2.0, 1.0}) {
            std::array<double, 3> raised{};
            std::ranges::transform(y, raised.begin(), [&](double v) { return std::pow(v, power); });
            const auto least = least_of(x, raised);
            if (!least || *least < 0.0 || *least > 1.0) continue;
            Point point = start;
            point[axis] = *least;
            point = rounded(std::move(point), axis);
            const double distance = distance_at(point, fails);
            if (fails) return point;
            if (distance < here) from = point, here = distance;
        }
    }
    return std::nullopt;
}

Point smallest(Point failing, const Point& usual, const std::function<bool(const Point&)>& fails,
               int most) {
    constexpr int kHalvings = 7;
    for (std::size_t i = 0; i < failing.size() && most > 0; ++i) {
        if (failing[i] == usual[i]) continue;
        Point point = failing;
        point[i] = usual[i];
        --most;
        if (fails(point)) failing = std::move(point);
    }
    for (std::size_t i = 0; i < failing.size(); ++i) {
        if (failing[i] == usual[i]) continue;
        double sound = usual[i];
        for (int k = 0; k < kHalvings && most > 0; ++k, --most) {
            Point point = failing;
            point[i] = (sound + failing[i]) / 2.0;
            if (fails(point))
                failing = std::move(point);
            else
                sound = point[i];
        }
    }
    return failing;
}

}  // namespace glint
