#include "window/live/playground.h"

#include "base/readable_file.h"
#include "media/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace glint {
namespace {

// A live frame catches up at most this much simulated time after a hitch.
constexpr double kLongestCatchUp = 0.25;  // s

// How long a replay may keep the window waiting in one frame.
constexpr double kReplaySlice = 30.0;  // ms

constexpr std::size_t kKeptReports = 100;

Date local_now() {
    std::timespec now{};
    std::timespec_get(&now, TIME_UTC);
    std::tm local{};
    localtime_r(&now.tv_sec, &local);
    return {.year = local.tm_year + 1900,
            .month = local.tm_mon + 1,
            .day = local.tm_mday,
            .seconds = local.tm_hour * 3600.0 + local.tm_min * 60.0 + local.tm_sec +
                       static_cast<double>(now.tv_nsec) * 1e-9};
}

// Tweaks whose value in the file is another than when it was last read: those that a person changed
// there, and not in the panels.
void apply_saved_changes(const Preset& before, const Preset& now, History& history) {
    for (std::size_t i = 0; i < now.scene.tweaks.size(); ++i) {
        const Tweak& tweak = now.scene.tweaks[i];
        const auto& old = before.scene.tweaks;
        const auto same = std::find_if(old.begin(), old.end(), [&](const Tweak& t) {
            return t.name == tweak.name && t.type == tweak.type;
        });
        if (same == old.end()) continue;
        const TweakValue& was = before.values[static_cast<std::size_t>(same - old.begin())];
        const bool default_moved = was == same->initial && now.values[i] == tweak.initial;
        if (was != now.values[i] && !default_moved) history.set(i, now.values[i]);
    }
}

std::vector<std::filesystem::path> watched_files(const std::vector<std::filesystem::path>& texts,
                                                 const Preset* preset) {
    std::vector<std::filesystem::path> files = texts;
    if (!preset) return files;
    for (std::size_t i = 0; i < sampler_count(*preset); ++i) {
        const Sampler& sampler = sampler_at(*preset, i);
        files.insert(files.end(), sampler.files.begin(), sampler.files.end());
    }
    return files;
}

}  // namespace

Playground::Playground(Context& context, glm::ivec2 size, const PlaygroundOptions& options)
    : history({}),
      context_(context),
      options_(options),
      size_(size),
      trial_({.device = options.device}),
      inputs_(texture_limits()) {}

Playground::~Playground() = default;

void Playground::open(const std::filesystem::path& file) {
    file_ = file;
    fills_ = {};
    written_.reset();
    watcher_.about_to_read();
    read_again(file);
}

std::vector<int> Playground::descriptors() const {
    return {watcher_.descriptor(), trial_.descriptor(), inputs_.descriptor()};
}

bool Playground::update() {
    const std::size_t reports = report_count_;
    const bool was_loading = is_loading();
    notice_saves();
    follow_trial();
    follow_inputs();
    specialise_at_rest();
    return reports != report_count_ || was_loading != is_loading() || touched_;
}

void Playground::notice_saves() {
    const std::vector<std::filesystem::path> changed = watcher_.changed();
    if (changed.empty()) return;
    const auto is_text = [&](const std::filesystem::path& file) {
        return std::find(watched_.begin(), watched_.end(), file) != watched_.end();
    };
    const auto text = std::find_if(changed.begin(), changed.end(), is_text);
    if (text != changed.end()) read_again(*text);
    reload_inputs(changed);
}

void Playground::read_again(const std::filesystem::path& changed) {
    since_notice_.restart();
    report_ = {.file = changed, .text = {}};
    ReadPreset read = read_preset(file_);
    report_.read_ms = since_notice_.ms();
    watched_ = read.files;
    watcher_.set_files(watched_files(read.files, read.preset ? &*read.preset : preset_.get()));
    diagnostics_ = std::move(read.diagnostics);
    if (!read.preset) {
        candidate_.reset();
        trying_ = false;
        refused_ = true;
        finish_report(false);
        return;
    }
    candidate_ = std::make_unique<Preset>(std::move(*read.preset));
    lay_fills_over(*candidate_);
    start_trial(Purpose::reload);
}

void Playground::start_trial(Purpose purpose) {
    purpose_ = purpose;
    trying_ = true;
    trial_.start({.preset = *candidate_,
                  .compile = {.program = {.specialise = purpose == Purpose::specialise}},
                  .size = size_,
                  .time = transport.time(),
                  .images = {}});
}

