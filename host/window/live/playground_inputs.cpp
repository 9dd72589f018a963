// The files that the samplers of an open scene read: they come when they are there, and the picture
// goes on meanwhile.
#include "window/live/playground.h"

#include <algorithm>

namespace glint {
namespace {

constexpr std::size_t kLargePicture = std::size_t{16} << 20;  // bytes; the driver takes 20 ms
constexpr std::size_t kRowsAtOnce = std::size_t{1} << 20;     // bytes
constexpr double kSendSlice = 8.0;                            // ms between two frames

ReloadReport report_of(const InputLoader::Loaded& loaded) {
    return {.file = loaded.sampler.files.front(), .read_ms = loaded.ms, .text = {}};
}

}  // namespace

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
    for (const std::size_t index : renderer_->inputs_needed()) {
        const Sampler& sampler = sampler_at(*preset_, index);
        const bool arrives = std::ranges::any_of(arriving_, [&](const Arriving& arriving) {
            return same_input(arriving.loaded.sampler, sampler);
        });
        if (!arrives) inputs_.load(sampler);
    }
    inputs_.glance();
    for (InputLoader::Loaded& loaded : inputs_.take()) take_input(std::move(loaded));
    if (opening_ == Opening::awaits_inputs && !awaits_inputs()) opening_ = Opening::done;
}

void Playground::follow_inputs() {
    for (InputLoader::Loaded& loaded : inputs_.take()) take_input(std::move(loaded));
    send_arriving();
    if (opening_ != Opening::awaits_inputs || awaits_inputs()) return;
    opening_ = renderer_->graph().stateful ? Opening::plays_again : Opening::done;
    touched_ |= opening_ == Opening::plays_again;
}

std::optional<std::size_t> Playground::index_of(const Sampler& sampler) const {
    for (std::size_t i = 0; i < sampler_count(*preset_); ++i)
        if (same_input(sampler_at(*preset_, i), sampler)) return i;
    return std::nullopt;
}

void Playground::take_input(InputLoader::Loaded loaded) {
    const std::optional<std::size_t> index = index_of(loaded.sampler);
    if (!index) return;
    forget_failure(loaded.sampler);
    if (!loaded.input) return input_failed(std::move(loaded));
    try {
        const bool is_large = loaded.sampler.type == SamplerType::sampler2D &&
                              loaded.input->bytes.size() > kLargePicture;
        if (is_large) {
            const bool mipmaps = loaded.sampler.filter == Filter::mipmap;
            PictureUpload upload(view_of(*loaded.input), mipmaps);
            context_.finish();  // now the driver says whether there was memory for it
            arriving_.push_back({std::move(loaded), std::move(upload)});
        } else {
            give_input(std::move(*loaded.input), *renderer_, *index);
            forget_states();
            touched_ = true;
            reloader_.input_arrived(report_of(loaded));
            context_.finish();
        }
    } catch (const ContextLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        loaded.error = error.what();
        input_failed(std::move(loaded));
    }
}

// Of a sampler that the text still names.
void Playground::input_failed(InputLoader::Loaded loaded) {
    const Place& place = sampler_at(*preset_, *index_of(loaded.sampler)).place;
    reloader_.input_failed(report_of(loaded), {Severity::error, place, loaded.error, true});
    loaded.input.reset();
    failed_inputs_.push_back(std::move(loaded));
}

// Told of the text in place or of the one that is tried: of an older one its place may have moved.
void Playground::forget_failure(const Sampler& sampler) {
    std::erase_if(failed_inputs_, [&](const InputLoader::Loaded& failed) {
        const bool is_it = same_input(failed.sampler, sampler);
        if (is_it) reloader_.forget_missing_file(failed.error);
        return is_it;
    });
}

// Another text does not read them anew where the picture has what they were.
void Playground::tell_failed_inputs(ReadPreset& read) const {
    for (const InputLoader::Loaded& failed : failed_inputs_)
        for (std::size_t i = 0; i < sampler_count(*read.preset); ++i) {
            const Sampler& sampler = sampler_at(*read.preset, i);
            if (same_input(sampler, failed.sampler))
                read.diagnostics.push_back({Severity::error, sampler.place, failed.error, true});
        }
}

// Between frames, a few milliseconds at a time: the window goes on.
void Playground::send_arriving() {
    if (arriving_.empty()) return;
    try {
        if (send_slice()) show_arrived();
    } catch (const ContextLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        drop_arriving(error.what());
    }
}

// True once all of it is there.
bool Playground::send_slice() {
    Arriving& first = arriving_.front();
    const PixelView pixels = view_of(*first.loaded.input);
    const std::size_t row = pixels.data.size() / static_cast<std::size_t>(pixels.size.y);
    const int rows = static_cast<int>(std::max<std::size_t>(kRowsAtOnce / row, 1));
    const Stopwatch clock;
    bool is_whole = false;
    while (!is_whole && clock.ms() < kSendSlice) {
        is_whole = first.upload.send(pixels, rows);
        context_.finish();  // or the driver would do all of it later, at once
    }
    return is_whole;
}

void Playground::show_arrived() {
    Arriving& arrived = arriving_.front();
    // Else the text names it no more.
    if (const std::optional<std::size_t> index = index_of(arrived.loaded.sampler)) {
        renderer_->set_image(*index, arrived.upload);
        forget_states();
        touched_ = true;
        reloader_.input_arrived(report_of(arrived.loaded));
    }
    arriving_.pop_front();
}

// The driver has no memory for it: the picture goes on without.
void Playground::drop_arriving(const std::string& why) {
    InputLoader::Loaded& loaded = arriving_.front().loaded;
    loaded.error = why;
    if (index_of(loaded.sampler)) input_failed(std::move(loaded));
    arriving_.pop_front();
}

void Playground::fill(const Sampler& channel) {
    if (!preset_ || channel.source == Source::none) return;
    fills_[static_cast<std::size_t>(channel.name.back() - '0')] = channel;
    reloader_.saved(reloader_.file());
}

void Playground::forget_fills() {
    if (!has_fills()) return;
    fills_ = {};
    reloader_.saved(reloader_.file());
}

bool Playground::has_fills() const {
    return std::ranges::any_of(fills_,
                               [](const Sampler& filler) { return filler.source != Source::none; });
}

// What the file fills by now is the file's. A buffer is the one of its name, where there still is.
void Playground::lay_fills_over(Preset& candidate) {
    laid_over_ = {};
    for (std::size_t i = 0; i < fills_.size(); ++i) {
        Sampler filler = fills_[i];
        const auto& type = candidate.scene.channel_types[i];
        if (filler.source == Source::none || candidate.channels[i].source != Source::none ||
            (type && *type != filler.type))
            continue;
        if (filler.source == Source::buffer) {
            const auto& declared = candidate.scene.samplers;
            const std::string& name = preset_->scene.passes[filler.pass].outputs[filler.output];
            const auto same = std::ranges::find_if(declared, [&](const Sampler& sampler) {
                return sampler.name == name && sampler.source == Source::buffer &&
                       sampler.tab.empty();
            });
            if (same == declared.end()) continue;
            filler.pass = same->pass, filler.output = same->output;
        }
        candidate.channels[i] = filler;
        laid_over_[i] = true;
    }
}

}  // namespace glint
