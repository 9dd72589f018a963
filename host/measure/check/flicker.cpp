// What the eye sees from frame to frame: flashes, and things that run faster on a faster screen.
#include "measure/check/flicker.h"

#include "measure/check/budget.h"
#include "measure/check/situation.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace glint {
namespace {

constexpr std::size_t kSetsOfEnds = 5;
constexpr glm::ivec2 kTiles(8, 6);

double linear(float shown) {
    const double v = std::clamp(static_cast<double>(shown), 0.0, 1.0);
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// The mean linear colours of tiles.
std::vector<glm::dvec3> tile_colours(const std::vector<float>& picture, glm::ivec2 size) {
    std::vector<glm::dvec3> sums(static_cast<std::size_t>(kTiles.x * kTiles.y));
    std::vector<double> counts(sums.size());
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto tile =
                static_cast<std::size_t>(y * kTiles.y / size.y * kTiles.x + x * kTiles.x / size.x);
            const float* pixel = &picture[static_cast<std::size_t>(y * size.x + x) * 4];
            sums[tile] += glm::dvec3(linear(pixel[0]), linear(pixel[1]), linear(pixel[2]));
            counts[tile] += 1.0;
        }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(counts[i], 1.0);
    return sums;
}

// ---- Frame rates --------------------------------------------------------------------------------

// s, where the pictures of all rates are compared: later, and with the mouse or keys held before
// what they move meets a limit.
constexpr double kMet = 0.5, kMetHeld = 0.1;
// s; what has no state meets no limit, and shows late what begins slowly.
constexpr std::array kStateless = {kMet, 2.3, 7.1};
// s, where it is looked for what fades: what flashes up now and then has by one of them, and what
// the mouse or keys left once they are let go.
constexpr std::array kFading = {kMet, 0.7, 1.2};
constexpr double kLetGo = 0.2, kFaded = 0.4;
constexpr double kFastest = 240.0;  // Hz
// A finer rate comes nearer to the truth: the last doubling changes at most this share of what the
// one before did, or less than a clear mark on the picture, or little beside what a frame does.
constexpr double kShare = 0.7, kClear = 0.5, kBesideFrame = 1.5;

// Red, green and blue as a display shows them, each the mean of 3x3 pixels, so that a rounding at
// an edge is small and a thing of two pixels is not.
std::vector<float> blurred(const std::vector<float>& picture, glm::ivec2 size) {
    std::vector<float> result;
    result.reserve(picture.size());
    const auto at = [&](int x, int y, std::size_t c) {
        x = std::clamp(x, 0, size.x - 1);
        y = std::clamp(y, 0, size.y - 1);
        return std::clamp(picture[static_cast<std::size_t>(y * size.x + x) * 4 + c], 0.0f, 1.0f);
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0.0f;
                for (int i = 0; i < 9; ++i) sum += at(x + i % 3 - 1, y + i / 3 - 1, c);
                result.push_back(sum / 9.0f);
            }
    return result;
}

double largest_off(const std::vector<float>& a, const std::vector<float>& b) {
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        off = std::max(off, static_cast<double>(std::abs(a[i] - b[i])));
    return off;
}

// The mean of each channel of what is fed back.
std::vector<double> state_means(const CheckSubject& subject) {
    std::vector<double> means;
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!subject.is_fed_back(i)) continue;
        const std::vector<float> values = subject.renderer().read_buffer(i, 0);
        std::array<double, 4> sums{};
        for (std::size_t k = 0; k < values.size(); ++k)
            if (std::isfinite(values[k])) sums[k % 4] += static_cast<double>(values[k]);
        for (const double sum : sums)
            means.push_back(sum / std::max(1.0, static_cast<double>(values.size()) / 4.0));
    }
    return means;
}

// Of what is fed back as many texels as tell of all.
std::vector<float> state_texels(const CheckSubject& subject) {
    constexpr std::size_t kMost = 65536;  // of a buffer
    std::vector<float> texels;
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!subject.is_fed_back(i)) continue;
        const std::vector<float> values = subject.renderer().read_buffer(i, 0);
        const std::size_t step = 1 + values.size() / 4 / kMost;
        for (std::size_t k = 0; k + 3 < values.size(); k += 4 * step)
            texels.insert(texels.end(), {values[k], values[k + 1], values[k + 2], values[k + 3]});
    }
    return texels;
}

