#include "measure/rows/flip.h"

#include "measure/rows/difference.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>

namespace glint {
namespace {

using glm::dmat3, glm::mat3, glm::vec3;

// ---- Colour -------------------------------------------------------------------------------------

// Linear sRGB to XYZ, by columns: the primaries of IEC 61966-2-1 and their white, D65.
const dmat3 kToXyz = {{0.4123865632529917, 0.2126368216773238, 0.0193306201524840},
                      {0.3575914909206254, 0.7151829818412507, 0.1191971636402085},
                      {0.1804504912035636, 0.0721801964814254, 0.9503725870054354}};
const vec3 kWhite = kToXyz * glm::dvec3(1.0);

// Light to YyCxCz, a linear opponent space: luminance 116 Y/Yn - 16, red-green
// 500 (X/Xn - Y/Yn), blue-yellow 200 (Y/Yn - Z/Zn).
vec3 opponent_of(vec3 light) {
    static const mat3 kMatrix(kToXyz);
    const vec3 xyz = kMatrix * light / kWhite;
    return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

vec3 light_of(vec3 opponent) {
    static const mat3 kMatrix(glm::inverse(kToXyz));
    const float y = (opponent.x + 16.0f) / 116.0f;
    return kMatrix * (kWhite * vec3(y + opponent.y / 500.0f, y, y - opponent.z / 200.0f));
}

float lab_curve(float t) {
    constexpr float kDelta = 6.0f / 29.0f;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                        : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
}

// L*a*b* with Hunt's effect: a and b times L / 100, since what is darker has less colour.
vec3 seen_colour(vec3 light) {
    static const mat3 kMatrix(kToXyz);
    const vec3 xyz = kMatrix * light / kWhite;
    const float x = lab_curve(xyz.x), y = lab_curve(xyz.y), z = lab_curve(xyz.z);
    const float lightness = 116.0f * y - 16.0f;
    return {lightness, 5.0f * lightness * (x - y), 2.0f * lightness * (y - z)};
}

// HyAB, |dL| + sqrt(da^2 + db^2): a distance that holds for large differences, too.
float distance_hyab(vec3 a, vec3 b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// HyAB^0.7, spread over 0..1 (2020, "error redistribution"): what is below 0.4 of the largest,
// which is that of green and blue, goes to 0..0.95 and the rest above, both linearly.
float colour_difference(vec3 a, vec3 b) {
    constexpr float kPower = 0.7f, kPart = 0.4f, kShare = 0.95f;
    static const float most =
        std::pow(distance_hyab(seen_colour({0, 1, 0}), seen_colour({0, 0, 1})), kPower);
    const float d = std::pow(distance_hyab(a, b), kPower);
    const float knee = kPart * most;
    const float spread =
        d < knee ? kShare * d / knee : kShare + (1.0f - kShare) * (d - knee) / (most - knee);
    return std::min(spread, 1.0f);
}

// ---- Filters ------------------------------------------------------------------------------------

struct Plane {
    glm::ivec2 size{0};
    std::vector<float> values{};

    explicit Plane(glm::ivec2 s)
        : size(s), values(static_cast<std::size_t>(s.x) * static_cast<std::size_t>(s.y)) {}
    float* row(int y) {
        return values.data() + static_cast<std::ptrdiff_t>(y) * static_cast<std::ptrdiff_t>(size.x);
    }
    const float* row(int y) const { return const_cast<Plane*>(this)->row(y); }
};

using Kernel = std::vector<float>;  // of odd length, the middle at 0

int radius_of(const Kernel& kernel) {
    return static_cast<int>(kernel.size() / 2);
}

void add_scaled(float weight, const float* from, float* to, int count) {
    for (int x = 0; x < count; ++x) to[x] += weight * from[x];
}

// Correlation along x; beyond the edge the last pixel goes on.
Plane along_rows(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.size);
    const int width = plane.size.x, radius = radius_of(kernel);
    std::vector<float> padded(static_cast<std::size_t>(width) + kernel.size());
    for (int y = 0; y < plane.size.y; ++y) {
        const float* row = plane.row(y);
        std::fill_n(padded.data(), radius, row[0]);
        std::copy_n(row, width, padded.data() + radius);
        std::fill_n(padded.data() + radius + width, radius, row[width - 1]);
        for (std::size_t k = 0; k < kernel.size(); ++k)
            add_scaled(kernel[k], padded.data() + k, result.row(y), width);
    }
    return result;
}

Plane along_columns(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.size);
    const int radius = radius_of(kernel), last = plane.size.y - 1;
    for (int y = 0; y <= last; ++y)
        for (int k = -radius; k <= radius; ++k)
            add_scaled(kernel[static_cast<std::size_t>(k + radius)],
                       plane.row(std::clamp(y + k, 0, last)), result.row(y), plane.size.x);
    return result;
}

template <class F>
Kernel sampled(int radius, F f) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x) kernel.push_back(static_cast<float>(f(double(x))));
    return kernel;
}

