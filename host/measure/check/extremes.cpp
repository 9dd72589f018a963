// Extremes that a person can bring a scene to: tweaks, sizes, the mouse.
#include "measure/check/case.h"
#include "measure/check/lines.h"
#include "measure/check/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

namespace glint {
namespace {

constexpr double kExtremesPlayed = 0.5;  // s of a simulation, with each set of tweaks
constexpr double kPlayedSize = 0.1;      // s at each size
constexpr double kPlayedLarge = 1.0 / 60;
constexpr int kLeastLines = 9;        // of fewer each is another
constexpr int kBroad = 96;            // pixels across, of which a line of the scene has some
constexpr double kStandsOut = 0.1;    // of a line's mean, of 1
constexpr double kUsualShare = 0.25;  // of that: the largest step at the sizes beside

TweakValue filled(const Tweak& tweak, double component) {
    TweakValue value{};
    value.fill(component);
    return clamp_to_range(tweak, value);
}

void show_tweaks(Check& check) {
    check.subject.show(check.subject.preset.time, kExtremesPlayed * std::max(check.pace, 0.2));
}

void set_all(CheckSubject& subject, bool to_max) {
    const auto& tweaks = subject.scene().tweaks;
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const auto range = range_of(tweaks[i]);
        if (range) subject.preset.values[i] = filled(tweaks[i], to_max ? range->max : range->min);
    }
}

void set_random(CheckSubject& subject, unsigned seed) {
    std::mt19937 random(seed);
    const auto& tweaks = subject.scene().tweaks;
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const auto range = range_of(tweaks[i]);
        if (!range) continue;
        TweakValue value{};
        for (double& component : value) {
            // Not std::uniform_real_distribution: its numbers differ between libraries.
            const double share = static_cast<double>(random()) / 4294967295.0;
            component = at_share(tweaks[i], *range, share);
        }
        subject.preset.values[i] = clamp_to_range(tweaks[i], value);
    }
}

void add_extreme(std::vector<Case>& list, const Tweak& tweak, std::size_t index, double value) {
    const TweakValue extreme = filled(tweak, value);
    list.push_back({fmt::format("tweak {}={}", tweak.name, format_value(tweak, extreme)),
                    [index, extreme](Check& check, CaseResult&) {
                        check.subject.preset.values[index] = extreme;
                        show_tweaks(check);
                    },
                    Case::Tweaks::one});
}

struct MousePlace {
    const char* name;
    glm::dvec2 at;  // fraction of the picture
};
constexpr MousePlace kMousePlaces[] = {{"bottom left", {0, 0}},    {"bottom right", {1, 0}},
                                       {"top left", {0, 1}},       {"top right", {1, 1}},
                                       {"outside, low", {-2, -2}}, {"outside, high", {3, 3}}};

// Pressed at one place, held, dragged to another, released, and left alone; and the other way,
// since an edge may be met with the button down alone.
void run_mouse(glm::dvec2 press, glm::dvec2 drag, Check& check) {
    const auto frames = [](int count) { return count / 60.0; };
    check.subject.preset.events = {
        {.time = frames(1), .down = true, .mouse = press},
        {.time = frames(3), .down = true, .mouse = drag},
        {.time = frames(5), .down = false, .mouse = drag},
        {.time = frames(8), .down = true, .mouse = drag},
        {.time = frames(10), .down = true, .mouse = press},
        {.time = frames(12), .down = false, .mouse = press},
    };
    check.subject.play_frames(0, 15, 60.0);
}

struct LoneLine {
    double out, usual;  // how far it stands out, and how far any does at the sizes beside
};

// One that is there at this size, where at those beside it nothing is. Leaves the subject at this
// size.
std::optional<LoneLine> lone_line_at(CheckSubject& subject, glm::ivec2 size, int axis) {
    const auto means_at = [&](glm::ivec2 drawn) {
        subject.resize(drawn);
        subject.show(subject.preset.time, kPlayedLarge);
        return means_of_lines(subject.picture(), drawn, axis);
    };
    const LineMeans means = means_at(size);
    const double out = std::max(lone_line(subject.picture(), size, axis), lone_border(means));
    if (size[axis] < kLeastLines || out < kStandsOut) return std::nullopt;
    double usual = 0.0;
    for (const int longer : {-1, 1}) {
        glm::ivec2 beside = size;
        beside[axis] += longer;
        usual = std::max(usual, largest_step(means_at(beside)));
    }
    means_at(size);
    if (usual >= kUsualShare * out) return std::nullopt;
    return LoneLine{out, usual};
}

