#include "measure/check/curves.h"

#include "measure/study/gnuplot.h"

#include <fmt/format.h>

namespace glint {
namespace {

constexpr const char* kLook = R"(set offsets graph 0, graph 0, graph 0.08, graph 0.08
set lmargin 10
set xlabel 'frame'
)";

std::string points_of(const InvariantCurve& curve) {
    std::string text = "$points << END\n";
    for (const InvariantCurve::Point& p : curve.points)
        text += fmt::format("{} {} {} {}\n", p.frame, p.low, p.high, p.drift);
    return text + "END\n";
}

std::string dashed(double value) {
    return fmt::format(", {} with lines dt 2 lw 1.5 lc rgb '#a04040' notitle", value);
}

std::string range_plot(const InvariantCurve& curve) {
    std::string text = fmt::format(
        "set ylabel {} noenhanced\nplot $points using 1:2:3 with filledcurves fc rgb '#9ab8d8' "
        "notitle, $points using 1:2 with lines lc rgb '#1f5fa8' notitle, $points using 1:3 with "
        "lines lc rgb '#1f5fa8' notitle",
        gnuplot_word(curve.buffer));
    if (curve.bounded) text += dashed((*curve.bounded)[0]) + dashed((*curve.bounded)[1]);
    return text + "\n";
}

std::string drift_plot(const InvariantCurve& curve) {
    return fmt::format(
               "set ylabel {} noenhanced\nplot $points using 1:4 with lines lw 1.5 lc rgb "
               "'#1f5fa8' notitle",
               gnuplot_word("sum of " + curve.buffer + " off by")) +
           dashed(*curve.conserves) + "\n";
}

}  // namespace

std::string svg_curves(std::span<const InvariantCurve> curves) {
    std::string plots;
    int count = 0;
    for (const InvariantCurve& curve : curves) {
        if (curve.points.size() < 2) continue;
        plots += points_of(curve) + range_plot(curve);
        if (curve.conserves) plots += drift_plot(curve);
        count += curve.conserves ? 2 : 1;
    }
    if (count == 0) return {};
    return gnuplot_svg(
        fmt::format("set terminal svg size 760,{} dynamic font 'sans-serif,13' background "
                    "'#ffffff'\n{}{}set multiplot layout {},1\n{}unset multiplot\n",
                    40 + 200 * count, kGnuplotStyle, kLook, count, plots));
}

}  // namespace glint
