#include "window/trial/trial.h"

#include "scene/blame.h"
#include "window/trial/message.h"

#include <fmt/format.h>

#include <cstring>
#include <thread>

namespace glint {
namespace {

using namespace std::chrono_literals;

// A process that still works on an older candidate after this long is given up for the newer one.
constexpr auto kPatience = 200ms;
// How a process ended is waited for, without holding anybody up.
constexpr auto kLongestEnd = 1s;
// A driver that does not start will not do so the fourth time either.
constexpr int kMostFailedStarts = 3;

template <class Duration>
double seconds(Duration duration) {
    return std::chrono::duration<double>(duration).count();
}

// Of a process that ended like this.
std::string ending_words(int code) {
    if (code >= 0) return "ended by itself";
    return fmt::format("ended by signal {} ({})", -code, strsignal(-code));
}

}  // namespace

Trial::Trial(TrialOptions options)
    : options_(std::move(options)), heard_(std::make_unique<TrialAnswer>()) {
    if (options_.at_once) spawn();
}

Trial::~Trial() = default;

void Trial::spawn() {
    if (!unavailable_.empty()) return;
    heard_ = std::make_unique<TrialAnswer>();
    const int error = process_.start(options_.program, "trial", options_.device, options_.niceness);
    note_time();
    if (error == 0) {
        failed_launches_ = 0;
        return;
    }
    ++failed_launches_;
    unavailable_ =
        fmt::format("{} does not start: {}.", options_.program.string(), std::strerror(error));
}

// A new one, which is told of the candidate that still waits.
void Trial::replace_process() {
    process_.end();
    silent_since_.reset();
    renderer_.clear();
    spawn();
    if (is_running()) process_.send(order_);
}

void Trial::get_ready() {
    if (process_.id() == 0) spawn();
}

void Trial::start(const Candidate& candidate) {
    order_ = pack(++number_, candidate, options_.slow_ms);
    verdict_ = {};
    verdict_.state = TrialState::running;
    started_ = Clock::now();
    note_time();
    // A system that had no room for one more process may have it by now.
    if (failed_launches_ > 0 && failed_launches_ < kMostFailedStarts) unavailable_.clear();
    if (process_.id() == 0)
        replace_process();
    else
        process_.send(order_);
}

void Trial::receive() {
    const bool goes_on = process_.receive();
    while (const auto message = take_message(process_.arrived)) hear(unpack_answer(*message));
    if (!goes_on) hear_end_of_process();
}

void Trial::hear(TrialAnswer answer) {
    *heard_ = std::move(answer);
    note_time();
    if (heard_->verdict.state == TrialState::unavailable) {
        unavailable_ = heard_->verdict.diagnostics.front().text;
    } else if (heard_->stage == TrialStage::ready) {
        renderer_ = heard_->text;
        failed_starts_ = 0;
    } else if (heard_->number == number_ && is_running()) {
        verdict_ = heard_->verdict;
        verdict_.total_ms = seconds(Clock::now() - started_) * 1000.0;
    }
}

// It crashed, was killed by somebody, or has said why it cannot start. Its socket goes first, and
// its memory takes a while to follow on a busy machine.
void Trial::hear_end_of_process() {
    if (!silent_since_) silent_since_ = Clock::now();
    const std::optional<int> code = process_.exit_code();
    if (!code && Clock::now() - *silent_since_ < kLongestEnd) return;
    const bool was_ready = !renderer_.empty();
    if (!was_ready && ++failed_starts_ == kMostFailedStarts && unavailable_.empty()) {
        unavailable_ = fmt::format("It was {} when it started.", ending_words(code.value_or(0)));
    }
    const bool at_work = heard_->number == number_ && heard_->stage != TrialStage::ready;
    if (is_running() && at_work) {
        fail(TrialState::crashed,
             fmt::format("{} while {}", code ? ending_words(*code) : "gone",
                         heard_->stage == TrialStage::compiling ? "compiling" : "drawing"));
    }
    replace_process();
}

// Names the pass that was being worked on, and the place to look at.
void Trial::fail(TrialState state, const std::string& why) {
    const Scene scene = unpack_order(order_.substr(sizeof(std::uint64_t))).preset.scene;
    const auto loop = likely_endless_loop(scene);
    const std::string pass = is_at_work() ? heard_->text : "image";
    const bool slow = state == TrialState::too_slow;
    verdict_.state = state;
    verdict_.total_ms = seconds(Clock::now() - started_) * 1000.0;
    verdict_.diagnostics.push_back(
        {Severity::error, slow && loop ? *loop : entry_place(scene, pass),
         fmt::format("pass {}: {}{}", pass, slow ? "" : "the driver was ", why) +
             (!slow  ? "; the scene before goes on"
              : loop ? "; does this loop ever end?"
                     : "; is there a loop that never ends?")});
}

bool Trial::is_at_work() const {
    return heard_->stage == TrialStage::compiling || heard_->stage == TrialStage::drawing;
}

std::string Trial::work() const {
    if (renderer_.empty()) return "starting the driver";
    if (!is_at_work() || heard_->number != number_) return "compiling";
    return (heard_->stage == TrialStage::compiling ? "compiling " : "trying ") + heard_->text;
}

// What it does from now on is timed.
void Trial::note_time() {
    heard_at_ = Clock::now();
    heard_time_ = time_of(process_.id());
}

bool Trial::is_too_slow() const {
    const double wall = seconds(Clock::now() - heard_at_);
    if (wall <= limit_seconds()) return false;  // most often, and without a question to the kernel
    const ProcessTime now = time_of(process_.id());
    return had_its_time(
        limit_seconds(), wall,
        {.used = now.used - heard_time_.used, .waited = now.waited - heard_time_.waited},
        std::thread::hardware_concurrency());
}

double Trial::limit_seconds() const {
    return heard_->stage == TrialStage::drawing ? options_.draw_seconds : options_.compile_seconds;
}

const Verdict& Trial::poll() {
    receive();
    if (!is_running()) return verdict_;
    if (!unavailable_.empty() && process_.id() == 0) {
        verdict_.state = TrialState::unavailable;
        verdict_.diagnostics.resize(1);
        verdict_.diagnostics[0].severity = Severity::warning;
        verdict_.diagnostics[0].text = unavailable_;
        return verdict_;
    }
    if (is_at_work() && heard_->number != number_ && Clock::now() - started_ > kPatience) {
        replace_process();
    } else if (is_too_slow()) {
        const bool drawing = heard_->stage == TrialStage::drawing;
        fail(TrialState::too_slow,
             drawing ? fmt::format("no frame within {:g} s at {}", limit_seconds(), heard_->size)
                     : fmt::format("not compiled within {:g} s", limit_seconds()));
        replace_process();
    }
    return verdict_;
}

}  // namespace glint
