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

    // Hands a job over; waits while one a thread waits already, so that memory stays bounded.
    // Throws what a job before has thrown; nothing more is done then.
    void run(std::function<void()> job);

    // Waits for all jobs. Throws what one of them has thrown.
    void finish();

private:
    void work();
    void rethrow();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    std::size_t most_waiting_;
    int busy_ = 0;
    bool ends_ = false;
    std::exception_ptr failure_;  // the first
    std::vector<std::thread> threads_;
};

}  // namespace glint
