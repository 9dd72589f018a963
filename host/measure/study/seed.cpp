#include "measure/study/seed.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

// A mean of half the samples, all of which the reference has, too, is off it by 0.7 of what two
// seeds differ by.
constexpr double kFarNearer = 0.25, kMuchLess = 0.5;

}  // namespace

bool seed_moves_something_else(const Study& study, const Knob& knob) {
    if (knob.second_work.kind != SecondWork::Kind::seed || knob.names_second || !knob.more ||
        !study.has_own_error() || !knob.reference.work)
        return false;
    const double reference = *knob.reference.work;
    return std::ranges::any_of(study.rows, [&](const StudyRow& row) {
        // The very picture is one of a text that does no more work than it.
        if (!row.has_error() || row.error->max == 0.0 || row.work.value_or(0.0) <= 0.0)
            return false;
        const double share = knob.more_is_better ? *row.work / reference : reference / *row.work;
        return share <= kMuchLess && row.error->rmse < kFarNearer * study.reference_error->rmse;
    });
}

void measure_by_work(Knob& knob) {
    knob.second = knob.more;
    knob.second_work = kTwiceTheWork;
    if (knob.rival && knob.rival->more && knob.rival->work.kind == SecondWork::Kind::seed) {
        knob.rival->second = knob.rival->more;
        knob.rival->work = kTwiceTheWork;
    }
    knob.notes.push_back(
        fmt::format("the seed moves something else than {}, whose values are much nearer to each "
                    "other than pictures of two seeds: twice the work measures the reference",
                    knob.name));
}

}  // namespace glint
