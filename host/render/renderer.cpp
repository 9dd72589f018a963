#include "render/renderer.h"

#include "gl/context.h"
#include "render/plain_draw.h"
#include "render/room.h"

#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace glint {
namespace {

// Steps that have elapsed at a time. The tolerance, a millionth of a step, forgives times such as
// 7/60 s, which lie a rounding below a whole step.
long steps_elapsed(double time, Step step) {
    return static_cast<long>(std::floor(
        time * static_cast<double>(step.denominator) / static_cast<double>(step.numerator) + 1e-6));
}

constexpr double kStripSeconds = 0.1;

}  // namespace

Renderer::Renderer(const Preset& preset, CompiledScene scene, const RenderOptions& options,
                   Renderer* previous)
    : preset_(preset),
      built_values_(preset.values),
      values_(preset.values),
      scene_(std::move(scene)),
      options_(options),
      channels_(preset),
      buffers_(scene_.programs.size()),
      drawn_(scene_.programs.size()),
      steps_done_(scene_.programs.size(), 0),
      vertex_array_(make_vertex_array()) {
    if (previous) options_.size = previous->options_.size;
    make_buffers(previous);
    start_context();
    for (std::size_t i = 0; i < scene_.programs.size(); ++i) forget_drawn(i);
    if (previous) adopt(*previous);
}

// Those that the other one does not have.
void Renderer::make_buffers(const Renderer* previous) {
    std::vector<std::size_t> indices;
    std::vector<WantedBuffer> wanted;
    for (std::size_t i = 0; i < scene_.programs.size(); ++i) {
        const WantedBuffer one{pass_name(preset_.scene, scene_.programs[i].pass), wanted_shape(i)};
        if (previous && previous->has_buffer(one.name, one.shape)) continue;
        indices.push_back(i);
        wanted.push_back(one);
    }
    const WantedBuffer sum{"the sum of the samples", {.size = wanted_shape(scene_.root).size}};
    if (options_.samples > 1) wanted.push_back(sum);
    require_memory(wanted);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        buffers_[indices[i]] = std::make_unique<Buffer>(wanted[i].shape);
        require_room(*buffers_[indices[i]], wanted[i].name);
    }
    if (options_.samples > 1) {
        average_ = std::make_unique<Average>(sum.shape.size);
        require_room(average_->sum(), sum.name);
    }
}

// Drawn or parked.
bool Renderer::has_buffer(const std::string& name, const BufferShape& shape) const {
    for (std::size_t i = 0; i < scene_.programs.size(); ++i)
        if (pass_name(preset_.scene, scene_.programs[i].pass) == name)
            return buffers_[i] && buffers_[i]->shape() == shape;
    const auto parked = parked_.find(name);
    return parked != parked_.end() && parked->second.buffer->shape() == shape;
}

// GL keeps a deleted program for as long as it is current, and it vanishes under whoever wants to
// restore it.
Renderer::~Renderer() {
    glUseProgram(0);
}

bool Renderer::make_ahead(const CompiledScene& other) {
    for (std::size_t i = 0; i < other.programs.size(); ++i) {
        const std::size_t pass = other.programs[i].pass;
        const std::string name = pass_name(preset_.scene, pass);
        const auto is_same = [&](const PassProgram& own) { return own.pass == pass; };
        if (parked_.contains(name) || std::ranges::any_of(scene_.programs, is_same)) continue;
        const WantedBuffer wanted{name, wanted_shape(other, i)};
        require_memory({&wanted, 1});
        auto buffer = std::make_unique<Buffer>(wanted.shape);
        require_room(*buffer, name);
        parked_[name] = {std::move(buffer), 0};
        return true;
    }
    return false;
}

