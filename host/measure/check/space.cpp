#include "measure/check/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace glint {
namespace {

// A scene without a state is seen at any time up to an hour, mostly within its first minute.
constexpr double kMinute = 60.0, kLongest = 3600.0;  // s
constexpr double kInMinute = 0.75;                   // of the range; behind it, by logarithms
constexpr double kLongestSide = 1920.0;
constexpr std::size_t kMostEquals = 64;
constexpr std::size_t kMostOfMenus = 8;  // sets for the middle entries of menus
// The usual number of pixels. The shorter side gives way, so that no point is dearer than others.
constexpr double kMostPixels = 3.0;

// Of a year the ends, and the day that few have.
constexpr std::array kDates = {Date{2026, 1, 1, 0.0}, Date{2028, 2, 29, 43200.0},
                               Date{2026, 12, 31, 86399.0}};

// By the share of the date: the preset's, which is the first part of it, or one of these.
std::optional<Date> date_at(double share) {
    const auto part = static_cast<std::size_t>(share * (kDates.size() + 1));
    if (part == 0) return std::nullopt;
    return kDates[std::min(part, kDates.size()) - 1];
}

// What a hand has done with the mouse: by it `iMouse.zw` has all its signs, and other places than
// `iMouse.xy`.
enum class Hand { clicks, holds, drags, lets_go };
constexpr std::size_t kHands = 4, kButton = 2;  // the third number of the mouse, as shares
constexpr const char* kHandWords[kHands] = {"", " held", " dragged", " released"};
constexpr double kHandFrames = 3.0 / 60;  // s, which all of these need

Hand hand_at(double share) {
    return static_cast<Hand>(std::min(static_cast<std::size_t>(share * kHands), kHands - 1));
}

// Up to the end of the frame at `time`.
std::vector<Event> mouse_events(Hand hand, glm::dvec2 place, double time) {
    const glm::dvec2 from = hand == Hand::drags ? 1.0 - place : place;
    const double begin =
        hand == Hand::clicks ? std::max(0.0, time - 0.5 / 60) : std::max(0.0, time - kHandFrames);
    std::vector<Event> events = {{.time = begin, .down = true, .mouse = from}};
    if (hand == Hand::drags || hand == Hand::lets_go)
        events.push_back({.time = begin + 1.0 / 60, .down = hand == Hand::drags, .mouse = place});
    return events;
}

bool is_logarithmic(const Tweak& tweak, const Range& range) {
    return tweak.log && range.min > 0.0;
}

double time_at(double share) {
    if (share <= kInMinute) return kMinute * share / kInMinute;
    return kMinute * std::pow(kLongest / kMinute, (share - kInMinute) / (1.0 - kInMinute));
}

double share_of_time(double time) {
    if (time <= kMinute) return std::max(time, 0.0) / kMinute * kInMinute;
    const double behind = std::log(time / kMinute) / std::log(kLongest / kMinute);
    return std::min(kInMinute + (1.0 - kInMinute) * behind, 1.0);
}

double share_of(const Tweak& tweak, const Range& range, double value) {
    if (range.max <= range.min) return 0.0;
    const double share =
        is_logarithmic(tweak, range)
            ? std::log(std::max(value, range.min) / range.min) / std::log(range.max / range.min)
            : (value - range.min) / (range.max - range.min);
    return std::clamp(share, 0.0, 1.0);
}

}  // namespace

std::optional<Range> range_of(const Tweak& tweak) {
    if (tweak.safe) return Range{(*tweak.safe)[0], (*tweak.safe)[1]};
    if (!tweak.names.empty()) return Range{0.0, static_cast<double>(tweak.names.size() - 1)};
    if (tweak.type == TweakType::bool1 || tweak.is_colour) return Range{0.0, 1.0};
    if (tweak.min && tweak.max) return Range{*tweak.min, *tweak.max};
    return std::nullopt;
}

