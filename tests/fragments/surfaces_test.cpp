// Surfaces of the laboratory: rays that leave them, and their normals, with the eye near and far.
//
// Bars. A hit is moved back onto its surface and lifted by some 8 ulp (16 at most), so that a ray
// that leaves meets its own surface again in no more than 0.01 % of the cases, with the eye up to
// 1e6 m away. Normals are right to 0.01 degrees (RMS) for an eye up to 1e3 m away, although the
// distance itself is rounded to 6e-5 m there: the hit is made good near the surface. 0.0003 degrees
// are a few roundings of a normal's own digits, and no more is allowed, near or far.
#include "intersections.h"
#include "worst_case.h"

#include <array>

namespace glint::surfaces_test {
namespace {

using Surfaces = GlTest;

const std::string kLeave =
    // First and second thing met, the way between, the lift in ulp; outwards or, for glass,
    // inwards.
    "vec4 probe_leave(vec3 ro, vec3 rd, vec3 chance, float cosine, float sense, bool by_recipe) {\n"
    "    Hit h = meetScene(ro, rd);\n"
    "    vec3 p = ro + h.t * rd, q = p, nor = by_recipe ? arrive(ro, rd, h, q) : settle(h, q);\n"
    "    nor *= h.id == kMirrorId && dot(rd, nor) > 0.0 ? -sense : sense;\n"
    "    vec3 side = unit(chance - dot(chance, nor) * nor);\n"
    "    vec3 away = unit(cosine * nor + sqrt(1.0 - cosine * cosine) * side);\n"
    "    vec3 start = by_recipe ? liftOff(q, nor) : p + kTextbookLift * nor;\n"
    "    Hit g = meetScene(start, away);\n"
    // At an edge of glass the way to the next face may be nothing; that is another surface.
    "    if (sense < 0.0 && dot(unit(h.face), unit(g.face)) < 0.99 && h.id != kBallId) g.t = 1.0;\n"
    "    float ulp = max(maxComponent(abs(q)), 0.1) * 1.1920929e-7;\n"
    "    return vec4(h.id, g.id, g.t, by_recipe ? length(start - q) / ulp : 0.0);\n"
    "}\n";

struct Ids {
    int wall, ring, ball, gem, cube, floor;
};
Ids ids() {
    const std::vector<ProbeCase> one(1);
    const glm::vec4 a = probe(kAnalytic, "vec4(kWallId, kRingId, kBallId, kGemId)", one)[0];
    const glm::vec4 b = probe(kAnalytic, "vec2(kCubeId, kFloorId)", one)[0];
    return {.wall = static_cast<int>(a.x),
            .ring = static_cast<int>(a.y),
            .ball = static_cast<int>(a.z),
            .gem = static_cast<int>(a.w),
            .cube = static_cast<int>(b.x),
            .floor = static_cast<int>(b.y)};
}

// A ray from above towards some point of the set.
FloatRay ray_to_set(Random& random, double distance) {
    const glm::dvec3 target(random.uniform(-2.5, 3.5), random.uniform(0.0, 2.6),
                            random.uniform(-3.0, 2.0));
    glm::dvec3 from = random.direction();
    from.y = std::abs(from.y) + 0.05;
    const glm::vec3 ro(target + distance * glm::normalize(from));
    return {ro, glm::vec3(glm::normalize(target - glm::dvec3(ro)))};
}

// What rays met that left a surface seen from `distance` (m).
struct Leaving {
    double own = 0.0;       // share that met the surface they left
    double textbook = 0.0;  // the same with a lift of 1e-3 m
    float lift = 0.0f;      // the largest, in ulp
};
Leaving leaving(Random& random, double distance, const Ids& id) {
    std::vector<ProbeCase> cases;
    while (cases.size() < 32768) {
        const FloatRay ray = ray_to_set(random, distance);
        const auto cosine = static_cast<float>(std::pow(10.0, random.uniform(-1.7, 0.0)));
        const float sense = random.uniform(0.0, 1.0) < 0.5 ? 1.0f : -1.0f;
        cases.push_back({.a = glm::vec4(ray.ro, cosine),
                         .b = glm::vec4(ray.rd, sense),
                         .c = glm::vec4(random.direction(), 0)});
    }
    Leaving result;
    for (const bool recipe : {true, false}) {
        const auto met =
            probe_all(kAnalytic + kLeave,
                      fmt::format("probe_leave(a.xyz, b.xyz, c.xyz, a.w, b.w, {})", recipe), cases);
        std::size_t left = 0, own = 0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const auto first = static_cast<int>(met[i].x), second = static_cast<int>(met[i].y);
            const bool glass = first == id.ball || first == id.gem || first == id.cube;
            if (cases[i].b.w < 0.0f && !glass) continue;  // nothing goes into what is opaque
            ++left;
            result.lift = std::max(result.lift, met[i].w);
            if (first != second) continue;
            // Hollow shapes may meet themselves farther on, and glass its far side: what counts
            // there is a way no longer than some lifts seen at this slope.
            const bool may = first == id.ring || first == id.wall || cases[i].b.w < 0.0f;
            if (!may || met[i].z < 4e-6f / cases[i].a.w) ++own;
        }
        (recipe ? result.own : result.textbook) =
            static_cast<double>(own) / static_cast<double>(left);
    }
    return result;
}

struct Q6 {
    Bar own{"Q6 analytic: share of rays that meet what they leave", 1e-4};
    Bar lift{"Q6 analytic: lift, ulp", 16.0};
    const Ids id = ids();

