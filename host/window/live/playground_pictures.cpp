// The picture of an open scene for others than the screen: stills, the other set of tweaks, other
// processes.
#include "window/live/playground.h"

#include <algorithm>

namespace glint {

// At the full size, whatever the screen shows; from the buffers as they stand. From where the mouse
// was: of a pixel of another size the place in it is not known.
Frame Playground::frame_at_full_size() const {
    Frame frame = frame_again();
    frame.input.mouse = InputState(drawn_inputs_).next_frame(still_size()).mouse;
    frame.mouse_size = still_size();
    return frame;
}

Image Playground::still() {
    if (!renderer_) return {};
    const bool measured = measuring_;
    measure_passes(false);
    std::vector<std::byte> pixels;
    const glm::ivec2 size = still_size();
    const bool has_values = constants_ && *constants_ == tweaks.values();
    const bool as_it_is =
        (has_values || !options_.specialise) && size == size_ && !renderer_->has_maps_left();
    const Preset now = current_preset();
    const ProgramOptions still_options{.specialise = still_programs() == Programs::constants,
                                       .lean = true};
    Diagnostics why_not;
    const auto special =
        as_it_is ? nullptr : make_renderer(now, still_options, renderer_.get(), why_not);
    for (const Diagnostic& diagnostic : why_not) reloader_.tell(diagnostic);
    if (special) {
        touched_ = true;
        try {
            special->resize(size);
            special->draw_again(frame_at_full_size());
            pixels = special->read_bytes();
            special->resize(size_);
        } catch (const ContextLost&) {
            throw;
        } catch (const std::runtime_error&) {
            renderer_->adopt(*special);
            renderer_->resize(size_);
            throw;
        }
        renderer_->adopt(*special);
    } else {
        pixels = renderer_->read_bytes();
    }
    measure_passes(measured);
    return picture_without_alpha(std::move(pixels), special ? size : size_);
}

Metadata Playground::still_metadata() const {
    return picture_metadata(current_preset(), frame_again(), context_.renderer());
}

bool Playground::stands() const {
    return has_picture_ && !wants_frame() && !is_loading() && is_at_rest() && !tweaks.is_open();
}

RefineOrder Playground::refine_order() const {
    const Frame frame = frame_at_full_size();
    RefineOrder order{.preset = current_preset(),
                      .specialise = still_programs() == Programs::constants,
                      .time = frame.time,
                      .time_delta = frame.time_delta,
                      .frame_rate = frame.frame_rate,
                      .frame = frame.frame,
                      .date = frame.date,
                      .input = frame.input,
                      .mouse_size = frame.mouse_size,
                      .state = renderer_->state()};
    order.preset.size = still_size();
    return order;
}

const Buffer* Playground::picture_of(TweakSet set) {
    if (!renderer_) return nullptr;
    leave_constants();
    if (constants_) return nullptr;  // nothing at hand can draw it yet
    const Buffer& picture = renderer_->buffer(renderer_->graph().passes.size() - 1);
    if (!other_picture_ || other_picture_->shape() != picture.shape()) {
        other_picture_ = std::make_unique<Buffer>(picture.shape());
    }
    renderer_->set_values(tweaks.values(set));
    renderer_->draw_root(frame_again());
    other_picture_->copy_from(picture);
    renderer_->set_values(tweaks.values());
    renderer_->draw_root(frame_again());
    context_.finish();
    return other_picture_.get();
}

Preset Playground::preset_as_shown() const {
    constexpr double kSoon = 2.0;  // s
    Preset preset = current_preset();
    preset.size = still_size();
    if (renderer_->graph().stateful) {
        preset.time = std::min(preset.time, std::max(preset_->time, kSoon));
    }
    if (preset.events.empty()) preset.events = input_.as_events(0.0);
    return preset;
}

}  // namespace glint
