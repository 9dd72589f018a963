// The process that sketches: draws a text once, with what the window's buffers hold already.
#include "base/memory.h"
#include "gl/context.h"
#include "offline/input_files.h"
#include "window/trial/given_buffers.h"
#include "window/trial/refine_socket.h"
#include "window/trial/shared_memory.h"
#include "window/trial/sketcher.h"
#include "window/trial/socket_process.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace glint {
namespace {

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

// What compilers take, while nobody waits: a virtual machine may give 2 MB in 5 ms. It stays with
// the process (allocator.cpp).
void warm_up_memory() {
    constexpr std::size_t kTaken = std::size_t{96} << 20, kPage = 4096;
    if (available_memory() < 4 * kTaken) return;
    const std::unique_ptr<volatile char[]> memory(new volatile char[kTaken]);
    for (std::size_t at = 0; at < kTaken; at += kPage) memory[at] = 0;
}

}  // namespace

void run_sketch(const std::string& device) {
    require_socket("sketch");
    // Read when the driver is loaded. What it makes so is for nobody else.
    ::setenv("GALLIVM_PERF", "nopt", 1);
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    const auto context = make_egl_context(device);
    warm_up(*context);
    warm_up_memory();
    RefineOrder order = receive_refine_order();
    SentPictures sent;
    if (order.samples == 0) {
        const std::vector<GivenPicture> maps = as_pictures(order.preset, order.given);
        sent = send_ahead(order.preset, maps, SeenMemory().bytes());
        context->finish();
        order = receive_refine_order();
    }
    const std::vector<GivenPicture> pictures = as_pictures(order.preset, still_right(order));
    CompiledScene scene = compiled(order.preset);
    // What is simulated begins where it stands, which only the window knows.
    if (scene.graph.stateful) throw std::runtime_error("What is simulated was not given.");
    Renderer renderer(order.preset, std::move(scene), {.size = order.preset.size});
    const SeenMemory memory;
    hand_over(pictures, memory.bytes(), sent, renderer);
    load_inputs(order.preset, renderer);
    renderer.draw(frame_of(order));
    context->finish();
    send_refined(1, &renderer);
}

}  // namespace glint
