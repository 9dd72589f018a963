#include "base/watcher.h"

#include "base/readable_file.h"

#include <climits>
#include <fcntl.h>
#include <linux/magic.h>
#include <sys/epoll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace glint {
namespace {

using namespace std::chrono_literals;

constexpr auto kPollInterval = 100ms;
// Where inotify works, what it may miss (a folder mounted over, a write through shared memory).
constexpr auto kLookInterval = 1000ms;

// The kernel stamps files with a clock that lags by up to a tick; servers have clocks of their own.
constexpr std::int64_t kClockLagNs = 20'000'000;
constexpr std::int64_t kServerLagNs = 3'000'000'000;

constexpr std::uint32_t kMoves = IN_MOVE_SELF | IN_DELETE_SELF;
constexpr std::uint32_t kNames = IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO;
constexpr std::uint32_t kContent = IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB;

constexpr std::size_t kLargestCompared = 4 << 20;  // bytes

class Descriptor {
public:
    explicit Descriptor(int id) : id_(id) {}
    Descriptor(Descriptor&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Descriptor() {
        if (id_ >= 0) close(id_);
    }
    int id() const { return id_; }

private:
    int id_;
};

std::int64_t nanoseconds(const timespec& time) {
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::int64_t now_ns() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return nanoseconds(now);
}

// File systems whose other ends change files without telling this machine's kernel.
bool tells_of_changes(int folder) {
    constexpr std::array<std::uint64_t, 7> kSilent = {
        NFS_SUPER_MAGIC,  SMB_SUPER_MAGIC, SMB2_SUPER_MAGIC, CIFS_SUPER_MAGIC,
        FUSE_SUPER_MAGIC, V9FS_MAGIC,      AFS_SUPER_MAGIC};
    struct statfs system {};
    if (fstatfs(folder, &system) != 0) return true;
    const auto type = static_cast<std::uint64_t>(system.f_type) & 0xffffffffu;
    return std::ranges::find(kSilent, type) == kSilent.end();
}

// The names along a path, without empty ones and ".", last one first.
std::vector<std::string> names_from_the_end(const std::string& path) {
    std::vector<std::string> names;
    for (std::size_t end = path.size(); end != std::string::npos && end > 0;) {
        const std::size_t slash = path.rfind('/', end - 1);
        const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
        const std::string name = path.substr(begin, end - begin);
        if (!name.empty() && name != ".") names.push_back(name);
        end = slash;
    }
    return names;
}

std::uint64_t hash_of(const std::filesystem::path& path) try {
    const ReadableFile file(path);
    std::string text(std::min(file.size(), kLargestCompared), '\0');
    text.resize(file.read(text, 0));
    return std::hash<std::string>{}(text);
} catch (const Unreadable&) {
    return 0;
}

int required(int descriptor, const char* what) {
    if (descriptor < 0) throw std::system_error(errno, std::generic_category(), what);
    return descriptor;
}

}  // namespace

Watcher::Watcher(const std::vector<Path>& files, const WatcherOptions& options)
    : read_from_ns_(now_ns()), next_look_(Clock::now() + kPollInterval) {
    // Where there is none, all files are polled.
    if (options.use_inotify) inotify_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    timer_ = required(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC), "timerfd");
    epoll_ = required(epoll_create1(EPOLL_CLOEXEC), "epoll");
    for (const int source : {inotify_, timer_}) {
        epoll_event event{.events = EPOLLIN, .data = {.fd = source}};
        if (source >= 0) epoll_ctl(epoll_, EPOLL_CTL_ADD, source, &event);
    }
    set_files(files);
}

Watcher::~Watcher() {
    for (const int descriptor : {epoll_, timer_, inotify_}) {
        if (descriptor >= 0) close(descriptor);
    }
}

void Watcher::about_to_read() {
    read_from_ns_ = now_ns();
}

void Watcher::set_files(const std::vector<Path>& files) {
    std::vector<File> next;
    for (const Path& path : files) {
        const auto is_it = [&](const File& file) { return file.path == path; };
        if (std::ranges::any_of(next, is_it)) continue;
        const auto known = std::ranges::find_if(files_, is_it);
        if (known != files_.end()) {
            next.push_back(std::move(*known));
            known->path.clear();
            continue;
        }
        File& file = next.emplace_back();
        file.path = path;
        find(file);
        note_stamp(file);
        const std::int64_t lag = file.polled ? kServerLagNs : kClockLagNs;
        if (file.newest_ns > read_from_ns_ - lag)
            file.notice.lost_count(file.reported, Clock::now());
    }
    files_ = std::move(next);
    drop_unused_watches();
    set_timer();
}

