// What the probes of fragments/analytic.frag share: the scene's text, rays, and how answers
// compare.
#pragma once

#include "probe.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace glint {

using Real = long double;
using Real3 = glm::vec<3, Real>;

// The scene itself: what is tested is what is drawn.
inline const std::string kAnalytic = "#include \"" GLINT_REPOSITORY "/fragments/analytic.frag\"\n";

// A miss of a reference.
inline constexpr Real kMiss = -1.0L;

inline std::vector<glm::vec4> probe_all(std::string_view functions, std::string_view expression,
                                        std::span<const ProbeCase> cases) {
    constexpr std::size_t kMost = 16384;
    std::vector<glm::vec4> all;
    for (std::size_t i = 0; i < cases.size(); i += kMost) {
        const auto part =
            probe(functions, expression, cases.subspan(i, std::min(kMost, cases.size() - i)));
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

struct Random {
    std::mt19937 bits;
    double uniform(double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(bits);
    }
    glm::dvec3 direction() {
        const double y = uniform(-1.0, 1.0), a = uniform(0.0, 2.0 * std::numbers::pi);
        const double r = std::sqrt(1.0 - y * y);
        return {r * std::cos(a), y, r * std::sin(a)};
    }
    glm::dvec3 in_box(const glm::dvec3& half) {
        return {uniform(-half.x, half.x), uniform(-half.y, half.y), uniform(-half.z, half.z)};
    }
};

// A ray from `distance` away through a point, in the floats that the shader gets.
struct FloatRay {
    glm::vec3 ro, rd;
};
inline FloatRay ray_through(Random& random, const glm::dvec3& target, double distance) {
    const glm::vec3 ro(target - distance * random.direction());
    return {ro, glm::vec3(glm::normalize(target - glm::dvec3(ro)))};
}

// The nearest root ahead whose point is accepted, of a t^2 + 2 b t + c.
inline Real first_root(Real a, Real b, Real c, const std::function<bool(Real)>& accepts) {
    const Real d = b * b - a * c;
    if (d < 0.0L || a == 0.0L) return kMiss;
    const Real s = std::sqrt(d);
    const Real near = std::min((-b - s) / a, (-b + s) / a),
               far = std::max((-b - s) / a, (-b + s) / a);
    if (near > 0.0L && accepts(near)) return near;
    return far > 0.0L && accepts(far) ? far : kMiss;
}

// Answers beside the truth.
struct Comparison {
    double flips = 0.0;  // share of the rays where one hits and the other does not
    double p99 = 0.0;    // of |t / truth - 1| where both hit
    double worst = 0.0;
    std::size_t hits = 0;
    std::size_t not_finite = 0;
};
inline Comparison compare(const std::vector<Real>& truth,
                          const std::function<Real(std::size_t)>& answer) {
    std::vector<double> errors;
    std::size_t flips = 0, not_finite = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Real t = answer(i);
        if (!std::isfinite(t)) ++not_finite;
        const bool hit = t > 0.0L && t < 1e29L;
        if (hit != (truth[i] > 0.0L)) ++flips;
        if (hit && truth[i] > 0.0L) {
            errors.push_back(static_cast<double>(std::abs(t / truth[i] - 1.0L)));
        }
    }
    std::ranges::sort(errors);
    const std::size_t n = errors.size();
    return {.flips = static_cast<double>(flips) / static_cast<double>(truth.size()),
            .p99 = n == 0 ? 0.0 : errors[std::min(n - 1, n * 99 / 100)],
            .worst = n == 0 ? 0.0 : errors.back(),
            .hits = n,
            .not_finite = not_finite};
}
inline void print_row(std::string_view what, const Comparison& robust, const Comparison& textbook) {
    fmt::print("{:<34} robust {:8.4f} % flips, t {:7.1e} | textbook {:8.4f} % flips, t {:7.1e}\n",
               what, 100.0 * robust.flips, robust.p99, 100.0 * textbook.flips, textbook.p99);
}

}  // namespace glint