void Playground::follow_trial() {
    if (!trying_) return;
    const Verdict& verdict = trial_.poll();
    if (verdict.state == TrialState::running) return;
    trying_ = false;
    const std::unique_ptr<Preset> candidate = std::move(candidate_);
    if (purpose_ == Purpose::reload) {
        report_.trial_ms = verdict.total_ms;
        diagnostics_.insert(diagnostics_.end(), verdict.diagnostics.begin(),
                            verdict.diagnostics.end());
    }
    switch (verdict.state) {
        case TrialState::passed:
            if (verdict.expected_ms > options_.hopeless_ms) {
                refuse(
                    fmt::format("a frame would take about {:.0f} s; make it cheaper, or lower the "
                                "resolution",
                                verdict.expected_ms / 1000.0));
                return;
            }
            [[fallthrough]];
        case TrialState::unavailable:
            take(*candidate, purpose_);
            return;
        case TrialState::idle:
        case TrialState::running:
        case TrialState::rejected:
        case TrialState::too_slow:
        case TrialState::crashed:
        case TrialState::lost:
            refuse("");
            return;
    }
}

// The picture stays as it was; the diagnostics say why.
void Playground::refuse(const std::string& why) {
    if (purpose_ == Purpose::specialise) {
        specialise_failed_ = true;  // uniforms do as well
        return;
    }
    if (!why.empty()) {
        diagnostics_.push_back(
            {.place = {.file = file_.string()}, .text = why, .missing_file = false});
    }
    refused_ = true;
    finish_report(false);
}

std::unique_ptr<Renderer> Playground::make_renderer(const Preset& preset, bool specialise) {
    CompileResult compiled = compile_scene(preset, {.program = {.specialise = specialise}});
    if (!compiled.scene) {
        diagnostics_.insert(diagnostics_.end(), compiled.diagnostics.begin(),
                            compiled.diagnostics.end());
        return nullptr;
    }
    return std::make_unique<Renderer>(
        preset, std::move(*compiled.scene),
        RenderOptions{.size = size_, .picture_format = picture_format()});
}

// Puts a candidate on the screen in one step, or leaves all as it was.
void Playground::take(const Preset& candidate, Purpose purpose) {
    const Stopwatch clock;
    auto preset = std::make_unique<Preset>(candidate);
    auto saved = purpose == Purpose::reload ? std::make_unique<Preset>(candidate) : nullptr;
    History next = history;
    if (saved && !written_) {
        next = History(preset->scene.tweaks, preset->values);
    } else if (saved) {
        next.rebase(preset->scene.tweaks);
        apply_saved_changes(*written_, *saved, next);
    }
    preset->values = next.values();
    std::unique_ptr<Renderer> renderer;
    try {
        renderer = make_renderer(*preset, purpose == Purpose::specialise);
        if (!renderer) return refuse("");
        const bool same_file = preset_ && written_;
        if (renderer_ && (same_file || !saved)) renderer->adopt(*renderer_);
        // What cannot be opened keeps the scene before; what cannot be decoded is told later.
        for (const std::size_t sampler : renderer->inputs_needed())
            for (const auto& file : sampler_at(*preset, sampler).files) require_readable(file);
        context_.finish();  // now the driver says whether there was memory for all buffers
    } catch (const ContextLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        if (renderer && renderer_) renderer_->adopt(*renderer);
        return refuse(error.what());
    }
    const bool opened = saved && !written_;
    renderer_ = std::move(renderer);
    preset_ = std::move(preset);
    history = std::move(next);
    specialised_ = purpose == Purpose::specialise;
    if (!saved) return;  // the picture is the same; nothing asks for a frame
    for (std::size_t i = 0; i < fills_.size(); ++i)
        fills_[i] = laid_over_[i] ? preset_->channels[i] : Sampler();
    written_ = std::move(saved);
    refused_ = specialise_failed_ = false;
    since_tweak_.restart();
    report_.compile_ms = clock.ms();
    report_first_frame_ = touched_ = true;
    opens_with_inputs_ |= opened;
    if (opened) {
        transport = Transport(preset_->time);
        input_ = {};
        extra_frames_ = frame_offset_ = 0;
    }
    load_missing_inputs();
}

void Playground::tweaks_changed() {
    if (!preset_) return;
    preset_->values = history.values();
    since_tweak_.restart();
    specialise_failed_ = false;
    touched_ = true;
    if (purpose_ == Purpose::specialise && trying_) {
        trying_ = false;
        candidate_.reset();
    }
    if (specialised_) use_uniforms();
}

void Playground::use_uniforms() {
    auto renderer = make_renderer(*preset_, false);
    if (!renderer) return;
    renderer->adopt(*renderer_);
    renderer_ = std::move(renderer);
    specialised_ = false;
}

void Playground::specialise_at_rest() {
    if (!options_.specialise || !renderer_ || specialised_ || specialise_failed_ || trying_) return;
    if (history.is_open() || since_tweak_.ms() < options_.rest_seconds * 1000.0) return;
    candidate_ = std::make_unique<Preset>(*preset_);
    start_trial(Purpose::specialise);
}

