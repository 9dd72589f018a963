// Where a fault is born, what an assertion says, what a pixel costs.
#include "../render/fixture.h"
#include "measure/probe/assertions.h"
#include "measure/probe/faults.h"
#include "scene/probe_note.h"

#include <random>

namespace glint::probe_faults_test {
namespace {

class ProbeFaults : public GlTest {};

std::optional<ProbeFault> first_fault(Player& player, int frames = 1,
                                      const ProgramOptions& options = {}) {
    FaultWatch watch(player.preset, player.renderer(), options);
    for (int k = 0; k < frames && !watch.is_seen(); ++k) {
        const Frame frame = player.frame(k);
        watch.begin(frame);
        player.draw(frame);
    }
    return watch.first();
}

std::string image(const std::string& body) {
    return "void mainImage(out vec4 c, in vec2 p) {\n" + body + "\n}";
}

TEST_F(ProbeFaults, NameTheOperationItsOperandsAndThePixel) {
    struct {
        const char *body, *expression, *what;
    } cases[] = {
        {"float d = p.x - 2.0; c = vec4(sqrt(d));", "sqrt(d)", "sqrt(-1.5)"},
        {"float d = p.x - 0.5; c = vec4(1.0 / d);", "1.0 / d", "division by zero"},
        {"float d = p.x - 0.5; c = vec4(log(d));", "log(d)", "log(0)"},
        {"float d = p.x + 0.75; c = vec4(acos(d));", "acos(d)", "acos(1.25)"},
        {"float d = p.x - 2.0; c = vec4(pow(d, 0.5));", "pow(d, 0.5)", "pow(-1.5, 0.5)"},
        {"vec3 d = vec3(p.x - 0.5); c = vec4(normalize(d), 1);", "normalize(d)",
         "normalize of a vector of length 0"},
        {"float d = exp(p.x * 200.0); c = vec4(d);", "d", "Inf is born"},
        {"int i = (int(p.x) - 20) % 7; c = vec4(i);", "(int(p.x) - 20) % 7",
         "% of a negative number"},
        {"int i = 20 % int(p.x); c = vec4(i);", "20 % int(p.x)", "division by zero"},
    };
    for (const auto& [body, expression, what] : cases) {
        Player player(image(body), {.size = {1, 1}});
        const auto fault = first_fault(player);
        ASSERT_TRUE(fault) << body;
        EXPECT_EQ(fault->expression, expression);
        EXPECT_EQ(fault->what, what);
        EXPECT_EQ(fault->line, 2);
        EXPECT_EQ(fault->function, "mainImage");
        const bool is_whole = std::string_view(expression).find('%') != std::string_view::npos;
        EXPECT_EQ(fault->is_seen, !is_whole) << body;
    }
}

// They need no name, and the driver may make 0 of 0/d itself.
TEST_F(ProbeFaults, AreFoundInWhatOthersHide) {
    for (const char* body : {"float a = p.x * 1e38 * 9.0; c = vec4(clamp(a - a * 2.0, 0.0, 1.0));",
                             "vec2 zero = vec2(0, 1), d = floor(p / vec2(9, 0.1)); c = "
                             "vec4(max(zero / d, 0.1), 0, 1);"}) {
        Player player(image(body), {.size = {1, 1}});
        EXPECT_TRUE(first_fault(player)) << body;
    }
    // A part of a divisor that is 0, of a quotient that is none, is not that of another part.
    Player parts(image("vec2 d = vec2(floor(p.x), 2); c = vec4(min(vec2(1, 0) / d, 2.0), 0, 1);"),
                 {.size = {1, 1}});
    FaultSurvey survey(parts.preset, parts.renderer(), {});
    const Frame frame = parts.frame(0);
    survey.begin(frame, true);
    parts.draw(frame);
    survey.end();
    EXPECT_FALSE(survey.fault()) << "1/0 is infinite";
}

TEST_F(ProbeFaults, AreNotSeenWhereNothingIsWrong) {
    Player player(image("c = vec4(sqrt(p.x) / p.y, log(p.x), acos(p.x / 4.0), 1.0);"));
    EXPECT_FALSE(first_fault(player));
}

// More operations than are watched at once; or so many that not all are.
std::string long_text(const std::string& body, int count = 70) {
    std::string text = "float many(float x) {\n";
    for (int i = 1; i <= count; ++i) text += fmt::format("    x += 1.0 / (x + {}.0);\n", i);
    return text + "    return x;\n}\n" + image(body);
}

TEST_F(ProbeFaults, OfALongTextAreFoundToo) {
    struct {
        const char *body, *expression, *what;
    } cases[] = {
        {"float d = p.x - 2.0, m = many(p.x); c = vec4(m * sqrt(d));", "sqrt(d)", "sqrt(-1.5)"},
        {"float m = many(p.x) * 1e37, e = m * 99.0; c = vec4(e);", "e", "Inf is born"},
    };
    for (const auto& [body, expression, what] : cases) {
        Player player(long_text(body), {.size = {1, 1}});
        const auto fault = first_fault(player);
        ASSERT_TRUE(fault) << body;
        EXPECT_EQ(fault->expression, expression);
        EXPECT_EQ(fault->what, what);
        EXPECT_EQ(fault->line, 75);
        EXPECT_TRUE(fault->is_seen) << body;
    }
}

TEST_F(ProbeFaults, OfALongTextAreFoundWhereTheyAreHidden) {
    const std::pair<const char*, const char*> texts[] = {
        {"c = vec4(many(p.x) * step(1.0 / (p.x - 0.5), 2.0));", "1.0 / (p.x - 0.5)"},
        {"c = vec4(max(many(p.x) * normalize(p - p).x, 0.25));", "normalize(p - p)"},
    };
    for (const auto& [body, expression] : texts) {
        Player player(long_text(body), {.size = {1, 1}});
        const auto fault = first_fault(player);
        ASSERT_TRUE(fault) << body;
        EXPECT_EQ(fault->expression, expression);
    }
}

constexpr int kTooMany = 300;

TEST_F(ProbeFaults, OfAVeryLongTextThatAreHiddenAreThoseWithoutAResult) {
    Player player(
        long_text("float d = p.x - 2.0; c = vec4(max(many(p.x) * sqrt(d), 0.25));", kTooMany),
        {.size = {1, 1}});
    const auto fault = first_fault(player);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->what, "sqrt(-1.5)");
    Player sound(
        long_text("c = vec4(many(p.x) * sqrt(p.x) * step(1.0 / (p.x - 0.5), 2.0));", kTooMany),
        {.size = {1, 1}});
    EXPECT_FALSE(first_fault(sound));
    const FaultWatch watch(sound.preset, sound.renderer(), {});
    EXPECT_GT(watch.unwatched(), 300u);
}

TEST_F(ProbeFaults, OfADivisionByAConstantThatHasAName) {
    for (const char* body : {"const float z = 0.0; c = vec4(p.x / z);",
                             "const float z = 0.; c = vec4(p, p) / vec4(z);",
                             "float x = p.x; const float z = .0; x /= z; c = vec4(x);"}) {
        Player player(image(body), {.size = {1, 1}});
        const auto fault = first_fault(player);
        ASSERT_TRUE(fault) << body;
        EXPECT_EQ(fault->what, "division by zero") << body;
    }
}

TEST_F(ProbeFaults, OfAVeryLongTextAreWhatASurveyGoesBy) {
    Player player(long_text("c = vec4(many(p.x) * max(sqrt(p.x - 2.0), 0.25));", kTooMany),
                  {.size = {2, 1}});
    FaultSurvey survey(player.preset, player.renderer(), {});
    const Frame frame = player.frame(0);
    survey.begin(frame, true);
    player.draw(frame);
    survey.end();
    ASSERT_EQ(survey.distances().size(), 2u) << "the root, and the operand that begins with it";
    EXPECT_FLOAT_EQ(std::ranges::min(survey.distances()), 0.0f);
    ASSERT_TRUE(survey.fault());
    EXPECT_EQ(survey.fault()->expression, "sqrt(p.x - 2.0)");
}

TEST_F(ProbeFaults, FindAnIndexOutOfRange) {
    Player player(image("float a[3]; a[0] = a[1] = a[2] = 1.0; int i = int(p.x) + 2; c = "
                        "vec4(a[i]);"),
                  {.size = {2, 1}});
    const auto fault = first_fault(player);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->what, "index 3 of 3");
    EXPECT_EQ(fault->pixel, glm::ivec2(1, 0));
}

