// How far two pictures differ, as a picture: black, blue, violet, orange, white.
#pragma once

#include "measure/rows/difference.h"

#include <cstddef>
#include <span>
#include <vector>

namespace glint {

// RGB bytes, a pixel each, of RGBA pictures of one size. The largest channel, in light, a step of
// colour a decade from 1/10000 to 1. Not finite: magenta.
std::vector<std::byte> difference_heat(std::span<const float> picture,
                                       std::span<const float> reference, Values values);

// Of one number a pixel, from 0 to 1, in equal steps.
std::vector<std::byte> heat(std::span<const float> map);

}  // namespace glint
