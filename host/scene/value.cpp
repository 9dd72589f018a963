// Tweak values: their types, their range, and how a person writes them.
#include "base/words.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace glint {

namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();
constexpr double kLargestInt = std::numeric_limits<int>::max();
constexpr double kSmallestInt = std::numeric_limits<int>::min();

std::size_t count_of(const Tweak& tweak) {
    return static_cast<std::size_t>(component_count(tweak.type));
}

std::optional<TweakValue> parse_colour(std::string_view text, std::size_t components) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    if (!text.starts_with('#') || components < 3) return std::nullopt;
    text.remove_prefix(1);
    if (text.size() != 6 && !(text.size() == 8 && components == 4)) return std::nullopt;
    TweakValue value{};
    if (components == 4) value[3] = 1.0;
    for (std::size_t i = 0; i * 2 < text.size(); ++i) {
        unsigned byte = 0;
        const char* begin = text.data() + i * 2;
        const auto [end, error] = std::from_chars(begin, begin + 2, byte, 16);
        if (error != std::errc() || end != begin + 2) return std::nullopt;
        value[i] = byte / 255.0;
    }
    return value;
}

// "0.1, 0.2" or "(0.1, 0.2)": as many numbers as the type has components.
std::optional<TweakValue> parse_tuple(std::string_view text, std::size_t components) {
    if (text.size() >= 2 && text.front() == '(' && text.back() == ')')
        text = text.substr(1, text.size() - 2);
    TweakValue value{};
    for (std::size_t i = 0; i < components; ++i) {
        const bool last = i + 1 == components;
        const std::size_t comma = last ? text.size() : text.find(',');
        if (comma == std::string_view::npos) return std::nullopt;
        const auto number = parse_number(trimmed(text.substr(0, comma)));
        if (!number || std::abs(*number) > kLargestFloat) return std::nullopt;
        value[i] = *number;
        if (!last) text.remove_prefix(comma + 1);
    }
    return value;
}

std::optional<TweakValue> parse_int(const Tweak& tweak, std::string_view text) {
    for (std::size_t i = 0; i < tweak.names.size(); ++i)
        if (tweak.names[i] == text) return TweakValue{static_cast<double>(i)};
    const auto number = parse_number(text);
    if (!number || *number != std::floor(*number)) return std::nullopt;
    if (*number < kSmallestInt || *number > kLargestInt) return std::nullopt;
    const auto names = static_cast<double>(tweak.names.size());
    if (!tweak.names.empty() && (*number < 0.0 || *number >= names)) return std::nullopt;
    return TweakValue{*number};
}

std::optional<TweakValue> parse_bool(std::string_view text) {
    if (const auto on = parse_switch(text)) return TweakValue{*on ? 1.0 : 0.0};
    if (text == "1") return TweakValue{1.0};
    if (text == "0") return TweakValue{0.0};
    return std::nullopt;
}

// "#rrggbb" where that is exact.
std::optional<std::string> format_colour(const TweakValue& value, std::size_t components) {
    std::string text = "#";
    for (std::size_t i = 0; i < components; ++i) {
        const double byte = std::round(value[i] * 255.0);
        if (!(byte >= 0.0 && byte <= 255.0) || byte / 255.0 != value[i]) return std::nullopt;
        text += fmt::format("{:02x}", static_cast<int>(byte));
    }
    return text;
}

double clamp_component(const Tweak& tweak, double value) {
    value = std::clamp(value, -kLargestFloat, kLargestFloat);
    if (tweak.type == TweakType::bool1) return std::round(std::clamp(value, 0.0, 1.0));
    if (tweak.type == TweakType::int1)
        value = std::round(std::clamp(value, kSmallestInt, kLargestInt));
    if (!tweak.names.empty())
        return std::clamp(value, 0.0, static_cast<double>(tweak.names.size() - 1));
    if (tweak.min && value < *tweak.min) value = *tweak.min;
    if (tweak.max && value > *tweak.max) value = *tweak.max;
    return value;
}

}  // namespace

int component_count(TweakType type) {
    switch (type) {
        case TweakType::float1:
        case TweakType::int1:
        case TweakType::bool1:
            return 1;
        case TweakType::vec2:
            return 2;
        case TweakType::vec3:
            return 3;
        case TweakType::vec4:
            return 4;
    }
    return 1;
}

