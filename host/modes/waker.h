// Ends the window's wait for events when a file was saved or a trial has answered.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace glint {

class Waker {
public:
    // `wake` is called from another thread.
    explicit Waker(std::function<void()> wake);
    ~Waker();
    Waker(const Waker&) = delete;
    Waker& operator=(const Waker&) = delete;

    // From now on, calls `wake` once as soon as one of these descriptors is readable; -1 is passed
    // over.
    void arm(const std::vector<int>& descriptors);

private:
    void run();

    std::function<void()> wake_;
    int changed_ = -1;  // an eventfd that ends the thread's own wait
    std::mutex mutex_;
    std::vector<int> descriptors_;
    bool armed_ = false, stop_ = false;
    std::thread thread_;
};

}  // namespace glint
