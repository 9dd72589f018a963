#include "measure/check/subject.h"

#include "measure/probe/assertions.h"
#include "offline/input_files.h"
#include "render/viewer.h"

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

// iFrame is an int; a year at 60 Hz still fits, and what counts further stays there.
constexpr long kMostFrames = 2'000'000'000;

// Pixels; one that has both NaN and Inf counts once.
std::size_t count_not_finite(std::span<const float> rgba) {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
        count += !std::isfinite(rgba[i]) || !std::isfinite(rgba[i + 1]) ||
                 !std::isfinite(rgba[i + 2]) || !std::isfinite(rgba[i + 3]);
    }
    return count;
}

}  // namespace

CheckSubject::CheckSubject(const ViewOptions& view, const Preset& opened, Context& context,
                           const SubjectOptions& options)
    : preset(opened),
      view_(view),
      opened_(opened),
      specialised_(options.specialise),
      picture_alone_(options.marked && options.marked->outputs),
      context_(context) {
    for (Pass& pass : preset.scene.passes) {
        if (options.float_bytes != 0 && bytes_a_channel(pass.format) != 1)
            pass.format = with_channel_bytes(pass.format, options.float_bytes);
    }
    CompiledScene compiled = compile_or_stop(
        preset, {.program = {.specialise = options.specialise, .marked = options.marked},
                 .as_written = has_assertions(preset.scene)});
    for (std::size_t pass = 0; pass < compiled.programs.size(); ++pass)
        for (const BuiltinUniform& uniform : compiled.programs[pass].builtins)
            builtins_.emplace_back(uniform.builtin, pass);
    renderer_.emplace(preset, std::move(compiled),
                      RenderOptions{.size = preset.size,
                                    .picture_format = PixelFormat::rgba32f,
                                    .fine_bytes = options.float_bytes == 4});
    load_inputs(preset, *renderer_);
    renderer_->compile_ahead();
    looked_at_.resize(renderer_->graph().passes.size());
}

void CheckSubject::restore() {
    preset.values = opened_.values;
    preset.events = opened_.events;
    preset.date = opened_.date;
    resize(opened_.size);
    // A scene without a state has nothing to forget, and its static passes need not run again.
    if (stateful()) renderer_->reset();
    std::ranges::fill(looked_at_, std::nullopt);
    observed_ = {};
    still.reset();
}

void CheckSubject::resize(glm::ivec2 size) {
    preset.size = size;
    renderer_->resize(size);
}

void CheckSubject::draw_blindly(const Frame& frame) {
    renderer_->set_values(preset.values);
    renderer_->draw(frame);
    context_.finish();
    if (after_frame) after_frame();
}

bool CheckSubject::draw(const Frame& frame) {
    if (!observed_.is_finite()) return false;
    draw_blindly(frame);
    for (std::size_t i = 0; i < looked_at_.size(); ++i) {
        const std::size_t version = renderer_->buffer(i).version();
        if (looked_at_[i] == version) continue;
        looked_at_[i] = version;
        look(i);
    }
    return observed_.is_finite();
}

void CheckSubject::look(std::size_t graph_index) {
    const BufferShape& shape = renderer_->buffer(graph_index).shape();
    if (bytes_a_channel(shape.format) == 1) return;  // holds nothing that is not finite
    const std::size_t pass = renderer_->graph().passes[graph_index].pass;
    if (picture_alone_ && pass != kImagePass) return;
    const auto names = output_names(scene(), pass);
    for (std::size_t output = 0; output < names.size(); ++output) {
        std::vector<float> values = renderer_->read_buffer(graph_index, output);
        if (pass == kImagePass) {  // whose alpha means nothing, but for what is no number
            for (std::size_t i = 0; i + 3 < values.size(); i += 4)
                if (!std::isnan(values[i + 3])) values[i + 3] = values[i];
        }
        const ValueRange found = value_range(values);
        for (int c = 0; c < 4; ++c) {
            if (found.min[c] > found.max[c]) continue;  // nothing finite
            observed_.min = observed_.any ? std::min(observed_.min, found.min[c]) : found.min[c];
            observed_.max = observed_.any ? std::max(observed_.max, found.max[c]) : found.max[c];
            observed_.any = true;
            const bool at_end = std::max(-found.min[c], found.max[c]) >= kLargestHalf;
            if (at_end && bytes_a_channel(shape.format) == 2 && observed_.at_largest_half.empty())
                observed_.at_largest_half = names[output];
        }
        if (found.nan + found.infinite == 0) continue;
        observed_.nan += found.nan;
        observed_.infinite += found.infinite;
        observed_.found.push_back({names[output], count_not_finite(values)});
        observed_.size = {shape.cube ? shape.size.x * 6 : shape.size.x, shape.size.y};
        observed_.values = std::move(values);
    }
}

