// Reading a preset: its channels and events.
#include "base/names.h"
#include "scene/annotation.h"
#include "scene/preset_reader.h"
#include "scene/toml_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace glint {

void PresetReader::read_channels(const toml::node& node) {
    const toml::table* channels = node.as_table();
    if (!channels)
        return warning(node, "channels is a table; write [channels] on a line of its own");
    static const Names kChannels = {"iChannel0", "iChannel1", "iChannel2", "iChannel3"};
    check_keys(*channels, kChannels);
    for (const auto& [key, value] : *channels) {
        const auto known = std::ranges::find(kChannels, key.str());
        if (known == kChannels.end()) continue;
        const auto& declared = preset_.scene.samplers;
        if (std::ranges::any_of(
                declared, [&](const Sampler& s) { return s.name == *known && s.tab.empty(); }))
            warning(key.source(),
                    fmt::format("the scene fills {} itself; this line is not used", *known));
        else if (const toml::table* table = value.as_table())
            read_channel(static_cast<std::size_t>(known - kChannels.begin()), *table);
        else
            warning(value, fmt::format("{} is a table; write {} = {{ image = \"wood.png\" }}",
                                       *known, *known));
    }
}

void PresetReader::read_channel(std::size_t index, const toml::table& table) {
    static const Names kSources = {"image", "cube",     "volume", "sound",
                                   "noise", "keyboard", "buffer"};
    Names known = kSources;
    known.insert(known.end(), {"wrap", "filter", "vflip", "plays"});
    check_keys(table, known);
    Sampler sampler;
    sampler.name = fmt::format("iChannel{}", index);
    sampler.place = place(table.source());
    const auto declared = preset_.scene.channel_types[index];
    const SamplerType used_as = declared.value_or(preset_.channels[index].type);
    int sources = 0;
    for (const std::string& source : kSources) {
        const toml::node* node = table.get(source);
        if (!node) continue;
        if (++sources > 1) {
            warning(*node, fmt::format("a channel has one source; {} is not used", source));
            continue;
        }
        if (source == "noise") sampler.type = used_as;  // noise fills any kind
        read_channel_source(sampler, source, *node);
    }
    if (sources == 0)
        warning(table.source(),
                "this channel has no source; write image =, cube =, volume =, sound =, noise =, "
                "keyboard = true or buffer =");
    if (sampler.source == Source::none) return;
    if (declared && *declared != sampler.type)
        return warning(table.source(),
                       fmt::format("the scene declares {} as {}, and this fills a {}; not used",
                                   sampler.name, glsl_name(*declared), glsl_name(sampler.type)));
    read_channel_options(sampler, table);
    preset_.channels[index] = std::move(sampler);
}

void PresetReader::read_channel_source(Sampler& sampler, std::string_view key,
                                       const toml::node& node) {
    if (key == "keyboard") {
        if (node.value_exact<bool>().value_or(false))
            return set_defaults(sampler, Source::keyboard);
        return warning(node, "keyboard is a switch; write keyboard = true, or leave it out");
    }
    if (key == "cube" && node.is_array()) return read_cube_files(sampler, *node.as_array());
    const auto text = node.value<std::string>();
    if (!may_name_a_file(text)) {
        const char* example = key == "image"    ? "wood.png"
                              : key == "cube"   ? "sky.hdr"
                              : key == "volume" ? "clouds.bin"
                              : key == "sound"  ? "song.ogg"
                              : key == "noise"  ? "rgba 256"
                                                : "waves";
        return warning(node, fmt::format("{0} is {1}; write {0} = \"{2}\"", key,
                                         text && text->empty() ? "empty" : "a text", example));
    }
    const auto read_file = [&](Source source, SamplerType type) {
        sampler.type = type;
        sampler.files = {preset_.file.parent_path() / *text};
        set_defaults(sampler, source);
    };
    if (key == "image") return read_file(Source::image, SamplerType::sampler2D);
    if (key == "cube") return read_file(Source::cube, SamplerType::samplerCube);
    if (key == "volume") return read_file(Source::volume, SamplerType::sampler3D);
    if (key == "sound") return read_file(Source::sound, SamplerType::sampler2D);
    if (key == "noise") {
        if (std::ranges::count(*text, 'x') == 2) sampler.type = SamplerType::sampler3D;
        const std::string wrong = parse_noise(*text, sampler);
        return wrong.empty() ? set_defaults(sampler, Source::noise) : warning(node, wrong);
    }
    Names names;
    for (const Sampler& declared : preset_.scene.samplers) {
        if (declared.source != Source::buffer || !declared.tab.empty()) continue;
        names.push_back(declared.name);
        if (declared.name != *text) continue;
        sampler.type = declared.type;
        sampler.pass = declared.pass;
        sampler.output = declared.output;
        return set_defaults(sampler, Source::buffer);
    }
    if (has_scene_)
        warning(node, fmt::format("the scene has no buffer {}{}", in_quotes(*text),
                                  did_you_mean(*text, names)));
}

