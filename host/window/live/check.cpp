#include "window/live/check.h"

#include "offline/common.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <system_error>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Two files of one name in two folders keep apart what they left.
std::string folder_name(const fs::path& file) {
    return fmt::format("{}-{:08x}", file.stem().string(),
                       std::hash<std::string>()(file.string()) & 0xffffffff);
}

// "name=value" for each tweak that the file does not give this value.
std::vector<std::string> unsaved_tweaks(const Preset& preset) {
    const ReadPreset saved = read_preset(preset.file);
    std::vector<std::string> list;
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = preset.scene.tweaks[i];
        const std::string value = format_value(tweak, preset.values[i]);
        bool is_saved = false;
        for (std::size_t k = 0; saved.preset && k < saved.preset->values.size(); ++k) {
            const Tweak& other = saved.preset->scene.tweaks[k];
            is_saved |=
                other.name == tweak.name && format_value(other, saved.preset->values[k]) == value;
        }
        if (!is_saved) list.push_back(tweak.name + "=" + value);
    }
    return list;
}

}  // namespace

void LiveCheck::start(const Preset& preset) {
    clear();
    const fs::path file = fs::absolute(preset.file);
    const fs::path folder = folder_ / folder_name(file);
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    std::vector<std::string> words = {"check", file.string(), "--lines", "--output",
                                      folder.string()};
    for (const std::string& tweak : unsaved_tweaks(preset)) {
        words.insert(words.end(), {"--tweak", tweak});
    }
    if (!options_.device.empty()) words.insert(words.end(), {"--device", options_.device});
    work_.start(std::move(words));
}

void LiveCheck::clear() {
    work_.clear();
    cases_.clear();
}

bool LiveCheck::update() {
    return work_.update([this](const nlohmann::ordered_json& line) { hear(line); });
}

// A line holds one case.
void LiveCheck::hear(const nlohmann::ordered_json& json) {
    CaseResult found = case_from_json(json.at("case"));
    cases_.insert(std::ranges::upper_bound(cases_, found, is_worse), std::move(found));
}

fs::path LiveCheck::picture(const std::string& name) const {
    const auto found = std::ranges::find(cases_, name, &CaseResult::name);
    return found == cases_.end() ? fs::path() : fs::path(found->picture);
}

}  // namespace glint