Frame CheckSubject::frame_at(double time, double delta, long index) const {
    const double before = index == 0 ? -1.0 : time - delta;  // nothing happens before 0
    return glint::frame_at(preset, before, time, delta,
                           static_cast<int>(std::min(index, kMostFrames)));
}

bool CheckSubject::play_frames(int first, int end, double fps) {
    const Playback endless{.end = 1e6, .fps = fps};
    for (int k = first; k < end; ++k) {
        if (!observed_.is_finite()) return false;  // of what failed `still` tells
        still = StillPlace{k / fps, fps};
        if (!draw(endless.frame(preset, k))) return false;
    }
    return true;
}

double CheckSubject::shown_time(double time, double played) const {
    if (!stateful()) return time;
    double two_steps = 0.0;
    for (const Pass& pass : scene().passes)
        if (pass.step) two_steps = std::max(two_steps, 2.0 * pass.step.seconds());
    return played > 0.0 ? std::max(played, two_steps) : 0.0;
}

bool CheckSubject::show(double time, double played, const std::function<bool()>& is_enough) {
    const Playback playback{.end = shown_time(time, played)};
    const int last = playback.last_frame();
    for (int k = stateful() ? 0 : last; k <= last; ++k) {
        if (!observed_.is_finite()) return false;
        const Frame frame = playback.frame(preset, k);
        still = StillPlace{frame.time, playback.fps};
        if (!draw(frame)) return false;
        if (is_enough && is_enough()) break;
    }
    return true;
}

bool CheckSubject::moves() const {
    const auto& passes = renderer_->graph().passes;
    return std::ranges::any_of(passes,
                               [](const GraphPass& pass) { return pass.runs != Runs::on_change; });
}

bool CheckSubject::reads(Builtin builtin, std::optional<std::size_t> pass) const {
    return std::ranges::any_of(builtins_, [&](const auto& read) {
        return read.first == builtin && pass.value_or(read.second) == read.second;
    });
}

bool CheckSubject::knows_step(std::size_t pass) const {
    constexpr Builtin kTold[] = {Builtin::time_delta, Builtin::frame_rate, Builtin::time};
    return std::ranges::any_of(kTold, [&](Builtin builtin) { return reads(builtin, pass); });
}

bool CheckSubject::is_fed_back(std::size_t graph_index) const {
    const auto& passes = renderer_->graph().passes;
    const std::size_t pass = passes[graph_index].pass;
    return std::ranges::any_of(passes, [&](const GraphPass& reader) {
        return reader.pass <= pass && std::ranges::find(reader.reads, pass) != reader.reads.end();
    });
}

float CheckSubject::largest_state() const {
    float largest = 0.0f;
    for (std::size_t i = 0; i < renderer_->graph().passes.size(); ++i) {
        if (!is_fed_back(i)) continue;
        for (int output = 0; output < renderer_->buffer(i).shape().outputs; ++output) {
            for (const float v : renderer_->read_buffer(i, static_cast<std::size_t>(output))) {
                if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
            }
        }
    }
    return largest;
}

std::vector<float> CheckSubject::picture() const {
    return renderer_->read_buffer(renderer_->graph().passes.size() - 1, 0);
}

}  // namespace glint
