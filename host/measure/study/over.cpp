#include "measure/study/over.h"

#include "base/say.h"
#include "base/terminal.h"
#include "base/words.h"
#include "measure/study/values.h"
#include "offline/common.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr int kMostViews = 100;

std::vector<fs::path> presets_near(const Preset& preset) {
    std::vector<fs::path> folders = {preset.file.parent_path()};
    if (!is_preset(preset.file))
        folders.push_back(preset.file.parent_path().parent_path() / "presets");
    std::vector<fs::path> files;
    for (const fs::path& folder : folders) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, none))
            if (is_preset(entry.path())) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

std::vector<View> presets_of(const Preset& preset, const StudyOptions& options) {
    std::vector<View> views;
    for (const fs::path& file : presets_near(preset)) {
        ReadPreset read = read_preset(file);
        std::error_code none;
        if (!read.preset)
            say_warning(fmt::format(
                "{} is left out: {}", file.string(),
                read.diagnostics.empty() ? "it cannot be read" : read.diagnostics.front().text));
        if (!read.preset ||
            !fs::equivalent(read.preset->scene.files.front(), preset.scene.files.front(), none))
            continue;
        if (!fs::equivalent(file, preset.file, none)) report(read.diagnostics);
        read.preset->size = preset.size;
        ViewOptions laid = options.view;
        laid.size.clear();
        laid.quality.clear();
        lay_over(*read.preset, laid);
        views.push_back({file.stem().string(), std::move(*read.preset)});
    }
    if (views.empty())
        throw UsageError(fmt::format("--over presets: there is no preset of {} beside it.",
                                     preset.scene.files.front().string()));
    return views;
}

std::vector<View> times_of(const Preset& preset, const std::string& range) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at <= range.size();) {
        const std::size_t colon = std::min(range.find(':', at), range.size());
        numbers.push_back(parse_number(range.substr(at, colon - at)).value_or(-1.0));
        at = colon + 1;
    }
    const bool is_range = numbers.size() == 3 && std::ranges::min(numbers) >= 0.0 &&
                          numbers[2] > 0.0 && numbers[1] >= numbers[0];
    // The last is not lost to what a division rounds.
    const double count =
        is_range ? std::floor((numbers[1] - numbers[0]) / numbers[2] * (1.0 + 1e-9)) + 1.0 : 0.0;
    if (!is_range || count > kMostViews)
        throw UsageError(fmt::format(
            "--over time={}: write time=A:B:STEP, seconds from A to B, at most {} of them.", range,
            kMostViews));
    std::vector<View> views;
    for (int i = 0; i < static_cast<int>(count); ++i) {
        View& view = views.emplace_back(View{.name = {}, .preset = preset});
        view.preset.time = to_twelve_digits(numbers[0] + i * numbers[2]);
        view.name = fmt::format("time {}", format_number(view.preset.time));
    }
    return views;
}

// The look of the view, with all that the setting turns, and the quality of the base.
KnobValue value_in(const View& view, const Preset& base, const std::string& knob, KnobValue value) {
    for (std::size_t i = 0; i < value.setting.values.size(); ++i) {
        const Tweak& tweak = base.scene.tweaks[i];
        const bool turned = tweak.quality || tweak.name == knob ||
                            value.setting.values[i] != base.values[i] ||
                            std::ranges::count(value.named, i) > 0;
        if (!turned) value.setting.values[i] = view.preset.values[i];
    }
    if (knob != "settle" && value.setting.settle == base.settle)
        value.setting.settle = view.preset.settle;
    return value;
}

// A mean of squares for what adds up so; 8-bit errors are such squares, too.
Difference mean_of(const std::vector<const Difference*>& all) {
    Difference mean;
    double squares = 0.0, byte_squares = 0.0;
    const auto count = static_cast<double>(all.size());
    for (const Difference* one : all) {
        squares += one->rmse * one->rmse / count;
        byte_squares += std::pow(10.0, -one->psnr / 10.0) / count;
        mean.max = std::max(mean.max, one->max);
        mean.relative_mse += one->relative_mse / count;
        mean.share_off += one->share_off / count;
        mean.flip += one->flip / count;
        mean.not_finite += one->not_finite;
        mean.reference_not_finite += one->reference_not_finite;
    }
    mean.rmse = std::sqrt(squares);
    mean.psnr = byte_squares > 0.0 ? -10.0 * std::log10(byte_squares)
                                   : std::numeric_limits<double>::infinity();
    return mean;
}

void add_times(std::vector<double>& sum, const std::vector<double>& times, double share) {
    sum.resize(std::min(sum.size(), times.size()));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * times[i];
}

