// Triangles: the crystal of the laboratory and single triangles, by watertight edge functions
// (Woop, Benthin and Wald 2013) and by Cramer's rule.
//
// Bars. A ray that is aimed at an edge or a corner between two faces that both look at it passes
// one of them: of 1e5 rays to edges and 1e5 to corners none may slip between. In slivers a
// ten-thousandth as high as long 99 % of the distances are right to 1e-5, seen from any side, and
// to 2 ulp over the cosine of incidence: a ray's own rounding moves its hit by half of one. A
// triangle without area is a miss and never NaN.
#include "intersections.h"
#include "worst_case.h"

#include <array>

namespace glint::triangles_test {
namespace {

using Triangles = GlTest;

const std::string kFirstHit =
    "vec2 probe_gem(vec3 ro, vec3 rd, bool by_robust) {\n"  // distance; which side it shows
    "    robust = by_robust;\n"
    "    Hit h = Hit(kFar, -1, vec3(0.0));\n"
    "    meetGem(ro, rd, h);\n"
    "    return vec2(h.t, sign(dot(h.face, rd)));\n"
    "}\n"
    "float probe_woop(vec3 rd, vec3 a, vec3 b, vec3 c) {\n"
    "    Shear q = shearAlong(rd);\n"
    "    a = sheared(a, q); b = sheared(b, q); c = sheared(c, q);\n"
    "    return robustTriangle(a, b, c) < kFar ? exactDistance(a, b, c) : kFar;\n"
    "}\n";

// The crystal's mesh as the shader has it: 12 corners, 20 faces with outward winding.
struct Mesh {
    std::vector<glm::dvec3> corners;
    std::vector<std::array<int, 3>> faces;
};
Mesh crystal() {
    std::vector<ProbeCase> cases;
    for (int k = 0; k < 10; ++k) cases.push_back({.a = {k % 5, k < 5 ? 1 : -1, 0, 0}});
    const auto rings = probe(kAnalytic, "gemCorner(int(a.x), a.y)", cases);
    const std::vector<ProbeCase> one(1);
    const double size = probe(kAnalytic, "kGemSize", one)[0].x;
    Mesh mesh;
    for (const glm::vec4& corner : rings) mesh.corners.emplace_back(glm::vec3(corner));
    mesh.corners.emplace_back(0.0, size, 0.0);
    mesh.corners.emplace_back(0.0, -size, 0.0);
    for (int k = 0; k < 5; ++k) {
        const int a = k, b = k + 5, c = (k + 1) % 5, d = (k + 1) % 5 + 5;
        mesh.faces.push_back({10, a, c});
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({b, d, c});
        mesh.faces.push_back({11, d, b});
    }
    return mesh;
}
glm::dvec3 normal_of(const Mesh& mesh, const std::array<int, 3>& f) {
    const auto& c = mesh.corners;
    return glm::cross(c[static_cast<std::size_t>(f[1])] - c[static_cast<std::size_t>(f[0])],
                      c[static_cast<std::size_t>(f[2])] - c[static_cast<std::size_t>(f[1])]);
}

// Where a ray enters and leaves the convex mesh.
struct Span {
    Real near = -1e30L, far = 1e30L;
};
Span span_of(const Mesh& mesh, const Real3& o, const Real3& d) {
    Span span;
    for (const auto& face : mesh.faces) {
        const Real3 n(normal_of(mesh, face));
        const Real3 corner(mesh.corners[static_cast<std::size_t>(face[0])]);
        const Real speed = glm::dot(n, d), t = glm::dot(n, corner - o) / speed;
        if (speed < 0.0L) span.near = std::max(span.near, t);
        if (speed > 0.0L) span.far = std::min(span.far, t);
    }
    return span;
}

// Rays to points that lie on an edge (or corner) whose faces all look at the ray's start.
std::vector<FloatRay> rays_to(const Mesh& mesh, bool corners, double distance, std::size_t count,
                              unsigned seed = 5) {
    Random random{std::mt19937(corners ? seed + 6 : seed)};
    const double slack = 3e-7 * distance;  // m, that a ray is rounded by
    std::vector<FloatRay> rays;
    while (rays.size() < count) {
        const auto& face = mesh.faces[rays.size() % mesh.faces.size()];
        const auto a = static_cast<std::size_t>(face[0]), b = static_cast<std::size_t>(face[1]);
        const double s = corners ? 0.0 : random.uniform(0.0, 1.0);
        const glm::dvec3 target = mesh.corners[a] + s * (mesh.corners[b] - mesh.corners[a]);
        const FloatRay ray = ray_through(random, target, distance);
        bool all_look = true;
        for (const auto& other : mesh.faces) {
            const glm::dvec3 n = glm::normalize(normal_of(mesh, other));
            const auto first = static_cast<std::size_t>(other[0]);
            const bool touches = std::abs(glm::dot(n, target - mesh.corners[first])) < 1e-6 + slack;
            if (touches && glm::dot(n, glm::dvec3(ray.rd)) > -0.1) all_look = false;
        }
        if (all_look) rays.push_back(ray);
    }
    return rays;
}

TEST_F(Triangles, NothingLeaksAtEdgesAndCornersOfAClosedMesh) {
    constexpr std::size_t kRays = 100000;
    const Mesh mesh = crystal();
    double textbook_leaks = 0.0;
    for (const bool corners : {false, true}) {
        for (const double distance : {2.0, 50.0}) {
            const auto rays = rays_to(mesh, corners, distance, kRays);
            std::vector<ProbeCase> cases;
            for (const FloatRay& ray : rays) {
                cases.push_back({.a = glm::vec4(ray.ro, 0), .b = glm::vec4(ray.rd, 0)});
            }
            const auto t = probe_all(
                kAnalytic + kFirstHit,
                "vec4(probe_gem(a.xyz, b.xyz, true), probe_gem(a.xyz, b.xyz, false))", cases);
            std::size_t leaks = 0, textbook = 0, backs = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Real near = span_of(mesh, Real3(rays[i].ro), Real3(rays[i].rd)).near;
                // Through a gap the ray would meet the far side, or nothing.
                if (!(std::abs(t[i].x - near) < 1e-4L * near)) ++leaks;
                if (!(std::abs(t[i].z - near) < 1e-4L * near)) ++textbook;
                if (t[i].y >= 0.0f) ++backs;
            }
            fmt::print("{} from {:g} m: robust {} leaks of {}, textbook {:.3f} %\n",
                       corners ? "corners" : "edges", distance, leaks, kRays,
                       100.0 * static_cast<double>(textbook) / static_cast<double>(kRays));
            EXPECT_EQ(leaks, 0u);
            EXPECT_EQ(backs, 0u) << "every first face looks at the ray";
            textbook_leaks = std::max(textbook_leaks, static_cast<double>(textbook) / kRays);
        }
    }
    EXPECT_GE(textbook_leaks, 0.01) << "Cramer's rule leaks, or these rays prove nothing";
}

// Q4: from just before the crystal to 500 m away, with other rays each.
TEST_F(Triangles, NothingLeaksWhateverTheCase) {
    const Mesh mesh = crystal();
    Bar leaks("Q4 crystal: rays of 20,000 that slip between faces", 0.0);
    search_worst(2, 48, {&leaks}, [&](Dials& dials) {
        const double distance = dials.between_logs(0.8, 500.0);
        const bool corners = dials.share() >= 0.5;
        const auto rays = rays_to(mesh, corners, distance, 20000, 100 + dials.number);
        std::vector<ProbeCase> cases;
        for (const FloatRay& ray : rays)
            cases.push_back({.a = glm::vec4(ray.ro, 0), .b = glm::vec4(ray.rd, 0)});
        const auto t = probe_all(kAnalytic + kFirstHit, "probe_gem(a.xyz, b.xyz, true)", cases);
        int through = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Real near = span_of(mesh, Real3(rays[i].ro), Real3(rays[i].rd)).near;
            through += !(std::abs(t[i].x - near) < 1e-4L * near);
        }
        leaks.see(through,
                  fmt::format("{} from {:.4g} m", corners ? "corners" : "edges", distance));
    });
}

