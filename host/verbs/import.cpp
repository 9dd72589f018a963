// `glint import`: from the site's files to scene files.
#include "offline/import.h"

#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, ImportOptions& import) {
    verb.add_option("input", import.input, "a .json file, or a folder of tabs")
        ->type_name(kFile)
        ->required();
    verb.add_option("-o,--output", import.output, "a .frag file")->type_name(kFile)->required();
    verb.add_flag("--anywhere", import.anywhere,
                  "let it name files outside its folder, such as ../wood.png");
    add_examples(verb,
                 {"glint import shader.json -o shader.frag", "glint import tabs -o shader.frag"});
}

}  // namespace

std::unique_ptr<Verb> import_verb() {
    return make_verb<ImportOptions>(
        declare, [](const ImportOptions& options, const Stopwatch&) { run_import(options); });
}

}  // namespace glint
