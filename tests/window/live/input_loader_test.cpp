// Input files that are read beside the thread that draws.
#include "window/live/input_loader.h"

#include "../../base/test_folder.h"
#include "media/image.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <optional>

namespace glint::input_loader_test {
namespace {

namespace fs = std::filesystem;

class InputLoaders : public testing::Test {
protected:
    Sampler picture(const std::string& name, int grey) const {
        write(name, grey);
        Sampler sampler;
        sampler.name = name;
        sampler.source = Source::image;
        sampler.files = {file(name)};
        return sampler;
    }
    fs::path file(const std::string& name) const { return folder_ / (name + ".png"); }
    void write(const std::string& name, int grey) const {
        write_image(file(name), {.size = {1, 1},
                                 .channels = 1,
                                 .type = ChannelType::u8,
                                 .pixels = {static_cast<std::byte>(grey)}});
    }

    // What comes until nothing more is to come, by the sampler's name: a grey, or -1.
    std::vector<std::pair<std::string, int>> all_of(InputLoader& loader) const {
        std::vector<std::pair<std::string, int>> list;
        while (loader.is_reading() || loader.is_loading()) {
            pollfd end{.fd = loader.descriptor(), .events = POLLIN, .revents = 0};
            if (::poll(&end, 1, 30'000) != 1) break;
            for (const auto& loaded : loader.take()) {
                const int grey = loaded.input ? std::to_integer<int>(loaded.input->bytes[0]) : -1;
                list.emplace_back(loaded.sampler.name, grey);
                errors_ += loaded.error;
            }
        }
        std::sort(list.begin(), list.end());
        return list;
    }

    TestFolder made_;
    fs::path folder_ = made_.path();
    mutable std::string errors_;
};

using Greys = std::vector<std::pair<std::string, int>>;

// Keeps whoever opens a file waiting, as a slow disk does.
class Slow {
public:
    explicit Slow(const fs::path& file) : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
        ::signal(SIGIO, SIG_IGN);
        works_ = ::fcntl(descriptor_, F_SETLEASE, F_WRLCK) == 0;
    }
    ~Slow() { ::close(descriptor_); }
    Slow(const Slow&) = delete;
    Slow& operator=(const Slow&) = delete;
    bool works() const { return works_; }
    void end() { ::fcntl(descriptor_, F_SETLEASE, F_UNLCK); }

private:
    int descriptor_;
    bool works_;
};

TEST_F(InputLoaders, ManyAtOnceComeEachWithItsOwnContent) {
    InputLoader loader{TextureLimits{}};
    Greys wanted;
    for (int i = 0; i < 9; ++i) {
        wanted.emplace_back(std::string(1, static_cast<char>('a' + i)), i * 10);
        loader.load(picture(wanted.back().first, i * 10));
    }
    EXPECT_TRUE(loader.is_loading());
    EXPECT_EQ(all_of(loader), wanted);
    EXPECT_FALSE(loader.is_loading());
}

TEST_F(InputLoaders, WhatCannotBeReadSaysWhyAndTheOthersCome) {
    InputLoader loader{TextureLimits{}};
    Sampler gone = picture("gone", 1);
    fs::remove(file("gone"));
    loader.load(gone);
    loader.load(picture("here", 2));
    EXPECT_EQ(all_of(loader), (Greys{{"gone", -1}, {"here", 2}}));
    EXPECT_EQ(errors_, "Cannot read " + file("gone").string() + ": No such file or directory.");
}

TEST_F(InputLoaders, AFileThatChangesWhileItIsReadIsReadOnceMore) {
    InputLoader loader{TextureLimits{}};
    const Sampler sampler = picture("a", 10);
    Slow slow(file("a"));
    if (!slow.works()) GTEST_SKIP() << "no leases on the file system of " << folder_;
    loader.load(sampler);
    loader.load(sampler);  // the same reading
    write("b", 20);
    slow.end();
    fs::rename(file("b"), file("a"));
    loader.load_again(sampler);
    const Greys list = all_of(loader);
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list.back().second, 20);
    EXPECT_LE(list.size(), 2U);
}

TEST_F(InputLoaders, WhatNobodyWantsAnyMoreIsNotHandedOver) {
    const Sampler sampler = picture("a", 10);
    Slow slow(file("a"));
    if (!slow.works()) GTEST_SKIP() << "no leases on the file system of " << folder_;
    InputLoader loader{TextureLimits{}};
    loader.load(sampler);
    loader.keep_only(Preset{});
    EXPECT_FALSE(loader.is_loading());
    EXPECT_TRUE(loader.is_reading());
    slow.end();
    EXPECT_EQ(all_of(loader), Greys{});
    EXPECT_FALSE(loader.is_reading());
}

TEST_F(InputLoaders, ItGoesWhileAFileIsStillRead) {
    const Sampler sampler = picture("a", 10);
    Slow slow(file("a"));
    if (!slow.works()) GTEST_SKIP() << "no leases on the file system of " << folder_;
    std::optional<InputLoader> loader(TextureLimits{});
    loader->load(sampler);
    loader.reset();
    slow.end();
}

}  // namespace
}  // namespace glint::input_loader_test
