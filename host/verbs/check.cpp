// `glint check`: numerical stability at every extreme.
#include "measure/check/check.h"

#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, CheckOptions& check) {
    add_views(verb, check.files, check.view, "pixels of most cases; 96x54 otherwise");
    verb.add_option("--inject", check.effort.inject, "texels of a buffer poisoned at once; 0: none")
        ->check(from(0, 10'000));
    verb.add_option("--frames", check.effort.frames, "of the long run; 2000 otherwise")
        ->check(from(1, 10'000'000));
    verb.add_option("--random", check.effort.random, "sets of random tweaks")
        ->check(from(0, 1'000'000));
    CLI::Option* seconds =
        verb.add_option("--seconds", check.effort.seconds,
                        "that one file's cases may take, 110 otherwise; 0: no limit")
            ->check(from(0.0, 1e6));
    verb.add_option("--effort", check.effort.tries,
                    "how far to search, 1 or more, whatever the clock says")
        ->check(from(1, 10'000))
        ->excludes(seconds);
    verb.add_option("--case", check.only, "only cases whose name begins so");
    verb.add_option("--hang", check.hang_seconds,
                    "s that one frame may take; less where --seconds are nearly over")
        ->check(from(1.0, 1e5));
    verb.add_option("-o,--output", check.output,
                    "a folder for the pictures of failures; glint-check otherwise")
        ->type_name(kFolder);
    verb.add_option("--junit", check.junit, "a file for the cases as JUnit XML")->type_name(kFile);
    CLI::Option* json = verb.add_flag("--json", check.view.json, "one JSON object on stdout");
    verb.add_flag("--lines", check.lines, "a JSON object a line, whenever a case ends")
        ->excludes(json);
    add_examples(verb, {"glint check fragments/water.frag",
                        "glint check fragments/*.frag presets/*.toml --seconds 20 -o failures",
                        "glint check presets/boat.toml --junit check.xml"});
}

}  // namespace

std::unique_ptr<Verb> check_verb() {
    return make_verb<CheckOptions>(
        declare, [](const CheckOptions& options, const Stopwatch&) { run_check(options); });
}

}  // namespace glint