// What the eye's contrast sensitivity leaves of a channel, as one or two Gaussians over the plane
// (2020, "spatial filtering", with the table of a and b): a sqrt(pi / b) exp(-pi^2 d^2 / b), d in
// degrees. Each is a product of two along the axes; all of a channel together have the sum 1.
struct Sensitivity {
    struct Gaussian {
        double a, b;
    };
    std::array<Gaussian, 2> terms;
};
constexpr Sensitivity kSensitivities[3] = {
    {{{{1.0, 0.0047}, {}}}}, {{{{1.0, 0.0053}, {}}}}, {{{{34.1, 0.04}, {13.5, 0.025}}}}};

int sensitivity_radius(double per_degree) {
    constexpr double kWidest = 0.04;  // three standard deviations of the widest, for all
    const double sigma = std::sqrt(kWidest / 2.0) / std::numbers::pi;
    return static_cast<int>(std::ceil(3.0 * sigma * per_degree));
}

// The kernels along one axis of a channel's terms.
std::vector<Kernel> sensitivity_kernels(const Sensitivity& channel, double per_degree) {
    const int radius = sensitivity_radius(per_degree);
    const auto along = [&](double x, double b) {
        const double d = std::numbers::pi * x / per_degree;
        return std::exp(-d * d / b);
    };
    double whole = 0.0;
    for (const auto& [a, b] : channel.terms) {
        double line = 0.0;
        for (int x = -radius; a > 0.0 && x <= radius; ++x) line += along(x, b);
        if (a > 0.0) whole += a * std::sqrt(std::numbers::pi / b) * line * line;
    }
    std::vector<Kernel> kernels;
    for (const auto& [a, b] : channel.terms) {
        if (a == 0.0) continue;
        const double scale = std::sqrt(a * std::sqrt(std::numbers::pi / b) / whole);
        kernels.push_back(sampled(radius, [&, b = b](double x) { return scale * along(x, b); }));
    }
    return kernels;
}

Plane as_the_eye_blurs(const Plane& plane, const std::vector<Kernel>& kernels) {
    Plane result = along_columns(along_rows(plane, kernels[0]), kernels[0]);
    for (std::size_t i = 1; i < kernels.size(); ++i) {
        const Plane more = along_columns(along_rows(plane, kernels[i]), kernels[i]);
        add_scaled(1.0f, more.values.data(), result.values.data(),
                   static_cast<int>(more.values.size()));
    }
    return result;
}

// What finds edges and points (2020, "feature detection"): the first and second derivative of a
// Gaussian whose width, two standard deviations, is 0.082 degrees. The negative weights have the
// sum -1, the positive ones 1.
struct Detectors {
    Kernel smooth, edge, point;
};

void even_out(Kernel& kernel) {
    float up = 0.0f, down = 0.0f;
    for (const float w : kernel) (w > 0.0f ? up : down) += std::abs(w);
    for (float& w : kernel) w /= w > 0.0f ? up : down > 0.0f ? down : 1.0f;
}

Detectors detectors(double per_degree) {
    constexpr double kWidth = 0.082;  // degrees
    const double sigma = 0.5 * kWidth * per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto g = [sigma](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    Detectors result{
        .smooth = sampled(radius, g),
        .edge = sampled(radius, [&](double x) { return -x * g(x); }),
        .point = sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * g(x); })};
    for (Kernel* kernel : {&result.smooth, &result.edge, &result.point}) even_out(*kernel);
    return result;
}

// ---- The two pipelines --------------------------------------------------------------------------

struct Filters {
    std::array<std::vector<Kernel>, 3> sensitivity;
    Detectors detectors;
    int radius = 0;  // how far a pixel sees