struct Shown {
    std::vector<float> last{}, before{};  // blurred
    std::vector<glm::dvec3> tiles{};      // their mean light
    std::vector<double> state{};
    std::vector<float> texels{};
};

// At 60, 120 and 240 Hz.
using Rates = std::array<Shown, 3>;

// Plays on from the frame that is given.
bool show_at_rate(CheckSubject& subject, int from, double met, double fps, Shown& shown) {
    const int frames = static_cast<int>(std::lround(met * fps));
    if (!subject.stateful()) from = frames - 1;
    if (!subject.play_frames(from, frames, fps)) return false;
    shown.before = blurred(subject.picture(), subject.preset.size);
    if (!subject.play_frames(frames, frames + 1, fps)) return false;
    shown.last = blurred(subject.picture(), subject.preset.size);
    shown.tiles = tile_colours(subject.picture(), subject.preset.size);
    shown.state = state_means(subject);
    shown.texels = state_texels(subject);
    return true;
}

// At each of these moments; nothing where a frame was not finite.
std::vector<Rates> show_at_rates(CheckSubject& subject, std::span<const double> moments) {
    std::vector<Rates> all(moments.size());
    for (std::size_t i = 0; i < 3; ++i) {
        const double fps = kFastest / (4 >> i);
        subject.renderer().reset();
        int from = 0;
        for (std::size_t k = 0; k < moments.size(); ++k) {
            if (!show_at_rate(subject, from, moments[k], fps, all[k][i])) return {};
            from = static_cast<int>(std::lround(moments[k] * fps)) + 1;
        }
    }
    return all;
}

// What is added in every frame, however long it is, is twice as much at twice the rate, and shows:
// half of a step that converges is left. Where frames are counted, what is added is divided by
// that.
bool is_added_by_frames(const Rates& shown, double met) {
    constexpr double kLight = 0.01, kMoreThanHalf = 0.53, kDoubled = 1.6, kOfIt = 0.05;
    const auto is_seen = [&](std::size_t tile) {
        const double coarse = glm::length(shown[1].tiles[tile] - shown[0].tiles[tile]);
        const double fine = glm::length(shown[2].tiles[tile] - shown[1].tiles[tile]);
        return fine > kLight && fine > kMoreThanHalf * coarse;
    };
    const auto doubles = [&](std::size_t channel) {
        const double coarse = shown[1].state[channel] - shown[0].state[channel];
        const double fine = shown[2].state[channel] - shown[1].state[channel];
        return std::abs(fine) > kOfIt * std::abs(shown[2].state[channel]) && fine * coarse > 0.0 &&
               std::abs(fine) > kDoubled * std::abs(coarse);
    };
    const auto counts = [&](std::size_t channel) {
        const double frames = met * kFastest;
        return std::abs(shown[2].state[channel] - frames) < 2.0 &&
               std::abs(shown[1].state[channel] - frames / 2.0) < 2.0;
    };
    const auto any = [](std::size_t count, const auto& is) {
        for (std::size_t i = 0; i < count; ++i)
            if (is(i)) return true;
        return false;
    };
    const std::size_t channels = shown[0].state.size();
    return any(shown[0].tiles.size(), is_seen) && any(channels, doubles) && !any(channels, counts);
}

// What is multiplied by a share in every frame, however long it is, has the square of it at twice
// the rate, of which again the square is left at twice that.
bool is_squared(double slow, double middle, double fast) {
    constexpr double kOfSquare = 0.25;
    return middle > 0.0 && fast > 0.0 &&
           std::abs(std::log(fast / middle) / std::log(middle / slow) - 2.0) < kOfSquare;
}

constexpr double kFadedTo = 0.85;

// All of it together, where it is much of the picture.
bool fades_by_frames(const Rates& shown) {
    constexpr double kLight = 0.01;
    bool any_seen = false, any_squared = false;
    for (std::size_t i = 0; i < shown[0].tiles.size(); ++i)
        any_seen |= glm::length(shown[1].tiles[i] - shown[0].tiles[i]) > kLight;
    for (std::size_t i = 0; i < shown[0].state.size(); ++i) {
        const double slow = shown[0].state[i], middle = shown[1].state[i];
        any_squared |= middle < kFadedTo * slow && is_squared(slow, middle, shown[2].state[i]);
    }
    return any_seen && any_squared;
}

