#include "window/ui/icons.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <numbers>

namespace glint {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// A pen over the square from (-1, -1), top left, to (1, 1).
struct Pen {
    ImDrawList& list;
    ImVec2 centre;
    float half;
    ImU32 colour;
    float width;

    ImVec2 at(float x, float y) const { return {centre.x + x * half, centre.y + y * half}; }
    void line(float x0, float y0, float x1, float y1) const {
        list.AddLine(at(x0, y0), at(x1, y1), colour, width);
    }
    void path(std::initializer_list<ImVec2> points, bool closed = false) const {
        for (const ImVec2& point : points) list.PathLineTo(at(point.x, point.y));
        list.PathStroke(colour, closed ? ImDrawFlags_Closed : ImDrawFlags_None, width);
    }
    void triangle(ImVec2 a, ImVec2 b, ImVec2 c) const {
        list.AddTriangleFilled(at(a.x, a.y), at(b.x, b.y), at(c.x, c.y), colour);
    }
    void box(float x0, float y0, float x1, float y1, float round = 0.15f) const {
        list.AddRect(at(x0, y0), at(x1, y1), colour, round * half, 0, width);
    }
    void solid(float x0, float y0, float x1, float y1, float round = 0.0f) const {
        list.AddRectFilled(at(x0, y0), at(x1, y1), colour, round * half);
    }
    void dot(float x, float y, float radius) const {
        list.AddCircleFilled(at(x, y), radius * half, colour);
    }
    void ring(float x, float y, float radius) const {
        list.AddCircle(at(x, y), radius * half, colour, 0, width);
    }
    void arc(float x, float y, float radius, float begin, float end) const {
        list.PathArcTo(at(x, y), radius * half, begin, end);
        list.PathStroke(colour, ImDrawFlags_None, width);
    }
};

// An arrow that turns back; `way` is -1 for one to the left, 1 for its mirror image.
void hook(const Pen& pen, float way) {
    const auto path = [&](float begin, float end) {
        pen.list.PathArcTo(pen.at(0.2f * -way, 0.2f), 0.5f * pen.half, begin, end);
    };
    pen.list.PathLineTo(pen.at(0.5f * way, -0.3f));
    if (way < 0)
        path(-0.5f * kPi, 0.5f * kPi);
    else
        path(1.5f * kPi, 0.5f * kPi);
    pen.list.PathLineTo(pen.at(0.3f * way, 0.7f));
    pen.list.PathStroke(pen.colour, ImDrawFlags_None, pen.width);
    pen.triangle({0.95f * way, -0.3f}, {0.3f * way, -0.8f}, {0.3f * way, 0.2f});
}

// Round and back to the start.
void turn(const Pen& pen) {
    pen.arc(0, 0.05f, 0.72f, -0.75f * kPi, 0.9f * kPi);
    pen.triangle({-0.95f, -0.15f}, {-0.85f, -0.85f}, {-0.2f, -0.5f});
}

void lock(const Pen& pen, bool closed) {
    pen.solid(-0.65f, -0.05f, 0.65f, 0.85f, 0.15f);
    if (closed) {
        pen.path({{-0.4f, 0.0f}, {-0.4f, -0.35f}});
        pen.path({{0.4f, 0.0f}, {0.4f, -0.35f}});
    } else {
        pen.path({{-0.4f, 0.0f}, {-0.4f, -0.45f}});
    }
    pen.arc(0, closed ? -0.35f : -0.45f, 0.4f, kPi, closed ? 2 * kPi : 1.8f * kPi);
}

void sliders(const Pen& pen) {
    const float knobs[] = {0.4f, -0.4f, 0.1f};
    for (int row = 0; row < 3; ++row) {
        const float y = -0.65f + 0.65f * static_cast<float>(row);
        pen.line(-0.9f, y, 0.9f, y);
        pen.dot(knobs[row], y, 0.24f);
    }
}

void layers(const Pen& pen) {
    pen.path({{0, -0.85f}, {0.9f, -0.35f}, {0, 0.15f}, {-0.9f, -0.35f}}, true);
    pen.path({{-0.9f, 0.1f}, {0, 0.6f}, {0.9f, 0.1f}});
    pen.path({{-0.9f, 0.5f}, {0, 1.0f}, {0.9f, 0.5f}});
}

void camera(const Pen& pen) {
    pen.box(-0.95f, -0.5f, 0.95f, 0.75f, 0.25f);
    pen.ring(0, 0.12f, 0.36f);
    pen.solid(-0.4f, -0.8f, 0.4f, -0.45f, 0.1f);
}

void grid(const Pen& pen) {
    for (const float x : {-0.85f, 0.15f})
        for (const float y : {-0.85f, 0.15f}) pen.box(x, y, x + 0.7f, y + 0.7f);
}

// Error that falls as the time grows.
void diagram(const Pen& pen) {
    pen.path({{-0.85f, -0.85f}, {-0.85f, 0.85f}, {0.85f, 0.85f}});
    pen.path({{-0.45f, -0.6f}, {-0.1f, 0.1f}, {0.75f, 0.4f}});
    for (const ImVec2 at : {ImVec2{-0.45f, -0.6f}, {-0.1f, 0.1f}, {0.75f, 0.4f}})
        pen.dot(at.x, at.y, 0.17f);
}

void speaker(const Pen& pen, bool sounds) {
    pen.solid(-0.9f, -0.35f, -0.5f, 0.35f, 0.05f);
    pen.triangle({-0.85f, 0.0f}, {0.0f, -0.8f}, {0.0f, 0.8f});
    if (sounds) {
        pen.arc(-0.1f, 0.0f, 0.5f, -0.3f * kPi, 0.3f * kPi);
        pen.arc(-0.1f, 0.0f, 0.95f, -0.3f * kPi, 0.3f * kPi);
    } else {
        pen.line(0.3f, -0.35f, 0.95f, 0.35f);
        pen.line(0.3f, 0.35f, 0.95f, -0.35f);
    }
}

// A shield with a tick.
void shield(const Pen& pen) {
    pen.path(
        {{0, -0.95f}, {0.75f, -0.65f}, {0.7f, 0.15f}, {0, 0.95f}, {-0.7f, 0.15f}, {-0.75f, -0.65f}},
        true);
    pen.path({{-0.35f, -0.05f}, {-0.05f, 0.3f}, {0.4f, -0.35f}});
}

void corners(const Pen& pen) {
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f})
            pen.path({{0.8f * x, 0.3f * y}, {0.8f * x, 0.75f * y}, {0.3f * x, 0.75f * y}});
}