BufferShape Renderer::wanted_shape(const CompiledScene& scene, std::size_t index) const {
    const std::size_t wanted = scene.programs[index].pass;
    const bool whole = options_.tile == glm::ivec2(0);
    BufferShape shape{.size = whole ? options_.size : options_.tile + 2,  // 2: see set_tile()
                      .format = options_.picture_format};
    if (wanted == kSoundPass) shape.size = {kSoundBlockWidth, kSoundBlockRows};
    if (fills_a_buffer(wanted)) {
        shape = shape_of(preset_.scene.passes[wanted], options_.size,
                         scene.graph.passes[index].feedback);
        shape.fine_bytes = options_.fine_bytes;
    }
    for (const PassProgram& reader : scene.programs) {
        for (const SamplerUniform& uniform : reader.samplers) {
            const Sampler& sampler = sampler_at(preset_, uniform.sampler);
            shape.mipmaps |= sampler.source == Source::buffer && sampler.pass == wanted &&
                             sampler.filter == Filter::mipmap;
        }
    }
    require_drawable({pass_name(preset_.scene, wanted), shape});
    return shape;
}

std::vector<std::size_t> Renderer::empty_channels() const {
    std::set<std::size_t> channels;
    for (const PassProgram& program : scene_.programs)
        for (const UnfilledSampler& unfilled : program.unfilled)
            if (unfilled.name.starts_with("iChannel") && unfilled.type)
                channels.insert(static_cast<std::size_t>(unfilled.name.back() - '0'));
    return {channels.begin(), channels.end()};
}

std::vector<std::size_t> Renderer::inputs_needed() const {
    std::vector<std::size_t> list;
    const auto need = [&](std::size_t sampler) {
        if (sampler_at(preset_, sampler).files.empty() || channels_.has(sampler)) return;
        if (std::find(list.begin(), list.end(), sampler) == list.end()) list.push_back(sampler);
    };
    for (const PassProgram& program : scene_.programs) {
        for (const SamplerUniform& uniform : program.samplers) need(uniform.sampler);
        // Only the file knows its size and its length.
        for (const std::size_t sampler : channels_told_of(preset_, program)) need(sampler);
    }
    return list;
}

bool Renderer::reads_mouse() const {
    return std::any_of(scene_.programs.begin(), scene_.programs.end(), [](const PassProgram& p) {
        return std::any_of(p.builtins.begin(), p.builtins.end(), [](const BuiltinUniform& uniform) {
            return is_of_mouse(uniform.builtin);
        });
    });
}

bool Renderer::reads_keyboard() const {
    return std::any_of(scene_.programs.begin(), scene_.programs.end(), [&](const PassProgram& p) {
        return std::any_of(
            p.samplers.begin(), p.samplers.end(), [&](const SamplerUniform& uniform) {
                return sampler_at(preset_, uniform.sampler).source == Source::keyboard;
            });
    });
}

void Renderer::advance(const Frame& frame) {
    run(frame, true);
}

bool Renderer::draw(const Frame& frame) {
    run(frame, false);
    ahead_.reset();
    force_root_ = false;
    return root_drawn_;
}

void Renderer::set_instant(const Frame& frame) {
    glBindVertexArray(vertex_array_.id());
    channels_.set_keyboard(frame.input);
    channels_.set_time(frame.time);
}

// Holds what cannot be drawn again: it follows from frames before.
bool Renderer::is_kept(std::size_t index) const {
    const GraphPass& pass = scene_.graph.passes[index];
    return pass.feeds_state || pass.previous;
}

void Renderer::draw_again(const Frame& frame) {
    set_instant(frame);
    for (std::size_t i = 0; i < scene_.root; ++i)
        if (!is_kept(i)) run_pass(i, {.frame = frame});
    draw_root(frame);
}

void Renderer::begin_samples(const Frame& frame) {
    set_instant(frame);
    average_->clear();
    for (std::size_t i = 0; i < scene_.root; ++i)
        if (!is_kept(i) && !is_jittered(preset_.scene, scene_.graph.passes[i]))
            run_pass(i, {.frame = frame});
}

void Renderer::draw_root(const Frame& frame) {
    set_instant(frame);
    if (average_) return run_averaged(frame);
    run_pass(scene_.programs.size() - 1, {.frame = frame}, true);
}

void Renderer::set_tile(glm::ivec2 origin, glm::ivec2 size) {
    tile_margin_ = origin % 2;
    tile_origin_ = origin - tile_margin_;
    tile_size_ = size;
    force_root_ = true;
}

