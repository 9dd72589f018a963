// The process that refines: draws sample after sample, and sends the mean of those so far.
#include "gl/context.h"
#include "offline/input_files.h"
#include "offline/picture.h"
#include "window/trial/refine_socket.h"
#include "window/trial/socket_process.h"

#include <bit>
#include <stdexcept>

namespace glint {
namespace {

constexpr double kSendPeriod = 500.0;  // ms between two pictures, which cost the window its upload

// The first pictures are sent as soon as they are twice as good as the one before.
void refine(const RefineOrder& order, Context& context, Renderer& renderer) {
    const Frame frame = frame_of(order);
    renderer.begin_samples(frame);
    Stopwatch since_sent;
    for (int done = 1; done <= order.samples; ++done) {
        renderer.add_sample(frame, refining_sample(done - 1, order.samples));
        context.finish();
        const bool is_due = std::has_single_bit(static_cast<unsigned>(done)) ||
                            since_sent.ms() > kSendPeriod || done == order.samples;
        if (is_due) {
            renderer.show_samples(done);
            since_sent.restart();
        }
        send_refined(done, is_due ? &renderer : nullptr);
    }
}

}  // namespace

void run_refine(const std::string& device) {
    require_socket("refine");
    const RefineOrder order = receive_refine_order();
    const auto context = make_egl_context(device);
    PictureOptions options;
    options.view.specialise = order.specialise;
    options.samples = order.samples;
    CompileResult compiled = compile_scene(order.preset, compile_options(options, {}));
    if (!compiled.scene) throw std::runtime_error("What is on the screen does not compile.");
    Renderer renderer(order.preset, std::move(*compiled.scene),
                      render_options(options, {}, order.preset.size));
    load_inputs(order.preset, renderer);
    renderer.set_state(order.state);
    refine(order, *context, renderer);
}

}  // namespace glint
