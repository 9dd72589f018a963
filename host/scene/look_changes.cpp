#include "scene/look_changes.h"

#include <algorithm>
#include <utility>

namespace glint {

std::vector<std::string> lay_changes_over(const Preset& before, const Preset& now,
                                          TweakValues& tweaks) {
    std::vector<std::string> overruled;
    std::vector<TweakValue> values = tweaks.values();
    for (std::size_t i = 0; i < now.scene.tweaks.size(); ++i) {
        const Tweak& tweak = now.scene.tweaks[i];
        const auto& old = before.scene.tweaks;
        const auto locks = [&](const Preset& preset) {
            return std::ranges::find(preset.locked, tweak.name) != preset.locked.end();
        };
        const auto same = std::find_if(old.begin(), old.end(), [&](const Tweak& t) {
            return t.name == tweak.name && t.type == tweak.type;
        });
        if (same == old.end()) {
            if (locks(now)) tweaks.lock(i, true);
            continue;
        }
        const TweakValue& was = before.values[static_cast<std::size_t>(same - old.begin())];
        const bool default_moved = was == same->initial && now.values[i] == tweak.initial;
        if (locks(before) != locks(now)) tweaks.lock(i, locks(now));
        if (was == now.values[i] || default_moved) continue;
        const TweakValue here = std::exchange(values[i], now.values[i]);
        if (here != values[i] && here != was) overruled.push_back(tweak.name);
        tweaks.follow_hidden(i, was, now.values[i]);
    }
    tweaks.set_all(values);
    return overruled;
}

std::vector<std::string> locks_without_tweak(const Preset& preset) {
    const auto& tweaks = preset.scene.tweaks;
    std::vector<std::string> names = preset.locked;
    std::erase_if(names, [&](const std::string& name) {
        return std::ranges::find(tweaks, name, &Tweak::name) != tweaks.end();
    });
    return names;
}

}  // namespace glint
