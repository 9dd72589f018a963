#include "measure/study/plot.h"

#include "measure/study/gnuplot.h"
#include "measure/study/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <vector>

namespace glint {
namespace {

bool can_be_shown(const Study& study, const StudyRow& row) {
    if (row.ms.median <= 0.0) return false;
    if (study.time_only) return row.work && *row.work > 0.0;
    return row.failed.empty() && row.error && row.error->rmse > 0.0;
}

// x, y, and the ends of the time.
std::string data_block(const Study& study, const char* name, bool only_pareto) {
    std::vector<const StudyRow*> rows;
    for (const StudyRow& row : study.rows) {
        if (can_be_shown(study, row) && (!only_pareto || row.pareto)) rows.push_back(&row);
    }
    if (only_pareto) {
        std::ranges::sort(
            rows, [](const StudyRow* a, const StudyRow* b) { return a->ms.median < b->ms.median; });
    }
    std::string text = fmt::format("${} << END\n", name);
    for (const StudyRow* row : rows) {
        const Timing& ms = row->ms;
        if (study.time_only) {
            text += fmt::format("{} {} {} {}\n", *row->work, ms.median, ms.low, ms.high);
        } else {
            text += fmt::format("{} {} {} {}\n", ms.median, row->error->rmse, ms.low, ms.high);
        }
    }
    return text + "END\n";
}

// Both ends of an axis, with room round what is shown.
struct Span {
    double low, high;
    void widen(double factor) { low /= factor, high *= factor; }
};

Span span_of(const Study& study, bool of_time) {
    Span span{1e300, 0.0};
    const auto include = [&](double v) {
        span.low = std::min(span.low, v);
        span.high = std::max(span.high, v);
    };
    for (const StudyRow& row : study.rows) {
        if (!can_be_shown(study, row)) continue;
        if (of_time) {
            include(row.ms.low);
            include(row.ms.high);
        } else {
            include(study.time_only ? *row.work : row.error->rmse);
        }
    }
    if (!of_time && study.reference_rmse() > 0.0) include(study.reference_rmse());
    return span;
}

// Tics at round numbers, few enough to be read; gnuplot's own stand at decades alone.
std::string tics(const Span& span) {
    const double decades = std::log10(span.high / span.low);
    const std::vector<double> digits =
        decades > 4.0   ? std::vector<double>{1}
        : decades > 1.0 ? std::vector<double>{1, 2, 5}
        : decades > 0.5
            ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 7}
            : std::vector<double>{1, 1.2, 1.5, 1.7, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7, 8, 9};
    std::string text;
    const int first = static_cast<int>(std::floor(std::log10(span.low)));
    const int last = static_cast<int>(std::floor(std::log10(span.high)));
    for (int decade = first; decade <= last; ++decade) {
        for (const double digit : digits) {
            const double v = digit * std::pow(10.0, decade);
            if (v < span.low || v > span.high) continue;
            text += fmt::format("{}'{:.4g}' {}", text.empty() ? "" : ", ", v, v);
        }
    }
    return "(" + text + ")";
}

std::string axis(const char* name, Span span) {
    return fmt::format("set {0}range [{1}:{2}]\nset {0}tics {3}\n", name, span.low, span.high,
                       tics(span));
}

// Where the diagram stands in its picture, so that texts can be placed by the pixel.
constexpr glm::dvec2 kPicture{760.0, 440.0};
constexpr Box kArea{{92.0, 66.0}, {736.0, 400.0}};

constexpr const char* kLook = R"(set logscale xy
set key at screen 0.97,0.97 right top horizontal
set bars small
)";

const char* clock_words(const Study& study) {
    switch (study.clock) {
        case Clock::wall:
            return "";
        case Clock::gpu:
            return ", by timer queries";
        case Clock::processor:
            return " of the processor, all threads";
    }
    return "";
}

// What a point is called: its value; of a joint setting what differs from the preset's own.
std::string label_of(const Study& study, const StudyRow& row) {
    if (!study.is_joint) return row.value;
    if (row.is_preset) return "the preset's own";
    const auto own = std::ranges::find_if(study.rows, &StudyRow::is_preset);
    if (own == study.rows.end()) return row.value;
    std::istringstream mine(row.value), theirs(own->value);
    std::string text, a, b;
    while (mine >> a && theirs >> b)
        if (a != b) text += (text.empty() ? "" : " ") + a;
    return text;
}

