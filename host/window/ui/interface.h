// All panels of one frame, in whichever ImGui context is current. It knows no window and no GL, so
// tests can hold the mouse themselves.
//
// Each panel is one function over Build: it reads the facts, draws, and adds to the wishes. What it
// has to remember from frame to frame is its State, which Interface owns. Lengths are points until
// Theme::px() makes them pixels. Nothing fails here; what cannot be done is drawn disabled, with
// the reason as its tip.
#pragma once

#include "window/ui/layout.h"
#include "window/ui/panels.h"

#include <imgui.h>

#include <random>

namespace glint {

// What one frame's panels share; all of it the caller's, valid until build() returns.
struct Build {
    const Facts& facts;
    const TweakValues& tweaks;
    const Transport& transport;
    PanelSettings& settings;
    Wishes& wishes;
    const Theme& theme;
    Layout& layout;
};

inline void wish(Build& build, const TweakEdit& edit) {
    build.wishes.tweaks.push_back(edit);
}

inline void wish(Build& build, const TimeEdit& edit) {
    build.wishes.time.push_back(edit);
}

// Makes one entry of the undo list of what one widget does while it is held.
class Edits {
public:
    // Wishes for a value; `index` is that of the tweak.
    void set(Build& build, std::size_t index, const TweakValue& value);
    void follow(Wishes& wishes);  // at the end of a frame: commits when the widget is let go

private:
    unsigned held_ = 0;  // ImGui's id
};

struct TweaksState {
    std::string search;
    Edits edits;
    std::string typed, typed_text;  // the tweak whose value is being typed, and what stands there
    bool typing_begins = false, is_typing = false;
    std::string hex_of, hex;    // the colour whose digits are being typed, and those
    std::string told, told_of;  // what became of a value that was typed, and of which tweak
    TweakValue told_at{};       // which it has since; said of no other
    std::string focus;          // the tweak whose control is to have the keyboard
    bool focus_first = false;   // the first that is listed
    bool searches = false;      // the field was asked for
    std::mt19937 random{std::random_device{}()};
};

struct TransportState {
    double span = 60.0;     // s, of the scrub bar; kept while it is held
    Loop loop{0.0, 10.0};   // the last that there was; comes back with the button
    bool has_loop = false;  // there has been one
    // The time that is typed, as far as it is; nothing where the field shows it.
    std::optional<std::string> typed{};
    bool typing_begins = false, is_typing = false;
};

struct DiagnosticsState {
    struct Shown {
        Diagnostic diagnostic;
        std::string source;  // the line as the file has it
    };
    std::vector<Shown> shown;
    std::string told;  // what `shown` was made of
    bool open = true;  // the list, and not its button alone
};

struct SavingState {
    std::string path;         // of save as
    bool keeps_time = false;  // the time that the bar shows is to be written
};

struct NewSceneState {
    std::string path;
    std::size_t from = 0;  // of Facts::templates
};

struct StudyState {
    std::string knob;  // to be studied; "" for all
    Edits edits;
    // The row under the mouse, in the diagram or in the table; in the frame before, and in this.
    std::optional<std::size_t> hovered, hovering;
};

struct SourceState {
    std::string watch;        // as far as it is typed
    std::string entry;        // whose head was brought into view
    std::optional<int> to{};  // a line of the text that is to be, from 0
};

void top_bar(Build& build, DiagnosticsState& diagnostics);
void tweaks_panel(Build& build, TweaksState& state);
void transport_panel(Build& build, TransportState& state);
void passes_panel(Build& build);
void browser_panel(Build& build);
void shelves(Build& build, float card_width);  // of scenes and presets; points, at least
void start_page(Build& build);                 // instead of the panels while nothing is open
void study_panel(Build& build, StudyState& state);
void check_panel(Build& build);
void source_panel(Build& build, SourceState& state);
void probe_mark(Build& build);  // on the picture: the pinned pixel
void diagnostics_panel(Build& build, DiagnosticsState& state);
void diagnostics_button(Build& build, DiagnosticsState& state);  // in the bar: how many
void help_panel(Build& build);
void dialogs(Build& build, SavingState& saving, NewSceneState& new_scene);
void error_line(Build& build);  // where the panels are hidden
void wipe_handle(Build& build);
void shown_labels(Build& build);
void start_picture(Build& build);
void ground(Build& build);  // where there is no picture
// What the first frame waits for; that a list of errors says why it does not come, where that is
// closed.
void waiting_label(Build& build, bool list_is_open);
void pixel_grid(Build& build);
void notice(Build& build, float alpha);

// The time as the bar shows it, which is how it is written: s, to the millisecond.
double shown_time(const Build& build);

// A docked panel: its heading, tools that stay, and a body that scrolls.
//     begin_panel(…); tools…; begin_body(); body…; end_panel(…);
void begin_panel(Build& build, PanelId id, const char* title, bool& open);
void begin_body();
void end_panel(Build& build, PanelId id);

// How far work beside the window has come, and what went wrong with it.
void work_line(const Theme& theme, const WorkFact& work);

class Interface {
public:
    explicit Interface(const Theme& theme) : theme_(theme) {}

    // Between ImGui's NewFrame and Render.
    Wishes build(const Facts& facts, const TweakValues& tweaks, const Transport& transport,
                 PanelSettings& settings);

    // Panels learn how large they are by being built. True while this frame was built with sizes
    // that no longer hold, and another pass would stand better.
    bool is_behind();

    // A notice fades or a tooltip is due: frames are wanted though nobody moves.
    bool is_moving() const;

    // Whether the value of a tweak is being typed.
    bool is_typing() const { return tweaks_.is_typing || transport_.is_typing; }

    void set_theme(const Theme& theme) { theme_ = theme; }
    const Layout& layout() const { return layout_; }
    Places& places() { return layout_.places; }

private:
    void panels(Build& build);
    void follow_notice(const Facts& facts);
    void follow_keys(PanelSettings& settings);

    Theme theme_;
    Layout layout_, layout_before_;
    unsigned extents_ = 0;  // a hash of where all windows stood
    TweaksState tweaks_;
    TransportState transport_;
    DiagnosticsState diagnostics_;
    SavingState saving_;
    NewSceneState new_scene_;
    StudyState study_;
    SourceState source_;
    std::string notice_;
    unsigned notice_number_ = 0;
    float notice_age_ = 1e9f;  // s
    bool is_busy_ = false;     // Esc has something to end before it gives the keyboard back
    bool keys_moved_ = false;  // to the panels, from one to another, or back to the scene
    bool had_keys_ = false;    // the panels, in the frame before
};

}  // namespace glint
