#include "offline/page.h"

#include "base/canonical_name.h"
#include "base/json_text.h"
#include "base/markup.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "base/words.h"
#include "gl/context.h"
#include "offline/common.h"
#include "offline/named_files.h"
#include "offline/page_controls.h"
#include "offline/page_plan.h"
#include "offline/page_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace glint {
namespace {

// The page with texts in place of its marks; what looks like a mark within these is only text.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& texts) {
    std::string result;
    while (!page.empty()) {
        std::size_t first = page.size();
        std::string_view mark;
        for (const auto& [candidate, text] : texts) {
            const std::size_t at = page.find(candidate);
            if (at >= first) continue;
            first = at;
            mark = candidate;
        }
        result += page.substr(0, first);
        if (!mark.empty()) result += texts.at(mark);
        page.remove_prefix(first + mark.size());
    }
    return result;
}

// Takes a module out of the script: it stands from its mark to the next one.
void leave_out(std::string& page, const std::string& module) {
    const std::size_t begin = page.find("//! " + module + "\n");
    page.erase(begin, page.find("//! ", begin + 1) - begin);
}

// The modules that only some scenes need.
void leave_out_unneeded(std::string& page, const nlohmann::ordered_json& plan) {
    const auto reads = [&](const char* source) {
        return std::ranges::any_of(plan["inputs"],
                                   [&](const auto& input) { return input["source"] == source; });
    };
    const auto has = [&](const char* key) {
        const auto any = [&](const auto& passes) {
            return std::ranges::any_of(passes,
                                       [&](const auto& pass) { return pass.contains(key); });
        };
        return any(plan["passes"]) || (plan.contains("sound") && any(plan["sound"]));
    };
    if (!plan.contains("sound")) leave_out(page, "sound");
    if (!reads("sound")) leave_out(page, "rows");
    if (!reads("noise")) leave_out(page, "noise");
    if (!has("step")) leave_out(page, "steps");
    if (!has("channels")) leave_out(page, "channels");
    for (std::size_t at = 0; (at = page.find("//! ", at)) != page.npos;)
        page.erase(at, page.find('\n', at) + 1 - at);
}

// Whose fingers do not scroll the page.
bool reads_mouse(const CompiledScene& scene) {
    return std::ranges::any_of(scene.programs, [](const PassProgram& program) {
        return std::ranges::any_of(program.builtins, [](const BuiltinUniform& uniform) {
            return is_of_mouse(uniform.builtin);
        });
    });
}

// What the style sheet asks of the page's body.
std::string body_classes(const Preset& preset, bool has_controls, bool reads_mouse) {
    std::string classes;
    if (reads_mouse) classes += " mouse";
    if (!has_controls) classes += " bare";
    if (!preset.scene.has_sound) classes += " quiet";
    if (preset.scene.tweaks.empty()) classes += " plain narrow";
    return classes;
}

}  // namespace

bool is_page(const std::filesystem::path& output) {
    const std::string ending = ending_of(output);
    return ending == ".html" || ending == ".htm";
}

void write_page(const ExportOptions& options) {
    const Preset preset = open_preset(options.view);
    require_apart({{{"-o", options.output.string()}}}, files_read_for(preset));
    const auto context = make_egl_context(options.view.device);
    const CompileOptions compile{.program = {.specialise = false}};
    const CompiledScene scene = compile_or_stop(preset, compile);
    std::optional<CompiledScene> sound;
    if (preset.scene.has_sound)
        sound = compile_or_stop(preset, {.root = kSoundPass, .program = compile.program});
    nlohmann::ordered_json plan = page_plan(preset, scene, sound ? &*sound : nullptr);
    if (!options.view.size.empty()) plan["fixed"] = true;
    std::string page(page_text());
    leave_out_unneeded(page, plan);
    std::string json = json_text(plan, -1);
    replace_all(json, "</", "<\\/");      // which would end the script,
    replace_all(json, "<!", "\\u003c!");  // and this, before "<script", would keep it from ending
    const std::string classes = body_classes(preset, options.controls, reads_mouse(scene));
    page =
        filled(page, {{"<!--TITLE-->", markup_escaped(plan["title"].get<std::string>())},
                      {"<!--CLASSES-->", classes},
                      {"<!--SHAPE-->", fmt::format("--w:{};--h:{}", preset.size.x, preset.size.y)},
                      {"<!--CONTROLS-->", page_controls(preset)},
                      {"/*PLAN*/", json}});
    write_whole_file(options.output, std::as_bytes(std::span(page)));
    say_result("{}\n", options.output.string());
}

}  // namespace glint