double at_share(const Tweak& tweak, const Range& range, double share) {
    if (is_logarithmic(tweak, range)) return range.min * std::pow(range.max / range.min, share);
    const double value = std::lerp(range.min, range.max, share);
    if (std::abs(value) < 1e-12 * (range.max - range.min)) return 0.0;
    return std::stod(fmt::format("{:.15g}", value));  // 1.843, not 1.8429999999999997
}

Space::Space(const CheckSubject& subject, const std::vector<int>& keys)
    : tweaks_(subject.opened().scene.tweaks),
      usual_size_(subject.opened().size),
      is_stateful_(subject.stateful()) {
    const std::vector<Tweak>& tweaks = tweaks_;
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const auto range = range_of(tweaks[i]);
        const auto count = static_cast<std::size_t>(component_count(tweaks[i].type));
        for (std::size_t c = 0; range && c < count; ++c) {
            axes_.push_back({Axis::Of::tweak, i, c});
            zero_.emplace_back();
            if (range->min < 0.0 && range->max > 0.0)
                zero_.back() = share_of(tweaks[i], *range, 0.0);
            usual_.push_back(share_of(tweaks[i], *range, subject.opened().values[i][c]));
        }
    }
    if (!subject.stateful() && subject.moves()) {
        axes_.push_back({Axis::Of::time, 0, 0});
        usual_.push_back(share_of_time(subject.opened().time));
    }
    if (subject.reads(Builtin::date)) {
        axes_.push_back({Axis::Of::date, 0, 0});
        usual_.push_back(0.0);
    }
    if (subject.renderer().reads_mouse()) {
        for (const std::size_t c : {std::size_t{0}, std::size_t{1}, kButton}) {
            axes_.push_back({Axis::Of::mouse, 0, c});
            usual_.push_back(c == kButton ? 0.0 : 0.5);
        }
    }
    for (const int key : keys) {
        axes_.push_back({Axis::Of::key, static_cast<std::size_t>(key), 0});
        usual_.push_back(0.0);
    }
    for (const int c : {0, 1}) {
        axes_.push_back({Axis::Of::size, 0, static_cast<std::size_t>(c)});
        usual_.push_back(std::min(usual_size_[c] / kLongestSide, 1.0));
    }
}

std::vector<Point> Space::zeros() const {
    std::vector<Point> points;
    Point all = usual_;
    for (std::size_t i = 0; i < zero_.size(); ++i) {
        if (!zero_[i]) continue;
        const bool is_next = i == 0 || axes_[i].index != axes_[i - 1].index;
        if (is_next) points.push_back(usual_);
        points.back()[i] = all[i] = *zero_[i];
    }
    if (points.size() > 1) points.insert(points.begin(), all);
    return points;
}

std::vector<Point> Space::equals() const {
    std::vector<Point> points;
    const auto is_float = [&](const Axis& axis) {
        return axis.of == Axis::Of::tweak && tweaks_[axis.index].type == TweakType::float1;
    };
    for (std::size_t i = 0; i < axes_.size(); ++i)
        for (std::size_t k = 0; k < axes_.size() && points.size() < kMostEquals; ++k) {
            if (i == k || !is_float(axes_[i]) || !is_float(axes_[k])) continue;
            const Tweak &tweak = tweaks_[axes_[i].index], &other = tweaks_[axes_[k].index];
            const auto range = range_of(tweak), its = range_of(other);
            if (!range || !its) continue;
            const double value = at_share(other, *its, usual_[k]);
            if (value < range->min || value > range->max) continue;
            points.push_back(usual_);
            points.back()[i] = share_of(tweak, *range, value);
        }
    return points;
}

Point Space::at_odd_size(Point point) const {
    constexpr double kOdd[] = {203.0, 207.0};
    for (const std::size_t c : {0u, 1u}) point[point.size() - 2 + c] = kOdd[c] / kLongestSide;
    return point;
}

