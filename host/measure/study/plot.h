// A study's work-precision diagram, drawn by gnuplot.
#pragma once

#include "measure/rows/study.h"

namespace glint {

// An <svg> element to stand in a page; "" without gnuplot or without two points to show.
std::string svg_plot(const Study& study);

}  // namespace glint
