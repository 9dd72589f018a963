// A scene that has run for days shows what it showed when it was young, whatever its tweaks.
//
// Q1: at least 55 dB and at most 0.05 % of the pixels off by more than 1/255, 1.5 days, 30 days and
// a year later. All motion comes from iTick, which wraps after 65536 s: the same moment of that is
// the same picture. Simulations begin a quarter of a second before, and are seen some frames on.
// (`glint check` asks the same of every scene as it stands, and whether motion is still even.)
#include "bar.h"
#include "looks.h"

#include <cmath>

namespace glint::ageing_test {
namespace {

constexpr unsigned kCases = 80, kSimulatedCases = 16;

class Ageing : public GlTest, public testing::WithParamInterface<const char*> {};

void see_ages(Player& player, const std::string& look, double time, Bar& psnr, Bar& off) {
    set_look(player, look);
    const bool stateful = player.renderer().graph().stateful;
    const auto drawn = [&](double at) {
        if (stateful) player.renderer().reset();
        for (int k = 0; k < (stateful ? 8 : 1); ++k) {
            Frame frame = player.frame(k);
            frame.time = at + k / 60.0;
            frame.longest_catch_up = 0.25;  // s
            player.draw(frame);
        }
        return player.floats();
    };
    const std::vector<float> young = drawn(time);
    for (const double age : {2.0 * 65536, 40.0 * 65536, 482.0 * 65536}) {
        const std::vector<float> old = drawn(time + age);
        double squares = 0.0, apart = 0.0;
        for (std::size_t i = 0; i < old.size(); ++i) {
            const double d = double{old[i]} - young[i];
            squares += d * d;
            apart += !(std::abs(d) <= 1.0 / 255.0);
        }
        const auto count = static_cast<double>(old.size());
        const std::string where = fmt::format("{} at {:.1f} + {} s", look, time, age);
        psnr.see(-10.0 * std::log10(squares / count + 1e-12), where);
        off.see(100.0 * apart / count, where);
    }
}

// Every tweak but those of quality, which have nothing to do with time, and of the camera.
TEST_P(Ageing, ShowsTheSamePictureWhateverTheCase) {
    const std::string scene = GetParam();
    Player player("#include \"" GLINT_REPOSITORY "/fragments/" + scene + ".frag\"\n",
                  {.size = {48, 27}, .specialise = false});
    Bar psnr("Q1 " + scene + ": after 1.5 to 365 days, dB", 55.0, Bar::Side::at_least);
    Bar off("Q1 " + scene + ": pixels off by 1/255, %", 0.05);
    std::vector<std::string> names;
    for (const Tweak& tweak : player.preset.scene.tweaks) {
        const bool still = tweak.quality || tweak.group == "Camera" || tweak.group == "Quality";
        if (!still && !tweak.no_random && tweak.names.empty()) names.push_back(tweak.name);
    }
    see_ages(player, "", 5.0, psnr, off);
    search_worst(numbers_of(player.preset.scene, names) + 1,
                 player.renderer().graph().stateful ? kSimulatedCases : kCases, {&psnr, &off},
                 [&](Dials& dials) {
                     const std::string look = look_at(player.preset.scene, names, dials);
                     see_ages(player, look, dials.between(2.0, 1000.0), psnr, off);
                 });
}
INSTANTIATE_TEST_SUITE_P(Scenes, Ageing,
                         testing::Values("analytic", "boat", "caustics", "christmas", "deep_ocean",
                                         "magic", "sea", "terrain", "water"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace glint::ageing_test
