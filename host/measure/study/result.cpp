#include "measure/study/result.h"

#include "base/words.h"
#include "measure/study/rounds.h"
#include "measure/study/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr double kNearFactor = 10.0;    // of the reference's own error: rows that are marked
constexpr double kFitFactor = 3.0;      // beyond, the order is off by at most 5 % of an error
constexpr double kLeastRmse = 1e-7;     // below, a difference of two pictures is rounding
constexpr double kGrowingOrder = -0.1;  // error that grows faster than work^0.1
// Values that agree with each other so much better than with the reference do not converge to it:
// a method of order 1 that doubles its work still has a distance to go as long as its last step.
constexpr double kPlateau = 0.2;

bool has_error(const StudyRow& row) {
    return row.failed.empty() && row.error.has_value();
}

// Rows that tell how the error falls.
bool counts_for_order(const Study& study, const StudyRow& row) {
    if (!has_error(row) || !row.work || *row.work <= 0.0 || row.is_reference) return false;
    const double floor = study.reference_error ? kFitFactor * study.reference_error->rmse : 0.0;
    return row.error->rmse > std::max(floor, kLeastRmse);
}

Timing timing_of(const std::vector<double>& times) {
    if (times.empty()) return {};
    const auto [least, most] = std::ranges::minmax(times);
    return {.median = median_of(times), .min = least, .max = most};
}

// Each row by each clock, and by the best.
void take_times(Study& study, bool on_software) {
    std::vector<FrameTimes> timed;
    for (const StudyRow& row : study.rows)
        if (!row.times.wall.empty()) timed.push_back(row.times);
    study.clock = best_clock(timed, on_software);
    for (StudyRow& row : study.rows) {
        row.wall = timing_of(row.times.wall);
        row.gpu = timing_of(row.times.gpu);
        row.processor = timing_of(row.times.processor);
        const std::vector<double>& times = times_by(study.clock, row.times);
        const Interval interval = median_interval(times);
        row.ms = timing_of(times);
        row.ms.low = interval.low;
        row.ms.high = interval.high;
    }
}

TimeVerdicts verdicts_of(const Study& study) {
    std::vector<std::vector<double>> times;
    for (const StudyRow& row : study.rows) times.push_back(times_by(study.clock, row.times));
    return TimeVerdicts(times, study.look);
}

void tell_verdicts(Study& study, const TimeVerdicts& verdicts) {
    const auto own = std::ranges::find_if(study.rows, &StudyRow::is_preset);
    const auto than =
        own == study.rows.end() ? 0 : static_cast<std::size_t>(own - study.rows.begin());
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        StudyRow& row = study.rows[i];
        row.verdict.reset();
        if (i != than && !row.times.wall.empty()) row.verdict = verdicts.of(i, than);
    }
}

void mark_near_reference(Study& study) {
    if (!study.reference_error) return;
    for (StudyRow& row : study.rows) {
        row.near_reference = has_error(row) && !row.is_reference &&
                             row.error->rmse < kNearFactor * study.reference_error->rmse;
    }
}

// Whether the errors to the truth are told apart: each may be off by what the reference is.
bool is_nearer(const Study& study, const StudyRow& row, const StudyRow& than) {
    return row.error->rmse + study.reference_rmse() < than.error->rmse - study.reference_rmse();
}

// Rows that can be compared in both, the fastest first.
std::vector<std::size_t> comparable_rows(const Study& study) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        const StudyRow& row = study.rows[i];
        if (has_error(row) && !row.times.wall.empty()) rows.push_back(i);
    }
    std::ranges::stable_sort(rows, {}, [&](std::size_t i) { return study.rows[i].ms.median; });
    return rows;
}

