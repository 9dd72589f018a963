// `glint still`: one frame to a picture file.
#include "offline/still.h"

#include "measure/probe/cut_loops.h"
#include "measure/probe/run.h"
#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, StillOptions& still) {
    add_picture(verb, still);
    verb.add_option("-o,--output", still.output, "a .png, .exr, .jpg, .tif or .hdr file")
        ->type_name(kFile)
        ->required();
    verb.add_option("--time", still.time, "s; the preset's otherwise")->check(from(0.0, 1e9));
    verb.add_option("--frame", still.frame, "instead of --time")->check(from(0, 1 << 30));
    verb.add_option("--settle", still.settle, "more frames with time held still")
        ->check(from(0, 1'000'000));
    verb.add_option("--pass", still.pass, "write this buffer instead of the picture")
        ->type_name(kPass);
    verb.add_option(
            "--tile", still.tile,
            "draw in tiles of at most so many pixels a side; huge pictures do so by themselves")
        ->check(from(1, 16384));
    add_examples(verb,
                 {"glint still presets/christmas.toml -o wall.png --size 3840x2160 --samples 16",
                  "glint still presets/christmas.toml -o x.png --tweak ornaments=256 --tweak "
                  "snow=1 --time 3",
                  "glint still presets/water.toml -o pond.exr --pass pond --frame 240"});
}

}  // namespace

std::unique_ptr<Verb> still_verb() {
    return make_verb<StillOptions>(declare,
                                   [](const StillOptions& options, const Stopwatch& since_start) {
                                       Preset drawn = run_still(options, since_start);
                                       const ProbeOptions frame{.view = options.view,
                                                                .time = options.time,
                                                                .frame = options.frame,
                                                                .settle = options.settle,
                                                                .fps = options.fps};
                                       say_cut_loops(drawn, frame);
                                       say_broken_assertions(std::move(drawn), frame);
                                   });
}

}  // namespace glint
