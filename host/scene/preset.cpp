// Reading a preset.
#include "scene/preset.h"

#include "base/canonical_name.h"
#include "base/words.h"
#include "glsl/raw_text.h"
#include "glsl/sampler_use.h"
#include "scene/annotation.h"
#include "scene/expect_toml.h"
#include "scene/preset_reader.h"
#include "scene/scene_text.h"
#include "scene/toml_keys.h"
#include "scene/toml_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestSize = 1'000'000;  // pixels; the largest picture that any file keeps
constexpr int kMostSettle = 1'000'000, kMostTime = 1'000'000'000;  // frames, s

// At the top of a preset.
const std::vector<std::string> kKeys = {"scene",    "title",  "time",  "size",   "settle",
                                        "date",     "locked", "watch", "tweaks", "quality",
                                        "channels", "events", "expect"};

}  // namespace

Diagnostic PresetReader::syntax_error(const toml::parse_error& error) const {
    std::string text = "no valid TOML: " + better_said(error.description());
    for (char& c : text)  // it quotes what it has read, line ends too
        if (c >= 0 && c < ' ') c = ' ';
    return {Severity::error, place(error.source()), std::move(text)};
}

Diagnostic PresetReader::deep_key(std::string_view text, std::size_t at) const {
    const std::string_view before = text.substr(0, at);
    const auto line = static_cast<int>(std::ranges::count(before, '\n')) + 1;
    const auto column = static_cast<int>(at - (before.rfind('\n') + 1)) + 1;
    return {Severity::error,
            {preset_.file.string(), line, column},
            fmt::format("a key of more than {} parts; a preset's have one or two, such as "
                        "tweaks.ink",
                        kMostKeyParts)};
}

void PresetReader::read(std::string_view text) {
    if (const auto at = find_deep_key(text)) {
        result_.diagnostics.push_back(deep_key(text, *at));
        return;
    }
    const toml::parse_result parsed = toml::parse(text, preset_.file.string());
    if (!parsed) {
        result_.diagnostics.push_back(syntax_error(parsed.error()));
        return;
    }
    const toml::table& root = parsed.table();
    read_scene_key(root);
    check_root_keys(root);
    read_picture(root);
    if (const toml::node* tweaks = root.get("tweaks")) read_tweaks(*tweaks);
    if (const toml::node* quality = root.get("quality")) read_qualities(*quality);
    if (const toml::node* locked = root.get("locked")) read_locked(*locked);
    if (const toml::node* watch = root.get("watch")) read_watch(*watch);
    if (const toml::node* channels = root.get("channels")) read_channels(*channels);
    if (const toml::node* events = root.get("events")) read_events(*events);
    if (const toml::node* expect = root.get("expect"))
        preset_.expect = read_expect(*expect, preset_.file.parent_path(),
                                     [this](const toml::source_region& source, std::string wrong) {
                                         warning(source, std::move(wrong));
                                     });
    // toml++ sorts keys by name; a person reads from top to bottom.
    std::ranges::stable_sort(warnings_, [](const Diagnostic& a, const Diagnostic& b) {
        return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    });
    result_.diagnostics.insert(result_.diagnostics.end(), warnings_.begin(), warnings_.end());
    if (!has_errors(result_.diagnostics)) result_.preset = std::move(preset_);
}

void PresetReader::check_keys(const toml::table& table, const Names& known) {
    for (const auto& [key, node] : table) {
        const std::string wrong = unknown_key(key.str(), known);
        if (!wrong.empty()) warning(key.source(), wrong);
    }
}

// A tweak at the top is a line that has lost its heading.
void PresetReader::check_root_keys(const toml::table& root) {
    for (const auto& [key, node] : root) {
        const std::string wrong = unknown_key(key.str(), kKeys);
        if (wrong.empty()) continue;
        const bool is_tweak = std::ranges::find(preset_.scene.tweaks, key.str(), &Tweak::name) !=
                              preset_.scene.tweaks.end();
        warning(key.source(), is_tweak ? fmt::format("{} is a tweak of the scene: write it below "
                                                     "a line [tweaks]",
                                                     in_quotes(key.str()))
                                       : wrong);
    }
}

namespace {

// Of a channel that neither text nor preset speaks of, how the text uses it decides.
SamplerType type_by_use(const Reading& reading, std::string_view channel) {
    const std::string_view type = sampler_used_as(reading, channel);
    return kSamplerTypeNames.find(type).value_or(SamplerType::sampler2D);
}

// With the values that its text gives it.
void put_scene(Scene scene, Preset& preset) {
    preset.scene = std::move(scene);
    for (const Tweak& tweak : preset.scene.tweaks) preset.values.push_back(tweak.initial);
    if (preset.scene.text.find("iChannel") == std::string::npos) return;
    const Reading reading = read_glsl(preset.scene.text, known_of_scene());
    for (std::size_t i = 0; i < preset.channels.size(); ++i)
        preset.channels[i].type = type_by_use(reading, fmt::format("iChannel{}", i));
}

}  // namespace

