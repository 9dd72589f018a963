#include "window/live/study.h"

#include "base/temporary_file.h"
#include "measure/rows/together.h"
#include "media/image.h"
#include "scene/preset_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;
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
    if (knob == kAllTogether)
        words.insert(words.end(), {"--ms", "own", "--seconds", "10"});
    else if (!knob.empty())
        words.insert(words.end(), {"--vary", knob});
    if (!options_.device.empty()) words.insert(words.end(), {"--device", options_.device});
    if (!options_.specialise) words.push_back("--no-specialise");
    work_.start(std::move(words));
}

void LiveStudy::clear() {
    work_.clear();
    std::error_code ignored;
    fs::remove_all(run_folder(), ignored);
    studies_.clear();
}

bool LiveStudy::update() {
    const bool news = work_.update([this](const nlohmann::ordered_json& line) { hear(line); });
    if (news) work_.rename(run_folder().string() + "/", "");
    if (news && !work_.fact().running && studies_.empty())
        work_.explain("The scene has no tweak of quality, and accumulates nothing.");
    return news;
}

// A line holds one study as far as it has come; none while joint settings are sought.
void LiveStudy::hear(const nlohmann::ordered_json& json) {
    if (!json.contains("study")) return;
    Study study = study_from_json(json.at("study"));
    if (studies_.empty() || studies_.back().knob != study.knob) studies_.emplace_back();
    studies_.back() = std::move(study);
}

LiveStudy::Pictures LiveStudy::pictures(std::size_t study, std::size_t row) const {
    if (study >= studies_.size() || row >= studies_[study].rows.size()) return {};
    const auto file = [&](const std::string& name) {
        return name.empty() ? fs::path() : run_folder() / name;
    };
    const StudyRow& found = studies_[study].rows[row];
    return {.row = file(found.picture),
            .map = file(found.map),
            .reference = file(studies_[study].reference_picture)};
}

}  // namespace glint
