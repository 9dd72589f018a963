#include "window/live/neovim.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Deadline = std::chrono::steady_clock::time_point;
using nlohmann::json;

class Neovim {
public:
    Neovim(const std::string& address, Deadline deadline) : deadline_(deadline) {
        sockaddr_un name{.sun_family = AF_UNIX, .sun_path = {}};
        if (address.size() >= sizeof name.sun_path) return;
        address.copy(name.sun_path, address.size());
        socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (socket_ < 0) return;
        limit();
        connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&name), sizeof name) == 0;
    }
    ~Neovim() {
        if (socket_ >= 0) ::close(socket_);
    }
    Neovim(const Neovim&) = delete;
    Neovim& operator=(const Neovim&) = delete;

    // What an expression of Vim script comes to; nothing where there is no answer in time.
    std::optional<json> evaluate(const std::string& expression) {
        if (!connected_) return {};
        const auto request = json::to_msgpack({0, ++requests_, "nvim_eval", {expression}});
        if (::send(socket_, request.data(), request.size(), MSG_NOSIGNAL) !=
            static_cast<ssize_t>(request.size()))
            return {};
        std::vector<std::uint8_t> bytes;
        for (std::uint8_t chunk[4096]; limit();) {
            const ssize_t count = ::recv(socket_, chunk, sizeof chunk, 0);
            if (count <= 0) return {};
            bytes.insert(bytes.end(), chunk, chunk + count);
            // [1, which request, error, result]
            const json answer = json::from_msgpack(bytes, true, false);
            if (!answer.is_array() || answer.size() != 4) continue;  // not whole yet
            return answer[2].is_null() ? std::optional(answer[3]) : std::nullopt;
        }
        return {};
    }

private:
    // No wait goes beyond the deadline. False where that has passed.
    bool limit() const {
        const auto left = std::chrono::duration_cast<std::chrono::microseconds>(
                              deadline_ - std::chrono::steady_clock::now())
                              .count();
        if (left <= 0) return false;
        const timeval wait{.tv_sec = left / 1'000'000, .tv_usec = left % 1'000'000};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
        ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof wait);
        return true;
    }

    Deadline deadline_;
    int socket_ = -1;
    bool connected_ = false;
    int requests_ = 0;
};

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

// A text of Vim script.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
    return result + "'";
}

bool has_loaded(Neovim& neovim, const std::string& file) {
    const auto count = neovim.evaluate(fmt::format(
        "len(filter(getbufinfo({{'bufloaded': 1}}), {{_, b -> resolve(b.name) ==# {}}}))",
        quoted(file)));
    return count && count->is_number() && *count != 0;
}

bool show(Neovim& neovim, const std::string& file, const Place& place) {
    return neovim
        .evaluate(fmt::format("[execute('drop ' . fnameescape({})), cursor({}, {})]", quoted(file),
                              std::max(place.line, 1), std::max(place.column, 1)))
        .has_value();
}

// Where each Neovim listens that was told no place: $XDG_RUNTIME_DIR/nvim.PID.0 or
// /tmp/nvim.USER/RANDOM/nvim.PID.0, before 0.8 /tmp/nvimRANDOM/0. Only this user's count.
std::vector<std::string> sockets() {
    std::vector<std::string> found;
    const auto look = [&](const auto& self, const fs::path& folder, int depth) -> void {
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            const std::string name = entry->path().filename().string();
            if (depth == 0 && !name.starts_with("nvim")) continue;
            struct stat status {};
            if (::lstat(entry->path().c_str(), &status) != 0 || status.st_uid != ::getuid())
                continue;
            if (S_ISSOCK(status.st_mode)) found.push_back(entry->path().string());
            if (S_ISDIR(status.st_mode) && depth < 2) self(self, entry->path(), depth + 1);
        }
    };
    const std::string temporary = variable("TMPDIR");
    for (const std::string& folder :
         {variable("XDG_RUNTIME_DIR"), temporary.empty() ? std::string("/tmp") : temporary})
        if (!folder.empty()) look(look, folder, 0);
    return found;
}

}  // namespace

bool jump_in_neovim(const std::string& address, const Place& place) {
    std::error_code error;
    const fs::path whole = fs::canonical(place.file, error);
    const std::string file = error ? fs::absolute(place.file).string() : whole.string();
    const Deadline deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
    for (const std::string& named :
         address.empty() ? std::vector{variable("NVIM"), variable("NVIM_LISTEN_ADDRESS")}
                         : std::vector{address}) {
        if (named.empty()) continue;
        if (Neovim neovim(named, deadline); show(neovim, file, place)) return true;
    }
    if (!address.empty()) return false;
    for (const std::string& socket : sockets()) {
        Neovim neovim(socket, deadline);
        if (has_loaded(neovim, file) && show(neovim, file, place)) return true;
    }
    return false;
}

}  // namespace glint
