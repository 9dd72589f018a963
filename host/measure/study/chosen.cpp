#include "measure/study/chosen.h"

#include "base/say.h"
#include "base/temporary_file.h"
#include "base/terminal.h"
#include "base/words.h"
#include "measure/study/joint.h"
#include "offline/common.h"
#include "scene/preset_writer.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {

void require_preset_output(const StudyOptions& options) {
    if (options.files.size() != 1 || !limit_of(options))
        throw UsageError("-o with a preset takes one FILE, and --ms, --rmse or --flip.");
    if (options.name.empty() || parse_number(options.name)) {
        throw UsageError(
            fmt::format("--name {}: write a word; --quality with a number is that of JPEG files.",
                        options.name));
    }
    const std::filesystem::path folder = options.output.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
        throw UsageError(
            fmt::format("-o {}: there is no folder {}.", options.output.string(), folder.string()));
    }
    if (!std::filesystem::exists(options.output)) return;
    const ReadPreset read = read_preset(options.output), from = read_preset(options.files.front());
    if (!read.preset) report(read.diagnostics);
    if (!read.preset) throw Stop(ExitCode::failure);
    std::error_code none;
    if (from.preset && !std::filesystem::equivalent(from.preset->scene.files.front(),
                                                    read.preset->scene.files.front(), none))
        throw UsageError(
            fmt::format("-o {}: it is a preset of another scene.", options.output.string()));
}

void write_best(const StudyOptions& options, const std::vector<Study>& studies) {
    if (studies.empty()) return;
    if (!studies.front().best) {
        say_error(fmt::format("{} is not written: {}", options.output.string(),
                              studies.front().findings.back()));
        throw Stop(ExitCode::failure);
    }
    const Study& study = studies.front();
    const bool exists = std::filesystem::exists(options.output);
    ReadPreset read = read_preset(exists ? options.output : options.files.front());
    report(read.diagnostics);
    if (!read.preset) throw Stop(ExitCode::failure);
    Preset& preset = *read.preset;
    QualitySet best{.name = options.name, .values = {}};
    std::string list = study.rows[*study.best].value, wrong;
    std::ranges::replace(list, ' ', ',');
    best.values = turned_values(preset.scene.tweaks, {}, list, wrong);
    if (!wrong.empty()) throw std::runtime_error(wrong);
    std::erase_if(preset.qualities, [&](const QualitySet& q) { return q.name == best.name; });
    preset.qualities.push_back(std::move(best));
    std::string why_not;
    const auto bytes = exists ? read_bytes(options.output, why_not) : std::string();
    const PresetText text = write_preset(preset, options.output, bytes.value_or(""));
    report(text.diagnostics);
    if (!text.text) throw Stop(ExitCode::failure);
    write_whole_file(options.output, std::as_bytes(std::span(*text.text)));
}

}  // namespace glint
