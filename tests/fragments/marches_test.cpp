// Rays to the scenes' height fields, over their tweaks: what the march finds against short steps
// through the same heights, which other tests hold against double precision.
//
// Q11, at -20, -5 and -1.5 degrees: at most 0.5 % of the hits more than 5 cm off, at most 0.5 % hit
// or miss against the truth, at most 32 evaluations a ray, at most 0.1 % out of steps.
#include "looks.h"

#include <cmath>

namespace glint::marches_test {
namespace {

struct Field {
    std::string scene;
    std::string height;  // GLSL, of vec2 q
    std::string start;   // from vec3 chance, more (0 to 1) and rd: vec3 ro and float end, m
    std::string hit;     // float found, beyond 0 and `end` for a miss, and evaluations
    std::string steps;   // the tweak that limits them
    double finish;       // evaluations that the count leaves out
    std::vector<std::string> tweaks;
    std::string worst = {};     // the look in which the sweep found most wrong
    double worst_time = 0.0;    // s
    double longest_time = 1e5;  // s, of the sweep
};
void PrintTo(const Field& field, std::ostream* out) {
    *out << field.scene;
}

const std::string kMovers =
    "float height(vec2 q) {\n"
    "    vec3 p = vec3(q.x, 0.0, q.y);\n"
    "    return moversHeight(moversAlong(0, p, vec3(0.0), 0.0), 0.0)\n"
    "        + moversHeight(moversAlong(1, p, vec3(0.0), 0.0), 0.0);\n}\n"
    "float top() {\n"
    "    vec4 a = moversAlong(0, vec3(0.0), vec3(0.0), 0.0).a\n"
    "        + moversAlong(1, vec3(0.0), vec3(0.0), 0.0).a;\n"
    "    return (1.0 + crest()) * dot(a, vec4(1.0));\n}\n";
const std::string kOverSea =
    "    vec2 at = 400.0 * (chance.yz - 0.5);\n"
    "    vec3 ro = vec3(at.x, height(at) + 0.05 + 5.0 * more.x * more.x, at.y);\n"
    "    float end = (-top() - 0.01 - ro.y) / rd.y;\n";

const std::vector<Field> kFields = {
    {.scene = "sea",
     .height = kMovers,
     .start = kOverSea,
     .hit = "    float found = hitSea(ro, rd, 0.0, kFar), evaluations = float(seaEvaluations);\n",
     .steps = "seaSteps",
     .finish = 4.0,
     .tweaks = {"waveHeight", "choppiness", "windAngle", "animation"},
     .worst = "waveHeight=2 choppiness=0.878 windAngle=-94 animation=0.692",
     .worst_time = 87925.6},
    {.scene = "boat",
     .height =
         "float height(vec2 q) { return moversAt(q); }\n"
         "float top() { return (1.0 + crest()) * dot(gHeight[0] + gHeight[1], vec4(1.0)); }\n",
     .start = "    loadWavelets();\n    loadBoat();\n" + kOverSea,
     .hit = "    float found = hitWaves(ro, rd, 0.0, kFar), evaluations = float(seaEvaluations);\n",
     .steps = "seaSteps",
     .finish = 4.0,
     .tweaks = {"longestWave", "steepness", "choppiness", "windAngle", "depth", "animation"},
     .worst = "longestWave=40 steepness=1 choppiness=1 windAngle=40.4 depth=1.11 animation=0.523",
     .worst_time = 58563.9},
    {.scene = "terrain",
     .height = "float height(vec2 q) { return landHeight(q); }\n",
     .start = "    vec2 at = 2.0 * kHalf * (chance.yz - 0.5);\n"
              "    vec3 ro = vec3(at.x, height(at) + 0.05 + 12.0 * more.x, at.y), face;\n"
              "    float end = blockSpan(ro, rd, face).y;\n",
     .hit = "    float found = hitLand(ro, rd, 0.0, end), evaluations = float(landTurns);\n",
     .steps = "marchSteps",
     .finish = 0.0,
     .tweaks = {"landscape", "relief", "ruggedness", "trees", "waterLevel"},
     .worst = "landscape=390 relief=0 ruggedness=2 trees=1 waterLevel=-4.4",
     .worst_time = 0.3,
     .longest_time = 1.0},
    {.scene = "deep_ocean",
     .height = "float height(vec2 q) { return groundHeight(q); }\n",
     .start = "    vec2 at = kTile * (chance.yz - 0.5);\n"
              "    vec3 ro = vec3(at.x, height(at) + 0.3 + 4.0 * more.x, at.y);\n"
              "    float end = 140.0;\n",
     .hit = "    float found = hitSeabed(ro, rd, 0.0, end);\n"
            "    float evaluations = float(seabedEvaluations);\n",
     .steps = "marchSteps",
     .finish = 0.0,
     .tweaks = {"wideRelief", "fineRelief", "cliff", "depth", "ripples"},
     .worst = "wideRelief=7.766 fineRelief=40 cliff=0 depth=16 ripples=1.901",
     .longest_time = 1.0},
    {.scene = "water",
     .height = "float height(vec2 q) { return waterHeight(q); }\n",
     .start = "    loadWaves();\n"
              "    vec2 at = 1.99 * kPool * (chance.yz - 0.5);\n"
              "    vec3 ro = vec3(at.x, height(at) + 0.01 + 0.5 * more.x * more.x, at.y);\n"
              "    vec2 far = (kPool * sign(rd.xz) - ro.xz) / rd.xz;\n"
              "    float end = min(far.x, far.y);\n",
     .hit = "    int n;\n    float found = marchWater(ro, rd, kFar, false, n);\n"
            "    float evaluations = float(n);\n",
     .steps = "marchSteps",
     .finish = 0.0,
     .tweaks = {"waveHeight", "longestWave", "windAngle", "windSpread", "depth", "rain", "dropSize",
                "dropForce", "waveSpeed", "damping"},
     .worst = "waveHeight=0.09572 longestWave=0.8214 windAngle=4.978 windSpread=171.2 depth=2.046 "
              "rain=51.38 dropSize=0.169 dropForce=2.72 waveSpeed=0.8008 damping=0.06749",
     .worst_time = 0.340442,
     .longest_time = 0.5},
};

constexpr int kSide = 48;  // rays, a side of the picture

class Rays {
public:
    explicit Rays(const Field& field)
        : field_(field),
          player_(
              fmt::format("#define mainImage scene_image\n"
                          "#include \"" GLINT_REPOSITORY "/fragments/{}.frag\"\n"
                          "#undef mainImage\n{}"
                          "void mainImage(out vec4 c, in vec2 p) {{\n"
                          "    int seed = int(iMouse.y);\n"
                          "    vec3 chance = random3(ivec3(ivec2(p), seed));\n"
                          "    vec3 more = random3(ivec3(ivec2(p), seed + 1000));\n"
                          "    float down = radians(iMouse.x), a = 2.0 * kPi * chance.x;\n"
                          "    vec3 rd = vec3(cos(down) * cos(a), sin(down), cos(down) * sin(a));\n"
                          "{}{}"
                          "    float above = 0.0, below = -1.0;\n"
                          "    for (int k = 1; k <= 8192 && below < 0.0; ++k) {{\n"
                          "        float t = end * float(k) / 8192.0;\n"
                          "        vec3 q = ro + t * rd;\n"
                          "        if (q.y <= height(q.xz)) below = t;\n"
                          "        else above = t;\n"
                          "    }}\n"
                          "    for (int k = 0; k < 24 && below > 0.0; ++k) {{\n"
                          "        float t = 0.5 * (above + below);\n"
                          "        vec3 q = ro + t * rd;\n"
                          "        if (q.y <= height(q.xz)) below = t; else above = t;\n"
                          "    }}\n"
                          "    if (found > end + 0.05) found = -1.0;\n"
                          "    c = vec4(found, evaluations, below, end);\n"
                          "}}\n",
                          field.scene, field.height, field.start, field.hit),
              {.size = {kSide, kSide}, .specialise = false}) {}