std::vector<Point> Space::inputs() const {
    constexpr double kTimes[] = {100.0, 3000.0};  // s
    constexpr double kPlaces[][2] = {{0.12, 0.18}, {0.5, 0.51}, {0.87, 0.81}};
    // Who has little time comes to the first ones.
    std::vector<Point> keys, times, hands, places;
    Point all_keys = usual_;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const auto with = [&](std::vector<Point>& list, std::initializer_list<double> values) {
            list.push_back(usual_);
            std::ranges::copy(values, list.back().begin() + static_cast<std::ptrdiff_t>(i));
        };
        const Axis& axis = axes_[i];
        if (axis.of == Axis::Of::time)
            for (const double time : kTimes) with(times, {share_of_time(time)});
        if (axis.of == Axis::Of::date)
            for (std::size_t k = 1; k <= kDates.size(); ++k)
                with(times, {(static_cast<double>(k) + 0.5) / (kDates.size() + 1)});
        for (std::size_t hand = 0; axis.of == Axis::Of::mouse && hand < kHands; ++hand) {
            // Of a state what was clicked at its start is held.
            const bool is_new = !is_stateful_ || static_cast<Hand>(hand) != Hand::holds;
            for (const auto& place : kPlaces)
                if (axis.component == 0 && is_new)
                    with(&place == kPlaces ? hands : places,
                         {place[0], place[1], (static_cast<double>(hand) + 0.5) / kHands});
        }
        if (axis.of != Axis::Of::key) continue;
        with(keys, {1.0});
        all_keys[i] = 1.0;
    }
    if (keys.size() > 1) keys.push_back(all_keys);
    for (const auto& more : {times, hands, places})
        keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

Point Space::rounded(Point point, std::size_t axis) const {
    constexpr double kAsGood = 1e-5;  // of the range
    if (axes_[axis].of != Axis::Of::tweak) return point;
    const Tweak& tweak = tweaks_[axes_[axis].index];
    const Range range = *range_of(tweak);
    const double value = at_share(tweak, range, point[axis]);
    for (int digits = 1; digits <= 7; ++digits) {
        const double round = std::stod(fmt::format("{:.{}g}", value, digits));
        if (std::abs(round - value) > kAsGood * (range.max - range.min)) continue;
        point[axis] = share_of(tweak, range, round);
        break;
    }
    return point;
}

glm::ivec2 Space::size_at(const Point& point) const {
    glm::ivec2 size = usual_size_;
    const std::size_t first = point.size() - 2;
    for (const int c : {0, 1}) {
        const std::size_t i = first + static_cast<std::size_t>(c);
        if (point[i] != usual_[i])
            size[c] = std::max(1, static_cast<int>(std::lround(point[i] * kLongestSide)));
    }
    if (size == usual_size_) return size;
    const double most = kMostPixels * usual_size_.x * usual_size_.y;
    int& shorter = size.x < size.y ? size.x : size.y;
    const int longer = std::max(size.x, size.y);
    shorter = std::clamp(static_cast<int>(most / longer), 1, shorter);
    return size;
}

double Space::apply(const Point& point, CheckSubject& subject) const {
    double time = subject.opened().time;
    glm::dvec3 mouse(0.5, 0.5, 0.0);
    bool is_moved = false;
    std::vector<int> held;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (point[i] == usual_[i]) continue;  // what the preset has, to the last digit
        const Axis& axis = axes_[i];
        if (axis.of == Axis::Of::time) {
            time = std::round(time_at(point[i]) * 60.0) / 60.0;
        } else if (axis.of == Axis::Of::date) {
            subject.preset.date = date_at(point[i]).value_or(subject.opened().date);
        } else if (axis.of == Axis::Of::mouse) {
            mouse[static_cast<int>(axis.component)] = point[i];
            is_moved = true;
        } else if (axis.of == Axis::Of::key) {
            if (point[i] >= 0.5) held.push_back(static_cast<int>(axis.index));
        } else if (axis.of == Axis::Of::tweak) {
            const Tweak& tweak = tweaks_[axis.index];
            TweakValue& value = subject.preset.values[axis.index];
            value[axis.component] = at_share(tweak, *range_of(tweak), point[i]);
            value = clamp_to_range(tweak, value);
        }
    }
    if (is_moved || !held.empty()) subject.preset.events.clear();
    const Hand hand = hand_at(mouse.z);
    if (is_moved && hand != Hand::clicks && !subject.stateful()) time = std::max(time, kHandFrames);
    if (is_moved)
        subject.preset.events =
            mouse_events(hand, glm::dvec2(mouse), subject.stateful() ? 0.0 : time);
    // Of a scene without a state in its one frame, so that it is seen as pressed, too.
    const double pressed = subject.stateful() ? 1.0 / 60 : std::max(0.0, time - 0.5 / 60);
    for (const int key : held)
        subject.preset.events.push_back({.time = pressed, .key = key, .down = true});
    if (const glm::ivec2 size = size_at(point); size != subject.preset.size) subject.resize(size);
    return time;
}

