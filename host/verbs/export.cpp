// `glint export`: a scene to the tabs of a Shadertoy.
#include "offline/export.h"

#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, ExportOptions& options) {
    add_view(verb, options.view, false);
    verb.add_option("-o,--output", options.output, "a folder")->type_name(kFolder)->required();
    add_examples(verb, {"glint export presets/magic.toml -o tabs"});
}

}  // namespace

std::unique_ptr<Verb> export_verb() {
    return make_verb<ExportOptions>(
        declare, [](const ExportOptions& options, const Stopwatch&) { run_export(options); });
}

}  // namespace glint
