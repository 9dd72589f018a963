// The mirrored sea: screen-space rays against exact ones, the looking glass, in figures.
#include "sea.h"
#include "worst_case.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace glint::sea_mirror_test {
namespace {

using SeaScene = GlTest;

struct Rates {
    int solvable = 0, other = 0;
    double found = 0.0, wrong = 0.0, invented = 0.0, traced = 0.0;  // percent
    double fetches = 0.0;                                           // a ray
};

// Walks against exact rays, over the pixels of water and glass, for any tweaks in one program.
class Walks {
public:
    explicit Walks(glm::ivec2 size) : size_(size) {}

    // All rays; water's; the mirror's to water; the mirror's to things.
    std::array<Rates, 4> rates(const std::string& tweaks, double time = 5.0) {
        const auto truth = drawn(truth_, tweaks, time);
        const auto walk = drawn(walk_, tweaks, time);
        std::array<Rates, 4> all;
        std::array<double, 4> rays{};
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const int code = static_cast<int>(truth[i].z);
            if (code == 0) continue;
            const float off =
                std::max(std::abs(walk[i].x - truth[i].x), std::abs(walk[i].y - truth[i].y));
            const double fetches = std::floor(walk[i].z);
            const double mark = walk[i].z - fetches;
            const bool traced = mark == 0.25, met = mark == 0.5;
            for (const int part : {0, 1 + code / 4}) {
                Rates& r = all[static_cast<std::size_t>(part)];
                rays[static_cast<std::size_t>(part)] += 1.0;
                r.fetches += fetches;
                r.traced += traced;
                if (code % 4 == 2) {
                    ++r.solvable;
                    r.found += met || traced;
                    r.wrong += met && off > 2.0f;
                } else {
                    ++r.other;
                    r.invented += met;
                }
            }
        }
        for (std::size_t part = 0; part < 4; ++part) {
            Rates& r = all[part];
            r.wrong *= 100.0 / std::max(r.found, 1.0);
            r.found *= 100.0 / std::max(r.solvable, 1);
            r.invented *= 100.0 / std::max(r.other, 1);
            r.fetches /= std::max(rays[part], 1.0);
            r.traced *= 100.0 / std::max(rays[part], 1.0);
        }
        return all;
    }

private:
    std::vector<glm::vec4> drawn(Player& player, const std::string& tweaks, double time) {
        const TestFolder folder;
        const ReadPreset read = read_scene_text(folder, sea_picture(""),
                                                {.preset = "[tweaks]\nedgeFade = 0.0\n" + tweaks});
        if (!read.preset) throw std::runtime_error(to_text(read.diagnostics));
        player.preset.values = read.preset->values;
        Frame frame = player.frame(0);
        frame.time = time;
        player.draw(frame);
        return pixels_of(player);
    }

    glm::ivec2 size_;
    // Where the exact ray meets something: its pixel, its depth, what the picture has there.
    Player truth_{
        sea_picture(
            "    float sea = hitSea(from, u.away, angle, u.id == kGlass ? kFar : 0.0);\n"
            "    float end = !mirrors ? 0.0 : sea > 0.0 ? sea : kFar;\n"
            "    Hit h = hitThings(from, u.away, angle, end);\n"
            "    if (h.id == kSky && sea > 0.0) h.id = kWater;\n"
            "    vec3 v = toView(e, from + min(h.t, 1e5) * u.away);\n"
            "    vec2 at = toPixel(e, v);\n"
            "    bool inside = v.z > kNear && clamp(at, vec2(0.0), iResolution.xy - 0.01) == at;\n"
            // Shown: nothing lies between the eye and the point.
            "    vec3 sight = from + min(h.t, 1e5) * u.away - e.pos;\n"
            "    float reach = length(sight) * 0.995 - 0.005;\n"
            "    Hit before = hitThings(e.pos, normalize(sight), angle, reach);\n"
            "    float wet = hitSea(e.pos, normalize(sight), angle, kFar);\n"
            "    bool shown = inside && before.id == kSky && (wet < 0.0 || wet > reach);\n"
            "    float kind = !mirrors ? 0.0 : h.id == kSky || !shown ? 1.0 : 2.0;\n"
            "    float part = u.id == kWater ? 0.0 : h.id == kWater ? 4.0 : 8.0;\n"
            "    c = vec4(at, kind == 0.0 ? 0.0 : kind + part, 1.0);\n"),
        {.size = size_, .specialise = false}};
    Player walk_{
        sea_picture("    vec2 found;\n"
                    "    bool doubtful;\n"
                    "    float sure = walkScreen(e, from, u.away, 0.5, mirrors, found, doubtful);\n"
                    "    sure = doubtful ? 0.25 : sure > 0.0 ? 0.5 : 0.0;\n"
                    "    c = vec4(found, float(walkFetches) + sure, 1.0);\n"),
        {.size = size_, .specialise = false}};
};

