// What a study keeps in its folder, so that a call that was stopped goes on.
#include "../base/test_folder.h"
#include "measure/study/store.h"

#include <gtest/gtest.h>

namespace glint::study_store_test {
namespace {

namespace fs = std::filesystem;

const StudyKey kKey{.name = "scene-steps-4", .text = "all that it depends on"};
const StudyKey kOther{.name = "scene-steps-4", .text = "another seed"};
constexpr glm::ivec2 kSize{2, 1};
const std::vector<float> kPicture = {0.1f, 0.2f, 0.3f, 1.0f, 4.0f, -1.0f, 1e-9f, 1.0f};

TEST(StudyStore, ARowComesBackWithAllThatWasMeasured) {
    const TestFolder folder;
    const StudyRow row{.value = "4",
                       .work = 4.0,
                       .error = Difference{.rmse = 0.1 / 3, .psnr = 20.0 / 3},
                       .is_reference = true};
    StudyStore(folder.path()).keep(kKey, row);
    const auto found = StudyStore(folder.path()).row(kKey, kSize);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->resumed);
    EXPECT_EQ(found->work, row.work);
    EXPECT_EQ(found->error->rmse, row.error->rmse);
    EXPECT_TRUE(found->is_reference);
}

TEST(StudyStore, TimesComeBackRoundByRound) {
    const TestFolder folder;
    const FrameTimes row{.wall = {1.0 / 3, 0.5}, .gpu = {0.25, 0.125}, .processor = {2.0 / 3, 1}};
    const StudyStore store(folder.path());
    store.keep(kKey, Rounds{.rows = {row, {}}, .all_passes = {1.0 / 7, 0.0}, .look = 2});
    const auto found = store.rounds(kKey);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->look, 2);
    EXPECT_EQ(found->all_passes[0], 1.0 / 7);
    ASSERT_EQ(found->rows.size(), 2u);
    EXPECT_EQ(found->rows[0].wall, row.wall);
    EXPECT_EQ(found->rows[0].gpu, row.gpu);
    EXPECT_EQ(found->rows[0].processor, row.processor);
    EXPECT_FALSE(store.rounds(kOther));
}

TEST(StudyStore, ARowOfAnotherKeyIsNotTakenForIt) {
    const TestFolder folder;
    const StudyStore store(folder.path());
    store.keep(kKey, {.value = "4"});
    EXPECT_TRUE(store.row(kKey, kSize));
    EXPECT_FALSE(store.row(kOther, kSize));
    // Nor where the digests of both, which name the files, were the same.
    const fs::directory_iterator only(folder.path() / "data");
    const fs::path file = only->path();
    store.keep(kOther, {.value = "4"});
    fs::path other;
    for (const auto& entry : fs::directory_iterator(folder.path() / "data"))
        if (entry.path() != file) other = entry.path();
    fs::copy_file(file, other, fs::copy_options::overwrite_existing);
    EXPECT_FALSE(store.row(kOther, kSize));
}

TEST(StudyStore, ARowIsAsWholeAsItsPictures) {
    const TestFolder folder;
    const StudyStore store(folder.path());
    StudyRow row{.value = "4"};
    row.picture = store.keep_picture(kKey, kPicture, kSize);
    row.map = store.keep_map(kKey, kPicture, kPicture, kSize, Values::display);
    row.flip_map = store.keep_flip_map(kKey, std::vector<float>(kPicture.size() / 4), kSize);
    store.keep(kKey, row);
    ASSERT_TRUE(store.row(kKey, kSize));
    EXPECT_EQ(store.row(kKey, kSize)->picture, row.picture);
    EXPECT_EQ(store.picture(kKey, kSize), kPicture) << "exact";
    EXPECT_FALSE(store.row(kKey, {1, 1})) << "of another size";
    for (const std::string& map : {row.map, row.flip_map}) {
        fs::rename(folder.path() / map, folder.path() / "away");
        EXPECT_FALSE(store.row(kKey, kSize)) << "without " << map;
        fs::rename(folder.path() / "away", folder.path() / map);
    }
}

TEST(StudyStore, WithoutAFolderNothingIsKept) {
    const StudyStore store("");
    store.keep(kKey, {.value = "4"});
    EXPECT_EQ(store.keep_picture(kKey, kPicture, kSize), "");
    EXPECT_FALSE(store.row(kKey, kSize));
    EXPECT_FALSE(store.picture(kKey, kSize));
}

TEST(StudyKeys, DifferWhereAValueOrTheFramesDo) {
    Preset preset;
    preset.scene.tweaks.emplace_back().name = "a";
    const Setting setting{.values = {{0.5}}, .settle = 0};
    const std::string key = key_of_setting(preset, setting);
    EXPECT_EQ(key, key_of_setting(preset, setting));
    EXPECT_NE(key, key_of_setting(preset, {.values = {{0.5000001}}, .settle = 0}));
    EXPECT_NE(key, key_of_setting(preset, {.values = {{0.5}}, .settle = 1}));
    preset.scene.passes.emplace_back().name = "waves";
    Setting other = setting;
    other.format = {0, PixelFormat::r16f};
    EXPECT_NE(key, key_of_setting(preset, other));
}

}  // namespace
}  // namespace glint::study_store_test
