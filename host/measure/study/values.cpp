#include "measure/study/values.h"

#include "base/words.h"
#include "offline/common.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr int kMostValues = 9, kLinearValues = 6;
constexpr double kWideRange = 16.0;       // of whole numbers: beyond, values double
constexpr std::size_t kMostListed = 256;  // that dots stand for

// Where the slider can stand.
double on_step(const Tweak& tweak, double value) {
    if (tweak.step <= 0.0 || !tweak.min) return value;
    return to_twelve_digits(*tweak.min +
                            std::round((value - *tweak.min) / tweak.step) * tweak.step);
}

// From the least to the most, doubled or evenly.
std::vector<TweakValue> spread_values(const Tweak& tweak, double least, double most) {
    std::vector<TweakValue> list;
    const auto add = [&](double v) {
        const TweakValue value = clamp_to_range(tweak, {on_step(tweak, to_twelve_digits(v))});
        if (list.empty() || list.back() != value) list.push_back(value);
    };
    const bool whole = tweak.type == TweakType::int1;
    const bool doubled = least > 0.0 && (tweak.log || (whole && most / least > kWideRange));
    if (doubled) {
        double ratio = 2.0;
        while (std::log(most / least) / std::log(ratio) > kMostValues - 1) ratio *= 2.0;
        for (double v = least; v < most * 0.999; v *= ratio) add(v);
        add(most);
    } else {
        const int count =
            whole ? std::min(kMostValues, static_cast<int>(most - least) + 1) : kLinearValues;
        for (int i = 0; i < count; ++i) add(std::lerp(least, most, i / std::max(count - 1.0, 1.0)));
    }
    return list;
}

// What the dots behind these words stand for, up to `end`, without it.
std::vector<std::string> between(const std::vector<std::string>& before, const std::string& end) {
    const auto number = [](const std::string& word) { return parse_number(word).value_or(0.0); };
    const double last = before.empty() ? 0.0 : number(before.back());
    const double first = before.size() < 2 ? 0.0 : number(before[before.size() - 2]);
    const double most = number(end), ratio = first > 0.0 ? last / first : 2.0;
    std::vector<std::string> list;
    if (last <= 0.0 || most <= 0.0 || ratio <= 0.0 || ratio == 1.0 ||
        (ratio > 1.0) != (most > last))
        throw UsageError(
            "Dots in a list stand between positive numbers, and double, or go on by the ratio of "
            "the two before them: 4,...,64 or 64,32,...,4.");
    for (double v = last * ratio; ratio > 1.0 ? v < most * 0.999 : v > most * 1.001; v *= ratio) {
        list.push_back(format_number(v));
        if (list.size() > kMostListed)
            throw UsageError(
                fmt::format("Dots that stand for more than {} values; name another "
                            "step.",
                            kMostListed));
    }
    return list;
}

}  // namespace

double to_twelve_digits(double value) {
    return parse_number(fmt::format("{:.12g}", value)).value_or(value);
}

bool is_number(const Tweak& tweak) {
    return tweak.names.empty() &&
           (tweak.type == TweakType::float1 || tweak.type == TweakType::int1);
}

std::vector<TweakValue> values_of(const Tweak& tweak) {
    if (!tweak.names.empty() || tweak.type == TweakType::bool1) {
        std::vector<TweakValue> list;
        const std::size_t count = tweak.names.empty() ? 2 : tweak.names.size();
        for (std::size_t i = 0; i < count; ++i) list.push_back({static_cast<double>(i)});
        return list;
    }
    if (!is_number(tweak) || !tweak.min || !tweak.max) return {};
    return spread_values(tweak, *tweak.min, *tweak.max);
}

std::vector<TweakValue> values_to_choose(const Tweak& tweak, std::vector<TweakValue> list,
                                         double own) {
    if (tweak.safe)
        std::erase_if(list, [&, safe = *tweak.safe](const TweakValue& value) {
            return value[0] != own && (value[0] < safe[0] || value[0] > safe[1]);
        });
    if (!is_number(tweak)) return list;
    double below = -HUGE_VAL, above = HUGE_VAL;
    for (const TweakValue& value : list) {
        if (value[0] < own) below = std::max(below, value[0]);
        if (value[0] > own) above = std::min(above, value[0]);
    }
    for (const double next : {below, above}) {
        if (!std::isfinite(next)) continue;
        const double half = on_step(tweak, 0.5 * (own + next));
        list.push_back({tweak.type == TweakType::int1 ? std::floor(half) : half});
    }
    std::ranges::sort(list, {}, [](const TweakValue& value) { return value[0]; });
    const auto again = std::ranges::unique(list);
    list.erase(again.begin(), again.end());
    return list;
}

std::vector<std::string> parse_list(const std::string& text) {
    std::vector<std::string> list;
    bool has_dots = false;  // before this word
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        const std::string word(trimmed(std::string_view(text).substr(at, comma - at)));
        at = comma + 1;
        const bool is_dots = word == "..." || word == "\u2026";
        if (is_dots && (has_dots || at > text.size())) between({}, "");  // lead nowhere
        if (has_dots)
            for (std::string& value : between(list, word)) list.push_back(std::move(value));
        has_dots = is_dots;
        if (!is_dots) list.push_back(word);
    }
    return list;
}

}  // namespace glint
