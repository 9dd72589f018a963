#include "measure/check/process.h"

#include "base/launch.h"
#include "base/process_time.h"
#include "measure/check/budget.h"
#include "measure/check/case_child.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

const unsigned kProcessors = std::max(1u, std::thread::hardware_concurrency());
constexpr int kMostRestarts = 8;  // hangs and crashes of one file; then the rest is left out

// A child, what it tells, and which case it runs, until it ends or is silent for too long.
class CaseProcess {
public:
    explicit CaseProcess(const FileCheck& wanted) {
        std::array<int, 2> ends{};
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            throw std::runtime_error("There is no socket to be had.");
        std::fflush(nullptr);
        const pid_t parent = ::getpid();
        pid_ = ::fork();
        if (pid_ < 0) throw std::runtime_error("There is no process to be had.");
        if (pid_ == 0) {
            ::close(ends[0]);
            be_a_case_child(wanted, ends[1], parent);
        }
        ::close(ends[1]);
        socket_ = ends[0];
        heard();
    }
    ~CaseProcess() {
        ::close(socket_);
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        wait_for(pid_);
    }
    CaseProcess(const CaseProcess&) = delete;
    CaseProcess& operator=(const CaseProcess&) = delete;

    int socket() const { return socket_; }

    void run(std::size_t number) {
        running = number;
        heard();
        // One that is gone is found when its socket is read.
        (void)::send(socket_, &number, sizeof number, MSG_NOSIGNAL);
    }
    void run_no_more() { ::shutdown(socket_, SHUT_WR); }

    // What it has told since, to be asked when its socket can be read. False at its end.
    bool read(const std::function<void(const Json&)>& line) {
        std::array<char, 4096> chunk;
        const ssize_t count = ::read(socket_, chunk.data(), chunk.size());
        if (count < 0 && errno == EINTR) return true;
        if (count <= 0) return false;
        heard();
        text_.append(chunk.data(), static_cast<std::size_t>(count));
        for (std::size_t end; (end = text_.find('\n')) != std::string::npos;) {
            const Json told = Json::parse(text_.substr(0, end));
            text_.erase(0, end + 1);
            compiling_ = told.value("compiling", compiling_);
            line(told);
        }
        return true;
    }

    // From its last word on it may be silent for so many seconds, but while it compiles.
    void wait_at_most(double seconds) { patience_ = seconds; }
    // What is left of them.
    double patience() const { return limit() - silent_.ms() / 1000.0; }
    // Whether none is left, and others did not keep it from the processors.
    bool is_too_silent() const {
        return patience() <= 0.0 &&
               had_its_time(limit(), silent_.ms() / 1000.0, since_heard(), kProcessors);
    }
    // Ends it; what it did while it was silent tells whether it hung.
    void end_silent() {
        waited_ = silent_.ms() / 1000.0;
        since_ = since_heard();
        hung_ = true;
        ::kill(pid_, SIGKILL);
    }

    bool hung() const { return hung_; }
    double waited() const { return waited_; }
    // What it had of the processors while it was silent, when that ended it.
    const ProcessTime& since() const { return since_; }

    // Its exit code, or minus the signal that ended it.
    int wait() { return wait_for(std::exchange(pid_, -1)); }

    std::optional<std::size_t> running{};  // its case
    bool is_asked = false;                 // it has compiled, and gets cases

private:
    void heard() {
        silent_.restart();
        before_ = time_of(pid_);
    }
    double limit() const {
        constexpr double kCompiling = 600.0;  // for drivers that sleep meanwhile
        return compiling_ ? kCompiling : patience_;
    }
    ProcessTime since_heard() const {
        const ProcessTime now = time_of(pid_);
        return {now.used - before_.used, now.waited - before_.waited};
    }

    pid_t pid_ = -1;
    int socket_ = -1;
    std::string text_;
    Stopwatch silent_;
    bool compiling_ = false, hung_ = false;
    double patience_ = 0.0, waited_ = 0.0;
    ProcessTime before_{}, since_{};
};

