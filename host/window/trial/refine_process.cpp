// The process that refines: draws sample after sample, and sends the mean of those so far.
#include "gl/context.h"
#include "offline/input_files.h"
#include "offline/picture.h"
#include "window/trial/message.h"
#include "window/trial/refiner.h"
#include "window/trial/socket_process.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <stdexcept>

namespace glint {
namespace {

constexpr double kSendPeriod = 500.0;  // ms between two pictures, which cost the window its upload

void send_all(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(STDIN_FILENO, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) _exit(0);  // the window has moved on
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
}

RefineOrder receive() {
    std::string arrived;
    std::array<char, 64 * 1024> buffer;
    for (;;) {
        if (const auto message = take_message(arrived)) return unpack_refine_order(*message);
        const ssize_t length = ::recv(STDIN_FILENO, buffer.data(), buffer.size(), 0);
        if (length <= 0) _exit(0);
        arrived.append(buffer.data(), static_cast<std::size_t>(length));
    }
}

Frame frame_of(const RefineOrder& order) {
    Frame frame;
    frame.time = order.time;
    frame.time_delta = order.time_delta;
    frame.frame_rate = order.frame_rate;
    frame.frame = order.frame;
    frame.date = order.date;
    frame.input = order.input;
    return frame;
}

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
        RefineAnswer answer{.done = done};
        std::vector<std::byte> pixels;
        if (is_due) {
            renderer.show_samples(done);
            pixels = renderer.read_bytes();
            answer.width = renderer.root_size().x;
            answer.height = renderer.root_size().y;
            since_sent.restart();
        }
        send_all(std::as_bytes(std::span(&answer, 1)));
        send_all(pixels);
    }
}

}  // namespace

void run_refine(const std::string& device) {
    require_socket("refine");
    const RefineOrder order = receive();
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
