#include "measure/study/result.h"

#include "base/median.h"
#include "base/words.h"
#include "measure/study/rounds.h"
#include "measure/study/row_times.h"
#include "measure/study/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glint {
namespace {

constexpr double kNearFactor = 10.0;   // of the reference's own error: rows that are marked
constexpr double kFitFactor = 3.0;     // beyond, the order is off by at most 5 % of an error
constexpr double kRandomOrder = 0.75;  // below, an error is that of random samples
constexpr double kLeastOrder = 0.3;    // below, where values go cannot be told
constexpr double kNoOrder = 0.15;      // below, an error does not fall
constexpr double kLeastFall = 0.05;    // an order that is told at all: below, nothing is known
constexpr double kRefuted = 1.001;     // times what two references differ by: no nearer than that
constexpr double kMostOrder = 4.0;     // that three pictures are believed to show
constexpr double kClaim = 1.25;        // claims are known to a quarter
// Where nothing is claimed, a sixteenth of what a display shows: two methods of thousands of
// operations round by less, and none that is wrong comes so near.
constexpr double kUnclaimed = 1.0 / 255 / 16;
constexpr double kWideWork = 4.0;       // from the least to the most, to say so
constexpr double kNoNearer = 0.5;       // of the rows' error, by which a reference is off
constexpr double kSurely = 3.0;         // times what is expected
constexpr double kGrowingOrder = -0.1;  // error that grows faster than work^0.1
// Of the size of values: what sums of thousands of floats differ by, and of each term added what
// all roundings the same way make of it.
constexpr double kRounding = 1e-6, kRoundingOfTerm = 3e-8;
// Values that agree with each other so much better than with the reference do not converge to it:
// a method of order 1 that doubles its work still has a distance to go as long as its last step.
constexpr double kPlateau = 0.2;
constexpr double kMoreWork = 1.25;    // times as much as the row before
constexpr double kBeyondClaim = 2.0;  // times its own error, by which no true reference is off them

double least_rmse(const Study& study) {
    return kLeastRmse * study.reference_size;
}

// Rows that tell how the error falls.
bool counts_for_order(const Study& study, const StudyRow& row) {
    if (!row.has_error() || !row.work || *row.work <= 0.0 || row.is_reference) return false;
    return row.error->rmse > std::max(kFitFactor * study.own_error, least_rmse(study));
}

TimeVerdicts verdicts_of(const Study& study, double least) {
    std::vector<std::vector<double>> times;
    for (const StudyRow& row : study.rows) times.push_back(times_by(study.clock, row.times));
    return TimeVerdicts(times, study.look, least);
}

// Whether the row is nearer to the truth, wherever that lies within the reference's own error of
// the reference. Where it lies off by d, the difference of the two squared errors is another by
// twice d . (row - than), at most twice |d| |row - than|: by what two pictures have in common they
// are off alike. How far apart they are, if nobody knows, is at most both errors together.
bool is_nearer(const Study& study, std::size_t row, std::size_t than) {
    const double a = study.rows[row].error->rmse, b = study.rows[than].error->rmse;
    const std::vector<double>& apart = study.rows[row].apart;
    const double between = than < apart.size() ? apart[than] : a + b;
    return b * b - a * a > 2.0 * study.reference_rmse() * between;
}

void tell_verdicts(Study& study, const TimeVerdicts& verdicts) {
    const auto own = std::ranges::find_if(study.rows, &StudyRow::is_preset);
    const auto than =
        own == study.rows.end() ? 0 : static_cast<std::size_t>(own - study.rows.begin());
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        StudyRow& row = study.rows[i];
        row.verdict.reset();
        if (i != than && !row.times.wall.empty()) row.verdict = verdicts.of(i, than);
        row.nearer = study.has_truth() && i != than && own != study.rows.end() && row.has_error() &&
                     own->has_error() && is_nearer(study, i, than);
    }
}

void mark_near_reference(Study& study) {
    for (StudyRow& row : study.rows) {
        row.near_reference = row.has_error() && !row.is_reference &&
                             row.error->rmse < kNearFactor * study.reference_rmse();
    }
}

// Whether the reference is near enough to the truth to tell the row from it.
bool is_told_off(const Study& study, const StudyRow& row) {
    const double least = study.reference_rmse();
    return least == 0.0 || row.error->rmse > kRefuted * least;
}