TEST_F(ProbeFaults, AreBornInTheFirstFrameAndPassThatHasThem) {
    Player player(
        "uniform sampler2D sum; //@ pass mainSum\n"
        "void mainSum(out vec4 c, in vec2 p) {\n"
        "    float left = 3.0 - texelFetch(sum, ivec2(p), 0).x;\n"
        "    c = vec4(texelFetch(sum, ivec2(p), 0).x + 1.0 + 0.0 * sqrt(left - 0.5)); }\n" +
        image("c = texelFetch(sum, ivec2(p), 0) / 9.0;"));
    const auto fault = first_fault(player, 10);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->pass, "sum");
    EXPECT_EQ(fault->line, 4);
    EXPECT_EQ(fault->frame, 3);
    EXPECT_EQ(fault->operands, std::vector<double>{-0.5});
    EXPECT_EQ(fault->pixels, 8u);
}

TEST_F(ProbeFaults, FindAValueThatNothingHasGiven) {
    Player player(image("float never; if (p.x < 0.0) never = 1.0; float d = never + 1.0; c = "
                        "vec4(d);"),
                  {.size = {1, 1}});
    const auto fault =
        first_fault(player, 1, {.marked = Marked{{0, player.preset.scene.text.size()}}});
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->expression, "never");
    EXPECT_EQ(fault->what, "a value that nothing has given it");
}

