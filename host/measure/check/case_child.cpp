#include "measure/check/case_child.h"

#include "base/json_text.h"
#include "base/launch.h"
#include "base/terminal.h"
#include "measure/check/budget.h"
#include "measure/probe/loop_turns.h"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

// The sanitizers' own exit, so that what they find does not read as a result.
constexpr int kNoResult = 99;

void tell(int socket, const Json& line) {
    const std::string text = json_text(line, -1) + "\n";
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t count = ::write(socket, text.data() + done, text.size() - done);
        if (count < 0 && errno != EINTR) _exit(kNoResult);  // nobody listens any more
        if (count > 0) done += static_cast<std::size_t>(count);
    }
}

// The number of the case to run; nothing when there is none left.
std::optional<std::size_t> next_case(int socket) {
    std::size_t number = 0;
    for (;;) {
        const ssize_t count = ::read(socket, &number, sizeof number);
        if (count == sizeof number) return number;
        if (count >= 0 || errno != EINTR) return std::nullopt;
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
    explicit Heartbeat(int socket) : socket_(socket) {}
    void operator()() {
        if (since_told_.ms() < 200.0) return;
        since_told_.restart();
        tell(socket_, {{"alive", true}});
    }

private:
    int socket_;
    Stopwatch since_told_;
};

constexpr double kLeastPace = 0.1;

// With an effort no clock may tell: a scene gets fewer frames where its loops take so many turns
// for each of the picture's pixels that a frame takes long anywhere.
double pace_by_turns(CheckSubject& subject) {
    constexpr double kMany = 16384.0;
    if (!subject.is_short()) return 1.0;  // counting would take a minute to compile
    try {
        LoopTurns turns(subject.opened(), subject.renderer(), {.specialise = subject.specialised()},
                        subject.after_frame);
        const Frame frame = subject.frame_at(subject.preset.time, 1.0 / 60, 0);
        turns.count(frame, [&] { subject.draw(frame); });
        return turns.a_pixel() > kMany ? kLeastPace : 1.0;
    } catch (const ProbeRefused&) {
        return 1.0;
    }
}

// How much of the usual number of frames a scene can afford. Beyond 20 ms a frame the usual number,
// some 3000, takes more than a minute.
double pace_of(CheckSubject& subject, const Effort& effort) {
    constexpr double kQuick = 20.0;
    if (effort.tries) return pace_by_turns(subject);
    if (effort.seconds == 0.0) return 1.0;
    subject.draw_blindly(subject.frame_at(0.0, 1.0 / 60, 0));  // compiles to machine code
    const WorkClock clock(subject.context());
    subject.draw_blindly(subject.frame_at(1.0 / 60, 1.0 / 60, 1));
    subject.draw_blindly(subject.frame_at(2.0 / 60, 1.0 / 60, 2));
    return std::clamp(kQuick / std::max(clock.ms() / 2.0, kQuick), kLeastPace, 1.0);
}

// A scene under check in two forms: as its preset specialises it, and, for cases that change
// tweaks, fed with uniforms; made when the first such case comes.
class Subjects {
public:
    Subjects(const FileCheck& wanted, int socket)
        : wanted_(wanted),
          socket_(socket),
          preset_(wanted.is_told ? open_preset_again(small(wanted.view))
                                 : open_preset(small(wanted.view))),
          context_(make_egl_context(wanted.view.device)) {
        make(special_, special_check_, {});
        special_check_->pace = pace_of(*special_, wanted_.effort);
    }

    Check& for_tweaks(Case::Tweaks tweaks) {
        if (tweaks == Case::Tweaks::none) return *special_check_;
        if (!fed_) {
            make(fed_, fed_check_, {.specialise = false});
            fed_check_->pace = special_check_->pace;
            fed_check_->begun = special_check_->begun;
        }
        return *fed_check_;
    }

    std::vector<Case> cases() const {
        std::vector<Case> list = all_cases(*special_, wanted_.effort);
        std::erase_if(list, [&](const Case& c) { return !c.name.starts_with(wanted_.only); });
        return list;
    }

    std::string renderer() const { return context_->renderer(); }

private:
    void make(std::optional<CheckSubject>& subject, std::optional<Check>& check,
              const SubjectOptions& options) {
        tell(socket_, {{"compiling", true}});  // which has limits of its own, and is no hang
        subject.emplace(wanted_.view, preset_, *context_, options);
        tell(socket_, {{"compiling", false}});
        subject->after_frame = Heartbeat(socket_);
        check.emplace(
            Check{.subject = *subject, .effort = wanted_.effort, .folder = wanted_.folder});
    }

    const FileCheck& wanted_;
    int socket_;
    Preset preset_;
    std::unique_ptr<Context> context_;
    std::optional<CheckSubject> special_, fed_;
    std::optional<Check> special_check_, fed_check_;
};

void run_cases(const FileCheck& wanted, int socket) {
    if (wanted.is_told) hush_warnings();
    Subjects subjects(wanted, socket);
    const std::vector<Case> cases = subjects.cases();
    Json list = Json::array();
    for (const Case& one : cases)
        list.push_back({one.name, static_cast<int>(one.tweaks), one.group});
    tell(socket, {{"renderer", subjects.renderer()}, {"cases", list}});
    while (const auto number = next_case(socket)) {
        const Case& next = cases.at(*number);
        tell(socket, {{"result", to_json(run_case(subjects.for_tweaks(next.tweaks), next))}});
    }
}

}  // namespace

void be_a_case_child(const FileCheck& wanted, int socket, pid_t parent) {
    end_with(parent);
    const auto leave = [](ExitCode code) {
        std::fflush(nullptr);
        _exit(static_cast<int>(code));
    };
    try {
        run_cases(wanted, socket);
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

}  // namespace glint
