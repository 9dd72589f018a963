// How far two pictures differ for a person who looks at one and then at the other in its place.
//
// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020. HDR-FLIP: Andersson, Nilsson, Shirley,
// Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021.
// What differs is blurred as the eye does at a distance, in three channels (contrast sensitivity);
// colours are compared as people compare large differences, and where edges or points come or go
// the difference counts for more.
#pragma once

#include "measure/rows/difference.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace glint {

// Pixels in a degree of the field of view, of a screen `width` metres wide that has `pixels` across
// and is seen from `distance` metres.
double pixels_per_degree(double distance, double width, double pixels);

struct FlipOptions {
    // Those of a display are clamped to 0..1 (LDR-FLIP). All others count as light (HDR-FLIP): what
    // is below 0 counts as 0.
    Values values = Values::display;
    double pixels_per_degree = 67.02;  // 0.7 m before a screen of 0.7 m and 3840 pixels
};

// One number a pixel, rows as they came: 0 where no difference is seen, 1 at the most. RGBA
// pictures of the same size; alpha means nothing. A pixel that is not finite in either picture is
// 1, and black for its neighbours. LDR-FLIP is symmetric; HDR-FLIP takes its exposures from
// `reference`.
std::vector<float> flip_map(std::span<const float> picture, std::span<const float> reference,
                            glm::ivec2 size, const FlipOptions& options = {});

// The mean of a map, which the papers report as the error of a picture; 0 of an empty one.
double mean(std::span<const float> map);
// The same without the pixels where this reference is not finite, for which no picture can help it.
double mean_where_finite(std::span<const float> map, std::span<const float> reference);

// At which exposures, in stops, HDR-FLIP looks at a picture: from the one that shows its brightest
// pixel, tone mapped, at 0.85, to the one that shows the median luminance so; as many as there are
// stops between, rounded up, and two at least.
std::vector<double> flip_exposures(std::span<const float> reference);

}  // namespace glint
