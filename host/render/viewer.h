// Shows a buffer on the screen: the picture as it is, or any output of any pass as a person who
// looks for a fault wants it.
#pragma once

#include "gl/objects.h"
#include "render/buffer.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace glint {

enum class ViewChannel { rgb, red, green, blue, alpha };

struct BufferView {
    std::size_t output = 0;
    ViewChannel channel = ViewChannel::rgb;
    float exposure = 0.0f;         // stops: values times 2^exposure
    bool tone_curve = false;       // x / (1 + x), for values beyond 1
    bool mark_not_finite = false;  // NaN and Inf in magenta
    glm::dvec2 centre{0.5};        // the fraction of the buffer in the middle of the view
    double zoom = 0.0;             // screen pixels a buffer pixel; 0 fills the view
    // True when the buffer is shown unchanged, which is a plain copy.
    bool is_plain() const {
        return channel == ViewChannel::rgb && exposure == 0.0f && !tone_curve && !mark_not_finite &&
               zoom == 0.0;
    }
};

// Of one output of a buffer; exact. A channel with nothing finite has its min above its max.
struct ValueRange {
    std::size_t nan = 0, infinite = 0;  // pixels with at least one such channel
    glm::vec4 min{0.0f}, max{0.0f};     // of the finite values
};
ValueRange value_range(std::span<const float> rgba);

struct BufferStatistics : ValueRange {
    std::array<std::array<int, 64>, 4> histogram{};  // by channel, from min to max
};
BufferStatistics statistics(std::span<const float> rgba);

// A place on the screen, in pixels from the bottom left.
struct ScreenArea {
    glm::ivec2 origin{0}, size{0};
};

// The colour, 0 to 1, in which a view shows a value of the buffer.
glm::vec4 displayed(const BufferView& view, const glm::vec4& value);

class Viewer {
public:
    Viewer();

    // Draws into framebuffer 0. The buffer keeps its shape, to one of its pixels; what is left of
    // the area is dark.
    void show(const Buffer& buffer, const BufferView& view, const ScreenArea& area);

    // The pixel of the buffer under a point of the screen (pixels, y up), as a fraction; outside 0
    // to 1 beside the picture.
    static glm::dvec2 fraction_at(glm::dvec2 point, glm::ivec2 buffer_size, const BufferView& view,
                                  const ScreenArea& area);

    // Where that draws the whole of a buffer, to the pixel of the screen.
    static ScreenArea area_of(glm::ivec2 buffer_size, const BufferView& view,
                              const ScreenArea& area);

private:
    struct Placed;
    static Placed place(glm::ivec2 buffer_size, const BufferView& view, const ScreenArea& area);
    void copy(const Buffer& buffer, const ScreenArea& to) const;
    void draw(const Buffer& buffer, const BufferView& view, const ScreenArea& area);

    VertexArray vertex_array_;
    SamplerObject nearest_, linear_;
    Program program_;  // once a view is not plain
};

}  // namespace glint
