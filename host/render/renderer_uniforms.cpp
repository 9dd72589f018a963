// What the programs of a frame are fed with: values by name, sent where they have changed.
#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

struct Words {
    const GLfloat* floats;
    GLint integer;
};

void send(GLuint program, const BuiltinUniform& uniform, const Words& value) {
    const GLfloat* floats = value.floats;
    const GLint location = uniform.location;
    switch (uniform.builtin) {
        case Builtin::time:
        case Builtin::time_delta:
        case Builtin::frame_rate:
        case Builtin::sample_rate:
            glProgramUniform1fv(program, location, 1, floats);
            break;
        case Builtin::channel_time:
            glProgramUniform1fv(program, location, 4, floats);
            break;
        case Builtin::jitter:
        case Builtin::origin:
        case Builtin::resolution_2d:
        case Builtin::mouse_2d:
        case Builtin::mouse_share:
            glProgramUniform2fv(program, location, 1, floats);
            break;
        case Builtin::resolution:
            glProgramUniform3fv(program, location, 1, floats);
            break;
        case Builtin::channel_resolution:
            glProgramUniform3fv(program, location, 4, floats);
            break;
        case Builtin::mouse:
        case Builtin::date:
            glProgramUniform4fv(program, location, 1, floats);
            break;
        case Builtin::frame:
        case Builtin::face:
            glProgramUniform1i(program, location, value.integer);
            break;
        case Builtin::tick:
            glProgramUniform1ui(program, location, static_cast<GLuint>(value.integer));
            break;
        case Builtin::channel_struct:
            if (uniform.name.ends_with(".size"))
                glProgramUniform3fv(program, location, 1, floats);
            else if (uniform.name.ends_with(".time"))
                glProgramUniform1fv(program, location, 1, floats);
            else
                glProgramUniform1i(program, location, value.integer);
            break;
    }
}

void send(GLuint program, GLint location, TweakType type, const TweakValue& value) {
    const glm::vec4 v(value[0], value[1], value[2], value[3]);
    switch (type) {
        case TweakType::float1:
            glProgramUniform1f(program, location, v.x);
            break;
        case TweakType::int1:
        case TweakType::bool1:
            glProgramUniform1i(program, location, static_cast<GLint>(value[0]));
            break;
        case TweakType::vec2:
            glProgramUniform2f(program, location, v.x, v.y);
            break;
        case TweakType::vec3:
            glProgramUniform3f(program, location, v.x, v.y, v.z);
            break;
        case TweakType::vec4:
            glProgramUniform4f(program, location, v.x, v.y, v.z, v.w);
            break;
    }
}

}  // namespace

// Sends what has changed since the pass was last drawn, and says whether anything had. The
// sub-pixel position counts; the face of a cube does not, since all faces are drawn together.
bool Renderer::update_uniforms(std::size_t index, const Inputs& inputs) {
    const PassProgram& pass = scene_.programs[index];
    const GLuint program = pass.id;
    bool changed = false;
    if (!drawn_[index].is_fed && pass.numbers_location >= 0)
        glProgramUniform4fv(program, pass.numbers_location,
                            static_cast<GLsizei>(pass.numbers.size() / 4), pass.numbers.data());
    drawn_[index].is_fed = true;
    for (std::size_t i = 0; i < pass.builtins.size(); ++i) {
        const BuiltinUniform& uniform = pass.builtins[i];
        const Value value = value_of(uniform, index, inputs);
        if (drawn_[index].builtins[i] == value) continue;
        drawn_[index].builtins[i] = value;
        changed |= uniform.builtin != Builtin::face;
        send(program, uniform, {value.floats.data(), value.ints[0]});
    }
    for (std::size_t i = 0; i < pass.tweaks.size(); ++i) {
        const TweakUniform& uniform = pass.tweaks[i];
        const TweakValue& value = values_[uniform.tweak];
        if (drawn_[index].tweaks[i] == value) continue;
        drawn_[index].tweaks[i] = value;
        changed = true;
        send(program, uniform.location, preset_.scene.tweaks[uniform.tweak].type, value);
    }
    return changed;
}

// To a program that is no pass's own.
void Renderer::send_all(const PassProgram& program, std::size_t index, const Inputs& inputs) {
    for (const BuiltinUniform& uniform : program.builtins) {
        const Value value = value_of(uniform, index, inputs);
        send(program.id, uniform, {value.floats.data(), value.ints[0]});
    }
    for (const TweakUniform& uniform : program.tweaks)
        send(program.id, uniform.location, preset_.scene.tweaks[uniform.tweak].type,
             values_[uniform.tweak]);
    if (program.numbers_location >= 0)
        glProgramUniform4fv(program.id, program.numbers_location,
                            static_cast<GLsizei>(program.numbers.size() / 4),
                            program.numbers.data());
}

// What a pass reads as iChannel0..3, in pixels; 0 where nothing is bound.
glm::ivec3 Renderer::channel_size(std::size_t pass, int channel) const {
    const auto found = find_sampler(preset_, pass, fmt::format("iChannel{}", channel));
    if (!found) return glm::ivec3(0);
    const Sampler& sampler = sampler_at(preset_, *found);
    if (sampler.source == Source::none) return glm::ivec3(0);
    if (sampler.source != Source::buffer) return channels_.channel(*found).size;
    return glm::ivec3(buffer_size(preset_.scene.passes[sampler.pass], options_.size), 1);
}

