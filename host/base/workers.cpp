#include "base/workers.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace glint {

Workers::Workers(int threads) : most_(2 * static_cast<std::size_t>(std::max(threads, 1))) {
    // Where processes are rationed, by a container or `ulimit -u`, fewer do.
    try {
        for (std::size_t i = 0; i < most_ / 2; ++i) threads_.emplace_back([this] { work(); });
    } catch (const std::system_error& error) {
        if (threads_.empty())
            throw std::runtime_error(
                fmt::format("No thread can be started: {}; the limits of "
                            "processes or of memory are too low.",
                            error.code().message()));
    }
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Workers::limit(std::size_t jobs) {
    const std::lock_guard lock(mutex_);
    most_ = std::min(most_, std::max<std::size_t>(jobs, 1));
}

void Workers::wait_for_room(std::unique_lock<std::mutex>& lock) {
    changed_.wait(lock, [&] { return waiting_.size() + busy_ < most_ || failure_; });
    rethrow();
}

void Workers::wait_for_room() {
    std::unique_lock lock(mutex_);
    wait_for_room(lock);
}

void Workers::run(std::function<void()> job) {
    std::unique_lock lock(mutex_);
    wait_for_room(lock);
    waiting_.push_back(std::move(job));
    changed_.notify_all();
}

void Workers::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return (waiting_.empty() && busy_ == 0) || failure_; });
    rethrow();
}

void Workers::rethrow() {
    if (failure_) std::rethrow_exception(failure_);
}

void Workers::work() {
    // Where software draws, its threads go first and this work fills their gaps: 9 % more frames.
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10);
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return !waiting_.empty() || ends_; });
        if (ends_) return;
        std::function<void()> job = std::move(waiting_.front());
        waiting_.pop_front();
        ++busy_;
        changed_.notify_all();
        lock.unlock();
        std::exception_ptr failure;
        try {
            job();
        } catch (...) {
            failure = std::current_exception();
        }
        job = nullptr;  // what it holds is gone before there is room for the next
        lock.lock();
        --busy_;
        if (failure && !failure_) {
            failure_ = failure;
            waiting_.clear();
        }
        changed_.notify_all();
    }
}

}  // namespace glint
