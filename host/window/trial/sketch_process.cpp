// The process that sketches: draws a text once, with what the window's buffers hold already.
#include "gl/context.h"
#include "offline/input_files.h"
#include "window/trial/refine_socket.h"
#include "window/trial/sketcher.h"
#include "window/trial/socket_process.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace glint {
namespace {

// What stands at our standard output.
std::span<const std::byte> shared_memory() {
    struct stat status {};
    if (::fstat(STDOUT_FILENO, &status) != 0 || status.st_size == 0) return {};
    const auto bytes = static_cast<std::size_t>(status.st_size);
    void* at = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, STDOUT_FILENO, 0);
    if (at == MAP_FAILED) throw std::runtime_error("The window's buffers cannot be seen.");
    return {static_cast<const std::byte*>(at), bytes};
}

// Those that the new text would fill with what they hold.
std::vector<GivenBuffer> still_right(const RefineOrder& order) {
    std::vector<GivenBuffer> list = order.given;
    std::erase_if(list, [&](const GivenBuffer& given) {
        return !given.feeds_state &&
               sketch_hash(pass_text(order.preset, given.pass, kSketched).text) != given.text_hash;
    });
    const auto is_right = [&](std::size_t pass) {
        return std::ranges::find(list, pass, &GivenBuffer::pass) != list.end();
    };
    for (std::size_t before = 0; before != list.size();) {
        before = list.size();
        std::erase_if(list, [&](const GivenBuffer& given) {
            return !given.feeds_state && !std::ranges::all_of(given.reads, is_right);
        });
    }
    return list;
}

// Whoever reads such a buffer reads a picture from now on, and nobody draws it.
struct GivenPicture {
    std::size_t sampler = 0;
    GivenBuffer given;
    std::size_t output = 0;
};
std::vector<GivenPicture> as_pictures(RefineOrder& order) {
    const std::vector<GivenBuffer> buffers = still_right(order);
    std::vector<GivenPicture> pictures;
    auto& own = order.preset.scene.samplers;
    for (std::size_t i = 0; i < sampler_count(order.preset); ++i) {
        Sampler& sampler = i < own.size() ? own[i] : order.preset.channels.at(i - own.size());
        const auto given = std::ranges::find(buffers, sampler.pass, &GivenBuffer::pass);
        if (sampler.source != Source::buffer || given == buffers.end()) continue;
        sampler.source = Source::image;
        pictures.push_back({i, *given, sampler.output});
    }
    return pictures;
}

bool is_read(const CompiledScene& scene, std::size_t sampler) {
    return std::ranges::any_of(scene.programs, [&](const PassProgram& program) {
        return std::ranges::find(program.samplers, sampler, &SamplerUniform::sampler) !=
               program.samplers.end();
    });
}

void hand_over(const std::vector<GivenPicture>& pictures, std::span<const std::byte> memory,
               Renderer& renderer) {
    for (const GivenPicture& picture : pictures) {
        if (!is_read(renderer.scene(), picture.sampler)) continue;
        const glm::ivec2 size = picture.given.size;
        const std::size_t bytes =
            static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4 * sizeof(float);
        renderer.set_image(
            picture.sampler,
            {.size = size,
             .floats = true,
             .data = memory.subspan(picture.given.begin + picture.output * bytes, bytes)});
    }
}

CompiledScene compiled(const Preset& preset) {
    CompileResult result = compile_scene(preset, {.program = kSketched});
    if (!result.scene) throw std::runtime_error("The text does not compile.");
    return std::move(*result.scene);
}

// Drivers do much when they compile and draw for the first time, and nobody waits yet.
void warm_up(Context& context) {
    Preset preset;
    preset.scene.files = {"nothing"};
    preset.scene.text = "void mainImage(out vec4 c, in vec2 p) { c = vec4(sin(p), iTime, 1.0); }\n";
    preset.scene.origins = {{.file = 0, .line = 1}};
    Renderer renderer(preset, compiled(preset), {.size = {16, 16}});
    renderer.draw({});
    context.finish();
}

}  // namespace

void run_sketch(const std::string& device) {
    require_socket("sketch");
    // Read when the driver is loaded. What it makes so is for nobody else.
    ::setenv("GALLIVM_PERF", "nopt", 1);
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    const auto context = make_egl_context(device);
    warm_up(*context);
    RefineOrder order = receive_refine_order();
    const std::vector<GivenPicture> pictures = as_pictures(order);
    CompiledScene scene = compiled(order.preset);
    // What is simulated begins where it stands, which only the window knows.
    if (scene.graph.stateful) throw std::runtime_error("What is simulated was not given.");
    Renderer renderer(order.preset, std::move(scene), {.size = order.preset.size});
    hand_over(pictures, shared_memory(), renderer);
    load_inputs(order.preset, renderer);
    renderer.draw(frame_of(order));
    context->finish();
    send_refined(1, &renderer);
}

}  // namespace glint
