#include "window/live/window.h"

#include "base/canonical_name.h"
#include "base/numbered_name.h"
#include "base/say.h"
#include "base/terminal.h"
#include "media/image.h"
#include "offline/new_scene.h"
#include "window/live/home_folder.h"
#include "window/live/inspect.h"
#include "window/live/offers.h"
#include "window/live/playground_window.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Idle windows still look round now and then: for a file system that does not tell of saves.
constexpr double kLongestWait = 10.0;  // s

// Where time plays and the picture does not depend on it, only the clock in the panels moves.
constexpr double kClockTick = 0.25, kWaitingTick = 0.1;  // s

// What the preset or the options say. What is wrong with the file is told once it is open; what is
// wrong with the options throws UsageError.
glm::ivec2 size_at_start(const ViewOptions& options) {
    ReadPreset read = read_preset(options.file);
    if (!read.preset) return size_of(options, Preset{}.size);
    lay_over(*read.preset, options);
    return read.preset->size;
}

std::span<const std::string_view> template_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> list;
        for (const SceneTemplate& each : scene_templates()) list.push_back(each.name);
        return list;
    }();
    return names;
}

}  // namespace

PlaygroundWindow::PlaygroundWindow(const ViewOptions& options)
    : options_(options),
      kept_pictures_(home_folder("XDG_CACHE_HOME", ".cache") / "pictures"),
      begun_picture_(StartPicture::begin(kept_pictures_.find(canonical_name(options.file)))),
      begun_size_(std::async(std::launch::async, size_at_start, options)),
      begun_fonts_(std::async(std::launch::async, make_fonts, glfw_.content_scale())),
      trial_({.device = options.device, .at_once = false}),
      window_(begun_size_.get(), "Glint"),
      panels_(window_.handle(), window_.content_scale(),
              home_folder("XDG_CONFIG_HOME", ".config") / "panels.ini", begun_fonts_.get()),
      start_picture_(std::move(begun_picture_)),
      crash_mark_(home_folder("XDG_STATE_HOME", ".local/state") / "open"),
      unsaved_work_(home_folder("XDG_STATE_HOME", ".local/state") / "unsaved"),
      playground_(window_, trial_, window_.size(),
                  {.device = options.device,
                   .specialise = options.specialise,
                   .start_states = home_folder("XDG_CACHE_HOME", ".cache") / "states",
                   .maps = home_folder("XDG_CACHE_HOME", ".cache") / "maps",
                   .verdicts = home_folder("XDG_CACHE_HOME", ".cache") / "trials"}),
      browser_(home_folder("XDG_CACHE_HOME", ".cache") / "thumbnails"),
      recent_(home_folder("XDG_STATE_HOME", ".local/state") / "recent"),
      study_(home_folder("XDG_CACHE_HOME", ".cache") / "study",
             {.device = options.device, .specialise = options.specialise}),
      check_(home_folder("XDG_CACHE_HOME", ".cache") / "check", {.device = options.device}),
      sound_(options.device),
      refiner_(options.device),
      probe_(options.device),
      kept_resolutions_(home_folder("XDG_STATE_HOME", ".local/state") / "resolution") {
    playground_.before_other_scene = [this] { leave_scene(); };
    window_.show();
    std::error_code error;
    if (options.file.empty() || fs::is_directory(options.file, error)) {
        browse(options.file.empty() ? "." : options.file);
        return;
    }
    pause_at_open_ = crash_mark_.take(canonical_name(options.file));
    if (pause_at_open_) notice("The last run ended while this scene was open; it starts paused.");
    open(options.file);
}

