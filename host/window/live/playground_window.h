// The window of an open scene: what it holds together, and who does what.
//
// window.cpp draws and grants wishes, window_input.cpp hears keys and mouse, window_findings.cpp
// runs studies and checks beside it, window_work.cpp sees to it that no work is lost,
// window_probe.cpp asks for values of a pixel, window_start.cpp shows what stands for a scene until
// it draws, window_resolution.cpp chooses how many pixels it draws.
#pragma once

#include "base/end_signals.h"
#include "render/viewer.h"
#include "window/live/browser.h"
#include "window/live/check.h"
#include "window/live/crash_mark.h"
#include "window/live/editor.h"
#include "window/live/glfw_window.h"
#include "window/live/held_rate.h"
#include "window/live/kept_pictures.h"
#include "window/live/kept_resolutions.h"
#include "window/live/live_probe.h"
#include "window/live/picture_shelf.h"
#include "window/live/playground.h"
#include "window/live/recent.h"
#include "window/live/sound.h"
#include "window/live/start_picture.h"
#include "window/live/study.h"
#include "window/live/unsaved_work.h"
#include "window/ui/panels.h"
#include "window/ui/shortcuts.h"

#include <array>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace glint {

// Positions and sizes are pixels of the window, y up, unless they say otherwise. What goes wrong
// is told by notice() in the window, and leaves all as it was.
class PlaygroundWindow {
public:
    // Opens the file of the options, or shows those of its folder. Throws UsageError where the
    // options do not fit the file, std::runtime_error where there is no screen or no GL.
    explicit PlaygroundWindow(const ViewOptions& options);
    // Until it is closed, or a signal asks the program to end: that one, or 0. Throws ContextLost.
    int run();
    // Whether another thread still uses what the end of the program takes down.
    bool is_reading_inputs() const { return playground_.is_reading_inputs(); }

private:
    // Input. Shortcuts come first, panels next, and the scene has what is left.
    void handle(const WindowEvent& event);
    void handle_key(const WindowEvent& event);
    void handle_mouse(const WindowEvent& event);
    void release_keys();
    void take_dropped(const std::filesystem::path& file);
    bool run_shortcut(int key, int modifiers);
    void end_typing();
    void act(Action action);
    void flip(Action action);  // one of the settings
    void play_or_pause();
    void hide_panels();
    void undo(bool (TweakValues::*step)());
    void save_or_ask();
    void revert_or_say();
    void edit_first();
    // The mouse is the scene's: neither a buffer is looked at, nor pixels, nor what a study found.
    bool is_over_scene() const {
        return settings_.view.sampler.empty() && settings_.view.zoom == 0.0 &&
               settings_.shown == Shown::scene;
    }
    // Whether something can be magnified: a panel is open for that, or a study's picture is shown.
    bool looks_inside() const { return settings_.passes || settings_.shown != Shown::scene; }
    void settle_view();

    // What panels and shortcuts ask for
    void grant(const Wishes& wishes);
    void take_still();
    void edit(const Diagnostic& diagnostic);
    void close_one();
    void toggle_free_aspect();
    void toggle_full_screen();
    // Words that stand in the window for a while; "" takes them away.
    void notice(std::string text);
    void tell_overruled();

    // What would take unsaved work away, and is asked about first.
    struct Leaving {
        enum class For { quit, open, revert, record } what = For::quit;
        std::filesystem::path file;  // to be opened
        std::string new_from = {};   // and made before, of this
    };
    void leave(const Leaving& leaving);  // asks, or goes
    bool takes_away(Leaving::For what) const;
    void go(Leaving leaving);
    void discard(const Leaving& leaving);
    void open_new(const Leaving& leaving);
    void take_answer(Answer answer);
    void open(const std::filesystem::path& file);  // unasked
    void import_or_open(const std::filesystem::path& file);
    void browse(const std::filesystem::path& folder);
    void list_files();
    void make_new_scene(const NewScene& wanted);
    // Under another name: goes on there, or where leave() was asked for.
    void save_as(const std::filesystem::path& file);
    // True once it is written. Where the file says by now what nobody here has read, a person is
    // asked first.
    enum class Over { nothing_unread, anything };
    bool save(const std::filesystem::path& file, Over over = Over::nothing_unread);
    bool write_look(const Preset& preset, const std::filesystem::path& file);
    void go_on_in(const std::filesystem::path& file, const Preset& preset);
    // A sentence, or "" where it is possible.
    std::string why_nothing_is_open() const;
    std::string why_no_save() const;
    std::string why_no_revert() const;
    void revert();
    void toggle_recording();
    void stop_recording();
    void follow_recording();
    void tell_recorded();