// Whether a row is farther off than in the worst view so far. Where it is no number in any pixel it
// is so only if there is no other.
bool is_worse(double rmse, const std::optional<WorstView>& worst) {
    if (!worst) return true;
    return std::isnan(worst->rmse) ? !std::isnan(rmse) : rmse > worst->rmse;
}

StudyRow row_over(const std::vector<View>& views, const std::vector<Study>& studies,
                  std::size_t index) {
    StudyRow row = studies.front().rows[index];
    const double share = 1.0 / static_cast<double>(studies.size());
    const std::size_t rounds = row.times.wall.size();
    row.times = {.wall = std::vector<double>(rounds, 0.0),
                 .gpu = std::vector<double>(rounds, 0.0),
                 .processor = std::vector<double>(rounds, 0.0)};
    row.all_passes_ms = 0.0;
    row.failed.clear();
    std::vector<const Difference*> errors;
    for (double& apart : row.apart) apart = 0.0;
    for (std::size_t v = 0; v < studies.size(); ++v) {
        const StudyRow& one = studies[v].rows[index];
        add_times(row.times.wall, one.times.wall, share);
        add_times(row.times.gpu, one.times.gpu, share);
        add_times(row.times.processor, one.times.processor, share);
        row.all_passes_ms += share * one.all_passes_ms;
        row.is_reference &= one.is_reference;
        row.resumed &= one.resumed;
        row.apart.resize(std::min(row.apart.size(), one.apart.size()));
        for (std::size_t k = 0; k < row.apart.size(); ++k)
            row.apart[k] = std::hypot(row.apart[k], std::sqrt(share) * one.apart[k]);
        if (!one.failed.empty() && row.failed.empty())
            row.failed = fmt::format("{}: {}", views[v].name, one.failed);
        if (!one.error) continue;
        errors.push_back(&*one.error);
        if (!is_worse(one.error->rmse, row.worst)) continue;
        row.worst = {.view = views[v].name, .rmse = one.error->rmse};
        row.picture = one.picture;
        row.map = one.map;
        row.flip_map = one.flip_map;
    }
    row.error.reset();
    if (!errors.empty()) row.error = mean_of(errors);
    return row;
}

}  // namespace

std::vector<View> views_over(const Preset& preset, const StudyOptions& options) {
    if (options.over.empty()) return {};
    if (options.over == "presets") return presets_of(preset, options);
    if (options.over.starts_with("time=")) return times_of(preset, options.over.substr(5));
    throw UsageError(fmt::format("--over {}: write presets, or time=A:B:STEP.", options.over));
}

Knob knob_in(const View& view, const Preset& base, const Knob& knob) {
    Knob turned = knob;
    const auto turn = [&](KnobValue& value) {
        value = value_in(view, base, knob.name, std::move(value));
    };
    for (KnobValue& value : turned.values) turn(value);
    turn(turned.reference);
    if (turned.second) turn(*turned.second);
    if (turned.more) turn(*turned.more);
    if (turned.rival) turn(turned.rival->value);
    if (turned.rival && turned.rival->second) turn(*turned.rival->second);
    if (turned.rival && turned.rival->more) turn(*turned.rival->more);
    if (turned.rival && turned.rival->less) turn(*turned.rival->less);
    return turned;
}

Study over_all(const std::vector<View>& views, const std::vector<Study>& studies) {
    Study all = studies.front();
    std::vector<const Difference*> seconds, rivals;
    double claims = 0.0;
    all.reference_not_finite = 0;
    for (std::size_t v = 0; v < studies.size(); ++v) {
        const Study& study = studies[v];
        if (!study.has_truth() && all.broken_view.empty()) all.broken_view = views[v].name;
        all.look = std::max(all.look, study.look);
        all.reference_not_finite += study.reference_not_finite;
        if (all.reference_cut.empty()) all.reference_cut = study.reference_cut;
        if (all.second_cut.empty()) all.second_cut = study.second_cut;
        if (study.reference_error) seconds.push_back(&*study.reference_error);
        if (!study.rival) continue;
        rivals.push_back(&study.rival->difference);
        if (all.rival->cut.empty()) all.rival->cut = study.rival->cut;
        claims += std::pow(study.rival->own_error, 2.0) / static_cast<double>(studies.size());
    }
    if (!seconds.empty()) all.reference_error = mean_of(seconds);
    if (!rivals.empty()) all.rival->difference = mean_of(rivals);
    if (!rivals.empty()) all.rival->own_error = std::sqrt(claims);
    for (std::size_t i = 0; i < all.rows.size(); ++i) all.rows[i] = row_over(views, studies, i);
    for (const View& view : views) all.views.push_back(view.name);
    return all;
}

}  // namespace glint
