#include "measure/study/store.h"

#include "base/hash.h"
#include "base/json_text.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "base/words.h"
#include "glsl/raw_text.h"
#include "measure/rows/heat.h"
#include "scene/passes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The whole key stands in the row's file, so that a clash is seen.
std::string digest(std::string_view text) {
    Hash hash;
    hash.add(text);
    return hash.text();
}

Json to_json(const FrameTimes& times) {
    return {times.wall, times.gpu, times.processor};
}

FrameTimes times_from(const Json& json) {
    const FrameTimes times{json.at(0), json.at(1), json.at(2)};
    if (times.gpu.size() != times.wall.size() || times.processor.size() != times.wall.size())
        throw std::runtime_error("A frame lacks a clock");
    return times;
}

Image bytes_image(glm::ivec2 size) {
    return {.size = size, .channels = 3, .type = ChannelType::u8, .pixels = {}};
}

void push_byte(Image& image, double value) {
    const double shown = value > 0.0 ? std::min(value, 1.0) : 0.0;  // not-a-number is black
    image.pixels.push_back(static_cast<std::byte>(std::lround(shown * 255.0)));
}

// What is read from a file. Nothing where it is not there, and nothing with a word where it is not
// what was written: whoever calls makes it anew.
template <class Read>
auto kept(const fs::path& name, Read read) -> decltype(read()) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(name, error))) return {};
    try {
        if (fs::is_regular_file(name, error)) return read();
    } catch (const std::exception&) {
    }
    say("{}: warning: it is damaged, and is made anew\n", name.string());
    return {};
}

// Nothing where it is another's, whose digest is the same. Throws where it is not what keep()
// wrote.
std::optional<StudyRow> row_in(const fs::path& name, const StudyKey& key) {
    std::string why_not;
    const Json json = Json::parse(read_bytes(name, why_not).value_or(""));
    if (json.at("key") != key.text) return std::nullopt;
    StudyRow row{.value = json.at("value")};
    if (!json.at("work").is_null()) row.work = json.at("work");
    if (!json.at("error").is_null()) row.error = difference_from_json(json.at("error"));
    row.failed = json.at("failed");
    row.is_reference = json.at("is_reference");
    row.picture = json.at("picture");
    row.map = json.at("map");
    row.resumed = true;
    return row;
}

std::optional<Rounds> rounds_in(const fs::path& name, const StudyKey& key) {
    std::string why_not;
    const Json json = Json::parse(read_bytes(name, why_not).value_or(""));
    if (json.at("key") != key.text) return std::nullopt;
    Rounds rounds{.rows = {}, .all_passes = json.at("all_passes"), .look = json.at("look")};
    for (const Json& row : json.at("rows")) rounds.rows.push_back(times_from(row));
    if (rounds.rows.size() != rounds.all_passes.size())
        throw std::runtime_error("A row lacks a time");
    return rounds;
}

std::vector<float> rgba_in(const fs::path& name, glm::ivec2 size) {
    const Image image = read_image(name);
    if (image.size != size || image.type != ChannelType::f32 || image.channels != 3) {
        throw std::runtime_error("It is another picture");
    }
    std::vector<float> rgba(image.pixels.size() / sizeof(float) / 3 * 4, 1.0f);
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
        std::memcpy(&rgba[i * 4], image.pixels.data() + i * 3 * sizeof(float), 3 * sizeof(float));
    }
    return rgba;
}

bool has_bytes(const fs::path& name) {
    return kept(name, [&] { return !read_image(name).pixels.empty(); });
}

std::string file_facts(const fs::path& file) {
    std::error_code unknown;
    return fmt::format("{} {} {}", file.string(), fs::file_size(file, unknown),
                       fs::last_write_time(file, unknown).time_since_epoch().count());
}

}  // namespace

std::string key_of_setting(const Preset& preset, const Setting& setting) {
    std::string text = fmt::format("settle {}\n", setting.settle);
    for (std::size_t i = 0; i < setting.values.size(); ++i) {
        const Tweak& tweak = preset.scene.tweaks[i];
        text += fmt::format("{} {}\n", tweak.name, format_value(tweak, setting.values[i]));
    }
    if (setting.format) {
        text += fmt::format("{} {}\n", preset.scene.passes[setting.format->pass].name,
                            name_of(setting.format->format));
    }
    return text;
}

std::string key_of_preset(const Preset& preset, const std::string& renderer,
                          const std::string& pass, bool specialise) {
    std::string text =
        fmt::format("glint {}\n{}\nscene {}\nsize {}x{}\ntime {}\n{} {}\n", GLINT_VERSION, renderer,
                    digest(preset.scene.text), preset.size.x, preset.size.y,
                    format_number(preset.time), pass, specialise);
    text += fmt::format("date {} {} {} {}\n", preset.date.year, preset.date.month, preset.date.day,
                        format_number(preset.date.seconds));
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        text += sampler_facts(sampler);
        for (const fs::path& file : sampler.files) text += " " + file_facts(file);
        text += '\n';
    }
    for (const Event& event : preset.events) {
        text += fmt::format("event {} {} {} {} {}\n", format_number(event.time), event.key,
                            event.down, format_number(event.mouse.x), format_number(event.mouse.y));
    }
    return text;
}

StudyStore::StudyStore(fs::path folder) : folder_(std::move(folder)) {
    if (folder_.empty()) return;
    make_folder(folder_ / "data");
    make_folder(folder_ / "pictures");
}