    // So many pictures' rays at each angle, as one case.
    void see(const std::string& look, double time, unsigned seed, unsigned pictures,
             const std::vector<Worst*>& seen) {
        set_look(player_, look);
        player_.renderer().reset();
        for (const double degrees : {-20.0, -5.0, -1.5}) {
            Counts all;
            for (unsigned k = 0; k < pictures; ++k) {
                Frame frame = player_.frame(0);
                frame.time = time;
                frame.longest_catch_up = 1.0;  // s, of what is simulated
                frame.input.mouse = {static_cast<float>(degrees), static_cast<float>(seed + k), 0,
                                     0};
                player_.draw(frame);
                count(all);
            }
            const std::string where =
                fmt::format("{} at {:.6g} s, {} degrees, rays {}", look, time, degrees, seed);
            seen[0]->see(100.0 * all.wrong / std::max(all.hits, 1.0), where);
            seen[1]->see(100.0 * all.flipped / all.rays, where);
            seen[2]->see(all.evaluations / all.rays + field_.finish, where);
            seen[3]->see(100.0 * all.capped / all.rays, where);
        }
    }
    const Scene& scene() const { return player_.preset.scene; }
    std::vector<Worst*> bars() { return {&wrong_, &flipped_, &evaluations_, &capped_}; }

private:
    struct Counts {
        double rays = 0, hits = 0, wrong = 0, flipped = 0, capped = 0, evaluations = 0;
    };
    void count(Counts& all) {
        const std::vector<float> values = player_.floats();
        const auto& tweaks = scene().tweaks;
        const auto steps =
            static_cast<std::size_t>(&tweak_of(scene(), field_.steps) - tweaks.data());
        const auto most = static_cast<float>(player_.preset.values[steps][0]);
        for (std::size_t i = 0; i < values.size(); i += 4) {
            const float found = values[i], truth = values[i + 2];
            all.rays += 1.0;
            all.hits += truth > 0.0f;
            all.flipped += (found >= 0.0f) != (truth > 0.0f);
            all.wrong += found >= 0.0f && truth > 0.0f && std::abs(found - truth) > 0.05f;
            all.evaluations += values[i + 1];
            all.capped += values[i + 1] >= most;
        }
    }

