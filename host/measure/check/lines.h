// Rows and columns of a picture as single values: what stands out as a whole line.
#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <vector>

namespace glint {

// As a screen shows it, 0 to 1.
double shown(float value);

// How far the value in the middle is from both beside it, where it lies beyond them; else 0.
double beyond(double before, double value, double after);

// Of each line the means of red, green and blue as shown.
using LineMeans = std::array<std::vector<double>, 3>;

// Of each column (axis 0) or row (axis 1) of an RGBA picture.
LineMeans means_of_lines(const std::vector<float>& picture, glm::ivec2 size, int axis);

// Of the channel in which it is the most, each of these:
// How far the line that stands out most is from those beside it, in the mean and by its pixels.
// None at the border counts.
double lone_line(const std::vector<float>& picture, glm::ivec2 size, int axis);

// The same at the border: by how much the last step, on either side, is larger than the one before.
double lone_border(const LineMeans& means);

// The largest step from a line to the next.
double largest_step(const LineMeans& means);

}  // namespace glint