int PlaygroundWindow::run() {
    // A logout is no crash; what is thrown is one, and nobody is left to ask then.
    Window::on_lost_display = [this] { crash_mark_.clear(); };
    struct Unheard {
        ~Unheard() { Window::on_lost_display = nullptr; }
    } const unheard;
    panels_.compile();  // while the screen makes room for the window
    // However soon the trial is over: what follows then takes its time.
    if (awaits_first_frame()) draw_frame();
    trial_.get_ready();
    while (!window_.should_close() && end_signals_.arrived() == 0) {
        std::vector<int> descriptors = playground_.descriptors();
        descriptors.push_back(study_.process().descriptor());
        descriptors.push_back(check_.process().descriptor());
        descriptors.push_back(sound_.descriptor());
        descriptors.push_back(end_signals_.descriptor());
        descriptors.push_back(editor_.descriptor());
        descriptors.push_back(refiner_.descriptor());
        descriptors.push_back(probe_.descriptor());
        for (const WindowEvent& event : window_.events(wait_seconds(), descriptors)) handle(event);
        dirty_ |= playground_.update();
        tell_overruled();
        dirty_ |= browser_.update(settings_.browser || file_.empty());
        dirty_ |= sound_.update();
        dirty_ |= follow_findings();
        dirty_ |= follow_start();
        dirty_ |= follow_refining();
        dirty_ |= follow_probe();
        if (const std::string problem = editor_.problem(); !problem.empty()) notice(problem);
        print_reports();
        keep_unsaved();
        const double now = since_draw_.ms() / 1000.0;
        if (!window_.is_visible() || window_.size().x == 0 || window_.size().y == 0) continue;
        if (playground_.has_unseen_text()) frame_due_ = 0.0;
        // A mouse may tell of itself a thousand times a second; the screen shows sixty pictures.
        const bool wanted = dirty_ || playground_.wants_frame() || panels_.is_settling();
        if ((wanted && now >= frame_due_) || (shows_clock() && now >= clock_tick())) draw_frame();
    }
    keep_picture();
    if (end_signals_.arrived() != 0 || window_.has_lost_display()) keep_at_end();
    if (window_.has_lost_display()) {
        crash_mark_.clear();
        throw std::runtime_error("The display is gone; Glint ends.");
    }
    return end_signals_.arrived();
}

bool PlaygroundWindow::shows_clock() const {
    if (awaits_first_frame()) return true;
    return playground_.is_open() && playground_.transport().playing() && settings_.visible &&
           settings_.transport;
}

double PlaygroundWindow::clock_tick() const {
    return awaits_first_frame() ? kWaitingTick : kClockTick;
}

// Nothing to do: wait for events. Something to draw: only until the next frame of the screen is
// due.
double PlaygroundWindow::wait_seconds() const {
    if (playground_.is_sending() && window_.is_visible()) return 0.0;
    if (is_keeping_due()) return kKeepPeriod / 4.0;
    if (!window_.is_visible()) return kLongestWait;
    const double now = since_draw_.ms() / 1000.0;
    if (dirty_ || playground_.wants_frame() || panels_.is_settling()) {
        return std::max(0.0, frame_due_ - now);
    }
    if (start_picture_.is_reading()) return 0.005;
    if (shows_clock()) return std::max(0.0, clock_tick() - now);
    if (probe_.is_waiting()) return 0.05;
    if (refining_is_due()) return kRestBeforeRefining;
    const bool pending = playground_.is_loading() || browser_.is_busy() ||
                         study_.process().is_ending() || check_.process().is_ending() ||
                         (playground_.is_open() && !playground_.is_at_rest());
    return pending ? 0.1 : kLongestWait;
}

// Whose aspect the picture keeps.
std::optional<glm::ivec2> PlaygroundWindow::frame_size() const {
    if (!options_.size.empty()) return size_of(options_, {});
    const Preset* preset = playground_.preset();
    if (!preset || !preset->has_size) return std::nullopt;
    return preset->size;
}

// Where the picture stands in the window, pixels: between bars where the aspects differ.
ScreenArea PlaygroundWindow::picture_area() const {
    const std::optional<glm::ivec2> frame = frame_size();
    const glm::ivec2 room = window_.size();
    if (!frame || settings_.free_aspect) return {.origin = {0, 0}, .size = room};
    const glm::dvec2 ratio = glm::dvec2(room) / glm::dvec2(*frame);
    const glm::dvec2 fitted = glm::dvec2(*frame) * std::min(ratio.x, ratio.y);
    const glm::ivec2 size =
        glm::clamp(glm::ivec2(glm::round(fitted)), glm::min(glm::ivec2(1), room), room);
    return {.origin = (room - size) / 2, .size = size};
}

