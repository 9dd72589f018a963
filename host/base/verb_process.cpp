#include "base/verb_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

namespace glint {
namespace {

// The window is to stay quick; what is timed is told by the processor's clock where others are.
constexpr int kNiceness = 10;

}  // namespace

VerbProcess::~VerbProcess() {
    end();
    if (messages_ >= 0) ::close(messages_);
}

void VerbProcess::start(std::vector<std::string> words) {
    end();
    words.insert(words.begin(), "glint");
    if (messages_ >= 0) ::close(messages_);
    messages_ = ::memfd_create("messages", MFD_CLOEXEC);
    const Launched verb = launch({.words = std::move(words),
                                  .program = "/proc/self/exe",
                                  .output = kPipe,
                                  .messages = messages_,
                                  .group = Launch::Group::own,
                                  .core_files = false,
                                  .niceness = kNiceness});
    if (verb.error != 0)
        throw std::system_error(verb.error, std::generic_category(), "There is no process");
    process_ = verb.process;
    out_ = verb.pipe;
    ::fcntl(out_, F_SETFL, O_NONBLOCK);
}

void VerbProcess::end() {
    if (out_ >= 0) ::close(std::exchange(out_, -1));
    heard_.clear();
    dying_.end(process_);
}

void VerbProcess::reap() {
    dying_.reap();
    if (!is_ending()) return;
    const std::optional<int> code = ended(process_);
    if (!code) return;
    process_ = 0;
    exit_code_ = *code;
}

std::vector<std::string> VerbProcess::lines() {
    std::vector<std::string> whole;
    std::array<char, 16 * 1024> chunk;
    while (out_ >= 0) {
        const ssize_t length = ::read(out_, chunk.data(), chunk.size());
        if (length < 0 && errno == EINTR) continue;
        if (length < 0 && errno == EAGAIN) break;
        if (length <= 0) {
            ::close(std::exchange(out_, -1));
            break;
        }
        heard_.append(chunk.data(), static_cast<std::size_t>(length));
    }
    std::size_t begin = 0;
    for (std::size_t at; (at = heard_.find('\n', begin)) != std::string::npos; begin = at + 1) {
        whole.push_back(heard_.substr(begin, at - begin));
    }
    heard_.erase(0, begin);
    reap();
    return whole;
}

// The first error, or else the last line.
std::string VerbProcess::complaint() const {
    std::array<char, 16 * 1024> text;
    const ssize_t length = messages_ < 0 ? 0 : ::pread(messages_, text.data(), text.size(), 0);
    std::string_view rest(text.data(), static_cast<std::size_t>(length > 0 ? length : 0));
    std::string_view last;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (!line.empty()) last = line;
        if (line.find("error: ") != std::string_view::npos) break;
    }
    return std::string(last);
}

}  // namespace glint
