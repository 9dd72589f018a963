// Rays that run exactly level, along an axis or at 45 degrees: what they see is what rays a hair to
// either side of them see.
//
// A level camera that looks along an axis has such rays in the middle row and column and on the
// diagonals of a picture with odd sides. Something is stranded where it differs from both
// neighbours though these agree: an edge of an object lies between the neighbours and strands
// nothing.
#include "probe.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <random>

namespace glint::degenerate_rays_test {
namespace {

using DegenerateRays = GlTest;

constexpr glm::ivec2 kSize{65, 37};  // odd: the middle of a pixel is the middle of the picture

std::string scene_text(const std::string& scene) {
    return "#include \"" GLINT_REPOSITORY "/fragments/" + scene + ".frag\"\n";
}

// Of three colours on the screen; 6/255 is what a hair may move a thing that is a pixel small. What
// is no number is stranded, too.
bool is_stranded(const glm::vec4& here, const glm::vec4& before, const glm::vec4& after) {
    const auto apart = [](const glm::vec4& a, const glm::vec4& b) {
        const glm::vec4 d = glm::abs(a - b);
        return std::max({d.x, d.y, d.z});
    };
    const float away = std::min(apart(here, before), apart(here, after));
    return !(away - apart(before, after) < 6.0f / 255.0f);
}

// ---- Cameras ----

struct View {
    double distance, height, angle;  // m, m, degrees
};

class Camera {
public:
    explicit Camera(const std::string& scene)
        : player_(scene_text(scene), {.size = kSize, .specialise = false}),
          round_target_(scene == "terrain") {
        // The quickest light on the floor: it has nothing to do with rays from the eye.
        if (scene == "caustics") value("method") = 0.0;
        defaults_ = player_.preset.values;
    }

    // How many pixels are stranded on the worst line of the picture: a row, a column or a diagonal.
    int stranded_on_a_line(const View& view) {
        return most_on_a_line(view, [] {});
    }

    // How many pixels are, of a picture in which this angle is exactly so, beside one hundredth of
    // a degree less and more. The sun stands high, and the eye looks down.
    int stranded_by_angle(const std::string& tweak, double degrees, const View& view) {
        const auto turned = [&](double angle) {
            return picture(view, 0.0, [&] {
                for (const auto& [name, number] :
                     {std::pair{"sunHeight", 45.0}, {"targetHeight", 0.0}})
                    if (has(name)) value(name) = number;
                value(tweak) = angle;
            });
        };
        const Picture here = turned(degrees), before = turned(degrees - 0.01);
        const Picture after = turned(degrees + 0.01);
        int count = 0;
        for (std::size_t i = 0; i < here.size(); ++i)
            count += is_stranded(here[i], before[i], after[i]);
        return count;
    }

    // Names of what turns light and wind.
    std::vector<std::string> angles() const {
        std::vector<std::string> names;
        for (const Tweak& tweak : player_.preset.scene.tweaks)
            if (tweak.unit == "deg" && tweak.name.ends_with("Angle") && tweak.name != "cameraAngle")
                names.push_back(tweak.name);
        return names;
    }

    // Of a level eye on the axis z = 20 that looks along x over a lake without waves.
    int stranded_on_a_calm_lake() {
        const auto calm = [&] {
            for (const auto& [name, number] :
                 {std::pair{"waveHeight", 0.0}, {"waterLevel", 6.0}, {"cameraRise", 40.0}})
                value(name) = number;
            value("target") = 10.0;
            value("target", 2) = 20.0;
        };
        return most_on_a_line({20.0, 0.0, 90.0}, calm);
    }

private:
    using Picture = std::vector<glm::vec4>;

    int most_on_a_line(const View& view, const std::function<void()>& turn) {
        const Picture here = picture(view, 0.0, turn), before = picture(view, -1.0, turn);
        const Picture after = picture(view, 1.0, turn);
        std::map<std::pair<int, int>, int> lines;
        for (int y = 0; y < kSize.y; ++y) {
            for (int x = 0; x < kSize.x; ++x) {
                const auto i = static_cast<std::size_t>(y * kSize.x + x);
                if (!is_stranded(here[i], before[i], after[i])) continue;
                const std::array places = {x, y, x + y, x - y};
                for (int kind = 0; kind < 4; ++kind) {
                    ++lines[{kind, places[static_cast<std::size_t>(kind)]}];
                }
            }
        }
        int most = 0;
        for (const auto& [line, count] : lines) most = std::max(most, count);
        return most;
    }