// Rows that can be compared in both, the fastest first.
std::vector<std::size_t> comparable_rows(const Study& study) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        if (study.rows[i].has_error() && !study.rows[i].times.wall.empty()) rows.push_back(i);
    }
    std::ranges::stable_sort(rows, {}, [&](std::size_t i) { return study.rows[i].ms.median; });
    return rows;
}

bool is_same_picture(const StudyRow& row) {
    return row.has_error() && row.error->max == 0.0;
}

// A row stands when each row with less error is told to be slower, and when it is told to be nearer
// than each faster row that stands. One that cannot be told from the truth does not stand, and
// beats those that it is told to be nearer than.
void mark_pareto(Study& study, const TimeVerdicts& verdicts) {
    for (StudyRow& row : study.rows) row.pareto = false;
    if (!study.converges) return;
    const std::vector<std::size_t> rows = comparable_rows(study);
    const auto beats = [&](std::size_t k, std::size_t i) {
        const StudyRow &other = study.rows[k], &row = study.rows[i];
        // Of two that draw the very picture of the reference the one of less work is enough.
        if (is_same_picture(other) && is_same_picture(row) && other.work < row.work)
            return verdicts.of(k, i) != TimeVerdict::slower;
        if (other.error->rmse < row.error->rmse)
            return verdicts.of(k, i) != TimeVerdict::slower &&
                   (is_told_off(study, other) || is_nearer(study, k, i));
        return other.pareto && verdicts.of(k, i) == TimeVerdict::faster && !is_nearer(study, i, k);
    };
    for (const std::size_t i : rows) {
        study.rows[i].pareto =
            is_told_off(study, study.rows[i]) &&
            std::ranges::none_of(rows, [&](std::size_t k) { return beats(k, i); });
    }
}

