// A simulation that was played up to its start stands there in the next run.
#include "window/live/start_states.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>

namespace glint::start_states_test {
namespace {

namespace fs = std::filesystem;

Preset simulation(double time) {
    Preset preset;
    preset.scene.files = {"scene.frag"};
    preset.scene.text = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0); }\n";
    preset.time = time;
    return preset;
}

Snapshot state(float value) {
    const std::vector<float> texels(3 * 2 * 4 * 2, value);
    const auto bytes = std::as_bytes(std::span(texels));
    return {.frame = 540,
            .time = 9.0,
            .renderer = "any",
            .provenance = {},
            .passes = {{.pass = "waves",
                        .shape = {.size = {3, 2}, .feedback = true},
                        .steps_done = 540,
                        .bytes = {bytes.begin(), bytes.end()}}}};
}

// As one run leaves it.
void keep(const fs::path& folder, const Preset& preset, float value) {
    StartStates states(folder);
    states.read(preset, "any");
    EXPECT_FALSE(states.take());
    states.keep(state(value));
}

std::optional<Snapshot> find(const fs::path& folder, const Preset& preset,
                             const std::string& renderer = "any") {
    StartStates states(folder);
    states.read(preset, renderer);
    return states.take();
}

TEST(StartStates, TheNextRunStandsWhereThisOneBegan) {
    const TestFolder folder;
    const fs::path cache = folder.path() / "cache/states";
    keep(cache, simulation(9.0), 0.25f);
    const std::optional<Snapshot> found = find(cache, simulation(9.0));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->frame, 540);
    ASSERT_EQ(found->passes.size(), 1u);
    EXPECT_EQ(found->passes[0].bytes, state(0.25f).passes[0].bytes);
    EXPECT_EQ(found->passes[0].steps_done, 540);
}

TEST(StartStates, WhatWouldBeSimulatedOtherwiseIsAnother) {
    const TestFolder folder;
    keep(folder.path(), simulation(9.0), 0.25f);
    EXPECT_FALSE(find(folder.path(), simulation(8.0)));
    EXPECT_FALSE(find(folder.path(), simulation(9.0), "another GPU"));
    Preset edited = simulation(9.0);
    edited.scene.text += " ";
    EXPECT_FALSE(find(folder.path(), edited));
    EXPECT_TRUE(find(folder.path(), simulation(9.0)));
}

TEST(StartStates, ADamagedFileIsNone) {
    const TestFolder folder;
    keep(folder.path(), simulation(9.0), 0.25f);
    for (const auto& entry : fs::directory_iterator(folder.path()))
        fs::resize_file(entry.path(), entry.file_size() / 2);
    EXPECT_FALSE(find(folder.path(), simulation(9.0)));
}

TEST(StartStates, NothingIsKeptWithoutAFolderOrAtTheStartOfTime) {
    const TestFolder folder;
    StartStates none{""};
    none.read(simulation(9.0), "any");
    none.keep(state(1.0f));
    EXPECT_FALSE(none.take());
    keep(folder.path(), simulation(0.0), 0.5f);
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace glint::start_states_test
