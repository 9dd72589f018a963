#include "window/live/reloader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace glint {
namespace {

constexpr std::size_t kKeptReports = 100;

std::string line_of(const ReloadReport& report, const Diagnostics& diagnostics) {
    const std::string name = report.file.filename().string();
    if (report.shown) {
        return fmt::format(
            "{}: shown; read {:.1f}, trial {:.1f}, compile {:.1f}, first frame {:.1f} ms", name,
            report.read_ms, report.trial_ms, report.compile_ms, report.first_frame_ms);
    }
    const auto errors = std::ranges::count(diagnostics, Severity::error, &Diagnostic::severity);
    return fmt::format("{}: not shown, {} error{}; read {:.1f}, trial {:.1f} ms", name, errors,
                       errors == 1 ? "" : "s", report.read_ms, report.trial_ms);
}

}  // namespace

std::optional<ReloadState> next(ReloadState state, ReloadEvent event) {
    using enum ReloadState;
    constexpr auto never = std::nullopt;
    static constexpr std::optional<ReloadState> kNext[5][7] = {
        // clang-format off
        //                     read         unreadable  passed             refused  placed  moved        rested
        /* idle */             {trying_text, idle,      never,             never,   never,  idle,        trying_constants},
        /* trying_text */      {trying_text, idle,      placing_text,      idle,    never,  trying_text, never},
        /* placing_text */     {never,       never,     never,             idle,    idle,   never,       never},
        /* trying_constants */ {trying_text, idle,      placing_constants, idle,    never,  idle,        never},
        /* placing_constants */{never,       never,     never,             idle,    idle,   never,       never},
        // clang-format on
    };
    return kNext[static_cast<int>(state)][static_cast<int>(event)];
}

std::string_view name_of(ReloadState state) {
    static constexpr std::string_view kNames[] = {"idle", "trying text", "placing text",
                                                  "trying constants", "placing constants"};
    return kNames[static_cast<int>(state)];
}

Reloader::Reloader(ReloadSteps steps, const ReloaderOptions& options)
    : steps_(std::move(steps)),
      options_(options),
      programs_(options.constants ? Programs::uniforms : Programs::uniforms_for_good) {}

void Reloader::on(ReloadEvent event) {
    const std::optional<ReloadState> now = next(state_, event);
    assert(now);
    state_ = *now;
    if (state_ == ReloadState::idle) tried_.reset();
}

void Reloader::open(const std::filesystem::path& file) {
    file_ = file;
    written_.reset();
    read(file);
}

void Reloader::saved(const std::filesystem::path& changed) {
    read(changed);
}

void Reloader::go_on_in(const std::filesystem::path& file, const Preset& preset) {
    file_ = file;
    written_ = preset;
    read(file);
}

void Reloader::read(const std::filesystem::path& changed) {
    ReloadReport report{.file = changed, .text = {}};
    const Stopwatch clock;
    ReadPreset read = steps_.read(file_);
    report.read_ms = clock.ms();
    steps_.watch(read);
    read_from_ = std::move(read.files);
    diagnostics_ = std::move(read.diagnostics);
    if (!read.preset) {
        on(ReloadEvent::unreadable);
        return refuse_text(std::move(report));
    }
    const bool by_constants = options_.constants && !steps_.has_uniforms(*read.preset);
    tried_ = {std::move(*read.preset), std::move(report),
              by_constants ? Programs::constants : Programs::uniforms};
    on(ReloadEvent::read);
    steps_.start_trial(tried_->preset, tried_->programs, true);
}

// The picture stays as it was; the diagnostics say why.
void Reloader::refuse_text(ReloadReport report) {
    refused_ = true;
    finish(std::move(report));
}

