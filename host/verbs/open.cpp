// `glint open`: the window, or where there is no display, a still.

#include "base/say.h"
#include "gl/context.h"
#include "offline/import.h"
#include "offline/still.h"
#include "verbs/options.h"
#include "verbs/verb.h"
#include "window/live/window.h"

#include <fmt/format.h>

#include <cstdlib>

namespace glint {
namespace {

bool has_display() {
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY"}) {
        const char* value = std::getenv(variable);
        if (value && *value) return true;
    }
    return false;
}

// A shader of the site is imported, as where it is dropped on the window: a person wants to work on
// it. Where that fails the window shows why.
ViewOptions shown_in_window(const ViewOptions& options) {
    if (!is_shadertoy(options.file)) return options;
    const ImportedBeside imported = import_beside(options.file);
    if (!imported.notice.empty()) say("{}\n", imported.notice);
    ViewOptions shown = options;
    if (!imported.scene.empty()) shown.file = imported.scene;
    return shown;
}

void run_open(const ViewOptions& options, const Stopwatch& since_start) {
    if (has_display()) {
        try {
            return run_window(shown_in_window(options));
        } catch (const NoContext& error) {
            say("{}\n", error.what());
        }
    }
    StillOptions still;
    still.view = options;
    still.output = options.file.stem().string() + ".png";
    say("There is no display; the picture goes to {}.\n", still.output.string());
    run_still(still, since_start);
}

void declare(CLI::App& verb, ViewOptions& options) {
    add_view(verb, options);
}

}  // namespace

std::unique_ptr<Verb> open_verb() {
    return std::make_unique<VerbWith<ViewOptions>>(declare, run_open);
}

}  // namespace glint
