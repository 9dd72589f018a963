// Tweaks of a scene as words, "waveHeight=2 windAngle=-30": by hand, or anywhere in their ranges.
#pragma once

#include "probe.h"

#include <cmath>
#include <initializer_list>
#include <random>
#include <sstream>

namespace glint {

inline const Tweak& tweak_of(const Scene& scene, std::string_view name) {
    for (const Tweak& tweak : scene.tweaks) {
        if (tweak.name == name) return tweak;
    }
    throw std::runtime_error(fmt::format("no tweak {}", name));
}

// The scene's defaults, and what the words say instead.
inline void set_look(Player& player, std::string_view words) {
    const auto& tweaks = player.preset.scene.tweaks;
    for (std::size_t i = 0; i < tweaks.size(); ++i) player.preset.values[i] = tweaks[i].initial;
    std::istringstream list{std::string(words)};
    for (std::string word; list >> word;) {
        const std::size_t equals = word.find('=');
        const Tweak& tweak = tweak_of(player.preset.scene, word.substr(0, equals));
        const auto value = parse_value(tweak, word.substr(equals + 1));
        if (!value) throw std::runtime_error(word + ": no such value");
        player.preset.values[static_cast<std::size_t>(&tweak - tweaks.data())] = *value;
    }
}

// A look with these tweaks anywhere in their ranges, every fourth at one of its ends.
inline std::string random_look(const Scene& scene, const std::vector<std::string>& names,
                               std::mt19937& random) {
    const auto share = [&] {
        return std::clamp(static_cast<double>(random()) / 4294967296.0 * 1.3 - 0.15, 0.0, 1.0);
    };
    std::string words;
    for (const std::string& name : names) {
        const Tweak& tweak = tweak_of(scene, name);
        const double low = tweak.min.value_or(0.0);
        const double high =
            tweak.max.value_or(std::max(1.0, static_cast<double>(tweak.names.size()) - 1.0));
        TweakValue value{};
        for (double& component : value) {
            const double at = share();
            component = tweak.log ? low * std::pow(high / low, at) : low + (high - low) * at;
        }
        std::string text = format_value(tweak, clamp_to_range(tweak, value));
        std::erase(text, ' ');
        words += fmt::format("{}{}={}", words.empty() ? "" : " ", name, text);
    }
    return words;
}

// How far along a range by chance: a time, a distance.
inline double random_between(double low, double high, std::mt19937& random) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

}  // namespace glint
