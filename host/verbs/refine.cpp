// `glint refine`: the process that refines a picture for the window; for no person to call.
#include "window/trial/refiner.h"

#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

void declare(CLI::App& verb, std::string& device) {
    verb.add_option("device", device);
}

}  // namespace

std::unique_ptr<Verb> refine_verb() {
    return std::make_unique<VerbWith<std::string>>(
        declare, [](const std::string& options, const Stopwatch&) { run_refine(options); });
}

}  // namespace glint