// Not what becomes of it, which is in order, nor what hides it.
TEST_F(ProbeFaults, NameTheVariableThatIsReadWithoutAValue) {
    const std::pair<const char*, const char*> texts[] = {
        {"int i; int k = i + 1; c = vec4(k);", "i"},
        {"uvec2 u; c = vec4(max(u.y, 7u));", "u.y"},
        {"float un; c = vec4(un > -3.0 ? 0.2 : 0.4);", "un"},
        {"float un; c = vec4(clamp(un, 0.2, 0.8));", "un"},
        {"float good = p.y; float un; good += un; c = vec4(good);", "un"},
        {"float w[3]; w[0] = 1.0; c = vec4(w[0] + w[2]);", "w[2]"},
        {"float un; modf(p.x, un); c = vec4(un); float b; c += b;", "b"},
        {"c = vec4(half_set(p.x - 9.0));", "half_set(p.x - 9.0)"},
        {"int n; n += 2; c = vec4(n > 2);", "n"},
        {"int n; n++; c = vec4(n > 2);", "n"},
        {"int n; while (n++ < 4) c = p.xyxy;", "n"},
        {"ivec2 n; n.x -= 3; c = vec4(n.x);", "n.x"},
        {"int n; leave(n); c = vec4(n > 0);", "n"},
    };
    for (const auto& [body, name] : texts) {
        Player player(
            "float half_set(float x) { if (x > 0.0) return 1.0; }\nvoid leave(out int n) {}\n" +
                image(body),
            {.size = {1, 1}});
        const auto fault =
            first_fault(player, 1, {.marked = Marked{{0, player.preset.scene.text.size()}}});
        ASSERT_TRUE(fault) << body;
        EXPECT_EQ(fault->expression, name) << body;
        EXPECT_EQ(fault->what, "a value that nothing has given it");
    }
}

TEST_F(ProbeFaults, FindIndicesOfColumnsMembersAndResults) {
    const std::pair<const char*, const char*> texts[] = {
        {"mat3x2 m = mat3x2(1); c = vec4(m[1][n]);", "m[1][n]"},
        {"S s = S(float[](.1, .2), vec3(0)); c = vec4(s.w[n]);", "s.w[n]"},
        {"vec2 v[3] = vec2[](vec2(0), vec2(1), vec2(2)); c = vec4(v[n][n]);", "v[n][n]"},
        {"c = vec4(pick()[n]);", "pick()[n]"},
        {"c = vec4(vec2(1, 2)[n]);", "vec2(1, 2)[n]"},
    };
    for (const auto& [body, name] : texts) {
        Player player("struct S { float w[2]; vec3 v; };\nvec2 pick() { return vec2(1); }\n" +
                          image(std::string("int n = int(p.x) + 2; ") + body),
                      {.size = {1, 1}});
        const auto fault = first_fault(player, 1);
        ASSERT_TRUE(fault) << body;
        EXPECT_EQ(fault->expression, name);
        EXPECT_EQ(fault->what, "index 2 of 2");
    }
}

