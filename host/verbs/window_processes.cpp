// `glint trial`, `refine`, `sketch`, `probing` and `voice`: processes of the window; for no person
// to call.
#include "verbs/options.h"
#include "verbs/verb.h"
#include "window/live/voice.h"
#include "window/probe/process.h"
#include "window/trial/refiner.h"
#include "window/trial/trial.h"

namespace glint {
namespace {

// Of a verb that is told of a device alone.
template <void (*run)(const std::string& device)>
std::unique_ptr<Verb> process_verb() {
    return make_verb<std::string>(
        [](CLI::App& verb, std::string& device) { verb.add_option("device", device); },
        [](const std::string& device, const Stopwatch&) { run(device); });
}

}  // namespace

std::unique_ptr<Verb> trial_verb() {
    return process_verb<run_trial>();
}

std::unique_ptr<Verb> refine_verb() {
    return process_verb<run_refine>();
}

std::unique_ptr<Verb> sketch_verb() {
    return process_verb<run_sketch>();
}

std::unique_ptr<Verb> probing_verb() {
    return process_verb<run_probing>();
}

std::unique_ptr<Verb> voice_verb() {
    return process_verb<run_voice>();
}

}  // namespace glint
