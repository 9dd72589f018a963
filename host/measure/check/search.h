// The search for the worst: points of a unit cube are tried, and the next ones chosen by how near
// the last came to a fault.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

namespace glint {

using Point = std::vector<double>;  // a share of each range, 0 to 1

struct Trial {
    bool fails = false;
    // How far each of some operations kept off a fault; always the same ones. May be empty.
    std::vector<float> distances{};
};
using Try = std::function<Trial(const Point&)>;

// Chooses points. The same answers lead to the same points, on any machine.
//
// First the usual one. Then ends of all ranges together, so that in twice the next power of two
// trials any three ranges have met at each combination of their ends (the rows of a Hadamard matrix
// and their opposites: an orthogonal array of strength 3; Hedayat, Sloane and Stufken, "Orthogonal
// Arrays", 1999). From then on every other point is of the additive sequence R (Martin Roberts,
// "The Unreasonable Effectiveness of Quasirandom Sequences", 2018), which leaves no large hole, and
// the others move from where one operation came nearest to a fault (an evolution strategy,
// (1+1), of one to three ranges at a time, that adapts its steps; the distance is the "branch
// distance" of search-based testing, McMinn 2004).
//
// The last `rare` ranges are dear to change: no end is tried of them, and they change in every
// fourth of the points that spread, and of the moves.
class Search {
public:
    explicit Search(Point usual, std::size_t rare = 0)
        : usual_(std::move(usual)), often_(usual_.size() - rare) {}

    Point next();
    // The next of the sequence alone.
    Point spread_point();
    void tell(const Point& point, const Trial& trial);

    // Where an operation came nearest to a fault, for those that can be moved at all; first those
    // that came nearest, as a share of where they began.
    struct Near {
        std::size_t operation;  // of Trial::distances
        Point point;
        float distance;
    };
    std::vector<Near> nearest() const;

private:
    struct Goal {
        Point best{};
        float nearest = 0.0f, first = 0.0f;
        double step = 0.25;
        bool varies = false;
    };
    double drawn() { return static_cast<double>(random_()) / 4294967296.0; }
    Point end_point(std::size_t row) const;
    std::optional<Point> moved_point();

    Point usual_;
    std::size_t often_;
    std::vector<Goal> goals_;
    std::size_t asked_ = 0, spread_ = 0, turn_ = 0, moves_ = 0, moving_ = SIZE_MAX;
    std::mt19937 random_{1};
};

// A point with what a person would set in this range: a share whose number has few digits.
using Rounded = std::function<Point(Point, std::size_t)>;

// Follows an operation along each range to where its distance would be 0, by the secant method: a
// moved point comes near, but meets no pole. The point that fails, if any; at most `most` trials.
std::optional<Point> follow_to_zero(const Search::Near& from, const Try& attempt,
                                    const Rounded& rounded, int most);

// The same along one range after the other, each to where the distance is least by the parabola
// through three trials, or that through the squares of these: so two points meet that have three
// tweaks each, and poles of even order are found.
std::optional<Point> descend_to_zero(Point from, std::size_t operation, const Try& attempt,
                                     const Rounded& rounded, int most);

// The point between a failing one and the usual that differs in the fewest ranges, and by the
// least; at most `most` trials.
Point smallest(Point failing, const Point& usual, const std::function<bool(const Point&)>& fails,
               int most);

}  // namespace glint
