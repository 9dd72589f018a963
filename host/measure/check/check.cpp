#include "measure/check/check.h"

#include "base/canonical_name.h"
#include "base/hash.h"
#include "base/json_text.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "glsl/raw_text.h"
#include "measure/check/case.h"
#include "measure/check/junit.h"
#include "offline/examples.h"
#include "offline/named_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

std::size_t count(const CheckedFile& file, CaseVerdict verdict) {
    return static_cast<std::size_t>(std::ranges::count(file.cases, verdict, &CaseResult::verdict));
}

void print_table(const CheckedFile& file) {
    std::size_t widest = 0;
    for (const CaseResult& result : file.cases) widest = std::max(widest, result.name.size());
    for (const CaseResult& result : file.cases) {
        say_result("{:<6}  {:<{}}  {}\n", to_string(result.verdict), result.name,
                   std::min<std::size_t>(widest, 40), result.note);
        if (!result.picture.empty()) say_result("        picture: {}\n", result.picture);
        if (!result.diagram.empty()) say_result("        curves: {}\n", result.diagram);
        if (!result.reproduce.empty()) say_result("        again: {}\n", result.reproduce);
    }
    const std::size_t skipped = count(file, CaseVerdict::skip);
    say_result("{}: {} of {} cases failed{}, {:.0f} s, {}\n", file.scene,
               count(file, CaseVerdict::fail), file.cases.size(),
               skipped > 0 ? fmt::format(", {} left out", skipped) : "", file.seconds,
               file.renderer);
}

Json to_json(const CheckedFile& file, const CaseResult& result) {
    Json json = {{"scene", file.scene}};
    json.update(glint::to_json(result));
    return json;
}

// How far a file has come, on stdout; cases that were told of before are not told again.
void print_lines(const CheckedFile& file, long total, std::size_t& told) {
    for (; told < file.cases.size(); ++told) {
        const Json line = {{"done", told + 1},
                           {"of", total},
                           {"renderer", file.renderer},
                           {"case", to_json(file, file.cases[told])}};
        say_result("{}\n", json_text(line, -1));
    }
    flush_results();
}

Json to_json(const std::vector<CheckedFile>& files) {
    Json cases = Json::array(), list = Json::array();
    std::size_t failed = 0;
    std::string renderer;
    for (const CheckedFile& file : files) {
        failed += count(file, CaseVerdict::fail);
        if (renderer.empty()) renderer = file.renderer;
        list.push_back({{"scene", file.scene},
                        {"code", static_cast<int>(file.code)},
                        {"cases", file.cases.size()},
                        {"failed", count(file, CaseVerdict::fail)},
                        {"seconds", file.seconds}});
        for (const CaseResult& result : file.cases) cases.push_back(to_json(file, result));
    }
    return {{"renderer", renderer}, {"failed", failed}, {"files", list}, {"cases", cases}};
}

ExitCode exit_code(const std::vector<CheckedFile>& files) {
    ExitCode code = ExitCode::done;
    for (const CheckedFile& file : files) {
        if (file.code != ExitCode::done) return file.code;
        if (count(file, CaseVerdict::fail) > 0) code = ExitCode::check_failed;
    }
    return code;
}

// The scene file of a preset; of what cannot be read, nothing.
std::filesystem::path scene_file(const std::filesystem::path& file) {
    const ReadPreset read = read_preset(file);
    std::error_code ignored;
    return read.preset ? std::filesystem::canonical(read.preset->scene.files.front(), ignored)
                       : std::filesystem::path();
}

void require_cases(const std::vector<CheckedFile>& files, const std::string& only) {
    for (const CheckedFile& file : files) {
        if (file.code != ExitCode::done || !file.cases.empty()) continue;
        throw UsageError(
            fmt::format("--case '{}': {} has no case whose name begins so; without "
                        "--case all are listed.",
                        only, file.scene));
    }
}

