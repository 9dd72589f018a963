#include "base/readable_file.h"

#include "base/diagnostic.h"
#include "base/nearest_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

namespace glint {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string words_of(int error) {
    return std::generic_category().message(error);
}

std::string why_missing(const fs::path& file, int error) {
    const fs::path meant = error == ENOENT ? nearest_file(file) : fs::path();
    return words_of(error) + (meant.empty() ? "" : did_you_mean(meant));
}

void require_regular(const fs::path& file, const struct stat& status) {
    const mode_t mode = status.st_mode;
    if (S_ISREG(mode)) return;
    if (S_ISDIR(mode)) throw Unreadable(file, "it is a folder");
    const char* what = S_ISFIFO(mode) ? "pipe" : S_ISSOCK(mode) ? "socket" : "device";
    throw Unreadable(file, std::string("it is not a regular file (a ") + what + ")");
}

// Another program may hold a lease (a file server does) and is asked to give it up; the system
// takes it away after 45 s.
int open_without_waiting(const fs::path& file) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    for (;;) {
        const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
        if (descriptor >= 0) return descriptor;
        const bool is_leased = errno == EWOULDBLOCK && std::chrono::steady_clock::now() < end;
        if (errno != EINTR && !is_leased) throw Unreadable(file, words_of(errno));
        std::this_thread::sleep_for(5ms);
    }
}

}  // namespace

Unreadable::Unreadable(const fs::path& file, std::string why)
    : std::runtime_error("Cannot read " + file.string() + ": " + why +
                         (why.ends_with('?') ? "" : ".")),
      cause(std::move(why)) {}

// Asked by name first, so that a device is not even opened.
void require_readable(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) throw Unreadable(file, why_missing(file, errno));
    require_regular(file, status);
    if (::access(file.c_str(), R_OK) != 0) throw Unreadable(file, words_of(errno));
}

// Asked again of the descriptor: something else may have taken the name meanwhile, and O_NONBLOCK
// opens even a pipe without its other end.
ReadableFile::ReadableFile(const fs::path& file) : file_(file) {
    require_readable(file);
    descriptor_ = open_without_waiting(file);
    struct stat status {};
    try {
        if (::fstat(descriptor_, &status) != 0) throw Unreadable(file, words_of(errno));
        require_regular(file, status);
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
    size_ = static_cast<std::size_t>(status.st_size);
}

ReadableFile::~ReadableFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::string ReadableFile::name() const {
    return "/proc/self/fd/" + std::to_string(descriptor_);
}

std::size_t ReadableFile::read(std::span<char> to, std::size_t offset) const {
    std::size_t done = 0;
    while (done < to.size()) {
        const ssize_t got = ::pread(descriptor_, to.data() + done, to.size() - done,
                                    static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw Unreadable(file_, words_of(errno));
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

std::string read_whole_file(const fs::path& file, std::size_t most) {
    constexpr std::size_t kChunk = 1 << 16;
    const ReadableFile in(file);
    const auto too_large = [&] {
        return Unreadable(file, "it is larger than " + std::to_string(most >> 20) + " MiB");
    };
    if (in.size() > most) throw too_large();
    // It may grow meanwhile, and files of the kernel's tell no size. Room to see that it has not.
    std::string bytes;
    bytes.reserve(in.size() + kChunk);
    bytes.resize(in.size());
    bytes.resize(in.read(bytes, 0));
    for (bool more = true; more;) {
        const std::size_t before = bytes.size();
        bytes.resize(before + kChunk);
        bytes.resize(before + in.read(std::span(bytes).subspan(before), before));
        more = bytes.size() == before + kChunk;
        if (bytes.size() > most) throw too_large();
    }
    return bytes;
}

}  // namespace glint
