// What a folder sees of a file that is written whole or not at all.
#include "base/temporary_file.h"

#include "test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace glint::temporary_file_test {
namespace {

namespace fs = std::filesystem;

void write_whole(const fs::path& file, std::string_view text) {
    write_whole_file(file, std::as_bytes(std::span(text)));
}

std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator(in), {}};
}

// Every name that a folder has had since.
class Names {
public:
    explicit Names(const fs::path& folder) : inotify_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
        inotify_add_watch(inotify_, folder.c_str(), IN_CREATE | IN_MOVED_TO);
    }
    ~Names() { ::close(inotify_); }
    std::set<std::string> seen() {
        std::set<std::string> names;
        alignas(inotify_event) std::array<char, 4096> buffer;
        for (ssize_t read; (read = ::read(inotify_, buffer.data(), buffer.size())) > 0;) {
            for (const char* at = buffer.data(); at < buffer.data() + read;) {
                const auto* event = reinterpret_cast<const inotify_event*>(at);
                names.insert(event->name);
                at += sizeof(inotify_event) + event->len;
            }
        }
        return names;
    }

private:
    int inotify_;
};

// So whoever is killed in the middle of thousands of pictures leaves only whole ones behind.
TEST(TemporaryFile, ANewFileHasNoNameButItsOwn) {
    const TestFolder folder;
    Names names(folder.path());
    write_whole(folder.path() / "new.png", "whole");
    EXPECT_EQ(names.seen(), std::set<std::string>{"new.png"});
    EXPECT_EQ(read(folder.path() / "new.png"), "whole");
}

TEST(TemporaryFile, ALinkStaysWhetherOrNotItsFileIsThereYet) {
    const TestFolder folder;
    std::filesystem::create_directory(folder.path() / "data");
    std::filesystem::create_symlink("data/new.png", folder.path() / "middle");
    std::filesystem::create_symlink("middle", folder.path() / "link.png");
    for (const char* text : {"whole", "again"}) {
        write_whole(folder.path() / "link.png", text);
        EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.png"));
        EXPECT_EQ(read(folder.path() / "data/new.png"), text);
    }
    std::filesystem::create_symlink("itself", folder.path() / "itself");
    EXPECT_THROW(write_whole(folder.path() / "itself", "nowhere"), std::runtime_error);
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "itself"));
}

TEST(TemporaryFile, AWriteProtectedFileIsNotReplaced) {
    if (::geteuid() == 0) GTEST_SKIP() << "this user may write everything";
    const TestFolder folder;
    write_whole(folder.path() / "kept.png", "kept");
    std::filesystem::permissions(folder.path() / "kept.png", std::filesystem::perms::owner_read);
    EXPECT_THROW(write_whole(folder.path() / "kept.png", "new"), std::runtime_error);
    EXPECT_EQ(read(folder.path() / "kept.png"), "kept");
}

TEST(TemporaryFile, AnOldFileStaysUntilTheNewOneIsWhole) {
    const TestFolder folder;
    const fs::path file = folder.write("old.png", "old");
    {
        TemporaryFile given_up(file);
        given_up.append(std::as_bytes(std::span("half", 4)));
    }
    EXPECT_EQ(read(file), "old");
    write_whole(file, "new");
    EXPECT_EQ(read(file), "new");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(TemporaryFile, AFileThatCameMeanwhileIsReplaced) {
    const TestFolder folder;
    const fs::path file = folder.path() / "both.png";
    TemporaryFile slow(file);
    write_whole(file, "quick");
    slow.append(std::as_bytes(std::span("slow", 4)));
    slow.commit();
    EXPECT_EQ(read(file), "slow");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

// Left by processes that were killed and had our number, as in containers.
TEST(TemporaryFile, NamesThatOthersLeftArePassedOver) {
    const TestFolder folder;
    const fs::path file = folder.path() / "a.png";
    write_whole(file, "old");
    for (int serial = 0; serial < 60; ++serial)
        std::ofstream(folder.path() / fmt::format(".a.png.{}-{}.tmp", ::getpid(), serial));
    write_whole(file, "new");
    EXPECT_EQ(read(file), "new");
}

}  // namespace
}  // namespace glint::temporary_file_test
