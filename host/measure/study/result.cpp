#include "measure/study/result.h"

#include "base/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr double kNearFactor = 10.0;     // of the reference's own error: rows that are marked
constexpr double kFitFactor = 3.0;       // beyond, the order is off by at most 5 % of an error
constexpr double kLeastRmse = 1e-7;      // below, a difference of two pictures is rounding
constexpr double kTimerAgreement = 0.2;  // of the wall, by which a timer query may be off
constexpr double kBusy = 1.25;           // by which rows may differ in how many processors worked
constexpr double kShared = 2.0;          // ms; a shorter frame is mostly one processor's work
constexpr double kGrowingOrder = -0.1;   // error that grows faster than work^0.1
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

bool timers_agree(const Study& study) {
    return std::ranges::all_of(study.rows, [](const StudyRow& row) {
        return std::abs(row.gpu.median - row.wall.median) <= kTimerAgreement * row.wall.median;
    });
}

// How many processors worked at once, as far as that differs from row to row: where it does, others
// took them away, and the wall tells of them.
bool machine_is_busy(const Study& study) {
    double least = 1e9, most = 0.0;
    for (const StudyRow& row : study.rows) {
        if (row.wall.median < kShared) continue;
        least = std::min(least, row.processor.median / row.wall.median);
        most = std::max(most, row.processor.median / row.wall.median);
    }
    return most > kBusy * least;
}

// Timer queries lie on software renderers.
void choose_clock(Study& study, bool on_software) {
    study.clock = Clock::wall;
    if (on_software && machine_is_busy(study)) study.clock = Clock::processor;
    if (!on_software && timers_agree(study)) study.clock = Clock::gpu;
    for (StudyRow& row : study.rows) {
        row.ms = study.clock == Clock::wall  ? row.wall
                 : study.clock == Clock::gpu ? row.gpu
                                             : row.processor;
    }
}

void mark_near_reference(Study& study) {
    if (!study.reference_error) return;
    for (StudyRow& row : study.rows) {
        row.near_reference = has_error(row) && !row.is_reference &&
                             row.error->rmse < kNearFactor * study.reference_error->rmse;
    }
}

void mark_pareto(Study& study) {
    for (StudyRow& row : study.rows) {
        if (!has_error(row)) continue;
        const double ms = row.ms.median;
        row.pareto = std::ranges::none_of(study.rows, [&](const StudyRow& other) {
            if (!has_error(other)) return false;
            const double other_ms = other.ms.median;
            const bool as_good = other_ms <= ms && other.error->rmse <= row.error->rmse;
            return as_good && (other_ms < ms || other.error->rmse < row.error->rmse);
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
    choose_clock(study, on_software);
    mark_near_reference(study);
    mark_pareto(study);
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
    text += fmt::format("    {:>{}} {:>10} {:>19}", study.knob, widest, "ms", "min to max");
    if (!study.time_only) {
        text += fmt::format(" {:>9} {:>9} {:>6} {:>8} {:>9} {:>9}", "rmse", "max", "psnr",
                            "> 1/255", "rel. mse", "flip");
    }
    text += "\n";
    for (const StudyRow& row : study.rows) {
        const Timing& ms = row.ms;
        text += fmt::format("{} {} {:>{}} {:>10.3f} {:>9.3f} {:>9.3f}", row.pareto ? '*' : ' ',
                            mark(row), row.value, widest, ms.median, ms.min, ms.max);
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
    return "scene,knob,value,ms,ms_min,ms_max,rmse,max,psnr,share_off,relative_mse,flip,pareto,"
           "near_reference,failed,renderer,width,height\n";
}

std::string to_csv(const Study& study) {
    const auto word = [](const std::string& text) { return quoted(text, '"', "\"\""); };
    std::string text;
    for (const StudyRow& row : study.rows) {
        const Timing& ms = row.ms;
        text += fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},", word(study.scene), study.knob,
                            word(row.value), ms.median, ms.min, ms.max);
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
