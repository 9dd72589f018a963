// Threads that write pictures while the GPU draws the next ones.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace glint {

class Workers {
public:
    // One thread does its jobs in the order in which they come.
    explicit Workers(int threads);
    ~Workers();  // jobs that were begun are brought to an end, the others are dropped
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    // So many jobs at most are under way, those that wait for a thread too: what bounds memory.
    // More than two a thread, as without a limit, are never.
    void limit(std::size_t jobs);

    // Waits while there are as many. Throws what a job before has thrown; nothing more is done
    // then.
    void wait_for_room();

    // Hands a job over once there is room for it. Throws as wait_for_room() does.
    void run(std::function<void()> job);

    // Waits for all jobs. Throws what one of them has thrown.
    void finish();

private:
    void work();
    void rethrow();
    void wait_for_room(std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    std::size_t most_;
    std::size_t busy_ = 0;
    bool ends_ = false;
    std::exception_ptr failure_;  // the first
    std::vector<std::thread> threads_;
};

}  // namespace glint
