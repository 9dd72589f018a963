// Which of a set of files have been saved, however that was done.
#pragma once

#include "base/save_notice.h"

#include <sys/stat.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace glint {

struct WatcherOptions {
    // Off: every file is looked at 10 times a second, as on file systems that tell nothing.
    bool use_inotify = true;
};

// Hears of saves through inotify on the folders of the files, of every link that leads to them and
// of every folder on the way; looks at the files themselves where the system does not tell. A save
// that is closed or renamed into place is reported at once; a plain write, an empty file or one
// that is gone after a short quiet time, in case more is to come (base/save_notice.h). Whatever
// happens after a report is reported again, so whoever reads a file each time ends with its last
// content.
//
// Nothing is lost while the set changes either, in this order: make the watcher (or call
// `about_to_read`), read, `set_files` with what was read; later `changed`, read again, `set_files`.
// A file that is new in the set and was saved since then is reported.
class Watcher {
public:
    using Path = std::filesystem::path;

    // Throws std::system_error when the process has no descriptor left.
    explicit Watcher(const std::vector<Path>& files = {}, const WatcherOptions& options = {});
    ~Watcher();
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;

    // Files that do not exist yet, or whose folder does not, are watched for all the same. Relative
    // paths start at the current folder.
    void set_files(const std::vector<Path>& files);

    // Marks the start of a reading that does not answer `changed`, such as of another scene.
    void about_to_read();

    // For poll(): readable when `changed` has something to do. It need not have news then.
    int descriptor() const { return epoll_; }

    // The files saved since the last call, as they were given, each once. Does not wait.
    std::vector<Path> changed();

private:
    using Clock = std::chrono::steady_clock;

    using Name = std::pair<int, std::string>;  // in the folder of a watch
    struct File {
        Path path;
        std::set<int> folders;       // watches of the folders on the way, for when one is moved
        std::set<Name> links;        // on the way
        Name entry{-1, {}};          // the end of the way: the file, or what is missing
        int itself = -1;             // watch of the file, when it has other names too
        bool polled = false;         // inotify does not tell of it, or not of everything
        std::int64_t newest_ns = 0;  // the latest change of anything on the way, ns since 1970

        SaveNotice notice;
        FileStamp reported;         // when last reported
        FileStamp seen;             // when last looked at; polled files only
        std::uint64_t content = 0;  // hash when last reported; polled files only
    };

    void find(File& file);
    FileStamp walk(File& file);
    std::optional<struct stat> look_up(File& file, int folder, const std::string& name, bool last,
                                       int& watch);
    FileStamp end_of_way(File& file, int folder, const std::string& name, int watch,
                         const std::optional<struct stat>& found);
    int add_watch(File& file, int descriptor, std::uint32_t mask);
    void drop_unused_watches();

    void read_events();
    void hear(File& file, const Name& name, std::uint32_t mask);
    void look(File& file);
    bool still_growing(File& file);
    static FileStamp stamp_of(const struct stat& status);
    static FileStamp stamp_of(const Path& path);
    void note_stamp(File& file);
    void set_timer();

    int inotify_ = -1, timer_ = -1, epoll_ = -1;
    std::vector<File> files_;
    std::set<int> watches_;
    std::int64_t read_from_ns_;  // when the last reading began, ns since 1970
    Clock::time_point next_look_;
};

}  // namespace glint
