// `glint sequence`: frames to pictures, a film, or another program.
#include "offline/sequence.h"

#include "measure/probe/cut_loops.h"
#include "media/film.h"
#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, SequenceOptions& sequence) {
    add_picture(verb, sequence);
    verb.add_option(
            "-o,--output", sequence.output,
            "out.%04d.png (or .exr, .jpg, .tif, .hdr), out.mp4 (or .webm, .mov, .gif), or -; "
            "may be left out with --save-state or --from-pictures")
        ->type_name(kFile);
    verb.add_option("--frames", sequence.frames,
                    "FIRST:LAST or FIRST:LAST:STEP; the first ten seconds otherwise")
        ->type_name("FRAMES");
    verb.add_option("--shard", sequence.shard, "K/N: only the K-th of N shares of the pictures")
        ->type_name("SHARE");
    verb.add_flag("--resume", sequence.resume,
                  "leave pictures alone that are there and are what would be written");
    verb.add_option("--from-pictures", sequence.from_pictures,
                    "frames/%06d.png that others have drawn: check them, and make the film of them")
        ->type_name(kFile);
    verb.add_option("--save-state-every", sequence.state.save_every,
                    "keep the state before each frame that is a multiple of this")
        ->check(from(1, 1 << 30));
    add_examples(verb, {"glint sequence presets/sea.toml -o sea.mp4 --frames 0:599 --samples 4",
                        "glint sequence presets/magic.toml -o magic.%04d.png --frames 0:59 --size "
                        "640x360 --resume",
                        "glint sequence presets/magic.toml -o - | ffplay -f rawvideo -pixel_format "
                        "rgb24 -video_size 1280x720 -"});
}

}  // namespace

std::unique_ptr<Verb> sequence_verb() {
    return make_verb<SequenceOptions>(
        declare, [](const SequenceOptions& options, const Stopwatch&) {
            const Preset drawn = run_sequence(options);
            say_cut_loops(drawn, {.view = options.view, .fps = options.fps});
            if (is_film(options.output) && has_sound(options.output))
                say_cut_loops_of_sound(drawn, options.view);
        });
}

}  // namespace glint
