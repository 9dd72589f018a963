#include "verbs/show.h"

#include "base/say.h"
#include "base/words.h"
#include "gl/context.h"
#include "offline/examples.h"
#ifdef GLINT_WINDOW
#include "offline/import.h"
#include "window/live/window.h"
#endif

#include <errno.h>

#include <cstdlib>

namespace glint {
namespace {

namespace fs = std::filesystem;

#ifdef GLINT_WINDOW
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
    if (imported.scene.empty()) return options;
    say("{}\n", imported.notice);
    ViewOptions shown = options;
    shown.file = imported.scene;
    return shown;
}
#endif

}  // namespace

bool show_in_window([[maybe_unused]] const ViewOptions& options) {
#ifdef GLINT_WINDOW
    if (!has_display()) return false;
    try {
        run_window(shown_in_window(options));
        return true;
    } catch (const NoContext& error) {
        say("{}\n", error.what());
    }
#endif
    return false;
}

std::string own_name() {
    const fs::path name = program_invocation_name;
    if (!name.has_parent_path()) return name.string();
    std::error_code error;
    const fs::path shorter = fs::proximate(name, error);
    return error ? name.string() : shorter.string();
}

void say_first_commands(const fs::path& folder) {
    const std::string glint = own_name();
    say_result("There is no display to open a window on. Three commands to try:\n\n");
    const std::vector<fs::path> files = folder.empty() ? examples() : scenes_in(folder);
    if (!files.empty()) {
        const std::string file = fs::proximate(files.front()).string();
        say_result("  {} still {} -o picture.png --size 640x360\n", glint, shell_file(file));
    }
    std::error_code error;
    std::string free = "rings";
    for (int i = 2; fs::exists(free + ".frag", error); ++i) free = fmt::format("rings{}", i);
    say_result("  {} new {}\n", glint, free);
    if (files.empty()) say_result("  {} still {}.frag -o rings.png\n", glint, free);
    say_result("  {} --help\n", glint);
}

}  // namespace glint
