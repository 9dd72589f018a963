// What the rows of a study say together, and how it is told to people and to spreadsheets.
#pragma once

#include "measure/rows/study.h"
#include "measure/study/plan.h"

#include <optional>
#include <span>
#include <string>

namespace glint {

constexpr double kLeastRmse = 1e-7;  // below, a difference of two pictures is rounding

// Chooses the clock and fills in what is judged from all rows together, which are those of this
// knob. Timer queries of a renderer `on_software` lie.
void judge(Study& study, const Knob& knob, bool on_software);

// How far a reference is from the truth, that differs by `rmse` from a second one; `order` is that
// of the error over the work, where it is known.
double own_error(double rmse, const SecondWork& second, const std::optional<double>& order);

// Slope of log y over log x by least squares; nothing for fewer than two points. Both are positive
// and of one length.
std::optional<double> log_slope(std::span<const double> x, std::span<const double> y);

// What the reference is off by, or why that is not known: "0.001 by 8192".
std::string own_error_text(const Study& study);

// What was judged, as aligned lines that end with findings and notes; for a terminal.
std::string to_table(const Study& study);
// Lines of comma-separated values: the names, and a line a row.
std::string csv_header();
std::string to_csv(const Study& study);

// A number as tables and pages write it: "0.0123".
// Of a picture whose loops a driver ended early in this pass.
std::string loops_cut(std::string_view pass);

std::string three_digits(double value);

}  // namespace glint
