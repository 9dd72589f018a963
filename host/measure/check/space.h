// What a person can turn: every number of every tweak, the time, the mouse; as shares of ranges.
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
    explicit Space(const CheckSubject& subject);
    // The preset's own.
    const Point& usual() const { return usual_; }
    // Sets tweaks and events; gives the time.
    double apply(const Point& point, CheckSubject& subject) const;
    // "a=0.95, mouse 0.3,0.7, time 7.3": what of it is not as usual.
    std::string words(const Point& point, const CheckSubject& subject) const;

private:
    struct Axis {
        enum class Of { tweak, time, mouse } of;
        std::size_t index;  // of the tweak
        std::size_t component;
    };
    std::vector<Axis> axes_;
    Point usual_;
};

}  // namespace glint