    const Field& field_;
    Player player_;
    Bar wrong_{"Q11 " + field_.scene + ": rays over 5 cm off, % of hits", 0.5};
    Bar flipped_{"Q11 " + field_.scene + ": rays that hit or miss wrongly, %", 0.5};
    Bar evaluations_{"Q11 " + field_.scene + ": evaluations a ray", 32.0};
    Bar capped_{"Q11 " + field_.scene + ": rays out of steps, %", 0.1};
};

class Marches : public GlTest, public testing::WithParamInterface<Field> {};

TEST_P(Marches, MeetWhatShortStepsMeet) {
    Rays rays(GetParam());
    rays.see(GetParam().worst, GetParam().worst_time, 1, 1, rays.bars());
}
TEST_P(Marches, MeetItWhateverTheTweaks) {
    const Field& field = GetParam();
    Rays rays(field);
    search_worst_share(numbers_of(rays.scene(), field.tweaks) + 1, 72, rays.bars(),
                       [&](Dials& dials, unsigned times, const std::vector<Worst*>& bars) {
                           const std::string look = look_at(rays.scene(), field.tweaks, dials);
                           const double time = dials.between(0.0, field.longest_time);
                           rays.see(look, time, dials.number, times, bars);
                       });
}
INSTANTIATE_TEST_SUITE_P(Scenes, Marches, testing::ValuesIn(kFields),
                         [](const auto& field) { return field.param.scene; });

}  // namespace
}  // namespace glint::marches_test