// Where the view stands: buffers, magnified pixels and the pictures of studies have all the window.
ScreenArea PlaygroundWindow::view_area() const {
    if (is_over_scene()) return picture_area();
    return {.origin = {0, 0}, .size = window_.size()};
}

// Where frames take long, panels answer a person before the next of them, and never twice in a row:
// what was moved is in that frame already, and time goes on under a hand that does not rest.
bool PlaygroundWindow::answers_first() {
    constexpr double kLongMs = 25.0;
    const bool is_long = playground_.has_picture() && playground_.wants_frame() &&
                         playground_.frame_ms() > kLongMs && !settings_.wipe;
    answered_first_ = is_long && was_told_ && !answered_first_;
    was_told_ = false;
    return answered_first_;
}

// True when there is a new picture.
bool PlaygroundWindow::draw_scene() {
    choose_resolution();
    playground_.measure_passes(settings_.visible && settings_.passes);
    const double elapsed = since_draw_.restart() / 1000.0;
    frame_due_ = 1.0 / window_.refresh_rate();
    const double drawn_at = clock_seconds();
    const bool drawn = playground_.draw(elapsed);
    follow_recording();
    follow_sound(drawn_at);
    return drawn;
}

void PlaygroundWindow::draw_frame() {
    if (content_scale_ != window_.content_scale()) {
        content_scale_ = window_.content_scale();  // another monitor
        panels_.rescale(content_scale_);
    }
    dirty_ = false;
    settle_view();
    const bool drawn = !answers_first() && draw_scene();
    const Stopwatch clock;
    show_picture();
    const Wishes wishes =
        panels_.update(facts(), playground_.tweaks, playground_.transport(), settings_);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    panels_.draw();
    measure_beside(clock);
    if (drawn) hold_rate();
    window_.swap();
    if (const auto ms = playground_.sketch() ? playground_.take_sketch_ms() : std::nullopt) {
        const glm::ivec2 size = playground_.sketch()->shape().size;
        say("{}: sketched at {}x{} after {:.1f} ms\n", file_.filename().string(), size.x, size.y,
            *ms);
    }
    print_reports();
    grant(wishes);
}

// `at` is the clock when the frame was begun: its time is that instant's.
void PlaygroundWindow::follow_sound(double at) {
    const Transport& transport = playground_.transport();
    const bool is_loud = playground_.is_open() && !settings_.muted;
    // While a replay is under way, or frames have a fixed length, time does not run by the clock.
    const bool runs =
        transport.playing() && !transport.fixed_step() && playground_.replayed() >= 1.0;
    sound_.follow(playground_.preset(), playground_.tweaks.values(),
                  {.playing = runs,
                   .time = playground_.instant().time,
                   .rate = transport.rate(),
                   .at = at,
                   .volume = is_loud ? settings_.volume : 0.0f});
}

BufferView PlaygroundWindow::buffer_view() const {
    const PassView& view = settings_.view;
    return {.channel = static_cast<ViewChannel>(view.channel),
            .exposure = view.exposure,
            .tone_curve = view.tone_curve,
            .mark_not_finite = settings_.passes && view.mark_not_finite,
            .centre = view.centre,
            .zoom = view.zoom};
}

