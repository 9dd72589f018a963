// What the passes panel is told of the passes, buffers and pixels of an open scene.
#pragma once

#include "render/viewer.h"
#include "window/live/playground.h"
#include "window/ui/panels.h"

#include <string>
#include <vector>

namespace glint {

// One output of one pass that is drawn.
struct Output {
    std::size_t graph_index = 0, output = 0;
};

// The output that this sampler reads; the picture when nothing of that name is drawn.
Output find_output(Playground& playground, const std::string& sampler);

// In drawing order, with sizes in pixels and times in milliseconds; none while nothing is open. The
// other functions are for an open scene, and those that read pixels wait for the GPU.
std::vector<PassFact> pass_facts(Playground& playground);

// Exact counts over one output: of all its pixels.
PixelFacts pixel_facts(Playground& playground, const Output& output);

// The pixels of one output that lie in the area, once they are large enough to hold numbers.
std::vector<GridPixel> pixel_grid(Playground& playground, const Output& output,
                                  const BufferView& view, const ScreenArea& area);

// The middle of the screen's pixel that the mouse points to, both from the bottom left. Screens
// count from the top: a whole number of rows is the upper edge of a pixel.
glm::dvec2 middle_of_pixel(glm::dvec2 mouse);

// The values of all buffers at one place, a fraction of the picture; none outside it.
std::vector<PixelValue> pixel_values(Playground& playground, glm::dvec2 at);

}  // namespace glint