TEST_F(ProbeFaults, FindANegativeNumberWhoseRestIsAssigned) {
    Player player(image("ivec2 i = ivec2(p) - 3; i %= 3; c = vec4(i, 0, 1);"), {.size = {8, 1}});
    const auto fault = first_fault(player, 1);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->expression, "i %= 3");
    EXPECT_EQ(fault->what, "% of a negative number");
}

TEST_F(ProbeFaults, AreBornWhereAGlobalBeginsWithThem) {
    Player player("const float none = 2.0 - 2.0;\nfloat first = 1.0 / none;\n" +
                      image("float q = first * p.x; c = vec4(q);"),
                  {.size = {1, 1}});
    const auto fault = first_fault(player, 1);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->line, 2);
    EXPECT_EQ(fault->expression, "first");
}

std::vector<BrokenAssertion> broken(Player& player, int frame = 0) {
    return broken_assertions(player.preset, player.renderer(), {},
                             [&](const BrokenAssertions&) { player.draw(frame); });
}

TEST_F(ProbeFaults, AnAssertionStandsBehindAllOfItsLine) {
    const std::pair<const char*, bool> lines[] = {
        {"if (p.x > 0.0) z = 1.0; else z = 2.0; //@ assert z < 3.0", true},
        {"if (p.x > 0.0) { z = 8.0; } //@ assert z == 8.0", true},
        {"switch (1) { case 1: z = 9.0; } //@ assert z == 9.0", true},
        {"for (int i = 0; i < 3; i++) z += 1.0; //@ assert z == 8.0", true},
        {"for (int i = 0; i < 3; i++) z += 1.0; //@ assert z < 8.0", false},
        {"if (z > 9.0) return; //@ assert z <= 9.0", true},
        {"if (p.x > 0.0) //@ assert z == 5.0\n z = 1.0;", true},
    };
    for (const auto& [line, holds] : lines) {
        Player player(image(fmt::format("float z = 5.0;\n{}\nc = vec4(z);", line)),
                      {.size = {1, 1}});
        EXPECT_EQ(broken(player).empty(), holds) << line;
    }
}

TEST_F(ProbeFaults, AnAssertionOutsideOfAllFunctionsIsRefused) {
    Player player("//@ assert 1.0 > 2.0\n" + image("c = vec4(1);"), {.size = {1, 1}});
    const std::vector<BrokenAssertion> found = broken(player);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].refused, "it stands in no function");
}

TEST_F(ProbeFaults, BrokenAssertionsAreFoundWhereNothingHasMovedSince) {
    Player player(image("//@ assert p.x < 1.0\nc = vec4(1.0);"), {.size = {2, 1}});
    player.draw(0);
    ASSERT_EQ(broken(player).size(), 1u);
    EXPECT_EQ(broken(player)[0].pixels, 1u);
}

// What frames before have left is what a text asserts something of.
TEST_F(ProbeFaults, AssertionsAreAskedInTheStateThatStands) {
    Player player(
        "uniform sampler2D sum; //@ pass mainSum size=2x1\n"
        "void mainSum(out vec4 c, in vec2 p) {\n"
        "    c = texelFetch(sum, ivec2(p), 0) + 1.0;\n"
        "    //@ assert c.x < 4.0\n}\n" +
            image("vec4 seen = texelFetch(sum, ivec2(0), 0);\n"
                  "    //@ assert seen.x < 4.0\n"
                  "    c = seen;"),
        {.size = {2, 2}});
    for (int frame = 0; frame < 4; ++frame) player.draw(frame);
    const auto list = broken(player, 4);
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].pass, "sum");
    EXPECT_EQ(list[0].pixels, 2u);
    EXPECT_EQ(list[1].pass, "image");
    EXPECT_EQ(list[1].pixels, 4u);
}

