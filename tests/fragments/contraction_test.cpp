// What fragments/analytic.frag builds on exact roundings, on a driver that fuses products and sums.
//
// The scene's forms are repeated here over a type of number: with plain floats they give the bits
// that the scene gives, and with fused ones the same bits again. Dekker's split by subtractions
// does not.
#include "intersections.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace glint::contraction_test {
namespace {

using Contraction = GlTest;

enum class Fuse { left, right };  // which of two products goes into the one rounding

// A float that remembers the product it came from: a later sum takes that product unrounded, as
// compilers do across statements.
template <Fuse kFirst>
struct Fused {
    float value = 0.0f, a = 0.0f, b = 0.0f;
    bool is_product = false;

    Fused(float v = 0.0f) : value(v) {}
    Fused(float x, float y) : value(x * y), a(x), b(y), is_product(true) {}
    friend Fused operator*(Fused x, Fused y) { return {x.value, y.value}; }
    friend Fused operator-(Fused x) { return x.is_product ? Fused(-x.a, x.b) : Fused(-x.value); }
    friend Fused operator+(Fused x, Fused y) {
        const bool left = x.is_product && (kFirst == Fuse::left || !y.is_product);
        if (left) return std::fma(x.a, x.b, y.value);
        return y.is_product ? std::fma(y.a, y.b, x.value) : x.value + y.value;
    }
    friend Fused operator-(Fused x, Fused y) { return x + -y; }
};
float value_of(float x) {
    return x;
}
template <Fuse kFirst>
float value_of(Fused<kFirst> x) {
    return x.value;
}

template <typename Number>
Number masked(Number x, std::uint32_t mask) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value_of(x)) & mask);
}
template <typename Number>
Number settled(Number x) {
    return masked(x, 0xfffffffeu);
}
struct Product {
    float product, lost;
    bool operator==(const Product&) const = default;
};
template <typename Number>
Product exact_product(Number a, Number b) {
    const Number high_a = masked(a, 0xfffff000u), low_a = a - high_a;
    const Number high_b = masked(b, 0xfffff000u), low_b = b - high_b;
    const Number most = high_a * high_b, rest = (high_a * low_b + low_a * high_b) + low_a * low_b;
    const Number product = settled(most + rest), lost = rest - (product - most);
    return {value_of(product), value_of(lost)};
}
template <typename Number>
Product dekker_product(Number a, Number b) {
    const auto split = [](Number x) {
        const Number big = Number(4097.0f) * x;
        return big - (big - x);
    };
    const Number high_a = split(a), low_a = a - high_a, high_b = split(b), low_b = b - high_b;
    const Number lost =
        ((high_a * high_b - a * b) + high_a * low_b + low_a * high_b) + low_a * low_b;
    return {value_of(a * b), value_of(lost)};
}
template <typename Number>
float along_exactly(Number ro, Number rd, Number t) {
    const Product p = exact_product(t, rd);
    const Number product = p.product, sum = settled(ro + product), part = settled(sum - ro);
    return value_of(sum + ((ro - (sum - part)) + (product - part) + Number(p.lost)));
}
// Of a triangle's edge from b to c, seen along the ray.
template <typename Number>
float edge(Number cx, Number cy, Number bx, Number by) {
    return value_of(settled(cx * by) - settled(bx * cy));
}

std::vector<ProbeCase> numbers(std::size_t count) {
    Random random{std::mt19937(41)};
    const auto any = [&] {
        return static_cast<float>(random.uniform(-1.0, 1.0) *
                                  std::exp2(random.uniform(-12.0, 12.0)));
    };
    std::vector<ProbeCase> cases(count);
    for (ProbeCase& one : cases) one.a = {any(), any(), any(), any()};
    return cases;
}

template <typename Number>
std::size_t products_that_differ(const std::vector<ProbeCase>& cases, Product (*by)(Number, Number),
                                 Product (*plain)(float, float)) {
    return static_cast<std::size_t>(std::ranges::count_if(cases, [&](const ProbeCase& one) {
        return by(one.a.x, one.a.y) != plain(one.a.x, one.a.y);
    }));
}

