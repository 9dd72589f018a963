#include "modes/waker.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace glint {
namespace {

void notify(int descriptor) {
    const std::uint64_t one = 1;
    // An eventfd takes eight bytes at once or fails because it is full, and then it is readable
    // too.
    [[maybe_unused]] const auto written = ::write(descriptor, &one, sizeof one);
}

}  // namespace

Waker::Waker(std::function<void()> wake)
    : wake_(std::move(wake)), changed_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (changed_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
    thread_ = std::thread([this] { run(); });
}

Waker::~Waker() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    notify(changed_);
    thread_.join();
    ::close(changed_);
}

void Waker::arm(const std::vector<int>& descriptors) {
    {
        const std::lock_guard lock(mutex_);
        if (armed_ && descriptors == descriptors_) return;
        descriptors_ = descriptors;
        armed_ = true;
    }
    notify(changed_);
}

void Waker::run() {
    for (;;) {
        std::vector<pollfd> polled = {{.fd = changed_, .events = POLLIN, .revents = 0}};
        {
            const std::lock_guard lock(mutex_);
            if (stop_) return;
            if (armed_) {
                for (const int fd : descriptors_) {
                    polled.push_back({.fd = fd, .events = POLLIN, .revents = 0});
                }
            }
        }
        if (::poll(polled.data(), polled.size(), -1) < 0) continue;
        if (polled.front().revents != 0) {
            std::uint64_t count = 0;
            [[maybe_unused]] const auto taken = ::read(changed_, &count, sizeof count);
            continue;
        }
        {
            const std::lock_guard lock(mutex_);
            armed_ = false;  // a readable descriptor stays so until the window has looked at it
        }
        wake_();
    }
}

}  // namespace glint
