// An open scene, live: it follows its files, keeps what a person has set, and draws when something
// has changed. It knows no window and no panels, so it runs in tests without either.
//
// playground.cpp opens, places what has passed its trial, and follows tweaks; playground_frames.cpp
// draws; playground_replay.cpp and playground_start.cpp play simulations to a time;
// playground_sketch.cpp draws a coarse picture where the fast programs take long;
// playground_inputs.cpp has the files of samplers; playground_pictures.cpp draws for others than
// the screen.
#pragma once

#include "base/watcher.h"
#include "gl/context.h"
#include "media/image.h"
#include "offline/common.h"
#include "scene/recording.h"
#include "scene/transport.h"
#include "scene/tweak_values.h"
#include "window/live/input_loader.h"
#include "window/live/kept_maps.h"
#include "window/live/kept_states.h"
#include "window/live/live_programs.h"
#include "window/live/reloader.h"
#include "window/live/start_states.h"
#include "window/trial/refiner.h"
#include "window/trial/sketcher.h"

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace glint {

struct PlaygroundOptions {
    std::string device;            // as for make_egl_context, of the processes that try and refine
    bool specialise = true;        // tweaks become constants once they rest
    double rest_seconds = 0.4;     // how long they rest before that
    double hopeless_ms = 10000.0;  // a frame that would take longer is refused
    // Where simulations that have been played up to their start are kept; empty: nowhere.
    std::filesystem::path start_states{};
    // Where maps are kept that took long to draw; empty: nowhere.
    std::filesystem::path maps{};
    // Where it is kept which texts have passed their trial; empty: nowhere.
    std::filesystem::path verdicts{};
};

// To be used on one thread. What a person typed wrong is told by diagnostics() and leaves on the
// screen what was there; a lost GPU throws ContextLost from whatever uses it. Sizes are pixels of
// the picture, times seconds of the scene, unless they say otherwise.
class Playground {
    // A live frame catches up at most this much simulated time after a hitch.
    static constexpr double kLongestCatchUp = 0.25;  // s

public:
    // `context` is current in every call; it and `trial`, which tries what is opened or saved,
    // outlive the playground. Throws std::system_error where the process has no descriptor left to
    // follow files with.
    Playground(Context& context, Trial& trial, glm::ivec2 size,
               const PlaygroundOptions& options = {});
    ~Playground();

    // --- The file ---

    // Opens a scene or a preset, or this one anew. What was open stays on the screen until the new
    // one draws, and for good where it cannot.
    void open(const std::filesystem::path& file);

    // Called before the scene of another file takes the place of what is shown, which still stands
    // then, with its tweaks.
    std::function<void()> before_other_scene = [] {};

    // Follows files and trials; does not wait. True when something has changed that a person sees.
    bool update();
    // For ::poll(): readable when update() has something to do. Valid until the next update().
    std::vector<int> descriptors() const;

    bool is_open() const { return renderer_ != nullptr; }
    // What is drawn, or null; its values are empty: `tweaks` has them. Valid until the next
    // update(), as is all that is returned by reference here.
    const Preset* preset() const { return preset_.get(); }
    // What draws it, or null.
    Renderer* renderer() { return renderer_.get(); }
    // What is shown as its file has it, without what was changed here; null until it is shown.
    const Preset* as_written() const { return reloader_.as_written(); }
    // The same, but for the channels that were filled here. While it is shown.
    Preset without_fills() const;
    // Whether this text of the file says what was read from it, or given to it, last.
    bool is_as_read(const std::string& text) const;

    // The file has just been given this.
    void note_saved(const Preset& preset) {
        reloader_.note_saved(preset);
        tweaks.set_written(preset.values);
        fills_ = {};
        laid_over_ = {};
    }
    // What is shown has its file's name from now on, which has just been given this. All goes on:
    // time, buffers, undo.
    void go_on_in(const std::filesystem::path& file, const Preset& preset);

    // What is wrong with the newest text, and what could not be done for it since.
    const Diagnostics& diagnostics() const { return reloader_.diagnostics(); }
    // The newest text that was tried was refused, for the reasons that the diagnostics tell.
    bool shows_older_text() const { return reloader_.shows_older_text(); }
    // The last reloads, and how many there were in all.
    const std::deque<ReloadReport>& reports() const { return reloader_.reports(); }
    std::size_t report_count() const { return reloader_.report_count(); }

    // --- What goes on in the background ---

    // A text is tried, or an input that it names is read.
    bool is_loading() const { return reloader_.is_trying() || awaits_inputs(); }
    // Something large goes to the driver in pieces; update() is to be called again at once.
    bool is_sending() const {
        return !arriving_.empty() || programs_.is_linking_standby() ||
               (reloader_.is_trying() && programs_.is_linking_tried());
    }
    // Whether another thread still reads an input, wanted or not. It ends with the process.
    bool is_reading_inputs() const { return inputs_.is_reading(); }
    // The picture is drawn with the tweaks written in.
    bool is_specialised() const { return reloader_.programs() == Programs::constants; }
    // Whether a slider or a number can move without a compiler.
    bool is_prepared() const { return programs_.is_prepared(); }
    // Nothing is left to be done.
    bool is_at_rest() const {
        return reloader_.programs() != Programs::uniforms && programs_.is_at_rest();
    }
    // What the next picture waits for, in words such as "compiling image"; "" where nothing is
    // waited for.
    std::string waits_for() const;

    // --- Frames ---

    // Whether a frame is due: time moves, or an input, a tweak, the size or the scene has changed.
    bool wants_frame() const;
    // Whether that frame is the first of a text that was saved or opened.
    bool has_unseen_text() const { return reloader_.has_unseen(); }
    // Draws what is due, and waits for the GPU; `wall_seconds` have passed since the last call.
    // True when the picture is new: not while a simulation is played up to the time.
    bool draw(double wall_seconds);

    // Whether what is open has been drawn. A simulation is first played up to its start.
    bool has_picture() const { return has_picture_; }
    // Pictures drawn so far, of all files.
    std::size_t picture_count() const { return pictures_; }
    // What the last picture was drawn at, and what it took, ms of the clock.
    const Instant& instant() const { return instant_; }
    double frame_ms() const { return frame_ms_; }
    // What the trial of the file that was opened took a frame of the full size to cost, ms; 0: not
    // known.
    double expected_ms() const { return expected_ms_; }

    // Milliseconds a pass of the graph took last, and whether the last frame drew it.
    struct PassTime {
        double ms = 0.0;
        bool drawn = false;
    };
    // In the order of the graph. Empty unless measuring.
    const std::vector<PassTime>& pass_times() const { return pass_times_; }
    // Frames wait after every pass meanwhile, and the picture is kept in floats: bytes hold no NaN.
    void measure_passes(bool on);

    // It stays as it is where there is no memory for the new size; the diagnostics tell.
    void resize(glm::ivec2 size);
    glm::ivec2 size() const { return size_; }
    // The size that stills have and others are told of, where the screen shows a share of it.
    void set_full_size(glm::ivec2 size) { full_size_ = size; }
    glm::ivec2 still_size() const { return keeps_size() ? size_ : full_size_; }
    // Its buffers would be cropped by another size: it keeps the one that its first frame had, in
    // stills, too.
    bool keeps_size() const {
        return renderer_ && keeps_picture_size(preset_->scene, renderer_->graph());
    }

    // --- What a person does ---

    // Input, for the next frame; asks for one when the scene reads it. Positions are fractions of
    // the picture, y up; codes those of the site's keyboard.
    void mouse(glm::dvec2 fraction, bool down);
    void key(int code, bool down);
    // Records both from now on, into `recorder`, as what goes on after these.
    void start_recording(std::span<const Event> before) {
        const InputReads reads{.mouse = renderer_ && renderer_->reads_mouse(),
                               .keys = renderer_ && renderer_->reads_keyboard()};
        recorder.start(instant_.time, input_, before, reads);
    }

    // `tweaks` were changed: the next frame shows it.
    void tweaks_changed();

    // Fills the channel of this name, where the scene and its preset fill it by nothing, until the
    // file is left: reads it again, and tries it.
    void fill(const Sampler& channel);
    // Leaves the channels to what the file says.
    void forget_fills();
    bool has_fills() const;

    // Time, whose only owner this is: keys and panels ask.
    const Transport& transport() const { return transport_; }
    void apply(const TimeEdit& edit) { transport_.apply(edit); }
    void apply(TimeEdit::What what) { apply({.what = what, .loop = {}}); }

    // Whether a jump of time plays the scene again.
    bool simulates() const;
    // Fraction done of a replay to a time that was jumped to, or 1.
    double replayed() const;
    // From which times it can be, s, ascending, beside 0.
    const std::vector<double>& kept_states() const { return kept_states_.times(); }
    // How many of its seconds are played in one of the clock; 0 before the first such jump.
    double replay_rate() const;

    // --- The picture for others ---

    // As a still would write it, RGB: drawn anew at its full size, the tweaks as constants. Nothing
    // while nothing is open; throws std::runtime_error where there is no memory for that size.
    Image still();
    Metadata still_metadata() const;

    // The same instant with the values of one of the two tweak sets, drawn from the buffers as they
    // stand. Null while nothing is open, and until programs are at hand that can draw it.
    const Buffer* picture_of(TweakSet set);

    // The first picture of a text that was saved and is compiled still, as large as what is shown;
    // null where there is none.
    const Buffer* sketch() const { return awaits_text() ? sketch_.get() : nullptr; }
    // How long that took from the save on, ms; once, when there is a new one.
    std::optional<double> take_sketch_ms() { return std::exchange(sketch_ms_, std::nullopt); }

    // Tweaks that were edited in the file, of whose values here no file knew; once, when the file
    // has been taken over. Undo brings those back.
    std::vector<std::string> take_overruled() { return std::exchange(overruled_, {}); }

    // Nothing moves, and nothing is about to: the picture may be refined.
    bool stands() const;
    // For that; `picture_count()` says whether it is still about what is shown.
    RefineOrder refine_order() const;

    // The frame that was drawn last, for another process to look into a pass of it; what the pass
    // reads goes into that memory. While something has been drawn.
    RefineOrder probe_order(std::size_t pass, SharedMemory& memory);

    // The preset as it stands now: values, time, size, recorded events. While one is open.
    Preset current_preset() const;
    // The same for another process to draw what is seen here, mouse and keys included. A scene that
    // has to be played to its time is taken soon after its start.
    Preset preset_as_shown() const;

    // The only owner of what the tweaks are now. Whoever changes them calls tweaks_changed().
    TweakValues tweaks{{}};
    Recorder recorder;

private:
    ReloadSteps reload_steps();
    void notice_saves();
    void reload_inputs(const std::vector<std::filesystem::path>& changed);
    void load_missing_inputs();
    void follow_inputs();
    void take_input(InputLoader::Loaded loaded);
    void input_failed(InputLoader::Loaded loaded);
    void forget_failure(const Sampler& sampler);
    void tell_failed_inputs(ReadPreset& read) const;
    void send_arriving();
    bool send_slice();
    void show_arrived();
    void drop_arriving(const std::string& why);
    bool awaits_inputs() const { return inputs_.is_loading() || !arriving_.empty(); }
    std::optional<std::size_t> index_of(const Sampler& sampler) const;
    void lay_fills_over(Preset& candidate);
    void heard(bool is_read);
    void forget_slowness();
    double map_seconds() const;
    void start_trial(const Preset& candidate, Programs programs, bool is_text);
    TweakValues tweaks_with(const Preset& text,
                            std::vector<std::string>* overruled = nullptr) const;
    Diagnostics put_in_place(const Preset& candidate, Programs programs, bool is_text);
    void begin_file(bool is_constant);
    void specialise_at_rest();
    void prepare_uniforms();
    bool follow_sketch();
    bool may_sketch() const;
    void start_sketch();
    RefineOrder order_of(Preset preset) const;
    void prepare_sketch();
    std::vector<GivenBuffer> standing_buffers(const std::vector<std::size_t>& indices);
    void note_texts(std::vector<GivenBuffer>& list);
    void read_buffers(std::vector<GivenBuffer>& list, SharedMemory& shared);
    bool awaits_text() const {
        return reloader_.state() == ReloadState::trying_text || reloader_.has_unseen();
    }
    void leave_constants();
    Frame next_frame(double wall_seconds);
    void follow_events(double before, double time);
    void take_events_up_to(double time);
    void replay_events(double from, double to);
    Frame frame_again() const;
    Frame frame_at_full_size() const;
    Programs still_programs() const {
        const bool refused = reloader_.programs() == Programs::uniforms_for_good;
        return refused ? Programs::uniforms : Programs::constants;
    }
    PixelFormat picture_format() const {
        return measuring_ ? PixelFormat::rgba32f : PixelFormat::rgba8;
    }
    void begin_replay(bool from_start);
    bool replay_slice(Frame& frame);
    void find_start_state();
    bool stands_for_start() const;
    void take_start_state();
    void keep_start_state();
    void keep_maps();
    void keep_live_state();
    void notice_dropped_steps();
    bool has_states_of(const Preset& preset, const std::vector<TweakValue>& values) const;
    void forget_states();
    bool states_depend_on_size() const;
    bool follows_time() const;
    std::unique_ptr<Renderer> make_renderer(const Preset& preset, const ProgramOptions& options,
                                            Renderer* previous, Diagnostics& why_not);

    Context& context_;
    PlaygroundOptions options_;
    Transport transport_;
    glm::ivec2 size_, full_size_, refused_size_{0};
    Watcher watcher_;
    LivePrograms programs_;
    Sketcher sketcher_;
    std::vector<GivenBuffer> known_to_sketch_;  // to the process at hand
    std::unique_ptr<Buffer> sketch_;
    std::optional<double> sketch_ms_;
    std::vector<std::string> overruled_;
    bool wants_sketch_ = false;
    Stopwatch since_trial_;
    Reloader reloader_;
    InputLoader inputs_;
    StartStates start_states_;
    KeptMaps kept_maps_;
    // Those whose file could not be read the last time; the picture may have one from before.
    std::vector<InputLoader::Loaded> failed_inputs_;
    // Read, and on the way to the driver.
    struct Arriving {
        InputLoader::Loaded loaded;
        PictureUpload upload;
    };
    std::deque<Arriving> arriving_;
    // A file that was opened: its inputs may come after its first frame. A simulation that began
    // without them is played again from its start.
    enum class Opening { done, awaits_inputs, plays_again } opening_ = Opening::done;

    std::unique_ptr<Preset> preset_;  // what is drawn, without values
    std::unique_ptr<Renderer> renderer_;
    // Of iChannel0..3, by a person here; the buffers that they name are those of preset_.
    std::array<Sampler, 4> fills_;
    std::array<bool, 4> laid_over_{};  // those that the newest text that was read has
    Stopwatch since_tweak_;
    // What the programs that are drawn have written in; nothing where they are fed.
    std::optional<std::vector<TweakValue>> constants_;
    bool constants_alone_fit_ = false;  // into memory, of this text in this size

    std::unique_ptr<Buffer> other_picture_;
    InputState input_;
    Recorder recent_;                        // for the steps of simulations
    InputState being_drawn_, drawn_inputs_;  // as the frame began
    Input drawn_input_;
    glm::ivec2 drawn_mouse_size_{0};
    glm::vec4 drawn_date_{0.0f};
    Instant instant_;
    bool has_picture_ = false;
    bool touched_ = true;       // something other than time asks for a frame
    bool begins_move_ = false;  // of a slider; fed programs draw for the first time
    int extra_frames_ = 0;      // drawn since time stands
    int frame_offset_ = 0;      // of iFrame from the frames drawn, since a replay
    int replay_at_ = -1, replay_from_ = 0, replay_until_ = -1;  // frames; at -1: none is under way
    double replayed_seconds_ = 0.0, replay_ms_ = 0.0;           // of the scene; of the clock
    KeptStates kept_states_;
    bool is_replayable_ = false;  // the buffers stand as in a still of this time
    bool replays_start_ = false;  // a file was opened, and has not been played up to its start
    std::vector<TweakValue> start_values_;
    double frame_ms_ = 0.0, expected_ms_ = 0.0;
    std::size_t pictures_ = 0;                 // drawn so far
    static constexpr double kSlowMs = 1000.0;  // as of TrialOptions
    int quick_frames_ = 0;                     // in a row, of this text
    bool measuring_ = false;
    std::vector<PassTime> pass_times_;
};

}  // namespace glint