// What is left of --seconds, from the first case on.
class SecondsLeft {
public:
    explicit SecondsLeft(const Effort& effort) : all_(effort.seconds) {}
    void start() {
        if (!started_) since_.restart();
        started_ = true;
    }
    // None left is little, since 0 has no limit.
    double left() const {
        constexpr double kLittle = 1e-3;
        if (all_ == 0.0 || !started_) return all_;
        return std::max(all_ - since_.ms() / 1000.0, kLittle);
    }

private:
    double all_;
    bool started_ = false;
    Stopwatch since_;
};

// A frame that never comes is a hang, unless others had the processors meanwhile. One that has not
// come because --seconds were short is one as well where it was worked on for half the time.
CaseResult silent_case(const std::string& name, const CaseProcess& child, const FileCheck& wanted) {
    CaseResult result{.name = name};
    const double waited = child.waited();
    const bool hangs = had_its_time(wanted.hang_seconds, waited, child.since(), kProcessors);
    if (hangs || child.since().used > waited / 2) {
        result.fail(fmt::format("hangs: no frame within {:.3g} s", waited));
    } else {
        result.verdict = CaseVerdict::skip;
        result.note = fmt::format("left out: no frame within {:.3g} s, and --seconds {} were over",
                                  waited, wanted.effort.seconds);
    }
    return result;
}

// What a case is told that ended its process.
std::string last_words(int code) {
    if (code == static_cast<int>(ExitCode::context_lost)) return "the GPU was lost";
    if (code < 0) return fmt::format("the driver crashed: {}", ::strsignal(-code));
    return fmt::format("could not be drawn (exit code {})", code);
}

// How many processes share the cases of a file. What an --effort finds must not depend on the
// machine, nor on who finds it first; and a second process pays for a compilation of its own.
std::size_t crew_of(const FileCheck& wanted, std::size_t cases) {
    constexpr double kWorth = 10.0;  // s
    constexpr std::size_t kMost = 4, kCasesEach = 8;
    if (wanted.effort.seconds < kWorth) return 1;
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    return std::clamp<std::size_t>(cases / kCasesEach, 1, std::min(cores, kMost));
}

// One file: hands its cases out, in their order, to whoever has none.
class FileWork {
public:
    FileWork(const FileCheck& wanted,
             const std::function<void(const CheckedFile& so_far, long total)>& progress)
        : wanted_(wanted),
          progress_(progress),
          file_{.scene = wanted.view.file.string()},
          left_(wanted.effort),
          shared_(wanted.effort) {}

    CheckedFile run() {
        const Stopwatch clock;
        start_one();
        while (!children_.empty() && !is_done()) {
            const auto spoke = wait_for_word();
            if (spoke == children_.end()) continue;
            CaseProcess& child = **spoke;
            if (child.hung() || !child.read([&](const Json& line) { hear(child, line); }))
                at_the_end(spoke);
        }
        put_in_order();
        file_.seconds = clock.ms() / 1000.0;
        return std::move(file_);
    }

private:
    using Children = std::vector<std::unique_ptr<CaseProcess>>;

    // Then nobody is waited for who still compiles.
    bool is_done() const { return !cases_.empty() && numbers_.size() == cases_.size(); }

    double frame_limit() const {
        return frame_wait_seconds(wanted_.hang_seconds, wanted_.effort.seconds, left_.left());
    }

    void start_one() {
        FileCheck rest = wanted_;
        rest.effort.seconds = left_.left();
        rest.is_told = std::exchange(is_told_, true);
        children_.push_back(std::make_unique<CaseProcess>(rest));
        children_.back()->wait_at_most(frame_limit());
    }

    // Who can be read, or has been silent for too long; the end when nobody.
    Children::iterator wait_for_word() {
        std::vector<pollfd> sockets;
        double seconds = 600.0;
        for (const auto& child : children_) {
            sockets.push_back({child->socket(), POLLIN, 0});
            seconds = std::clamp(child->patience(), 0.1, seconds);
        }
        ::poll(sockets.data(), sockets.size(), static_cast<int>(seconds * 1000.0) + 1);
        for (std::size_t i = 0; i < sockets.size(); ++i)
            if (sockets[i].revents != 0) return children_.begin() + static_cast<std::ptrdiff_t>(i);
        const auto silent = std::ranges::find_if(
            children_, [](const auto& child) { return child->is_too_silent(); });
        if (silent != children_.end()) (*silent)->end_silent();
        return silent;
    }

