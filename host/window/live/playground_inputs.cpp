// The files that the samplers of an open scene read: they come when they are there, and the picture
// goes on meanwhile.
#include "window/live/playground.h"

#include <algorithm>

namespace glint {

void Playground::reload_inputs(const std::vector<std::filesystem::path>& changed) {
    if (!renderer_) return;
    for (std::size_t i = 0; i < sampler_count(*preset_); ++i) {
        const Sampler& sampler = sampler_at(*preset_, i);
        const auto file = std::find_first_of(changed.begin(), changed.end(), sampler.files.begin(),
                                             sampler.files.end());
        if (file != changed.end()) inputs_.load_again(sampler);
    }
}

// Small ones are there before the first frame.
void Playground::load_missing_inputs() {
    inputs_.keep_only(*preset_);
    for (const std::size_t sampler : renderer_->inputs_needed())
        inputs_.load(sampler_at(*preset_, sampler));
    inputs_.glance();
    for (InputLoader::Loaded& loaded : inputs_.take()) take_input(std::move(loaded));
    opens_with_inputs_ &= inputs_.is_loading();
}

void Playground::follow_inputs() {
    for (InputLoader::Loaded& loaded : inputs_.take()) take_input(std::move(loaded));
    if (!opens_with_inputs_ || inputs_.is_loading()) return;
    opens_with_inputs_ = false;
    plays_again_ = renderer_->graph().stateful;  // a simulation began without them
    touched_ |= plays_again_;
}

// What comes before the first frame of a text is part of its report, anything later has its own.
void Playground::take_input(InputLoader::Loaded loaded) {
    std::size_t index = 0;
    while (index < sampler_count(*preset_) &&
           !same_input(sampler_at(*preset_, index), loaded.sampler))
        ++index;
    if (index == sampler_count(*preset_)) return;
    const Place& place = sampler_at(*preset_, index).place;
    std::erase_if(diagnostics_, [&](const Diagnostic& d) {
        return d.missing_file && d.place.file == place.file && d.place.line == place.line;
    });
    const bool has_own_report = !report_first_frame_;
    if (has_own_report) {
        report_ = {.file = loaded.sampler.files.front(), .read_ms = loaded.ms, .text = {}};
    }
    try {
        if (!loaded.input) throw std::runtime_error(loaded.error);
        give_input(std::move(*loaded.input), *renderer_, index);
        context_.finish();  // now the driver says whether there was memory for it
        touched_ = report_first_frame_ = true;
    } catch (const ContextLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        diagnostics_.push_back({Severity::error, place, error.what(), true});
        if (has_own_report) finish_report(false);
    }
}

}  // namespace glint
