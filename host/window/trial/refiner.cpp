#include "window/trial/refiner.h"

#include "window/trial/message.h"

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

bool Refiner::prepare() {
    if (is_running() || is_refused_) return false;
    process_.start(program_, verb_, device_, 0, output_);
    of_ = done_ = 0;
    return is_running();
}

void Refiner::make_ready(const RefineOrder& order) {
    process_.send(pack(order));
}

void Refiner::start(const RefineOrder& order) {
    if (of_ > 0) stop();
    prepare();
    if (!is_running()) return;
    of_ = order.samples;
    process_.send(pack(order));
}

void Refiner::stop() {
    process_.end();
    picture_ = {};
    is_new_picture_ = false;
    done_ = of_ = 0;
}

bool Refiner::update() {
    const bool goes_on = process_.receive();
    const bool is_new = take_arrived();
    if (goes_on) return is_new;
    process_.end();  // it is done, or gone
    is_refused_ = of_ == 0;
    if (done_ < of_) of_ = done_ = 0;  // it could not; nothing more comes
    return true;
}

bool Refiner::take_arrived() {
    bool is_new = false;
    RefineAnswer answer;
    while (process_.arrived.size() >= sizeof answer) {
        std::memcpy(&answer, process_.arrived.data(), sizeof answer);
        const auto pixels = static_cast<std::size_t>(answer.pixel_bytes());
        if (process_.arrived.size() < sizeof answer + pixels) break;
        done_ = answer.done;
        is_new = true;
        if (pixels > 0) {
            picture_ = {.size = {answer.width, answer.height}, .channels = 4, .pixels = {}};
            const auto bytes =
                std::as_bytes(std::span(process_.arrived)).subspan(sizeof answer, pixels);
            picture_.pixels.assign(bytes.begin(), bytes.end());
            is_new_picture_ = true;
        }
        process_.arrived.erase(0, sizeof answer + pixels);
    }
    return is_new;
}

}  // namespace glint