// Pictures of failures would take the place of what was expected, and the next call find no fault.
void require_expected_apart(const Preset& preset, const std::filesystem::path& folder) {
    const std::filesystem::path picture = canonical_name(preset.expect.picture);
    if (preset.expect.picture.empty() || picture.parent_path() != canonical_name(folder) ||
        !picture.filename().string().starts_with(case_stem(preset, "")))
        return;
    throw UsageError(
        fmt::format("The picture that {} expects, {}, has a name that pictures of failures have; "
                    "keep it in another folder, or name one for these by -o.",
                    preset.file.string(), preset.expect.picture.string()));
}

// Where pictures of failures go, whose names begin as the file's does: files of one name in two
// places, or a scene and its preset, keep theirs apart.
std::filesystem::path picture_folder(const CheckOptions& options,
                                     const std::filesystem::path& file) {
    const std::filesystem::path own = canonical_name(file);
    const bool is_shared = std::ranges::any_of(options.files, [&](const auto& other) {
        return other.stem() == file.stem() && canonical_name(other) != own;
    });
    if (!is_shared) return options.output;
    Hash hash;
    hash.add(own.string());
    return options.output /
           fmt::format("{}-{}", file.filename().string(), hash.text().substr(0, 8));
}

// Before any work: what would be written in the place of something that is read, or cannot be.
void require_outputs(const CheckOptions& options) {
    const NamedFile report{"--junit", options.junit.string()};
    for (const std::filesystem::path& name : options.files) {
        const ReadPreset read = read_preset(name);
        if (!read.preset) continue;
        require_apart({report}, files_read_for(*read.preset));
        require_apart({report}, files_expected(*read.preset));
        require_expected_apart(*read.preset, picture_folder(options, name));
    }
    require_folder(options.output);
    if (options.junit.empty()) return;
    std::string why_not;
    std::error_code unknown;
    const auto there = std::filesystem::is_regular_file(options.junit, unknown)
                           ? read_bytes(options.junit, why_not)
                           : std::nullopt;
    if (there && !there->empty() && !there->starts_with("<?xml"))
        throw UsageError(
            fmt::format("--junit {} would replace a file that is no report; name another.",
                        options.junit.string()));
    require_writable(options.junit);
}

}  // namespace

void run_check(const CheckOptions& options) {
    require_outputs(options);
    std::vector<CheckedFile> files;
    std::set<std::filesystem::path> scenes;
    for (const std::filesystem::path& name : options.files) {
        FileCheck wanted{.view = options.view,
                         .effort = options.effort,
                         .folder = picture_folder(options, name),
                         .only = options.only,
                         .scene_is_known = !scenes.insert(scene_file(name)).second,
                         .hang_seconds = options.hang_seconds};
        wanted.view.file = name;
        if (options.effort.tries) wanted.effort.seconds = 0.0;
        std::unique_ptr<Progress> bar;
        std::size_t told = 0;
        files.push_back(check_file(wanted, [&](const CheckedFile& so_far, long total) {
            if (!bar)
                bar = std::make_unique<Progress>("checking " + name.filename().string(), total);
            bar->update(static_cast<long>(so_far.cases.size()));
            if (options.lines) print_lines(so_far, total, told);
        }));
        bar.reset();
        std::ranges::stable_sort(files.back().cases, is_worse);
        const bool table = !options.view.json && !options.lines;
        if (table && files.back().code == ExitCode::done) print_table(files.back());
    }
    if (!options.junit.empty()) {
        const std::string xml = junit_xml(files);
        write_whole_file(options.junit, std::as_bytes(std::span(xml)));
    }
    if (!options.only.empty()) require_cases(files, options.only);
    if (options.view.json) say_result("{}\n", json_text(to_json(files)));
    const ExitCode code = exit_code(files);
    flush_results();  // the table first
    if (code == ExitCode::check_failed && !options.view.json && !options.lines)
        say("What each case means, and how to mend it: {}\n",
            documentation("checking.md").string());
    if (code != ExitCode::done) throw Stop(code);
}

}  // namespace glint
