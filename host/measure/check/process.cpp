#include "measure/check/process.h"

#include "base/json_text.h"
#include "base/launch.h"
#include "base/terminal.h"
#include "measure/check/budget.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <utility>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostRestarts = 8;  // hangs and crashes of one file; then the rest is left out
// The sanitizers' own exit, so that what they find does not read as a result.
constexpr int kNoResult = 99;

// ---- The child: one line of JSON for everything that the parent has to know ---------------------

void tell(int pipe, const Json& line) {
    const std::string text = json_text(line, -1) + "\n";
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t count = ::write(pipe, text.data() + done, text.size() - done);
        if (count < 0 && errno != EINTR) _exit(kNoResult);  // nobody listens any more
        if (count > 0) done += static_cast<std::size_t>(count);
    }
}

ViewOptions small(const ViewOptions& view) {
    ViewOptions result = view;
    if (result.size.empty()) result.size = "96x54";
    return result;
}

// Tells now and then that the driver still answers.
class Heartbeat {
public:
    explicit Heartbeat(int pipe) : pipe_(pipe) {}
    void operator()() {
        if (since_told_.ms() < 200.0) return;
        since_told_.restart();
        tell(pipe_, {{"alive", true}});
    }

private:
    int pipe_;
    Stopwatch since_told_;
};

// How much of the usual number of frames a scene can afford. Beyond 20 ms a frame the usual number,
// some 3000, takes more than a minute.
double pace_of(CheckSubject& subject, const Effort& effort) {
    constexpr double kQuick = 20.0, kLeast = 0.1;
    if (effort.seconds == 0.0) return 1.0;
    subject.draw_blindly(subject.frame_at(0.0, 1.0 / 60, 0));  // compiles to machine code
    const Stopwatch clock;
    subject.draw_blindly(subject.frame_at(1.0 / 60, 1.0 / 60, 1));
    subject.draw_blindly(subject.frame_at(2.0 / 60, 1.0 / 60, 2));
    return std::clamp(kQuick / std::max(clock.ms() / 2.0, kQuick), kLeast, 1.0);
}

// `wanted.effort.seconds` are those that are left; of `all_seconds` people have heard.
void run_cases(const FileCheck& wanted, double all_seconds, std::size_t first, int pipe) {
    const Preset preset = open_preset(small(wanted.view));
    const auto context = make_egl_context(wanted.view.device);
    // Compiling has limits of its own, and is no hang.
    tell(pipe, {{"compiling", true}});
    CheckSubject subject(wanted.view, preset, *context);
    tell(pipe, {{"compiling", false}});
    std::optional<CheckSubject> fed;  // with uniforms, for cases that change tweaks
    std::optional<Check> with_uniforms;
    std::vector<Case> cases = all_cases(subject, wanted.effort);
    std::erase_if(cases, [&](const Case& c) { return !c.name.starts_with(wanted.only); });
    tell(pipe, {{"renderer", context->renderer()}, {"cases", cases.size()}});
    subject.after_frame = Heartbeat(pipe);
    Check check{.subject = subject,
                .effort = wanted.effort,
                .pace = pace_of(subject, wanted.effort),
                .folder = wanted.folder};
    SharedSeconds seconds(wanted.effort);
    const Stopwatch clock;
    for (std::size_t i = first; i < cases.size(); ++i) {
        const Case& next = cases[i];
        tell(pipe, {{"begin", next.name}});
        CaseResult result{.name = next.name, .verdict = CaseVerdict::skip};
        if (wanted.scene_is_known && next.tweaks >= Case::Tweaks::all) {
            result.note = "the same as with the preset before";
        } else if (seconds.is_over(next, clock.ms())) {
            result.note = fmt::format("left out: --seconds {} were over", all_seconds);
        } else if (next.tweaks == Case::Tweaks::none) {
            result = run_case(check, next);
        } else {
            tell(pipe, {{"compiling", true}});
            if (!fed)
                fed.emplace(wanted.view, preset, *context, SubjectOptions{.specialise = false});
            tell(pipe, {{"compiling", false}});
            fed->after_frame = subject.after_frame;
            if (!with_uniforms)
                with_uniforms.emplace(Check{.subject = *fed,
                                            .effort = wanted.effort,
                                            .pace = check.pace,
                                            .folder = wanted.folder});
            result = run_case(*with_uniforms, next);
        }
        tell(pipe, {{"result", to_json(result)}});
    }
    tell(pipe, {{"end", true}});
}

[[noreturn]] void be_the_child(const FileCheck& wanted, double all_seconds, std::size_t first,
                               int pipe, pid_t parent) {
    end_with(parent);
    const auto leave = [](ExitCode code) {
        std::fflush(nullptr);
        _exit(static_cast<int>(code));
    };
    try {
        run_cases(wanted, all_seconds, first, pipe);
        leave(ExitCode::done);
    } catch (const Stop& stop) {
        leave(stop.code);
    } catch (const UsageError& error) {
        say_error(error.what());
        leave(ExitCode::usage);
    } catch (const NoContext& error) {
        say_error(error.what());
        leave(ExitCode::no_context);
    } catch (const ContextLost&) {
        leave(ExitCode::context_lost);
    } catch (const std::exception& error) {
        say_error(error.what());
    }
    leave(ExitCode::failure);
    std::abort();
}

// ---- The parent ---------------------------------------------------------------------------------