void question(const Pen& pen) {
    pen.arc(0, -0.4f, 0.42f, -kPi, 0.4f * kPi);
    pen.line(0.13f, 0.0f, 0.0f, 0.35f);
    pen.dot(0, 0.78f, 0.13f);
}

void dice(const Pen& pen) {
    pen.box(-0.8f, -0.8f, 0.8f, 0.8f, 0.3f);
    for (const float k : {-0.38f, 0.0f, 0.38f}) pen.dot(k, k, 0.15f);
    for (const float k : {-0.38f, 0.38f}) pen.dot(k, -k, 0.15f);
}

void loop(const Pen& pen) {
    pen.path({{-0.85f, 0.0f}, {-0.85f, -0.5f}, {0.5f, -0.5f}});
    pen.path({{0.85f, 0.0f}, {0.85f, 0.5f}, {-0.5f, 0.5f}});
    pen.triangle({0.4f, -0.9f}, {0.95f, -0.5f}, {0.4f, -0.1f});
    pen.triangle({-0.4f, 0.9f}, {-0.95f, 0.5f}, {-0.4f, 0.1f});
}

void save(const Pen& pen) {
    pen.path({{-0.8f, -0.8f}, {0.5f, -0.8f}, {0.8f, -0.5f}, {0.8f, 0.8f}, {-0.8f, 0.8f}}, true);
    pen.box(-0.4f, 0.1f, 0.4f, 0.8f, 0.0f);
    pen.line(-0.35f, -0.4f, 0.25f, -0.4f);
}

