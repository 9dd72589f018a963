// A study as a table for people, and as CSV.
#include "base/words.h"
#include "measure/study/result.h"

#include <fmt/format.h>

#include <cmath>

namespace glint {
namespace {

std::string psnr_text(double psnr) {
    return std::isinf(psnr) ? "inf" : fmt::format("{:.1f}", psnr);
}

}  // namespace

char mark_of(const Study& study, const StudyRow& row) {
    if (!row.failed.empty() || !study.converges) return '!';
    if (row.is_reference) return '=';
    return row.near_reference ? '~' : ' ';
}

std::string own_error_text(const Study& study) {
    if (study.reference_not_finite > 0)
        return fmt::format("is not known: {} of its pixels are not finite",
                           study.reference_not_finite);
    for (const std::string& cut : {study.reference_cut, study.second_cut})
        if (!cut.empty()) return "is not known: it is " + loops_cut(cut);
    if (!study.reference_error) return "is not known: name another method with --second";
    if (!study.has_own_error())
        return fmt::format("is not known: {} pixels of {} are not finite",
                           study.reference_error->not_finite, study.second);
    return fmt::format("{} by {}", three_digits(study.own_error), study.second);
}

std::string to_table(const Study& study) {
    std::size_t widest = study.knob.size();
    for (const StudyRow& row : study.rows) widest = std::max(widest, row.value.size());
    std::string text =
        fmt::format("{}  {}  {}x{}  {}\nclock: {}\n", study.scene, study.knob, study.size.x,
                    study.size.y, study.renderer, to_string(study.clock));
    if (!study.time_only) {
        text +=
            fmt::format("reference {}; its own error {}\n", study.reference, own_error_text(study));
        if (study.rival) {
            text += fmt::format("second reference {}; its own error {}; they differ by {}\n",
                                study.rival->value, three_digits(study.rival->own_error),
                                three_digits(study.rival->difference.rmse));
        }
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
                            row.pareto ? '*' : ' ', mark_of(study, row), row.value, widest,
                            ms.median, ms.low, ms.high, row.verdict ? to_string(*row.verdict) : "");
        if (!row.failed.empty()) text += " " + row.failed;
        if (row.has_error()) {
            text +=
                fmt::format(" {:>9.3g} {:>9.3g} {:>6} {:>6.2f} % {:>9.3g} {:>9.3g}",
                            row.error->rmse, row.error->max, psnr_text(row.error->psnr),
                            100.0 * row.error->share_off, row.error->relative_mse, row.error->flip);
        }
        if (row.worst)
            text += fmt::format("  worst {} in {}", three_digits(row.worst->rmse), row.worst->view);
        text += "\n";
    }
    if (const auto order = study.told_order())
        text += fmt::format("order {:.2f} (error ~ work^-order)\n", *order);
    if (study.cost_exponent) {
        text += fmt::format("time ~ {}^{:.2f} over the larger half\n", study.knob,
                            *study.cost_exponent);
    }
    if (study.best) {
        const StudyRow& best = study.rows[*study.best];
        text += fmt::format("best: {}  {:.3f} ms, RMSE {}, FLIP {}\n", best.value, best.ms.median,
                            three_digits(best.error->rmse), three_digits(best.error->flip));
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
        if (row.has_error()) {
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
