// The values of a preset as TOML spells them: the shortest text that reads back as the same.
#pragma once

#include "scene/frame.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// A key and its value, spelled.
struct TomlLine {
    std::string key, value;
};

std::string toml_string(std::string_view text);
std::string toml_number(double value);  // finite; always a float: "12.0"
std::string toml_date(const Date& date);

// true, 3, 0.3, "traced", "#0b3a53", [0.1, 0.2].
std::string toml_value(const Tweak& tweak, const TweakValue& value);

// `image = "oak.png"`, `wrap = "repeat"`: what differs from the defaults of the source. None if the
// channel is off. The scene names its buffers; paths are relative to the folder.
std::vector<TomlLine> toml_channel(const Sampler& channel, const Scene& scene,
                                   const std::filesystem::path& folder);

std::vector<TomlLine> toml_event(const Event& event);

// "{ a = 1, b = 2 }".
std::string toml_braces(const std::vector<TomlLine>& lines);

// The path from the folder to the file, for whoever opens the folder through whichever links. A
// file that is a link itself keeps its name.
std::string relative_path(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace glint
