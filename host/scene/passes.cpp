#include "scene/passes.h"

#include "glsl/token.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>

namespace glint {

std::string pass_name(const Scene& scene, std::size_t pass) {
    return pass == kImagePass ? "image" : pass == kSoundPass ? "sound" : scene.passes[pass].name;
}

std::string entry_of(const Scene& scene, std::size_t pass) {
    return pass == kImagePass   ? scene.image_entry
           : pass == kSoundPass ? "mainSound"
                                : scene.passes[pass].entry;
}

bool draws_by_main(const Scene& scene, std::size_t pass) {
    return entry_of(scene, pass) == "main";
}

bool draws_by_main(const Scene& scene) {
    return draws_by_main(scene, kImagePass) ||
           std::ranges::find(scene.passes, "main", &Pass::entry) != scene.passes.end();
}

const Sampler& sampler_at(const Preset& preset, std::size_t index) {
    const auto& own = preset.scene.samplers;
    return index < own.size() ? own[index] : preset.channels.at(index - own.size());
}

std::size_t sampler_count(const Preset& preset) {
    return preset.scene.samplers.size() + preset.channels.size();
}

std::string sampler_facts(const Sampler& sampler) {
    return fmt::format("{} {} {} {} {} {} {} {} {} {}x{}x{} {}", sampler.name,
                       static_cast<int>(sampler.type), static_cast<int>(sampler.source),
                       static_cast<int>(sampler.filter), static_cast<int>(sampler.wrap),
                       sampler.vflip, sampler.pass, sampler.output, sampler.noise_channels,
                       sampler.noise_size.x, sampler.noise_size.y, sampler.noise_size.z,
                       sampler.plays);
}

std::optional<std::size_t> find_sampler(const Preset& preset, std::size_t pass,
                                        std::string_view name) {
    const auto is_seen = [&](const std::string& tab) {
        if (tab.empty() || tab == pass_name(preset.scene, pass)) return true;
        if (!fills_a_buffer(pass)) return false;
        const auto& outputs = preset.scene.passes[pass].outputs;
        return std::ranges::find(outputs, tab) != outputs.end();
    };
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        if (sampler.name == name && is_seen(sampler.tab)) return i;
    }
    return std::nullopt;
}

std::vector<std::size_t> samplers_named(const Preset& preset, std::size_t reader,
                                        const std::string& text) {
    std::deque<std::string> spellings;
    const ScannedText scanned = scan(text, spellings);
    std::map<std::string_view, int> words;
    std::vector<std::size_t> samplers;
    for (const Token& token : scanned.tokens) {
        if (!token.is_word() || ++words[token.text] != 2) continue;
        if (const auto sampler = find_sampler(preset, reader, token.text))
            samplers.push_back(*sampler);
    }
    return samplers;
}

std::vector<std::string> output_names(const Scene& scene, std::size_t pass) {
    return fills_a_buffer(pass) ? scene.passes[pass].outputs
                                : std::vector<std::string>{pass_name(scene, pass)};
}

}  // namespace glint
