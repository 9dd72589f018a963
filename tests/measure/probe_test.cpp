// Values of a shader at a pixel, against what the same arithmetic gives here.
#include "measure/probe/probe.h"

#include "../render/fixture.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

namespace glint::probe_test {
namespace {

class ProbeTest : public GlTest {};

struct Answer {
    std::vector<ProbeValue> values;
    std::array<float, 4> colour{};
    glm::vec4 plain{0.0f};
    std::vector<std::string> notes;

    const ProbeValue& of(std::string_view name, int hit = 0) const {
        for (const ProbeValue& one : values)
            if (one.name == name && (hit == 0 || one.hit == hit)) return one;
        throw std::runtime_error(fmt::format("{} has no value", name));
    }
    double number(std::string_view name, int hit = 0) const { return of(name, hit).value.at(0); }
};

Answer ask(Player& player, glm::ivec2 pixel, int k = 0, const ProbeWish& wish = {},
           std::string_view pass = "image", bool all_hits = false) {
    Answer answer;
    const std::size_t index = player.graph_index(pass);
    Probe probe(player.preset, player.renderer().graph().passes[index].pass, {}, wish);
    const Frame frame = player.frame(k);
    player.renderer().before_pass = [&](std::size_t drawn) {
        if (drawn != index) return;
        answer.values = all_hits ? probe.hits_at(player.renderer(), frame, {pixel}, 1000)
                                 : probe.values_at(player.renderer(), frame, {pixel});
        answer.colour = probe.colour();
    };
    player.renderer().redraw();
    player.draw(frame);
    player.renderer().before_pass = nullptr;
    answer.plain = player.renderer().read_pixel(index, 0, pixel);
    answer.notes = probe.notes();
    return answer;
}

std::string image(const std::string& body) {
    return "void mainImage(out vec4 c, in vec2 p) { " + body + " }";
}

TEST_F(ProbeTest, TellsWhatAnIndependentComputationGives) {
    Player player(
        "float map(vec3 p) { return length(p) - 1.0; }\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    vec3 rd = normalize(vec3(p / 16.0 - 0.5, 2.0)), ro = vec3(0, 0, -3);\n"
        "    float t = 0.0;\n"
        "    for (int i = 0; i < 5; i++) t += map(ro + rd * t);\n"
        "    c = vec4(t);\n"
        "}\n",
        {.size = {16, 16}});
    const Answer all = ask(player, {5, 11}, 0, {}, "image", true);
    const glm::dvec3 rd = glm::normalize(glm::dvec3(5.5 / 16.0 - 0.5, 11.5 / 16.0 - 0.5, 2.0));
    double t = 0.0;
    // Rounding of a dozen operations near 3, each of at most 2^-23 of that.
    constexpr double kRounding = 12 * 3 / 8388608.0;
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(all.of("rd").value[static_cast<std::size_t>(i)], rd[i], kRounding);
    for (int hit = 1; hit <= 5; ++hit) {
        const glm::dvec3 at = glm::dvec3(0, 0, -3) + rd * t;
        const double d = glm::length(at) - 1.0;
        EXPECT_NEAR(all.number("map", hit), d, kRounding) << hit;
        t += d;
        // t has one value before the loop, where it is declared.
        double told = NAN;
        for (const ProbeValue& one : all.values)
            if (one.name == "t" && one.hits == 5 && one.hit == hit) told = one.value[0];
        EXPECT_NEAR(told, t, kRounding) << hit;
    }
    EXPECT_EQ(all.of("map").hits, 5);
    EXPECT_EQ(same_colour(all.plain, all.colour, PixelFormat::rgba32f), "bits");
}

TEST_F(ProbeTest, TellsEveryType) {
    Player player(
        "struct Hit { float t; vec3 nor; ivec2 id[2]; };\n"
        "Hit hit(float t) { return Hit(t, vec3(1, 2, 3), ivec2[2](ivec2(4, 5), ivec2(6, 7))); }\n" +
        image("int i = -3; uint u = 4000000000u; bool b = true; bvec2 bb = bvec2(true, false);\n"
              "vec4 v = vec4(1, 2, 3, 4); mat2x3 m = mat2x3(1, 2, 3, 4, 5, 6); Hit h = hit(0.5);\n"
              "uvec3 w = uvec3(7u); float nan = uintBitsToFloat(0x7FC00001u);\n"
              "v.zx *= 2.0; h.nor.y = 9.0; i++; c = v + h.t;"));
    const Answer all = ask(player, {1, 1});
    EXPECT_EQ(all.of("u").value, std::vector<double>{4000000000.0});
    EXPECT_EQ(all.of("b").value, std::vector<double>{1});
    EXPECT_EQ(all.of("bb").value, (std::vector<double>{1, 0}));
    EXPECT_EQ(all.of("v").value, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(all.of("v.zx").value, (std::vector<double>{6, 2}));
    EXPECT_EQ(all.of("m[0]").value, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(all.of("m[1]").value, (std::vector<double>{4, 5, 6}));
    EXPECT_EQ(all.of("h.t").value, std::vector<double>{0.5});
    EXPECT_EQ(all.of("h.nor").value, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(all.of("h.id[1]").value, (std::vector<double>{6, 7}));
    EXPECT_EQ(all.of("h.nor.y").value, std::vector<double>{9});
    EXPECT_EQ(all.of("i").value, std::vector<double>{-3});
    EXPECT_TRUE(std::isnan(all.number("nan")));
    EXPECT_EQ(all.of("w").type, "uvec3");
}

TEST_F(ProbeTest, TellsArraysByTheirElements) {
    Player player(
        "float[2] pair(float x) { return float[2](x, x * 2.0); }\n"
        "float sum(float a[2]) { return a[0] + a[1]; }\n"
        "void fill(out ivec2 a[3]) { for (int i = 0; i < 3; i++) a[i] = ivec2(i, 7); }\n" +
        image("float a[2] = pair(3.0), late[2]; ivec2 f[3]; fill(f); late = pair(5.0);\n"
              "const float table[2] = float[2](8.0, 9.0);\n"
              "mat2 m[2] = mat2[2](mat2(1, 2, 3, 4), mat2(5, 6, 7, 8));\n"
              "if ((late = pair(6.0))[0] > 1.0) c = vec4(sum(a) + table[1]);"));
    const Answer all = ask(player, {1, 1});
    EXPECT_EQ(all.of("a[1]").value, std::vector<double>{6});
    EXPECT_EQ(all.of("a[0]").function, "sum");
    EXPECT_EQ(all.of("f[2]").value, (std::vector<double>{2, 7}));
    EXPECT_EQ(all.of("late[1]").value, std::vector<double>{10});
    EXPECT_EQ(all.values.back().value.at(0), 18.0);
    EXPECT_EQ(all.of("table[1]").value, std::vector<double>{9});
    EXPECT_EQ(all.of("m[1][0]").value, (std::vector<double>{5, 6}));
    EXPECT_EQ(all.of("m[1][1]").value, (std::vector<double>{7, 8}));
    EXPECT_EQ(all.notes, std::vector<std::string>());
    EXPECT_EQ(same_colour(all.plain, all.colour, PixelFormat::rgba32f), "bits");
}

TEST_F(ProbeTest, KnowsTheLinesOfThePlainText) {
    Player player(image("c = vec4(__LINE__);"));
    const Answer all = ask(player, {1, 1});
    EXPECT_EQ(all.plain.x, all.colour[0]);
}

TEST_F(ProbeTest, LeavesNamesToTheText) {
    Player player("float glint_v = 1.0; int glint_id = 2;\n" +
                  image("float glint_ask = glint_v + float(glint_id); c = vec4(glint_ask);"));
    EXPECT_EQ(ask(player, {1, 1}).number("glint_ask"), 3.0);
}

TEST_F(ProbeTest, EvaluatesNothingThatTheSourceDoesNot) {
    Player player(
        "int calls = 0;\n"
        "bool touch() { calls += 1; return true; }\n"
        "float early(float x) { if (x < 2.0) return 1.0; calls += 100; return 2.0; }\n" +
        image("bool a = false && touch(); bool b = true || touch(); bool d = p.x < 0.0 ? touch() : "
              "false;\nfloat e = early(0.5); c = vec4(float(calls), e, 0, 1);"));
    const Answer all = ask(player, {2, 1});
    EXPECT_EQ(all.colour[0], 0.0f);
    EXPECT_EQ(all.plain.x, 0.0f);
    EXPECT_THROW((void)all.of("touch"), std::runtime_error);
    EXPECT_EQ(all.number("early"), 1.0);
    EXPECT_EQ(all.of("early").hits, 1);
}

TEST_F(ProbeTest, FollowsOutAndInoutParameters) {
    Player player("void split(float a, out float b, inout float s) { b = a * 2.0; s += b; }\n" +
                  image("float b, s = 1.0; split(p.x, b, s); if (s > 0.0) c = vec4(b, s, 0, 1);"));
    const Answer all = ask(player, {1, 0});  // p.x = 1.5
    EXPECT_EQ(all.number("b"), 3.0);
    EXPECT_EQ(all.number("s"), 4.0 - 3.0);  // where split() is entered and main declares it
    EXPECT_EQ(same_colour(all.plain, all.colour, PixelFormat::rgba32f), "bits");
}

// A call that is not evaluated hands nothing out; wherever it stands, it is told what it does.
TEST_F(ProbeTest, TellsWhatIsHandedOutWhereTheCallIsEvaluatedAndOnlyThere) {
    Player player(
        "bool get(inout float t) { t += 1.0; return t < 3.0; }\n"
        "float give(out float o) { o = 7.0; return 1.0; }\n"
        "void many(out float a, out vec2 b) { a = 5.0; b = vec2(6.0); }\n"
        "float ret() { float q; return give(q) + q; }\n" +
        image("float skipped = 0.0, taken = 0.0, chosen, switched, step = 0.0, a; vec4 b;\n"
              "if (p.x < 0.0 && get(skipped)) c = vec4(1);\n"
              "if (p.x > 0.0 && get(taken)) chosen = p.x > 0.0 ? give(chosen) : 2.0;\n"
              "switch (int(give(switched))) { case 1: c = vec4(2); }\n"
              "for (int i = 0; i < 2; many(a, b.wy), ++i) get(step);\n"
              "c += vec4(taken, switched, step, ret() + a + b.y);"));
    const Answer all = ask(player, {2, 1}, 0, {}, "image", true);
    const auto told = [&](std::string_view name) {
        std::vector<double> list;
        for (const ProbeValue& one : all.values)
            if (one.name == name && one.function != "get" && one.function != "give")
                list.push_back(one.value.at(0));
        return list;
    };
    using List = std::vector<double>;
    EXPECT_EQ(told("skipped"), (List{0}));
    EXPECT_EQ(told("taken"), (List{0, 1}));
    EXPECT_EQ(told("chosen"), (List{7, 1})) << "what the call hands out, then what it gives back";
    EXPECT_EQ(told("switched"), (List{7}));
    EXPECT_EQ(told("step"), (List{0, 1, 2}));
    EXPECT_EQ(told("b.wy"), (List{6, 6}));
    EXPECT_EQ(told("q"), (List{7}));
    EXPECT_EQ(all.notes, std::vector<std::string>());
    EXPECT_EQ(same_colour(all.plain, all.colour, PixelFormat::rgba32f), "bits");
}

TEST_F(ProbeTest, TellsArraysOfStructsByTheirElements) {
    Player player(
        "struct P { vec3 pos; float w[2]; mat2 m; };\n"
        "P[2] two(float x) { P a[2]; a[0].pos = vec3(x); a[1] = a[0]; a[1].w[1] = 9.0; return a; "
        "}\n"
        "void turn(inout P a[2]) { a[0].m = mat2(1, 2, 3, 4); }\n" +
        image("P a[2] = two(3.0), late[2]; turn(a); late = two(5.0);\n"
              "struct Own { vec2 y; int n; }; Own b[2]; b[0] = Own(p, 4); b[1] = b[0]; Own k[2];\n"
              "k = b; c = vec4(a[1].w[1], late[0].pos.x, k[1].n, a[0].m[1].y);"));
    const Answer all = ask(player, {1, 1});
    EXPECT_EQ(all.of("late[1].w[1]").value, (std::vector<double>{9}));
    EXPECT_EQ(all.of("late[0].pos").value, (std::vector<double>{5, 5, 5}));
    EXPECT_EQ(all.of("k[1].n").value, (std::vector<double>{4}));
    EXPECT_EQ(all.of("k[0].y").value, (std::vector<double>{1.5, 1.5}));
    const auto turned = std::ranges::find_if(all.values, [](const ProbeValue& one) {
        return one.name == "a[0].m[1]" && one.function == "mainImage" &&
               one.value == std::vector<double>{3, 4};
    });
    EXPECT_NE(turned, all.values.end()) << "behind turn()";
    EXPECT_EQ(all.notes, std::vector<std::string>());
    EXPECT_EQ(same_colour(all.plain, all.colour, PixelFormat::rgba32f), "bits");
}

TEST_F(ProbeTest, LeavesAStructWithASamplerAlone) {
    Player player("struct M { sampler2D t; float k; }; uniform M m;\n" +
                  image("float a = m.k + 2.0; c = vec4(a);"));
    EXPECT_EQ(ask(player, {1, 1}).number("a"), 2.0);
}

TEST_F(ProbeTest, TellsASteppedMatrix) {
    Player player(image("mat2 m = mat2(1, 2, 3, 4); m++; c = vec4(m[1], m[0]);"));
    const Answer all = ask(player, {1, 1});
    EXPECT_EQ(all.values.back().value, (std::vector<double>{4, 5, 2, 3}));
    std::vector<double> last;
    for (const ProbeValue& one : all.values)
        if (one.name == "m[1]") last = one.value;
    EXPECT_EQ(last, (std::vector<double>{4, 5}));
    EXPECT_EQ(all.notes, std::vector<std::string>());
}

TEST_F(ProbeTest, HasTheTrueNeighboursForDerivatives) {
    Player player(image("float w = fwidth(p.x * p.x); c = vec4(w);"), {.size = {8, 4}});
    for (const int x : {2, 3}) {
        const Answer all = ask(player, {x, 1});
        EXPECT_EQ(all.number("w"), 3.5 * 3.5 - 2.5 * 2.5);
        EXPECT_EQ(all.plain.x, static_cast<float>(all.number("w")));
    }
}

// Drivers round to halves or cut them off: both are what a program has drawn.
TEST_F(ProbeTest, ComparesABufferOfHalvesAsFarAsThatTells) {
    const auto same = [](float plain, float probed) {
        return same_colour(glm::vec4(plain), {probed, probed, probed, probed},
                           PixelFormat::rgba16f);
    };
    EXPECT_EQ(same(1955.0f / 2048.0f, 0.9550683f), "bits");
    EXPECT_EQ(same(1956.0f / 2048.0f, 0.9550683f), "bits");
    EXPECT_NE(same(1954.0f / 2048.0f, 0.9550683f), "bits");
    EXPECT_NE(same(-1955.0f / 2048.0f, 0.9550683f), "bits");
}

TEST_F(ProbeTest, SeesTheSameFormerFrameAsAFeedbackPass) {
    Player player(
        "uniform sampler2D sum; //@ pass mainSum\n"
        "void mainSum(out vec4 c, in vec2 p) {\n"
        "    float before = texelFetch(sum, ivec2(p), 0).x; c = vec4(before + 1.0); }\n" +
        image("c = texelFetch(sum, ivec2(p), 0);"));
    player.draw_frames(0, 4);
    const Answer all = ask(player, {1, 1}, 4, {}, "sum");
    EXPECT_EQ(all.number("before"), 4.0);
    EXPECT_EQ(all.plain.x, 5.0f);
    EXPECT_EQ(all.colour[0], 5.0f);
}

TEST_F(ProbeTest, EvaluatesAnyExpressionAtALine) {
    const std::string text = image("float a = p.x;\n a *= 2.0;\n c = vec4(a);");
    Player player(text);
    const std::size_t at = player.preset.scene.text.find(" a *= 2.0;\n");
    const Answer all =
        ask(player, {2, 0}, 0,
            {.expressions = {{.text = "vec2(a, p.y) * 3.0", .line = {at, at + 11}}}});
    EXPECT_EQ(all.values.size(), 1u);
    EXPECT_EQ(all.values[0].value, (std::vector<double>{15.0, 1.5}));
    EXPECT_THROW(
        ask(player, {0, 0}, 0, {.expressions = {{.text = "a = 1.0", .line = {at, at + 11}}}}),
        ProbeRefused);
    EXPECT_THROW(
        ask(player, {0, 0}, 0, {.expressions = {{.text = "nobody", .line = {at, at + 11}}}}),
        ProbeRefused);
}

TEST_F(ProbeTest, EvaluatesAnExpressionAtTheTruePlace) {
    Player player(image("c = vec4(gl_FragCoord.xy, p);"));
    const Answer all =
        ask(player, {3, 1}, 0, {.expressions = {{.text = "gl_FragCoord.xy", .line = {41, 42}}}});
    EXPECT_EQ(all.values.at(0).value, (std::vector<double>{3.5, 1.5}));
    EXPECT_EQ(all.values.at(0).name, "gl_FragCoord.xy");
}

TEST_F(ProbeTest, TellsStructsThatAFunctionDeclares) {
    Player player(image(
        "struct Own { float x; vec2 y; }; Own a = Own(1.0, vec2(2, 3)), b[2]; float k = a.x;\n"
        "a = Own(4.0, vec2(p)); b[1] = a; a.x = 7.0; c = vec4(a.x + b[1].x + k);"));
    const Answer all = ask(player, {0, 0});
    EXPECT_EQ(all.number("k"), 1.0);
    EXPECT_EQ(all.of("a.y").value, (std::vector<double>{2, 3})) << "as it is declared";
    EXPECT_EQ(all.number("b[1].x"), 4.0);
    EXPECT_EQ(all.values.back().value.at(0), 12.0);
    EXPECT_EQ(all.notes, std::vector<std::string>());
    EXPECT_EQ(same_colour(all.plain, all.colour, PixelFormat::rgba32f), "bits");
}

// Nothing beside it on its line is lost.
TEST_F(ProbeTest, TellsAnArrayInAStructAndTheConditionThatDeclares) {
    Player player("struct Held { int k[2]; float t; };\n" +
                  image("Held r; r.t = 2.0; r.k = int[2](4, 5); float z = r.t;\n"
                        "for (int i = 0; bool goes = i < 2; i++) z += float(r.k[i]);\n"
                        "float whole; float part = modf(z, whole); c = vec4(z + part + whole);"));
    const Answer all = ask(player, {0, 0});
    EXPECT_EQ(all.number("r.k[1]"), 5.0);
    EXPECT_EQ(all.number("r.t"), 2.0);
    EXPECT_EQ(all.number("goes"), 0.0);
    EXPECT_EQ(all.number("whole"), 11.0);
    EXPECT_EQ(all.notes, std::vector<std::string>());
}

// Of an array in a struct, which may have the length of an expression, its elements alone are told.
TEST_F(ProbeTest, LeavesOutWhatItCannotTellAndSaysSo) {
    Player player("const int two = 2; struct Many { float x[two]; };\n" +
                  image("Many m; m.x[0] = 1.0; m.x[1] = 2.0; Many n = m;\n"
                        "float b = 3.0; c = vec4(b + n.x[1]);"));
    const Answer all = ask(player, {0, 0});
    EXPECT_EQ(all.number("b"), 3.0);
    EXPECT_EQ(all.number("m.x[1]"), 2.0);
    EXPECT_FALSE(all.notes.empty());
    EXPECT_EQ(all.plain.x, all.colour[0]);
}

// Functions of which the answer is known, computed here in double from the pixel's exact place.
TEST_F(ProbeTest, TellsWhatKnownFunctionsAreInDouble) {
    Player player(
        "float root(float a) { float x = a; for (int i = 0; i < 12; i++) x = 0.5 * (x + a / x); "
        "return x; }\n"
        "float series(float x) { float s = 1.0, t = 1.0; for (int i = 1; i < 20; i++) { t *= x / "
        "float(i); s += t; } return s; }\n"
        "float area(float b) { float s = 0.0; for (int i = 0; i < 64; i++) { float x = b * "
        "(float(i) + 0.5) / 64.0; s += x * x * b / 64.0; } return s; }\n"
        "float horner(float x) { return ((2.0 * x - 3.0) * x + 5.0) * x - 7.0; }\n" +
            image("float x = p.x / 8.0; mat2 m = mat2(0.6, 0.8, -0.8, 0.6); vec2 turned = m * p;\n"
                  "c = vec4(root(x), series(x), area(x), horner(x)) + dot(turned, turned);"),
        {.size = {16, 4}});
    constexpr double kUlp = 1.0 / 16777216.0;  // a rounding is off by this share at most
    for (const int at : {0, 3, 7, 15}) {
        const Answer all = ask(player, {at, 2});
        const double x = (at + 0.5) / 8.0, y = 2.5, px = 8.0 * x;
        // A step of Newton's forgets the errors before it: the last has three roundings.
        EXPECT_NEAR(all.number("root"), std::sqrt(x), 3 * kUlp * std::sqrt(x)) << at;
        // Term i has 2 i roundings, of which the sum of i x^i/i! is x e^x; and 20 sums of at most
        // e^x.
        EXPECT_NEAR(all.number("series"), std::exp(x), (2 * x + 20) * kUlp * std::exp(x)) << at;
        // The midpoint rule is off by b^3/12/64^2 exactly; 64 sums and five roundings of a term.
        const double exact = x * x * x / 3.0 - x * x * x / 12.0 / 4096.0;
        EXPECT_NEAR(all.number("area"), exact, 70 * kUlp * exact) << at;
        // Six roundings, of numbers up to 2 x^3 + 3 x^2 + 5 x + 7.
        const double most = 2 * x * x * x + 3 * x * x + 5 * x + 7;
        EXPECT_NEAR(all.number("horner"), ((2 * x - 3) * x + 5) * x - 7, 6 * kUlp * most) << at;
        // Coefficients, products and a sum, each off by a rounding of the longest side's size.
        const std::vector<double> turned = {0.6 * px - 0.8 * y, 0.8 * px + 0.6 * y};
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_NEAR(all.of("turned").value.at(i), turned[i], 5 * kUlp * (px + y)) << at;
    }
}

TEST_F(ProbeTest, HasItsRowsInOneJson) {
    Probing probing{.scene = "a.frag", .pass = "image", .size = {4, 2}, .pixel = {1, 0}};
    probing.values.push_back({.file = "a.frag",
                              .line = 3,
                              .name = "d",
                              .type = "vec2",
                              .hit = 2,
                              .hits = 5,
                              .value = {0.1f, NAN}});
    const Probing back = probing_from_json(to_json(probing));
    EXPECT_EQ(back.values.at(0).name, "d");
    EXPECT_EQ(back.values.at(0).value.at(0), static_cast<double>(0.1f));
    EXPECT_TRUE(std::isnan(back.values.at(0).value.at(1)));
    EXPECT_EQ(back.pixel, glm::ivec2(1, 0));
}

}  // namespace
}  // namespace glint::probe_test
