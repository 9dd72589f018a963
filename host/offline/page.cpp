#include "offline/page.h"

#include "base/json_text.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "gl/context.h"
#include "offline/common.h"
#include "offline/named_files.h"
#include "offline/page_plan.h"
#include "offline/page_text.h"

#include <fmt/format.h>

namespace glint {
namespace {

void replace_all(std::string& text, std::string_view what, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
}

std::string in_html(std::string text) {
    replace_all(text, "&", "&amp;");
    replace_all(text, "<", "&lt;");
    return text;
}

// Takes a module out of the script, which stands between /*NAME*/ and /*end*/.
void leave_out(std::string& page, std::string_view module) {
    const std::size_t begin = page.find(fmt::format("/*{}*/", module));
    page.erase(begin, page.find("/*end*/", begin) - begin);
}

}  // namespace

bool is_page(const std::filesystem::path& output) {
    return output.extension() == ".html" || output.extension() == ".htm";
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
    if (!options.controls) plan["bare"] = true;
    std::string json = json_text(plan, -1);
    replace_all(json, "</", "<\\/");  // which would end the script
    std::string page(page_text());
    if (!sound) leave_out(page, "sound");
    if (json.find("\"source\":\"sound\"") == json.npos) leave_out(page, "analyser");
    replace_all(page, "<!--TITLE-->", in_html(plan["title"].get<std::string>()));
    page.replace(page.find("/*PLAN*/"), 8, json);
    write_whole_file(options.output, std::as_bytes(std::span(page)));
    say_result("{}\n", options.output.string());
}

}  // namespace glint