// Cameras anywhere over seas of any kind, with the glass turned any way.
constexpr std::size_t kViewNumbers = 12;
std::string view_at(Dials& dials) {
    std::string view;
    const auto add = [&](const char* name, double value) {
        view += fmt::format("{} = {:.4g}\n", name, value);
    };
    const auto calm = [&](double most) { return std::max(dials.between(-most / 3.0, most), 0.0); };
    add("cameraDistance", dials.between_logs(2.0, 12.0));
    add("cameraAngle", dials.between(-180, 180));
    add("cameraHeight", dials.between_logs(0.2, 6.0));
    add("targetHeight", dials.between(-0.5, 1.5));
    add("targetShift", dials.between(-1, 1));
    add("focalLength", dials.between_logs(12.0, 120.0));
    add("waveHeight", calm(2.0));
    add("ripples", calm(2.0));
    add("choppiness", dials.between(0, 1));
    for (const char* name : {"windAngle", "mirrorAngle", "rabbitAngle"})
        add(name, dials.between(-180, 180));
    return view;
}

// The same bars for every way of walking.
void expect_good(const Rates& r, double most_fetches = 32.0) {
    EXPECT_GE(r.found, 98.0);
    EXPECT_LE(r.wrong, 2.0);
    EXPECT_LE(r.invented, 3.0);
    EXPECT_LE(r.fetches, most_fetches);
}

void sweep(const std::string& method) {
    Walks walks({480, 270});
    Bar found("Q13 sea, " + method + ": found, %", 98.0, Bar::Side::at_least);
    Bar wrong("Q13 sea, " + method + ": over 2 px off, %", 2.0);
    Bar invented("Q13 sea, " + method + ": false, %", 3.0);
    Bar fetches("Q13 sea, " + method + ": texels a ray", 32.0);
    double traced = 0.0;
    int views = 0;
    search_worst(kViewNumbers + 1, 280, {&found, &wrong, &invented, &fetches}, [&](Dials& dials) {
        const std::string view = view_at(dials);
        const double time = dials.between(0.0, 60.0);
        const Rates r = walks.rates(view + fmt::format("reflections = \"{}\"\n", method), time)[0];
        if (r.solvable < 1296) return;  // a hundredth of the picture: else no percentage
        const std::string where = fmt::format("{}{:.2f} s", view, time);
        found.see(r.found, where);
        wrong.see(r.wrong, where);
        invented.see(r.invented, where);
        fetches.see(r.fetches, where);
        traced += r.traced;
        ++views;
    });
    EXPECT_GE(views, 200);
    fmt::print("traced {:.1f} % on average of {} views\n", traced / views, views);
}
TEST_F(SeaScene, ScreenSpaceRaysHoldOverViewsAndSeas) {
    sweep("screen-space");
}
TEST_F(SeaScene, ScreenSpaceRaysHoldOverViewsAndSeasThatAreMarched) {
    sweep("march");
}

// Bars: of what is on the screen at least 98 % is found, at most 2 % of that more than 2 pixels
// off; at most 3 % of the other rays find something; at most 32 texels are read a ray. With ever
// finer steps a walk must not become worse.
TEST_F(SeaScene, ScreenSpaceRaysFindWhatExactRaysMeet) {
    struct View {
        const char *name, *tweaks;
    };
    // The scene's own, and the worst there are.
    constexpr std::array<View, 9> kViews = {{
        {"usual", ""},
        {"calm", "waveHeight = 0.0\nripples = 0.0\n"},
        {"tele", "cameraAngle = -60.0\nfocalLength = 120.0\n"},
        {"rough", "waveHeight = 2.0\nripples = 2.0\nchoppiness = 1.0\n"},
        {"high", "cameraHeight = 5.0\n"},
        {"along the glass",
         "cameraAngle = 90.6\ncameraDistance = 3.48\ncameraHeight = 0.31\ntargetHeight = 1.11\n"
         "focalLength = 68.0\nmirrorAngle = 168.0\nwaveHeight = 1.72\n"},
        {"low and far",
         "cameraAngle = 154.1\ncameraDistance = 9.2\ncameraHeight = 0.28\ntargetHeight = 0.116\n"
         "targetShift = -0.944\nfocalLength = 25.3\nmirrorAngle = 97.6\nwaveHeight = 0.0\n"
         "ripples = 1.6\nrabbitAngle = 128.5\n"},
        {"far and small",
         "cameraDistance = 5.915\ncameraAngle = 149.4\ncameraHeight = 0.3621\n"
         "targetHeight = 0.9542\ntargetShift = -0.03439\nfocalLength = 15.68\n"
         "waveHeight = 1.953\nripples = 1.683\nchoppiness = 0.03504\nwindAngle = -104.5\n"
         "mirrorAngle = -13.3\nrabbitAngle = 112.5\n"},
        {"by search",
         "cameraDistance = 5.451\ncameraAngle = -35.15\ncameraHeight = 0.674\n"
         "targetHeight = -0.01639\ntargetShift = -0.453\nfocalLength = 20.6\nwaveHeight = 0\n"
         "ripples = 0.4334\nchoppiness = 0\nwindAngle = -144.6\nmirrorAngle = -155.4\n"
         "rabbitAngle = -165.6\n"},
    }};
    struct Way {
        const char *name, *tweaks;
        double most_fetches = 32.0;
    };
    constexpr std::array<Way, 4> kWays = {{
        {"march 32 + 6", "reflections = \"march\"\n"},
        {"walk, stride 1", "reflections = \"screen-space\"\nstride = 1.0\n",
         40.0},  // up to 60 pixels, one by one
        {"walk, stride 3", "reflections = \"screen-space\"\nstride = 3.0\n"},
        {"walk, stride 8", "reflections = \"screen-space\"\nstride = 8.0\n"},
    }};
    constexpr std::array kParts = {"all", "water", "to sea", "to thing"};
    Walks walks({480, 270});
    fmt::print("{:<32}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "", "solvable", "found %", ">2 px %",
               "false %", "fetches", "traced %");
    for (const View& view : kViews) {
        std::vector<double> wrong;
        for (const Way& way : kWays) {
            SCOPED_TRACE(std::string(view.name) + ", " + way.name);
            const auto all = walks.rates(std::string(view.tweaks) + way.tweaks);
            for (std::size_t k = 0; k < all.size(); ++k) {
                const Rates& r = all[k];
                fmt::print("{:<16}{:<16}{:<8}{:>9}{:>9.2f}{:>9.2f}{:>9.2f}{:>9.1f}{:>9.2f}\n",
                           view.name, way.name, kParts[k], r.solvable, r.found, r.wrong, r.invented,
                           r.fetches, r.traced);
            }
            expect_good(all[0], way.most_fetches);
            wrong.push_back(all[0].wrong);
        }
        // A twentieth of a percent are a few rays.
        EXPECT_LE(wrong[1], wrong[2] + 0.05) << "strides 1 and 3";
        EXPECT_LE(wrong[2], wrong[3] + 0.05) << "strides 3 and 8";
    }
}

