// What a person can turn: every number of every tweak, the time, the date, the mouse, keys, the
// size; as shares of ranges.
#pragma once

#include "measure/check/search.h"
#include "measure/check/subject.h"

#include <optional>
#include <vector>

namespace glint {

struct Range {
    double min, max;
};

// Where the slider ends, or what is safe of it; nothing for a number without a range, which stays
// at the preset's.
std::optional<Range> range_of(const Tweak& tweak);

// A component of a tweak, evenly over the slider's length.
double at_share(const Tweak& tweak, const Range& range, double share);

class Space {
public:
    // `keys`: held down or not.
    explicit Space(const CheckSubject& subject, const std::vector<int>& keys = {});
    // The preset's own.
    const Point& usual() const { return usual_; }
    // Each tweak at 0 whose range has that within, and all of those: directions and lengths have
    // none there, and neither ends nor a sequence meet it.
    std::vector<Point> zeros() const;
    // Each float at the value of another, where its range has that: what is between two has no
    // length there.
    std::vector<Point> equals() const;
    // The same at a size of odd sides, where a pixel may lie in the middle.
    Point at_odd_size(Point point) const;
    // The preset's tweaks with what else there is: the mouse pressed at some places, each key held
    // and all of them, a late time, the ends of a year.
    std::vector<Point> inputs() const;
    // The point with this range's tweak at the number of fewest digits that is as good as the one
    // there; itself for other ranges.
    Point rounded(Point point, std::size_t axis) const;
    // How many of the last ranges are dear to change: those of the size.
    std::size_t rare() const { return 2; }
    // Sets tweaks, events and size; gives the time.
    double apply(const Point& point, CheckSubject& subject) const;
    // "a=0.95, mouse 0.3,0.7, time 7.3": what of it is not as usual.
    std::string words(const Point& point, const CheckSubject& subject) const;

private:
    struct Axis {
        enum class Of { tweak, time, date, mouse, key, size } of;
        std::size_t index;  // of the tweak; the key
        std::size_t component;
    };
    glm::ivec2 size_at(const Point& point) const;

    const std::vector<Tweak>& tweaks_;
    std::vector<Axis> axes_;
    std::vector<std::optional<double>> zero_;  // the share at which a tweak is 0
    Point usual_;
    glm::ivec2 usual_size_;
    bool is_stateful_;
};

// "2028-02-29 12:00:00"
std::string date_words(const Date& date);

// The preset's values, and the ends of all ranges, so combined that any two tweaks take every
// combination of theirs, at most `most` sets; then the other entries of menus, each alone, where
// more than one set is wanted.
std::vector<std::vector<TweakValue>> values_at_ends(const CheckSubject& subject, std::size_t most);

}  // namespace glint