// Names of the points, those of the frontier and of the preset first; of joint settings, which have
// long names, of these alone.
std::string labels(const Study& study, const Span& x, const Span& y) {
    const auto place = [](double v, const Span& span, double low, double high) {
        return std::lerp(low, high, std::log(v / span.low) / std::log(span.high / span.low));
    };
    const auto across = [&](double ms) { return place(ms, x, kArea.low.x, kArea.high.x); };
    std::vector<LabelledPoint> points;
    for (const bool first : {true, false}) {
        for (const StudyRow& row : study.rows) {
            if (!can_be_shown(study, row) || (row.pareto || row.is_preset) != first) continue;
            const double up = place(row.error->rmse, y, kArea.low.y, kArea.high.y);
            points.push_back({.at = {across(row.ms.median), up},
                              .low = across(row.ms.low),
                              .high = across(row.ms.high),
                              .text = first || !study.is_joint ? label_of(study, row) : ""});
        }
    }
    std::string text;
    for (const PlacedLine& line : place_labels(points, kArea)) {
        text += fmt::format(
            "set label {} at screen {:.5f},{:.5f} left front tc rgb '#1f5fa8' noenhanced\n",
            gnuplot_word(line.text), line.at.x / kPicture.x, line.at.y / kPicture.y);
    }
    return text;
}

std::string script(const Study& study) {
    // Names of its parts, so that several diagrams can stand in one page. Of others than these
    // characters gnuplot takes none.
    std::string name =
        fmt::format("{}_{}", std::filesystem::path(study.scene).stem().string(), study.knob);
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    std::string text = fmt::format(
        "set terminal svg size {},{} dynamic font 'sans-serif,13' name {} background '#ffffff'\n",
        kPicture.x, kPicture.y, gnuplot_word(name));
    const Box share{kArea.low / kPicture, kArea.high / kPicture};
    text += fmt::format(
        "set margins at screen {:.5f}, at screen {:.5f}, at screen {:.5f}, at screen {:.5f}\n",
        share.low.x, share.high.x, share.low.y, share.high.y);
    text += kGnuplotStyle;
    text += kLook + data_block(study, "rows", false);
    Span x = span_of(study, !study.time_only), y = span_of(study, study.time_only);
    x.widen(study.time_only ? 1.3 : 1.25);
    y.widen(study.time_only ? 1.3 : 2.0);
    text += axis("x", x) + axis("y", y);
    if (study.time_only) {
        text += fmt::format("set xlabel {} noenhanced\nset ylabel 'ms a frame'\n",
                            gnuplot_word(study.knob));
        return text +
               "plot $rows using 1:2:3:4 with yerrorlines lw 2 pt 7 ps 0.6 lc rgb '#1f5fa8' "
               "notitle\n";
    }
    text += data_block(study, "pareto", true) + labels(study, x, y);
    text += fmt::format("set xlabel 'ms{}'\nset ylabel 'RMSE{}'\nplot ", clock_words(study),
                        study.pass == "image" ? " in linear light" : "");
    if (study.reference_rmse() > 0.0) {
        text += fmt::format(
            "{} with lines dt 2 lw 1.5 lc rgb '#a04040' title 'error of the reference', ",
            study.reference_rmse());
    }
    // The order of joint settings means nothing.
    if (!study.is_joint) text += "$rows using 1:2 with lines lw 0.7 lc rgb '#9ab8d8' notitle, ";
    return text +
           "$pareto using 1:2 with lines lw 5 lc rgb '#f0c060' title 'Pareto frontier', "
           "$rows using 1:2:3:4 with xerrorbars lw 1.5 pt 7 ps 0.6 lc rgb '#1f5fa8' notitle\n";
}

}  // namespace

std::string svg_plot(const Study& study) {
    const auto shown = std::ranges::count_if(
        study.rows, [&](const StudyRow& r) { return can_be_shown(study, r); });
    return shown < 2 ? "" : gnuplot_svg(script(study));
}

}  // namespace glint