// A child and what it tells, until it ends or is silent for too long.
class CaseProcess {
public:
    CaseProcess(const FileCheck& wanted, double all_seconds, std::size_t first) {
        std::array<int, 2> ends{};
        if (::pipe(ends.data()) != 0) throw std::runtime_error("There is no pipe to be had.");
        std::fflush(nullptr);
        const pid_t parent = ::getpid();
        pid_ = ::fork();
        if (pid_ < 0) throw std::runtime_error("There is no process to be had.");
        if (pid_ == 0) {
            ::close(ends[0]);
            be_the_child(wanted, all_seconds, first, ends[1], parent);
        }
        ::close(ends[1]);
        pipe_ = ends[0];
    }
    ~CaseProcess() {
        ::close(pipe_);
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        wait_for(pid_);
    }
    CaseProcess(const CaseProcess&) = delete;
    CaseProcess& operator=(const CaseProcess&) = delete;

    // The next line; nothing at the end, or after `seconds` of silence, which ends the child.
    std::optional<Json> next(double seconds) {
        for (;;) {
            const std::size_t end = text_.find('\n');
            if (end != std::string::npos) {
                Json line = Json::parse(text_.substr(0, end));
                text_.erase(0, end + 1);
                return line;
            }
            pollfd readable{pipe_, POLLIN, 0};
            const double worked = processor_seconds();
            const int ready = ::poll(&readable, 1, static_cast<int>(seconds * 1000.0));
            if (ready < 0 && errno == EINTR) continue;
            hung_ = ready == 0;
            if (hung_) worked_ = processor_seconds() - worked;
            if (hung_) ::kill(pid_, SIGKILL);
            std::array<char, 4096> chunk;
            const ssize_t count = hung_ ? 0 : ::read(pipe_, chunk.data(), chunk.size());
            if (count <= 0) return std::nullopt;
            text_.append(chunk.data(), static_cast<std::size_t>(count));
        }
    }

    bool hung() const { return hung_; }
    // Processor time that it took while it was silent, when that ended it.
    double worked() const { return worked_; }

    // Its exit code, or minus the signal that ended it.
    int wait() { return wait_for(std::exchange(pid_, -1)); }

private:
    pid_t pid_ = -1;
    int pipe_ = -1;
    double processor_seconds() const {
        clockid_t clock{};
        timespec spent{};
        if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &spent) != 0)
            return 0.0;
        return static_cast<double>(spent.tv_sec) + static_cast<double>(spent.tv_nsec) * 1e-9;
    }

    std::string text_;
    bool hung_ = false;
    double worked_ = 0.0;
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

// A frame that never comes is a hang. One that has not come because --seconds were short is one as
// well where it was worked on for half the time; otherwise the machine may have been busy.
CaseResult silent_case(const std::string& name, const CaseProcess& child, double waited,
                       const FileCheck& wanted) {
    CaseResult result{.name = name};
    if (waited >= wanted.hang_seconds || child.worked() > waited / 2) {
        result.fail(fmt::format("hangs: no frame within {:g} s", waited));
    } else {
        result.verdict = CaseVerdict::skip;
        result.note = fmt::format("left out: no frame within {:g} s, and --seconds {} were over",
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

}  // namespace

CheckedFile check_file(const FileCheck& wanted,
                       const std::function<void(const CheckedFile& so_far, long total)>& progress) {
    CheckedFile file{.scene = wanted.view.file.string()};
    const Stopwatch clock;
    SecondsLeft seconds(wanted.effort);
    FileCheck rest = wanted;
    long total = 0;
    for (int start = 0; start <= kMostRestarts; ++start) {
        rest.effort.seconds = seconds.left();
        CaseProcess child(rest, wanted.effort.seconds, file.cases.size());
        std::string running;
        bool ended = false, compiling = false;
        double wait = 0.0;
        const auto next_line = [&] {
            constexpr double kCompiling = 600.0;  // for drivers that sleep meanwhile
            wait = compiling ? kCompiling
                             : frame_wait_seconds(wanted.hang_seconds, wanted.effort.seconds,
                                                  seconds.left());
            return child.next(wait);
        };
        while (const auto line = next_line()) {
            compiling = line->value("compiling", compiling);
            if (line->contains("renderer")) file.renderer = line->at("renderer");
            if (line->contains("cases")) total = line->at("cases");
            if (line->contains("begin")) {
                running = line->at("begin");
                seconds.start();
            }
            if (line->contains("result")) file.cases.push_back(case_from_json(line->at("result")));
            ended |= line->contains("end");
            progress(file, total);
        }
        const int code = child.wait();
        if (ended) break;
        if (running.empty() && !child.hung()) {  // it did not come to the first case
            file.code = code > 0 ? static_cast<ExitCode>(code) : ExitCode::failure;
            break;
        }
        CaseResult result{.name = running.empty() ? "start" : running};
        if (child.hung())
            result = silent_case(result.name, child, wait, wanted);
        else
            result.fail(last_words(code));
        result.reproduce = command_for_case(wanted.view, result.name);
        file.cases.push_back(std::move(result));
        progress(file, total);
        const bool is_given_up = code == static_cast<int>(ExitCode::shader);
        if (is_given_up) file.code = ExitCode::shader;  // the driver would do the same again
        if (running.empty() || is_given_up) break;
    }
    file.seconds = clock.ms() / 1000.0;
    return file;
}

}  // namespace glint