// Sounds, and noise in the place of one, have a time of their own.
float Renderer::channel_time(std::size_t pass, int channel, double time) const {
    const auto found = find_sampler(preset_, pass, fmt::format("iChannel{}", channel));
    return found ? static_cast<float>(channels_.time_of(*found, time)) : 0.0f;
}

// What a pass is told of its channels: of all four, or of the one that the uniform is about.
Renderer::Value Renderer::channel_value(const BuiltinUniform& uniform, std::size_t pass,
                                        double time) const {
    Value value;
    if (uniform.builtin == Builtin::channel_struct) {
        const glm::vec3 size(channel_size(pass, uniform.index));
        if (uniform.name.ends_with(".size")) std::copy_n(&size.x, 3, value.floats.begin());
        if (uniform.name.ends_with(".time"))
            value.floats[0] = channel_time(pass, uniform.index, time);
        if (uniform.name.ends_with(".loaded")) value.ints[0] = size.x > 0.0f;
        return value;
    }
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 size(channel_size(pass, i));
        if (uniform.builtin == Builtin::channel_time)
            value.floats[static_cast<std::size_t>(i)] = channel_time(pass, i, time);
        else
            std::copy_n(&size.x, 3, value.floats.begin() + 3 * i);
    }
    return value;
}

Renderer::Value Renderer::value_of(const BuiltinUniform& uniform, std::size_t index,
                                   const Inputs& inputs) const {
    const Frame& frame = inputs.frame;
    Value value;
    auto& f = value.floats;
    switch (uniform.builtin) {
        case Builtin::resolution:
        case Builtin::resolution_2d: {
            const glm::ivec2 size = is_tile(index) ? options_.size : buffers_[index]->shape().size;
            f[0] = static_cast<float>(size.x), f[1] = static_cast<float>(size.y), f[2] = 1.0f;
            break;
        }
        case Builtin::time:
            f[0] = static_cast<float>(frame.time);
            break;
        case Builtin::time_delta:
            f[0] = static_cast<float>(frame.time_delta);
            break;
        case Builtin::frame_rate:
            f[0] = static_cast<float>(frame.frame_rate);
            break;
        case Builtin::frame:
            value.ints[0] = frame.frame;
            break;
        case Builtin::mouse:
        case Builtin::mouse_2d:
            for (int i = 0; i < 4; ++i)
                f[i] = static_cast<float>(frame.input.mouse[i] * double(options_.size[i % 2]) /
                                          mouse_size(frame)[i % 2]);
            break;
        case Builtin::mouse_share:
            f[0] = frame.input.mouse.x / static_cast<float>(mouse_size(frame).x);
            f[1] = frame.input.mouse.y / static_cast<float>(mouse_size(frame).y);
            break;
        case Builtin::date:
            std::copy_n(&frame.date.x, 4, f.begin());
            break;
        case Builtin::sample_rate:
            f[0] = 44100.0f;
            break;
        case Builtin::tick:
            value.ints[0] = static_cast<GLint>(tick(frame.time));
            break;
        case Builtin::channel_time:
        case Builtin::channel_resolution:
        case Builtin::channel_struct:
            return channel_value(uniform, scene_.programs[index].pass, frame.time);
        case Builtin::jitter:
            if (is_jittered(preset_.scene, scene_.graph.passes[index]))
                f[0] = inputs.jitter.x, f[1] = inputs.jitter.y;
            break;
        case Builtin::face:
            value.ints[0] = inputs.face;
            break;
        case Builtin::origin:
            f[0] = static_cast<float>(tile_origin_.x), f[1] = static_cast<float>(tile_origin_.y);
            break;
    }
    return value;
}

// A variant may read what the pass itself does not; such a buffer is empty.
GLuint Renderer::texture_of(std::size_t index) {
    const Sampler& sampler = sampler_at(preset_, index);
    if (sampler.source != Source::buffer) return channels_.channel(index).texture.id();
    const std::size_t pass = graph_index(sampler.pass);
    return pass < buffers_.size() ? buffers_[pass]->texture(sampler.output)
                                  : channels_.empty(sampler.type);
}

std::vector<Renderer::Binding> Renderer::bindings_of(const PassProgram& program) {
    std::vector<Binding> bindings;
    for (const SamplerUniform& uniform : program.samplers) {
        const Sampler& sampler = sampler_at(preset_, uniform.sampler);
        bindings.push_back({static_cast<GLuint>(uniform.unit), texture_of(uniform.sampler),
                            channels_.sampler_object(sampler)});
    }
    for (const UnfilledSampler& uniform : program.unfilled) {
        const GLuint texture = uniform.type ? channels_.empty(*uniform.type) : 0;
        bindings.push_back({static_cast<GLuint>(uniform.unit), texture, 0});
    }
    return bindings;
}

void Renderer::bind(const std::vector<Binding>& bindings) {
    for (const Binding& binding : bindings) {
        glBindTextureUnit(binding.unit, binding.texture);
        glBindSampler(binding.unit, binding.sampler);
    }
}

}  // namespace glint
