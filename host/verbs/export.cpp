// `glint export`: a scene to the tabs of a Shadertoy, or to a web page.
#include "offline/export.h"

#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, ExportOptions& options) {
    add_view(verb, options.view, false);
    verb.add_option("-o,--output", options.output,
                    "a folder for the tabs, or a .html file for a page that draws by itself")
        ->type_name(kFile)
        ->required();
    add_off_switch(verb, "--no-controls", options.controls, "a page with the picture alone");
    add_examples(verb, {"glint export presets/magic.toml -o tabs",
                        "glint export presets/boat.toml -o boat.html"});
}

}  // namespace

std::unique_ptr<Verb> export_verb() {
    return make_verb<ExportOptions>(
        declare, [](const ExportOptions& options, const Stopwatch&) { run_export(options); });
}

}  // namespace glint
