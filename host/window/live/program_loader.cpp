#include "window/live/program_loader.h"

#include <algorithm>
#include <utility>

namespace glint {

std::optional<std::size_t> pass_named(const Scene& scene, std::string_view name) {
    for (std::size_t i = 0; i < scene.passes.size(); ++i)
        if (pass_name(scene, i) == name) return i;
    if (name == pass_name(scene, kImagePass)) return kImagePass;
    return std::nullopt;
}

void ProgramLoader::start(const Preset& preset, const ProgramOptions& options,
                          const std::vector<PassTrial>& passes) {
    stop();
    preset_ = preset;
    options_ = options;
    for (const PassTrial& pass : passes) passes_.push_back(pass.name);
}

void ProgramLoader::step(ProgramShelf& shelf, Renderer* same_text) {
    if (linked_ && same_text) same_text->warm_up(*linked_);
    if (std::exchange(linked_, {})) return;
    constexpr double kSlice = 4.0;  // ms, of texts that are compared alone
    const Stopwatch clock;
    while (!passes_.empty() && !linked_ && clock.ms() < kSlice) {
        const auto pass = pass_named(preset_->scene, passes_.back());
        passes_.pop_back();
        if (!pass) continue;
        bool was_kept = false;
        CompiledPass compiled = compile_pass(*preset_, *pass, options_, &shelf, &was_kept);
        if (!was_kept) linked_ = std::move(compiled.program);
    }
}

}  // namespace glint
