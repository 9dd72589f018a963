// Spheres, discs, cylinders, cones, ellipsoids and the torus of the laboratory, each by its robust
// and its textbook form, against long double arithmetic on the same floats.
//
// Bars. Sphere: at a distance of 1e4 radii at most 0.02 % of the rays may flip between hit and
// miss; the direction's own rounding moves a ray by some 3e-4 radii there. The others share the
// sphere's recipe (numbers of the shape's own size), so they get the same bar at 1e4, and 1e-6 for
// the distance, some ten roundings. The textbook forms must be a hundred times worse, or these rays
// would prove nothing.
#include "intersections.h"

#include "worst_case.h"

#include <array>

namespace glint::intersections_test {
namespace {

using Intersections = GlTest;

constexpr std::size_t kRays = 98304;

struct Shape {
    std::string name;
    std::string robust,
        textbook;  // GLSL of a.xyz (start, in the shape's frame) and b.xyz (direction)
    double size;
    std::function<Real(const Real3&, const Real3&)> truth;
};

Real unlimited(Real a, Real b, Real c) {
    return first_root(a, b, c, [](Real) { return true; });
}

Real sphere(const Real3& o, const Real3& d, Real r) {
    return unlimited(glm::dot(d, d), glm::dot(o, d), glm::dot(o, o) - r * r);
}
Real ellipsoid(const Real3& o, const Real3& d, const Real3& axes) {
    const Real3 u = o / axes, v = d / axes;
    return unlimited(glm::dot(v, v), glm::dot(u, v), glm::dot(u, u) - 1.0L);
}
Real cylinder(const Real3& o, const Real3& d, Real r, Real h) {
    return first_root(d.x * d.x + d.z * d.z, o.x * d.x + o.z * d.z, o.x * o.x + o.z * o.z - r * r,
                      [&](Real t) { return std::abs(o.y + t * d.y) <= h; });
}
Real cone(const Real3& o, const Real3& d, Real slope, Real h) {
    const Real k = slope * slope;
    return first_root(d.x * d.x + d.z * d.z - k * d.y * d.y, o.x * d.x + o.z * d.z - k * o.y * d.y,
                      o.x * o.x + o.z * o.z - k * o.y * o.y, [&](Real t) {
                          const Real y = o.y + t * d.y;
                          return y >= -h && y <= 0.0L;
                      });
}
Real disc(const Real3& o, const Real3& d, const Real3& normal, Real r) {
    const Real t = -glm::dot(o, normal) / glm::dot(d, normal);
    const Real3 p = o + t * d;
    return t > 0.0L && glm::dot(p, p) <= r * r ? t : kMiss;
}

// All roots of a polynomial (constant first) in an interval: the derivative's roots part it into
// pieces with at most one, which bisection finds.
std::vector<Real> roots_of(const std::vector<Real>& c, Real low, Real high) {
    const auto at = [&](Real t) {
        Real sum = 0.0L;
        for (std::size_t i = c.size(); i-- > 0;) sum = sum * t + c[i];
        return sum;
    };
    std::vector<Real> ends{low};
    if (c.size() > 2) {
        std::vector<Real> slope;
        for (std::size_t i = 1; i < c.size(); ++i) slope.push_back(c[i] * static_cast<Real>(i));
        for (const Real t : roots_of(slope, low, high)) ends.push_back(t);
    }
    ends.push_back(high);
    std::vector<Real> roots;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        Real a = ends[i], b = ends[i + 1];
        const Real sign = at(a);
        if (sign * at(b) > 0.0L) continue;
        for (int k = 0; k < 90; ++k) {
            const Real m = 0.5L * (a + b);
            (at(m) * sign > 0.0L ? a : b) = m;
        }
        roots.push_back(0.5L * (a + b));
    }
    return roots;
}
Real torus(const Real3& start, const Real3& d, Real large, Real small) {
    const Real dd = glm::dot(d, d), slid = -glm::dot(start, d) / dd;
    const Real3 o = start + slid * d;  // in long double nothing is lost by it
    const Real m = glm::dot(o, d), k = glm::dot(o, o) + large * large - small * small;
    const Real g = 4.0L * large * large;
    const auto xz = [](const Real3& u, const Real3& v) { return u.x * v.x + u.z * v.z; };
    const std::vector<Real> quartic = {k * k - g * xz(o, o), 4.0L * m * k - 2.0L * g * xz(o, d),
                                       4.0L * m * m + 2.0L * k * dd - g * xz(d, d), 4.0L * m * dd,
                                       dd * dd};
    for (const Real t : roots_of(quartic, -2.0L * (large + small), 2.0L * (large + small))) {
        if (t + slid > 0.0L) return t + slid;
    }
    return kMiss;
}

const std::vector<Shape> kShapes = {
    {"sphere", "intersectSphere(a.xyz, b.xyz, vec3(0), 1.0)", "textbookSphere(a.xyz, b.xyz, 1.0)",
     1.0, [](const Real3& o, const Real3& d) { return sphere(o, d, 1.0L); }},
    {"ellipsoid", "robustEllipsoid(a.xyz, b.xyz, vec3(0.5, 1, 0.75))",
     "textbookEllipsoid(a.xyz, b.xyz, vec3(0.5, 1, 0.75))", 1.0,
     [](const Real3& o, const Real3& d) {
         return ellipsoid(o, d, {0.5L, 1.0L, 0.75L});
     }},
    {"cylinder", "robustCylinder(a.xyz, b.xyz, 0.5, 1.0)",
     "textbookCylinder(a.xyz, b.xyz, 0.5, 1.0)", 1.0,
     [](const Real3& o, const Real3& d) { return cylinder(o, d, 0.5L, 1.0L); }},
    {"cone", "robustCone(a.xyz, b.xyz, 0.5, 1.0)", "textbookCone(a.xyz, b.xyz, 0.5, 1.0)", 1.0,
     [](const Real3& o, const Real3& d) { return cone(o, d, 0.5L, 1.0L); }},
    {"disc", "robustDisc(a.xyz, b.xyz, vec3(0, 0.6, 0.8), 1.0)",
     "textbookDisc(a.xyz, b.xyz, vec3(0, 0.6, 0.8), 1.0)", 1.0,
     [](const Real3& o, const Real3& d) {
         return disc(o, d, Real3(glm::vec3(0.0f, 0.6f, 0.8f)), 1.0L);
     }},
    {"torus", "robustTorus(a.xyz, b.xyz, 1.0, 0.25)", "textbookTorus(a.xyz, b.xyz, 1.0, 0.25)",
     1.25, [](const Real3& o, const Real3& d) { return torus(o, d, 1.0L, 0.25L); }},
};

struct Answers {
    Comparison robust, textbook;
};
Answers answers_of(const Shape& shape, const std::vector<FloatRay>& rays) {
    std::vector<ProbeCase> cases;
    std::vector<Real> truth;
    for (const FloatRay& ray : rays) {
        cases.push_back({.a = glm::vec4(ray.ro, 0), .b = glm::vec4(ray.rd, 0)});
        truth.push_back(shape.truth(Real3(ray.ro), Real3(ray.rd)));
    }
    const auto both =
        probe_all(kAnalytic, fmt::format("vec2({}, {})", shape.robust, shape.textbook), cases);
    return {compare(truth, [&](std::size_t i) { return Real{both[i].x}; }),
            compare(truth, [&](std::size_t i) { return Real{both[i].y}; })};
}

std::vector<FloatRay> rays_at(double distance, double size, std::size_t count) {
    Random random{std::mt19937(static_cast<std::uint32_t>(distance))};
    std::vector<FloatRay> rays;
    while (rays.size() < count) {
        rays.push_back(ray_through(random, random.in_box(glm::dvec3(1.2 * size)), distance * size));
    }
    return rays;
}

TEST_F(Intersections, HitsAndDistancesHoldFromNearToTenThousandRadii) {
    for (const Shape& shape : kShapes) {
        for (const double distance : {4.0, 100.0, 1e4}) {
            const Answers at = answers_of(shape, rays_at(distance, shape.size, kRays));
            print_row(fmt::format("{}, distance {:g}", shape.name, distance), at.robust,
                      at.textbook);
            EXPECT_GT(at.robust.hits, kRays / 20) << shape.name;
            EXPECT_LE(at.robust.flips, 2e-4) << shape.name << " at " << distance;
            EXPECT_LE(at.robust.p99, 5e-7) << shape.name << " at " << distance;
            EXPECT_EQ(at.robust.not_finite, 0u) << shape.name << " at " << distance;
            if (distance < 1e4 || shape.name == "disc") continue;  // a disc has little to cancel
            EXPECT_GE(at.textbook.flips, 0.02) << shape.name << ": the textbook form breaks here";
            EXPECT_GE(at.textbook.p99, 1e-4) << shape.name;
        }
    }
}

// From within a shape, and beside it, a ray meets the far side or nothing. Starts nearer to the
// surface than a few roundings may count as either side of it: 0.01 % of the rays.
TEST_F(Intersections, RaysThatStartInsideMeetTheFarSide) {
    for (const Shape& shape : kShapes) {
        Random random{std::mt19937(7)};
        std::vector<FloatRay> rays;
        while (rays.size() < kRays / 2) {
            rays.push_back({.ro = glm::vec3(random.in_box(glm::dvec3(shape.size))),
                            .rd = glm::vec3(random.direction())});
        }
        const Answers at = answers_of(shape, rays);
        print_row(shape.name + ", from inside", at.robust, at.textbook);
        EXPECT_LE(at.robust.flips, 1e-4) << shape.name;
        // Relative to a distance that may be far below the shape's size.
        EXPECT_LE(at.robust.p99, 2e-5) << shape.name;
        EXPECT_EQ(at.robust.not_finite, 0u) << shape.name;
    }
}

// Q3: spheres of a millimetre to a kilometre, near the origin and a thousand radii from it, seen
// from 4 to 1e4 radii away.
TEST_F(Intersections, SpheresHoldWhateverTheCase) {
    Bar flips("Q3 sphere: share of rays that flip between hit and miss", 2e-4);
    Bar distances("Q3 sphere: relative error of the distance, 99 % are below", 5e-7);
    const auto try_one = [&](Dials& dials, unsigned times, const std::vector<Worst*>& bars) {
        Random random{std::mt19937(dials.number)};
        const auto radius = static_cast<float>(dials.between_logs(1e-3, 1e3));
        const double away = dials.between_logs(4.0, 1e4) * radius;
        const glm::vec3 centre(random.direction() * dials.between_logs(1e-2, 1e3) * double{radius});
        std::vector<ProbeCase> cases;
        std::vector<Real> truth;
        while (cases.size() < 32768 * times) {
            const FloatRay ray = ray_through(
                random, glm::dvec3(centre) + random.in_box(glm::dvec3(1.2 * radius)), away);
            cases.push_back({.a = glm::vec4(ray.ro, 0),
                             .b = glm::vec4(ray.rd, 0),
                             .c = glm::vec4(centre, radius)});
            truth.push_back(sphere(Real3(ray.ro) - Real3(centre), Real3(ray.rd), Real{radius}));
        }
        const auto t = probe_all(kAnalytic, "intersectSphere(a.xyz, b.xyz, c.xyz, c.w)", cases);
        const Comparison found = compare(truth, [&](std::size_t i) { return Real{t[i].x}; });
        const std::string where =
            fmt::format("radius {:.3g} at {:.3g}, from {:.3g}", radius, glm::length(centre), away);
        EXPECT_GT(found.hits, cases.size() / 20) << where;
        bars[0]->see(found.flips, where);
        bars[1]->see(found.p99, where);
    };
    search_worst_share(3, 60, {&flips, &distances}, try_one);
}

// Rays with zeros in them, along axes, through the apex, in the plane of the disc: a number always,
// and never a hit where there is none by a clear margin.
TEST_F(Intersections, SpecialRaysGiveNumbers) {
    const std::array starts = {-2.0f, -1.0f, -0.5f, -0.0f, 0.0f, 0.25f, 0.5f, 1.0f, 2.0f};
    const std::array steps = {-1.0f, -0.0f, 0.0f, 1e-30f, 1e-12f, 1.0f};
    std::vector<FloatRay> rays;
    for (const float x : starts)
        for (const float y : starts)
            for (const float z : starts)
                for (const float u : steps)
                    for (const float v : steps)
                        for (const float w : steps) {
                            const glm::vec3 d(u, v, w);
                            if (glm::length(d) < 0.5f) continue;
                            rays.push_back({.ro = {x, y, z}, .rd = glm::normalize(d)});
                        }
    for (const Shape& shape : kShapes) {
        std::vector<ProbeCase> cases;
        for (const FloatRay& ray : rays) {
            cases.push_back({.a = glm::vec4(ray.ro, 0), .b = glm::vec4(ray.rd, 0)});
        }
        const auto t = probe_all(kAnalytic, shape.robust, cases);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_TRUE(std::isfinite(t[i].x)) << shape.name << " case " << i;
            if (t[i].x <= 0.0f) continue;
            const Real3 p = Real3(rays[i].ro) + Real{t[i].x} * Real3(rays[i].rd);
            ASSERT_LE(glm::length(p), Real{shape.size} * 1.4143L) << shape.name << " case " << i;
        }
    }
}

}  // namespace
}  // namespace glint::intersections_test
