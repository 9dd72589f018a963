#include "measure/probe/session.h"

#include "offline/input_files.h"
#include "scene/passes.h"
#include "scene/probe_note.h"

#include <fmt/format.h>

#include <charconv>

namespace glint {
namespace {

// "320,180".
std::optional<glm::ivec2> parse_pixel(const std::string& text) {
    glm::ivec2 pixel{0};
    const char* end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, pixel.x);
    if (x.ec != std::errc() || x.ptr == end || *x.ptr != ',') return {};
    const auto y = std::from_chars(x.ptr + 1, end, pixel.y);
    if (y.ec != std::errc() || y.ptr != end) return {};
    return pixel;
}

}  // namespace

ProbeSession::ProbeSession(const ProbeOptions& options)
    : ProbeSession(open_preset(options.view), options) {}

ProbeSession::ProbeSession(Preset preset, const ProbeOptions& options)
    : preset_(std::move(preset)),
      output_(options.pass),
      pass_(find_pass(preset_.scene, options.pass)),
      specialised_(options.view.specialise),
      context_(make_egl_context(options.view.device)) {
    // The picture in floats, so that no difference hides in its bytes.
    renderer_.emplace(
        preset_,
        compile_or_stop(preset_, {.root = pass_, .program = program_options(), .as_written = true}),
        RenderOptions{.size = preset_.size, .picture_format = PixelFormat::rgba32f});
    load_inputs(preset_, *renderer_);
}

ProbePlace ProbeSession::place(const ProbeOptions& options) const {
    if (options.face != 0 && !shape().cube)
        throw UsageError(fmt::format("--face {}: pass {} fills no cube.", options.face,
                                     pass_name(preset_.scene, pass_)));
    const glm::ivec2 size = shape().size;
    if (options.at.empty()) return {.pixel = size / 2, .face = options.face};
    const auto pixel = parse_pixel(options.at);
    if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x >= size.x || pixel->y >= size.y)
        throw UsageError(
            fmt::format("--at {}: write X,Y from 0,0 at the bottom left to {},{}, as in 17,40.",
                        options.at, size.x - 1, size.y - 1));
    return {.pixel = *pixel, .face = options.face};
}

void ProbeSession::draw(const Frame& frame, const Ask& ask) {
    bool was_asked = false;
    renderer_->before_pass = [&](std::size_t index) {
        if (index != this->index()) return;
        ask(frame);
        was_asked = true;
    };
    renderer_->draw(frame);
    renderer_->before_pass = nullptr;
    const bool waits = step() > 0.0;       // what it read for its last step is gone
    if (!was_asked && !waits) ask(frame);  // nothing has changed: the buffers stand as it read them
    context_->finish();
}

double ProbeSession::step() const {
    return pass_ == kImagePass ? 0.0 : preset_.scene.passes[pass_].step.seconds();
}

const Frame& ProbeSession::play_to(const ProbeOptions& options) {
    const double end = time_of(options, preset_.time);
    int rendered = 0;
    frame_ = play(preset_, *renderer_, {.end = end, .fps = options.fps},
                  options.settle.value_or(preset_.settle), rendered);
    return frame_;
}

void ProbeSession::at_frame(const ProbeOptions& options, const Ask& ask) {
    bool was_asked = false;
    const Ask once = [&](const Frame& frame) {
        ask(frame);
        was_asked = true;
    };
    draw(play_to(options), once);
    if (was_asked) return;
    // A simulation that takes no step in this frame.
    constexpr double kRounding = 1e-6;
    const std::string name = pass_name(preset_.scene, pass_);
    const Frame asked = frame_;
    const double last_step = std::floor(asked.time / step() + kRounding) * step();
    ProbeOptions earlier = options;
    earlier.time.reset();
    earlier.frame = static_cast<int>(std::ceil(last_step * options.fps - kRounding));
    renderer_->reset();
    draw(play_to(earlier), once);
    if (!was_asked)
        throw ProbeRefused(
            fmt::format("Pass {} has taken no step by frame {}, for its step is {:.6g} s; "
                        "ask for a later frame.",
                        name, asked.frame, step()));
    notes_.push_back(fmt::format("pass {} takes no step in frame {}; shown is frame {}, its last",
                                 name, asked.frame, frame_.frame));
}

Probing ProbeSession::probing(const ProbePlace& place) const {
    return {.scene = preset_.scene.files.front().string(),
            .renderer = context_->renderer(),
            .pass = output_,
            .size = shape().size,
            .pixel = place.pixel,
            .frame = frame_.frame,
            .time = frame_.time,
            .notes = notes_};
}

Span ProbeSession::line(const std::string& text) const {
    if (const auto found = find_line(preset_.scene, text)) return *found;
    const std::string digits = text.substr(text.rfind(':') + 1);
    if (digits.empty() || digits.find_first_not_of("0123456789") != digits.npos)
        throw UsageError(
            fmt::format("{} is no line: write one as in 412 or shared.glsl:12.", text));
    throw UsageError(fmt::format("There is no line {} in the scene.", text));
}

ProbeExpression ProbeSession::expression(const std::string& text) const {
    const std::size_t at = text.rfind('@');
    const std::size_t number = at == text.npos ? at : text.find_first_not_of(' ', at + 1);
    if (number == text.npos)
        throw UsageError(fmt::format(
            "--expr {}: write an expression and its line, as in 'dot(nor, rd)@412'.", text));
    return {.text = text.substr(0, at), .line = line(text.substr(number))};
}

}  // namespace glint