void PresetReader::read_cube_files(Sampler& sampler, const toml::array& files) {
    const std::string wrong = check_cube_files(files.size());
    if (!wrong.empty()) return warning(files, wrong);
    for (const toml::node& file : files) {
        const auto name = file.value<std::string>();
        if (!may_name_a_file(name))
            return warning(file, "the name of a file is a text; write \"px.png\"");
        sampler.files.push_back(preset_.file.parent_path() / *name);
    }
    sampler.type = SamplerType::samplerCube;
    set_defaults(sampler, Source::cube);
}

void PresetReader::read_channel_options(Sampler& sampler, const toml::table& table) {
    if (const toml::node* node = table.get("wrap")) {
        if (const auto wrap = kWrapNames.find(node->value_or("")))
            sampler.wrap = *wrap;
        else
            warning(*node, "wrap is \"clamp\", \"repeat\" or \"mirror\"");
    }
    if (const toml::node* node = table.get("filter")) {
        if (const auto filter = kFilterNames.find(node->value_or("")))
            sampler.filter = *filter;
        else
            warning(*node, "filter is \"nearest\", \"linear\" or \"mipmap\"");
    }
    for (const auto& [key, value] :
         {std::pair{"vflip", &sampler.vflip}, {"plays", &sampler.plays}}) {
        const toml::node* node = table.get(key);
        if (!node) continue;
        if (!takes_option(sampler.source, key)) {
            warning(*node, fmt::format("{} means nothing here: {}", key,
                                       std::string_view(key) == "vflip"
                                           ? "an image or a cube may be turned upside down"
                                           : "noise alone may play with the time"));
            continue;
        }
        if (const auto* on = node->as_boolean())
            *value = on->get();
        else
            warning(*node, fmt::format("{} is true or false", key));
    }
}

void PresetReader::read_events(const toml::node& node) {
    const toml::array* events = node.as_array();
    if (!events) return warning(node, "events is a list; write [[events]] above each of them");
    for (const toml::node& entry : *events) {
        const toml::table* table = entry.as_table();
        if (!table) {
            warning(entry, "an event is a table; write [[events]] above each of them");
            continue;
        }
        if (const auto event = read_event(*table)) preset_.events.push_back(*event);
    }
    std::ranges::stable_sort(preset_.events, {}, &Event::time);
}

// An event that lacks something is left out: half an event would be another one.
std::optional<Event> PresetReader::read_event(const toml::table& table) {
    check_keys(table, {"t", "key", "mouse", "down"});
    Event event;
    const toml::node* time = table.get("t");
    const auto seconds = time ? finite_number(*time) : std::nullopt;
    if (!seconds || *seconds < 0.0) {
        warning(time ? time->source() : table.source(),
                "an event needs its time in seconds from 0, such as t = 0.5; left out");
        return std::nullopt;
    }
    event.time = *seconds;
    const toml::node* down = table.get("down");
    if (!down || !down->is_boolean()) {
        warning(down ? down->source() : table.source(),
                "an event says down = true or down = false; left out");
        return std::nullopt;
    }
    event.down = down->value_or(false);
    if (!read_event_input(event, table)) return std::nullopt;
    return event;
}

bool PresetReader::read_event_input(Event& event, const toml::table& table) {
    const toml::node* key = table.get("key");
    const toml::node* mouse = table.get("mouse");
    if ((key != nullptr) == (mouse != nullptr)) {
        warning(table.source(), "an event has either key = \"up\" or mouse = [0.5, 0.5]; left out");
        return false;
    }
    if (key) {
        const auto name = key->value<std::string>();
        const std::int64_t code = key->is_integer() ? key->value_or(std::int64_t{-1}) : -1;
        if (name) event.key = key_code(*name);
        if (code >= 0 && code < kKeyCount) event.key = static_cast<int>(code);
        if (event.key < 0)
            warning(*key,
                    "no such key; write a name such as \"up\", \"space\", \"a\" or \"f1\", or "
                    "a JavaScript key code from 0 to 255; left out");
        return event.key >= 0;
    }
    const toml::array* pair = mouse->as_array();
    const auto x = pair && pair->size() == 2 ? finite_number((*pair)[0]) : std::nullopt;
    const auto y = pair && pair->size() == 2 ? finite_number((*pair)[1]) : std::nullopt;
    if (!x || !y) {
        warning(*mouse,
                "mouse is two fractions of the picture, y up, such as [0.5, 0.4]; left out");
        return false;
    }
    event.mouse = {*x, *y};
    return true;
}

}  // namespace glint
