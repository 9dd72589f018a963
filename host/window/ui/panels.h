// The Dear ImGui panels over the picture. They show plain facts and hand back wishes; what the
// wishes mean is the window's business.
//
// Who owns what: facts are the window's, and stand until update() returns; tweaks have their one
// owner, TweakValues, and time has its own, which is asked; settings are edited by both. Nothing
// here fails: a wish that cannot be granted becomes a notice, or a diagnostic, of a later frame.
//
// Positions are pixels of the framebuffer, y up; sizes of panels are points, which the scale of the
// screen makes pixels; times are seconds, costs milliseconds.
#pragma once

#include "glsl/raw_text.h"
#include "measure/rows/case.h"
#include "measure/rows/study.h"
#include "scene/scene.h"
#include "scene/transport.h"
#include "scene/tweak_values.h"
#include "window/ui/findings.h"
#include "window/ui/fonts.h"
#include "window/ui/probe_facts.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct GLFWwindow;

namespace glint {

// A scene or preset in the browser. `thumbnail` is a GL texture, 16:9, 0 until it is there.
struct BrowserEntry {
    std::filesystem::path file;
    std::string title;
    std::string shelf;  // the heading it stands under; "" is its scene's name
    std::uint32_t thumbnail = 0;
    std::filesystem::path scene;  // of a preset, under which it stands; "" is guessed by name
};

// One pass as the list of passes shows it.
struct PassFact {
    std::string name, entry;           // of its first sampler; its function
    glm::ivec2 size{0};                // pixels of its buffer
    std::vector<std::string> outputs;  // samplers, in the order of the function's `out` parameters
    std::string runs;                  // "every frame", "on change", "every step"
    double ms = 0.0;                   // when it was drawn last; 0 while passes are not measured
    bool drawn = false;                // in the last frame; "skipped" otherwise
};

// What the pass viewer found in the output that it shows.
struct PixelFacts {
    std::size_t nan = 0, infinite = 0;               // pixels with such a component
    glm::vec4 min{0.0f}, max{0.0f};                  // of the finite ones, by component
    std::array<std::array<int, 64>, 4> histogram{};  // pixels; 64 bins from min to max, RGBA
};

// One value under the mouse.
struct PixelValue {
    std::string sampler;    // whose buffer it is
    glm::ivec2 pixel{0};    // of that buffer, y up
    glm::vec4 value{0.0f};  // RGBA, as it holds it
};

// A magnified pixel that has its value printed on it.
struct GridPixel {
    glm::dvec2 centre{0.0};  // pixels of the window, y up
    double side = 0.0;       // pixels of the window; small ones are left without numbers
    glm::vec4 value{0.0f};   // what the buffer holds
    glm::vec4 shown{0.0f};   // what the screen shows, 0 to 1: the ink is its opposite
};

// How the pass viewer shows a buffer; edited by the panel, drawn by the window.
struct PassView {
    std::string sampler;    // "" or "image" for the picture
    int channel = 0;        // 0 rgb, 1 red, 2 green, 3 blue, 4 alpha
    float exposure = 0.0f;  // stops: the value times 2 to this power is shown
    bool tone_curve = false;
    bool mark_not_finite = true;
    glm::dvec2 centre{0.5};  // fraction of the buffer in the middle
    double zoom = 0.0;       // screen pixels a buffer pixel; 0 fits
    bool inspect = false;    // counts, histogram and the pixel inspector are wanted
};

// A channel that the scene reads and nothing fills, and what a click fills it with.
struct EmptyChannel {
    struct Offer {
        std::string label;  // "noise", "wood.png", or a buffer's name
        Sampler filler;     // of the channel's name
    };
    std::string name;  // "iChannel0"
    std::vector<Offer> offers;
};

// What has to be answered before anything else is done.
enum class Question {
    none,
    leave,      // what is not saved would be lost: save, discard, or cancel
    restore,    // the last run left work that it had not saved: restore, or discard
    overwrite,  // the file says by now what nobody here has read: save, or cancel
};

// The picture that stands for a scene until it draws, in the lower left of a GL texture; 0: none.
struct StartPictureFact {
    std::uint32_t texture = 0;
    glm::vec2 share{0.0f};              // of the texture that is the picture
    glm::dvec2 origin{0.0}, size{0.0};  // pixels of the window, y up
};

// What the panels need to know for one frame. What is pointed at is the window's.
struct Facts {
    const Scene* scene = nullptr;  // null while nothing is open
    std::string title;             // of the scene or preset
    std::filesystem::path file;    // what is open, a preset (.toml) or a scene; "" if nothing
    bool unsaved = false, loading = false, specialised = false;
    std::string why_no_save, why_no_revert;  // whole sentences; "" while there is something to do
    std::optional<double> start_time;        // s; what the next save writes instead of the file's
    double replayed = 1.0;                   // fraction of a replay that is under way
    bool simulates = false;                  // a jump of time plays the scene again
    std::span<const double> kept_states;     // s, ascending: from where it can be played again
    double replay_rate = 0.0;  // scene seconds in a second of a replay; 0 while not known
    // What the first frame of the file waits for, and for how long by now; "" once it is there, and
    // where none comes.
    std::string waits_for;
    double waited = 0.0;         // s
    bool shows_picture = false;  // the scene, or a picture that stands for it until it draws
    StartPictureFact start_picture;
    std::span<const Diagnostic> diagnostics;
    std::span<const EmptyChannel> empty_channels;
    std::string last_reload;  // one line
    Instant instant;
    double frame_ms = 0.0;                     // of the last frame that was drawn
    std::string renderer;                      // the driver's name
    glm::ivec2 picture_size{0}, full_size{0};  // pixels; what is drawn, and what would be
    double full_ms = 0.0;                      // that a frame of the full size would take, roughly
    bool resolution_is_fixed = false;          // chosen before the first frame: its buffers keep it
    int refined = 0, refined_of = 0;           // samples of a picture that stands still
    glm::ivec2 frame_size{0};  // whose aspect the picture keeps; 0x0 fills the window
    std::span<const PassFact> passes;
    std::optional<PixelFacts> pixel_facts;
    std::span<const PixelValue> pixel_values;
    std::span<const GridPixel> grid;  // those in view, when the zoom is far enough for numbers
    std::span<const BrowserEntry> browser;
    std::filesystem::path folder;                 // where a new scene would go
    std::span<const std::string_view> templates;  // what it may begin with
    WorkFact study_work, check_work;
    std::span<const Study> studies;
    std::span<const CaseResult> cases;  // worst first
    ProbeFact probe;
    bool recording = false;
    bool has_sound = false;
    std::string why_silent;  // a cause; "" while the sound can be heard
    Question question = Question::none;
    // A short message such as "christmas.png written", and its number. It fades by itself; the next
    // shows anew, with the same words, too.
    std::string notice;
    unsigned notice_number = 0;
};

// To a Question, as it lists them.
enum class Answer { save, discard, cancel, restore };

struct NewScene {
    std::filesystem::path file;  // ends in .frag; was free when it was asked for
    std::string from;            // of Facts::templates
};

// Where a preset starts from its next save on.
struct StartTime {
    std::optional<double> seconds;  // as the bar shows it; none leaves what the file says
};

// What a person asked for in one frame.
struct Wishes {
    std::optional<std::filesystem::path> open, save_as;
    std::optional<NewScene> new_scene;
    bool save = false, revert = false;
    std::optional<StartTime> start_time;  // before anything is saved
    bool still = false;
    bool toggle_recording = false;
    bool toggle_full_screen = false;
    std::vector<TweakEdit> tweaks;   // in this order
    std::vector<TimeEdit> time;      // in this order
    bool tweaks_changed = false;     // what was wished of them has changed a value or the shown set
    std::optional<Diagnostic> edit;  // open the editor at this place
    std::optional<Sampler> fill;     // the channel of this name
    std::optional<std::string> study;  // run one of this knob; "" for all
    std::optional<Answer> answer;      // to Facts::question
    bool cancel_study = false;
    bool check = false, cancel_check = false;
    bool quit = false;
    std::optional<Span> lines;                      // of the scene's text: those in view
    std::optional<std::vector<std::string>> watch;  // from now on
    std::vector<std::filesystem::path> seen;        // of Facts::browser: those in view
};

// Edited by panels and window alike; kept while the program runs.
struct PanelSettings {
    bool visible = true;  // Tab hides all
    bool tweaks = true, transport = true, passes = false, browser = false, help = false;
    bool study = false, check = false, source = false;
    ProbeView probe;
    bool keys = false;       // the panels have the keyboard, and the scene has not
    int next_panel = 0;      // give it to the next one (1), or to the one before (-1); becomes 0
    bool search = false;     // give it to the search of tweaks; becomes false
    bool save_as = false;    // ask for the path; the panels answer with Wishes::save_as
    bool new_scene = false;  // ask for its name; answered with Wishes::new_scene
    PassView view;
    bool free_aspect = false;       // the picture fills the window, whatever Facts::frame_size
    float resolution_scale = 1.0f;  // 0.25 to 2
    bool hold_frame_rate = true;    // lower the resolution to hold this rate
    float frame_rate = 20.0f;       // Hz
    bool refine = true;             // what stands still
    bool muted = false;
    float volume = 1.0f;  // 0 to 1
    bool wipe = false;    // the tweak set that is shown left of a line, the other right of it
    float wipe_position = 0.5f;            // fraction of the width; also of the wipe of a study
    Shown shown = Shown::scene;            // what stands in the view
    std::size_t shown_study = 0;           // of Facts::studies
    std::optional<std::size_t> shown_row;  // of that study, to be compared
    std::string shown_case;                // the chosen one of Facts::cases
};

class Panels {
public:
    // The window outlives the panels, and its GL context is current whenever they are called.
    // Places are remembered in `memory` (an .ini file); "" remembers nothing, nor does one that
    // cannot be written. Fonts of another scale are drawn anew.
    Panels(GLFWwindow* window, float content_scale, const std::filesystem::path& memory,
           Fonts fonts);
    ~Panels();
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;