bool Reloader::follow() {
    const Verdict& verdict = steps_.trial();
    if (!is_trying() || verdict.state == TrialState::running) return false;
    const bool is_hopeless =
        verdict.state == TrialState::passed && verdict.expected_ms > options_.hopeless_ms;
    const bool passed = !is_hopeless && (verdict.state == TrialState::passed ||
                                         verdict.state == TrialState::unavailable);
    if (state_ == ReloadState::trying_constants) {
        on(passed ? ReloadEvent::passed : ReloadEvent::refused);
        if (passed) place_constants();
        if (!passed) programs_ = Programs::uniforms_for_good;  // they do as well
        return false;
    }
    ReloadReport& report = tried_->report;
    report.trial_ms = verdict.total_ms;
    diagnostics_.insert(diagnostics_.end(), verdict.diagnostics.begin(), verdict.diagnostics.end());
    // The trial's last word.
    const bool is_slow = verdict.expected_ms > options_.slow_ms && !verdict.diagnostics.empty();
    slowness_ = is_slow ? verdict.diagnostics.back().text : "";
    if (is_hopeless) {
        tell({.place = {.file = file_.string()},
              .text = fmt::format("a frame would take about {:.0f} s; make it cheaper, or lower "
                                  "the resolution",
                                  verdict.expected_ms / 1000.0)});
    }
    if (passed) {
        on(ReloadEvent::passed);
        return place_text();
    }
    refuse_text(std::move(report));
    on(ReloadEvent::refused);
    return false;
}

// Whether it is on the screen now.
bool Reloader::place_text() {
    const Stopwatch clock;
    const Diagnostics why_not = steps_.put_in_place(tried_->preset, tried_->programs, true);
    Tried tried = std::move(*tried_);
    if (!why_not.empty()) {
        on(ReloadEvent::refused);
        diagnostics_.insert(diagnostics_.end(), why_not.begin(), why_not.end());
        refuse_text(std::move(tried.report));
        return false;
    }
    on(ReloadEvent::placed);
    refused_ = false;
    programs_ = tried.programs;
    if (programs_ == Programs::uniforms) uses_uniforms();
    written_ = std::move(tried.preset);
    unseen_ = std::move(tried.report);
    unseen_->compile_ms = clock.ms();
    return true;
}

void Reloader::place_constants() {
    const bool placed = steps_.put_in_place(tried_->preset, Programs::constants, false).empty();
    on(placed ? ReloadEvent::placed : ReloadEvent::refused);
    programs_ = placed ? Programs::constants : Programs::uniforms_for_good;
}

void Reloader::tweaks_moved() {
    on(ReloadEvent::moved);
    if (programs_ == Programs::uniforms_for_good) uses_uniforms();
}

void Reloader::uses_uniforms() {
    programs_ = options_.constants ? Programs::uniforms : Programs::uniforms_for_good;
}

void Reloader::tweaks_rest(const Preset& drawn) {
    if (!wants_constants()) return;
    tried_ = {drawn, {}};
    on(ReloadEvent::rested);
    steps_.start_trial(tried_->preset, Programs::constants, false);
}

void Reloader::input_arrived(const ReloadReport& report) {
    if (!unseen_) unseen_ = report;
}

void Reloader::input_failed(const ReloadReport& report, const Diagnostic& why) {
    tell(why);
    if (!unseen_) finish(report);
}

void Reloader::drawn(double frame_ms) {
    if (!unseen_) return;
    ReloadReport report = std::move(*unseen_);
    report.shown = true;
    report.first_frame_ms = frame_ms;
    finish(std::move(report));
}

void Reloader::forget_missing_file(const std::string& why) {
    std::erase_if(diagnostics_,
                  [&](const Diagnostic& d) { return d.missing_file && d.text == why; });
}

void Reloader::forget_slowness() {
    if (slowness_.empty()) return;
    std::erase_if(diagnostics_, [&](const Diagnostic& d) { return d.text == slowness_; });
    slowness_.clear();
}

bool Reloader::is_read_from(const std::filesystem::path& file) const {
    return std::ranges::find(read_from_, file) != read_from_.end();
}

void Reloader::finish(ReloadReport report) {
    report.text = line_of(report, diagnostics_);
    reports_.push_back(std::move(report));
    ++report_count_;
    if (reports_.size() > kKeptReports) reports_.pop_front();
    unseen_.reset();
}

}  // namespace glint