    // Unsaved work, which the state folder keeps for the next run
    const Preset* written() const;
    std::filesystem::path shown_file() const;
    void stay_with_scene();
    void leave_scene();
    void begin_work();
    bool is_unsaved() const;
    bool differs_from_file() const;
    bool has_worked(TweakSet set) const;
    bool is_unsaved_but_values() const;
    bool hides_work() const;
    void show_hidden_work();
    void note_work();
    std::vector<Event> unsaved_events() const;
    // `end` is the time of the last frame of what is recorded.
    std::vector<Event> with_written_events(std::span<const Event> recorded, double end) const;
    void start_recording();
    Preset preset_to_save() const;
    void lay_options_over();
    void keep_unsaved();
    void keep_unsaved(TweakSet set);
    void keep_now(TweakSet set);
    void keep_at_end();
    bool has_work(TweakSet set) const;
    bool is_keeping_due() const;
    bool is_keeping_due(TweakSet set) const;
    bool is_gone() const;
    void let_go_of_work();
    void find_unsaved();
    TweakSet offered_set() const;
    ReadPreset read_offer() const;
    bool says_what_stands(const Preset& look) const;
    void restore();
    struct Kept;
    Kept work(TweakSet set) const;

    // Studies and checks
    bool follow_findings();  // true when there is something new
    void grant_findings(const Wishes& wishes);
    struct Subject;
    void begin_finding(Subject& subject, const std::function<void()>& start);
    void stop_findings();
    void tell_findings(Facts& facts) const;
    // Each puts its picture into the view; false where there is none to show.
    bool show_finding();
    bool show_failure();
    bool show_comparison();

    // Values of a pixel
    bool probes() const;
    const std::vector<std::string>& watch() const;
    std::optional<glm::dvec2> probed_place() const;  // a fraction of the picture
    bool follow_probe();                             // true when there is something new
    bool pin_probe(glm::dvec2 position);
    void tell_probe(Facts& facts) const;
    void grant_probe(const Wishes& wishes);
    bool show_value(const BufferView& view);

    // The resolution that is held while something moves, and what refines it when nothing does
    glm::ivec2 full_size() const;  // pixels of the picture
    void choose_resolution();
    void begin_resolution();
    void measure_beside(const Stopwatch& clock);
    void hold_rate();
    void keep_resolution() const;
    bool shows_refined() const;
    bool refining_is_due() const;
    bool follow_refining();
    bool show_refined(const BufferView& view);
    void tell_resolution(Facts& facts) const;

    // Until the first frame of a file
    bool awaits_first_frame() const;
    void begin_start();
    bool follow_start();
    bool shows_start_picture() const;
    void keep_picture();
    void tell_start(Facts& facts) const;

    // Drawing
    double wait_seconds() const;
    bool shows_clock() const;
    double clock_tick() const;  // s
    void draw_frame();
    bool answers_first();
    bool draw_scene();
    void follow_sound(double at);  // s of the clock
    void show_picture();
    bool show_sketch(const BufferView& view);
    void show_wipe(const Buffer& left, const Buffer& right, const BufferView& view);
    Facts facts();  // valid until the next frame: they point at what is kept here
    void gather_pixels();
    BufferView buffer_view() const;
    std::optional<glm::ivec2> frame_size() const;
    ScreenArea picture_area() const;
    ScreenArea view_area() const;
    glm::ivec2 viewed_size() const;
    glm::dvec2 on_picture(glm::dvec2 position) const;  // a fraction, y up
    bool is_on_picture(glm::dvec2 position) const;
    void print_reports();