fs::path StudyStore::file(const char* kind, const StudyKey& key, const char* end) const {
    std::string name;
    for (const char c : key.name) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_';
        if (plain || name.empty() || name.back() != '-') name += plain ? c : '-';
    }
    return folder_ / kind / fmt::format("{}-{}{}", name.substr(0, 80), digest(key.text), end);
}

std::optional<StudyRow> StudyStore::row(const StudyKey& key, glm::ivec2 size) const {
    if (folder_.empty()) return std::nullopt;
    const fs::path name = file("data", key, ".json");
    auto row = kept(name, [&] { return row_in(name, key); });
    if (!row || row->picture.empty()) return row;
    row->picture = shown_file(key);
    row->map = map_file(key);
    row->flip_map = flip_file(key);
    if (!picture(key, size) || !has_bytes(folder_ / row->map)) return std::nullopt;
    if (!has_bytes(folder_ / row->flip_map)) return std::nullopt;
    return row;
}

void StudyStore::keep(const StudyKey& key, const StudyRow& row) const {
    if (folder_.empty()) return;
    const Json json = {{"key", key.text},
                       {"value", row.value},
                       {"work", row.work ? Json(*row.work) : Json()},
                       {"error", row.error ? glint::to_json(*row.error) : Json()},
                       {"failed", row.failed},
                       {"is_reference", row.is_reference},
                       {"picture", row.picture},
                       {"map", row.map}};
    const std::string text = json_text(json, 1) + "\n";
    write_whole_file(cleared(file("data", key, ".json")), std::as_bytes(std::span(text)));
}

std::optional<Rounds> StudyStore::rounds(const StudyKey& key) const {
    if (folder_.empty()) return std::nullopt;
    const fs::path name = file("data", key, ".json");
    return kept(name, [&] { return rounds_in(name, key); });
}

void StudyStore::keep(const StudyKey& key, const Rounds& rounds) const {
    if (folder_.empty()) return;
    Json json = {{"key", key.text},
                 {"look", rounds.look},
                 {"all_passes", rounds.all_passes},
                 {"rows", Json::array()}};
    for (const FrameTimes& row : rounds.rows) json["rows"].push_back(to_json(row));
    const std::string text = json_text(json, 1) + "\n";
    write_whole_file(cleared(file("data", key, ".json")), std::as_bytes(std::span(text)));
}

std::optional<std::vector<float>> StudyStore::picture(const StudyKey& key, glm::ivec2 size) const {
    if (folder_.empty()) return std::nullopt;
    const fs::path name = file("data", key, ".exr");
    auto rgba = kept(name, [&] { return std::optional(rgba_in(name, size)); });
    return has_bytes(folder_ / shown_file(key)) ? rgba : std::nullopt;
}

std::string StudyStore::shown_file(const StudyKey& key) const {
    return file("pictures", key, ".png").lexically_relative(folder_).string();
}

std::string StudyStore::map_file(const StudyKey& key) const {
    return file("pictures", key, "-map.png").lexically_relative(folder_).string();
}

std::string StudyStore::flip_file(const StudyKey& key) const {
    return file("pictures", key, "-flip.png").lexically_relative(folder_).string();
}

std::string StudyStore::keep_picture(const StudyKey& key, std::span<const float> rgba,
                                     glm::ivec2 size) const {
    if (folder_.empty()) return {};
    Image exact{.size = size, .channels = 3, .type = ChannelType::f32, .pixels = {}};
    Image shown = bytes_image(size);
    exact.pixels.resize(rgba.size() / 4 * 3 * sizeof(float));
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
        std::memcpy(exact.pixels.data() + i * 3 * sizeof(float), &rgba[i * 4], 3 * sizeof(float));
        for (std::size_t c = 0; c < 3; ++c) push_byte(shown, rgba[i * 4 + c]);
    }
    write_image(cleared(folder_ / shown_file(key)), shown);
    write_image(cleared(file("data", key, ".exr")), exact);
    return shown_file(key);
}

std::optional<std::string> StudyStore::cut_pass(const StudyKey& key) const {
    if (folder_.empty()) return std::nullopt;
    const fs::path name = file("data", key, ".cut");
    return kept(name, [&]() -> std::optional<std::string> {
        std::string why_not;
        const Json json = Json::parse(read_bytes(name, why_not).value_or(""));
        if (json.at("key") != key.text) return std::nullopt;
        return json.at("cut_pass").get<std::string>();
    });
}

void StudyStore::keep_cut_pass(const StudyKey& key, const std::string& pass) const {
    if (folder_.empty()) return;
    const Json json = {{"key", key.text}, {"cut_pass", pass}};
    const std::string text = json_text(json, 1) + "\n";
    write_whole_file(cleared(file("data", key, ".cut")), std::as_bytes(std::span(text)));
}

std::string StudyStore::keep_map(const StudyKey& key, std::span<const float> picture,
                                 std::span<const float> reference, glm::ivec2 size,
                                 Values values) const {
    if (folder_.empty()) return {};
    Image map = bytes_image(size);
    map.pixels = difference_heat(picture, reference, values);
    write_image(cleared(folder_ / map_file(key)), map);
    return map_file(key);
}

std::string StudyStore::keep_flip_map(const StudyKey& key, std::span<const float> map,
                                      glm::ivec2 size) const {
    if (folder_.empty()) return {};
    Image shown = bytes_image(size);
    shown.pixels = heat(map);
    write_image(cleared(folder_ / flip_file(key)), shown);
    return flip_file(key);
}

}  // namespace glint
