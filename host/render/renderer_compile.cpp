// Drivers finish compiling inside the first draw: draws for nobody, ahead of it.
#include "base/process_time.h"
#include "gl/context_beside.h"
#include "render/plain_draw.h"
#include "render/renderer.h"

#include <glm/common.hpp>

#include <algorithm>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace glint {

void Renderer::start_context() {
    glDisable(GL_DITHER);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);  // always on in GLSL ES
}

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
    bind_samplers(program);
    glBindFramebuffer(GL_FRAMEBUFFER, nobodys.target());
    glViewport(0, 0, shape.size.x, shape.size.y);
    const PlainDraw plain;
    draw_triangle();
}

// Its state is that of the first draw, or the driver would compile once more; its pixels are none.
void Renderer::compile_by_drawing(std::size_t index) {
    const VertexArray vertex_array = make_vertex_array();
    const bool averaged = index == scene_.root && average_;
    BufferShape shape = averaged ? average_->sum().shape() : buffers_[index]->shape();
    shape.size = glm::min(shape.size, glm::ivec2(4));
    shape.feedback = shape.mipmaps = false;
    const Buffer nobodys(shape);
    glBindVertexArray(vertex_array.id());
    const PassProgram& program = scene_.programs[index];
    glUseProgram(program.id);
    bind_samplers(program);
    glBindFramebuffer(GL_FRAMEBUFFER, nobodys.target());
    glViewport(0, 0, shape.size.x, shape.size.y);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 0, 0);
    if (averaged) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    {
        const PlainDraw plain;
        std::optional<CompileWatch> watch;
        if (scene_.give_up) watch.emplace(scene_.give_up, preset_, program.pass);
        draw_triangle();
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glUseProgram(0);
}

namespace {

// Passes that several threads work on: each is taken once, and a driver that never comes back is
// in the one that was begun first.
class SharedPasses {
public:
    SharedPasses(std::size_t count, const std::function<void(std::size_t)>& works_on)
        : taken_(count), ms_(count), works_on_(works_on) {}

    void compile(std::size_t index, const std::function<void(std::size_t)>& by_drawing) {
        if (!begin(index)) return;
        const double began_ms = own_thread_ms();
        by_drawing(index);
        const std::lock_guard lock(mutex_);
        ms_[index] = own_thread_ms() - began_ms;
        const bool was_oldest = begun_.front() == index;
        std::erase(begun_, index);
        if (was_oldest) tell();
    }
    std::vector<double> ms() const { return ms_; }

private:
    bool begin(std::size_t index) {
        const std::lock_guard lock(mutex_);
        if (taken_[index]) return false;
        taken_[index] = true;
        begun_.push_back(index);
        if (begun_.size() == 1) tell();
        return true;
    }
    void tell() const {
        if (works_on_ && !begun_.empty()) works_on_(begun_.front());
    }

    std::mutex mutex_;
    std::vector<bool> taken_;
    std::vector<double> ms_;
    std::vector<std::size_t> begun_;  // and not done, the oldest first
    const std::function<void(std::size_t)>& works_on_;
};

}  // namespace

// llvmpipe compiles on the thread that draws. Threads beside this one draw with contexts of their
// own, from the picture's pass on, this one from the other end; what they compiled is then in the
// driver's cache.
std::vector<double> Renderer::compile_ahead(const std::function<void(std::size_t)>& works_on,
                                            double worth_ms) {
    const unsigned threads = std::min(std::thread::hardware_concurrency(), kMostTraps);
    const std::size_t passes = scene_.programs.size();
    if (!draws_in_software() || threads < 2 || passes < 2 || scene_.compile_ms < worth_ms)
        return {};
    // What is made when it is first bound is there before others look.
    for (const PassProgram& program : scene_.programs) bind_samplers(program);
    glFinish();
    SharedPasses shared(passes, works_on);
    const auto compile = [this](std::size_t index) { compile_by_drawing(index); };
    std::deque<ContextBeside> contexts;
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < threads; ++i) {
        if (!contexts.emplace_back().is_there()) break;
        others.emplace_back([&, &context = contexts.back()] {
            const auto current = context.make_current();
            if (!current) return;
            start_context();
            for (std::size_t index = passes; index-- > 0;) shared.compile(index, compile);
            glFinish();
        });
    }
    if (others.empty()) return {};
    for (std::size_t index = 0; index < passes; ++index) shared.compile(index, compile);
    others.clear();  // waits for them
    return shared.ms();
}

}  // namespace glint