// The sign of ray . (AB x BC): entering shows a front, leaving a back.
TEST_F(Triangles, RaysFromInsideShowTheBacksOfFaces) {
    const Mesh mesh = crystal();
    Random random{std::mt19937(3)};
    std::vector<ProbeCase> cases;
    std::vector<Real> truth;
    while (cases.size() < 16384) {
        const glm::vec3 ro(random.in_box(glm::dvec3(0.2))), rd(random.direction());
        cases.push_back({.a = glm::vec4(ro, 0), .b = glm::vec4(rd, 0)});
        truth.push_back(span_of(mesh, Real3(ro), Real3(rd)).far);
    }
    const auto t = probe_all(kAnalytic + kFirstHit, "probe_gem(a.xyz, b.xyz, true)", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ASSERT_NEAR(t[i].x, static_cast<double>(truth[i]), 2e-6) << i;
        ASSERT_GT(t[i].y, 0.0f) << i;
    }
}

struct Corners {
    glm::vec3 a, b, c;
};
Real reference(const Corners& k, const glm::vec3& rd) {  // Cramer's rule in long double
    const Real3 a(k.a), d(rd), ab = Real3(k.b) - a, ac = Real3(k.c) - a, p = glm::cross(d, ac);
    const Real det = glm::dot(ab, p);
    if (det == 0.0L) return kMiss;
    const Real3 q = glm::cross(-a, ab);
    const Real u = glm::dot(-a, p) / det, v = glm::dot(d, q) / det;
    return u >= 0.0L && v >= 0.0L && u + v <= 1.0L ? glm::dot(ac, q) / det : kMiss;
}

