#include "window/live/playground.h"

#include "base/readable_file.h"
#include "render/room.h"
#include "scene/look_changes.h"
#include "scene/preset_writer.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace glint {
namespace {

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

Playground::Playground(Context& context, Trial& trial, glm::ivec2 size,
                       const PlaygroundOptions& options)
    : context_(context),
      options_(options),
      size_(size),
      full_size_(size),
      programs_(trial, options.device, options.specialise,
                KeptVerdicts(options.verdicts, context.driver())),
      sketcher_(options.device),
      reloader_(reload_steps(),
                {.constants = options.specialise, .hopeless_ms = options.hopeless_ms}),
      inputs_(texture_limits()),
      start_states_(options.start_states),
      kept_maps_(options.maps) {}

Playground::~Playground() = default;

ReloadSteps Playground::reload_steps() {
    return {
        .read =
            [this](const std::filesystem::path& file) {
                ReadPreset read = read_preset(file);
                if (!read.preset) return read;
                lay_fills_over(*read.preset);
                tell_failed_inputs(read);
                return read;
            },
        .watch =
            [this](const ReadPreset& read) {
                const Preset* preset = read.preset ? &*read.preset : preset_.get();
                watcher_.set_files(watched_files(read.files, preset));
            },
        .has_uniforms = [this](const Preset& text) { return programs_.draw(text); },
        .start_trial = [this](const Preset& preset, Programs programs,
                              bool is_text) { start_trial(preset, programs, is_text); },
        .trial = [this]() -> const Verdict& {
            return programs_.follow_trial(reloader_.is_trying(), renderer_.get());
        },
        .put_in_place = [this](const Preset& preset, Programs programs,
                               bool is_text) { return put_in_place(preset, programs, is_text); }};
}

// The values that a text would be drawn with: those that a person has set stay.
TweakValues Playground::tweaks_with(const Preset& text, std::vector<std::string>* overruled) const {
    const Preset* written = reloader_.as_written();
    if (!written) {
        TweakValues next(text.scene.tweaks, text.values);
        next.set_locks(text.locked);
        return next;
    }
    TweakValues next = tweaks;
    next.rebase(text.scene.tweaks, text.values);
    std::vector<std::string> names = lay_changes_over(*written, text, next);
    if (overruled) *overruled = std::move(names);
    return next;
}

void Playground::start_trial(const Preset& candidate, Programs programs, bool is_text) {
    Preset tried = candidate;
    if (is_text) tried.values = tweaks_with(candidate).values();
    programs_.start_trial(std::move(tried), programs, is_text, full_size_, transport_.time());
    since_trial_.restart();
    wants_sketch_ = is_text && !programs_.is_tried_by_standby();
    if (sketcher_.is_drawing()) sketcher_.stop();
    sketch_.reset();
}

void Playground::open(const std::filesystem::path& file) {
    fills_ = {};
    failed_inputs_.clear();
    programs_.forget_costs();
    watcher_.about_to_read();
    reloader_.open(file);
}

std::vector<int> Playground::descriptors() const {
    std::vector<int> descriptors = programs_.descriptors();
    descriptors.insert(descriptors.end(),
                       {watcher_.descriptor(), sketcher_.descriptor(), inputs_.descriptor()});
    return descriptors;
}

bool Playground::update() {
    const std::size_t reports = report_count();
    const bool was_loading = is_loading();
    notice_saves();
    programs_.hear();
    if (reloader_.follow()) load_missing_inputs();
    follow_inputs();
    const bool is_sketched = follow_sketch();
    prepare_uniforms();
    // The tweaks may have moved while constants were compiled, or before there was anything else.
    const bool may_follow = is_specialised() || programs_.has_fed();
    if (constants_ && *constants_ != tweaks.values() && may_follow) leave_constants();
    specialise_at_rest();
    const bool is_behind = touched_ && renderer_;  // without one there is nothing to draw anew
    return reports != report_count() || was_loading != is_loading() || is_behind || is_sketched;
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
                                                    Renderer* previous, Diagnostics& why_not) {
    CompileResult compiled =
        compile_scene(preset, {.program = options}, nullptr, nullptr, &programs_.shelf());
    if (!compiled.scene) {
        why_not = std::move(compiled.diagnostics);
        return nullptr;
    }
    return std::make_unique<Renderer>(
        preset, std::move(*compiled.scene),
        RenderOptions{.size = size_, .picture_format = picture_format()}, previous);
}

// In one step, or all is left as it was.
Diagnostics Playground::put_in_place(const Preset& candidate, Programs programs, bool is_text) {
    const bool is_constant = programs == Programs::constants;
    const Preset* written = reloader_.as_written();
    auto preset = std::make_unique<Preset>(candidate);
    std::vector<std::string> overruled;
    TweakValues next = is_text ? tweaks_with(candidate, &overruled) : tweaks;
    // For the compiler and the renderer alone. A tweak that moved since is followed at once.
    preset->values = is_constant ? programs_.tried().values : next.values();
    const bool is_same_file = (preset_ && written) || !is_text;
    Renderer* previous = is_same_file ? renderer_.get() : nullptr;
    std::unique_ptr<Renderer> renderer;
    try {
        Diagnostics why_not;
        renderer = make_renderer(*preset, programs_.options(programs), previous, why_not);
        if (!renderer) return why_not;
        // What cannot be opened keeps the scene before; what cannot be decoded is told later.
        for (const std::size_t sampler : renderer->inputs_needed())
            for (const auto& file : sampler_at(*preset, sampler).files) require_readable(file);
        context_.finish();  // now the driver says whether there was memory for all buffers
    } catch (const ContextLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        if (renderer && previous) previous->adopt(*renderer);
        return {{.place = {.file = reloader_.file().string()}, .text = error.what()}};
    }
    if (is_text && !written && renderer_) before_other_scene();
    touched_ |= constants_ && *constants_ != preset->values;
    touched_ |= renderer_ && renderer_->has_maps_left();
    programs_.note_drawn(programs, is_text, renderer_.get(), !constants_);
    const bool states_stay = is_text && written && has_states_of(*preset, next.values());
    renderer_ = std::move(renderer);
    preset_ = std::move(preset);
    constants_.reset();
    if (is_constant) constants_ = std::move(preset_->values);
    preset_->values.clear();
    tweaks = std::move(next);
    if (is_text) overruled_ = std::move(overruled);
    if (!states_stay) forget_states();
    if (!is_text || !options_.specialise) programs_.tidy(*renderer_);
    if (!is_text && !renderer_->inputs_needed().empty()) load_missing_inputs();
    if (!is_text) return {};  // the picture is the same; nothing asks for a frame
    for (std::size_t i = 0; i < fills_.size(); ++i)
        fills_[i] = laid_over_[i] ? preset_->channels[i] : Sampler();
    since_tweak_.restart();
    touched_ = true;
    constants_alone_fit_ = false;
    quick_frames_ = 0;
    kept_maps_.forget();
    if (!written) begin_file(is_constant);
    return {};
}

// What is in place is the first of its file.
void Playground::begin_file(bool is_constant) {
    if (is_constant) kept_maps_.give(*preset_, *renderer_, programs_.shelf(), context_.driver());
    expected_ms_ = programs_.expected_ms();
    find_start_state();
    has_picture_ = false;
    opening_ = Opening::awaits_inputs;
    transport_ = Transport(preset_->time);
    input_ = {};
    recent_ = {};
    extra_frames_ = frame_offset_ = 0;
    is_replayable_ = preset_->time == 0.0;  // else the first frame is a jump
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

// Draws fed programs, where these are at hand and fit into memory. Else the picture waits for them,
// or for the constants of the new values.
void Playground::leave_constants() {
    if (!constants_) return;
    reloader_.uses_uniforms();
    if (constants_alone_fit_) return;
    std::optional<CompiledScene> scene = programs_.take_fed(*preset_);
    if (!scene) return;
    std::unique_ptr<Renderer> renderer;
    try {
        renderer = std::make_unique<Renderer>(
            *preset_, std::move(*scene),
            RenderOptions{.size = size_, .picture_format = picture_format()}, renderer_.get());
    } catch (const NoRoom& error) {
        // They draw what constants switch off, too.
        constants_alone_fit_ = true;
        reloader_.tell({.place = {.file = reloader_.file().string()}, .text = error.what()});
        return;
    }
    renderer->set_values(tweaks.values());
    renderer_ = std::move(renderer);
    forget_states();
    constants_.reset();
    touched_ = begins_move_ = true;
    load_missing_inputs();  // constants may have had no use for some
}

// When there is nothing else to do: the picture comes first.
void Playground::prepare_uniforms() {
    if (!renderer_) return;
    programs_.follow_standby(*renderer_);
    const bool is_quiet =
        reloader_.state() == ReloadState::idle && !reloader_.has_unseen() && !awaits_inputs();
    if (is_quiet && has_picture_) programs_.keep_verdict();
    if (is_quiet) keep_maps();
    if (is_quiet && programs_.wants_preparing())
        programs_.prepare(current_preset(), full_size_, transport_.time());
}

void Playground::specialise_at_rest() {
    if (!renderer_ || !reloader_.wants_constants() || (tweaks.is_open() && !constants_)) return;
    // Where the picture does not follow yet, constants are the first to show the new values.
    constexpr double kStandsStill = 0.1;  // s
    const double rest = constants_ ? kStandsStill : options_.rest_seconds;
    if (since_tweak_.ms() < rest * 1000.0) return;
    reloader_.tweaks_rest(current_preset());
}

void Playground::resize(glm::ivec2 size) {
    if (size == size_ || size == refused_size_) return;
    touched_ = true;
    if (states_depend_on_size()) forget_states();
    refused_size_ = {0, 0};
    constants_alone_fit_ = false;
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

void Playground::go_on_in(const std::filesystem::path& file, const Preset& preset) {
    fills_ = {};
    tweaks.set_written(preset.values);
    watcher_.about_to_read();
    reloader_.go_on_in(file, preset);
}

bool Playground::is_as_read(const std::string& text) const {
    return as_written() && write_preset(without_fills(), reloader_.file(), text).text == text;
}

Preset Playground::without_fills() const {
    Preset written = *as_written();
    for (std::size_t i = 0; i < laid_over_.size(); ++i)
        if (laid_over_[i]) written.channels[i] = {};
    return written;
}

Preset Playground::current_preset() const {
    Preset preset = *preset_;
    preset.values = tweaks.values();
    preset.locked = tweaks.locks();
    std::ranges::copy(locks_without_tweak(*preset_), std::back_inserter(preset.locked));
    preset.time = instant_.time;
    return preset;
}

}  // namespace glint