bool Renderer::is_tile(std::size_t index) const {
    return options_.tile != glm::ivec2(0) && !fills_a_buffer(scene_.programs[index].pass);
}

// Of the buffer, what is drawn.
glm::ivec2 Renderer::drawn_size(std::size_t index) const {
    return is_tile(index) ? tile_margin_ + tile_size_ : buffers_[index]->shape().size;
}

void Renderer::reset() {
    // The picture, which nobody reads, stays on the screen until it is drawn anew.
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        const bool is_cleared = fills_a_buffer(scene_.programs[i].pass) && !drawn_[i].content;
        if (is_cleared) buffers_[i]->clear();
    }
    offer_maps();
    std::fill(steps_done_.begin(), steps_done_.end(), 0);
    force_root_ = true;
}

void Renderer::redraw_all() {
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        const GraphPass& pass = scene_.graph.passes[i];
        if (pass.runs != Runs::every_step && !pass.feedback && !pass.carries) forget_drawn(i);
    }
    force_root_ = true;
}

std::vector<PassState> Renderer::state() const {
    std::vector<PassState> list;
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        if (!scene_.graph.passes[i].carries) continue;
        list.push_back({.pass = pass_name(preset_.scene, scene_.programs[i].pass),
                        .shape = buffers_[i]->shape(),
                        .steps_done = steps_done_[i],
                        .bytes = buffers_[i]->bytes()});
    }
    return list;
}

void Renderer::set_state(std::span<const PassState> state) {
    std::vector<const PassState*> kept(buffers_.size(), nullptr);
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        if (!scene_.graph.passes[i].carries) continue;
        const std::string name = pass_name(preset_.scene, scene_.programs[i].pass);
        const auto saved = std::ranges::find(state, name, &PassState::pass);
        if (saved == state.end()) throw std::runtime_error("It lacks the buffer " + name + ".");
        BufferShape shape = saved->shape;
        shape.mipmaps = buffers_[i]->shape().mipmaps;  // made anew, where somebody reads them
        if (shape != buffers_[i]->shape() || saved->bytes.size() != buffers_[i]->byte_count()) {
            throw std::runtime_error("It holds the buffer " + name + " in another shape.");
        }
        kept[i] = &*saved;
    }
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        if (!kept[i]) continue;
        buffers_[i]->set_bytes(kept[i]->bytes);
        steps_done_[i] = kept[i]->steps_done;
    }
    offer_maps();
}

void Renderer::set_picture_format(PixelFormat format) {
    if (format == options_.picture_format) return;
    ahead_.reset();
    options_.picture_format = format;
    if (fills_a_buffer(scene_.programs.back().pass)) return;
    const std::size_t root = buffers_.size() - 1;
    buffers_[root] = std::make_unique<Buffer>(wanted_shape(root));
    drawn_[root].ever = false;
}

void Renderer::resize(glm::ivec2 size) {
    ahead_.reset();
    options_.size = size;
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        const glm::ivec2 wanted = wanted_shape(i).size;
        if (wanted == buffers_[i]->shape().size) continue;
        buffers_[i]->resize(wanted);
        drawn_[i].ever = false;  // the new tile is empty, whatever the pass reads
    }
    if (average_) average_ = std::make_unique<Average>(size);
}

void Renderer::run(const Frame& frame, bool state_only) {
    set_instant(frame);
    root_drawn_ = false;
    if (!state_only) draw_maps(frame);
    std::vector<Step> stepped;
    for (std::size_t i = 0; i < scene_.programs.size(); ++i) {
        const GraphPass& pass = scene_.graph.passes[i];
        if (state_only && !pass.feeds_state) continue;
        const Step step = fills_a_buffer(pass.pass) ? preset_.scene.passes[pass.pass].step : Step{};
        if (step) {
            if (std::find(stepped.begin(), stepped.end(), step) != stepped.end()) continue;
            stepped.push_back(step);
            run_steps(frame, step);
        } else if (average_ && i == scene_.root) {
            run_averaged(frame);
        } else if (state_only || !goes_in_parts(i)) {
            run_pass(i, {.frame = frame}, force_root_ && i == scene_.root);
        }
    }
}