TEST_F(Triangles, SliversKeepTheirDistance) {
    for (const double height : {1.0, 1e-2, 1e-4}) {
        Random random{std::mt19937(9)};
        std::vector<ProbeCase> cases;
        std::vector<Real> truth;
        std::vector<double> cosines;
        while (cases.size() < 49152) {
            const glm::dvec3 centre = 4.0 * random.direction(), along = random.direction();
            const glm::dvec3 up = glm::normalize(glm::cross(along, random.direction()));
            const Corners k{.a = glm::vec3(centre - 0.5 * along),
                            .b = glm::vec3(centre + 0.5 * along),
                            .c = glm::vec3(centre + height * up)};
            const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
            const glm::dvec3 target =
                glm::dvec3(k.a) + u * glm::dvec3(k.b - k.a) + v * glm::dvec3(k.c - k.a);
            const glm::vec3 rd(glm::normalize(target));
            const glm::dvec3 n = glm::normalize(
                glm::cross(glm::dvec3(k.b) - glm::dvec3(k.a), glm::dvec3(k.c) - glm::dvec3(k.a)));
            cosines.push_back(std::abs(glm::dot(n, glm::dvec3(rd))));
            cases.push_back({.a = glm::vec4(k.a, 0),
                             .b = glm::vec4(k.b, 0),
                             .c = glm::vec4(k.c, 0),
                             .d = glm::vec4(rd, 0)});
            truth.push_back(reference(k, rd));
        }
        const auto t = probe_all(kAnalytic + kFirstHit,
                                 "vec2(probe_woop(d.xyz, a.xyz, b.xyz, c.xyz),"
                                 "     textbookTriangle(vec3(0), d.xyz, a.xyz, b.xyz, c.xyz))",
                                 cases);
        const Comparison robust = compare(truth, [&](std::size_t i) { return Real{t[i].x}; });
        const Comparison textbook = compare(truth, [&](std::size_t i) { return Real{t[i].y}; });
        print_row(fmt::format("triangle, height {:g}", height), robust, textbook);
        std::vector<double> ulps;  // errors in what an ulp of the ray's direction moves the hit
        for (std::size_t i = 0; i < cases.size(); ++i) {
            if (truth[i] <= 0.0L || t[i].x > 1e29f) continue;
            const double error = static_cast<double>(std::abs(Real{t[i].x} / truth[i] - 1.0L));
            ulps.push_back(error * cosines[i] / 1.1920929e-7);
        }
        std::ranges::sort(ulps);
        const double most_ulps = ulps[ulps.size() * 99 / 100];
        fmt::print("  {:.2f} ulp / cosine\n", most_ulps);
        EXPECT_LE(most_ulps, 2.0);
        EXPECT_LE(robust.p99, 1e-5);
        EXPECT_EQ(robust.not_finite, 0u);
        if (height < 1e-3) {
            EXPECT_GE(textbook.p99, 1e-4) << "Cramer's rule loses the sliver";
        }
    }
}

// Mueller and Trumbore's usual epsilon loses every triangle whose edges are 1e-4; here nothing has
// a size.
TEST_F(Triangles, SizeDoesNotMatter) {
    Random random{std::mt19937(21)};
    for (const double size : {1e-8, 1e-4, 1.0, 1e6}) {
        std::vector<ProbeCase> cases;
        while (cases.size() < 4096) {
            const glm::dvec3 centre = 3.0 * size * random.direction();
            const auto corner = [&] { return glm::vec3(centre + size * random.direction()); };
            const glm::vec3 a = corner(), b = corner(), c = corner();
            const glm::dvec3 middle = (glm::dvec3(a) + glm::dvec3(b) + glm::dvec3(c)) / 3.0;
            cases.push_back({.a = glm::vec4(a, 0),
                             .b = glm::vec4(b, 0),
                             .c = glm::vec4(c, 0),
                             .d = glm::vec4(glm::normalize(middle), 0)});
        }
        const auto t =
            probe_all(kAnalytic + kFirstHit, "probe_woop(d.xyz, a.xyz, b.xyz, c.xyz)", cases);
        const auto lost = std::ranges::count_if(
            t, [](const glm::vec4& v) { return !(v.x > 0.0f && v.x < 1e29f); });
        EXPECT_EQ(lost, 0) << "edges of " << size;
    }
}

TEST_F(Triangles, WithoutAreaIsAMiss) {
    Random random{std::mt19937(2)};
    std::vector<ProbeCase> cases;
    while (cases.size() < 16000) {
        const glm::vec3 a(3.0 * random.direction()), b(3.0 * random.direction());
        const glm::vec3 middle = 0.5f * (a + b);
        const std::array<Corners, 4> flat = {Corners{a, a, b}, Corners{a, b, a}, Corners{b, a, a},
                                             Corners{a, a, a}};
        const Corners& k = flat[cases.size() % 4];
        // Straight at it, where the shear maps all on one line through the ray.
        const glm::vec3 rd = glm::normalize(cases.size() % 8 < 4 ? middle : a);
        cases.push_back({.a = glm::vec4(k.a, 0),
                         .b = glm::vec4(k.b, 0),
                         .c = glm::vec4(k.c, 0),
                         .d = glm::vec4(rd, 0)});
    }
    const auto t =
        probe_all(kAnalytic + kFirstHit, "probe_woop(d.xyz, a.xyz, b.xyz, c.xyz)", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) ASSERT_EQ(t[i].x, 1e30f) << i;
}

}  // namespace
}  // namespace glint::triangles_test
