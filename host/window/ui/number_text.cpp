#include "window/ui/number_text.h"

#include "base/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace glint {
namespace {

bool is_logarithmic(const Tweak& tweak) {
    return tweak.log && *tweak.min > 0.0;
}

bool is_whole(const Tweak& tweak) {
    return tweak.type == TweakType::int1 || tweak.type == TweakType::bool1;
}

constexpr double kMostDecimals = 18.0;

// Decimals so that steps of this size can be told apart.
int decimals_for(double size) {
    if (!(size > 0.0) || !std::isfinite(size)) return 3;
    return static_cast<int>(std::clamp(std::ceil(-std::log10(size) - 1e-6), 0.0, kMostDecimals));
}

// Decimals that write this number out: 2 for 0.25.
int decimals_of(double number) {
    for (int digits = 0; digits < static_cast<int>(kMostDecimals); ++digits) {
        const double scaled = number * std::pow(10.0, digits);
        if (std::abs(scaled - std::round(scaled)) <= 1e-6 * std::abs(scaled)) return digits;
    }
    return static_cast<int>(kMostDecimals);
}

int decimals(const Tweak& tweak, double value) {
    if (is_whole(tweak)) return 0;
    if (tweak.step > 0.0)
        return std::max(decimals_of(tweak.step), tweak.min ? decimals_of(*tweak.min) : 0);
    if (!has_range(tweak) || is_logarithmic(tweak)) {
        const double least = has_range(tweak) ? std::min(*tweak.min, 1e-6) : 1e-6;
        return decimals_for(std::max(std::abs(value), least) / 1000.0);
    }
    return std::max(decimals_for((*tweak.max - *tweak.min) / 1000.0), 1);
}

double rounded_to(double value, int digits) {
    const double unit = std::pow(10.0, digits);
    const double rounded = std::round(value * unit) / unit;
    return std::isfinite(rounded) ? rounded : value;
}

}  // namespace

std::string power_text(double value) {
    static constexpr std::array<const char*, 10> kRaised = {"\u2070", "\u00b9", "\u00b2", "\u00b3",
                                                            "\u2074", "\u2075", "\u2076", "\u2077",
                                                            "\u2078", "\u2079"};
    const double size = std::abs(value);
    if (value == 0.0 || !std::isfinite(value)) return short_number(value);
    if (size > 0.0999 && size < 99999.0) return fmt::format("{:.3g}", value);
    const std::string written = fmt::format("{:.2e}", value);  // "3.64e-04"
    const std::size_t e = written.find('e');
    std::string digits = written.substr(0, e);
    digits.erase(digits.find_last_not_of("0") + 1);
    if (digits.ends_with('.')) digits.pop_back();
    std::string text = digits == "1" ? "10" : digits + "\u00b710";
    if (written[e + 1] == '-') text += "\u207b";
    const std::size_t power = std::min(written.find_first_not_of('0', e + 2), written.size() - 1);
    for (const char c : written.substr(power)) text += kRaised[static_cast<std::size_t>(c - '0')];
    return text;
}

std::string pixel_text(glm::ivec2 pixel, glm::ivec2 size, std::optional<glm::ivec2> at_full_size) {
    return fmt::format("pixel {}, {} of {} \u00d7 {}{}", pixel.x, pixel.y, size.x, size.y,
                       at_full_size
                           ? fmt::format(" ({}, {} at full size)", at_full_size->x, at_full_size->y)
                           : "");
}

bool has_range(const Tweak& tweak) {
    return tweak.min && tweak.max && std::isfinite(*tweak.min) && std::isfinite(*tweak.max) &&
           *tweak.min < *tweak.max;
}

std::string short_number(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    const double size = std::abs(value);
    if (size >= 1e4 && size < 1e6) return fmt::format("{:.0f}", value);
    if (size == 0.0 || (size >= 1e-3 && size < 1e4)) return fmt::format("{:.4g}", value);
    // 1.23e-5, not 1.23e-05: columns are narrow.
    std::string text = fmt::format("{:.2e}", value);
    const std::size_t sign = text.find('e') + 1;
    const std::size_t zeros = text[sign + 1] == '0' ? 1 : 0;
    text.erase(sign + 1, zeros);
    if (text[sign] == '+') text.erase(sign, 1);
    return text;
}

std::string number_text(const Tweak& tweak, double value) {
    if (!std::isfinite(value)) return short_number(value);
    if (std::abs(value) >= 1e7 || (value != 0.0 && std::abs(value) < 1e-5))
        return short_number(value);
    return fmt::format("{:.{}f}", value, decimals(tweak, value));
}

std::optional<double> parse_clock(std::string_view text) {
    double seconds = 0.0;
    for (int parts = 0; parts < 3; ++parts) {
        const std::size_t colon = text.find(':');
        const auto number = parse_number(text.substr(0, colon));
        const bool is_first = parts == 0;
        if (!number || *number < 0.0 || (!is_first && *number >= 60.0)) return {};
        seconds = 60.0 * seconds + *number;
        if (colon == text.npos) return seconds;
        if (*number != std::floor(*number)) return {};
        text.remove_prefix(colon + 1);
    }
    return {};
}

double fraction_of(const Tweak& tweak, double value) {
    if (!has_range(tweak) || !std::isfinite(value)) return 0.0;
    const double min = *tweak.min, max = *tweak.max;
    const double inside = std::clamp(value, min, max);
    if (is_logarithmic(tweak)) return std::log(inside / min) / std::log(max / min);
    return (0.5 * inside - 0.5 * min) / (0.5 * max - 0.5 * min);  // the span may be past a double
}

double value_at(const Tweak& tweak, double fraction) {
    const double min = *tweak.min, max = *tweak.max;
    if (fraction <= 0.0) return min;
    if (fraction >= 1.0) return max;
    double value = min * (1.0 - fraction) + max * fraction;
    if (is_logarithmic(tweak)) value = min * std::pow(max / min, fraction);
    if (tweak.step > 0.0) value = min + std::round((value - min) / tweak.step) * tweak.step;
    return std::clamp(rounded_to(value, decimals(tweak, value)), min, max);
}

}  // namespace glint
