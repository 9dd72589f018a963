// A name that leads nowhere, and the file that was meant.
#include "base/nearest_file.h"

#include "base/diagnostic.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

namespace glint::nearest_file_test {
namespace {

namespace fs = std::filesystem;

class NearestFile : public testing::Test {
protected:
    NearestFile() {
        for (const char* file :
             {"presets/boat.toml", "presets/boat-storm.toml", "presets/sea.toml",
              "fragments/boat.frag", "fragments/water.frag", "wood.png", "notes.txt"})
            made_.write(file, "x");
    }

    std::string meant(const fs::path& name) const {
        const fs::path found = nearest_file(folder_ / name);
        return found.empty() ? "" : found.lexically_relative(folder_).string();
    }

    TestFolder made_;
    fs::path folder_ = made_.path();
};

TEST_F(NearestFile, IsFoundByLettersEndingAndFolder) {
    const std::pair<const char*, const char*> cases[] = {
        {"presets/baot.toml", "presets/boat.toml"},  // two letters swapped
        {"presets/boat-strom.toml", "presets/boat-storm.toml"},
        {"presets/boat.tml", "presets/boat.toml"},  // another ending
        {"wood.jpg", "wood.png"},
        {"presets/boat", "presets/boat.toml"},  // none
        {"fragments/water", "fragments/water.frag"},
        {"presets/baot", "presets/boat.toml"},
        {"fragments/watre", "fragments/water.frag"},
        {"boat.toml", "presets/boat.toml"},  // a folder too high
        {"boat", "presets/boat.toml"},
        {"presets/boat.frag", "fragments/boat.frag"},  // in the folder beside
        {"preset/sea.toml", "presets/sea.toml"},       // a folder that is mistyped
        {"preset/see.toml", "presets/sea.toml"},
        {"presets/xyzzy.toml", ""},
        {"nowhere/at/all.toml", ""},
        {"notes.txt/boat.toml", ""},
    };
    for (const auto& [name, file] : cases) EXPECT_EQ(meant(name), file) << name;
}

TEST_F(NearestFile, AnythingMayBeAsked) {
    for (const char* name : {"", ".", "..", "/", "//", "presets/", "a/b/c/d/e/f"})
        (void)nearest_file(name);
    EXPECT_EQ(nearest_file(std::string(5000, 'a')), "");
}

TEST_F(NearestFile, AFolderOfThousandsIsNotSearched) {
    for (int i = 0; i < 1100; ++i) std::ofstream(folder_ / "presets" / std::to_string(i)) << "x";
    EXPECT_EQ(meant("presets/baot.toml"), "");
}

TEST(DidYouMean, SwappedLettersAreOneMistake) {
    const std::vector<std::string> verbs = {"new", "still", "sound"};
    EXPECT_EQ(nearest("nwe", verbs), "new");
    EXPECT_EQ(nearest("stlil", verbs), "still");
    EXPECT_EQ(nearest("xyz", verbs), "");
    EXPECT_EQ(nearest("STILL", verbs), "still");
}

}  // namespace
}  // namespace glint::nearest_file_test