// Most of what fades, texel by texel, such as what a small thing that moves leaves behind.
bool leaves_fade_by_frames(const Rates& shown) {
    constexpr double kMark = 0.05, kMost = 0.6, kOfLargest = 0.02;
    constexpr std::size_t kLeast = 32;
    if (largest_off(shown[0].last, shown[1].last) < kMark) return false;
    const std::vector<float>& slow = shown[0].texels;
    if (slow.empty()) return false;
    const double least = kOfLargest * static_cast<double>(std::ranges::max(slow));
    std::size_t faded = 0, squared = 0;
    for (std::size_t i = 0; i < slow.size(); ++i) {
        const double here = static_cast<double>(slow[i]);
        const double middle = static_cast<double>(shown[1].texels[i]);
        if (!(here > least) || !(middle < kFadedTo * here)) continue;
        ++faded;
        squared += is_squared(here, middle, static_cast<double>(shown[2].texels[i]));
    }
    return squared >= kLeast && static_cast<double>(squared) > kMost * static_cast<double>(faded);
}

void find_fading(const Rates& shown, double met, CaseResult& result) {
    if (fades_by_frames(shown) || leaves_fade_by_frames(shown))
        result.fail(fmt::format(
            "something fades by a share in every frame, however long it is: after {} s twice the "
            "rate leaves the square of it; mix by 1.0 - exp(-rate * iTimeDelta), or use step=",
            met));
}

void compare_rates(const Rates& shown, double met, CaseResult& result) {
    const double coarse = largest_off(shown[0].last, shown[1].last);
    const double fine = largest_off(shown[1].last, shown[2].last);
    const double frame = std::max(largest_off(shown[2].last, shown[2].before),
                                  largest_off(shown[0].last, shown[0].before));
    result.note = fmt::format("from 60 to 120 Hz {:.2f}, from 120 to 240 Hz {:.2f}, a frame {:.2f}",
                              coarse, fine, frame);
    if (is_added_by_frames(shown, met))
        result.fail(fmt::format(
            "something is added in every frame, however long it is: after {} s there is twice as "
            "much of it at twice the rate; use iTime, iTimeDelta or step=",
            met));
    else if (fine > kClear && fine > kShare * coarse && fine > kBesideFrame * frame)
        result.fail(
            fmt::format("something follows the frame rate: after {} s pixels of 120 and 240 Hz "
                        "differ by {:.2f}, those of 60 and 120 Hz by {:.2f}, and a frame from the "
                        "next by {:.2f}; use iTime, iTimeDelta or step=",
                        met, fine, coarse, frame));
}

// Whether rates differ by the same at all moments: what tells the rate, such as a meter of frames
// a second.
bool is_a_meter(const std::vector<Rates>& shown) {
    for (const Rates& later : shown)
        for (std::size_t i = 0; i < later[0].last.size(); ++i) {
            const auto apart = [i](const Rates& at) { return at[2].last[i] - at[1].last[i]; };
            if (std::abs(apart(later) - apart(shown.front())) > static_cast<float>(kClear))
                return false;
        }
    return true;
}

// Leaves the subject where a still of what was found has it.
void show_again(CheckSubject& subject, double met) {
    subject.renderer().reset();
    subject.play_frames(0, static_cast<int>(std::lround(met * kFastest)) + 1, kFastest);
}

// Of what the mouse or keys that are held leave when they are let go.
void find_left_fading(CheckSubject& subject, CaseResult& result) {
    std::vector<Event>& events = subject.preset.events;
    if (events.empty() || !subject.stateful() || !subject.observed().is_finite()) return;
    const std::vector<Event> held = events;
    for (Event let_go : held) {
        let_go.time = kLetGo;
        let_go.down = false;
        events.push_back(let_go);
    }
    const std::array moments = {kFaded};
    for (const Rates& shown : show_at_rates(subject, moments)) find_fading(shown, kFaded, result);
    if (result.verdict == CaseVerdict::fail)
        result.note += fmt::format("; let go at {} s", kLetGo);
    else
        events = held;
}

