// A picture that cannot be written leaves everything as it was, and one that replaces another is
// whole.
#include "base/temporary_file.h"
#include "image_files.h"

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

namespace glint::image_write_test {
namespace {

// No file may grow beyond `bytes` while this lives: what a full disk does, at the byte we choose.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{.rlim_cur = bytes, .rlim_max = old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit old_{};
    void (*old_handler_)(int);
};

// ---- what cannot be written

TEST_F(ImageFile, AFolderThatCannotBeWrittenIsToldByName) {
    // Below a regular file nobody can write, root included.
    put_content(in("file"), "content");
    for (const char* name : kWritable) {
        const auto text = complaint([&] {
            write_image(in("file") / name, noise_for(name, {4, 4}));
        });
        EXPECT_TRUE(contains(text, name) && contains(text, "Not a directory")) << text;
        const auto missing = complaint([&] {
            write_image(in("none") / name, noise_for(name, {4, 4}));
        });
        EXPECT_TRUE(contains(missing, name) && contains(missing, "No such file")) << missing;
    }
    EXPECT_EQ(content_of(in("file")), "content");
    EXPECT_EQ(names(), std::vector<std::string>{"file"});
}

TEST_F(ImageFile, ADirectoryOrAPipeIsNotReplaced) {
    fs::create_directory(in("a.png"));
    ASSERT_EQ(::mkfifo(in("b.png").c_str(), 0600), 0);
    const Image image = noise({4, 4}, ChannelType::u8);
    EXPECT_TRUE(contains(complaint([&] { write_image(in("a.png"), image); }), "Is a directory"));
    EXPECT_TRUE(contains(complaint([&] { write_image(in("b.png"), image); }), "regular"));
    EXPECT_TRUE(fs::is_directory(in("a.png")));
    EXPECT_TRUE(fs::is_fifo(in("b.png")));
    EXPECT_EQ(names().size(), 2U);
}

TEST_F(ImageFile, AnImageThatContradictsItselfIsNotWritten) {
    Image image = noise({4, 4}, ChannelType::u8);
    EXPECT_TRUE(contains(complaint([&] { write_image(in("a.exr"), image); }), "floats"));
    image.pixels.pop_back();
    EXPECT_TRUE(contains(complaint([&] { write_image(in("a.png"), image); }), "bytes"));
    EXPECT_TRUE(names().empty());
}

TEST_F(ImageFile, AFullDiskLeavesTheOldFileAndNothingElse) {
    prepare_image_library("a.jpg");
    for (const char* name : kWritable) {
        const Image image = noise_for(name, {128, 128});
        write_image(in(name), image);
        const std::string old = content_of(in(name));
        // At the start, in the middle, and at the very last byte, which is refused at close.
        for (const std::size_t limit : {std::size_t{0}, old.size() / 2, old.size() - 1}) {
            std::string text;
            {
                const FileSizeLimit full(limit);
                text = complaint([&] { write_image(in(name), image); });
            }
            EXPECT_TRUE(contains(text, name) && contains(text, "File too large"))
                << name << " with " << limit << " bytes: " << text;
            EXPECT_EQ(content_of(in(name)), old);
            EXPECT_EQ(names(), std::vector<std::string>{name});
        }
        fs::remove(in(name));
    }
}

TEST_F(ImageFile, AFullFileSystemIsToldInItsOwnWords) {
    // A mount of this process alone, so that no other program sees it.
    if (::unshare(CLONE_NEWNS) != 0 ||
        ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64k") != 0) {
        GTEST_SKIP() << "needs the right to mount a tmpfs: " << std::strerror(errno);
    }
    for (const char* name : kWritable) {
        const auto text = complaint([&] { write_image(in(name), noise_for(name, {256, 256})); });
        EXPECT_TRUE(contains(text, name) && contains(text, "No space left on device")) << text;
        EXPECT_TRUE(names().empty());
    }
    ::umount(folder_.c_str());
}

// ---- replacing files

TEST_F(ImageFile, ALinkStaysALinkAndItsFileIsReplaced) {
    fs::create_directory(in("real"));
    put_content(in("real/a.txt"), "old");
    fs::create_symlink("real/a.txt", in("link.txt"));
    write_whole_file(in("link.txt"), std::as_bytes(std::span("new", 3)));
    EXPECT_TRUE(fs::is_symlink(in("link.txt")));
    EXPECT_EQ(content_of(in("real/a.txt")), "new");
}

TEST_F(ImageFile, AReplacedFileKeepsItsRights) {
    put_content(in("a.txt"), "old");
    fs::permissions(in("a.txt"), fs::perms::owner_read | fs::perms::owner_write);
    write_whole_file(in("a.txt"), std::as_bytes(std::span("new", 3)));
    EXPECT_EQ(fs::status(in("a.txt")).permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(ImageFile, ANameMayBeAsLongAsTheSystemAllows) {
    const std::string name = std::string(251, 'n') + ".png";
    write_image(in(name), noise({2, 2}, ChannelType::u8));
    EXPECT_EQ(names(), std::vector<std::string>{name});
}

TEST_F(ImageFile, WritersOfOneFileDoNotMix) {
    std::vector<std::thread> writers;
    for (int i = 0; i < 8; ++i) {
        writers.emplace_back([&, i] {
            const std::string content(100000, static_cast<char>('a' + i));
            for (int round = 0; round < 10; ++round) {
                write_whole_file(in("a.txt"), std::as_bytes(std::span(content)));
            }
        });
    }
    for (std::thread& writer : writers) writer.join();
    const std::string content = content_of(in("a.txt"));
    EXPECT_EQ(content, std::string(100000, content[0]));
    EXPECT_EQ(names(), std::vector<std::string>{"a.txt"});
}

}  // namespace
}  // namespace glint::image_write_test
