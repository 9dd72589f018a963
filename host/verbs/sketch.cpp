// `glint sketch`: the process that draws a saved text soon for the window; for no person to call.
#include "verbs/options.h"
#include "verbs/verb.h"
#include "window/trial/refiner.h"

namespace glint {
namespace {

void declare(CLI::App& verb, std::string& device) {
    verb.add_option("device", device);
}

}  // namespace

std::unique_ptr<Verb> sketch_verb() {
    return std::make_unique<VerbWith<std::string>>(
        declare, [](const std::string& options, const Stopwatch&) { run_sketch(options); });
}

}  // namespace glint
