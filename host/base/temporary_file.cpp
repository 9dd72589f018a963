// A file that gets its final name when whole.
#include "base/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr int kTries = 100;  // of names that others may have left, whose process had our number

std::string cause_of(int error) {
    return std::generic_category().message(error);
}

// Other processes and other threads may write the same target at the same time.
fs::path name_beside(const fs::path& target) {
    static std::atomic<unsigned> serial{0};
    std::string name = target.filename().string();
    name.resize(std::min<std::size_t>(name.size(), 200));  // a file name holds 255 bytes
    return target.parent_path() / fmt::format(".{}.{}-{}.tmp", name, ::getpid(), serial++);
}

}  // namespace

std::runtime_error cannot_write(const fs::path& file, std::string_view cause) {
    for (const int error : {EFBIG, ENOSPC, EDQUOT}) {
        const std::string reason = cause_of(error);
        if (cause != reason && cause.find(reason) != cause.npos) return cannot_write(file, reason);
    }
    return std::runtime_error(fmt::format("Cannot write {}: {}.", file.string(), cause));
}

const fs::path& cleared(const fs::path& name) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(name, error);
    if (!fs::is_regular_file(status) && !fs::is_directory(status)) fs::remove(name, error);
    return name;
}

bool is_taken(const fs::path& name) {
    std::error_code error;
    return fs::exists(fs::symlink_status(name, error));
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw cannot_write(folder, cause_of(error.value()));
}

void require_writable(const fs::path& target) {
    const TemporaryFile goes_away(target);
}

std::runtime_error cannot_read(const fs::path& file, std::string_view cause) {
    return std::runtime_error(fmt::format("Cannot read {}: {}.", file.string(), cause));
}

std::runtime_error cannot_decode(const fs::path& file, std::string words) {
    constexpr std::size_t kLongest = 160;
    if (words.size() > kLongest) words.replace(kLongest, words.npos, "...");
    std::ranges::replace(words, '\n', ' ');
    while (words.ends_with('.') || words.ends_with(' ')) words.pop_back();
    if (words.empty()) return cannot_read(file, "It is damaged");
    return cannot_read(file, fmt::format("It is damaged, or of an unknown kind ({})", words));
}

TemporaryFile::TemporaryFile(const fs::path& target) : named_(target), target_(target) {
    // One by one: the last may point to what is not there yet.
    std::error_code error;
    for (int links = 0; fs::is_symlink(target_, error); ++links) {
        constexpr int kMostLinks = 40;  // as Linux has it
        if (links == kMostLinks) throw cannot_write(named_, cause_of(ELOOP));
        const fs::path next = fs::read_symlink(target_, error);
        if (error) throw cannot_write(named_, cause_of(error.value()));
        target_ = target_.parent_path() / next;
    }

    // Renaming over a device or a pipe would take it away from everybody else.
    struct stat old {};
    const bool replaces = ::stat(target_.c_str(), &old) == 0;
    if (!replaces && errno == ENAMETOOLONG) throw cannot_write(named_, cause_of(errno));
    if (replaces && S_ISDIR(old.st_mode)) throw cannot_write(named_, cause_of(EISDIR));
    if (replaces && !S_ISREG(old.st_mode)) throw cannot_write(named_, "It is not a regular file");
    if (replaces && ::access(target_.c_str(), W_OK) != 0)
        throw cannot_write(named_, cause_of(errno));

    buffer_.reserve(kBufferBytes);
    // A file without a name goes away with the process, however that ends. Not every file system
    // has such files, and they get their name through /proc.
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    if (::access("/proc/self/fd", X_OK) == 0) {
        descriptor_ = ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
    }
    for (int tries = 0; descriptor_ < 0 && tries < kTries; ++tries) {
        temporary_ = name_beside(target_);
        descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST) break;
    }
    if (descriptor_ < 0) {
        const int refusal = errno;
        temporary_.clear();
        if (std::error_code unknown; refusal == ENOENT && !fs::exists(folder, unknown))
            throw cannot_write(named_, fmt::format("{}; make the folder {} first",
                                                   cause_of(refusal), folder.string()));
        throw cannot_write(named_, cause_of(refusal));
    }
    if (replaces) (void)::fchmod(descriptor_, old.st_mode & 07777);  // some file systems have none
}

TemporaryFile::~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool TemporaryFile::append(std::span<const std::byte> bytes) noexcept {
    if (buffer_.size() + bytes.size() > kBufferBytes) {
        write_out(buffer_);
        buffer_.clear();
    }
    if (bytes.size() > kBufferBytes) {
        write_out(bytes);
    } else {
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());  // within what is reserved
    }
    return error_ == 0;
}

void TemporaryFile::write_out(std::span<const std::byte> bytes) noexcept {
    while (error_ == 0 && !bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
        if (written < 0 && errno != EINTR) fail(errno);
        if (written == 0) fail(ENOSPC);
    }
}

void TemporaryFile::fail(int error) noexcept {
    if (error_ == 0) error_ = error;
}

// A new file is given its own name at once, so that whoever is killed leaves nothing else behind.
// A rename can replace a file, a link cannot: where there is one, the link is named beside it
// first.
void TemporaryFile::give_name() {
    const std::string open_file = fmt::format("/proc/self/fd/{}", descriptor_);
    fs::path name = target_;
    for (int tries = 0; tries < kTries; ++tries, name = name_beside(target_)) {
        if (::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
            temporary_ = name;
            return;
        }
        if (errno != EEXIST && tries > 0) break;
    }
    fail(errno);
}

void TemporaryFile::commit(Haste haste) {
    write_out(buffer_);
    buffer_.clear();
    // Else a name may reach the disk before what it names, in place of what was there.
    if (error_ == 0 && haste == Haste::no && ::fdatasync(descriptor_) != 0 && errno != EINVAL)
        fail(errno);
    if (error_ == 0 && temporary_.empty()) give_name();
    if (::close(descriptor_) != 0) fail(errno);  // a network's file system reports here
    descriptor_ = -1;
    if (error_ == 0 && temporary_ != target_ &&
        ::rename(temporary_.c_str(), target_.c_str()) != 0) {
        fail(errno);
    }
    if (error_ != 0) throw cannot_write(named_, cause_of(error_));
    temporary_.clear();
}

void write_whole_file(const fs::path& file, std::span<const std::byte> bytes, Haste haste) {
    TemporaryFile out(file);
    out.append(bytes);
    out.commit(haste);
}

}  // namespace glint