    void hear(CaseProcess& child, const Json& line) {
        if (line.contains("cases")) {
            if (cases_.empty()) begin(line);
            child.is_asked = true;
            give(child);
        }
        if (line.contains("result")) {
            keep(*child.running, case_from_json(line.at("result")));
            give(child);
        }
        child.wait_at_most(frame_limit());
        tell();
    }

    // The first to have compiled tells which cases there are.
    void begin(const Json& line) {
        file_.renderer = line.at("renderer");
        for (const Json& one : line.at("cases"))
            cases_.push_back({.name = one.at(0),
                              .run = {},
                              .tweaks = static_cast<Case::Tweaks>(one.at(1).get<int>()),
                              .group = one.at(2)});
        left_.start();
        clock_.restart();
    }

    // Nobody else draws while the first group runs, which compares times.
    void call_others() {
        if (std::exchange(are_called_, true)) return;
        while (children_.size() < crew_of(wanted_, cases_.size())) start_one();
    }

    // Why it is not run; "" if it is.
    std::string why_left_out(const Case& next) {
        if (wanted_.scene_is_known && next.tweaks >= Case::Tweaks::all)
            return "the same as with the preset before";
        if (shared_.is_over(next, clock_.ms()))
            return fmt::format("left out: --seconds {} were over", wanted_.effort.seconds);
        return {};
    }

    void give(CaseProcess& child) {
        child.running.reset();
        while (next_ < cases_.size()) {
            const std::size_t number = next_++;
            std::string why = why_left_out(cases_[number]);
            if (why.empty()) {
                if (cases_[number].group > 0) call_others();
                return child.run(number);
            }
            keep(number, {.name = cases_[number].name,
                          .verdict = CaseVerdict::skip,
                          .note = std::move(why)});
        }
        child.run_no_more();
    }

    void keep(std::size_t number, CaseResult result) {
        numbers_.push_back(number);
        file_.cases.push_back(std::move(result));
    }
    void tell() const { progress_(file_, static_cast<long>(cases_.size())); }

    // A child has ended: it was done, never began, or its case has ended it.
    void at_the_end(Children::iterator which) {
        const std::unique_ptr<CaseProcess> child = std::move(*which);
        children_.erase(which);
        const int code = child->wait();
        if (!child->running && (!child->hung() || !children_.empty())) {  // others go on
            if (!child->is_asked && children_.empty())
                file_.code = code > 0 ? static_cast<ExitCode>(code) : ExitCode::failure;
            return;
        }
        CaseResult result{.name = child->running ? cases_[*child->running].name : "start"};
        if (child->hung())
            result = silent_case(result.name, *child, wanted_);
        else
            result.fail(last_words(code));
        result.reproduce = command_for_case(wanted_.view, result.name);
        keep(child->running.value_or(0), std::move(result));
        tell();
        const bool is_given_up = code == static_cast<int>(ExitCode::shader);
        if (is_given_up) file_.code = ExitCode::shader;  // the driver would do the same again
        if (!child->running || is_given_up) return children_.clear();
        if (restarts_++ < kMostRestarts && next_ < cases_.size()) start_one();
    }

    void put_in_order() {
        std::vector<std::size_t> order(numbers_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers_[i]; });
        std::vector<CaseResult> cases;
        for (const std::size_t i : order) cases.push_back(std::move(file_.cases[i]));
        file_.cases = std::move(cases);
    }

    const FileCheck& wanted_;
    const std::function<void(const CheckedFile& so_far, long total)>& progress_;
    CheckedFile file_;
    SecondsLeft left_;
    SharedSeconds shared_;
    Stopwatch clock_;  // since the first case
    std::vector<Case> cases_;
    std::size_t next_ = 0;
    std::vector<std::size_t> numbers_;  // of file_.cases, which stand as they ended
    Children children_;
    bool are_called_ = false, is_told_ = false;
    int restarts_ = 0;
};

}  // namespace

CheckedFile check_file(const FileCheck& wanted,
                       const std::function<void(const CheckedFile& so_far, long total)>& progress) {
    return FileWork(wanted, progress).run();
}

}  // namespace glint
