// Diagrams by gnuplot.
#pragma once

#include <string>

namespace glint {

// How our diagrams look: a faint grid, grey axes.
inline constexpr const char* kGnuplotStyle = R"(set encoding utf8
set grid xtics ytics lt 1 lc rgb '#dddddd'
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
)";

// A word as gnuplot reads it.
std::string gnuplot_word(const std::string& word);

// The <svg> element that these commands draw, behind `set terminal svg`; "" where there is no
// gnuplot, or it draws none.
std::string gnuplot_svg(const std::string& commands);

}  // namespace glint