    explicit Filters(double per_degree) : detectors(glint::detectors(per_degree)) {
        for (std::size_t c = 0; c < 3; ++c)
            sensitivity[c] = sensitivity_kernels(kSensitivities[c], per_degree);
        radius = std::max(sensitivity_radius(per_degree), radius_of(detectors.smooth));
    }
};

// Some rows of a picture as a person sees them.
struct Seen {
    std::array<Plane, 3> colour;  // see seen_colour()
    Plane edges, points;          // how much of each there is
};

Plane magnitude(const Plane& x, const Plane& y) {
    Plane result(x.size);
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
    return result;
}

// Across both axes.
Plane found(const Plane& smooth_in_y, const Plane& smooth_in_x, const Kernel& kernel) {
    return magnitude(along_rows(smooth_in_y, kernel), along_columns(smooth_in_x, kernel));
}

Seen seen(std::span<const vec3> light, glm::ivec2 size, const Filters& filters) {
    std::array<Plane, 3> opponent = {Plane(size), Plane(size), Plane(size)};
    for (std::size_t i = 0; i < light.size(); ++i) {
        const vec3 value = opponent_of(light[i]);
        for (int c = 0; c < 3; ++c) opponent[static_cast<std::size_t>(c)].values[i] = value[c];
    }
    std::array<Plane, 3> colour = {as_the_eye_blurs(opponent[0], filters.sensitivity[0]),
                                   as_the_eye_blurs(opponent[1], filters.sensitivity[1]),
                                   as_the_eye_blurs(opponent[2], filters.sensitivity[2])};
    for (std::size_t i = 0; i < light.size(); ++i) {
        const vec3 blurred{colour[0].values[i], colour[1].values[i], colour[2].values[i]};
        const vec3 value = seen_colour(glm::clamp(light_of(blurred), vec3(0), vec3(1)));
        for (int c = 0; c < 3; ++c) colour[static_cast<std::size_t>(c)].values[i] = value[c];
    }
    Plane& luminance = opponent[0];
    for (float& y : luminance.values) y = (y + 16.0f) / 116.0f;
    const Plane in_x = along_rows(luminance, filters.detectors.smooth);
    const Plane in_y = along_columns(luminance, filters.detectors.smooth);
    return {.colour = std::move(colour),
            .edges = found(in_y, in_x, filters.detectors.edge),
            .points = found(in_y, in_x, filters.detectors.point)};
}

vec3 colour_at(const Seen& seen, std::size_t i) {
    return {seen.colour[0].values[i], seen.colour[1].values[i], seen.colour[2].values[i]};
}

// The colours' difference C and the features' F = sqrt(max(edges, points) / sqrt(2)) are C^(1 - F).
float difference_at(const Seen& a, const Seen& b, std::size_t i) {
    const float colour = colour_difference(colour_at(a, i), colour_at(b, i));
    if (colour == 0.0f) return 0.0f;
    const float feature = std::max(std::abs(a.edges.values[i] - b.edges.values[i]),
                                   std::abs(a.points.values[i] - b.points.values[i]));
    const float share = std::min(std::sqrt(feature / std::numbers::sqrt2_v<float>), 1.0f);
    return std::pow(colour, 1.0f - share);
}

bool is_finite(const float* rgb) {
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

// Light of some rows, from 0 to 1, as it is to be shown.
template <class Show>
std::vector<vec3> shown_rows(std::span<const float> rgba, glm::ivec2 size, int first, int end,
                             const Show& show) {
    std::vector<vec3> light;
    light.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(end - first));
    const std::size_t row = static_cast<std::size_t>(size.x) * 4;
    for (std::size_t i = row * static_cast<std::size_t>(first);
         i < row * static_cast<std::size_t>(end); i += 4) {
        const vec3 value{rgba[i], rgba[i + 1], rgba[i + 2]};
        light.push_back(is_finite(&rgba[i]) ? show(value) : vec3(0));
    }
    return light;
}

