#include "window/trial/socket_process.h"

#include "offline/common.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace glint {

int SocketProcess::start(const std::filesystem::path& program, const std::string& verb,
                         const std::string& device, int niceness, int output) {
    end();
    Launch wanted{.words = {program.string(), verb},
                  .input = kSocket,
                  .output = output,
                  .group = Launch::Group::session,
                  .default_signals = true,
                  .core_files = false,
                  .niceness = niceness};
    if (!device.empty()) wanted.words.push_back(device);
    const Launched launched = launch(wanted);
    process_ = launched.process;
    socket_ = launched.pipe;
    return launched.error;
}

void SocketProcess::end() {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    outgoing_.clear();
    arrived.clear();
    dying_.end(process_);
    dying_.reap();
}

void SocketProcess::send(std::string_view bytes) {
    outgoing_ += bytes;
    while (!outgoing_.empty() && socket_ >= 0) {
        const ssize_t sent =
            ::send(socket_, outgoing_.data(), outgoing_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent <= 0) return;  // full, or broken, which receive() finds out
        outgoing_.erase(0, static_cast<std::size_t>(sent));
    }
}

bool SocketProcess::receive() {
    dying_.reap();
    send({});
    std::array<char, 64 * 1024> buffer;
    while (socket_ >= 0) {
        const ssize_t length = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
        if (length < 0 && errno == EINTR) continue;
        if (length <= 0) return length < 0 && errno == EAGAIN;
        arrived.append(buffer.data(), static_cast<std::size_t>(length));
    }
    return true;
}

std::optional<int> SocketProcess::exit_code() {
    const std::optional<int> code = ended(process_);
    if (code) process_ = 0;
    return code;
}

void require_socket(const char* verb) {
    struct stat status {};
    if (::fstat(STDIN_FILENO, &status) == 0 && S_ISSOCK(status.st_mode)) return;
    throw UsageError(fmt::format("`glint {}` is for the window to start, not for people.", verb));
}

}  // namespace glint
