// `glint probe`: any value of the shader, at a pixel.
#include "measure/probe/run.h"
#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, ProbeOptions& probe) {
    add_view(verb, probe.view);
    verb.add_option("--at", probe.at,
                    "X,Y of the pixel, from 0,0 at the bottom left as fragCoord counts; the middle "
                    "otherwise");
    verb.add_option("--pass", probe.pass, "of this buffer instead of the picture")
        ->type_name(kPass);
    verb.add_option("--face", probe.face, "of a cube: 0 to 5, +X -X +Y -Y +Z -Z")
        ->check(from(0, 5));
    verb.add_option("--time", probe.time, "s; the preset's otherwise")->check(from(0.0, 1e9));
    verb.add_option("--frame", probe.frame, "instead of --time")->check(from(0, 1 << 30));
    verb.add_option("--settle", probe.settle, "more frames with time held still")
        ->check(from(0, 1'000'000));
    verb.add_option("--fps", probe.fps, "Hz; frame k stands at k / fps")->check(from(0.01, 1e5));
    verb.add_option("--line", probe.line,
                    "this line's values in the order in which they came; of an included file, "
                    "FILE:LINE");
    verb.add_option("--hit", probe.hit, "of these values the N-th alone, from 1")
        ->check(from(1, 1 << 30));
    verb.add_option("--expr", probe.expression,
                    "any expression that is valid behind a line, as in 'dot(nor, rd)@412'");
    verb.add_option("--along", probe.along,
                    "the value along the pixel's row (x) or column (y), or over frames (time)")
        ->check(one_of({"x", "y", "time"}));
    verb.add_option("--frames", probe.frames, "of --along time: A:B or A:B:STEP; 0:59 otherwise");
    verb.add_option("--map", probe.map,
                    "the value at every pixel, to a .exr, .tif or .hdr file as it is, to a .png or "
                    ".jpg from its smallest to its largest");
    verb.add_flag("--cost", probe.cost,
                  "turns of loops, reads of textures and calls instead: of a pixel, of the dearest "
                  "lines, and with --map as a picture");
    verb.add_flag("--faults", probe.faults,
                  "where the first NaN, Inf, division by zero, root of a negative number or index "
                  "out of range is born, in any pass; of a simulation in any frame up to this one");
    add_examples(verb, {"glint probe presets/magic.toml --at 320,180 --size 640x360",
                        "glint probe presets/water.toml --pass pond --frame 60 --at 40,40 --size "
                        "320x180",
                        "glint probe presets/analytic.toml --cost --map heat.png --size 320x180",
                        "glint probe presets/boat.toml --faults --size 64x36"});
}

}  // namespace

std::unique_ptr<Verb> probe_verb() {
    return make_verb<ProbeOptions>(
        declare, [](const ProbeOptions& options, const Stopwatch&) { run_probe(options); });
}

}  // namespace glint