void PresetReader::take_scene(Scene scene) {
    put_scene(std::move(scene), preset_);
    has_scene_ = true;
}

void PresetReader::read_scene_key(const toml::table& root) {
    if (known_scene_) return take_scene(*known_scene_);
    const toml::node* node = root.get("scene");
    const auto name = node ? node->value<std::string>() : std::nullopt;
    if (!may_name_a_file(name)) {
        const std::string why =
            node ? "the scene is missing, for this is no file's name" : "the scene is missing";
        result_.diagnostics.push_back(
            {Severity::error, node ? place(node->source()) : Place{preset_.file.string(), 1, 1},
             why + "; write scene = \"NAME.frag\", relative to this file"});
        return;
    }
    fs::path file = preset_.file.parent_path() / *name;
    if (is_preset(file)) {
        result_.diagnostics.push_back(
            {Severity::error, place(node->source()),
             fmt::format("{} is a preset, and no scene; write scene = \"NAME.frag\"",
                         in_quotes(*name))});
        return;
    }
    std::error_code error;
    if (fs::equivalent(file.lexically_normal(), file, error)) file = file.lexically_normal();
    ReadScene read = read_scene(file);
    for (Diagnostic& diagnostic : read.diagnostics) {
        // The whole file is missing: the mistake, if it is one, stands in the preset.
        if (diagnostic.missing_file && diagnostic.place.line == 0)
            diagnostic.place = place(node->source());
        result_.diagnostics.push_back(std::move(diagnostic));
    }
    result_.files.insert(result_.files.end(), read.files.begin(), read.files.end());
    if (read.scene) take_scene(std::move(*read.scene));
}

void PresetReader::read_picture(const toml::table& root) {
    if (const toml::node* node = root.get("title")) {
        if (const auto title = node->value<std::string>())
            preset_.title = *title;
        else
            warning(*node, "title is a text; write title = \"Harbour at dusk\"");
    }
    if (const toml::node* node = root.get("time")) {
        const auto time = finite_number(*node);
        preset_.time = std::clamp(time.value_or(0.0), 0.0, double{kMostTime});
        if (!time || *time != preset_.time)
            warning(*node, fmt::format("time is a number of seconds from 0 to {}; it is {}",
                                       kMostTime, format_number(preset_.time)));
    }
    if (const toml::node* node = root.get("settle")) {
        const auto settle = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
        if (!settle)
            warning(*node, "settle is a whole number of frames; it stays 0");
        else if (*settle < 0 || *settle > kMostSettle)
            warning(*node, fmt::format("settle is from 0 to {}; clamped", kMostSettle));
        if (settle)
            preset_.settle = static_cast<int>(std::clamp<std::int64_t>(*settle, 0, kMostSettle));
    }
    if (const toml::node* node = root.get("size")) read_size(*node);
    if (const toml::node* node = root.get("date")) read_date(*node);
}

void PresetReader::read_size(const toml::node& node) {
    const toml::array* pair = node.as_array();
    const auto length = [&](std::size_t i) {
        return (*pair)[i].is_integer() ? (*pair)[i].value<std::int64_t>() : std::nullopt;
    };
    if (!pair || pair->size() != 2 || !length(0) || !length(1))
        return warning(node, fmt::format("size is two whole numbers, such as size = [1280, 720]; "
                                         "it stays {} x {}",
                                         preset_.size.x, preset_.size.y));
    for (int i = 0; i < 2; ++i) {
        const std::int64_t pixels = *length(static_cast<std::size_t>(i));
        const auto clamped = std::clamp<std::int64_t>(pixels, 1, kLargestSize);
        if (clamped != pixels)
            warning((*pair)[static_cast<std::size_t>(i)],
                    fmt::format("{} pixels are outside 1 to {}; clamped to {}", pixels,
                                kLargestSize, clamped));
        preset_.size[i] = static_cast<int>(clamped);
    }
    preset_.has_size = true;
}

void PresetReader::read_date(const toml::node& node) {
    const auto* written = node.as_date_time();
    const auto* day_only = node.as_date();
    if ((!written || written->get().offset) && !day_only)
        return warning(node,
                       "date is a date and time without a zone, such as 2000-01-01T12:00:00; it "
                       "stays 2000-01-01T00:00:00");
    const toml::date date = written ? written->get().date : day_only->get();
    const toml::time time = written ? written->get().time : toml::time{};
    preset_.date = {
        .year = date.year,
        .month = date.month,
        .day = date.day,
        .seconds = time.hour * 3600.0 + time.minute * 60.0 + time.second + time.nanosecond * 1e-9};
}

void PresetReader::read_tweaks(const toml::node& node) {
    const toml::table* tweaks = node.as_table();
    if (!tweaks) return warning(node, "tweaks is a table; write [tweaks] on a line of its own");
    if (!has_scene_) return;
    for (const auto& [key, value] : *tweaks)
        if (const auto read = read_tweak(key, value)) preset_.values[read->tweak] = read->value;
}

