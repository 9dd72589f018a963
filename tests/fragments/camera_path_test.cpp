// A mouse that is dragged all over the picture turns the landscapes' cameras through all of their
// views: no view is empty, none is from inside of something, none jumps.
#include "../render/fixture.h"

#include <algorithm>
#include <cmath>

namespace glint::camera_path_test {
namespace {

using CameraPath = GlTest;

constexpr glm::ivec2 kSize{48, 27};
constexpr double kFps = 30.0;

// The pixels that the mouse visits, one further in every frame: along the picture's lower border,
// and in turn to and fro as far as its upper one, so that every view turns as far as the last.
std::vector<glm::ivec2> path_of_mouse() {
    std::vector<glm::ivec2> path;
    int step = 1, x = 1;  // the corner itself, (0, 0), is no drag
    for (int y = 0; y < kSize.y; ++y) {
        path.push_back({x, y});
        if (y % 13 != 0) continue;
        for (x += step; x > 0 && x < kSize.x; x += step) path.push_back({x, y});
        x -= step;
        step = -step;
    }
    return path;
}
// The same as events, the button held: each comes before its frame, in the middle of a pixel.
std::string dragged(const std::vector<glm::ivec2>& path) {
    std::string events;
    for (std::size_t k = 0; k < path.size(); ++k)
        events += fmt::format("[[events]]\nt = {:.6f}\nmouse = [{:.6f}, {:.6f}]\ndown = true\n",
                              std::max(static_cast<double>(k) - 0.5, 0.0) / kFps,
                              (path[k].x + 0.5) / kSize.x, (path[k].y + 0.5) / kSize.y);
    return events;
}

struct View {
    double mean = 0.0, spread = 0.0;  // of its channels, 0 to 1
    double change = 0.0;              // from the view before, mean of all channels
    float room = 0.0f;                // m, from the eye to what is solid
};

// The scene's views along the path, with everything else at rest. `room` is GLSL for the distance
// from the eye to what it must not be in; it comes in the first pixel, which is no part of the
// view.
std::vector<View> views(const std::string& scene, std::string_view room,
                        const std::string& tweaks) {
    const std::vector<glm::ivec2> mouse = path_of_mouse();
    Player player(fmt::format("#define mainImage scene_image\n"
                              "#include \"" GLINT_REPOSITORY "/fragments/{}.frag\"\n"
                              "#undef mainImage\n"
                              "void mainImage(out vec4 c, in vec2 p) {{\n"
                              "    scene_image(c, p);\n"
                              "    vec3 eye = camera().pos;\n"
                              "    if (p.x + p.y < 1.5) c.r = {};\n"
                              "}}\n",
                              scene, room),
                  {.size = kSize,
                   .preset = "[tweaks]\nanimation = 0.0\n" + tweaks + dragged(mouse),
                   .fps = kFps});
    std::vector<View> path;
    std::vector<float> before;
    for (int k = 0; k < static_cast<int>(mouse.size()); ++k) {
        player.draw(k);
        const std::vector<float> now = player.floats();
        View view{.room = now.at(0)};
        double squares = 0.0;
        for (std::size_t i = 4; i < now.size(); ++i) {
            if (i % 4 == 3) continue;
            EXPECT_TRUE(std::isfinite(now[i])) << scene << ", frame " << k;
            view.mean += now[i];
            squares += now[i] * now[i];
            if (k > 0) view.change += std::abs(now[i] - before[i]);
        }
        const double count = 3.0 * (kSize.x * kSize.y - 1);
        view.mean /= count;
        view.change /= count;
        view.spread = std::sqrt(std::max(squares / count - view.mean * view.mean, 0.0));
        path.push_back(view);
        before = now;
    }
    return path;
}

// A jump is a change that dwarfs the ones before and after it.
double largest_jump(const std::vector<View>& path) {
    double largest = 0.0;
    for (std::size_t k = 2; k + 1 < path.size(); ++k) {
        const double around = std::max(path[k - 1].change, path[k + 1].change);
        largest = std::max(largest, path[k].change / (around + 0.002));
    }
    return largest;
}

// 0.02: darker is black to the eye. 0.02: less varied is a wall before the lens. A jump of 3:
// every frame turns as far as the one before, so what is new in it varies by less; 1.3 was
// measured.
void expect_unbroken(const std::vector<View>& path, float least_room) {
    double darkest = 1.0, plainest = 1.0;
    float nearest = 1e9f;
    for (const View& view : path) {
        darkest = std::min(darkest, view.mean);
        plainest = std::min(plainest, view.spread);
        nearest = std::min(nearest, view.room);
    }
    const double jump = largest_jump(path);
    fmt::print("darkest {:.3f}, least varied {:.3f}, nearest {:.2f} m, largest jump {:.2f}\n",
               darkest, plainest, nearest, jump);
    EXPECT_GE(darkest, 0.02);
    EXPECT_GE(plainest, 0.02);
    EXPECT_GE(nearest, least_room);
    EXPECT_LE(jump, 3.0);
}

constexpr std::string_view kRoomInTheSea =
    "min(min(eye.y - groundHeight(eye.xz), depth - eye.y),\n"
    "        maxComponent(abs(toWreck(eye - kWreckAt) - vec3(0.3, 3.25, 0.0)) -\n"
    "                     vec3(12.6, 3.75, 3.4)))";
constexpr std::string_view kRoomByTheBlock =
    "max(max(abs(eye.x), abs(eye.z)) - kHalf,\n"
    "        max(eye.y - max(landHeight(eye.xz), waterLevel), kBase - eye.y))";

TEST_F(CameraPath, TheWreckIsSeenFromAllSidesWithoutABreak) {
    expect_unbroken(views("deep_ocean", kRoomInTheSea, ""), 0.5f);
}

// As near as any of the presets goes.
TEST_F(CameraPath, TheBlockIsSeenFromAllSidesWithoutABreak) {
    expect_unbroken(
        views("terrain", kRoomByTheBlock, "cameraDistance = 118.0\ntarget = [0.0, 2.0, -14.0]\n"),
        0.5f);
}

}  // namespace
}  // namespace glint::camera_path_test