TEST_F(SeaScene, ScreenSpaceRaysFromTheNearPlaneOrBehindItFindNothing) {
    // Rays in all directions from the eye's plane, from behind it, and from just before the near
    // plane.
    const auto pixels = picture(
        "    vec3 d = normalize(random3(ivec3(ivec2(p), 7)) - 0.5);\n"
        "    float depth = p.x < 32.0 ? 0.0 : p.x < 64.0 ? -0.5 : 0.999 * kNear;\n"
        "    vec3 o = e.pos + depth * e.forward + (p.y < 20.0 ? 0.0 : 0.3) * e.right;\n"
        "    vec2 found;\n"
        "    bool doubtful;\n"
        "    c = vec4(walkScreen(e, o, d, 0.5, true, found, doubtful), found, 1.0);\n",
        {96, 40}, "reflections = \"screen-space\"\n");
    for (const glm::vec4& pixel : pixels) {
        EXPECT_EQ(pixel, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    }
}

// Of rays that a disc of half width b gathers evenly, the mean is the mirrored ray and the variance
// along each axis b^2 / 4, whichever way the glass stands. 64 rays in a spiral keep that to 4 %.
TEST_F(SeaScene, ABlurredGlassGathersEvenlyAndNothingFromBehindIt) {
    const auto pixels = picture(
        "    vec3 nor = normalize(random3(ivec3(ivec2(p), 7)) - 0.5 + 1e-4);\n"
        "    vec3 away = normalize(random3(ivec3(ivec2(p), 8)) - 0.5 + 1e-4);\n"
        "    away *= dot(away, nor) < 0.0 ? -1.0 : 1.0;\n"
        "    vec3 a = normalize(cross(away, nor) + 1e-6), b = cross(a, away);\n"
        "    vec2 sum = vec2(0.0), squares = vec2(0.0);\n"
        "    float least = 1.0;\n"
        "    for (int k = 0; k < mirrorRays; ++k) {\n"
        "        vec3 d = blurredRay(away, nor, float(k), random3(ivec3(ivec2(p), 9)).xy);\n"
        "        vec2 off = vec2(dot(d, a), dot(d, b)) / dot(d, away);\n"
        "        sum += off / float(mirrorRays);\n"
        "        squares += off * off / float(mirrorRays);\n"
        "        least = min(least, dot(d, nor));\n"
        "    }\n"
        "    bool slant = dot(away, nor) < 0.3;\n"
        "    c = vec4(slant ? -1.0 : length(sum), squares, least);\n",
        {64, 64}, "mirrorBlur = 0.2\nmirrorRays = 64\n");
    int whole = 0;
    for (const glm::vec4& pixel : pixels) {
        EXPECT_GE(pixel.w, 0.0f);
        if (pixel.x < 0.0f) continue;  // part of the disc would lie behind the glass
        ++whole;
        EXPECT_LE(pixel.x, 0.006f);
        EXPECT_NEAR(pixel.y, 0.01f, 5e-4f);
        EXPECT_NEAR(pixel.z, 0.01f, 5e-4f);
    }
    EXPECT_GT(whole, 1000);
}

}  // namespace
}  // namespace glint::sea_mirror_test