void PresetReader::read_qualities(const toml::node& node) {
    const toml::table* qualities = node.as_table();
    if (!qualities) return warning(node, "quality has tables; write [quality.NAME] on a line");
    if (!has_scene_) return;
    for (const auto& [name, values] : *qualities) {
        const toml::table* table = values.as_table();
        if (!table) {
            warning(name.source(),
                    "a quality is a table of tweaks; write [quality.NAME] on a line");
            continue;
        }
        if (parse_number(name.str()))
            warning(name.source(), fmt::format("a quality has a word for its name: --quality {} is "
                                               "that of JPEG files",
                                               name.str()));
        QualitySet& set = preset_.qualities.emplace_back();
        set.name = name.str();
        for (const auto& [key, value] : *table)
            if (const auto read = read_tweak(key, value)) set.values.push_back(*read);
    }
}

std::optional<Turned> PresetReader::read_tweak(const toml::key& key, const toml::node& node) {
    const auto& tweaks = preset_.scene.tweaks;
    const auto tweak = std::ranges::find(tweaks, key.str(), &Tweak::name);
    if (tweak == tweaks.end()) {
        Names names;
        for (const Tweak& known : tweaks) names.push_back(known.name);
        warning(key.source(),
                fmt::format("the scene has no tweak {}{}", in_quotes(key.str()),
                            std::ranges::find(kKeys, key.str()) != kKeys.end()
                                ? ": this is a key of the preset, write it above all [headings]"
                                : did_you_mean(key.str(), names)));
        return std::nullopt;
    }
    const auto value = tweak_value(*tweak, node);
    if (!value) {
        warning(node, fmt::format("{} takes {}; it keeps its default {}{}", tweak->name,
                                  expected_value(*tweak), format_value(*tweak, tweak->initial),
                                  did_you_mean(node.value_or(""), tweak->names)));
        return std::nullopt;
    }
    const TweakValue clamped = clamp_to_range(*tweak, *value);
    if (clamped != *value) {
        const bool one = component_count(tweak->type) == 1;
        warning(node, fmt::format("{} is {}, not {}; clamped to {}", tweak->name,
                                  one ? format_number((*value)[0]) : format_value(*tweak, *value),
                                  expected_value(*tweak), format_value(*tweak, clamped)));
    }
    return Turned{static_cast<std::size_t>(tweak - tweaks.begin()), clamped};
}

// A name that the scene does not have is told and kept: the scene may have it again tomorrow.
void PresetReader::read_locked(const toml::node& node) {
    const toml::array* names = node.as_array();
    if (!names)
        return warning(node, "locked is a list of tweaks; write locked = [\"NAME\", \"NAME\"]");
    Names known;
    for (const Tweak& tweak : preset_.scene.tweaks) known.push_back(tweak.name);
    for (const toml::node& entry : *names) {
        const auto* name = entry.as_string();
        if (!name) {
            warning(entry, "the name of a tweak is a text; write it in quotes");
            continue;
        }
        preset_.locked.push_back(name->get());
        if (has_scene_ && std::ranges::find(known, name->get()) == known.end())
            warning(entry, fmt::format("the scene has no tweak {}{}", in_quotes(name->get()),
                                       did_you_mean(name->get(), known)));
    }
}

// What names no line of today's text is kept: probing tells.
void PresetReader::read_watch(const toml::node& node) {
    constexpr const char* kForm = "watch is a list of texts; write watch = [\"EXPR@LINE\"]";
    const toml::array* list = node.as_array();
    if (!list) return warning(node, kForm);
    for (const toml::node& entry : *list) {
        const auto* text = entry.as_string();
        if (text && text->get().find('@') != std::string::npos)
            preset_.watch.push_back(text->get());
        else
            warning(entry, kForm);
    }
}

namespace {

void read_bare_scene(const fs::path& file, ReadPreset& result) {
    ReadScene read = read_scene(file);
    result.diagnostics = std::move(read.diagnostics);
    result.files = std::move(read.files);
    if (!read.scene) return;
    Preset preset;
    preset.file = file;
    put_scene(std::move(*read.scene), preset);
    result.preset = std::move(preset);
}

}  // namespace

bool is_preset(const fs::path& file) {
    return ending_of(file) == ".toml";
}

ReadPreset read_preset(const fs::path& file) {
    ReadPreset result;
    if (!is_preset(file)) {
        read_bare_scene(file, result);
        return result;
    }
    result.files.push_back(file);
    std::string why_not;
    const auto text = read_bytes(file, why_not);
    if (!text) {
        result.diagnostics.push_back(
            {Severity::error, Place{file.string()},
             fmt::format("cannot read {}: {}", in_quotes(file.string()), why_not), true});
        return result;
    }
    PresetReader(file, nullptr, result).read(*text);
    return result;
}

ReadPreset parse_preset(std::string_view text, const fs::path& file, const Scene& scene) {
    ReadPreset result;
    PresetReader(file, &scene, result).read(text);
    return result;
}

}  // namespace glint
