// `glint bench`: milliseconds a frame and a pass.
#include "measure/bench.h"

#include "measure/compile_bench.h"
#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, BenchOptions& bench) {
    add_view(verb, bench.view);
    verb.add_option("--frames", bench.frames, "how many frames are timed")
        ->check(from(1, 1'000'000));
    CLI::Option* compare =
        verb.add_flag("--compare", bench.compare, "time uniform-fed frames in turn as well");
    verb.add_flag(
            "--compile", bench.compile,
            "time the driver's compiler instead, pass by pass, with its cache empty and full; "
            "160x90 otherwise")
        ->excludes(compare);
    verb.add_option("--compile-cache", bench.compile_cache)->group("");  // for itself alone
    verb.add_flag("--compile-together", bench.compile_together)->group("");
    add_examples(verb, {"glint bench presets/magic.toml --size 640x360",
                        "glint bench presets/magic.toml --size 640x360 --compare",
                        "glint bench presets/boat.toml --compile"});
}

}  // namespace

std::unique_ptr<Verb> bench_verb() {
    return make_verb<BenchOptions>(declare, [](const BenchOptions& options, const Stopwatch&) {
        if (!options.compile_cache.empty()) return run_compile_once(options);
        options.compile ? run_compile_bench(options) : run_bench(options);
    });
}

}  // namespace glint