// Raises `map` to the differences of two pictures that are shown so. By bands of rows, which fit a
// processor's cache; a band sees as far beyond its ends as its pixels do.
template <class Show>
void raise(std::vector<float>& map, std::span<const float> picture,
           std::span<const float> reference, glm::ivec2 size, const Filters& filters,
           const Show& show) {
    constexpr int kBand = 64;
    for (int y = 0; y < size.y; y += kBand) {
        const int first = std::max(y - filters.radius, 0);
        const int end = std::min(y + kBand + filters.radius, size.y);
        const glm::ivec2 part{size.x, end - first};
        const Seen a = seen(shown_rows(picture, size, first, end, show), part, filters);
        const Seen b = seen(shown_rows(reference, size, first, end, show), part, filters);
        const auto width = static_cast<std::size_t>(size.x);
        for (int line = y; line < std::min(y + kBand, size.y); ++line) {
            const std::size_t from = width * static_cast<std::size_t>(line - first);
            const std::size_t to = width * static_cast<std::size_t>(line);
            for (std::size_t x = 0; x < width; ++x)
                map[to + x] = std::max(map[to + x], difference_at(a, b, from + x));
        }
    }
}

// ---- High dynamic range -------------------------------------------------------------------------

// Narkowicz's fit of the ACES film curve, which 2021 takes where nothing is known of the display:
// (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5).
constexpr double kFilm0 = 0.6 * 0.6 * 2.51, kFilm1 = 0.6 * 0.03;
constexpr double kFilm3 = 0.6 * 0.6 * 2.43, kFilm4 = 0.6 * 0.59, kFilm5 = 0.14;

float film(float x) {
    if (x > 1e9f) return 1.0f;  // and no overflow
    const double d = x;
    return static_cast<float>(
        std::min(d * (kFilm0 * d + kFilm1) / (d * (kFilm3 * d + kFilm4) + kFilm5), 1.0));
}

// The light that the curve shows as t.
double film_inverse(double t) {
    const double a = kFilm0 - t * kFilm3, b = kFilm1 - t * kFilm4, c = -t * kFilm5;
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

vec3 srgb_light(vec3 value) {
    vec3 light;
    for (int c = 0; c < 3; ++c)
        light[c] = static_cast<float>(decode_srgb(std::clamp(value[c], 0.0f, 1.0f)));
    return light;
}

}  // namespace

double pixels_per_degree(double distance, double width, double pixels) {
    return distance * pixels / width * std::numbers::pi / 180.0;
}

std::vector<double> flip_exposures(std::span<const float> reference) {
    constexpr double kShown = 0.85;
    std::vector<double> luminances;
    for (std::size_t i = 0; i + 3 < reference.size(); i += 4) {
        if (!is_finite(&reference[i])) continue;
        const glm::dvec3 light{reference[i], reference[i + 1], reference[i + 2]};
        luminances.push_back((kToXyz * glm::max(light, 0.0)).y);
    }
    if (luminances.empty()) return {0.0, 0.0};
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    constexpr double kLeast = std::numeric_limits<float>::epsilon();  // of a picture that is black
    const double median = std::max(*middle, kLeast);
    const double most = std::max(*std::max_element(middle, luminances.end()), kLeast);
    const double start = std::log2(film_inverse(kShown) / most);
    const double stop = std::log2(film_inverse(kShown) / median);
    const int count = std::max(2, static_cast<int>(std::ceil(stop - start)));
    std::vector<double> exposures;
    for (int i = 0; i < count; ++i) exposures.push_back(start + i * (stop - start) / (count - 1));
    return exposures;
}

std::vector<float> flip_map(std::span<const float> picture, std::span<const float> reference,
                            glm::ivec2 size, const FlipOptions& options) {
    std::vector<float> map(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    const Filters filters(options.pixels_per_degree);
    if (options.values == Values::display) {
        raise(map, picture, reference, size, filters, srgb_light);
    } else {
        // Each pixel counts as where it differs most.
        for (const double stops : flip_exposures(reference)) {
            const auto scale = static_cast<float>(std::exp2(stops));
            raise(map, picture, reference, size, filters, [scale](vec3 light) {
                light = glm::max(light * scale, vec3(0));
                return vec3(film(light.x), film(light.y), film(light.z));
            });
        }
    }
    for (std::size_t i = 0; i < map.size(); ++i)
        if (!is_finite(&picture[4 * i]) || !is_finite(&reference[4 * i])) map[i] = 1.0f;
    return map;
}

double mean(std::span<const float> map) {
    return map.empty()
               ? 0.0
               : std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

double mean_where_finite(std::span<const float> map, std::span<const float> reference) {
    std::vector<float> kept;
    for (std::size_t i = 0; i < map.size(); ++i)
        if (is_finite(&reference[4 * i])) kept.push_back(map[i]);
    return mean(kept);
}

}  // namespace glint
