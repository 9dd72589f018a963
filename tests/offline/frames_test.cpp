// Which frames a sequence is asked for.
#include "offline/frames.h"

#include "offline/common.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace glint::frames_test {
namespace {

std::vector<int> list(const std::string& text, const std::string& shard = "", double fps = 60.0) {
    const Frames frames = frames_of(text, shard, fps);
    std::vector<int> numbers;
    for (std::int64_t i = 0; i < frames.count; ++i) numbers.push_back(frames[i]);
    return numbers;
}

TEST(Frames, BothEndsBelongToThem) {
    EXPECT_EQ(list("3:6"), (std::vector{3, 4, 5, 6}));
    EXPECT_EQ(list("3:3"), (std::vector{3}));
    EXPECT_EQ(list("3:11:4"), (std::vector{3, 7, 11}));
    EXPECT_EQ(list("3:10:4"), (std::vector{3, 7}));
    EXPECT_EQ(list("3:10:2000000000"), (std::vector{3}));
    EXPECT_EQ(list("", "", 2.5).size(), 25u) << "ten seconds";
    EXPECT_EQ(list("", "", 0.01), (std::vector{0}));
}

TEST(Frames, SharesHaveEachFrameOnce) {
    for (const std::string text : {"5:29", "5:29:3", "7:7"}) {
        for (const int count : {1, 2, 7, 40}) {
            SCOPED_TRACE(text + " in " + std::to_string(count));
            std::multiset<int> together;
            for (int k = 1; k <= count; ++k) {
                const std::vector<int> share =
                    list(text, std::to_string(k) + "/" + std::to_string(count));
                together.insert(share.begin(), share.end());
            }
            const std::vector<int> all = list(text);
            EXPECT_EQ(together, std::multiset<int>(all.begin(), all.end()));
        }
    }
    EXPECT_EQ(list("10:20", "2/4"), (std::vector{11, 15, 19}));
}

TEST(Frames, TheLargestNumbersDoNotWrap) {
    const Frames all = frames_of("0:1073741824", "", 60.0);
    EXPECT_EQ(all.count, 1073741825);
    EXPECT_EQ(all.last(), 1073741824);
    const Frames share = frames_of("0:1073741824:2147483647", "2147483647/2147483647", 60.0);
    EXPECT_EQ(share.count, 0);
    EXPECT_EQ(share.last(), 0);
}

TEST(Frames, WhatMakesNoSenseIsAUsageError) {
    for (const std::string text : {"5", "5:2", "-1:2", "0:9:0", "0:9:-1", "0:9:1:1", "0:", ":9",
                                   "a:b", "0:9x", "0 :9", "0:1073741825", "0:99999999999"}) {
        EXPECT_THROW(frames_of(text, "", 60.0), UsageError) << text;
    }
    for (const std::string shard : {"0/3", "4/3", "3", "1/", "/3", "-1/3", "1/2/3"}) {
        EXPECT_THROW(frames_of("0:9", shard, 60.0), UsageError) << shard;
    }
}

}  // namespace
}  // namespace glint::frames_test