std::string expected_value(const Tweak& tweak) {
    const std::string range =
        tweak.min && tweak.max
            ? fmt::format(" from {} to {}", format_number(*tweak.min), format_number(*tweak.max))
            : std::string();
    if (!tweak.names.empty()) {
        return fmt::format("{} or an index from 0 to {}", fmt::join(tweak.names, ", "),
                           tweak.names.size() - 1);
    }
    switch (tweak.type) {
        case TweakType::float1:
            return "a number" + range;
        case TweakType::int1:
            return "a whole number" + range;
        case TweakType::bool1:
            return "on or off";
        case TweakType::vec2:
            return "two numbers such as 0.1, 0.2" + (range.empty() ? "" : ", each" + range);
        case TweakType::vec3:
            return "three numbers such as 0.1, 0.2, 0.3 or a colour such as #0b3a53" +
                   (range.empty() ? "" : ", each" + range);
        case TweakType::vec4:
            return "four numbers such as 0.1, 0.2, 0.3, 1 or a colour such as #0b3a53ff" +
                   (range.empty() ? "" : ", each" + range);
    }
    return {};
}

TweakValue clamp_to_range(const Tweak& tweak, TweakValue value) {
    const std::size_t count = count_of(tweak);
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (i >= count)
            value[i] = 0.0;
        else
            value[i] = std::isnan(value[i]) ? tweak.initial[i] : clamp_component(tweak, value[i]);
    }
    return value;
}

std::optional<TweakValue> parse_value(const Tweak& tweak, std::string_view text) {
    text = trimmed(text);
    switch (tweak.type) {
        case TweakType::int1:
            return parse_int(tweak, text);
        case TweakType::bool1:
            return parse_bool(text);
        case TweakType::float1:
        case TweakType::vec2:
        case TweakType::vec3:
        case TweakType::vec4:
            if (const auto colour = parse_colour(text, count_of(tweak))) return colour;
            return parse_tuple(text, count_of(tweak));
    }
    return std::nullopt;
}

std::string format_value(const Tweak& tweak, const TweakValue& value) {
    if (tweak.type == TweakType::bool1) return value[0] != 0.0 ? "on" : "off";
    if (!tweak.names.empty() && value[0] >= 0.0 &&
        value[0] < static_cast<double>(tweak.names.size()))
        return tweak.names[static_cast<std::size_t>(value[0])];
    if (tweak.type == TweakType::int1)
        return fmt::format("{}",
                           static_cast<long long>(std::clamp(value[0], kSmallestInt, kLargestInt)));
    const std::size_t count = count_of(tweak);
    if (tweak.is_colour)
        if (const auto colour = format_colour(value, count)) return *colour;
    std::string text = format_number(value[0]);
    for (std::size_t i = 1; i < count; ++i) text += ", " + format_number(value[i]);
    return text;
}

std::vector<Turned> turned_values(const std::vector<Tweak>& tweaks, const Tweak& own,
                                  std::string_view list, std::string& wrong) {
    std::vector<Turned> turned;
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t comma = std::min(list.find(',', at), list.size());
        const std::string_view item = trimmed(list.substr(at, comma - at));
        at = comma + 1;
        const std::size_t equals = item.find('=');
        const std::string name =
            equals == item.npos ? own.name : std::string(trimmed(item.substr(0, equals)));
        const std::string_view text = equals == item.npos ? item : trimmed(item.substr(equals + 1));
        const auto tweak = std::ranges::find(tweaks, name, &Tweak::name);
        if (tweak == tweaks.end()) {
            std::vector<std::string> names;
            for (const Tweak& known : tweaks) names.push_back(known.name);
            wrong = fmt::format("{}: the scene has no tweak {}{}", list, in_quotes(name),
                                did_you_mean(name, names));
            return {};
        }
        const auto value = parse_value(*tweak, text);
        if (!value) {
            wrong = fmt::format("{}: {} takes {}{}", list, name, expected_value(*tweak),
                                did_you_mean(std::string(text), tweak->names));
            return {};
        }
        turned.push_back({static_cast<std::size_t>(tweak - tweaks.begin()), *value});
    }
    return turned;
}

}  // namespace glint
