// Events get a short time that lies between the frame before and the one that saw them.
#include "scene/recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glint {

namespace {

constexpr double kNextFrame = 1.0 / 60.0;                             // s
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();  // known with the frame

// The shortest decimal in (after, time], so that a saved recording is readable.
double short_time(double after, double time) {
    for (const double parts : {1e2, 1e3, 1e4, 1e5}) {
        const double shorter = std::floor(time * parts) / parts;
        if (shorter > after && shorter <= time) return shorter;
    }
    return time;
}

double five_decimals(double value) {
    return std::round(value * 1e5) / 1e5;
}

}  // namespace

glm::dvec2 mouse_fraction(glm::dvec2 cursor, glm::ivec2 size) {
    const glm::dvec2 pixels(std::max(size.x, 1), std::max(size.y, 1));
    const double x = (std::floor(cursor.x) + 0.5) / pixels.x;
    const double y = 1.0 - (std::floor(cursor.y) + 0.5) / pixels.y;
    return {five_decimals(x), five_decimals(y)};
}

void Recorder::start(double time, const InputState& state, std::span<const Event> before,
                     const InputReads& reads) {
    *this = {};
    recording_ = true;
    last_time_ = time;
    InputState replayed;
    for (const Event& event : before) replayed.apply(event);
    for (const Event& event : state.as_events(0.0)) held_.follow(event);
    events_ = state.as_events(std::max(time, 0.0), replayed);
    std::erase_if(events_,
                  [&](const Event& event) { return event.key >= 0 ? !reads.keys : !reads.mouse; });
    for (const Event& event : events_) own_.follow(event);
    seen_own_ = own_;
}

void Recorder::go_on_from(double time, const InputState& state) {
    start(time, state);
    forget_before(std::numeric_limits<double>::infinity());
}

void Recorder::Held::follow(const Event& event) {
    if (event.key >= 0) {
        keys[static_cast<std::size_t>(event.key)] = event.down;
    } else {
        mouse = event.down;
        position = event.mouse;
    }
}

void Recorder::mouse(glm::dvec2 fraction, bool down) {
    const bool is_number = std::isfinite(fraction.x) && std::isfinite(fraction.y);
    const bool moves = down && held_.mouse;
    if (!recording_ || (down && !is_number) || (!down && !held_.mouse)) return;
    if (moves && fraction == held_.position) return;
    // Where the button is let go does not count.
    const Event event{.time = kNoTime, .down = down, .mouse = down ? fraction : held_.position};
    held_.follow(event);
    own_.follow(event);
    if (moves && last_move_) {
        pending_[*last_move_].mouse = fraction;
        return;
    }
    pending_.push_back(event);
    last_move_ = moves ? std::optional(pending_.size() - 1) : std::nullopt;
}

void Recorder::key(int code, bool down) {
    if (!recording_ || code < 0 || code >= kKeyCount) return;
    if (held_.keys[static_cast<std::size_t>(code)] == down) return;
    pending_.push_back({.time = kNoTime, .key = code, .down = down});
    held_.follow(pending_.back());
    own_.follow(pending_.back());
}

// What its events let go, or hold, is no longer a person's.
void Recorder::replayed(const Event& event) {
    if (!recording_) return;
    held_.follow(event);
    own_.follow({.key = event.key, .down = false, .mouse = event.mouse});
    pending_.push_back(event);
    last_move_.reset();
}

void Recorder::frame(double time) {
    if (time < last_time_) recording_ = false;
    if (time == last_time_) seen_ = pending_.size();
    if (recording_) seen_own_ = own_;
    if (!recording_ || !(time > last_time_)) return;
    const double stamp = short_time(last_time_, time);
    for (Event& event : pending_) {
        if (std::isnan(event.time)) event.time = stamp;
    }
    std::ranges::stable_sort(pending_, {}, &Event::time);
    events_.insert(events_.end(), pending_.begin(), pending_.end());
    pending_.clear();
    seen_ = 0;
    last_move_.reset();
    last_time_ = time;
}

void Recorder::forget_before(double time) {
    constexpr double kLongAgo = -std::numeric_limits<double>::infinity();
    const auto is_old = [time](const Event& event) { return event.time < time; };
    const auto kept = std::partition_point(events_.begin(), events_.end(), is_old);
    InputState state;
    for (auto event = events_.begin(); event != kept; ++event) state.apply(*event);
    std::vector<Event> shorter = state.as_events(kLongAgo);
    shorter.insert(shorter.end(), kept, events_.end());
    events_ = std::move(shorter);
}

// Of all that is held, and that a frame has seen to be.
std::vector<Event> Recorder::releases() const {
    std::vector<Event> events;
    for (int code = 0; code < kKeyCount; ++code)
        if (seen_own_.keys[static_cast<std::size_t>(code)])
            events.push_back({.time = kNoTime, .key = code, .down = false});
    if (seen_own_.mouse)
        events.push_back({.time = kNoTime, .down = false, .mouse = seen_own_.position});
    return events;
}

std::vector<Event> Recorder::stop() {
    const std::vector<Event> released = releases();
    pending_.resize(seen_);
    recording_ = true;  // also where time has gone back
    if (seen_ > 0) frame(last_time_ + kNextFrame);
    pending_ = released;
    if (!released.empty()) frame(last_time_ + kNextFrame);
    recording_ = false;
    own_ = seen_own_ = {};
    pending_.clear();
    seen_ = 0;
    return std::exchange(events_, {});
}

std::span<const Event> events_between(std::span<const Event> events, double from, double to) {
    const auto begin = std::ranges::upper_bound(events, from, {}, &Event::time);
    const auto end = std::ranges::upper_bound(begin, events.end(), to, {}, &Event::time);
    return {begin, end};
}

}  // namespace glint