void Playground::finish_report(bool shown) {
    report_.shown = shown;
    const auto errors = std::count_if(diagnostics_.begin(), diagnostics_.end(),
                                      [](const auto& d) { return d.severity == Severity::error; });
    const std::string name = report_.file.filename().string();
    report_.text =
        shown ? fmt::format(
                    "{}: shown; read {:.1f}, trial {:.1f}, compile {:.1f}, first frame {:.1f} ms",
                    name, report_.read_ms, report_.trial_ms, report_.compile_ms,
                    report_.first_frame_ms)
              : fmt::format("{}: not shown, {} error{}; read {:.1f}, trial {:.1f} ms", name, errors,
                            errors == 1 ? "" : "s", report_.read_ms, report_.trial_ms);
    reports_.push_back(report_);
    ++report_count_;
    if (reports_.size() > kKeptReports) reports_.pop_front();
    report_first_frame_ = false;
}

bool Playground::wants_frame() const {
    if (!renderer_) return false;
    const bool settles = !transport.playing() && extra_frames_ < preset_->settle;
    const bool time_moves = transport.playing() ? follows_time() : transport.wants_frame();
    return touched_ || replay_at_ >= 0 || settles || time_moves;
}

bool Playground::follows_time() const {
    const auto& passes = renderer_->graph().passes;
    return !preset_->events.empty() ||
           std::any_of(passes.begin(), passes.end(),
                       [](const GraphPass& pass) { return pass.runs != Runs::on_change; });
}

void Playground::resize(glm::ivec2 size) {
    if (size == size_ || size == refused_size_) return;
    touched_ = true;
    refused_size_ = {0, 0};
    try {
        if (renderer_) renderer_->resize(size);
        context_.finish();
        size_ = size;
    } catch (const ContextLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        refused_size_ = size;
        renderer_->resize(size_);
        diagnostics_.push_back({.place = {.file = file_.string()}, .text = error.what()});
    }
}

void Playground::mouse(glm::dvec2 fraction, bool down) {
    input_.mouse(fraction, down);
    recent_.mouse(fraction, down);
    recorder.mouse(fraction, down);
    touched_ |= renderer_ && renderer_->reads_mouse();
}

void Playground::key(int code, bool down) {
    input_.key(code, down);
    recent_.key(code, down);
    recorder.key(code, down);
    touched_ |= renderer_ && renderer_->reads_keyboard();
}

void Playground::measure_passes(bool on) {
    if (on == measuring_) return;
    measuring_ = on;
    pass_times_.clear();
    if (!renderer_) return;
    renderer_->set_picture_format(picture_format());
    renderer_->draw_root(frame_again());
}

Frame Playground::next_frame(double wall_seconds) {
    const double before = instant_.time;
    // What is recorded is replayed by exports, which drop no simulated time: a frame that is too
    // slow holds time up then. Below the limit, for the part of a step that was left over.
    if (recorder.recording()) {
        wall_seconds = std::min(wall_seconds, 0.8 * kLongestCatchUp / transport.rate());
    }
    instant_ = transport.advance(wall_seconds);
    if (instant_.frame == 0) frame_offset_ = 0;
    const bool stands = instant_.frame > 0 && instant_.time == before && !instant_.jumped;
    extra_frames_ = stands ? extra_frames_ + 1 : 0;
    instant_.frame += frame_offset_;
    Frame frame;
    frame.time = instant_.time;
    frame.time_delta = instant_.time_delta;
    frame.frame_rate = instant_.frame_rate;
    frame.frame = instant_.frame;
    frame.date = shadertoy_date(local_now(), 0.0);
    if (transport.playing() && !instant_.jumped) replay_events(before, frame.time);
    frame.input = input_.next_frame(size_);
    frame.longest_catch_up = kLongestCatchUp;
    recorder.frame(frame.time);
    recent_.frame(frame.time);
    if (!recent_.recording() || instant_.jumped) recent_.start(frame.time, input_);
    recent_.forget_before(frame.time - 4.0 * kLongestCatchUp);
    frame.events = recent_.events();
    return frame;
}

// The preset's events go on while time does, also when a person has taken over.
void Playground::replay_events(double from, double to) {
    for (const Event& event : events_between(preset_->events, from, to)) {
        input_.apply(event);
        recent_.replayed(event);
        recorder.replayed(event);
    }
}

double Playground::replayed() const {
    return replay_at_ < 0 ? 1.0 : static_cast<double>(replay_at_) / std::max(replay_until_, 1);
}

