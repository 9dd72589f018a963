// All quality tweaks of a scene together: which joint settings are the best within a budget.
#pragma once

#include "gl/context.h"
#include "measure/study/measure.h"
#include "measure/study/plan.h"

#include <functional>
#include <optional>

namespace glint {

// What the options ask for: the least error within so many milliseconds, or the least time within
// this RMSE or FLIP.
struct Limit {
    enum class Of { ms, rmse, flip } of = Of::ms;
    std::optional<double> number{};  // above 0; none: what the preset itself takes
};
// Nothing where they ask for none. Throws UsageError for a number that is no limit.
std::optional<Limit> limit_of(const StudyOptions& options);

// RGBA, and what MeasuredScene says of its loops.
struct DrawnPicture {
    std::vector<float> rgba{};
    std::string cut_pass{};
};

// What a search asks of those who want it. Pictures that it judges the truth by are looked for
// first, and handed on when they are drawn.
struct SearchCaller {
    std::function<std::optional<DrawnPicture>(const Knob&, const KnobValue&)> find;
    std::function<void(const Knob&, const KnobValue&, const DrawnPicture&)> keep;
    std::function<void(int tried, int most)> told;  // how many, of how many at most
};

// Searches over the values of these knobs, and gives what was found as the values of one: the
// settings near the budget that nothing beats, and the preset's own. What counts as the truth is
// the picture with all references at once, or, where the driver cuts its loops short, with half of
// each, a quarter or an eighth. Throws UsageError where there is nothing to choose.
Knob joint_knob(const Preset& preset, const std::vector<Knob>& knobs, const Limit& limit,
                double seconds, Context& context, const MeasureOptions& how,
                const SearchCaller& caller);

// Which row the limit chooses, when all have been measured.
void choose_best(Study& study, const Limit& limit);

}  // namespace glint