    // side: -1 or 1 to lean the camera by some thousandths of a pixel.
    // `turn` sets what else is another than usual.
    Picture picture(const View& view, double side, const std::function<void()>& turn) {
        player_.preset.values = defaults_;
        value("focalLength") = 24.0;
        value("cameraDistance") = view.distance;
        value("cameraAngle") = view.angle + 0.004 * side;
        if (round_target_) {
            value("cameraRise") = 0.004 * side;
            value("target", 1) = view.height;
        } else {
            value("cameraHeight") = view.height + 1e-5 * side;
            value("targetHeight") = view.height + 1e-4 * view.distance * side;
        }
        turn();
        player_.draw(0);
        const std::vector<float> floats = player_.floats();
        Picture pixels(floats.size() / 4);
        std::memcpy(pixels.data(), floats.data(), floats.size() * sizeof(float));
        return pixels;
    }
    bool has(const std::string& name) const {
        const auto& tweaks = player_.preset.scene.tweaks;
        return std::ranges::find(tweaks, name, &Tweak::name) != tweaks.end();
    }
    double& value(const std::string& name, std::size_t component = 0) {
        const auto& tweaks = player_.preset.scene.tweaks;
        for (std::size_t i = 0; i < tweaks.size(); ++i) {
            if (tweaks[i].name == name) return player_.preset.values[i][component];
        }
        throw std::runtime_error("no tweak " + name);
    }