// With the preset's values, where all tweaks are at an end of their ranges, and with the mouse or
// keys held.
void run_frame_rates(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const CaseClock clock(check);
    std::string first;
    for (const Situation& one : situations(subject, kSetsOfEnds, 0)) {
        one.bring(subject);
        std::vector<double> moments = {kMet};
        if (!one.events.empty()) moments = {kMetHeld, kMet};
        if (first.empty() && subject.stateful() && check.pace == 1.0)
            moments.assign(kFading.begin(), kFading.end());
        if (!subject.stateful()) moments.assign(kStateless.begin(), kStateless.end());
        std::vector<Rates> shown = show_at_rates(subject, moments);
        if (!subject.stateful() && !subject.reads(Builtin::frame) && is_a_meter(shown)) {
            if (first.empty()) first = "rates differ by the same at all moments, or not at all";
            shown.clear();
        }
        for (std::size_t i = 0; i < shown.size() && result.verdict != CaseVerdict::fail; ++i) {
            if (moments[i] <= kMet || !subject.stateful())
                compare_rates(shown[i], moments[i], result);
            if (first.empty()) first = result.note;
            find_fading(shown[i], moments[i], result);
            if (result.verdict == CaseVerdict::fail) show_again(subject, moments[i]);
        }
        if (result.verdict != CaseVerdict::fail) find_left_fading(subject, result);
        if (result.verdict == CaseVerdict::fail) result.note += where_words(one, subject);
        if (!subject.observed().is_finite() || result.verdict == CaseVerdict::fail) return;
        if (clock.is_over(0.03)) break;
    }
    result.note = first;
}

// ---- Flashes ------------------------------------------------------------------------------------

// After WCAG 2.3.1. A general flash: the luminance of more than a quarter of the picture goes up
// and down, or down and up, by a tenth of the brightest more than three times within a second, the
// darker one below 0.8. A red flash: so does a red that is at least 0.8 of its colour, by 20 of 320
// of what it has more than green and blue.
constexpr double kChange = 0.1, kDark = 0.8, kArea = 0.25;
constexpr double kRedChange = 20.0 / 320.0, kRedShare = 0.8;
constexpr int kMostFlashes = 3, kSecond = 60, kFlickerFrames = 90;  // frames at 60 Hz

double luminance(glm::dvec3 colour) {
    return glm::dot(colour, {0.2126, 0.7152, 0.0722});
}

double saturated_red(glm::dvec3 colour) {
    const double others = colour.g + colour.b;
    return colour.r >= kRedShare * (colour.r + others) ? std::max(0.0, colour.r - others) : 0.0;
}

// The changes of a tile that count, as they come: in which frames its luminance, or its red,
// turned.
class Turns {
public:
    Turns(double change, double dark) : change_(change), dark_(dark) {}

    void add(double now, int frame) {
        if (frame == 0) low_ = high_ = now;
        low_ = std::min(low_, now);
        high_ = std::max(high_, now);
        const bool rises = now - low_ >= change_ && low_ < dark_;
        const bool falls = high_ - now >= change_ && now < dark_;
        if (rises && direction_ != 1) turn(1, now, frame);
        if (falls && direction_ != -1) turn(-1, now, frame);
        if (direction_ == 1) low_ = now < high_ ? low_ : now;
        if (direction_ == -1) high_ = now > low_ ? high_ : now;
    }
    // The most within a second.
    int flashes() const {
        std::size_t most = 0;
        for (std::size_t i = 0, first = 0; i < frames_.size(); ++i) {
            while (frames_[i] - frames_[first] >= kSecond) ++first;
            most = std::max(most, i - first + 1);
        }
        return static_cast<int>(most / 2);
    }

private:
    void turn(int direction, double now, int frame) {
        direction_ = direction;
        low_ = high_ = now;
        frames_.push_back(frame);
    }
    double change_, dark_, low_ = 0.0, high_ = 0.0;
    int direction_ = 0;
    std::vector<int> frames_;
};

