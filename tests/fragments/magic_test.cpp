// The hall of fragments/magic.frag, in figures.
#include "../render/fixture.h"

#include <cmath>

namespace glint::magic_test {
namespace {

using Magic = GlTest;

// Where haze is sampled differs from pixel to pixel, so that neighbours' errors cancel: a mean over
// 3 x 3 pixels leaves less of them than the third that it leaves of chance. (0.26; chance 0.33.)
TEST_F(Magic, ErrorsOfShadowsInTheHazeCancelBetweenNeighbours) {
    constexpr glm::ivec2 kSize{128, 72};
    const auto picture = [kSize](int samples) {
        Player player(
            "#include \"" GLINT_REPOSITORY "/fragments/magic.frag\"\n",
            {.size = kSize,
             .preset = fmt::format("[tweaks]\nhaze = 0.03\nshafts = true\nfillLight = 0.0\n"
                                   "glowSamples = {}\n",
                                   samples)});
        player.still(0.0);
        return player.floats();
    };
    const std::vector<float> shown = picture(8), reference = picture(32);
    const auto error = [&](int x, int y) {
        const auto i = static_cast<std::size_t>(y * kSize.x + x) * 4 + 2;
        return double{shown[i]} - reference[i];
    };
    double one = 0.0, nine = 0.0;
    for (int y = 1; y + 1 < kSize.y; ++y) {
        for (int x = 1; x + 1 < kSize.x; ++x) {
            double mean = 0.0;
            for (int k = 0; k < 9; ++k) mean += error(x + k % 3 - 1, y + k / 3 - 1) / 9.0;
            one += error(x, y) * error(x, y);
            nine += mean * mean;
        }
    }
    fmt::print("a ninth's error is {:.3f} of a pixel's\n", std::sqrt(nine / one));
    EXPECT_LE(std::sqrt(nine / one), 0.29);
}

}  // namespace
}  // namespace glint::magic_test