// What halves a length, or counts from both ends, forgets a line; in words, "" where none does. In
// a picture of few pixels across, what is thinner than one of them looks the same: such a line is
// asked for in a broader one, too.
std::string line_of_this_size_alone(CheckSubject& subject, glm::ivec2 size) {
    for (const int axis : {0, 1}) {
        const auto line = lone_line_at(subject, size, axis);
        if (!line) continue;
        glm::ivec2 broad = size;
        broad[1 - axis] = std::max(size[1 - axis], kBroad);
        const bool stays = broad == size || lone_line_at(subject, broad, axis);
        subject.resize(size);
        subject.show(subject.preset.time, kPlayedLarge);
        if (stays)
            return fmt::format(
                "a {} stands out by {:.2f}; of one pixel more or less none by {:.2f}",
                axis == 0 ? "column" : "row", line->out, line->usual + 0.005);
    }
    return "";
}

// Rows and columns of odd and prime lengths, and between powers of two: what divides by a remainder
// or finds a pixel just in the middle.
void run_many_sizes(Check& check, CaseResult& result) {
    constexpr int kLengths[] = {201, 255, 257, 333, 401, 511, 513, 641, 719, 999, 1021, 1279, 1919};
    constexpr int kThin = 5;
    std::vector<glm::ivec2> sizes = {{203, 207}, {257, 255}, {301, 401}};
    for (const int length : kLengths) {
        sizes.emplace_back(length, kThin);
        sizes.emplace_back(kThin, length);
    }
    const auto count = static_cast<std::size_t>(check.paced(static_cast<int>(sizes.size()), 9));
    sizes.resize(count);
    for (const glm::ivec2 size : sizes) {
        check.subject.resize(size);
        result.note = fmt::format("{}x{}", size.x, size.y);
        if (!check.subject.show(check.subject.preset.time, kPlayedLarge)) return;
        if (const std::string line = line_of_this_size_alone(check.subject, size); !line.empty())
            return result.fail(fmt::format("{}x{}: {}", size.x, size.y, line));
    }
    result.note = fmt::format("{} sizes", count);
}

}  // namespace

void add_tweak_cases(std::vector<Case>& list, const CheckSubject& subject) {
    const auto& tweaks = subject.scene().tweaks;
    if (tweaks.empty()) return;
    for (const bool to_max : {false, true}) {
        list.push_back({fmt::format("all tweaks at their {}", to_max ? "maximum" : "minimum"),
                        [to_max](Check& check, CaseResult&) {
                            set_all(check.subject, to_max);
                            show_tweaks(check);
                        },
                        Case::Tweaks::all});
    }
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const auto range = range_of(tweaks[i]);
        if (!range) continue;
        if (tweaks[i].names.empty()) {
            add_extreme(list, tweaks[i], i, range->min);
            add_extreme(list, tweaks[i], i, range->max);
        } else {
            for (double k = range->min; k <= range->max; ++k) add_extreme(list, tweaks[i], i, k);
        }
    }
}

void add_random_cases(std::vector<Case>& list, const CheckSubject& subject, const Effort& effort) {
    if (subject.scene().tweaks.empty()) return;
    for (int seed = 1; seed <= effort.random.value_or(Effort::kRandom); ++seed) {
        list.push_back({fmt::format("random tweaks {}", seed),
                        [seed](Check& check, CaseResult&) {
                            set_random(check.subject, static_cast<unsigned>(seed));
                            show_tweaks(check);
                        },
                        Case::Tweaks::random});
    }
}

void add_size_cases(std::vector<Case>& list) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {7, 3}, {1, 512}, {512, 1}, {1920, 1080}}) {
        list.push_back(
            {fmt::format("size {}x{}", size.x, size.y), [size](Check& check, CaseResult& result) {
                 CheckSubject& subject = check.subject;
                 const bool large = size.x * size.y > 1'000'000;
                 const double scale = large ? std::sqrt(check.pace) : 1.0;
                 const glm::ivec2 drawn(glm::dvec2(size) * scale);
                 subject.resize(drawn);
                 if (drawn != size)
                     result.note = fmt::format("{}x{}, since frames take long", drawn.x, drawn.y);
                 subject.show(subject.preset.time, large ? kPlayedLarge : kPlayedSize);
             }});
    }
    list.push_back({"odd sizes", run_many_sizes});
}

void add_mouse_cases(std::vector<Case>& list, const CheckSubject& subject) {
    if (!subject.renderer().reads_mouse()) return;
    for (const MousePlace& place : kMousePlaces) {
        // Nobody can press outside; a drag may end there.
        const bool outside = place.at.x < 0.0 || place.at.x > 1.0;
        const glm::dvec2 middle(0.5);
        list.push_back({fmt::format("mouse {}", place.name), [=](Check& check, CaseResult&) {
                            run_mouse(outside ? middle : place.at, outside ? place.at : middle,
                                      check);
                        }});
    }
}

}  // namespace glint