TEST_F(ProbeFaults, AnAssertionOfTwoPassesIsToldOfEach) {
    Player player(
        "uniform sampler2D b; //@ pass mainB size=2x1\n"
        "float half_of(float x) {\n    //@ assert x < 1.0\n    return x * 0.5;\n}\n"
        "void mainB(out vec4 c, in vec2 p) { c = vec4(half_of(p.x)); }\n" +
            image("c = texelFetch(b, ivec2(0), 0) + half_of(p.x);"),
        {.size = {4, 1}});
    const auto list = broken(player);
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].pass, "b");
    EXPECT_EQ(list[0].pixels, 1u);
    EXPECT_EQ(list[1].pass, "image");
    EXPECT_EQ(list[1].pixels, 3u);
}

TEST_F(ProbeFaults, CountTheAssertionsThatFailAtOnePixelEach) {
    std::string body;
    for (int i = 0; i < 70; ++i) body += fmt::format("//@ assert p.x > {}.0\n", i);
    Player player(image(body + "c = vec4(1.0);"), {.size = {4, 1}});
    const auto list = broken(player);
    ASSERT_EQ(list.size(), 69u);  // 0.5 is above 0 alone
    EXPECT_EQ(list[0].line, 3);
    EXPECT_EQ(list[0].pixels, 1u);
    EXPECT_EQ(list[1].pixels, 2u);
    EXPECT_EQ(list[68].pixels, 4u);
    EXPECT_EQ(list[68].line, 71);
}

TEST_F(ProbeFaults, CountThePixelsWhereAnAssertionDoesNotHold) {
    Player player(image("float t = p.x - 1.0;\n"
                        "//@ assert t >= 0.0 \"behind the eye\"\n"
                        "for (int i = 0; i < 3; ++i) {\n"
                        "    //@ assert i < 2\n"
                        "    c += t;\n"
                        "}\n"
                        "//@ watch t, max(t, 1.0)\n"),
                  {.size = {4, 2}});
    const auto list = broken(player);
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(sentence_of(list[0]),
              "assert t >= 0.0 \"behind the eye\" does not hold in 2 pixels of image, first at "
              "0,0");
    EXPECT_EQ(list[0].line, 3);
    EXPECT_EQ(list[1].pixels, 8u);
    const auto notes = find_probe_notes(player.preset.scene);
    ASSERT_EQ(notes.size(), 4u) << "a watch for each of two values";
    EXPECT_EQ(notes[2].expression, "t");
    EXPECT_EQ(notes[3].expression, "max(t, 1.0)");
    EXPECT_FALSE(notes[3].is_assertion);
}

// The driver sees it at the next statement: what it says is told at the comment's own line.
TEST_F(ProbeFaults, AnAssertionThatIsNoExpressionIsToldAtItsLineAndKeepsNobodyFromAskingTheOthers) {
    Player player(image("//@ assert tt > 0.0\n"
                        "//@ assert p.x < 1.0\n"
                        "\n"
                        "c = vec4(1.0);"),
                  {.size = {2, 1}});
    const auto list = broken(player);
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].line, 2);
    EXPECT_NE(sentence_of(list[0]).find("cannot be evaluated"), std::string::npos);
    EXPECT_NE(sentence_of(list[0]).find("tt"), std::string::npos) << sentence_of(list[0]);
    EXPECT_EQ(list[1].pixels, 1u);
}

TEST_F(ProbeFaults, CountTurnsReadsAndCallsOfAPixel) {
    Player player(
        "uniform sampler2D grain; //@ noise rgba 16\n"
        "float f(int n) { float s = 0.0; for (int i = 0; i < n; ++i) s += texelFetch(grain, "
        "ivec2(i), 0).x; return s; }\n" +
        image("c = vec4(f(int(p.x)) + f(2));"));
    Probe probe(player.preset, kImagePass, {}, {.kind = ProbeKind::cost});
    player.draw(0);
    const auto cells = probe.map(player.renderer(), player.frame(0), 0, 0);
    EXPECT_EQ(cells[3].kept, (std::array<std::uint32_t, 4>{5, 5, 3, 0}));
    EXPECT_EQ(cells[0].kept, (std::array<std::uint32_t, 4>{2, 2, 3, 0}));
}

// At how many places of a scene instrumented programs draw as the plain ones do.
struct Comparison {
    std::size_t places = 0, bits = 0, bytes = 0;
    std::string refused{};
};

