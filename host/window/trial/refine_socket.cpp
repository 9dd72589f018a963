#include "window/trial/refine_socket.h"

#include "window/trial/message.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <span>

namespace glint {

void send_all(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(STDIN_FILENO, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) _exit(0);  // the window has moved on
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
}

std::string receive_message() {
    static std::string arrived;
    std::array<char, 64 * 1024> buffer;
    for (;;) {
        if (auto message = take_message(arrived)) return std::move(*message);
        const ssize_t length = ::recv(STDIN_FILENO, buffer.data(), buffer.size(), 0);
        if (length <= 0) _exit(0);
        arrived.append(buffer.data(), static_cast<std::size_t>(length));
    }
}

RefineOrder receive_refine_order() {
    return unpack_refine_order(receive_message());
}

Frame frame_of(const RefineOrder& order) {
    Frame frame;
    frame.time = order.time;
    frame.time_delta = order.time_delta;
    frame.frame_rate = order.frame_rate;
    frame.frame = order.frame;
    frame.date = order.date;
    frame.input = order.input;
    frame.mouse_size = order.mouse_size;
    return frame;
}

void send_refined(int done, Renderer* renderer) {
    RefineAnswer answer{.done = done};
    std::vector<std::byte> pixels;
    if (renderer) {
        pixels = renderer->read_bytes();
        answer.width = renderer->root_size().x;
        answer.height = renderer->root_size().y;
    }
    send_all(std::as_bytes(std::span(&answer, 1)));
    send_all(pixels);
}

}  // namespace glint