TEST_F(Contraction, ProductsInTwiceTheDigitsAreTheSameFused) {
    const auto cases = numbers(16384);
    const auto seen =
        probe(kAnalytic +
                  "vec2 probe_product(float x, float y) { vec3 lost, p = "
                  "exactProduct(vec3(x), vec3(y), lost); return vec2(p.x, lost.x); }",
              "vec3(probe_product(a.x, a.y), alongExactly(a.zzz, a.yyy, a.x).x)", cases);
    double worst = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::vec4& n = cases[i].a;
        const Product plain = exact_product(n.x, n.y);
        ASSERT_EQ(seen[i].x, plain.product) << "the scene's product";
        ASSERT_EQ(seen[i].y, plain.lost) << "and what that lost";
        const double truth = double{n.x} * n.y;
        worst = std::max(worst, std::abs((double{plain.product} + plain.lost) / truth - 1.0));
        const float along = along_exactly(n.z, n.y, n.x);
        ASSERT_EQ(seen[i].z, along);
        ASSERT_EQ(along, (along_exactly<Fused<Fuse::left>>(n.z, n.y, n.x)));
        ASSERT_EQ(along, (along_exactly<Fused<Fuse::right>>(n.z, n.y, n.x)));
        const double right = n.z + truth, last = std::abs(std::nextafter(along, 1e30f) - along);
        ASSERT_LE(std::abs(along - right), 0.51 * last + std::exp2(-33.0) * std::abs(truth))
            << "rounded once";
    }
    EXPECT_LE(worst, std::exp2(-33.0)) << "two roundings of what is 2^-10 of it";
    using Left = Fused<Fuse::left>;
    using Right = Fused<Fuse::right>;
    EXPECT_EQ((products_that_differ<Left>(cases, exact_product, exact_product)), 0u);
    EXPECT_EQ((products_that_differ<Right>(cases, exact_product, exact_product)), 0u);
    EXPECT_GE((products_that_differ<Right>(cases, dekker_product, dekker_product)), 1000u)
        << "fused, Dekker's split is none, or this proves nothing";
}

// Two triangles that share an edge must agree on which side of it a ray passes, and one without
// area is a miss only where its edges are exactly 0.
TEST_F(Contraction, AnEdgeIsTheOppositeOfItsReverseFused) {
    const auto cases = numbers(16384);
    const auto opposite = [&cases](auto number) {
        using Number = decltype(number);
        std::size_t wrong = 0;
        for (const ProbeCase& one : cases) {
            const Number cx = one.a.x, cy = one.a.y, bx = one.a.z, by = one.a.w;
            if (edge(cx, cy, bx, by) != -edge(bx, by, cx, cy)) ++wrong;
            if (edge(cx, cy, cx, cy) != 0.0f) ++wrong;
        }
        return wrong;
    };
    EXPECT_EQ(opposite(0.0f), 0u);
    EXPECT_EQ(opposite(Fused<Fuse::left>()), 0u);
    EXPECT_EQ(opposite(Fused<Fuse::right>()), 0u);
    const auto seen =
        probe(kAnalytic, "(settled(a.xxx * a.www) - settled(a.zzz * a.yyy)).x", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::vec4& n = cases[i].a;
        ASSERT_EQ(seen[i].x, edge(n.x, n.y, n.z, n.w)) << "the scene's edge";
    }
    std::size_t plain_wrong = 0;  // without the mask
    for (const ProbeCase& one : cases) {
        using Left = Fused<Fuse::left>;
        const Left cx = one.a.x, cy = one.a.y;
        if (value_of(cx * cy - cy * cx) != 0.0f) ++plain_wrong;
    }
    EXPECT_GE(plain_wrong, 1000u) << "fused, a b - b a is not 0, or this proves nothing";
}

}  // namespace
}  // namespace glint::contraction_test
