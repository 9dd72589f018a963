// What a person may have brought a scene to, for cases that look at a few of these, where a search
// over all would be too dear.
#pragma once

#include "measure/check/subject.h"

#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct Situation {
    std::vector<TweakValue> values;
    std::vector<Event> events;
    double time = 0.0;  // s, of a scene without a state
    Date date{};        // when time is 0

    // The subject as it was at first, but for this.
    void bring(CheckSubject& subject) const;
};

// First the preset as it is; then the ends of all ranges, at most `ends` sets in all, tweaks at 0,
// the mouse pressed, keys held, a late time; then `spread` points within all ranges. Of a subject
// that is specialised, the preset's tweaks alone.
std::vector<Situation> situations(CheckSubject& subject, std::size_t ends, int spread);

// Whether it may move at some values of its tweaks, though it stands still at the preset's.
bool reads_a_clock(std::string_view text);

// "; at a=0.95, b=on, time 100, mouse 0.5,0.5, key Space": what is not as the preset has it; "" for
// nothing.
std::string where_words(const Situation& situation, const CheckSubject& subject);

}  // namespace glint
