// The curves of what buffers promise.
#include "measure/rows/curve.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace glint {
namespace {

TEST(InvariantCurve, KeepsSomeHundredPointsOfAnyNumberOfFramesAndLosesNoExtreme) {
    for (const int frames : {1, 255, 256, 257, 2000, 216'000}) {
        InvariantCurve curve;
        for (int k = 0; k < frames; ++k)
            curve.add({k, k == frames / 3 ? -7.0 : 0.0, k == frames / 2 ? 9.0 : 1.0,
                       k == frames / 5 ? 0.5 : 0.0});
        EXPECT_LE(curve.points.size(), 256u);
        EXPECT_GE(curve.points.size(),
                  std::min<std::size_t>(static_cast<std::size_t>(frames), 128));
        EXPECT_EQ(curve.points.back().frame, frames - 1);
        int held = 0;
        double low = 0.0, high = 0.0, drift = 0.0;
        for (const InvariantCurve::Point& p : curve.points) {
            held += p.frames;
            EXPECT_EQ(p.frame, held - 1) << "points follow each other";
            low = std::min(low, p.low);
            high = std::max(high, p.high);
            drift = std::max(drift, p.drift);
        }
        EXPECT_EQ(low, -7.0);
        EXPECT_EQ(high, 9.0);
        EXPECT_EQ(drift, 0.5);
    }
}

TEST(InvariantCurve, IsTheSameBehindJson) {
    InvariantCurve curve{.buffer = "waves", .bounded = {{-1.0, 2.5}}, .conserves = 1e-6};
    curve.add({0, -0.5, 0.25, 1e-9});
    curve.add({1, -0.5, 2.0, 2e-9});
    const InvariantCurve read = curve_from_json(to_json(curve));
    EXPECT_EQ(read.buffer, "waves");
    EXPECT_EQ(read.bounded, curve.bounded);
    EXPECT_EQ(read.conserves, curve.conserves);
    ASSERT_EQ(read.points.size(), 2u);
    EXPECT_EQ(read.points[1].frame, 1);
    EXPECT_EQ(read.points[1].high, 2.0);
    EXPECT_FLOAT_EQ(static_cast<float>(read.points[1].drift), 2e-9f);
    const InvariantCurve none = curve_from_json(to_json(InvariantCurve{.buffer = "smoke"}));
    EXPECT_FALSE(none.bounded || none.conserves);
}

}  // namespace
}  // namespace glint