// A row stands when each row with less error is told to be slower, and when it is told to be nearer
// than each faster row that stands.
void mark_pareto(Study& study, const TimeVerdicts& verdicts) {
    for (StudyRow& row : study.rows) row.pareto = false;
    const std::vector<std::size_t> rows = comparable_rows(study);
    for (const std::size_t i : rows) {
        StudyRow& row = study.rows[i];
        row.pareto = std::ranges::none_of(rows, [&](std::size_t k) {
            const StudyRow& other = study.rows[k];
            const bool less = other.error->rmse < row.error->rmse;
            if (less) return verdicts.of(k, i) != TimeVerdict::slower;
            return other.pareto && verdicts.of(k, i) == TimeVerdict::faster &&
                   !is_nearer(study, row, other);
        });
    }
}

void fit(Study& study, bool more_is_better) {
    std::vector<double> work, error;
    std::vector<std::pair<double, double>> cost;
    for (const StudyRow& row : study.rows) {
        if (counts_for_order(study, row)) {
            work.push_back(*row.work);
            error.push_back(row.error->rmse);
        }
        if (row.work && *row.work > 0.0 && row.ms.median > 0.0) {
            cost.emplace_back(*row.work, row.ms.median);
        }
    }
    const auto slope = log_slope(work, error);
    if (slope) study.order = more_is_better ? -*slope : *slope;
    // Small sizes cost what a frame costs at all, so the larger half tells how the cost grows.
    std::ranges::sort(cost);
    std::vector<double> size, ms;
    for (std::size_t i = cost.size() / 2; i < cost.size(); ++i) {
        size.push_back(cost[i].first);
        ms.push_back(cost[i].second);
    }
    study.cost_exponent = log_slope(size, ms);
}

// The two rows that should agree best: those nearest to the reference.
void find_plateau(Study& study, bool more_is_better) {
    std::vector<const StudyRow*> rows;
    for (const StudyRow& row : study.rows) {
        const bool compares = row.work && !row.is_reference && !row.is_between;
        if (has_error(row) && compares) rows.push_back(&row);
    }
    if (rows.size() < 2) return;
    const StudyRow& best = more_is_better ? *rows.back() : *rows.front();
    const StudyRow& before = more_is_better ? *rows[rows.size() - 2] : *rows[1];
    const StudyRow& later = more_is_better ? best : before;  // in the order of the list
    if (!later.rmse_to_previous || best.error->rmse <= kLeastRmse || best.near_reference) return;
    if (*later.rmse_to_previous >= kPlateau * best.error->rmse) return;
    study.findings.push_back(
        fmt::format("{} and {} agree with each other to {}, and with the reference only to {}: the "
                    "reference is wrong, or another picture",
                    before.value, best.value, three_digits(*later.rmse_to_previous),
                    three_digits(best.error->rmse)));
}

void find_what_looks_wrong(Study& study, bool more_is_better) {
    const auto compared = static_cast<std::size_t>(std::ranges::count_if(
        study.rows, [&](const StudyRow& row) { return counts_for_order(study, row); }));
    if (study.order && compared >= 3 && *study.order < kGrowingOrder) {
        study.findings.push_back(
            fmt::format("the error grows with the work, by order {:.2f}", *study.order));
    }
    find_plateau(study, more_is_better);
    for (const StudyRow& row : study.rows) {
        if (!row.failed.empty()) study.findings.push_back(row.value + ": " + row.failed);
    }
    const bool any = std::ranges::any_of(study.rows, has_error);
    const bool nothing = std::ranges::none_of(
        study.rows, [](const StudyRow& row) { return has_error(row) && row.error->max > 0.0; });
    if (any && nothing) study.findings.push_back("it changes nothing in this picture");
    const auto near =
        std::ranges::count_if(study.rows, [](const StudyRow& row) { return row.near_reference; });
    if (near > 0) {
        study.notes.push_back(
            fmt::format("{} of {} rows are within ten times of the reference's own error (~)", near,
                        study.rows.size()));
    }
}

std::string psnr_text(double psnr) {
    return std::isinf(psnr) ? "inf" : fmt::format("{:.1f}", psnr);
}

// One character that tells how to take a row.
char mark(const StudyRow& row) {
    if (!row.failed.empty()) return '!';
    if (row.is_reference) return '=';
    return row.near_reference ? '~' : ' ';
}

}  // namespace

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

