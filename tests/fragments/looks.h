// Tweaks of a scene as words, "waveHeight=2 windAngle=-30": by hand, or as a search has them.
#pragma once

#include "probe.h"
#include "worst_case.h"

#include <cmath>
#include <initializer_list>
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

// How many numbers such tweaks are.
inline std::size_t numbers_of(const Scene& scene, const std::vector<std::string>& names) {
    std::size_t count = 0;
    for (const std::string& name : names)
        count += static_cast<std::size_t>(component_count(tweak_of(scene, name).type));
    return count;
}

// A look with these tweaks where a case has them in their ranges, to four digits.
inline std::string look_at(const Scene& scene, const std::vector<std::string>& names,
                           Dials& dials) {
    std::string words;
    for (const std::string& name : names) {
        const Tweak& tweak = tweak_of(scene, name);
        const double low = tweak.min.value_or(0.0);
        const double high =
            tweak.max.value_or(std::max(1.0, static_cast<double>(tweak.names.size()) - 1.0));
        TweakValue value{};
        for (int c = 0; c < component_count(tweak.type); ++c) {
            const double at = tweak.log ? dials.between_logs(low, high) : dials.between(low, high);
            value[static_cast<std::size_t>(c)] = std::stod(fmt::format("{:.4g}", at));
        }
        std::string text = format_value(tweak, clamp_to_range(tweak, value));
        std::erase(text, ' ');
        words += fmt::format("{}{}={}", words.empty() ? "" : " ", name, text);
    }
    return words;
}

}  // namespace glint
