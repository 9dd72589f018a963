// Spelling values as TOML.
#include "scene/toml_text.h"

#include "base/words.h"
#include "scene/annotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace glint {

namespace {

namespace fs = std::filesystem;

// As parse_noise reads it; two 'x' say that it is a volume.
std::string noise(const Sampler& channel) {
    const glm::ivec3 size = channel.noise_size;
    const auto letters =
        std::string_view("rgba").substr(0, static_cast<std::size_t>(channel.noise_channels));
    if (channel.type == SamplerType::sampler3D)
        return fmt::format("{} {}x{}x{}", letters, size.x, size.y, size.z);
    return size.x == size.y ? fmt::format("{} {}", letters, size.x)
                            : fmt::format("{} {}x{}", letters, size.x, size.y);
}

std::string buffer(const Sampler& channel, const Scene& scene) {
    for (const Sampler& declared : scene.samplers)
        if (declared.source == Source::buffer && declared.tab.empty() &&
            declared.pass == channel.pass && declared.output == channel.output)
            return declared.name;
    return {};
}

std::string toml_files(const std::vector<fs::path>& files, const fs::path& folder) {
    if (files.size() == 1) return toml_string(relative_path(files.front(), folder));
    std::string list;
    for (const fs::path& file : files)
        list += (list.empty() ? "" : ", ") + toml_string(relative_path(file, folder));
    return fmt::format("[{}]", list);
}

TomlLine source(const Sampler& channel, const Scene& scene, const fs::path& folder) {
    switch (channel.source) {
        case Source::image:
            return {"image", toml_files(channel.files, folder)};
        case Source::cube:
            return {"cube", toml_files(channel.files, folder)};
        case Source::volume:
            return {"volume", toml_files(channel.files, folder)};
        case Source::sound:
            return {"sound", toml_files(channel.files, folder)};
        case Source::noise:
            return {"noise", toml_string(noise(channel))};
        case Source::buffer:
            return {"buffer", toml_string(buffer(channel, scene))};
        case Source::keyboard:
        case Source::none:
            break;
    }
    return {"keyboard", "true"};
}

std::string toml_array(const double* numbers, std::size_t count) {
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i) text += (i ? ", " : "") + toml_number(numbers[i]);
    return text + "]";
}

}  // namespace

std::string toml_string(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += {'\\', c};
        else if (c == '\n')
            quoted += "\\n";
        else if (c == '\t')
            quoted += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            quoted += fmt::format("\\u{:04X}", static_cast<int>(c));
        else
            quoted += c;
    }
    return quoted + "\"";
}

std::string toml_number(double value) {
    const std::string text = format_number(value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string toml_date(const Date& date) {
    constexpr long long kBillion = 1'000'000'000;
    constexpr long long kLast = 86400 * kBillion - 1;
    const long long ns = std::clamp(std::llround(date.seconds * 1e9), 0LL, kLast);
    const long long seconds = ns / kBillion;
    std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", date.year, date.month,
                                   date.day, seconds / 3600, seconds / 60 % 60, seconds % 60);
    if (ns % kBillion == 0) return text;
    text += fmt::format(".{:09}", ns % kBillion);
    return text.substr(0, text.find_last_not_of('0') + 1);
}

std::string toml_value(const Tweak& tweak, const TweakValue& value) {
    const auto count = static_cast<std::size_t>(component_count(tweak.type));
    if (tweak.type == TweakType::bool1) return value[0] != 0.0 ? "true" : "false";
    const std::string text = format_value(tweak, value);
    const bool is_word = !tweak.names.empty() || text.starts_with('#');
    if (is_word && parse_value(tweak, text) == value) return toml_string(text);
    if (tweak.type == TweakType::int1) return fmt::format("{}", std::llround(value[0]));
    return count == 1 ? toml_number(value[0]) : toml_array(value.data(), count);
}

std::vector<TomlLine> toml_channel(const Sampler& channel, const Scene& scene,
                                   const fs::path& folder) {
    if (channel.source == Source::none) return {};
    Sampler plain;
    plain.type = channel.type;
    set_defaults(plain, channel.source);
    std::vector<TomlLine> lines = {source(channel, scene, folder)};
    if (channel.wrap != plain.wrap)
        lines.push_back({"wrap", toml_string(kWrapNames.of(channel.wrap))});
    if (channel.filter != plain.filter)
        lines.push_back({"filter", toml_string(kFilterNames.of(channel.filter))});
    if (channel.vflip != plain.vflip) lines.push_back({"vflip", channel.vflip ? "true" : "false"});
    if (channel.plays) lines.push_back({"plays", "true"});
    return lines;
}

std::vector<TomlLine> toml_event(const Event& event) {
    const double mouse[] = {event.mouse.x, event.mouse.y};
    return {{"t", toml_number(event.time)},
            event.key >= 0 ? TomlLine{"key", toml_string(key_name(event.key))}
                           : TomlLine{"mouse", toml_array(mouse, 2)},
            {"down", event.down ? "true" : "false"}};
}

std::string toml_braces(const std::vector<TomlLine>& lines) {
    std::string text = "{";
    for (const TomlLine& line : lines)
        text += fmt::format("{} {} = {}", text == "{" ? "" : ",", line.key, line.value);
    return text + " }";
}

std::string relative_path(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const auto real = [&error](const fs::path& path) {
        // The folder of a bare name is the current one, which fs::absolute does not know as "".
        const fs::path whole = fs::absolute(path.empty() ? "." : path, error);
        const fs::path found = fs::weakly_canonical(whole, error);
        return error ? whole.lexically_normal() : found;
    };
    const fs::path target = real(file.parent_path()) / file.filename();
    const fs::path relative = target.lexically_relative(real(folder));
    // None where the current folder, from which the file is named, is gone.
    return (relative.empty() ? file : relative).generic_string();
}

}  // namespace glint