void judge(Study& study, bool more_is_better, bool on_software) {
    take_times(study, on_software);
    const TimeVerdicts verdicts = verdicts_of(study);
    tell_verdicts(study, verdicts);
    mark_near_reference(study);
    mark_pareto(study, verdicts);
    fit(study, more_is_better);
    if (!study.time_only) find_what_looks_wrong(study, more_is_better);
}

std::string to_table(const Study& study) {
    std::size_t widest = study.knob.size();
    for (const StudyRow& row : study.rows) widest = std::max(widest, row.value.size());
    std::string text =
        fmt::format("{}  {}  {}x{}  {}\nclock: {}\n", study.scene, study.knob, study.size.x,
                    study.size.y, study.renderer, to_string(study.clock));
    if (!study.time_only) {
        text += fmt::format(
            "reference {}; its own error {}\n", study.reference,
            study.reference_error
                ? fmt::format("{} by {}", three_digits(study.reference_error->rmse), study.second)
                : "is not known: name another method with --second");
    }
    text += fmt::format("    {:>{}} {:>10} {:>19} {:>14}", study.knob, widest, "ms",
                        "95 of 100 within", "time");
    if (!study.time_only) {
        text += fmt::format(" {:>9} {:>9} {:>6} {:>8} {:>9} {:>9}", "rmse", "max", "psnr",
                            "> 1/255", "rel. mse", "flip");
    }
    text += "\n";
    for (const StudyRow& row : study.rows) {
        const Timing& ms = row.ms;
        text += fmt::format("{} {} {:>{}} {:>10.3f} {:>9.3f} {:>9.3f} {:>14}",
                            row.pareto ? '*' : ' ', mark(row), row.value, widest, ms.median, ms.low,
                            ms.high, row.verdict ? to_string(*row.verdict) : "");
        if (!row.failed.empty()) text += " " + row.failed;
        if (has_error(row)) {
            text +=
                fmt::format(" {:>9.3g} {:>9.3g} {:>6} {:>6.2f} % {:>9.3g} {:>9.3g}",
                            row.error->rmse, row.error->max, psnr_text(row.error->psnr),
                            100.0 * row.error->share_off, row.error->relative_mse, row.error->flip);
        }
        text += "\n";
    }
    if (study.order) text += fmt::format("order {:.2f} (error ~ work^-order)\n", *study.order);
    if (study.cost_exponent) {
        text += fmt::format("time ~ {}^{:.2f} over the larger half\n", study.knob,
                            *study.cost_exponent);
    }
    for (const std::string& finding : study.findings) text += "finding: " + finding + "\n";
    for (const std::string& note : study.notes) text += "note: " + note + "\n";
    return text;
}

std::string csv_header() {
    return "scene,knob,value,ms,ms_min,ms_max,ms_low,ms_high,verdict,rmse,max,psnr,share_off,"
           "relative_mse,flip,pareto,"
           "near_reference,failed,renderer,width,height\n";
}

std::string to_csv(const Study& study) {
    const auto word = [](const std::string& text) { return quoted(text, '"', "\"\""); };
    std::string text;
    for (const StudyRow& row : study.rows) {
        const Timing& ms = row.ms;
        text += fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},", word(study.scene),
                            study.knob, word(row.value), ms.median, ms.min, ms.max, ms.low, ms.high,
                            row.verdict ? to_string(*row.verdict) : "");
        if (has_error(row)) {
            text += fmt::format("{:.6g},{:.6g},{},{:.6g},{:.6g},{:.6g}", row.error->rmse,
                                row.error->max, psnr_text(row.error->psnr), row.error->share_off,
                                row.error->relative_mse, row.error->flip);
        } else {
            text += ",,,,,";
        }
        text += fmt::format(",{},{},{},{},{},{}\n", row.pareto, row.near_reference,
                            word(row.failed), word(study.renderer), study.size.x, study.size.y);
    }
    return text;
}

}  // namespace glint