// A stateful scene is played again from 0 after a jump, a slice a call. True when it has arrived:
// then `frame`, which is to be drawn, is the last frame of a still at its time, and those that
// follow count on from there.
bool Playground::replay_slice(Frame& frame) {
    const Stopwatch clock;
    const Playback playback{.end = frame.time};
    for (; replay_at_ < replay_until_; ++replay_at_) {
        if (clock.ms() > kReplaySlice) return false;
        renderer_->advance(playback.frame(*preset_, replay_at_));
        context_.finish();
    }
    replay_at_ = -1;
    Frame last = playback.frame(*preset_, replay_until_);
    if (preset_->events.empty()) last.input = frame.input;
    last.date = frame.date;
    frame_offset_ += last.frame - instant_.frame;
    instant_.frame = last.frame;
    instant_.time_delta = last.time_delta;
    instant_.frame_rate = last.frame_rate;
    frame = last;
    return true;
}

bool Playground::draw(double wall_seconds) {
    if (!renderer_) return false;
    // Panels move over a picture that stands; no frame of the scene goes by then.
    if (!transport.playing() && !wants_frame()) return false;
    const Stopwatch clock;
    // While a replay is under way, time stands.
    Frame frame = next_frame(replay_at_ < 0 ? wall_seconds : 0.0);
    const bool plays_again = std::exchange(plays_again_, false);
    if (instant_.jumped || plays_again) {
        renderer_->reset();
        const bool again = renderer_->graph().stateful && (instant_.time > 0.0 || plays_again);
        replay_at_ = again ? 0 : -1;
        replay_until_ = Playback{.end = instant_.time}.last_frame();
    }
    if (replay_at_ >= 0 && !replay_slice(frame)) return false;

    touched_ = false;
    if (measuring_) {
        pass_times_.resize(renderer_->graph().passes.size());
        for (PassTime& pass : pass_times_) pass.drawn = false;
        renderer_->after_pass = [this, watch = Stopwatch()](std::size_t pass) mutable {
            context_.finish();
            pass_times_[pass] = {.ms = watch.restart(), .drawn = true};
        };
    }
    const bool drawn = renderer_->draw(frame);
    renderer_->after_pass = nullptr;
    context_.finish();
    drawn_input_ = frame.input;
    drawn_date_ = frame.date;
    if (drawn) frame_ms_ = clock.ms();
    if (report_first_frame_) {
        report_.first_frame_ms = clock.ms();
        finish_report(true);
    }
    return drawn;
}

// The inputs of the frame that was drawn last.
Frame Playground::frame_again() const {
    Frame frame;
    frame.time = instant_.time;
    frame.time_delta = instant_.time_delta;
    frame.frame_rate = instant_.frame_rate;
    frame.frame = instant_.frame;
    frame.date = drawn_date_;
    frame.input = drawn_input_;
    return frame;
}

std::vector<std::byte> Playground::still() {
    if (!renderer_) return {};
    const bool measured = measuring_;
    measure_passes(false);
    std::vector<std::byte> pixels;
    const bool as_it_is = specialised_ || !options_.specialise;
    if (const auto special = as_it_is ? nullptr : make_renderer(*preset_, true)) {
        special->adopt(*renderer_);
        special->draw_root(frame_again());
        pixels = special->read_bytes();
        renderer_->adopt(*special);
        touched_ = true;
    } else {
        pixels = renderer_->read_bytes();
    }
    measure_passes(measured);
    return pixels;
}

Metadata Playground::still_metadata() const {
    return picture_metadata(current_preset(), frame_again(), context_.renderer());
}

const Buffer* Playground::picture_of(History::Set set) {
    if (!renderer_) return nullptr;
    if (specialised_) use_uniforms();
    const Buffer& picture = renderer_->buffer(renderer_->graph().passes.size() - 1);
    if (!other_picture_ || other_picture_->shape() != picture.shape()) {
        other_picture_ = std::make_unique<Buffer>(picture.shape());
    }
    std::vector<TweakValue> values = history.values(set);
    preset_->values.swap(values);
    renderer_->draw_root(frame_again());
    other_picture_->copy_from(picture);
    preset_->values.swap(values);
    renderer_->draw_root(frame_again());
    context_.finish();
    return other_picture_.get();
}

Preset Playground::current_preset() const {
    Preset preset = *preset_;
    preset.values = history.values();
    preset.time = instant_.time;
    return preset;
}

Preset Playground::preset_as_shown() const {
    constexpr double kSoon = 2.0;  // s
    Preset preset = current_preset();
    preset.size = size_;
    if (renderer_->graph().stateful) {
        preset.time = std::min(preset.time, std::max(preset_->time, kSoon));
    }
    if (preset.events.empty()) preset.events = input_.as_events(0.0);
    return preset;
}

}  // namespace glint
