// Diagrams by gnuplot.
#pragma once

#include <string>

namespace glint {

// A word as gnuplot reads it.
std::string gnuplot_word(const std::string& word);

// The <svg> element that these commands draw, behind `set terminal svg`; "" where there is no
// gnuplot, or it draws none.
std::string gnuplot_svg(const std::string& commands);

}  // namespace glint