    void see(double distance, std::uint32_t seed) {
        Random random{std::mt19937(seed)};
        const Leaving rays = leaving(random, distance, id);
        const std::string where = fmt::format("eye at {:.4g} m", distance);
        own.see(rays.own, where);
        lift.see(double{rays.lift}, where);
        if (distance >= 1e6) {
            EXPECT_GE(rays.textbook, 0.1) << "a fixed offset drowns, or this proves nothing";
        }
    }
};
TEST_F(Surfaces, RaysThatLeaveDoNotMeetWhatTheyLeave) {
    Q6 bars;
    for (const double distance : {10.0, 1e2, 1e3, 1e4, 1e6})
        bars.see(distance, static_cast<std::uint32_t>(distance) + 1);
}
TEST_F(Surfaces, RaysLeaveWhateverTheCase) {
    Q6 bars;
    search_worst(1, 40, {&bars.own, &bars.lift},
                 [&](Dials& dials) { bars.see(dials.between_logs(4.0, 1e6), dials.number); });
}

// The surfaces again, as implicit functions in long double, with the shader's own constants.
struct Implicit {
    std::string name;
    float id;
    std::function<Real(const Real3&)> value;
    Real3 tip{1e9L};  // where it has no normal
};
Real3 gradient(const Implicit& shape, const Real3& p) {
    constexpr Real kStep = 1e-6L;
    Real3 sum(0.0L);
    for (int k = 0; k < 3; ++k) {
        Real3 more = p, less = p;
        more[k] += kStep;
        less[k] -= kStep;
        sum[k] = shape.value(more) - shape.value(less);
    }
    return glm::normalize(sum);
}

std::vector<Implicit> implicit_shapes() {
    const std::vector<ProbeCase> one(1);
    const auto constant = [&](const char* what) { return probe(kAnalytic, what, one)[0]; };
    const auto real3 = [&](const char* what) { return Real3(glm::vec3(constant(what))); };
    const auto id = [&](const char* what) { return constant(what).x; };
    const glm::vec4 ball = constant("kBall"), ring = constant("vec3(kRing, ringTurn())"),
                    drum = constant("kDrum"), cone = constant("kCone");
    const Real3 egg = real3("kEggCentre"), axes = real3("kEggAxes"), at_ring = real3("kRingCentre"),
                at_drum = real3("kDrumCentre"), apex = real3("kConeApex");
    return {
        {"ball", id("float(kBallId)"),
         [=](const Real3& p) { return glm::length(p - Real3(glm::vec3(ball))) - Real{ball.w}; }},
        {"ellipsoid", id("float(kEggId)"),
         [=](const Real3& p) { return glm::length((p - egg) / axes) - 1.0L; }},
        {"cylinder", id("float(kDrumId)"),
         [=](const Real3& p) {
             return std::hypot(p.x - at_drum.x, p.z - at_drum.z) - Real{drum.x};
         }},
        {"cone", id("float(kConeId)"),
         [=](const Real3& p) {
             return std::hypot(p.x - apex.x, p.z - apex.z) + Real{cone.x} * (p.y - apex.y);
         },
         apex},
        {"torus", id("float(kRingId)"),
         [=](const Real3& p) {
             const Real3 f = p - at_ring;
             const Real c = std::cos(Real{ring.z}), s = std::sin(Real{ring.z});
             const Real x = c * f.x + s * f.z, axis = c * f.z - s * f.x;
             return std::hypot(std::hypot(x, f.y) - Real{ring.x}, axis) - Real{ring.y};
         }},
    };
}

// The true hit near o + t d, by Newton's steps.
Real3 true_hit(const Implicit& shape, const Real3& o, const Real3& d, Real t) {
    for (int k = 0; k < 20; ++k) {
        const Real slope =
            (shape.value(o + (t + 1e-6L) * d) - shape.value(o + (t - 1e-6L) * d)) / 2e-6L;
        t -= std::clamp(shape.value(o + t * d) / slope, -0.01L, 0.01L);
    }
    return o + t * d;
}

void expect_true_normals(double distance, std::uint32_t seed, const std::vector<Implicit>& shapes,
                         Bar& normals) {
    const std::string functions =
        "vec4 probe_normal(vec3 ro, vec3 rd) {\n"
        "    Hit h = meetScene(ro, rd);\n"
        "    vec3 q, nor = arrive(ro, rd, h, q);\n"
        "    return vec4(nor, h.id);\n"
        "}\n";
    Random random{std::mt19937(seed)};
    std::vector<FloatRay> rays;
    std::vector<ProbeCase> cases;
    while (rays.size() < 65536) {
        rays.push_back(ray_to_set(random, distance));
        cases.push_back({.a = glm::vec4(rays.back().ro, 0), .b = glm::vec4(rays.back().rd, 0)});
    }
    const auto found = probe_all(kAnalytic + functions, "probe_normal(a.xyz, b.xyz)", cases);
    const auto ways = probe_all(kAnalytic, "meetScene(a.xyz, b.xyz).t", cases);
    for (const Implicit& shape : shapes) {
        double squares = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (found[i].w != shape.id) continue;
            const Real3 o(rays[i].ro), d(rays[i].rd);
            const Real3 hit = true_hit(shape, o, d, Real{ways[i].x}), truth = gradient(shape, hit);
            if (std::abs(glm::dot(truth, d)) < 0.5L) continue;    // towards the limb a hit slides
            if (glm::distance(hit, shape.tip) < 0.02L) continue;  // m; a micrometre turns it there
            const Real sine = glm::length(glm::cross(truth, Real3(glm::vec3(found[i]))));
            const double error =
                static_cast<double>(std::asin(std::min(sine, 1.0L))) * 180.0 / std::numbers::pi;
            squares += error * error;
            ++count;
        }
        ASSERT_GT(count, 200u) << shape.name;
        normals.see(std::sqrt(squares / static_cast<double>(count)),
                    fmt::format("{}, eye at {:.4g} m", shape.name, distance));
    }
}
constexpr double kMostDegrees = 3e-4;
constexpr const char* kNormals = "Q10 analytic: normals, degrees RMS";
TEST_F(Surfaces, NormalsAreRightForAnEyeUpToAKilometreAway) {
    Bar normals(kNormals, kMostDegrees);
    const std::vector<Implicit> shapes = implicit_shapes();
    for (const double distance : {10.0, 1e2, 1e3})
        expect_true_normals(distance, static_cast<std::uint32_t>(distance) + 3, shapes, normals);
}
TEST_F(Surfaces, NormalsAreRightWhateverTheCase) {
    Bar normals(kNormals, kMostDegrees);
    const std::vector<Implicit> shapes = implicit_shapes();
    search_worst(1, 16, {&normals}, [&](Dials& dials) {
        expect_true_normals(dials.between_logs(4.0, 1e3), dials.number, shapes, normals);
    });
}

}  // namespace
}  // namespace glint::surfaces_test