// By how many powers errors fall with the work, the least work first. A start by which they fall
// much faster than later is that of an integrator which is not stable yet, and tells nothing of its
// order.
std::optional<double> order_from(std::vector<std::pair<double, double>> errors) {
    constexpr double kMuchFaster = 1.0;
    std::ranges::sort(errors);
    const auto slope = [&](std::size_t i) {
        return std::log(errors[i].second / errors[i + 1].second) /
               std::log(errors[i + 1].first / errors[i].first);
    };
    std::vector<double> later;  // from the end on
    for (std::size_t i = errors.size() < 2 ? 0 : errors.size() - 1; i-- > 0;) {
        const double here = slope(i);
        const double faster = later.size() > 1 ? kMuchFaster : 3.0 * kMuchFaster;
        if (!later.empty() && here > median_of(later) + faster) {
            errors.erase(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            break;
        }
        later.push_back(here);
    }
    std::vector<double> work, error;
    for (const auto& [one, its_error] : errors) {
        work.push_back(one);
        error.push_back(its_error);
    }
    const auto fallen = log_slope(work, error);
    return fallen ? std::optional(-*fallen) : std::nullopt;
}

void fit(Study& study, bool more_is_better) {
    std::vector<std::pair<double, double>> errors, cost;
    for (const StudyRow& row : study.rows) {
        if (counts_for_order(study, row))
            errors.emplace_back(more_is_better ? *row.work : 1.0 / *row.work, row.error->rmse);
        if (row.work && *row.work > 0.0 && row.ms.median > 0.0) {
            cost.emplace_back(*row.work, row.ms.median);
        }
    }
    study.order = order_from(std::move(errors));
    // Small sizes cost what a frame costs at all, so the larger half tells how the cost grows.
    std::ranges::sort(cost);
    if (!more_is_better) std::ranges::reverse(cost);
    std::vector<double> size, ms;
    for (std::size_t i = cost.size() / 2; i < cost.size(); ++i) {
        size.push_back(cost[i].first);
        ms.push_back(cost[i].second);
    }
    study.cost_exponent = log_slope(size, ms);
}

// What rounding may differ by at the work of the reference.
double rounding(const Study& study, const Knob& knob) {
    const double work = std::max(knob.reference.work.value_or(1.0), 1e-9);
    const double terms = knob.more_is_better ? work : 1.0 / work;
    return study.reference_size * std::max(kRounding, kRoundingOfTerm * std::min(terms, 1e4));
}

// Rows of work, the worst first, and how far each is from the one before.
struct Steps {
    std::vector<const StudyRow*> rows;
    std::vector<double> work;     // more is better
    std::vector<double> to_next;  // RMSE; one less, and as many as are known
    double least = kLeastRmse;    // below, they are rounding
    // Of the steps, by which errors fall wherever to; and whether what steps leave looks like them.
    Fall fall;
};

// How often a step and what it leaves look alike decides.
bool have_one_shape(const Steps& steps) {
    std::vector<double> cosines;
    for (std::size_t i = 0; i < steps.to_next.size(); ++i) {
        const double far = steps.rows[i]->error->rmse, left = steps.rows[i + 1]->error->rmse;
        if (std::min(steps.to_next[i], left) > steps.least)
            cosines.push_back(alike(far, steps.to_next[i], left));
    }
    return !cosines.empty() && median_of(cosines) > kOneShape;
}

std::optional<double> order_of(const Steps& steps) {
    std::vector<std::pair<double, double>> falls;
    for (std::size_t i = 0; i < steps.to_next.size(); ++i)
        if (steps.to_next[i] > steps.least) falls.emplace_back(steps.work[i + 1], steps.to_next[i]);
    return falls.size() < 3 ? std::nullopt : order_from(std::move(falls));
}

Steps steps_of(const Study& study, bool more_is_better) {
    Steps steps;
    steps.least = least_rmse(study);
    for (const StudyRow& row : study.rows) {
        const bool compares = row.work && *row.work > 0.0 && !row.is_reference && !row.is_between;
        if (row.has_error() && compares) steps.rows.push_back(&row);
    }
    const auto work = [&](const StudyRow* row) {
        return more_is_better ? *row->work : 1.0 / *row->work;
    };
    std::ranges::stable_sort(steps.rows, {}, work);
    for (std::size_t i = 0; i < steps.rows.size(); ++i) {
        steps.work.push_back(work(steps.rows[i]));
        if (i == 0) continue;
        // Rows that failed lie between them in the list, and are passed by.
        const std::vector<double>& apart = steps.rows[i]->apart;
        const auto before = static_cast<std::size_t>(steps.rows[i - 1] - study.rows.data());
        if (before < apart.size()) steps.to_next.push_back(apart[before]);
    }
    if (steps.to_next.size() + 1 != steps.rows.size()) steps.to_next.clear();
    steps.fall = {.order = order_of(steps), .one_shape = have_one_shape(steps)};
    return steps;
}

// How far the best row is from where the rows go, by how they near each other, whatever the
// reference says; nothing where that cannot be told.
std::optional<double> distance_to_limit(const Steps& steps) {
    const auto& [order, one_shape] = steps.fall;
    if (!order || *order < kLeastOrder) return std::nullopt;
    const double ratio = steps.work.back() / steps.work[steps.work.size() - 2];
    const double last = std::max(steps.to_next.back(), steps.least);
    if (*order < kRandomOrder && !one_shape) return last / std::sqrt(ratio - 1.0);
    return last / (std::pow(ratio, *order) - 1.0);
}

// A step by the same factor of work as all others, and the work where it ends.
struct Stride {
    double work = 0.0, length = 0.0;
};

std::vector<Stride> strides_of(const Steps& steps) {
    std::vector<Stride> strides;
    for (std::size_t i = 0; i < steps.to_next.size(); ++i) {
        const double end = steps.work[i + 1];
        strides.push_back({end, steps.to_next[i] / std::log(end / steps.work[i])});
    }
    return strides;
}

// From the reference to its second; nothing where that does no more work in the same way.
std::optional<Stride> stride_beyond(const Study& study, const Knob& knob) {
    const auto& [kind, ratio] = knob.second_work;
    const double work = knob.reference.work.value_or(0.0);
    if (!study.has_own_error() || work <= 0.0 || kind != SecondWork::Kind::more || ratio <= 1.0)
        return std::nullopt;
    return Stride{(knob.more_is_better ? work : 1.0 / work) * ratio,
                  study.reference_error->rmse / std::log(ratio)};
}

// By how many powers steps become shorter from the last of the rows to that of the reference. Of an
// error that falls faster the more work is done, as exp(-n) does, the rows show next to nothing.
std::optional<double> order_beyond(const Study& study, const Knob& knob, const Steps& steps) {
    const auto beyond = stride_beyond(study, knob);
    if (!beyond || steps.to_next.empty() || beyond->work < kMoreWork * steps.work.back())
        return std::nullopt;
    const Stride last = strides_of(steps).back();
    if (std::min(last.length, beyond->length) <= steps.least) return std::nullopt;
    return std::min(std::log(last.length / beyond->length) / std::log(beyond->work / last.work),
                    kMostOrder);
}

// How errors fall beside the reference. Where they fall slowly, the rows near it are nearer than to
// the truth by as much as it is off itself: steps know nothing of it.
Fall fall_of(const Study& study, const Knob& knob, const Steps& steps) {
    Fall fall{.order = study.order, .one_shape = steps.fall.one_shape};
    if (fall.order && *fall.order < kRandomOrder && fall.one_shape && steps.fall.order)
        fall.order = std::min(*fall.order, *steps.fall.order);
    if (fall.order && fall.one_shape)
        fall.order = std::max(*fall.order, order_beyond(study, knob, steps).value_or(0.0));
    return fall;
}

// The rows near each other, and not the reference.
void find_wrong_reference(Study& study, const Knob& knob, const Steps& steps) {
    if (steps.to_next.empty() || !study.converges) return;
    // Of hardly more work neighbours agree, whatever they converge to.
    const double ratio = steps.work.back() / steps.work[steps.work.size() - 2];
    if (ratio < kMoreWork) return;
    const StudyRow &best = *steps.rows.back(), &before = *steps.rows[steps.rows.size() - 2];
    const double error = best.error->rmse;
    if (error <= rounding(study, knob) || steps.to_next.back() >= error) return;
    const auto rest = distance_to_limit(steps);
    if (rest ? error <= kSurely * *rest + study.own_error
             : error <= kBeyondClaim * study.own_error ||
                   steps.to_next.back() >= kPlateau * error * std::min(1.0, ratio - 1.0))
        return;
    study.findings.push_back(fmt::format(
        "{} and {} agree with each other to {}, and with the reference only to {}: the "
        "reference is wrong, or another picture",
        before.value, best.value, three_digits(steps.to_next.back()), three_digits(error)));
}

// Steps that are as long at the reference as they are among the rows never end: as those of a sum
// that grows with the logarithm of its terms. By the same factor of work.
bool goes_on(const Study& study, const Knob& knob, const Steps& steps) {
    const auto beyond = stride_beyond(study, knob);
    if (steps.to_next.size() < 3 || !beyond) return false;
    std::vector<double> work, step;
    for (const Stride& stride : strides_of(steps)) {
        work.push_back(stride.work);
        step.push_back(stride.length);
    }
    // Longer than the last of them by far, it is the reference alone that leads away; shorter by
    // far, they end, however long they became before.
    if (std::max(beyond->length, step.back()) > kSurely * std::min(beyond->length, step.back()))
        return false;
    work.push_back(beyond->work);
    step.push_back(beyond->length);
    if (std::ranges::min(step) <= steps.least) return false;
    return -*log_slope(work, step) < kNoOrder;
}

// Of rows beyond the reference nothing is known: those of less work alone.
Steps before_reference(const Knob& knob, Steps steps) {
    if (!knob.reference.work || *knob.reference.work <= 0.0) return steps;
    const double work = knob.more_is_better ? *knob.reference.work : 1.0 / *knob.reference.work;
    while (!steps.work.empty() && steps.work.back() > work) {
        steps.work.pop_back();
        steps.rows.pop_back();
        if (steps.to_next.size() > steps.work.size()) steps.to_next.pop_back();
    }
    return steps;
}

// Whether the last row is nearer than the one before, to a reference that is off by far less: those
// before may have been near by chance. All errors are of these works.
bool come_nearer(const Study& study, std::span<const double> work, std::span<const double> errors) {
    const std::size_t last = errors.size() - 1;
    if (last == 0 || !study.has_own_error()) return false;
    return errors[last] > kNearFactor * study.reference_error->rmse &&
           std::log(errors[last - 1] / errors[last]) >
               kNoOrder * std::log(work[last] / work[last - 1]);
}

// More work that brings no row nearer to the reference, and the reference no nearer to its second,
// goes nowhere.
void find_convergence(Study& study, const Knob& knob, const Steps& all) {
    const Steps steps = before_reference(knob, all);
    std::vector<double> errors;
    for (const StudyRow* row : steps.rows) errors.push_back(std::max(row->error->rmse, 1e-12));
    study.converges = !goes_on(study, knob, steps);
    if (!study.converges) {
        study.findings.push_back(fmt::format(
            "it does not converge: {} is {} from its second, and the rows are as far from each "
            "other, however much work they do",
            study.reference, three_digits(study.reference_error->rmse)));
        return;
    }
    const auto slope = log_slope(steps.work, errors);
    const double typical = median_of(errors);
    if (errors.size() < 3 || steps.work.back() < kWideWork * steps.work.front() || !slope ||
        typical <= rounding(study, knob) || -*slope > kNoOrder)
        return;
    // One that has grown may be on its way down, as terms of a series are.
    if (errors.back() < kNoNearer * std::ranges::max(errors)) return;
    if (come_nearer(study, steps.work, errors)) return;
    const double apart = study.has_own_error() ? study.reference_error->rmse : 0.0;
    study.converges = apart < kNoNearer * typical && -*slope > kGrowingOrder;
    if (study.converges) return;
    study.findings.push_back(
        -*slope <= kGrowingOrder
            ? fmt::format("it does not converge: the error grows with the work, by order {:.2f}",
                          -*slope)
            : fmt::format("it does not converge: more work brings no row nearer, and the reference "
                          "is {} from its second",
                          three_digits(apart)));
}

std::string not_finite_in(std::size_t pixels) {
    return fmt::format("is not finite in {} pixels", pixels);
}

// Of a picture that is no number nothing is the truth, however few of its pixels are not.
void find_broken_reference(Study& study) {
    study.converges = false;
    study.findings.push_back(fmt::format(
        "the reference, {}, {}: no error can be told by it; name another with --reference",
        study.broken_view.empty() ? study.reference : study.reference + " in " + study.broken_view,
        study.reference_not_finite > 0 ? not_finite_in(study.reference_not_finite)
                                       : "is " + loops_cut(study.reference_cut)));
}

void find_broken_second(Study& study) {
    if (study.has_own_error() || !study.reference_error) return;
    study.findings.push_back(fmt::format(
        "the second reference, {}, {}: the reference's own error is not known; name another with "
        "--second",
        study.second,
        study.second_cut.empty() ? not_finite_in(study.reference_error->not_finite)
                                 : "is " + loops_cut(study.second_cut)));
}

// What the reference claims, and whether another way to the truth bears it out.
void compare_references(Study& study, const Knob& knob) {
    if (!study.rival) return;
    RivalReference& rival = *study.rival;
    if (rival.difference.not_finite > 0 || !rival.cut.empty()) {
        study.findings.push_back(
            fmt::format("the reference {} {}, so that nothing bears {} out", rival.value,
                        rival.cut.empty() ? not_finite_in(rival.difference.not_finite)
                                          : "is " + loops_cut(rival.cut),
                        knob.reference.text));
        return;
    }
    const double claimed = study.own_error + rival.own_error;
    const bool is_claimed = study.has_own_error();
    const double least = is_claimed ? least_rmse(study) : kUnclaimed;
    rival.disagrees = rival.difference.rmse > std::max(kClaim * claimed, least);
    if (!rival.disagrees) return;
    const std::string claims =
        is_claimed ? fmt::format("more than both claim ({} and {})", three_digits(study.own_error),
                                 three_digits(rival.own_error))
                   : "and the own error of neither is known";
    study.findings.push_back(fmt::format("the references {} and {} differ by {}, {}: one is wrong",
                                         knob.reference.text, rival.value,
                                         three_digits(rival.difference.rmse), claims));
}

void find_failed_rows(Study& study) {
    for (const StudyRow& row : study.rows) {
        if (!row.failed.empty()) study.findings.push_back(row.value + ": " + row.failed);
    }
}

void find_what_looks_wrong(Study& study) {
    const bool any = std::ranges::any_of(study.rows, &StudyRow::has_error);
    const bool nothing = std::ranges::none_of(study.rows, [](const StudyRow& row) {
        return !row.failed.empty() || (row.has_error() && row.error->max > 0.0);
    });
    if (any && nothing && study.is_joint)
        study.notes.push_back("each setting that was measured draws the reference's very picture");
    else if (any && nothing)
        study.findings.push_back("it changes nothing in this picture");
    const bool unseen = std::ranges::none_of(study.rows, [](const StudyRow& row) {
        return row.has_error() && (row.error->share_off > 0.0 || row.error->flip > 0.0);
    });
    const auto same = std::ranges::count_if(
        study.rows, [](const StudyRow& row) { return is_same_picture(row) && !row.is_reference; });
    if (!nothing && same > 1)
        study.notes.push_back(
            fmt::format("{} rows draw the reference's very picture: the first of them is "
                        "enough, or the text uses no more",
                        same));
    if (any && !nothing && unseen)
        study.notes.push_back(
            "no display shows any of it: all pixels are as those of the "
            "reference, or as bright as can be");
    const auto near =
        std::ranges::count_if(study.rows, [](const StudyRow& row) { return row.near_reference; });
    if (near > 0) {
        study.notes.push_back(
            fmt::format("{} of {} rows are within ten times of the reference's own error (~)", near,
                        study.rows.size()));
    }
}

// What the rows tell beside a reference that is finite.
void compare_with_reference(Study& study, const Knob& knob) {
    const Steps steps = steps_of(study, knob.more_is_better);
    find_broken_second(study);
    find_convergence(study, knob, steps);
    compare_references(study, knob);
    mark_near_reference(study);
    find_wrong_reference(study, knob, steps);
    find_failed_rows(study);
    find_what_looks_wrong(study);
}

// Nothing, where the reference is no truth: neither an order nor which row is nearer.
void compare_with_none(Study& study) {
    study.order.reset();
    study.own_error = 0.0;
    find_broken_reference(study);
    find_failed_rows(study);
}

}  // namespace

