// Pictures that stand for scenes until they draw, and what a person chose of their resolution.
#include "window/live/kept_pictures.h"

#include "../../base/test_folder.h"
#include "window/live/kept_resolutions.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace glint::kept_pictures_test {
namespace {

namespace fs = std::filesystem;

// Of noise, which no PNG makes smaller.
Image noise(int side, unsigned seed) {
    Image image{.size = {side, side}, .channels = 3, .pixels = {}};
    image.pixels.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3);
    for (std::byte& byte : image.pixels)
        byte = static_cast<std::byte>((seed = seed * 1664525u + 1013904223u) >> 24);
    return image;
}

// All of them written, when this returns.
void keep(const fs::path& folder, const fs::path& place, const Image& image,
          std::uintmax_t most = 1 << 20) {
    KeptPictures(folder, most).keep(place, image);
}

std::uintmax_t bytes_in(const fs::path& folder) {
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder)) bytes += entry.file_size();
    return bytes;
}

TEST(KeptPictures, WhatWasKeptIsFoundByItsPlaceInTheNextRun) {
    const TestFolder folder;
    const fs::path cache = folder.path() / "cache/pictures";
    const Image red = noise(8, 1), blue = noise(8, 2);
    keep(cache, "/home/ada/red.frag", red);
    keep(cache, "/home/ada/blue.frag", blue);
    keep(cache, "/home/ada/red.frag", blue);
    const KeptPictures kept(cache);
    EXPECT_EQ(read_image(kept.find("/home/ada/red.frag")).pixels, blue.pixels);
    EXPECT_EQ(read_image(kept.find("/home/ada/blue.frag")).pixels, blue.pixels);
    EXPECT_EQ(kept.find("/home/ada/green.frag"), "");
}

TEST(KeptPictures, TheOldestGoWhereAllTogetherWouldBeTooLarge) {
    const TestFolder folder;
    constexpr std::uintmax_t kMost = 40000;  // bytes; each picture has 12,000
    for (int i = 0; i < 6; ++i) {
        keep(folder.path(), std::to_string(i), noise(64, static_cast<unsigned>(i)), kMost);
        std::this_thread::sleep_for(std::chrono::milliseconds(12));  // file systems count in ticks
    }
    EXPECT_LE(bytes_in(folder.path()), kMost);
    const KeptPictures kept(folder.path());
    EXPECT_EQ(kept.find("0"), "");
    EXPECT_EQ(kept.find("2"), "");
    for (const char* place : {"3", "4", "5"}) EXPECT_NE(kept.find(place), "") << place;
}

TEST(KeptPictures, NothingIsLeftOfOneThatCannotBeWritten) {
    const TestFolder folder;
    folder.write("file", "no folder");
    keep(folder.path() / "file", "a", noise(8, 1));
    EXPECT_EQ(KeptPictures(folder.path() / "file").find("a"), "");
    keep(folder.path() / "cache", "a", noise(64, 1), 100);  // larger than all may be
    EXPECT_TRUE(fs::is_empty(folder.path() / "cache"));
}

TEST(KeptPictures, AShippedPresetHasThatOfTheGallery) {
    const TestFolder folder;
    const fs::path preset = fs::path(GLINT_REPOSITORY) / "presets/boat.toml";
    EXPECT_EQ(KeptPictures(folder.path()).find(preset).filename(), "boat.jpg");
}

TEST(KeptResolutions, AChoiceIsThatOfOneSceneAndTheNewestCounts) {
    const TestFolder folder;
    const fs::path file = folder.path() / "state/resolution";
    const KeptResolutions kept(file);
    EXPECT_FALSE(kept.find("/a b.frag"));
    kept.keep("/a b.frag", {.full = true, .share = 0.25});
    kept.keep("/c.frag", {.full = false, .share = 0.5});
    kept.keep("/a b.frag", {.full = false, .refines = false, .share = 0.375});
    EXPECT_EQ(KeptResolutions(file).find("/a b.frag"),
              (KeptResolution{.full = false, .refines = false, .share = 0.375}));
    EXPECT_EQ(KeptResolutions(file).find("/c.frag"), (KeptResolution{.full = false, .share = 0.5}));
}

TEST(KeptResolutions, AHundredAreKeptAndABrokenFileIsNone) {
    const TestFolder folder;
    const fs::path file =
        folder.write("resolution", "\n\nfull\nheld x y\nfull refined 0.5 /whole.frag\n");
    const KeptResolutions kept(file);
    EXPECT_EQ(kept.find("/whole.frag"), (KeptResolution{.full = true, .share = 0.5}));
    for (int i = 0; i < 130; ++i) kept.keep(std::to_string(i), {.full = true, .share = 1.0});
    EXPECT_TRUE(kept.find("129"));
    EXPECT_TRUE(kept.find("30"));
    EXPECT_FALSE(kept.find("29"));
    EXPECT_FALSE(kept.find("/whole.frag"));
}

}  // namespace
}  // namespace glint::kept_pictures_test
