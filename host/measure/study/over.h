// A study over several views of one scene: its presets, or several times.
#pragma once

#include "measure/rows/study.h"
#include "measure/study/plan.h"

#include <string>
#include <vector>

namespace glint {

struct View {
    std::string name;  // "sea-morning", "time 5"
    Preset preset;
};

// What `--over` names: "presets", which are those of this scene beside the file (of a scene also in
// the folder presets beside its own), or "time=A:B:STEP", both ends included. None where it is "".
// Throws UsageError.
std::vector<View> views_over(const Preset& preset, const StudyOptions& options);

// A knob as it is turned in another view: that has its own look, but the quality of `base`.
Knob knob_in(const View& view, const Preset& base, const Knob& knob);

// One study of all views: of errors the root of their mean square, with the worst named; of times
// the mean, round by round. To be judged.
Study over_all(const std::vector<View>& views, const std::vector<Study>& studies);

}  // namespace glint