void PlaygroundWindow::show_picture() {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClearColor(0.07f, 0.07f, 0.08f, 1.0f);
    if (!playground_.has_picture()) glClearColor(0.21f, 0.25f, 0.31f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    if (shows_start_picture() || !playground_.has_picture() || show_finding()) return;
    BufferView view = buffer_view();
    if (show_value(view) || show_sketch(view) || show_refined(view)) return;
    const Output viewed = find_output(playground_, settings_.view.sampler);
    view.output = viewed.output;
    const Buffer* buffer = &playground_.renderer()->buffer(viewed.graph_index);
    if (!settings_.wipe || !settings_.view.sampler.empty()) {
        viewer_.show(*buffer, view, view_area());
        return;
    }
    const TweakSet other = other_set(playground_.tweaks.shown());
    const Buffer* picture = playground_.picture_of(other);
    show_wipe(*buffer, picture ? *picture : *buffer, view);
}

// While a text that was saved is compiled.
bool PlaygroundWindow::show_sketch(const BufferView& view) {
    const Buffer* sketch = playground_.sketch();
    if (!sketch || !is_over_scene() || settings_.passes || settings_.wipe) return false;
    viewer_.show(*sketch, view, view_area());
    return true;
}

// One picture left of the line, another right of it.
void PlaygroundWindow::show_wipe(const Buffer& left, const Buffer& right, const BufferView& view) {
    const glm::ivec2 room = window_.size();
    const ScreenArea area = view_area();
    const auto line = static_cast<int>(settings_.wipe_position * static_cast<float>(room.x));
    viewer_.show(left, view, area);
    glEnable(GL_SCISSOR_TEST);
    glScissor(line, 0, room.x - line, room.y);
    viewer_.show(right, view, area);
    // Bars are not compared.
    const bool is_on_picture = line >= area.origin.x && line < area.origin.x + area.size.x;
    glScissor(line, area.origin.y, is_on_picture ? 2 : 0, area.size.y);
    // By name: the picture of the other set has left a buffer of the scene bound.
    constexpr float kWhite[] = {1.0f, 1.0f, 1.0f, 1.0f};
    glClearNamedFramebufferfv(0, GL_COLOR, 0, kWhite);
    glDisable(GL_SCISSOR_TEST);
}

// What the passes panel and the magnified picture tell of the buffer in view.
void PlaygroundWindow::gather_pixels() {
    const ScreenArea area = view_area();
    const Output viewed = find_output(playground_, settings_.view.sampler);
    const glm::ivec2 size = playground_.renderer()->buffer(viewed.graph_index).shape().size;
    grid_ = pixel_grid(playground_, viewed, buffer_view(), area);
    if (!settings_.view.inspect) return;
    pixel_facts_ = pixel_facts(playground_, viewed);
    pixel_values_ = pixel_values(
        playground_, Viewer::fraction_at(middle_of_pixel(mouse_), size, buffer_view(), area));
}

Facts PlaygroundWindow::facts() {
    passes_ = pass_facts(playground_);
    pixel_facts_.reset();
    pixel_values_.clear();
    grid_.clear();
    const bool sees_scene = playground_.is_open() && settings_.shown == Shown::scene;
    if (sees_scene && settings_.visible && settings_.passes) gather_pixels();
    browser_entries_.clear();
    for (const Look& look : browser_.looks()) {
        browser_entries_.push_back({look.file, look.title, look.shelf, look.thumbnail.id(), {}});
    }
    const Preset* preset = playground_.preset();
    Facts facts;
    facts.scene = preset ? &preset->scene : nullptr;
    facts.title = preset && !preset->title.empty() ? preset->title : file_.stem().string();
    facts.file = file_;
    facts.unsaved = is_unsaved();
    facts.why_no_save = why_no_save();
    facts.why_no_revert = why_no_revert();
    facts.start_time = start_time_;
    facts.loading = playground_.is_loading();
    facts.specialised = playground_.is_specialised();
    facts.replayed = playground_.replayed();
    tell_start(facts);
    tell_resolution(facts);
    facts.simulates = playground_.simulates();
    facts.kept_states = playground_.kept_states();
    facts.replay_rate = playground_.replay_rate();
    facts.diagnostics = playground_.diagnostics();
    facts.empty_channels = empty_channels_;
    facts.last_reload = last_reload_;
    facts.instant = playground_.instant();
    facts.frame_ms = playground_.frame_ms();
    facts.renderer = window_.renderer();
    facts.picture_size = playground_.size();
    facts.frame_size = frame_size().value_or(glm::ivec2(0));
    facts.question = overwriting_ ? Question::overwrite
                     : leaving_   ? Question::leave
                     : offer_     ? Question::restore
                                  : Question::none;
    facts.passes = passes_;
    facts.pixel_facts = pixel_facts_;
    facts.pixel_values = pixel_values_;
    facts.grid = grid_;
    facts.browser = browser_entries_;
    facts.folder = folder_;
    facts.templates = template_names();
    facts.recording = playground_.recorder.recording();
    facts.has_sound = sound_.has_sound();
    facts.why_silent = sound_.why_silent();
    facts.notice = notice_;
    facts.notice_number = notice_number_;
    tell_findings(facts);
    tell_probe(facts);
    const std::string title =
        file_.empty() ? "Glint"
                      : fmt::format("{}{} - Glint", facts.title, facts.unsaved ? " *" : "");
    if (title != title_) window_.set_title(title_ = title);
    return facts;
}

void PlaygroundWindow::print_reports() {
    const std::size_t total = playground_.report_count();
    const auto& reports = playground_.reports();
    const std::size_t unprinted = std::min(total - printed_reports_, reports.size());
    for (std::size_t i = reports.size() - unprinted; i < reports.size(); ++i) {
        last_reload_ = reports[i].text;
        say("{}\n", last_reload_);
        for (const Diagnostic& diagnostic : playground_.diagnostics()) {
            say_diagnostic(diagnostic);
        }
        // An input of the scene before may arrive while the file that is open is still tried.
        if (reports[i].shown && !values_known_ && playground_.as_written()) {
            values_known_ = true;
            keep_picture();
            recent_.add(file_);
            if (pause_at_open_) playground_.apply(TimeEdit::What::pause);
            pause_at_open_ = false;
            lay_options_over();
            find_unsaved();
        } else if (reports[i].shown && !is_preset(reports[i].file)) {
            stop_findings();  // they are about another text
        }
        // What is filled is filled in the file that is open.
        empty_channels_.clear();
        if (values_known_) empty_channels_ = empty_channels(playground_);
        dirty_ = true;
    }
    printed_reports_ = total;
}

void PlaygroundWindow::notice(std::string text) {
    notice_ = std::move(text);
    ++notice_number_;
    dirty_ = true;
}

void PlaygroundWindow::take_still() {
    if (!playground_.is_open()) return;
    if (playground_.replayed() < 1.0) return notice("A still waits for the end of the replay.");
    const fs::path name = free_picture_name(shown_file());
    try {
        write_image(name, playground_.still(), playground_.still_metadata());
        notice(fmt::format("{} written", name.string()));
    } catch (const std::runtime_error& error) {
        notice(error.what());
    }
}

void PlaygroundWindow::edit(const Diagnostic& diagnostic) {
    if (file_.empty()) return notice("Nothing is open.");
    Place place = diagnostic.place;
    const Preset* preset = playground_.preset();
    if (place.file.empty()) place.file = (preset ? preset->scene.files.front() : file_).string();
    const std::string problem = editor_.open(place);
    if (!problem.empty()) notice(problem);
}

void PlaygroundWindow::grant(const Wishes& wishes) {
    if (wishes.tweaks_changed) playground_.tweaks_changed();
    for (const TimeEdit& edit : wishes.time) playground_.apply(edit);
    dirty_ |= !wishes.time.empty();
    if (wishes.open) leave({Leaving::For::open, *wishes.open});
    if (wishes.start_time) start_time_ = wishes.start_time->seconds;
    if (wishes.save && is_preset(file_)) save(file_);
    if (wishes.save_as) save_as(*wishes.save_as);
    if (wishes.new_scene) make_new_scene(*wishes.new_scene);
    if (wishes.revert) leave({Leaving::For::revert, {}});
    if (wishes.still) take_still();
    if (wishes.toggle_recording) toggle_recording();
    if (wishes.answer) take_answer(*wishes.answer);
    if (wishes.toggle_full_screen) toggle_full_screen();
    if (wishes.edit) edit(*wishes.edit);
    if (wishes.fill) playground_.fill(*wishes.fill);
    browser_.draw_first(wishes.seen);
    grant_findings(wishes);
    grant_probe(wishes);
    if (wishes.quit) leave({Leaving::For::quit, {}});
}

void run_window(const ViewOptions& options) {
    int signal = 0;
    bool reads = false;
    {
        PlaygroundWindow window(options);
        signal = window.run();
        reads = window.is_reading_inputs();
    }
    if (signal != 0) end_by(signal);
    if (!reads) return;
    // A file that is large, or on a disk that hangs, keeps nobody waiting; and what other exits
    // take down, the thread that reads it still uses.
    std::fflush(nullptr);
    ::_exit(static_cast<int>(ExitCode::done));
}

}  // namespace glint
