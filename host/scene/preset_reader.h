// Who reads a preset; scene/preset.h has what comes of it.
#pragma once

#include "scene/preset.h"
#include "scene/toml.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glint {

// The system would read a name with a NUL in it up to there, and open another file.
inline bool may_name_a_file(const std::optional<std::string>& text) {
    return text && !text->empty() && text->find('\0') == text->npos;
}

class PresetReader {
public:
    // Without a scene, the one that the preset names is read.
    PresetReader(const std::filesystem::path& file, const Scene* scene, ReadPreset& result)
        : result_(result), known_scene_(scene) {
        preset_.file = file;
    }

    void read(std::string_view text);

private:
    using Names = std::vector<std::string>;

    Diagnostic syntax_error(const toml::parse_error& error) const;
    Diagnostic deep_key(std::string_view text, std::size_t at) const;
    void read_scene_key(const toml::table& root);
    void take_scene(Scene scene);
    void read_picture(const toml::table& root);
    void read_size(const toml::node& node);
    void read_date(const toml::node& node);
    void read_tweaks(const toml::node& node);
    void read_locked(const toml::node& node);
    void read_watch(const toml::node& node);
    std::optional<Turned> read_tweak(const toml::key& key, const toml::node& node);
    void read_qualities(const toml::node& node);
    void read_channels(const toml::node& node);
    void read_channel(std::size_t index, const toml::table& table);
    void read_channel_source(Sampler& sampler, std::string_view key, const toml::node& node);
    void read_cube_files(Sampler& sampler, const toml::array& files);
    void read_channel_options(Sampler& sampler, const toml::table& table);
    void read_events(const toml::node& node);
    std::optional<Event> read_event(const toml::table& table);
    bool read_event_input(Event& event, const toml::table& table);
    void check_keys(const toml::table& table, const Names& known);
    void check_root_keys(const toml::table& root);

    Place place(const toml::source_region& source) const {
        return {preset_.file.string(), static_cast<int>(source.begin.line),
                static_cast<int>(source.begin.column)};
    }
    void warning(const toml::source_region& source, std::string text) {
        warnings_.push_back({Severity::warning, place(source), std::move(text)});
    }
    void warning(const toml::node& node, std::string text) {
        warning(node.source(), std::move(text));
    }

    ReadPreset& result_;
    Diagnostics warnings_;  // of the preset itself
    Preset preset_;
    const Scene* known_scene_;
    bool has_scene_ = false;
};

}  // namespace glint