// Tweaks at their ends with the mouse pressed or a key held, or had been.
void add_both(std::vector<Situation>& all, const CheckSubject& subject) {
    const std::size_t count = all.size();
    for (std::size_t i = 1; i < count; ++i)
        for (std::size_t k = 1; k < count; ++k)
            if (all[i].values != subject.opened().values &&
                all[i].events == subject.opened().events &&
                all[k].values == subject.opened().values &&
                all[k].events != subject.opened().events)
                all.push_back({all[i].values, all[k].events, all[k].time, all[k].date});
}

// For tiles in which a row of pixels is little.
glm::ivec2 large_enough(glm::ivec2 size) {
    constexpr int kLeastOfTile = 9;
    int times = 1;
    while (std::min(size.x * times / kTiles.x, size.y * times / kTiles.y) < kLeastOfTile) ++times;
    return size * times;
}

// With the preset's values, and where all tweaks are at an end of their ranges; of a simulation
// with the preset's alone: at its stiffest it may well flash, and nobody knows what was meant. With
// the mouse or keys held, and later.
void run_flashes(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const CaseClock clock(check);
    std::vector<Situation> all = situations(subject, subject.stateful() ? 1 : kSetsOfEnds, 0);
    add_both(all, subject);
    for (const Situation& one : all) {
        one.bring(subject);
        if (!subject.stateful()) subject.resize(large_enough(subject.preset.size));
        const auto area = flashing_area(check, one.time);
        if (!area) return;
        if (result.note.empty())
            result.note = fmt::format("{:.0f} % of the picture flashes", 100.0 * *area);
        const std::string why = too_many_flashes(*area);
        if (!why.empty()) return result.fail(why + where_words(one, subject));
        if (clock.is_over(0.03)) break;
    }
}

}  // namespace

std::optional<double> flashing_area(Check& check, double time) {
    CheckSubject& subject = check.subject;
    // The edge of what moves enters a tile by a row or a column of pixels, which is no flash.
    constexpr double kMostOfEdge = 0.35;  // in pictures of a few pixels all is an edge
    const glm::ivec2 pixels = glm::max(subject.preset.size / kTiles, glm::ivec2(1));
    const double edge = std::min(1.05 / std::min(pixels.x, pixels.y), kMostOfEdge);
    struct Tile {
        Turns any, red;
    };
    std::vector<Tile> tiles(static_cast<std::size_t>(kTiles.x * kTiles.y),
                            {{std::max(kChange, edge), kDark}, {std::max(kRedChange, edge), 1.0}});
    const int frames = check.paced(kFlickerFrames, kSecond / 2);
    const int first = subject.stateful() ? 0 : static_cast<int>(time * 60.0);
    for (int k = 0; k < frames; ++k) {
        if (!subject.play_frames(first + k, first + k + 1, 60.0)) return {};
        const auto now = tile_colours(subject.picture(), subject.preset.size);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            tiles[i].any.add(luminance(now[i]), k);
            tiles[i].red.add(saturated_red(now[i]), k);
        }
    }
    const auto flashing = std::ranges::count_if(tiles, [](const Tile& tile) {
        return std::max(tile.any.flashes(), tile.red.flashes()) > kMostFlashes;
    });
    return static_cast<double>(flashing) / static_cast<double>(tiles.size());
}

std::string too_many_flashes(double area) {
    return area > kArea ? fmt::format("{:.0f} % of the picture flashes more than {} times a second",
                                      100.0 * area, kMostFlashes)
                        : "";
}

void add_frame_rate_case(std::vector<Case>& list, const CheckSubject& subject) {
    const bool counts_frames = subject.reads(Builtin::frame) ||
                               subject.reads(Builtin::frame_rate) ||
                               subject.reads(Builtin::time_delta);
    if (subject.stateful() || counts_frames)
        list.push_back({"frame rates", run_frame_rates,
                        subject.scene().tweaks.empty() ? Case::Tweaks::none : Case::Tweaks::all});
}

void add_flash_case(std::vector<Case>& list, const CheckSubject& subject) {
    const bool ends = !subject.stateful() && !subject.scene().tweaks.empty();
    if (subject.moves() || (ends && reads_a_clock(subject.scene().text)))
        list.push_back({"flashes", run_flashes, ends ? Case::Tweaks::all : Case::Tweaks::none});
}

}  // namespace glint
