// No knob of quality is there for nothing: each changes some preset's picture.
#include "probe.h"

#include <cmath>
#include <set>

namespace glint {
namespace {

class Knobs : public GlTest, public testing::WithParamInterface<const char*> {};

std::vector<std::filesystem::path> presets_of(const std::string& scene) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(GLINT_REPOSITORY "/presets")) {
        const std::string name = entry.path().stem().string();
        if (name == scene || name.starts_with(scene + "-")) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

// By the least value and the greatest, of each quality tweak alone, in any preset, after a second.
TEST_P(Knobs, EachChangesThePictureWhateverTheCase) {
    const std::string scene = GetParam();
    Player player("#include \"" GLINT_REPOSITORY "/fragments/" + scene + ".frag\"\n",
                  {.size = {48, 27}, .specialise = false});
    const auto& tweaks = player.preset.scene.tweaks;
    const auto picture = [&] {
        player.renderer().reset();
        player.still(1.0);
        return player.floats();
    };
    std::set<std::string> idle;
    for (const Tweak& tweak : tweaks)
        if (tweak.quality) idle.insert(tweak.name);
    for (const auto& file : presets_of(scene)) {
        const ReadPreset read = read_preset(file);
        ASSERT_TRUE(read.preset) << to_text(read.diagnostics);
        player.preset.values = read.preset->values;
        const std::vector<float> usual = picture();
        for (std::size_t i = 0; i < tweaks.size(); ++i) {
            for (const double end : {-1e9, 1e9}) {
                if (!idle.contains(tweaks[i].name)) break;
                TweakValue value;
                value.fill(end);
                player.preset.values[i] = clamp_to_range(tweaks[i], value);
                if (picture() != usual) idle.erase(tweaks[i].name);
                player.preset.values = read.preset->values;
            }
        }
    }
    for (const std::string& name : idle) ADD_FAILURE() << name << " changes no preset of " << scene;
}
INSTANTIATE_TEST_SUITE_P(Scenes, Knobs,
                         testing::Values("analytic", "boat", "caustics", "christmas", "deep_ocean",
                                         "magic", "sea", "terrain", "water"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace glint
