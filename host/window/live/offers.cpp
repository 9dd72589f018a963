#include "window/live/offers.h"

#include "media/image.h"
#include "scene/annotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPictures = 6;

Sampler channel_of(const Preset& preset, std::size_t channel) {
    Sampler sampler;
    sampler.name = fmt::format("iChannel{}", channel);
    sampler.type = preset.scene.channel_types[channel].value_or(preset.channels[channel].type);
    return sampler;
}

EmptyChannel::Offer noise(Sampler sampler) {
    parse_noise(sampler.type == SamplerType::sampler2D ? "rgba 256" : "rgba 32", sampler);
    set_defaults(sampler, Source::noise);
    return {"noise", sampler};
}

std::vector<fs::path> pictures_beside(const fs::path& file) {
    std::vector<fs::path> pictures;
    std::error_code error;
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (can_write(entry->path()) && entry->is_regular_file(error))
            pictures.push_back(file.parent_path() / entry->path().filename());
    std::ranges::sort(pictures);
    pictures.resize(std::min(pictures.size(), kMostPictures));
    return pictures;
}

std::vector<EmptyChannel::Offer> offers_for(const Preset& preset, const Sampler& channel) {
    std::vector<EmptyChannel::Offer> offers = {noise(channel)};
    for (const Sampler& declared : preset.scene.samplers) {
        if (declared.source != Source::buffer || !declared.tab.empty() ||
            declared.type != channel.type)
            continue;
        Sampler buffer = channel;
        buffer.pass = declared.pass, buffer.output = declared.output;
        set_defaults(buffer, Source::buffer);
        offers.push_back({declared.name, buffer});
    }
    if (channel.type != SamplerType::sampler2D) return offers;
    for (const fs::path& file : pictures_beside(preset.file)) {
        Sampler picture = channel;
        picture.files = {file};
        set_defaults(picture, Source::image);
        offers.push_back({file.filename().string(), picture});
    }
    return offers;
}

}  // namespace

std::vector<EmptyChannel> empty_channels(Playground& playground) {
    std::vector<EmptyChannel> list;
    if (!playground.is_open()) return list;
    const Preset& preset = *playground.preset();
    for (const std::size_t index : playground.renderer()->empty_channels()) {
        const Sampler channel = channel_of(preset, index);
        list.push_back({channel.name, offers_for(preset, channel)});
    }
    return list;
}

}  // namespace glint
