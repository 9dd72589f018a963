// Which values of a tweak a study takes.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace glint {

// What a sum or a product leaves beyond these nobody has asked for.
double to_twelve_digits(double value);

bool is_number(const Tweak& tweak);  // one, and no menu

// All values that a study takes when nobody names any; none when the range is not known.
std::vector<TweakValue> values_of(const Tweak& tweak);

// What a budget chooses from, beside the preset's own value: of the list, what is `safe`, since
// what is chosen is to be used; with the values halfway to the next of each side, since a budget
// that the preset just keeps is filled by less than a whole step.
std::vector<TweakValue> values_to_choose(const Tweak& tweak, std::vector<TweakValue> list,
                                         double own);

// "16,...,4096" is doubled, "64,32,...,1" goes on by the ratio of the two numbers before the dots;
// other lists are taken as they are. Throws UsageError for dots that lead nowhere.
std::vector<std::string> parse_list(const std::string& text);

}  // namespace glint