std::string loops_cut(std::string_view pass) {
    return fmt::format(
        "cut short, for loops of {} use all 65,535 turns that llvmpipe has for a pixel and its "
        "neighbours",
        pass);
}

std::string three_digits(double value) {
    return value == 0.0 ? "0" : fmt::format("{:.3g}", value);
}

std::optional<double> log_slope(std::span<const double> x, std::span<const double> y) {
    const auto n = static_cast<double>(x.size());
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += std::log(x[i]) / n;
        mean_y += std::log(y[i]) / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = std::log(x[i]) - mean_x;
        xx += dx * dx;
        xy += dx * (std::log(y[i]) - mean_y);
    }
    if (x.size() < 2 || xx == 0.0) return std::nullopt;
    return xy / xx;
}

double alike(double far, double step, double left) {
    return (far * far - step * step - left * left) / (2.0 * step * left);
}

Fall fall_by_doubling(double step, double last, double far) {
    if (step <= 0.0 || last <= 0.0) return {};
    return {.order = std::min(std::log2(step / last), kMostOrder),
            .one_shape = alike(far, step, last) > kOneShape};
}

double own_error(double rmse, const SecondWork& second, const Fall& fall) {
    switch (second.kind) {
        case SecondWork::Kind::another:
            return rmse;
        case SecondWork::Kind::seed:  // both are off by as much, in ways of their own
            return rmse / std::numbers::sqrt2;
        case SecondWork::Kind::share:
            return rmse * second.ratio;
        case SecondWork::Kind::more:
            break;
    }
    const double p = std::max(fall.order.value_or(1.0), kLeastFall);
    // A mean of random samples, part of which the mean of more has as well: of two independent
    // parts of the larger sum, one is missing.
    if (p < kRandomOrder && !fall.one_shape)
        return rmse / std::sqrt(std::abs(1.0 - 1.0 / second.ratio));
    // An error of order p that has the same shape with more work (Richardson).
    return rmse / std::abs(1.0 - std::pow(second.ratio, -p));
}

void judge(Study& study, const Knob& knob, bool on_software) {
    take_times(study, on_software);
    study.findings.clear();
    study.notes = knob.notes;  // a study over several views is judged again
    const double apart = study.has_own_error() ? study.reference_error->rmse : 0.0;
    // What the order is depends on what can be told from the reference, and that on the order.
    study.order.reset();
    const Steps steps = steps_of(study, knob.more_is_better);
    for (int round = 0; round < 2; ++round) {
        study.own_error = own_error(apart, knob.second_work, fall_of(study, knob, steps));
        fit(study, knob.more_is_better);
    }
    study.own_error = own_error(apart, knob.second_work, fall_of(study, knob, steps));
    if (study.has_truth() && !study.time_only)
        compare_with_reference(study, knob);
    else if (!study.time_only)
        compare_with_none(study);
    tell_verdicts(study, verdicts_of(study, kAlike));
    // By what anybody asks for: a step between what is told and what matters would have its star or
    // not by how long it was timed.
    mark_pareto(study, verdicts_of(study, kEnough));
}

}  // namespace glint
