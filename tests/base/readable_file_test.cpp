// Only regular files are read, and nothing waits for the others.
#include "base/readable_file.h"

#include "test_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>

namespace glint::readable_file_test {
namespace {

namespace fs = std::filesystem;

class ReadableFiles : public testing::Test {
protected:
    fs::path write(const char* name, std::string_view text) const {
        return made_.write(name, text);
    }

    // "" when it is read.
    static std::string refusal(const fs::path& file, std::size_t most = 1 << 20) {
        try {
            read_whole_file(file, most);
            return "";
        } catch (const Unreadable& unreadable) {
            EXPECT_EQ(unreadable.what(),
                      "Cannot read " + file.string() + ": " + unreadable.cause + ".");
            return unreadable.cause;
        }
    }

    TestFolder made_;
    const fs::path folder_ = made_.path();
};

TEST_F(ReadableFiles, WhatIsNoRegularFileIsRefusedAtOnceAndByItsKind) {
    const fs::path pipe = folder_ / "pipe", socket = folder_ / "socket";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    std::strncpy(address.sun_path, socket.c_str(), sizeof address.sun_path - 1);
    const int open_socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(::bind(open_socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    fs::create_symlink("pipe", folder_ / "link");
    fs::create_symlink("itself", folder_ / "itself");
    const struct {
        fs::path file;
        const char* cause;
    } cases[] = {{pipe, "it is not a regular file (a pipe)"},
                 {folder_ / "link", "it is not a regular file (a pipe)"},
                 {socket, "it is not a regular file (a socket)"},
                 {"/dev/zero", "it is not a regular file (a device)"},
                 {folder_, "it is a folder"},
                 {folder_ / "none", "No such file or directory"},
                 {folder_ / "itself", "Too many levels of symbolic links"},
                 {"", "No such file or directory"}};
    for (const auto& [file, cause] : cases) EXPECT_EQ(refusal(file), cause) << file;
    ::close(open_socket);
}

TEST_F(ReadableFiles, APipeThatSomebodyWritesToIsLeftAlone) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int end = ::open(pipe.c_str(), O_RDWR);
    ASSERT_EQ(::write(end, "text", 4), 4);
    EXPECT_EQ(refusal(pipe), "it is not a regular file (a pipe)");
    char left[8];
    EXPECT_EQ(::read(end, left, sizeof left), 4);
    ::close(end);
}

TEST_F(ReadableFiles, AllOfAFileIsReadToItsEndAsItStandsThen) {
    const std::string text(200'000, 'x');
    EXPECT_EQ(read_whole_file(write("a", text), 1 << 20), text);
    EXPECT_EQ(read_whole_file(write("empty", ""), 1 << 20), "");
    const fs::path file = write("b", text);
    const ReadableFile open(file);
    EXPECT_EQ(open.size(), text.size());
    fs::resize_file(file, 1000);
    std::string room(text.size(), '\0');
    EXPECT_EQ(open.read(room, 0), 1000U) << "it became shorter";
    EXPECT_EQ(open.read(room, 500), 500U);
    EXPECT_EQ(open.read(room, 5000), 0U);
    // A file of the kernel's says that it has no bytes.
    EXPECT_NE(read_whole_file("/proc/self/status", 1 << 20).find("Pid:"), std::string::npos);
}

TEST_F(ReadableFiles, WhatTakesTheNameOfAnOpenFileIsAnother) {
    const fs::path file = write("a", "first");
    const ReadableFile open(file);
    fs::rename(write("b", "second"), file);
    EXPECT_EQ(read_whole_file(open.name(), 100), "first");
    EXPECT_EQ(read_whole_file(file, 100), "second");
}

TEST_F(ReadableFiles, ATooLargeOneIsRefusedByName) {
    const fs::path file = write("a", "");
    fs::resize_file(file, std::uintmax_t{20} << 30);  // takes no room
    EXPECT_EQ(refusal(file, 64 << 20), "it is larger than 64 MiB");
    fs::resize_file(file, (1 << 20) + 1);
    EXPECT_EQ(refusal(file, 1 << 20), "it is larger than 1 MiB");
    fs::resize_file(file, 1 << 20);
    EXPECT_EQ(refusal(file, 1 << 20), "");
}

TEST_F(ReadableFiles, WhatMayNotBeReadIsRefused) {
    const fs::path file = write("a", "text");
    fs::permissions(file, fs::perms::none);
    if (::access(file.c_str(), R_OK) == 0) GTEST_SKIP() << "this user may read everything";
    EXPECT_EQ(refusal(file), "Permission denied");
}

}  // namespace
}  // namespace glint::readable_file_test
