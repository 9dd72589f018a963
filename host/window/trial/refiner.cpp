#include "window/trial/refiner.h"

#include "window/trial/message.h"
#include "window/trial/socket_process.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <numeric>

namespace glint {

// Steps of about the golden section, from the middle on.
int refining_sample(int k, int count) {
    int step = std::max(static_cast<int>(count * 0.618033988749895), 1);
    while (std::gcd(step, count) != 1) ++step;
    return static_cast<int>((count / 2 + std::int64_t{k} * step) % count);
}

Refiner::Refiner(std::string device, std::filesystem::path program, std::string verb, int output)
    : device_(std::move(device)),
      program_(std::move(program)),
      verb_(std::move(verb)),
      output_(output) {}

Refiner::~Refiner() {
    stop();
}

void Refiner::prepare() {
    if (process_ != 0 || is_refused_) return;
    const Launched launched = launch_on_socket(program_, verb_, device_, 0, output_);
    process_ = launched.process;
    socket_ = launched.pipe;
    of_ = done_ = 0;
}

void Refiner::start(const RefineOrder& order) {
    if (of_ > 0) stop();
    prepare();
    if (process_ == 0) return;
    of_ = order.samples;
    outgoing_ = pack(order);
    send_order();
}

void Refiner::stop() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
    dying_.end(process_);
    dying_.reap();
    outgoing_.clear();
    incoming_.clear();
    picture_ = {};
    is_new_picture_ = false;
    done_ = of_ = 0;
}

void Refiner::send_order() {
    while (!outgoing_.empty() && socket_ >= 0) {
        const ssize_t sent =
            send(socket_, outgoing_.data(), outgoing_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent <= 0) return;
        outgoing_.erase(0, static_cast<std::size_t>(sent));
    }
}

bool Refiner::update() {
    dying_.reap();
    if (socket_ < 0) return false;
    send_order();
    std::array<char, 64 * 1024> buffer;
    for (;;) {
        const ssize_t length = recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
        if (length < 0 && errno == EINTR) continue;
        if (length < 0 && errno == EAGAIN) break;
        if (length <= 0) {  // it is done, or gone
            close(socket_);
            socket_ = -1;
            dying_.end(process_);
            take_arrived();
            is_refused_ = of_ == 0;
            if (done_ < of_) of_ = done_ = 0;  // it could not; nothing more comes
            return true;
        }
        incoming_.append(buffer.data(), static_cast<std::size_t>(length));
    }
    return take_arrived();
}

bool Refiner::take_arrived() {
    bool is_new = false;
    RefineAnswer answer;
    while (incoming_.size() >= sizeof answer) {
        std::memcpy(&answer, incoming_.data(), sizeof answer);
        const auto pixels = static_cast<std::size_t>(answer.pixel_bytes());
        if (incoming_.size() < sizeof answer + pixels) break;
        done_ = answer.done;
        is_new = true;
        if (pixels > 0) {
            picture_ = {.size = {answer.width, answer.height}, .channels = 4, .pixels = {}};
            const auto bytes = std::as_bytes(std::span(incoming_)).subspan(sizeof answer, pixels);
            picture_.pixels.assign(bytes.begin(), bytes.end());
            is_new_picture_ = true;
        }
        incoming_.erase(0, sizeof answer + pixels);
    }
    return is_new;
}

}  // namespace glint
