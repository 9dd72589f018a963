// Pictures that come back later are the pictures that were drawn, in order.
#include "render/readback.h"

#include "fixture.h"

namespace glint::readback_test {
namespace {

class ReadbackTest : public GlTest {};

constexpr std::string_view kCountsFrames =
    "void mainImage(out vec4 c, vec2 p) { c = vec4(p / 255.0, float(iFrame) / 255.0, 1); }\n";

TEST_F(ReadbackTest, PicturesOnTheWayAreNotDrawnOver) {
    for (const bool floats : {false, true}) {
        for (const int ahead : {0, 1, 3}) {
            SCOPED_TRACE(ahead);
            Player player(
                kCountsFrames,
                {.size = {5, 3}, .format = floats ? PixelFormat::rgba32f : PixelFormat::rgba8});
            Readback readback(player.renderer(), floats, ahead);
            std::vector<std::vector<std::byte>> expected;
            int taken = 0;
            const auto expect_next = [&] {
                EXPECT_EQ(readback.take(), expected.at(static_cast<std::size_t>(taken++)));
            };
            for (int k = 0; k < 9; ++k) {
                player.draw(k);
                expected.emplace_back(5u * 3 * 4 * (floats ? sizeof(float) : 1));
                player.renderer().read_picture(floats, expected.back().data());
                readback.send();
                EXPECT_EQ(readback.full(), k >= ahead);
                if (readback.full()) expect_next();
            }
            while (taken < 9) expect_next();
            EXPECT_NE(expected.front(), expected.back());
        }
    }
}

}  // namespace
}  // namespace glint::readback_test