// Passes of one step length run together, each step all of them in order, where the first of them
// stands: so that simulations which read each other stay in step.
void Renderer::run_steps(const Frame& frame, Step step) {
    std::vector<std::size_t> group;
    for (std::size_t i = 0; i < scene_.programs.size(); ++i) {
        const std::size_t pass = scene_.programs[i].pass;
        if (fills_a_buffer(pass) && preset_.scene.passes[pass].step == step) group.push_back(i);
    }
    // The end of one step is the start of the next to the last bit, so that no event is seen twice.
    const auto time_of = [&](long count) {
        return static_cast<double>(count * step.numerator) / static_cast<double>(step.denominator);
    };
    const long due = steps_elapsed(frame.time, step);
    long done = steps_done_[group.front()];
    const double caught_up = std::clamp(frame.longest_catch_up / step.seconds(), 1.0, 1e15);
    done = std::min(std::max(done, due - static_cast<long>(caught_up)), due);
    for (; done < due; ++done) {
        Frame inner = frame;
        // A step is a frame of its own length, which ends at its time.
        inner.time = time_of(done + 1);
        inner.time_delta = step.seconds();
        inner.frame_rate = 1.0 / step.seconds();
        inner.frame = static_cast<int>(std::min(done, long{std::numeric_limits<int>::max()}));
        if (!frame.events.empty()) {
            const double from =
                done == 0 ? -std::numeric_limits<double>::infinity() : time_of(done);
            inner.input = replay(frame.events, from, inner.time, mouse_size(frame));
            channels_.set_keyboard(inner.input);
        }
        channels_.set_time(inner.time);
        for (const std::size_t i : group) run_pass(i, {.frame = inner}, true);
    }
    channels_.set_time(frame.time);
    if (!frame.events.empty()) channels_.set_keyboard(frame.input);
    for (const std::size_t i : group) steps_done_[i] = done;
}

// Where the shutter stays open, each sample has a time of its own as well.
void Renderer::run_averaged(const Frame& frame) {
    average_->clear();
    for (int sample = 0; sample < options_.samples; ++sample) add_sample(frame, sample);
    show_samples(options_.samples);
}

void Renderer::add_sample(const Frame& frame, int sample) {
    Frame moment = frame;
    const double later = frame.exposure * shutter_time(sample, options_.samples, frame.frame);
    moment.time += later;
    moment.date.w += static_cast<float>(later);
    const Inputs inputs{.frame = moment, .jitter = sub_pixel_position(sample, options_.samples)};
    if (frame.exposure > 0.0) channels_.set_time(moment.time);
    for (std::size_t i = 0; i < scene_.root; ++i) {
        const bool moves = is_jittered(preset_.scene, scene_.graph.passes[i]);
        if (moves || frame.exposure > 0.0) run_pass(i, inputs);
    }
    run_pass(scene_.root, inputs, true);
}

void Renderer::show_samples(int count) {
    const std::size_t root = scene_.root;
    const glm::ivec2 size = drawn_size(root);
    glViewport(0, 0, size.x, size.y);
    average_->resolve(buffers_[root]->target(), count);
    buffers_[root]->finish_draw();
    root_drawn_ = true;
}