// At a thousand random places of a buffer as it was drawn last.
void compare(const std::vector<ProbeCell>& cells, const Renderer& renderer, std::size_t pass,
             Comparison& result) {
    const BufferShape& shape = renderer.buffer(pass).shape();
    std::mt19937 random(19);
    for (int i = 0; i < 1000; ++i) {
        const glm::ivec2 at(random() % static_cast<unsigned>(shape.size.x),
                            random() % static_cast<unsigned>(shape.size.y));
        const ProbeCell& cell = cells[static_cast<std::size_t>(at.y * shape.size.x + at.x)];
        if (cell.told[3] == 0) continue;  // discarded
        const std::string same =
            same_colour(renderer.read_pixel(pass, 0, at), cell.colour, shape.format);
        ++result.places;
        result.bits += same == "bits";
        result.bytes += same == "bits" || same == "bytes";
    }
}

// Of all passes but those that fill cubes.
Comparison compare_with_plain(const std::filesystem::path& file) {
    Comparison result;
    ReadPreset read = read_preset(file);
    if (!read.preset) return {.refused = "not read"};
    Preset& preset = *read.preset;
    preset.size = {96, 54};
    CompileResult compiled = compile_scene(preset, {});
    if (!compiled.scene) return {.refused = "not compiled"};
    Renderer renderer(preset, std::move(*compiled.scene),
                      {.size = preset.size, .picture_format = PixelFormat::rgba32f});
    load_inputs(preset, renderer);
    const auto& passes = renderer.graph().passes;
    std::vector<std::optional<Probe>> probes(passes.size());
    std::vector<std::vector<ProbeCell>> cells(passes.size());
    try {
        for (std::size_t i = 0; i < passes.size(); ++i)
            if (!renderer.buffer(i).shape().cube)
                probes[i].emplace(preset, passes[i].pass, ProgramOptions{}, ProbeWish{});
    } catch (const ProbeRefused& refused) {
        return {.refused = refused.what()};
    }
    renderer.before_pass = [&](std::size_t drawn) {
        if (probes[drawn]) cells[drawn] = probes[drawn]->map(renderer, Frame{}, 0, 0);
    };
    for (int k = 0; k < 3; ++k) renderer.draw(Playback{.end = 1e6, .fps = 60.0}.frame(preset, k));
    renderer.before_pass = nullptr;
    for (std::size_t i = 0; i < passes.size(); ++i)
        if (!cells[i].empty()) compare(cells[i], renderer, i, result);
    return result;
}

// Of all scenes in a folder, those whose names have this in them; tells of each.
void compare_all(const char* folder, std::string_view ending, std::string_view within) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(GLINT_REPOSITORY) / folder)) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(ending) || name.find(within) == name.npos) continue;
        const Comparison found = compare_with_plain(entry.path());
        if (found.refused.starts_with("not ")) continue;
        ++files;
        fmt::print("{:<44} {:>5} places, {:>5} the same bits, {:>5} bytes {}\n", name, found.places,
                   found.bits, found.bytes, found.refused);
        EXPECT_EQ(found.refused, "") << name;
        // A driver may reorder sums where more of them are kept: a silhouette may flip.
        EXPECT_GE(static_cast<double>(found.bytes), 0.999 * static_cast<double>(found.places))
            << name;
    }
    EXPECT_GT(files, 0u);
}

class ProbeScenes : public GlTest {};
class AllProbeScenes : public ProbeScenes {};
// One scene each, so that it can be run in pieces.
class AllProbePresets : public ProbeScenes, public ::testing::WithParamInterface<const char*> {};

TEST_F(ProbeScenes, ShortTextsAreDrawnAsThePlainOnesAre) {
    compare_all("tests/corpus/shaders", ".glsl", "golfed");
    compare_all("tests/corpus/shaders", ".glsl", "macro_o");
}

TEST_F(AllProbeScenes, OfTheCorpusAreDrawnAsThePlainOnesAre) {
    compare_all("tests/corpus/shaders", ".glsl", "");
}

TEST_P(AllProbePresets, AreDrawnAsThePlainOnesAre) {
    compare_all("presets", ".toml", GetParam() + std::string(".toml"));
}

INSTANTIATE_TEST_SUITE_P(Long, AllProbePresets,
                         ::testing::Values("analytic", "boat", "caustics", "christmas",
                                           "deep_ocean", "magic", "sea", "terrain", "water"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace glint::probe_faults_test