void wipe(const Pen& pen) {
    pen.box(-0.9f, -0.65f, 0.9f, 0.65f, 0.2f);
    pen.solid(-0.9f, -0.65f, 0.0f, 0.65f);
    pen.line(0, -1.0f, 0, 1.0f);
}

void flip(const Pen& pen) {
    pen.line(-0.85f, -0.35f, 0.5f, -0.35f);
    pen.triangle({0.35f, -0.8f}, {0.9f, -0.35f}, {0.35f, -0.35f});
    pen.line(0.85f, 0.35f, -0.5f, 0.35f);
    pen.triangle({-0.35f, 0.8f}, {-0.9f, 0.35f}, {-0.35f, 0.35f});
}

void play(const Pen& pen) {
    pen.triangle({-0.55f, -0.85f}, {0.9f, 0.0f}, {-0.55f, 0.85f});
}

void pause(const Pen& pen) {
    pen.solid(-0.7f, -0.8f, -0.2f, 0.8f, 0.1f);
    pen.solid(0.2f, -0.8f, 0.7f, 0.8f, 0.1f);
}

void step(const Pen& pen) {
    pen.triangle({-0.8f, -0.75f}, {0.45f, 0.0f}, {-0.8f, 0.75f});
    pen.solid(0.5f, -0.75f, 0.8f, 0.75f, 0.1f);
}

void reset(const Pen& pen) {
    pen.triangle({0.8f, -0.75f}, {-0.45f, 0.0f}, {0.8f, 0.75f});
    pen.solid(-0.8f, -0.75f, -0.5f, 0.75f, 0.1f);
}

void copy(const Pen& pen) {
    pen.line(-0.9f, 0, 0.5f, 0);
    pen.triangle({0.2f, -0.5f}, {0.9f, 0.0f}, {0.2f, 0.5f});
}

void cross(const Pen& pen) {
    pen.line(-0.6f, -0.6f, 0.6f, 0.6f);
    pen.line(-0.6f, 0.6f, 0.6f, -0.6f);
}

void brackets(const Pen& pen) {
    pen.path({{-0.35f, -0.6f}, {-0.9f, 0.0f}, {-0.35f, 0.6f}});
    pen.path({{0.35f, -0.6f}, {0.9f, 0.0f}, {0.35f, 0.6f}});
    pen.line(0.15f, -0.8f, -0.15f, 0.8f);
}

void search(const Pen& pen) {
    pen.ring(-0.15f, -0.15f, 0.6f);
    pen.line(0.3f, 0.3f, 0.85f, 0.85f);
}

void clock(const Pen& pen) {
    pen.ring(0, 0, 0.85f);
    pen.path({{0, -0.5f}, {0, 0}, {0.4f, 0.25f}});
}

void screen(const Pen& pen) {
    pen.box(-0.95f, -0.75f, 0.95f, 0.5f, 0.2f);
    pen.line(-0.45f, 0.85f, 0.45f, 0.85f);
}

// In the order of Icon.
constexpr auto kDrawings = std::to_array<void (*)(const Pen&)>({
    play,
    pause,
    step,
    reset,
    [](const Pen& pen) { hook(pen, -1); },
    [](const Pen& pen) { hook(pen, 1); },
    dice,
    [](const Pen& pen) { lock(pen, true); },
    [](const Pen& pen) { lock(pen, false); },
    copy,
    flip,
    wipe,
    cross,
    cross,
    search,
    sliders,
    layers,
    grid,
    diagram,
    shield,
    brackets,
    clock,
    screen,
    camera,
    [](const Pen& pen) { pen.dot(0, 0, 0.62f); },
    corners,
    question,
    loop,
    [](const Pen& pen) { speaker(pen, true); },
    [](const Pen& pen) { speaker(pen, false); },
    turn,
    save,
});
static_assert(kDrawings.size() == static_cast<std::size_t>(Icon::save) + 1);

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, ImVec2 centre, float side, ImU32 colour) {
    kDrawings[static_cast<std::size_t>(icon)](
        {list, centre, 0.5f * side, colour, std::max(1.0f, side / 10.0f)});
}

}  // namespace glint