    Player player_;
    std::vector<TweakValue> defaults_;
    bool round_target_;  // the camera has a target and a rise over it, not two heights
};

// Glass and mirrors strand a pixel here and there, where rays part after many bounces; never a line
// of them.
constexpr int kByChance = 3;

// A level ray once met the floor at the eye itself.
TEST_F(DegenerateRays, ALevelRowOfTheChristmasRoomIsAsTheRowsBesideIt) {
    Camera camera("christmas");
    EXPECT_LE(camera.stranded_on_a_line({4.2, 0.98, 0.0}), kByChance);
}

// A ray in the water that runs exactly along x once met a wall at once.
TEST_F(DegenerateRays, ACalmLakeHasNoColumn) {
    EXPECT_LE(Camera("terrain").stranded_on_a_calm_lake(), kByChance);
}

struct Scene {
    std::string name;
    std::array<double, 2> distances;
    std::vector<double> heights;  // at the middle or an edge of something, or between them
    std::vector<double> angles;   // along the faces of boxes that are turned
};
void PrintTo(const Scene& scene, std::ostream* out) {
    *out << scene.name;
}
const std::vector<Scene> kScenes = {
    {"analytic", {4.0, 7.6}, {0.3, 0.56, 0.8, 1.36, 1.8, 6.0}, {25.7831008, 35.5234}},
    {"boat", {3.0, 8.5}, {1.0, 2.0, 3.0, 4.0, 5.0}, {}},
    {"caustics", {1.0, 3.4}, {0.05, 0.5, 1.0}, {28.6478898}},
    {"christmas", {4.2, 5.6}, {0.1, 0.34, 0.61, 0.79, 0.98, 1.16, 3.74, 6.0}, {20.0535228}},
    {"deep_ocean", {5.0, 18.0}, {0.3, 1.6, 4.0, 10.0, 20.0}, {}},
    {"magic", {8.0, 9.5}, {0.1, 1.0, 1.8, 2.3, 4.0, 7.0}, {}},
    {"sea", {2.0, 3.9}, {0.5, 1.0, 1.15, 2.0}, {}},
    {"terrain", {150.0, 250.0}, {-20.0, -3.0, 0.3, 5.0, 10.0}, {}},
    {"water", {3.0, 9.2}, {0.3, 0.5, 1.0, 1.7, 3.0}, {}},
};

class DegenerateCameras : public GlTest, public testing::WithParamInterface<Scene> {};

TEST_P(DegenerateCameras, StrandNoLineOfPixels) {
    const Scene& scene = GetParam();
    Camera camera(scene.name);
    std::vector<double> angles = {0.0, 90.0, 180.0, -90.0, 45.0, -135.0};
    angles.insert(angles.end(), scene.angles.begin(), scene.angles.end());
    int worst = 0;
    for (const double distance : scene.distances) {
        for (const double height : scene.heights) {
            for (const double angle : angles) {
                const int found = camera.stranded_on_a_line({distance, height, angle});
                EXPECT_LE(found, kByChance) << scene.name << " from " << distance << " m, "
                                            << height << " m high, at " << angle << " degrees";
                worst = std::max(worst, found);
            }
        }
    }
    fmt::print("{}: at most {} pixels of a line stand apart\n", scene.name, worst);
}
INSTANTIATE_TEST_SUITE_P(Scenes, DegenerateCameras, testing::ValuesIn(kScenes),
                         [](const auto& scene) { return scene.param.name; });

// Light and wind along an axis: the sun's shade of the pool's wall once fell on half of the pool.
class DegenerateAngles : public GlTest, public testing::WithParamInterface<Scene> {};

TEST_P(DegenerateAngles, ChangeThePictureByNothing) {
    Camera camera(GetParam().name);
    for (const std::string& angle : camera.angles()) {
        for (const double degrees : {0.0, 90.0, -90.0}) {
            const int found = camera.stranded_by_angle(
                angle, degrees, {GetParam().distances[0], GetParam().heights.back(), 10.0});
            fmt::print("{}: {}={}: {} pixels\n", GetParam().name, angle, degrees, found);
            EXPECT_LE(found, kSize.x * kSize.y / 100) << angle << " = " << degrees;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Scenes, DegenerateAngles, testing::ValuesIn(kScenes),
                         [](const auto& scene) { return scene.param.name; });

// ---- Rays ----

struct Room {
    std::string scene, light;  // what arrives at a against b
    glm::vec3 low, high;       // where rays start, m
};
void PrintTo(const Room& room, std::ostream* out) {
    *out << room.scene;
}
const std::vector<Room> kRooms = {
    {"analytic", "lightAlong(a.xyz, b.xyz, vec2(0.0, 0.002))", {-4, 0.1, -4}, {4, 4, 4}},
    {"caustics", "render(a.xyz, b.xyz, 0.002, 0.5)", {-4, 0.05, -4}, {4, 2.3, 4}},
    {"christmas", "radiance(a.xyz, b.xyz, 0.002)", {-6, 0.1, -6}, {6, 5, 6}},
    {"deep_ocean", "render(a.xyz, b.xyz, 0.002, 0.5)", {-30, 4, -30}, {30, 23, 30}},
    {"magic", "render(a.xyz, b.xyz, 0.002, 0.5)", {-8, 0.1, -8}, {8, 8, 8}},
};

// Along an axis, at 45 degrees between two or all of them, or in a plane of two.
glm::vec3 degenerate_ray(int kind, std::mt19937& random) {
    const auto sign = [&random] { return random() % 2 == 0 ? 1.0f : -1.0f; };
    const int k = static_cast<int>(random() % 3), next = (k + 1) % 3, last = (k + 2) % 3;
    glm::vec3 rd(0.0f);
    if (kind < 3) {
        for (int i = 0; i <= kind; ++i) rd[(k + i) % 3] = sign();
        return glm::normalize(rd);
    }
    const float angle =
        2.0f * std::numbers::pi_v<float> * static_cast<float>(random() % 4096) / 4096.0f;
    rd[next] = std::cos(angle);
    rd[last] = std::sin(angle);
    return rd;
}

// How many of so many rays from so many places are stranded between rays 2e-5 rad aside.
int stranded_rays(const Room& room, int rays, const std::vector<int>& kinds,
                  const std::string& text) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const auto anywhere = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    std::vector<ProbeCase> cases;
    for (int i = 0; i < rays; ++i) {
        glm::vec3 ro = glm::mix(room.low, room.high, anywhere());
        if (i % 2 == 0)
            ro = glm::max(glm::round(ro * 4.0f) / 4.0f, room.low);  // on planes of boxes
        const glm::vec3 rd =
            degenerate_ray(kinds[static_cast<std::size_t>(i / 2) % kinds.size()], random);
        const glm::vec3 hair = 2e-5f * glm::normalize(anywhere() - 0.5f);
        for (const float side : {0.0f, -1.0f, 1.0f}) {
            cases.push_back(
                {.a = glm::vec4(ro, 0),
                 .b = glm::vec4(side == 0.0f ? rd : glm::normalize(rd + side * hair), 0)});
        }
    }
    const auto seen = probe(text, "display(" + room.light + ")", cases);
    int found = 0;
    for (std::size_t i = 0; i < cases.size(); i += 3) {
        if (!is_stranded(seen[i], seen[i + 1], seen[i + 2])) continue;
        const glm::vec4 &ro = cases[i].a, &rd = cases[i].b;
        fmt::print("{}: from ({}, {}, {}) along ({}, {}, {})\n", room.scene, ro.x, ro.y, ro.z, rd.x,
                   rd.y, rd.z);
        ++found;
    }
    return found;
}

// Kelp and tentacles, strips that face the ray, once stood before every ray that ran nearly
// upright.
TEST_F(DegenerateRays, UprightOnesMeetNoKelpThatIsElsewhere) {
    std::ifstream file(GLINT_REPOSITORY "/fragments/deep_ocean.frag");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string ship = "uniform bool  wreck;           //@ on";
    ASSERT_NE(text.find(ship), std::string::npos);
    text.replace(text.find(ship) + ship.size() - 2, 2, "off");
    EXPECT_EQ(stranded_rays(kRooms[3], 1500, {0}, text), 0);
}

class DegenerateStarts : public GlTest, public testing::WithParamInterface<Room> {};

TEST_P(DegenerateStarts, StrandNoRay) {
    EXPECT_EQ(stranded_rays(GetParam(), 5400, {0, 1, 2, 3}, scene_text(GetParam().scene)), 0);
}
INSTANTIATE_TEST_SUITE_P(Scenes, DegenerateStarts, testing::ValuesIn(kRooms),
                         [](const auto& room) { return room.param.scene; });

}  // namespace
}  // namespace glint::degenerate_rays_test
