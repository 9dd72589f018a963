#include "base/end_signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <stdexcept>

namespace glint {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

// A handler is given nothing but the number.
volatile std::sig_atomic_t last_signal = 0;
int write_end = -1;
timespec heard{};  // when the first came

// The first, or within a second of it: a terminal that is closed tells of it twice.
bool is_of_the_first() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    const auto ns = [](const timespec& t) { return t.tv_sec * 1'000'000'000LL + t.tv_nsec; };
    if (last_signal == 0) heard = now;
    return ns(now) - ns(heard) < 1'000'000'000LL;
}

void hear(int signal) {
    const int kept = errno;
    if (!is_of_the_first()) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);  // once this has returned
    }
    last_signal = signal;
    const char byte = 0;
    [[maybe_unused]] const auto written = ::write(write_end, &byte, 1);
    errno = kept;
}

}  // namespace

EndSignals::EndSignals() {
    if (::pipe2(pipe_, O_CLOEXEC | O_NONBLOCK) != 0) throw std::runtime_error("There is no pipe.");
    write_end = pipe_[1];
    last_signal = 0;
    struct sigaction action {};
    action.sa_handler = hear;
    action.sa_flags = SA_RESTART;
    for (const int signal : kSignals) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
    }
}

EndSignals::~EndSignals() {
    for (const int signal : kSignals) {
        struct sigaction now {};
        ::sigaction(signal, nullptr, &now);
        if (now.sa_handler == hear) std::signal(signal, SIG_DFL);
    }
    ::close(pipe_[0]);
    ::close(pipe_[1]);
}

int EndSignals::descriptor() const {
    return pipe_[0];
}

int EndSignals::arrived() const {
    return last_signal;
}

void end_by(int signal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    std::_Exit(128 + signal);  // where it is blocked
}

}  // namespace glint