std::vector<Watcher::Path> Watcher::changed() {
    read_events();
    const auto now = Clock::now();
    if (now >= next_look_) {
        for (File& file : files_) look(file);
        const bool polled = std::ranges::any_of(files_, [](const File& f) { return f.polled; });
        next_look_ = now + (polled ? kPollInterval : kLookInterval);
    }
    std::vector<Path> list;
    for (File& file : files_) {
        if (!file.notice.is_due(now)) continue;
        if (!file.notice.is_whole() && still_growing(file)) continue;
        file.notice.reported();
        note_stamp(file);
        list.push_back(file.path);
    }
    if (!list.empty()) read_from_ns_ = now_ns();
    drop_unused_watches();
    set_timer();
    return list;
}

// Walks the path as the system does, name by name, and watches what would lead it elsewhere. Every
// watch stands before what it watches is read, so that no change falls between.
void Watcher::find(File& file) {
    // When something was exchanged behind our back on the way, the end differs from what the system
    // finds now; nobody does that many times in a row.
    for (int attempt = 0; attempt < 8; ++attempt) {
        const FileStamp end = walk(file);
        const FileStamp now = stamp_of(file.path);
        if (end.inode == now.inode && end.device == now.device) return;
    }
}

FileStamp Watcher::walk(File& file) {
    file.folders.clear();
    file.links.clear();
    file.entry = {-1, {}};
    file.itself = -1;
    file.newest_ns = 0;
    file.polled = inotify_ < 0;
    std::error_code error;
    const Path absolute = std::filesystem::absolute(file.path, error);
    std::vector<std::string> rest = names_from_the_end(absolute.string());
    Descriptor folder(open("/", O_PATH | O_DIRECTORY | O_CLOEXEC));
    for (int links = 0; !rest.empty();) {
        const std::string name = rest.back();
        rest.pop_back();
        const bool last = rest.empty();
        int watch = -1;
        const auto found = look_up(file, folder.id(), name, last, watch);
        if (found && S_ISLNK(found->st_mode) && ++links < 40) {
            file.links.insert({watch, name});
            std::string target(PATH_MAX, '\0');
            const ssize_t length =
                readlinkat(folder.id(), name.c_str(), target.data(), target.size());
            target.resize(static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
            if (target.starts_with('/')) folder = Descriptor(open("/", O_PATH | O_CLOEXEC));
            const auto more = names_from_the_end(target);
            rest.insert(rest.end(), more.begin(), more.end());
            if (!rest.empty()) continue;
        }
        Descriptor inside(found && !last ? openat(folder.id(), name.c_str(),
                                                  O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)
                                         : -1);
        if (inside.id() < 0) {  // the end of the way, or a name that is not there
            return end_of_way(file, folder.id(), name, watch, last ? found : std::nullopt);
        }
        file.folders.insert(add_watch(file, inside.id(), kMoves));
        folder = std::move(inside);
    }
    return {};
}

// What a name stands for, with the watch that such a thing needs; nothing when it is missing.
std::optional<struct stat> Watcher::look_up(File& file, int folder, const std::string& name,
                                            bool last, int& watch) {
    std::optional<struct stat> found;
    const auto status = [&]() -> std::optional<struct stat> {
        struct stat now {};
        if (fstatat(folder, name.c_str(), &now, AT_SYMLINK_NOFOLLOW) != 0) return std::nullopt;
        return now;
    };
    for (int attempt = 0; attempt < 8; ++attempt) {
        found = status();
        const bool plain_folder = found && S_ISDIR(found->st_mode) && !last;
        const bool content = found && !S_ISLNK(found->st_mode);
        // A folder on the way tells by itself when it is moved; its neighbours do not matter.
        watch = plain_folder ? -1 : add_watch(file, folder, content ? kNames | kContent : kNames);
        const auto again = status();
        if (found.has_value() != again.has_value()) continue;
        if (!found || (found->st_ino == again->st_ino && found->st_mode == again->st_mode)) break;
    }
    if (found) {
        // An entry that comes or goes changes both times of its folder, a move of the folder one.
        const bool moved = nanoseconds(found->st_ctim) != nanoseconds(found->st_mtim);
        if (!S_ISDIR(found->st_mode) || moved) {
            file.newest_ns = std::max(file.newest_ns, nanoseconds(found->st_ctim));
        }
    } else {
        struct stat parent {};
        if (fstatat(folder, "", &parent, AT_EMPTY_PATH) == 0) {
            file.newest_ns = std::max(file.newest_ns, nanoseconds(parent.st_mtim));
        }
    }
    return found;
}

FileStamp Watcher::end_of_way(File& file, int folder, const std::string& name, int watch,
                              const std::optional<struct stat>& found) {
    if (!tells_of_changes(folder)) file.polled = true;
    if (watch < 0) watch = add_watch(file, folder, kNames);
    file.entry = {watch, name};
    if (!found) return {};
    if (S_ISREG(found->st_mode) && found->st_nlink > 1) {
        const Descriptor itself(openat(folder, name.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
        if (itself.id() >= 0) {
            file.itself = add_watch(file, itself.id(), IN_MODIFY | IN_CLOSE_WRITE);
        }
    }
    return stamp_of(*found);
}

// By descriptor, because the same words may lead elsewhere by now. The same folder has the same
// watch, whoever asks.
int Watcher::add_watch(File& file, int descriptor, std::uint32_t mask) {
    if (inotify_ < 0) return -1;
    const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
    const int watch = inotify_add_watch(inotify_, path.c_str(), mask | IN_MASK_ADD);
    if (watch < 0)
        file.polled = true;  // no watch left, or not allowed
    else
        watches_.insert(watch);
    return watch;
}

void Watcher::drop_unused_watches() {
    std::set<int> used;
    for (const File& file : files_) {
        used.insert(file.folders.begin(), file.folders.end());
        for (const Name& link : file.links) used.insert(link.first);
        used.insert({file.entry.first, file.itself});
    }
    std::erase_if(watches_, [&](int watch) {
        const bool unused = !used.contains(watch);
        if (unused) inotify_rm_watch(inotify_, watch);
        return unused;
    });
}

void Watcher::read_events() {
    if (inotify_ < 0) return;
    alignas(inotify_event) std::array<char, 64 * 1024> buffer;
    for (;;) {
        const ssize_t length = read(inotify_, buffer.data(), buffer.size());
        if (length <= 0) return;
        for (std::size_t at = 0; at < static_cast<std::size_t>(length);) {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
            const Name name{event->wd, event->len > 0 ? event->name : ""};
            for (File& file : files_) hear(file, name, event->mask);
            if (event->mask & IN_IGNORED) watches_.erase(event->wd);
            at += sizeof(inotify_event) + event->len;
        }
    }
}

void Watcher::hear(File& file, const Name& name, std::uint32_t mask) {
    const auto tell = [&](FileEvent event) {
        file.notice.heard(event, stamp_of(file.path), Clock::now());
    };
    if (mask & IN_Q_OVERFLOW) {  // too much to be told one by one
        find(file);
        return file.notice.lost_count(stamp_of(file.path), Clock::now());
    }
    const bool folder_gone = mask & (kMoves | IN_IGNORED | IN_UNMOUNT);
    if (folder_gone && file.folders.contains(name.first)) {
        find(file);
        return tell(FileEvent::folder_went);
    }
    const bool is_link = file.links.contains(name);
    const bool is_entry = name == file.entry || (name.first == file.itself && file.itself >= 0);
    if (!is_link && !is_entry) return;
    if (mask & kNames) {
        find(file);
        tell(mask & (IN_DELETE | IN_MOVED_FROM) ? FileEvent::went
             : mask & IN_MOVED_TO               ? FileEvent::moved_in
             : file.links.contains(name)        ? FileEvent::led_away
                                                : FileEvent::came);
    } else if (is_link) {
        return;
    } else if (mask & IN_CLOSE_WRITE) {
        tell(FileEvent::closed);
    } else if (mask & IN_MODIFY) {
        tell(FileEvent::written);
    } else if ((mask & IN_ATTRIB) && ((stamp_of(file.path).mode ^ file.reported.mode) & 0444)) {
        tell(FileEvent::readable);
    }
}

// Finds what nobody told of.
void Watcher::look(File& file) {
    if (file.notice.is_pending()) return;
    const FileStamp now = stamp_of(file.path);
    const bool fresh = file.polled && now_ns() - now.modified_ns < kServerLagNs;
    if (!is_another(file.reported, now, !file.polled) &&
        (!fresh || hash_of(file.path) == file.content))
        return;
    find(file);
    file.seen = now;
    file.notice.found(now, Clock::now());
}

// Where nobody tells of a write, only a second look can.
bool Watcher::still_growing(File& file) {
    if (!file.polled) return false;
    const FileStamp now = stamp_of(file.path);
    if (now == file.seen) return false;
    file.seen = now;
    file.notice.grew(Clock::now());
    return !file.notice.is_due(Clock::now());
}

FileStamp Watcher::stamp_of(const struct stat& status) {
    return {.device = status.st_dev,
            .inode = status.st_ino,
            .size = status.st_size,
            .modified_ns = nanoseconds(status.st_mtim),
            .status_ns = nanoseconds(status.st_ctim),
            .mode = status.st_mode};
}

FileStamp Watcher::stamp_of(const Path& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? stamp_of(status) : FileStamp{};
}

// Before the file is read: what happens to it afterwards makes a difference to this.
void Watcher::note_stamp(File& file) {
    file.reported = file.seen = stamp_of(file.path);
    if (file.polled) file.content = hash_of(file.path);
}

void Watcher::set_timer() {
    std::optional<Clock::time_point> next;
    if (!files_.empty()) next = next_look_;
    for (const File& file : files_) {
        if (const auto due = file.notice.due()) next = std::min(*next, *due);
    }
    itimerspec when{};
    if (next) {
        const auto ns = std::max<std::int64_t>(1, next->time_since_epoch() / 1ns);
        when.it_value = {.tv_sec = ns / 1'000'000'000, .tv_nsec = ns % 1'000'000'000};
    }
    timerfd_settime(timer_, TFD_TIMER_ABSTIME, &when, nullptr);
}

}  // namespace glint