    EndSignals end_signals_;
    ViewOptions options_;  // size and tweaks are those of the file that was opened first
    KeptPictures kept_pictures_;
    StartPicture::Reading begun_picture_;
    std::future<glm::ivec2> begun_size_;  // read while GLFW asks the screen
    Glfw glfw_;
    std::future<Fonts> begun_fonts_;  // drawn while the window loads its driver
    Trial trial_;                     // its process starts when the window has loaded its driver
    Window window_;
    Panels panels_;
    StartPicture start_picture_;
    CrashMark crash_mark_;
    UnsavedWork unsaved_work_;
    Playground playground_;
    Viewer viewer_;
    PanelSettings settings_;
    Browser browser_;
    Recent recent_;
    LiveStudy study_;
    LiveCheck check_;
    LiveSound sound_;
    Editor editor_;
    PictureShelf pictures_;
    Refiner refiner_;
    LiveProbe probe_;
    Span seen_lines_{};                              // of the text, in the source panel
    std::optional<std::vector<std::string>> watch_;  // another than the file's
    std::optional<glm::dvec2> last_probed_;
    std::optional<glm::ivec2> probed_pixel_;
    glm::ivec2 probed_size_{0};  // of the buffer in which it is
    KeptResolutions kept_resolutions_;
    HeldRate held_rate_;
    bool resolution_begun_ = false;  // of the file that was opened
    bool is_held_ = true;            // the setting as it was when the resolution was chosen
    double beside_ms_ = 0.0;         // to show a picture, and the panels
    // What is refined: the picture and the size that it was about, and the best so far.
    std::size_t refined_picture_ = 0;
    glm::ivec2 refined_size_{0};
    std::unique_ptr<Buffer> refined_;
    // Since something moved.
    std::size_t resting_picture_ = 0;
    glm::ivec2 resting_size_{0};
    Stopwatch since_rest_;
    static constexpr double kRestBeforeRefining = 0.4;  // s
    std::filesystem::path file_;         // as it was named; empty while nothing is open
    std::filesystem::path folder_{"."};  // whose files the browser lists
    std::filesystem::path place_;  // the same for every name of it, wherever the program stands
    bool values_known_ = false;    // the file has been shown
    // The scene that is on the screen until the file is shown, for good where it cannot be: the
    // file that it was opened by, and the look in which it was left.
    struct Left {
        std::filesystem::path place;  // as place_
        Preset look;
    };
    std::optional<Left> left_;
    // Of the sets A and B: which have values that the file lacks, and the values at which nobody
    // has worked in one: those of the file, as it is or was.
    std::array<bool, 2> worked_in_{};
    std::array<std::vector<TweakValue>, 2> at_rest_;
    std::vector<Event> recorded_;  // all that the preset is to have
    bool records_ = false;
    std::size_t written_before_ = 0;     // events of the file that go before what is recorded
    std::size_t recorded_at_start_ = 0;  // of what is recorded: they did not happen in it
    std::optional<double> start_time_;   // s; a person asked for it to be saved
    struct Overwriting {
        std::optional<Leaving> then;
    };
    std::optional<Overwriting> overwriting_;  // the question is whether to
    std::optional<Leaving> leaving_;          // once a person has said what becomes of the unsaved
    std::optional<UnsavedLook> offer_;        // the unsaved work of the last run
    std::vector<TweakSet> restored_;          // the sets that have such work, of this file
    // What the state folder holds, and since when.
    struct Kept {
        std::vector<TweakValue> values, written;  // here, in the file
        std::size_t events = 0;
        std::vector<std::string> channels;  // as TOML
        std::vector<std::string> locked, watch;
        double start_time = 0.0;  // s
        std::vector<TweakValues::Waiting> waiting;
        bool operator==(const Kept&) const = default;
    };
    std::array<std::optional<Kept>, 2> kept_;  // by set, A and B
    Stopwatch since_kept_;
    static constexpr double kKeepPeriod = 0.5;  // s; a hand that moves does not write all the time
    // What a study or a check is about: the values it began with, and whether they are still those
    // of the same text.
    struct Subject {
        std::vector<TweakValue> values;
        bool is_other_text = false;
    };
    Subject studied_, checked_;
    std::vector<EmptyChannel> empty_channels_;
    Shown shown_before_ = Shown::scene;
    glm::ivec2 finding_size_{1};  // of the picture in the view that is not the scene's

    Stopwatch since_draw_, since_open_, since_picture_kept_;
    double frame_due_ = 0.0;  // s from since_draw_
    std::size_t printed_reports_ = 0;
    std::string notice_, title_, last_reload_;
    unsigned notice_number_ = 0;
    float content_scale_ = window_.content_scale();
    bool dirty_ = true;                               // the screen is behind what it should show
    bool was_told_ = false, answered_first_ = false;  // by events since it was drawn; by panels
    bool dragging_scene_ = false, panning_ = false, pause_at_open_ = false;
    glm::dvec2 mouse_{0.0};
    std::uint32_t random_seed_ = std::random_device()();
    std::vector<int> held_keys_;

    std::vector<PassFact> passes_;
    std::vector<BrowserEntry> browser_entries_;
    std::optional<PixelFacts> pixel_facts_;
    std::vector<PixelValue> pixel_values_;
    std::vector<GridPixel> grid_;
};

}  // namespace glint
