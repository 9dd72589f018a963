#include "window/live/inspect.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

// Smaller pixels have no room for a number.
constexpr double kSmallestPrinted = 24.0;  // screen pixels a side

}  // namespace

Output find_output(Playground& playground, const std::string& sampler) {
    const auto& graph = playground.renderer()->graph().passes;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        const auto names = output_names(playground.preset()->scene, graph[i].pass);
        const auto found = std::find(names.begin(), names.end(), sampler);
        if (found != names.end()) return {i, static_cast<std::size_t>(found - names.begin())};
    }
    return {graph.size() - 1, 0};
}

std::vector<PassFact> pass_facts(Playground& playground) {
    std::vector<PassFact> facts;
    if (!playground.is_open()) return facts;
    const auto& graph = playground.renderer()->graph().passes;
    const auto& times = playground.pass_times();
    const Scene& scene = playground.preset()->scene;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        const bool image = graph[i].pass == kImagePass;
        facts.push_back({.name = pass_name(scene, graph[i].pass),
                         .entry = image ? scene.image_entry : scene.passes[graph[i].pass].entry,
                         .size = playground.renderer()->buffer(i).shape().size,
                         .outputs = output_names(scene, graph[i].pass),
                         .runs = to_string(graph[i].runs),
                         .ms = i < times.size() ? times[i].ms : 0.0,
                         .drawn = i < times.size() && times[i].drawn});
    }
    return facts;
}

PixelFacts pixel_facts(Playground& playground, const Output& output) {
    const auto found =
        statistics(playground.renderer()->read_buffer(output.graph_index, output.output));
    return {found.nan, found.infinite, found.min, found.max, found.histogram};
}

std::vector<GridPixel> pixel_grid(Playground& playground, const Output& output,
                                  const BufferView& view, const ScreenArea& area) {
    const Buffer& buffer = playground.renderer()->buffer(output.graph_index);
    if (view.zoom < kSmallestPrinted || buffer.shape().cube) return {};
    const glm::ivec2 size = buffer.shape().size;
    const glm::dvec2 low =
        Viewer::fraction_at(glm::dvec2(area.origin), size, view, area) * glm::dvec2(size);
    const glm::dvec2 high = low + glm::dvec2(area.size) / view.zoom;
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(low)), glm::ivec2(0));
    const glm::ivec2 last = glm::min(glm::ivec2(glm::ceil(high)), size);
    const std::vector<float> values =
        playground.renderer()->read_buffer(output.graph_index, output.output);
    std::vector<GridPixel> grid;
    for (int y = first.y; y < last.y; ++y) {
        for (int x = first.x; x < last.x; ++x) {
            const float* v = values.data() + (static_cast<std::ptrdiff_t>(y) * size.x + x) * 4;
            const glm::vec4 value(v[0], v[1], v[2], v[3]);
            const glm::dvec2 centre = (glm::dvec2(x, y) + 0.5 - low) * view.zoom;
            grid.push_back({.centre = glm::dvec2(area.origin) + centre,
                            .side = view.zoom,
                            .value = value,
                            .shown = displayed(view, value)});
        }
    }
    return grid;
}

glm::dvec2 middle_of_pixel(glm::dvec2 mouse) {
    return {std::floor(mouse.x) + 0.5, std::ceil(mouse.y) - 0.5};
}

std::vector<PixelValue> pixel_values(Playground& playground, glm::dvec2 at) {
    std::vector<PixelValue> values;
    const Renderer& renderer = *playground.renderer();
    const auto& graph = renderer.graph().passes;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        const BufferShape& shape = renderer.buffer(i).shape();
        const glm::ivec2 pixel(glm::floor(at * glm::dvec2(shape.size)));
        const bool inside =
            pixel.x >= 0 && pixel.y >= 0 && pixel.x < shape.size.x && pixel.y < shape.size.y;
        if (shape.cube || !inside) continue;
        const auto names = output_names(playground.preset()->scene, graph[i].pass);
        for (std::size_t output = 0; output < names.size(); ++output) {
            values.push_back({names[output], pixel, renderer.read_pixel(i, output, pixel)});
        }
    }
    return values;
}

}  // namespace glint