void Renderer::run_pass(std::size_t index, const Inputs& inputs, bool force) {
    const PassProgram& program = scene_.programs[index];
    Buffer& buffer = *buffers_[index];
    const bool new_uniforms = update_uniforms(index, inputs);
    const bool new_buffers = update_versions(index);
    force |= drawn_[index].is_due;
    if (!new_uniforms && !new_buffers && !force && drawn_[index].ever) return;
    drawn_[index].ever = true;
    if (!force && holds(index)) return;
    drawing_ = &inputs.frame;
    if (before_pass) before_pass(index);
    drawing_ = nullptr;
    if (ahead_) ahead_->take(index);

    const bool root = index == scene_.root;
    const bool averaged = root && average_;
    glUseProgram(program.id);
    bind(bindings_of(program));
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    if (buffer.shape().cube) {
        for (int face = 0; face < 6; ++face) {
            update_uniforms(index, {.frame = inputs.frame, .face = face});
            draw_calls(index, buffer.target(face));
        }
    } else {
        if (averaged) {
            glEnable(GL_BLEND);
            glBlendFunc(GL_ONE, GL_ONE);
        }
        if (!averaged) clear_picture(index);
        draw_calls(index, averaged ? average_->target() : buffer.target());
        if (averaged) glDisable(GL_BLEND);
    }
    if (!averaged) buffer.finish_draw();
    draw_call_seconds += std::chrono::duration<double>(Clock::now() - start).count();
    if (root) root_drawn_ = true;
    drawn_[index].rows = 0;
    drawn_[index].is_due = drawn_[index].is_due_again = false;
    note_content(index);
    if (after_pass) after_pass(index);
}

// What a picture discards is transparent, as on the site, whatever frame or tile was drawn before.
// Buffers keep theirs.
void Renderer::clear_picture(std::size_t index) const {
    if (index != scene_.root || fills_a_buffer(scene_.programs[index].pass)) return;
    if (preset_.scene.text.find("discard") == std::string::npos) return;
    constexpr float kNothing[] = {0.0f, 0.0f, 0.0f, 0.0f};
    glClearNamedFramebufferfv(buffers_[index]->target(), GL_COLOR, 0, kNothing);
}

void Renderer::draw_calls(std::size_t index, GLuint target) {
    const glm::ivec2 size = drawn_size(index);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, size.x, size.y);
    if (options_.in_strips && !buffers_[index]->shape().cube) return draw_strips(index, size);
    draw_once(index);
}

// Drivers finish compiling inside the first draw call. What was drawn before is handed over first,
// so that it is not counted; buffers take their memory when they are drawn.
void Renderer::draw_once(std::size_t index) {
    const PlainDraw plain;
    if (drawn_[index].compiled || !scene_.give_up) return draw_triangle();
    drawn_[index].compiled = true;
    glFlush();
    const CompileWatch watch(scene_.give_up, preset_, scene_.programs[index].pass, pixel_bytes());
    draw_triangle();
}

std::size_t Renderer::pixel_bytes() const {
    std::size_t bytes = 0;
    for (const auto& buffer : buffers_) bytes += byte_count(buffer->shape());
    return average_ ? bytes + byte_count(average_->sum().shape()) : bytes;
}

// Strips grow and shrink until each takes about kStripSeconds. Where one holds the whole pass,
// nothing is waited for.
void Renderer::draw_strips(std::size_t index, glm::ivec2 size) {
    int& rows = drawn_[index].strip_rows;
    if (rows >= size.y) {
        draw_once(index);
        if (index == scene_.root && after_strip) after_strip(std::int64_t{size.x} * size.y);
        return;
    }
    glEnable(GL_SCISSOR_TEST);
    for (int y = 0, drawn = 0; y < size.y; y += drawn) {
        drawn = std::min(rows, size.y - y);
        const auto start = std::chrono::steady_clock::now();
        glScissor(0, y, size.x, drawn);
        draw_once(index);
        glFinish();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        const double wanted = drawn * kStripSeconds / std::max(took.count(), 1e-6);
        rows = static_cast<int>(std::clamp(wanted, 1.0, 8.0 * rows));
        if (index == scene_.root && after_strip) after_strip(std::int64_t{size.x} * drawn);
    }
    glDisable(GL_SCISSOR_TEST);
}

// Notes what the pass is about to read, and says whether any of it is new.
bool Renderer::update_versions(std::size_t index) {
    const PassProgram& program = scene_.programs[index];
    bool changed = false;
    for (std::size_t i = 0; i < program.samplers.size(); ++i) {
        const std::size_t sampler = program.samplers[i].sampler;
        const Sampler& read = sampler_at(preset_, sampler);
        const std::size_t version = read.source == Source::buffer
                                        ? buffers_[graph_index(read.pass)]->version()
                                        : channels_.channel(sampler).version;
        if (drawn_[index].versions[i] == version) continue;
        drawn_[index].versions[i] = version;
        changed = true;
    }
    return changed;
}

