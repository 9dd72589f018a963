// Jobs beside the thread that hands them over: in order, no more than have room, and what one
// throws reaches who waits.
#include "base/workers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <stdexcept>
#include <vector>

namespace glint::workers_test {
namespace {

TEST(Workers, OfOneThreadDoTheirJobsInOrder) {
    std::vector<int> done;
    Workers workers(1);
    for (int i = 0; i < 100; ++i) workers.run([&done, i] { done.push_back(i); });
    workers.finish();
    ASSERT_EQ(done.size(), 100u);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

TEST(Workers, OfSeveralThreadsDoAllOfThem) {
    std::atomic<int> sum = 0;
    Workers workers(4);
    for (int i = 1; i <= 1000; ++i) workers.run([&sum, i] { sum += i; });
    workers.finish();
    EXPECT_EQ(sum, 500500);
    workers.run([&sum] { sum = 0; });
    workers.finish();
    EXPECT_EQ(sum, 0) << "they go on after a pause";
}

TEST(Workers, HaveNoMoreJobsUnderWayThanIsAllowed) {
    std::atomic<int> alive = 0, most = 0;
    // Counts the jobs that hold something, those that wait for a thread too.
    struct Held {
        explicit Held(std::atomic<int>& count) : count_(count) { ++count_; }
        ~Held() { --count_; }
        std::atomic<int>& count_;
    };
    Workers workers(4);
    workers.limit(3);
    for (int i = 0; i < 200; ++i) {
        workers.wait_for_room();
        workers.run([held = std::make_shared<Held>(alive), &alive, &most] {
            most = std::max(most.load(), alive.load());
        });
    }
    workers.finish();
    EXPECT_EQ(alive, 0);
    EXPECT_GE(most, 1);
    EXPECT_LE(most, 3);
}

TEST(Workers, TellWhatAJobHasThrownAndDropTheRest) {
    std::promise<void> go;
    std::atomic<int> done = 0;
    Workers workers(1);
    workers.run([started = go.get_future().share()] {
        started.wait();
        throw std::runtime_error("the disk is full");
    });
    workers.run([&done] { ++done; });
    go.set_value();
    try {
        workers.finish();
        ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the disk is full");
    }
    EXPECT_THROW(workers.run([&done] { ++done; }), std::runtime_error) << "and again";
    EXPECT_THROW(workers.wait_for_room(), std::runtime_error);
    EXPECT_EQ(done, 0);
}

TEST(Workers, ThatGoBringWhatIsBegunToAnEndAndDropTheRest) {
    std::promise<void> begun, go;
    bool ended = false, other_done = false;
    {
        Workers workers(1);
        workers.run([&, may_end = go.get_future().share()] {
            begun.set_value();
            may_end.wait();
            ended = true;
        });
        // The first may end once the second is dropped, and no sooner.
        const auto let_end = [&go](void*) { go.set_value(); };
        workers.run(
            [&other_done, held = std::shared_ptr<void>(&go, let_end)] { other_done = true; });
        begun.get_future().wait();
    }
    EXPECT_TRUE(ended);
    EXPECT_FALSE(other_done);
}

}  // namespace
}  // namespace glint::workers_test
