// However a file is saved, whoever reads it on every notice ends with its last content.
#include "base/watcher.h"

#include "test_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <random>
#include <thread>

namespace glint::watcher_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

std::string content(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_all(int file, std::string_view text) {
    ASSERT_EQ(write(file, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

void truncate_and_write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

// What a window does: sleep until there is something to do, ask, read what has changed.
class Reader {
public:
    explicit Reader(std::vector<fs::path> files, bool inotify = true)
        : watcher_(files, {.use_inotify = inotify}) {
        for (const fs::path& file : files) seen_[file] = content(file);
        thread_ = std::thread([this] { run(); });
    }
    ~Reader() {
        stop_ = true;
        thread_.join();
    }

    std::string seen(const fs::path& file) {
        const std::lock_guard lock(mutex_);
        return seen_[file];
    }

    // Whether the reader comes to have this text, within a time that only what hangs takes.
    bool comes_to(const fs::path& file, const std::string& text) {
        const auto end = Clock::now() + 10s;
        while (seen(file) != text) {
            if (Clock::now() > end) return false;
            std::this_thread::sleep_for(200us);
        }
        return true;
    }

    std::atomic<int> notices = 0;

private:
    void run() {
        while (!stop_) {
            pollfd descriptor{.fd = watcher_.descriptor(), .events = POLLIN, .revents = 0};
            if (poll(&descriptor, 1, 20) == 0) continue;
            for (const fs::path& file : watcher_.changed()) {
                ++notices;
                const std::string text = content(file);
                const std::lock_guard lock(mutex_);
                seen_[file] = text;
            }
        }
    }

    Watcher watcher_;
    std::mutex mutex_;
    std::map<fs::path, std::string> seen_;
    std::atomic<bool> stop_ = false;
    std::thread thread_;
};

// A scene in a folder of its own, also reached through links:
// link.frag -> middle.frag -> real/scene.frag, and folder -> real.
struct Place {
    explicit Place(const fs::path& folder) : root(folder), real(folder / "real" / "scene.frag") {
        fs::create_directory(root / "real");
        truncate_and_write(real, "first");
        fs::create_symlink("real/scene.frag", root / "middle.frag");
        fs::create_symlink(root / "middle.frag", root / "link.frag");
        fs::create_symlink("real", root / "folder");
    }
    std::vector<fs::path> names() const {
        return {real, root / "link.frag", root / "folder" / "scene.frag"};
    }
    fs::path root, real;
};

struct Style {
    const char* name;
    std::function<void(const Place&, const std::string&)> save;
};

void rename_over(const fs::path& path, const std::string& text) {
    const fs::path fresh = path.string() + ".new";
    truncate_and_write(fresh, text);
    fs::rename(fresh, path);
}

void point(const fs::path& link, const fs::path& target) {
    const fs::path fresh = link.string() + ".new";
    fs::create_symlink(target, fresh);
    fs::rename(fresh, link);
}

void in_place(const fs::path& path, const std::string& text) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    write_all(file, text);
    ASSERT_EQ(ftruncate(file, static_cast<off_t>(text.size())), 0);
    close(file);
}

void in_two_parts(const fs::path& path, const std::string& text, std::chrono::milliseconds pause,
                  std::chrono::milliseconds before_close) {
    const int file = open(path.c_str(), O_WRONLY | O_TRUNC | O_CREAT | O_CLOEXEC, 0644);
    write_all(file, text.substr(0, text.size() / 2));
    std::this_thread::sleep_for(pause);
    write_all(file, text.substr(text.size() / 2));
    std::this_thread::sleep_for(before_close);
    close(file);
}

void with_the_old_time(const fs::path& path, const std::string& text) {
    struct stat old {};
    stat(path.c_str(), &old);
    in_place(path, text);
    const timespec times[] = {old.st_atim, old.st_mtim};
    utimensat(AT_FDCWD, path.c_str(), times, 0);
}

void through_memory(const fs::path& path, const std::string& text) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    ASSERT_EQ(ftruncate(file, static_cast<off_t>(text.size())), 0);
    void* memory = mmap(nullptr, text.size(), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    std::copy(text.begin(), text.end(), static_cast<char*>(memory));
    munmap(memory, text.size());
    close(file);
}

const Style kStyles[] = {
    {"in place", [](const Place& p, const std::string& t) { in_place(p.real, t); }},
    {"truncate and write",
     [](const Place& p, const std::string& t) { truncate_and_write(p.real, t); }},
    {"rename over", [](const Place& p, const std::string& t) { rename_over(p.real, t); }},
    {"twice at once",
     [](const Place& p, const std::string& t) {
         truncate_and_write(p.real, std::string(t.size(), 'x'));
         truncate_and_write(p.real, t);
     }},
    {"renamed over twice at once",
     [](const Place& p, const std::string& t) {
         rename_over(p.real, "between");
         rename_over(p.real, t);
     }},
    {"old one kept aside",
     [](const Place& p, const std::string& t) {
         fs::rename(p.real, p.real.string() + "~");
         truncate_and_write(p.real, t);
     }},
    {"delete and create again",
     [](const Place& p, const std::string& t) {
         fs::remove(p.real);
         truncate_and_write(p.real, t);
     }},
    {"delete, and create later",
     [](const Place& p, const std::string& t) {
         fs::remove(p.real);
         std::this_thread::sleep_for(30ms);
         truncate_and_write(p.real, t);
     }},
    {"two parts", [](const Place& p, const std::string& t) { in_two_parts(p.real, t, 20ms, 0ms); }},
    {"two parts, not closed for long",
     [](const Place& p, const std::string& t) { in_two_parts(p.real, t, 1ms, 150ms); }},
    {"cut off, closed, appended",
     [](const Place& p, const std::string& t) {
         truncate_and_write(p.real, "");
         std::this_thread::sleep_for(2ms);
         std::ofstream(p.real, std::ios::app) << t;
     }},
    {"with the old time",
     [](const Place& p, const std::string& t) { with_the_old_time(p.real, t); }},
    {"through memory", [](const Place& p, const std::string& t) { through_memory(p.real, t); }},
    {"through a link",
     [](const Place& p, const std::string& t) { truncate_and_write(p.root / "link.frag", t); }},
    {"through another name of the same file",
     [](const Place& p, const std::string& t) {
         const fs::path other = p.root / "other.frag";
         fs::create_hard_link(p.real, other);
         std::this_thread::sleep_for(20ms);
         truncate_and_write(other, t);
         std::this_thread::sleep_for(5ms);
         fs::remove(other);
     }},
    {"folder away, edited, and back",
     [](const Place& p, const std::string& t) {
         fs::rename(p.root / "real", p.root / "away");
         truncate_and_write(p.root / "away" / "scene.frag", t);
         std::this_thread::sleep_for(2ms);
         fs::rename(p.root / "away", p.root / "real");
     }},
    {"folder away and a new one",
     [](const Place& p, const std::string& t) {
         fs::remove_all(p.root / "old");
         fs::rename(p.root / "real", p.root / "old");
         fs::create_directory(p.root / "real");
         truncate_and_write(p.real, t);
     }},
    {"folder exchanged for a finished one",
     [](const Place& p, const std::string& t) {
         fs::remove_all(p.root / "old");
         fs::create_directory(p.root / "fresh");
         truncate_and_write(p.root / "fresh" / "scene.frag", t);
         fs::rename(p.root / "real", p.root / "old");
         fs::rename(p.root / "fresh", p.root / "real");
     }},
};

class Watching : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(, Watching, testing::Values(true, false), [](const auto& tested) {
    return std::string(tested.param ? "Inotify" : "Polling");
});

TEST_P(Watching, SeesEveryWayOfSaving) {
    const TestFolder folder;
    const Place place(folder.path());
    Reader reader(place.names(), GetParam());
    int number = 0;
    for (const Style& style : kStyles) {
        SCOPED_TRACE(style.name);
        const std::string text = fmt::format("{:4} saved: {}", ++number, style.name);
        style.save(place, text);
        for (const fs::path& name : place.names()) {
            EXPECT_TRUE(reader.comes_to(name, text)) << name << " is '" << reader.seen(name) << "'";
        }
    }
}

TEST_P(Watching, LosesNoneOfManyMixedSaves) {
    const TestFolder folder;
    const Place place(folder.path());
    Reader reader(place.names(), GetParam());
    std::mt19937 random(1);
    const int saves = GetParam() ? 500 : 100;
    for (int i = 1; i <= saves; ++i) {
        const Style& style = kStyles[random() % std::size(kStyles)];
        SCOPED_TRACE(style.name);
        const std::string text = fmt::format("save {:5}", i);  // all of one length
        style.save(place, text);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
        if (i % 10 != 0) continue;
        for (const fs::path& name : place.names()) {
            ASSERT_TRUE(reader.comes_to(name, text))
                << i << " " << name << " is '" << reader.seen(name) << "'";
        }
    }
}

TEST_P(Watching, FollowsALinkToWhereverItPoints) {
    const TestFolder folder;
    const Place place(folder.path());
    fs::create_directory(folder.path() / "second");
    const fs::path second = folder.path() / "second" / "b.frag";
    truncate_and_write(second, "second");
    const fs::path link = folder.path() / "link.frag", middle = folder.path() / "middle.frag";
    Reader reader({link}, GetParam());

    point(middle, second);  // in the middle of the chain
    EXPECT_TRUE(reader.comes_to(link, "second"));
    truncate_and_write(second, "second, edited");
    EXPECT_TRUE(reader.comes_to(link, "second, edited"));
    rename_over(second, "second, renamed over");
    EXPECT_TRUE(reader.comes_to(link, "second, renamed over"));

    fs::remove(link);  // the first link, replaced without a rename
    fs::create_symlink(place.real, link);
    EXPECT_TRUE(reader.comes_to(link, "first"));
    truncate_and_write(place.real, "first, edited");
    EXPECT_TRUE(reader.comes_to(link, "first, edited"));

    rename_over(link, "no link any more");
    EXPECT_TRUE(reader.comes_to(link, "no link any more"));
    in_place(link, "nor now");
    EXPECT_TRUE(reader.comes_to(link, "nor now"));
}

TEST_P(Watching, WaitsForWhatIsNotThereYet) {
    const TestFolder folder;
    const fs::path file = folder.path() / "a" / "b" / "scene.frag";
    const fs::path dangling = folder.path() / "dangling.frag";
    fs::create_symlink("a/b/scene.frag", dangling);
    Reader reader({file, dangling}, GetParam());
    fs::create_directories(file.parent_path());
    truncate_and_write(file, "here");
    EXPECT_TRUE(reader.comes_to(file, "here"));
    EXPECT_TRUE(reader.comes_to(dangling, "here"));
    fs::remove_all(folder.path() / "a");
    EXPECT_TRUE(reader.comes_to(file, ""));
    fs::create_directories(file.parent_path());
    truncate_and_write(file, "again");
    EXPECT_TRUE(reader.comes_to(file, "again"));
    EXPECT_TRUE(reader.comes_to(dangling, "again"));
}

TEST_P(Watching, NoticesAnEmptiedAndADeletedFile) {
    const TestFolder folder;
    const fs::path file = folder.path() / "scene.frag";
    truncate_and_write(file, "something");
    Reader reader({file}, GetParam());
    truncate_and_write(file, "");
    EXPECT_TRUE(reader.comes_to(file, ""));
    truncate_and_write(file, "something");
    EXPECT_TRUE(reader.comes_to(file, "something"));
    fs::remove(file);
    EXPECT_TRUE(reader.comes_to(file, ""));
}

// The scene's one line names its include. A person saves both, again and again, while the reader
// is busy, so that saves of the include fall before, into and after the change of the set.
TEST(Watcher, LosesNothingWhileTheSetChanges) {
    const TestFolder folder;
    const fs::path scene = folder.path() / "scene.frag";
    truncate_and_write(scene, "include0");
    truncate_and_write(folder.path() / "include0", "text 0");
    std::atomic<bool> stop = false;
    std::mutex mutex;
    std::string seen;
    std::thread reader([&] {
        Watcher watcher;
        std::mt19937 random(2);
        for (bool first = true; !stop;) {
            pollfd descriptor{.fd = watcher.descriptor(), .events = POLLIN, .revents = 0};
            if (!first && poll(&descriptor, 1, 20) == 0) continue;
            if (!first && watcher.changed().empty()) continue;
            first = false;
            const fs::path include = folder.path() / content(scene);
            const std::string text = content(include);
            std::this_thread::sleep_for(std::chrono::microseconds(random() % 2000));
            watcher.set_files({scene, include});
            const std::lock_guard lock(mutex);
            seen = text;
        }
    });
    std::mt19937 random(3);
    for (int i = 1; i <= 200; ++i) {
        const std::string name = fmt::format("include{}", i), text = fmt::format("text {}", i);
        truncate_and_write(folder.path() / name, "early");
        rename_over(scene, name);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
        truncate_and_write(folder.path() / name, text);
        const auto end = Clock::now() + 10s;
        for (bool same = false; !same && Clock::now() < end;) {
            std::this_thread::sleep_for(200us);
            const std::lock_guard lock(mutex);
            same = seen == text;
        }
        const std::lock_guard lock(mutex);
        EXPECT_EQ(seen, text);
    }
    stop = true;
    reader.join();
}

TEST(Watcher, IsQuietWhenNothingIsSaved) {
    const TestFolder folder;
    const Place place(folder.path());
    std::this_thread::sleep_for(50ms);  // what was saved just before counts as new
    Reader reader(place.names());
    std::this_thread::sleep_for(50ms);
    reader.notices = 0;
    truncate_and_write(place.root / "real" / "neighbour.frag", "another file");
    std::ifstream(place.real).get();
    chmod(place.real.c_str(), 0755);
    std::this_thread::sleep_for(1500ms);
    EXPECT_EQ(reader.notices, 0);
}

TEST(Watcher, ReportsOneSaveOnce) {
    const TestFolder folder;
    const fs::path file = folder.path() / "scene.frag";
    truncate_and_write(file, "first");
    std::this_thread::sleep_for(50ms);
    Reader reader({file});
    for (int i = 0; i < 20; ++i) {
        const std::string text = fmt::format("save {}", i);
        rename_over(file, text);
        ASSERT_TRUE(reader.comes_to(file, text));
    }
    std::this_thread::sleep_for(1200ms);
    EXPECT_EQ(reader.notices, 20);
}

TEST(Watcher, KeepsNoDescriptorsAndNoWatches) {
    const TestFolder folder;
    const Place place(folder.path());
    const auto descriptors = [] {
        return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
    };
    const auto before = descriptors();
    {
        Watcher watcher(place.names());
        const auto during = descriptors();
        for (int i = 0; i < 200; ++i) {
            rename_over(place.real, fmt::format("save {}", i));
            watcher.changed();
            watcher.set_files(i % 2 ? place.names() : std::vector{place.real});
        }
        EXPECT_EQ(descriptors(), during);
    }
    EXPECT_EQ(descriptors(), before);
}

}  // namespace
}  // namespace glint::watcher_test
