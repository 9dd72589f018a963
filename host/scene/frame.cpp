// Time, mouse and keys by the site's rules.
#include "scene/frame.h"

#include "base/words.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

namespace glint {

namespace {

constexpr double kSecondsPerDay = 86400.0;

struct NamedKey {
    std::string_view name;
    int code;
};

constexpr NamedKey kNamedKeys[] = {
    {"backspace", 8}, {"tab", 9},    {"enter", 13},  {"shift", 16},    {"ctrl", 17},   {"alt", 18},
    {"escape", 27},   {"space", 32}, {"pageup", 33}, {"pagedown", 34}, {"end", 35},    {"home", 36},
    {"left", 37},     {"up", 38},    {"right", 39},  {"down", 40},     {"delete", 46},
};

std::optional<int> parse_decimal(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return number;
}

// The pixel that a fraction of the picture falls on. The small addition gives back pixel 29 of 100
// from 29/100, which is stored a little below it.
double pixel(double fraction, int pixels) {
    return std::floor(fraction * pixels + 1e-6);
}

}  // namespace

int key_code(std::string_view name) {
    const std::string lower = in_small_letters(name.substr(0, 16));
    if (lower.size() == 1 && lower[0] >= 'a' && lower[0] <= 'z') return lower[0] - 'a' + 65;
    if (lower.size() == 1 && lower[0] >= '0' && lower[0] <= '9') return lower[0] - '0' + 48;
    for (const NamedKey& key : kNamedKeys)
        if (key.name == lower) return key.code;
    if (lower.starts_with('f')) {
        const auto number = parse_decimal(std::string_view(lower).substr(1));
        return number && *number >= 1 && *number <= 12 ? 111 + *number : -1;
    }
    const auto code = parse_decimal(lower);
    return code && *code >= 0 && *code < kKeyCount ? *code : -1;
}

std::string key_name(int code) {
    if ((code >= 'A' && code <= 'Z') || (code >= '0' && code <= '9'))
        return {static_cast<char>(code >= 'A' ? code - 'A' + 'a' : code)};
    for (const NamedKey& key : kNamedKeys)
        if (key.code == code) return std::string(key.name);
    if (code >= 112 && code <= 123) return "f" + std::to_string(code - 111);
    return (code < 10 ? "0" : "") + std::to_string(code);  // a digit alone is the key of the digit
}

void InputState::mouse(glm::dvec2 fraction, bool down) {
    const bool is_number = std::isfinite(fraction.x) && std::isfinite(fraction.y);
    if (down && is_number) {
        position_ = fraction;
        if (!down_) {
            click_ = fraction;
            clicked_ever_ = pressed_now_ = true;
        }
    }
    down_ = down && (is_number || down_);
}

void InputState::key(int code, bool down) {
    if (code < 0 || code >= kKeyCount) return;
    const auto index = static_cast<std::size_t>(code);
    if (down && keys_.held[index] == 0) {
        keys_.pressed[index] = 255;
        keys_.toggled[index] ^= 255;
    }
    keys_.held[index] = down ? 255 : 0;
}

Input InputState::next_frame(glm::ivec2 size) {
    Input input = keys_;
    if (clicked_ever_) {
        const glm::dvec2 click(pixel(click_.x, size.x), pixel(click_.y, size.y));
        input.mouse = glm::vec4(pixel(position_.x, size.x), pixel(position_.y, size.y),
                                down_ ? click.x : -click.x, pressed_now_ ? click.y : -click.y);
    }
    pressed_now_ = false;
    keys_.pressed.fill(0);
    return input;
}

void InputState::apply(const Event& event) {
    if (event.key >= 0) {
        key(event.key, event.down);
    } else {
        mouse(event.mouse, event.down);
    }
}

std::vector<Event> InputState::as_events(double time) const {
    return as_events(time, {});
}

// A press turns what a key toggles; so two of them lead back.
std::vector<Event> InputState::as_events(double time, const InputState& from) const {
    std::vector<Event> events;
    for (int code = 0; code < kKeyCount; ++code) {
        const auto index = static_cast<std::size_t>(code);
        const bool held = keys_.held[index] != 0, was_held = from.keys_.held[index] != 0;
        const bool turns = keys_.toggled[index] != from.keys_.toggled[index];
        const auto press = [&](bool down) {
            events.push_back({.time = time, .key = code, .down = down});
        };
        if (was_held && (turns || !held)) press(false);
        if (turns || (held && !was_held)) press(true);
        if (turns && !held) press(false);
        if (!turns && held && !was_held) press(false), press(true);
    }
    const auto mouse = [](const InputState& state) {
        return std::tuple(state.clicked_ever_, state.down_, state.click_.x, state.click_.y,
                          state.position_.x, state.position_.y);
    };
    if (!clicked_ever_ || mouse(*this) == mouse(from)) return events;
    if (from.down_) events.push_back({.time = time, .down = false, .mouse = from.position_});
    events.push_back({.time = time, .down = true, .mouse = click_});
    if (position_ != click_) events.push_back({.time = time, .down = true, .mouse = position_});
    if (!down_) events.push_back({.time = time, .down = false, .mouse = position_});
    return events;
}

InputState input_after(std::span<const Event> events, double from, double to) {
    InputState state;
    auto event = events.begin();
    for (; event != events.end() && event->time <= from && event->time <= to; ++event)
        state.apply(*event);
    state.next_frame({1, 1});
    for (; event != events.end() && event->time <= to; ++event) state.apply(*event);
    return state;
}

Input replay(std::span<const Event> events, double from, double to, glm::ivec2 size) {
    return input_after(events, from, to).next_frame(size);
}

glm::vec4 shadertoy_date(const Date& start, double elapsed) {
    using namespace std::chrono;
    // A few thousand years either way: beyond that the calendar's own types end.
    constexpr double kFurthestDays = 3.0e6;
    const double sum = start.seconds + elapsed;
    const double seconds = std::isfinite(sum) ? sum : 0.0;
    const double days_passed =
        std::clamp(std::floor(seconds / kSecondsPerDay), -kFurthestDays, kFurthestDays);
    const auto start_month = static_cast<unsigned>(std::clamp(start.month, 1, 12));
    const auto start_day = static_cast<unsigned>(std::clamp(start.day, 1, 31));
    const sys_days midnight =
        sys_days(year(std::clamp(start.year, 0, 9999)) / month(start_month) / day(start_day)) +
        days(static_cast<int>(days_passed));
    const year_month_day date(midnight);
    // Rounding to float must not reach the next midnight while the date is still yesterday's.
    const float latest = std::nextafter(static_cast<float>(kSecondsPerDay), 0.0f);
    const double second = std::clamp(seconds - days_passed * kSecondsPerDay, 0.0, kSecondsPerDay);
    return {static_cast<float>(static_cast<int>(date.year())),
            static_cast<float>(static_cast<unsigned>(date.month()) - 1),
            static_cast<float>(static_cast<unsigned>(date.day())),
            std::min(static_cast<float>(second), latest)};
}

std::uint32_t tick(double time) {
    if (!std::isfinite(time)) return 0;
    // 65536 s are 2^32 ticks: the remainder and the scaling are both exact.
    const double ticks = std::floor(std::fmod(time, 65536.0) * 65536.0);
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(ticks));
}

}  // namespace glint
