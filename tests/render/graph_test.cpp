// The graph of passes, from what each of them reads. No GL.
#include "render/graph.h"

#include "render/program.h"

#include <gtest/gtest.h>

namespace glint::graph_test {
namespace {

std::vector<Pass> passes(std::size_t count) {
    return std::vector<Pass>(count);
}

const GraphPass& at(const PassGraph& graph, std::size_t pass) {
    for (const GraphPass& p : graph.passes) {
        if (p.pass == pass) return p;
    }
    throw std::runtime_error("not in the graph");
}

PassReads reads(std::size_t pass, std::vector<std::size_t> buffers, bool changes = false) {
    return {.pass = pass, .buffers = std::move(buffers), .changes_by_itself = changes};
}

TEST(PassGraph, DrawsInTheOrderOfDeclarationsAndThePictureLast) {
    const PassGraph graph = build_graph(
        passes(5), {reads(kImagePass, {4, 1}), reads(4, {3}), reads(1, {}), reads(3, {})});
    ASSERT_EQ(graph.passes.size(), 4u);
    EXPECT_EQ(graph.passes[0].pass, 1u);
    EXPECT_EQ(graph.passes[1].pass, 3u);
    EXPECT_EQ(graph.passes[2].pass, 4u);
    EXPECT_EQ(graph.passes[3].pass, kImagePass);
    EXPECT_FALSE(graph.stateful);
}

TEST(PassGraph, ReadingAnEarlierPassSeesThisFrame) {
    const PassGraph graph =
        build_graph(passes(2), {reads(0, {}), reads(1, {0}), reads(kImagePass, {1})});
    for (const GraphPass& pass : graph.passes) {
        EXPECT_FALSE(pass.previous);
        EXPECT_FALSE(pass.feedback);
        EXPECT_FALSE(pass.feeds_state);
    }
    EXPECT_FALSE(graph.stateful);
}

TEST(PassGraph, ReadingALaterPassSeesThePreviousFrame) {
    const PassGraph graph =
        build_graph(passes(2), {reads(0, {1}), reads(1, {}), reads(kImagePass, {0})});
    EXPECT_TRUE(at(graph, 0).previous);
    EXPECT_FALSE(at(graph, 0).feedback)
        << "one buffer is enough: nobody reads it while it is drawn";
    EXPECT_FALSE(at(graph, 0).feeds_state);
    EXPECT_TRUE(at(graph, 1).feeds_state) << "a later frame needs it";
    EXPECT_TRUE(graph.stateful);
}

TEST(PassGraph, ReadingItselfIsFeedbackAndNeedsTwoBuffers) {
    const PassGraph graph = build_graph(passes(1), {reads(0, {0}), reads(kImagePass, {0})});
    EXPECT_TRUE(at(graph, 0).feedback);
    EXPECT_TRUE(at(graph, 0).previous);
    EXPECT_TRUE(at(graph, 0).feeds_state);
    EXPECT_FALSE(at(graph, kImagePass).previous);
    EXPECT_TRUE(graph.stateful);
}

TEST(PassGraph, WhatFeedsTheStateFeedsItThroughOthersToo) {
    // 0 → 1 → 2 (feedback) → picture; 3 is read by the picture alone.
    const PassGraph graph = build_graph(passes(4), {reads(0, {}), reads(1, {0}), reads(2, {1, 2}),
                                                    reads(3, {2}), reads(kImagePass, {2, 3})});
    EXPECT_TRUE(at(graph, 0).feeds_state);
    EXPECT_TRUE(at(graph, 1).feeds_state);
    EXPECT_TRUE(at(graph, 2).feeds_state);
    EXPECT_FALSE(at(graph, 1).carries) << "it is drawn anew before anybody reads it";
    EXPECT_TRUE(at(graph, 2).carries);
    EXPECT_FALSE(at(graph, 3).feeds_state);
    EXPECT_FALSE(at(graph, kImagePass).feeds_state);
}

TEST(PassGraph, AStepPassIsStateEvenWithoutFeedback) {
    std::vector<Pass> declared = passes(2);
    declared[1].step = {1, 240};
    const PassGraph graph =
        build_graph(declared, {reads(0, {}), reads(1, {0}), reads(kImagePass, {1})});
    EXPECT_TRUE(graph.stateful);
    EXPECT_TRUE(at(graph, 1).feeds_state);
    EXPECT_TRUE(at(graph, 0).feeds_state);
    EXPECT_EQ(at(graph, 1).runs, Runs::every_step);
    EXPECT_EQ(at(graph, kImagePass).runs, Runs::every_frame);
}

TEST(PassGraph, PassesRunAsOftenAsWhatTheyReadChanges) {
    struct {
        const char* what;
        std::vector<PassReads> reads;
        std::vector<Runs> expected;  // pass 0, pass 1, picture
    } const cases[] = {
        {"nothing changes",
         {reads(0, {}), reads(1, {0}), reads(kImagePass, {1})},
         {Runs::on_change, Runs::on_change, Runs::on_change}},
        {"the first reads time",
         {reads(0, {}, true), reads(1, {0}), reads(kImagePass, {1})},
         {Runs::every_frame, Runs::every_frame, Runs::every_frame}},
        {"the second reads time",
         {reads(0, {}), reads(1, {0}, true), reads(kImagePass, {1, 0})},
         {Runs::on_change, Runs::every_frame, Runs::every_frame}},
        {"the picture alone reads time",
         {reads(0, {}), reads(1, {0}), reads(kImagePass, {1}, true)},
         {Runs::on_change, Runs::on_change, Runs::every_frame}},
        {"the first reads itself",
         {reads(0, {0}), reads(1, {}), reads(kImagePass, {0, 1})},
         {Runs::every_frame, Runs::on_change, Runs::every_frame}},
        {"the two read each other",
         {reads(0, {1}), reads(1, {0}), reads(kImagePass, {})},
         {Runs::every_frame, Runs::every_frame, Runs::on_change}},
        {"the first reads the second, which is still",
         {reads(0, {1}), reads(1, {}), reads(kImagePass, {0})},
         {Runs::on_change, Runs::on_change, Runs::on_change}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.what);
        const PassGraph graph = build_graph(passes(2), c.reads);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_STREQ(to_string(graph.passes[i].runs), to_string(c.expected[i])) << i;
        }
    }
}

TEST(PassGraph, ALongChainSettles) {
    constexpr std::size_t kCount = 40;
    std::vector<PassReads> list = {reads(kImagePass, {0})};
    for (std::size_t i = 0; i < kCount; ++i) {
        list.push_back(i + 1 < kCount ? reads(i, {i + 1}) : reads(i, {i}, true));
    }
    const PassGraph graph = build_graph(passes(kCount), list);
    for (std::size_t i = 1; i < kCount; ++i) EXPECT_TRUE(at(graph, i).feeds_state) << i;
    for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(at(graph, i).runs, Runs::every_frame);
    EXPECT_FALSE(at(graph, 0).feeds_state);
}

TEST(PassGraph, AWantedBufferMayStandBeforeOneThatItReadsBack) {
    const PassGraph graph = build_graph(passes(2), {reads(0, {1}), reads(1, {0})});
    ASSERT_EQ(graph.passes.size(), 2u);
    EXPECT_EQ(graph.passes[0].pass, 0u);
    EXPECT_TRUE(graph.passes[0].previous);
    EXPECT_TRUE(graph.stateful);
}

}  // namespace
}  // namespace glint::graph_test
