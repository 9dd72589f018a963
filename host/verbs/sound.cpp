// `glint sound`: mainSound to a file.
#include "offline/sound.h"

#include "measure/probe/cut_loops.h"
#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, SoundOptions& sound) {
    add_view(verb, sound.view);
    verb.add_option("-o,--output", sound.output, "a .wav, .flac or .ogg file")
        ->type_name(kFile)
        ->required();
    verb.add_option("--seconds", sound.seconds, "from the start; 180 otherwise")
        ->check(from(0.0, kMostSoundSeconds));
    add_examples(verb, {"glint sound presets/sea.toml -o surf.ogg --seconds 5"});
}

}  // namespace

std::unique_ptr<Verb> sound_verb() {
    return make_verb<SoundOptions>(declare, [](const SoundOptions& options, const Stopwatch&) {
        say_cut_loops_of_sound(run_sound(options), options.view);
    });
}

}  // namespace glint
