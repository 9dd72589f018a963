// A process of this program that is spoken with through a socket.
#pragma once

#include "base/launch.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

// Our side of it. To be used on one thread, which lives as long as the program: the process ends
// with it. Nothing here waits for the process.
class SocketProcess {
public:
    SocketProcess() = default;
    ~SocketProcess() { end(); }
    SocketProcess(const SocketProcess&) = delete;
    SocketProcess& operator=(const SocketProcess&) = delete;

    // Starts `program VERB [DEVICE]` with a socket as its standard input, `output`, a descriptor of
    // ours, as its standard output, and nothing else of ours: no blocked or ignored signal, and no
    // terminal, so that Ctrl+C is not for it. It ends with us, even in the middle of a draw. What
    // ran before is ended. Why there is none, as errno has it; 0 where there is.
    int start(const std::filesystem::path& program, const std::string& verb,
              const std::string& device, int niceness = 0, int output = kNothing);

    // Kills it; what was on its way is lost. Costs nothing where there is none.
    void end();

    // Sends this behind what the socket has not taken yet. The rest goes with later calls.
    void send(std::string_view bytes);

    // Appends what has come to `arrived`, and sends what waits. False when the process has closed
    // its end: it is done, or gone. True also where there is none.
    bool receive();
    std::string arrived;  // whoever reads it takes from its front

    // How it ended, as base/launch.h has it; nothing while that is not known. It is none of ours
    // any more then.
    std::optional<int> exit_code();

    pid_t id() const { return process_; }  // 0: there is none
    // For ::poll(): readable when receive() has something; -1 when there is no process.
    int descriptor() const { return socket_; }

private:
    pid_t process_ = 0;
    int socket_ = -1;
    std::string outgoing_;
    Dying dying_;
};

// For that process. Throws UsageError when it has no socket.
void require_socket(const char* verb);

}  // namespace glint