std::string Space::words(const Point& point, const CheckSubject& subject) const {
    std::string words;
    const auto add = [&](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
    std::size_t told = SIZE_MAX;
    glm::dvec3 mouse(0.5, 0.5, 0.0);
    bool is_moved = false;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (point[i] == usual_[i]) continue;
        const Axis& axis = axes_[i];
        if (axis.of == Axis::Of::time) add(fmt::format("time {:.4g}", time_at(point[i])));
        if (axis.of == Axis::Of::date && date_at(point[i]))
            add("date " + date_words(*date_at(point[i])));
        if (axis.of == Axis::Of::mouse) {
            mouse[static_cast<int>(axis.component)] = point[i];
            is_moved = true;
        }
        if (axis.of == Axis::Of::key && point[i] >= 0.5)
            add("key " + key_name(static_cast<int>(axis.index)));
        if (axis.of != Axis::Of::tweak || told == axis.index) continue;
        told = axis.index;
        const Tweak& tweak = tweaks_[axis.index];
        add(tweak.name + "=" + format_value(tweak, subject.preset.values[axis.index]));
    }
    if (const glm::ivec2 size = size_at(point); size != usual_size_)
        add(fmt::format("size {}x{}", size.x, size.y));
    if (is_moved)
        add(fmt::format("mouse {:.3g},{:.3g}{}", mouse.x, mouse.y,
                        kHandWords[static_cast<std::size_t>(hand_at(mouse.z))]));
    return words.empty() ? "the preset as it is" : words;
}

std::string date_words(const Date& date) {
    const auto seconds = static_cast<int>(date.seconds);
    return fmt::format("{}-{:02}-{:02} {:02}:{:02}:{:02}", date.year, date.month, date.day,
                       seconds / 3600, seconds / 60 % 60, seconds % 60);
}

std::vector<std::vector<TweakValue>> values_at_ends(const CheckSubject& subject, std::size_t most) {
    const auto& tweaks = subject.scene().tweaks;
    std::vector<std::vector<TweakValue>> sets = {subject.opened().values};
    const auto add = [&](std::vector<TweakValue> values) {
        if (std::ranges::find(sets, values) == sets.end()) sets.push_back(std::move(values));
    };
    Search search(Point(tweaks.size(), 0.5));
    search.next();
    const std::size_t ends = tweaks.empty() ? 0 : 2 * std::bit_ceil(tweaks.size() + 1);
    for (std::size_t k = 0; k < ends && sets.size() < most; ++k) {
        const Point point = search.next();
        std::vector<TweakValue> values = sets.front();
        for (std::size_t i = 0; i < tweaks.size(); ++i) {
            const auto range = range_of(tweaks[i]);
            if (!range) continue;
            values[i].fill(point[i] < 0.5 ? range->min : range->max);
            values[i] = clamp_to_range(tweaks[i], values[i]);
        }
        add(std::move(values));
    }
    // What stands within a menu is no less than what stands at its ends.
    const std::size_t most_of_menus = sets.size() + kMostOfMenus;
    for (std::size_t i = 0; i < tweaks.size() && most > 1; ++i) {
        for (std::size_t n = 1; n + 1 < tweaks[i].names.size(); ++n) {
            if (sets.size() >= most_of_menus) return sets;
            std::vector<TweakValue> values = sets.front();
            values[i][0] = static_cast<double>(n);
            add(std::move(values));
        }
    }
    return sets;
}

}  // namespace glint
