// What the rows of a study say together, and how it is told to people and to spreadsheets.
#pragma once

#include "measure/rows/study.h"
#include "measure/study/plan.h"

#include <optional>
#include <span>
#include <string>

namespace glint {

// Of the size of their values: below, a difference of two pictures is rounding.
constexpr double kLeastRmse = 1e-7;

// Chooses the clock and fills in what is judged from all rows together, which are those of this
// knob. Timer queries of a renderer `on_software` lie.
void judge(Study& study, const Knob& knob, bool on_software);

// How errors fall with the work.
struct Fall {
    std::optional<double> order{};  // error ~ work^-order, where that is known
    // Errors have one shape, so that a step less and what is left add up; those of random samples
    // that more work goes on with have nothing in common, and their squares add up.
    bool one_shape = false;
};

// By three pictures, each of twice the work of the one before: how far (RMSE) the second is from
// the first, the third from the second, and the third from the first.
Fall fall_by_doubling(double step, double last, double far);

// How far a reference is from the truth, that differs by `rmse` from a second one.
double own_error(double rmse, const SecondWork& second, const Fall& fall);

// The cosine between the step from a picture to a nearer one and what is left, by three RMSE: of
// the first to the truth, of the step, and of what is left. All above 0.
double alike(double far, double step, double left);
constexpr double kOneShape = 0.5;  // above, errors count as of one shape

// Slope of log y over log x by least squares; nothing for fewer than two points. Both are positive
// and of one length.
std::optional<double> log_slope(std::span<const double> x, std::span<const double> y);

// What the reference is off by, or why that is not known: "0.001 by 8192".
std::string own_error_text(const Study& study);

// One character that tells how to take a row: '!' means nothing, '=' is the reference, '~' is near
// it, and ' ' any other.
char mark_of(const Study& study, const StudyRow& row);

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
