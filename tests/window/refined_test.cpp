// What rests in the window becomes the still of 64 samples: of all nine scenes.
#include "live.h"

#include <fmt/format.h>

namespace glint::window::refined_test {
namespace {

class Refined : public Window, public ::testing::WithParamInterface<const char*> {
protected:
    Refined() {
        counts_pixels_ = false;  // as for a person
        screen_size_ = {480, 270};
    }
};

TEST_P(Refined, APausedSceneBecomesItsStillOf64Samples) {
    const fs::path preset = repository() / "presets" / fmt::format("{}.toml", GetParam());
    const std::vector<std::string> size = {"--size", "480x270"};
    start({"open", preset.string(), size[0], size[1]});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+r");
    screen_->tap("Tab");
    const Image wanted =
        read_image(still({size[0], size[1], "--samples", "64", "--time", "0"}, preset));
    constexpr int kRows = 190;  // below stand words
    // The samples are added in another order: the last digits of the sums.
    EXPECT_TRUE(eventually([&] { return largest_difference(wanted, kRows) <= 1; }, 240.0))
        << largest_difference(wanted, kRows);
}
INSTANTIATE_TEST_SUITE_P(Scenes, Refined,
                         ::testing::Values("analytic", "boat", "caustics", "christmas",
                                           "deep_ocean", "magic", "sea", "terrain", "water"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace glint::window::refined_test
