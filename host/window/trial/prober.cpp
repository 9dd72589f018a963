#include "window/trial/prober.h"

#include "window/trial/message.h"

#include <utility>

namespace glint {
namespace {

constexpr double kLongest = 60'000.0;  // ms; heavy scenes compile for seconds beside others

}  // namespace

void Prober::prepare() {
    if (process_.id() == 0 && !is_refused_)
        process_.start(program_, "probing", device_, 0, memory_.descriptor());
}

void Prober::ask(const ProbeOrder& order) {
    prepare();
    if (process_.id() == 0) return;
    asked_ = order.number;
    since_asked_.restart();
    process_.send(pack(order));
}

void Prober::stop() {
    process_.end();
    asked_ = 0;
}

ProbeAnswer Prober::given_up(std::string problem) {
    ProbeAnswer answer{.number = std::exchange(asked_, 0), .problem = std::move(problem)};
    process_.end();
    return answer;
}

std::optional<ProbeAnswer> Prober::update() {
    if (process_.id() == 0) return {};
    const bool goes_on = process_.receive();
    if (const auto message = take_message(process_.arrived)) {
        asked_ = 0;
        has_answered_ = true;
        return unpack_probe_answer(*message);
    }
    if (!goes_on && is_asking()) return given_up("The process that probes has ended.");
    is_refused_ |= !goes_on && !has_answered_;
    if (!goes_on) process_.end();
    if (waited_ms() > kLongest) return given_up("The instrumented text takes too long.");
    return {};
}

}  // namespace glint