    // The window went to a screen of another scale: pixels a point, 1 to 4.
    void rescale(float content_scale);

    // Builds the frame's panels. What they wish of the tweaks is done to `tweaks` at once, since
    // the same frame shows it, and told as Wishes::tweaks_changed. What they wish of time is shown
    // at once, too, and told as Wishes::time: `transport` is its owner's.
    Wishes update(const Facts& facts, TweakValues& tweaks, const Transport& transport,
                  PanelSettings& settings);

    // Draws what update() built over the framebuffer that is bound.
    void draw();

    // Draws a dot, so that the driver makes code of what panels are drawn with: to be called where
    // nobody waits for it, before the first update().
    void compile();

    // A press or release since the last update(), at a place in pixels of the framebuffer, y up,
    // with Ctrl held or not. A slow scene leaves seconds between two frames: clicks count where
    // they happened.
    void mouse_button(glm::dvec2 position, int button, bool down, bool control);

    // Likewise a key of GLFW, pressed (or repeated) or released, and a character that was typed.
    void key(int code, bool down);
    void character(unsigned code);

    // Whether the panels take what the mouse or the keyboard does now, as of the last update(). The
    // keyboard is the scene's until PanelSettings::keys, a field or a popup has it.
    bool takes_mouse() const;
    bool takes_keyboard() const;

    // Whether a press at this place, in pixels of the framebuffer, y up, is theirs. The mouse may
    // have come there since the last frame.
    bool takes_mouse_at(glm::dvec2 position) const;

    // Whether a text field holds the keyboard.
    bool takes_text() const;

    // Whether that is the value of a tweak; its field is let go, and the next update() takes the
    // value.
    bool is_typing() const;
    void end_typing();

    // Frames that are still wanted after an input until everything stands still.
    bool is_settling() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace glint
