// `glint bench`: milliseconds a frame and a pass.
#include "measure/bench.h"

#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, BenchOptions& bench) {
    add_view(verb, bench.view);
    verb.add_option("--frames", bench.frames, "how many frames are timed")
        ->check(from(1, 1'000'000));
    verb.add_flag("--compare", bench.compare, "time uniform-fed frames in turn as well");
    add_examples(verb, {"glint bench presets/magic.toml --size 640x360",
                        "glint bench presets/magic.toml --size 640x360 --compare"});
}

}  // namespace

std::unique_ptr<Verb> bench_verb() {
    return std::make_unique<VerbWith<BenchOptions>>(
        declare, [](const BenchOptions& options, const Stopwatch&) { run_bench(options); });
}

}  // namespace glint