std::size_t Renderer::graph_index(std::size_t pass) const {
    const auto& passes = scene_.graph.passes;
    const auto found = std::find_if(passes.begin(), passes.end(),
                                    [&](const GraphPass& p) { return p.pass == pass; });
    return static_cast<std::size_t>(found - passes.begin());
}

// The faces of a cube come side by side, in GL's order: +X -X +Y -Y +Z -Z.
glm::ivec2 Renderer::root_size() const {
    const BufferShape& shape = buffers_[scene_.root]->shape();
    if (is_tile(scene_.root)) return tile_size_;
    return shape.cube ? glm::ivec2(shape.size.x * 6, shape.size.y) : shape.size;
}

void Renderer::read_picture(bool floats, void* to) const {
    const glm::ivec2 size = root_size();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, buffers_[scene_.root]->front_framebuffer());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(tile_margin_.x, tile_margin_.y, size.x, size.y, GL_RGBA,
                 floats ? GL_FLOAT : GL_UNSIGNED_BYTE, to);
}

std::vector<std::byte> Renderer::read_bytes() {
    const glm::ivec2 size = root_size();
    std::vector<std::byte> pixels(static_cast<std::size_t>(size.x) *
                                  static_cast<std::size_t>(size.y) * 4);
    read_picture(false, pixels.data());
    return pixels;
}

std::vector<float> Renderer::read_floats(std::size_t output) {
    return read_buffer(scene_.root, output);
}

std::vector<float> Renderer::read_buffer(std::size_t graph_index, std::size_t output) const {
    const Buffer& buffer = *buffers_[graph_index];
    const glm::ivec2 face_size = buffer.shape().size;
    const int faces = buffer.shape().cube ? 6 : 1;
    std::vector<float> pixels(static_cast<std::size_t>(face_size.x) *
                              static_cast<std::size_t>(face_size.y) *
                              static_cast<std::size_t>(faces) * 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, face_size.x * faces);
    for (int face = 0; face < faces; ++face) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, buffer.front_framebuffer(face));
        glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(output));
        glReadPixels(0, 0, face_size.x, face_size.y, GL_RGBA, GL_FLOAT,
                     pixels.data() + static_cast<std::ptrdiff_t>(face) * face_size.x * 4);
    }
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    return pixels;
}

glm::vec4 Renderer::read_pixel(std::size_t graph_index, std::size_t output,
                               glm::ivec2 pixel) const {
    glm::vec4 value(0.0f);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, buffers_[graph_index]->front_framebuffer());
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(output));
    glReadPixels(pixel.x, pixel.y, 1, 1, GL_RGBA, GL_FLOAT, &value.x);
    return value;
}

// Everything is sent and drawn again.
void Renderer::forget_drawn(std::size_t index) {
    const PassProgram& program = scene_.programs[index];
    Drawn& drawn = drawn_[index];
    drawn.ever = drawn.is_fed = false;
    drawn.rows = 0;
    drawn.is_due = drawn.is_due_again = false;
    drawn.content.reset();
    drawn.builtins.assign(program.builtins.size(), {});
    drawn.tweaks.assign(program.tweaks.size(), {});
    drawn.versions.assign(program.samplers.size(), {});
}

void Renderer::draw_variant(const Variant& variant, const Frame& frame) {
    const PassProgram& program = variant.program;
    send_all(program, graph_index(program.pass),
             {.frame = drawing_ ? *drawing_ : frame, .face = variant.face});
    glBindVertexArray(vertex_array_.id());
    glUseProgram(program.id);
    bind(bindings_of(program));
    glBindFramebuffer(GL_FRAMEBUFFER, variant.framebuffer);
    glViewport(0, 0, variant.size.x, variant.size.y);
    const PlainDraw plain;
    draw_triangle();
}

}  // namespace glint
