#include "window/live/playground.h"

#include "base/readable_file.h"
#include "media/image.h"
#include "scene/preset_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <utility>

namespace glint {
namespace {

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
void apply_saved_changes(const Preset& before, const Preset& now, TweakValues& tweaks) {
    for (std::size_t i = 0; i < now.scene.tweaks.size(); ++i) {
        const Tweak& tweak = now.scene.tweaks[i];
        const auto& old = before.scene.tweaks;
        const auto same = std::find_if(old.begin(), old.end(), [&](const Tweak& t) {
            return t.name == tweak.name && t.type == tweak.type;
        });
        if (same == old.end()) continue;
        const TweakValue& was = before.values[static_cast<std::size_t>(same - old.begin())];
        const bool default_moved = was == same->initial && now.values[i] == tweak.initial;
        if (was != now.values[i] && !default_moved) tweaks.set(i, now.values[i]);
        const auto locks = [&](const Preset& preset) {
            return std::ranges::find(preset.locked, tweak.name) != preset.locked.end();
        };
        if (locks(before) != locks(now)) tweaks.lock(i, locks(now));
    }
}

// The files of a text, and those that its samplers name.
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
    : context_(context),
      options_(options),
      size_(size),
      full_size_(size),
      trial_({.device = options.device}),
      standby_(options.device),
      sketcher_(options.device),
      reloader_(reload_steps(),
                {.constants = options.specialise, .hopeless_ms = options.hopeless_ms}),
      inputs_(texture_limits()),
      start_states_(options.start_states) {}

Playground::~Playground() = default;

ReloadSteps Playground::reload_steps() {
    return {
        .read =
            [this](const std::filesystem::path& file) {
                ReadPreset read = read_preset(file);
                if (read.preset) lay_fills_over(*read.preset);
                return read;
            },
        .watch =
            [this](const ReadPreset& read) {
                const Preset* preset = read.preset ? &*read.preset : preset_.get();
                watcher_.set_files(watched_files(read.files, preset));
            },
        .has_uniforms = [this](const Preset& text) { return standby_.draws(text, shelf_); },
        .start_trial = [this](const Preset& preset, Programs programs,
                              bool is_text) { start_trial(preset, programs, is_text); },
        .trial = [this]() -> const Verdict& { return follow_trial(); },
        .put_in_place = [this](const Preset& preset, Programs programs,
                               bool is_text) { return put_in_place(preset, programs, is_text); }};
}

ProgramOptions Playground::program_options(Programs programs) const {
    if (programs != Programs::constants && options_.specialise) return standby_.program_options();
    return {.specialise = programs == Programs::constants, .lean = true};
}

// The values that a text would be drawn with: those that a person has set stay.
TweakValues Playground::tweaks_with(const Preset& text) const {
    const Preset* written = reloader_.as_written();
    if (!written) {
        TweakValues next(text.scene.tweaks, text.values);
        next.set_locks(text.locked);
        return next;
    }
    TweakValues next = tweaks;
    next.rebase(text.scene.tweaks, text.values);
    apply_saved_changes(*written, text, next);
    return next;
}

void Playground::start_trial(const Preset& candidate, Programs programs, bool is_text) {
    tried_ = std::make_unique<Preset>(candidate);
    if (is_text) tried_->values = tweaks_with(candidate).values();
    tried_is_text_ = is_text;
    tried_is_loaded_ = false;
    tried_by_standby_ = programs != Programs::constants && options_.specialise;
    loader_.stop();
    Trial& trial = tried_by_standby_ ? standby_.trial() : trial_;
    trial.start({.preset = *tried_,
                 .compile = {.program = program_options(programs)},
                 .size = full_size_,
                 .time = transport_.time(),
                 .images = {},
                 .is_text = is_text});
    since_trial_.restart();
    wants_sketch_ = is_text && !tried_by_standby_;
    if (sketcher_.is_drawing()) sketcher_.stop();
    sketch_.reset();
}

// What has passed there is taken up here, pass by pass, before anybody hears of it. Standby's
// programs are here.
const Verdict& Playground::follow_trial() {
    static const Verdict running{.state = TrialState::running, .passes = {}, .diagnostics = {}};
    trial_.poll();
    const Verdict& verdict = (tried_by_standby_ ? standby_.trial() : trial_).poll();
    if (!reloader_.is_trying() || verdict.state != TrialState::passed || tried_by_standby_)
        return verdict;
    if (!std::exchange(tried_is_loaded_, true)) {
        std::vector<std::string> passes;
        double compile_ms = 0.0;
        for (const PassTrial& pass : verdict.passes) {
            passes.push_back(pass.name);
            compile_ms += pass.first_ms;
        }
        longest_compile_ms_ = std::max(longest_compile_ms_, compile_ms);
        const auto programs =
            options_.specialise ? Programs::constants : Programs::uniforms_for_good;
        loader_.start(*tried_, program_options(programs), std::move(passes));
    }
    if (!loader_.is_loading()) return verdict;
    loader_.step(shelf_, tried_is_text_ ? nullptr : renderer_.get());
    return running;
}

void Playground::open(const std::filesystem::path& file) {
    fills_ = {};
    longest_compile_ms_ = 0.0;
    watcher_.about_to_read();
    reloader_.open(file);
}

std::vector<int> Playground::descriptors() const {
    return {watcher_.descriptor(), trial_.descriptor(), standby_.descriptor(),
            sketcher_.descriptor(), inputs_.descriptor()};
}

bool Playground::update() {
    const std::size_t reports = report_count();
    const bool was_loading = is_loading();
    notice_saves();
    if (reloader_.follow()) load_missing_inputs();
    follow_inputs();
    const bool is_sketched = follow_sketch();
    prepare_uniforms();
    // The tweaks may have moved while constants were compiled, or before there was anything else.
    const bool may_follow = is_specialised() || standby_.has_scene();
    if (constants_ && *constants_ != tweaks.values() && may_follow) leave_constants();
    specialise_at_rest();
    return reports != report_count() || was_loading != is_loading() || touched_ || is_sketched;
}

void Playground::notice_saves() {
    const std::vector<std::filesystem::path> changed = watcher_.changed();
    if (changed.empty()) return;
    const auto text = std::ranges::find_if(
        changed, [&](const auto& file) { return reloader_.is_read_from(file); });
    if (text != changed.end()) reloader_.saved(*text);
    reload_inputs(changed);
}

std::unique_ptr<Renderer> Playground::make_renderer(const Preset& preset,
                                                    const ProgramOptions& options,
                                                    Diagnostics& why_not) {
    CompileResult compiled = compile_scene(preset, {.program = options}, nullptr, nullptr, &shelf_);
    if (!compiled.scene) {
        why_not = std::move(compiled.diagnostics);
        return nullptr;
    }
    return std::make_unique<Renderer>(
        preset, std::move(*compiled.scene),
        RenderOptions{.size = size_, .picture_format = picture_format()});
}

// In one step, or all is left as it was.
Diagnostics Playground::put_in_place(const Preset& candidate, Programs programs, bool is_text) {
    const bool is_constant = programs == Programs::constants;
    const Preset* written = reloader_.as_written();
    auto preset = std::make_unique<Preset>(candidate);
    TweakValues next = is_text ? tweaks_with(candidate) : tweaks;
    // For the compiler and the renderer alone. A tweak that moved since is followed at once.
    preset->values = is_constant ? tried_->values : next.values();
    std::unique_ptr<Renderer> renderer;
    try {
        Diagnostics why_not;
        renderer = make_renderer(*preset, program_options(programs), why_not);
        if (!renderer) return why_not;
        const bool same_file = preset_ && written;
        if (renderer_ && (same_file || !is_text)) renderer->adopt(*renderer_);
        // What cannot be opened keeps the scene before; what cannot be decoded is told later.
        for (const std::size_t sampler : renderer->inputs_needed())
            for (const auto& file : sampler_at(*preset, sampler).files) require_readable(file);
        context_.finish();  // now the driver says whether there was memory for all buffers
    } catch (const ContextLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        if (renderer && renderer_) renderer_->adopt(*renderer);
        return {{.place = {.file = reloader_.file().string()}, .text = error.what()}};
    }
    touched_ |= constants_ && *constants_ != preset->values;
    keep_what_was_drawn(programs, is_text);
    renderer_ = std::move(renderer);
    preset_ = std::move(preset);
    constants_.reset();
    if (is_constant) constants_ = std::move(preset_->values);
    preset_->values.clear();
    tweaks = std::move(next);
    forget_states();
    if (!is_text && standby_.is_ready()) tidy_shelf();
    if (!is_text && !renderer_->inputs_needed().empty()) load_missing_inputs();
    if (!is_text) return {};  // the picture is the same; nothing asks for a frame
    for (std::size_t i = 0; i < fills_.size(); ++i)
        fills_[i] = laid_over_[i] ? preset_->channels[i] : Sampler();
    since_tweak_.restart();
    touched_ = true;
    if (!written) {
        expected_ms_ = trial_.poll().expected_ms;
        find_start_state();
        has_picture_ = false;
        opening_ = Opening::awaits_inputs;
        transport_ = Transport(preset_->time);
        input_ = {};
        extra_frames_ = frame_offset_ = 0;
        is_replayable_ = preset_->time == 0.0;  // else the first frame is a jump
    }
    return {};
}

// Fed programs of the shown text stay at hand, whichever are drawn.
void Playground::keep_what_was_drawn(Programs programs, bool is_text) {
    const bool was_fed = renderer_ && !constants_;
    if (!is_text) {
        if (was_fed && standby_.is_ready()) standby_.give_back(renderer_->take_scene());
        return;
    }
    ++text_;
    if (programs == Programs::constants) return standby_.stop();
    standby_.forget_scene();
    prepared_text_ = text_;
}

// Programs that are neither drawn nor at hand.
void Playground::tidy_shelf() {
    std::vector<GLuint> ids = ids_of(renderer_->scene());
    std::ranges::copy(standby_.ids(), std::back_inserter(ids));
    shelf_.keep_only(ids);
}

void Playground::tweaks_changed() {
    if (!preset_) return;
    forget_states();
    renderer_->set_values(tweaks.values());
    since_tweak_.restart();
    touched_ = true;
    reloader_.tweaks_moved();
    leave_constants();
}

// Draws fed programs, where these are at hand. Else the picture waits for them, or for the
// constants of the new values.
void Playground::leave_constants() {
    if (!constants_) return;
    reloader_.uses_uniforms();
    std::optional<CompiledScene> scene = standby_.take();
    // Small texts are compiled here, and all where there is no other process.
    constexpr double kSmall = 60.0;  // ms
    if (!scene && (standby_.is_refused() || longest_compile_ms_ < kSmall))
        scene = compile_scene(*preset_, {.program = {.specialise = false, .lean = true}}).scene;
    if (!scene) return;
    auto renderer = std::make_unique<Renderer>(
        *preset_, std::move(*scene),
        RenderOptions{.size = size_, .picture_format = picture_format()});
    renderer->set_values(tweaks.values());
    renderer->adopt(*renderer_);
    renderer_ = std::move(renderer);
    forget_states();
    constants_.reset();
    touched_ = true;
    load_missing_inputs();  // constants may have had no use for some
}

// When there is nothing else to do: the picture comes first.
void Playground::prepare_uniforms() {
    if (!renderer_ || !options_.specialise) return;
    const bool was_ready = standby_.is_ready();
    standby_.follow(shelf_, *renderer_);
    if (!was_ready && standby_.is_ready()) tidy_shelf();
    const bool is_quiet =
        reloader_.state() == ReloadState::idle && !reloader_.has_unseen() && !awaits_inputs();
    if (!is_quiet || prepared_text_ == text_) return;
    prepared_text_ = text_;
    standby_.prepare(current_preset(), full_size_, transport_.time());
}

void Playground::specialise_at_rest() {
    if (!renderer_ || !reloader_.wants_constants() || (tweaks.is_open() && !constants_)) return;
    // Where the picture does not follow yet, constants are the first to show the new values.
    constexpr double kStandsStill = 0.1;  // s
    const double rest = constants_ ? kStandsStill : options_.rest_seconds;
    if (since_tweak_.ms() < rest * 1000.0) return;
    reloader_.tweaks_rest(current_preset());
}

bool Playground::wants_frame() const {
    if (!renderer_) return false;
    const bool settles = !transport_.playing() && extra_frames_ < preset_->settle;
    const bool time_moves = transport_.playing() ? follows_time() : transport_.wants_frame();
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
    if (states_depend_on_size()) forget_states();
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
        reloader_.tell({.place = {.file = reloader_.file().string()}, .text = error.what()});
    }
}

void Playground::mouse(glm::dvec2 fraction, bool down) {
    input_.mouse(fraction, down);
    recent_.mouse(fraction, down);
    recorder.mouse(fraction, down);
    const bool is_read = renderer_ && renderer_->reads_mouse();
    touched_ |= is_read;
    is_replayable_ &= !is_read;
}

void Playground::key(int code, bool down) {
    input_.key(code, down);
    recent_.key(code, down);
    recorder.key(code, down);
    const bool is_read = renderer_ && renderer_->reads_keyboard();
    touched_ |= is_read;
    is_replayable_ &= !is_read;
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
        wall_seconds = std::min(wall_seconds, 0.8 * kLongestCatchUp / transport_.rate());
    }
    instant_ = transport_.advance(wall_seconds);
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
    if (transport_.playing() && !instant_.jumped) replay_events(before, frame.time);
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

std::string Playground::waits_for() const {
    if (reloader_.is_trying()) return tried_by_standby_ ? standby_.work() : trial_.work();
    if (replay_at_ >= 0)
        return fmt::format("playing up to {:g} s, {:.0f} % done", instant_.time, 100 * replayed());
    return has_unseen_text() ? "drawing the first frame" : "";
}

bool Playground::draw(double wall_seconds) {
    if (!renderer_) return false;
    // Panels move over a picture that stands; no frame of the scene goes by then.
    if (!transport_.playing() && !wants_frame()) return false;
    const Stopwatch clock;
    // While a replay is under way, time stands.
    Frame frame = next_frame(replay_at_ < 0 ? wall_seconds : 0.0);
    const bool plays_again = opening_ == Opening::plays_again;
    if (plays_again) opening_ = Opening::done;
    if (instant_.jumped || plays_again) {
        begin_replay(plays_again);
        take_start_state();
    }
    if (replay_at_ >= 0 && !replay_slice(frame)) return false;
    notice_dropped_steps();

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
    has_picture_ |= drawn;
    if (drawn) ++pictures_;
    renderer_->after_pass = nullptr;
    context_.finish();
    drawn_input_ = frame.input;
    drawn_date_ = frame.date;
    if (drawn) frame_ms_ = clock.ms();
    reloader_.drawn(clock.ms());
    keep_live_state();
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

void Playground::go_on_in(const std::filesystem::path& file, const Preset& preset) {
    fills_ = {};
    tweaks.set_written(preset.values);
    watcher_.about_to_read();
    reloader_.go_on_in(file, preset);
}

bool Playground::is_as_read(const std::string& text) const {
    if (!as_written()) return false;
    Preset written = *as_written();
    for (std::size_t i = 0; i < laid_over_.size(); ++i)
        if (laid_over_[i]) written.channels[i] = {};
    return write_preset(written, reloader_.file(), text).text == text;
}

Preset Playground::current_preset() const {
    Preset preset = *preset_;
    preset.values = tweaks.values();
    preset.locked = tweaks.locks();
    for (const std::string& name : preset_->locked)
        if (std::ranges::find(preset.scene.tweaks, name, &Tweak::name) == preset.scene.tweaks.end())
            preset.locked.push_back(name);
    preset.time = instant_.time;
    return preset;
}

}  // namespace glint
