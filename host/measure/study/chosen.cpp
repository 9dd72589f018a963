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

namespace {

// What --quality and --tweak turned before: the setting was found on that, and holds with it alone.
void add_stood_on(const StudyOptions& options, Preset preset, std::vector<Turned>& values) {
    const std::vector<TweakValue> own = preset.values;
    lay_over(preset, options.view);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const bool is_chosen = std::ranges::find(values, i, &Turned::tweak) != values.end();
        if (preset.values[i] != own[i] && !is_chosen) values.push_back({i, preset.values[i]});
    }
    std::ranges::sort(values, {}, &Turned::tweak);
}

// What -o is to hold, with these values under the name. Throws Stop.
std::string text_with_best(const StudyOptions& options, const std::vector<Turned>& values) {
    const bool exists = std::filesystem::exists(options.output);
    ReadPreset read = read_preset(exists ? options.output : options.files.front());
    if (!read.preset) report(read.diagnostics);
    if (!read.preset) throw Stop(ExitCode::failure);
    auto& qualities = read.preset->qualities;
    std::erase_if(qualities, [&](const QualitySet& set) { return set.name == options.name; });
    qualities.push_back({.name = options.name, .values = values});
    std::string why_not;
    const auto bytes = exists ? read_bytes(options.output, why_not) : std::string();
    const PresetText text = write_preset(*read.preset, options.output, bytes.value_or(""));
    if (!text.text) report(text.diagnostics);
    if (!text.text) throw Stop(ExitCode::failure);
    return *text.text;
}

}  // namespace

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
    const bool exists = std::filesystem::exists(options.output);
    const ReadPreset read = read_preset(options.output), from = read_preset(options.files.front());
    if (exists && !read.preset) report(read.diagnostics);
    if (exists && !read.preset) throw Stop(ExitCode::failure);
    std::error_code none;
    if (exists && from.preset &&
        !std::filesystem::equivalent(from.preset->scene.files.front(),
                                     read.preset->scene.files.front(), none))
        throw UsageError(
            fmt::format("-o {}: it is a preset of another scene.", options.output.string()));
    // Any value will do to see whether the text takes one.
    if (from.preset && !from.preset->values.empty())
        text_with_best(options, {{0, from.preset->values.front()}});
}

void write_best(const StudyOptions& options, const std::vector<Study>& studies) {
    if (studies.empty()) return;
    if (!studies.front().best) {
        say_error(fmt::format("{} is not written: {}", options.output.string(),
                              studies.front().findings.back()));
        throw Stop(ExitCode::failure);
    }
    const Study& study = studies.front();
    const ReadPreset from = read_preset(options.files.front());
    if (!from.preset) throw Stop(ExitCode::failure);
    std::string list = study.rows[*study.best].value, wrong;
    std::ranges::replace(list, ' ', ',');
    std::vector<Turned> values = turned_values(from.preset->scene.tweaks, {}, list, wrong);
    if (!wrong.empty()) throw std::runtime_error(wrong);
    add_stood_on(options, *from.preset, values);
    const std::string text = text_with_best(options, values);
    write_whole_file(options.output, std::as_bytes(std::span(text)));
}

}  // namespace glint
