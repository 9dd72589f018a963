// Drivers finish compiling inside the first draw: draws for nobody, ahead of it.
#include "gl/context.h"
#include "render/plain_draw.h"
#include "render/renderer.h"

#include <glm/common.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace glint {

void Renderer::warm_up(const PassProgram& program) {
    const auto& passes = scene_.graph.passes;
    const auto is_here = [&](std::size_t pass) {
        return std::ranges::find(passes, pass, &GraphPass::pass) != passes.end();
    };
    const bool reads_others = std::ranges::any_of(program.samplers, [&](const auto& uniform) {
        const Sampler& sampler = sampler_at(preset_, uniform.sampler);
        return sampler.source == Source::buffer && !is_here(sampler.pass);
    });
    if (reads_others || !is_here(program.pass)) return;
    BufferShape shape = buffers_[graph_index(program.pass)]->shape();
    shape.size = glm::min(shape.size, glm::ivec2(4));
    shape.feedback = shape.mipmaps = false;
    Buffer nobodys(shape);
    glBindVertexArray(vertex_array_.id());
    glUseProgram(program.id);
    bind(bindings_of(program));
    glBindFramebuffer(GL_FRAMEBUFFER, nobodys.target());
    glViewport(0, 0, shape.size.x, shape.size.y);
    const PlainDraw plain;
    draw_triangle();
}

// One draw for nobody, as the pass's first one will be, or the driver would compile once more. All
// that later draws change is in here, since other threads draw it meanwhile.
struct Renderer::NobodysDraw {
    std::size_t pass;
    GLuint program;
    std::vector<Binding> bindings;
    BufferShape shape;
    bool averaged;
};

Renderer::NobodysDraw Renderer::nobodys_draw(std::size_t index) {
    const PassProgram& program = scene_.programs[index];
    const bool averaged = index == scene_.root && average_;
    BufferShape shape = averaged ? average_->sum().shape() : buffers_[index]->shape();
    shape.size = glm::min(shape.size, glm::ivec2(4));
    shape.feedback = shape.mipmaps = false;
    return {program.pass, program.id, bindings_of(program), shape, averaged};
}

// Its pixels are none.
void Renderer::compile_by_drawing(const NobodysDraw& draw, std::size_t pixel_bytes) const {
    const VertexArray vertex_array = make_vertex_array();
    const Buffer nobodys(draw.shape);
    glBindVertexArray(vertex_array.id());
    glUseProgram(draw.program);
    bind(draw.bindings);
    glBindFramebuffer(GL_FRAMEBUFFER, nobodys.target());
    glViewport(0, 0, draw.shape.size.x, draw.shape.size.y);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 0, 0);
    if (draw.averaged) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    {
        const PlainDraw plain;
        std::optional<CompileWatch> watch;
        if (scene_.give_up) watch.emplace(scene_.give_up, preset_, draw.pass, pixel_bytes);
        draw_triangle();
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glUseProgram(0);
}

// llvmpipe compiles on the thread that draws. Threads beside this one draw with contexts of their
// own; what they compiled is then in the driver's cache.
bool Renderer::compile_ahead(const CompileAhead::WorksOn& works_on, double worth_ms) {
    const std::size_t passes = scene_.programs.size();
    if (!draws_in_software() || passes < 2 || scene_.compile_ms < worth_ms) return false;
    std::vector<NobodysDraw> draws;
    for (std::size_t index = 0; index < passes; ++index) draws.push_back(nobodys_draw(index));
    glFinish();  // what is made when it is first bound is there before others look
    const auto compile = [this, draws, bytes = pixel_bytes()](std::size_t index) {
        compile_by_drawing(draws[index], bytes);
    };
    ahead_ = std::make_unique<CompileAhead>(passes, compile, works_on);
    if (!ahead_->is_there()) ahead_.reset();
    return ahead_ != nullptr;
}

std::vector<double> Renderer::finish_compiling() {
    std::vector<double> ms;
    if (ahead_) ms = ahead_->finish();
    ahead_.reset();
    return ms;
}

}  // namespace glint
