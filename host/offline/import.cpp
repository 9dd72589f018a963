#include "offline/import.h"

#include "base/canonical_name.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "base/terminal.h"
#include "offline/common.h"
#include "scene/scene.h"
#include "scene/shadertoy.h"

#include <fmt/format.h>

namespace glint {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& input) {
    std::error_code error;
    return fs::is_directory(input, error);
}

std::vector<Shadertoy> read(const ImportOptions& options, Diagnostics& diagnostics) {
    if (!is_folder(options.input)) return read_shadertoys(options.input, diagnostics);
    auto shader = read_shadertoy_folder(options.input, diagnostics, options.anywhere);
    return shader ? std::vector{std::move(*shader)} : std::vector<Shadertoy>();
}

// out.frag, out-2.frag, …
fs::path numbered(const fs::path& output, std::size_t index) {
    if (index == 0) return output;
    return output.parent_path() /
           fmt::format("{}-{}{}", output.stem().string(), index + 1, output.extension().string());
}

void remove_all(const std::vector<fs::path>& files) {
    std::error_code error;
    for (const fs::path& file : files) fs::remove(file, error);
}

// None stays of those that this began, where one cannot be written.
void write_all_or_none(const std::vector<fs::path>& names, const std::vector<std::string>& texts) {
    std::vector<fs::path> written;
    try {
        for (std::size_t i = 0; i < names.size(); ++i) {
            write_whole_file(names[i], std::as_bytes(std::span(texts[i])));
            written.push_back(names[i]);
        }
    } catch (...) {
        remove_all(written);
        throw;
    }
}

// Takes back what has been written where it names anything outside the folder.
void confine(std::vector<fs::path>& scenes, const ImportOptions& options,
             Diagnostics& diagnostics) {
    const fs::path folder = is_folder(options.input) ? options.input : options.input.parent_path();
    std::vector<fs::path> outside;
    for (const fs::path& scene : scenes) {
        // What a scene reads in the end counts: the code may name files, too.
        for (const fs::path& file : files_outside(read_scene(scene), folder))
            if (file != scene) outside.push_back(file);
    }
    if (outside.empty()) return;
    diagnostics.push_back(
        {Severity::error,
         {options.input.string()},
         fmt::format("its code names {}, which is outside its folder; --anywhere imports it",
                     in_quotes(outside.front().string())),
         true});
    remove_all(scenes);
    scenes.clear();
}

}  // namespace

std::vector<fs::path> import_shadertoys(const ImportOptions& options, Diagnostics& diagnostics) {
    if (ending_of(options.output) != ".frag") {
        throw UsageError(fmt::format("A scene file ends with .frag; name one behind -o, such as {}",
                                     fs::path(options.output).replace_extension(".frag").string()));
    }
    const std::vector<Shadertoy> shaders = read(options, diagnostics);
    // Files beside it are read: of a folder those in it.
    const fs::path from = is_folder(options.input) ? options.input / "" : options.input;
    std::vector<fs::path> names;
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < shaders.size(); ++i) {
        names.push_back(numbered(options.output, i));
        texts.push_back(scene_text(shaders[i], from, options.output.parent_path(), diagnostics,
                                   options.anywhere));
    }
    if (has_errors(diagnostics)) return {};
    for (const fs::path& name : names) {
        if (is_taken(name))
            throw cannot_write(name,
                               "it is there already, and somebody may have worked on it; "
                               "name another file, or move it away");
    }
    write_all_or_none(names, texts);
    if (!options.anywhere) confine(names, options, diagnostics);
    return names;
}

bool is_shadertoy(const fs::path& file) {
    std::error_code error;
    return ending_of(file) == ".json" ||
           (fs::is_directory(file, error) && is_shadertoy_folder(file));
}

ImportedBeside import_beside(const fs::path& input) {
    const fs::path scene = fs::path(input).replace_extension(".frag");
    const std::string name = scene.filename().string();
    if (is_taken(scene)) return {scene, fmt::format("{} was there already", name)};
    Diagnostics diagnostics;
    try {
        import_shadertoys({.input = input, .output = scene}, diagnostics);
    } catch (const std::exception& problem) {
        return {{}, problem.what()};
    }
    for (const Diagnostic& diagnostic : diagnostics) say_diagnostic(diagnostic);
    if (has_errors(diagnostics)) return {{}, diagnostics.front().text};
    if (diagnostics.empty()) return {scene, fmt::format("{} written", name)};
    return {scene, fmt::format("{}: {}", name, diagnostics.front().text)};
}

void run_import(const ImportOptions& options) {
    Diagnostics diagnostics;
    const auto names = import_shadertoys(options, diagnostics);
    report(diagnostics);
    for (const fs::path& name : names) say_result("{}\n", name.string());
}

}  // namespace glint
