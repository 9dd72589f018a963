#include "window/live/study.h"

#include "base/temporary_file.h"
#include "media/image.h"
#include "scene/preset_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// As many pixels as a study draws of itself, in the shape of the window's picture.
glm::ivec2 study_size(glm::ivec2 picture) {
    constexpr double kPixels = 640.0 * 360.0;
    const double pixels = static_cast<double>(picture.x) * picture.y;
    const double scale = std::min(1.0, std::sqrt(kPixels / std::max(pixels, 1.0)));
    const auto side = [scale](int length) {
        return std::max(1, static_cast<int>(std::lround(length * scale)));
    };
    return {side(picture.x), side(picture.y)};
}

std::optional<double> number(const Json& json) {
    return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

RowFact row_from(const Json& json) {
    return {.value = json.at("value"),
            .ms = json.at("ms"),
            .ms_min = json.at("ms_min"),
            .ms_max = json.at("ms_max"),
            .rmse = number(json.at("rmse")),
            .max = number(json.at("max")).value_or(0.0),
            .psnr = number(json.at("psnr")).value_or(std::numeric_limits<double>::infinity()),
            .share_off = number(json.at("share_off")).value_or(0.0),
            .is_reference = json.at("is_reference"),
            .pareto = json.at("pareto"),
            .near_reference = json.at("near_reference"),
            .failed = json.value("failed", "")};
}

StudyFact study_from(const Json& json) {
    StudyFact study{.knob = json.at("knob"),
                    .reference = json.at("reference"),
                    .reference_error = {},
                    .order = number(json.at("order")),
                    .clock = json.at("clock"),
                    .rows = {},
                    .findings = json.at("findings")};
    const Json& error = json.at("reference_error");
    if (error.is_object()) study.reference_error = number(error.at("rmse"));
    for (const Json& row : json.at("rows")) study.rows.push_back(row_from(row));
    return study;
}

}  // namespace

// Each run has a folder of its own: one that was just killed may still be writing into its.
void LiveStudy::start(const Preset& preset, const std::string& knob) {
    clear();
    ++runs_;
    const fs::path folder = run_folder();
    const fs::path file = folder / (preset.file.stem().string() + ".toml");
    Preset small = preset;
    small.size = study_size(preset.size);
    const PresetText text = write_preset(small, file);
    if (!text.text) throw std::runtime_error(to_string(text.diagnostics.front()));
    fs::create_directories(folder);
    write_whole_file(file, std::as_bytes(std::span(*text.text)));
    std::vector<std::string> words = {"study", file.string(), "--lines", "--output",
                                      folder.string()};
    words.insert(words.end(), {"--size", fmt::format("{}x{}", small.size.x, small.size.y)});
    if (!knob.empty()) words.insert(words.end(), {"--vary", knob});
    if (!options_.device.empty()) words.insert(words.end(), {"--device", options_.device});
    if (!options_.specialise) words.push_back("--no-specialise");
    work_.start(std::move(words));
}

void LiveStudy::clear() {
    work_.clear();
    std::error_code ignored;
    fs::remove_all(run_folder(), ignored);
    studies_.clear();
    pictures_.clear();
}

bool LiveStudy::update() {
    const bool news = work_.update([this](const Json& line) { hear(line); });
    if (news && !work_.fact().running && studies_.empty())
        work_.explain("The scene has no tweak of quality, and accumulates nothing.");
    return news;
}

// A line holds one study as far as it has come.
void LiveStudy::hear(const Json& json) {
    StudyFact study = study_from(json.at("study"));
    if (studies_.empty() || studies_.back().knob != study.knob) {
        studies_.emplace_back();
        pictures_.emplace_back();
    }
    studies_.back() = std::move(study);
    pictures_.back().clear();
    const fs::path folder = run_folder();
    const auto named = [&](const Json& object, const char* key) {
        return object.contains(key) ? folder / object.at(key).get<std::string>() : fs::path();
    };
    for (const Json& row : json.at("study").at("rows")) {
        pictures_.back().push_back({.row = named(row, "picture"),
                                    .map = named(row, "map"),
                                    .reference = named(json.at("study"), "reference_picture")});
    }
}

LiveStudy::Pictures LiveStudy::pictures(std::size_t study, std::size_t row) const {
    if (study >= pictures_.size() || row >= pictures_[study].size()) return {};
    return pictures_[study][row];
}

}  // namespace glint
