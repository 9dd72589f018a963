// `glint open`: the window, or where there is no display, a still.

#include "base/numbered_name.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "base/terminal.h"
#include "offline/examples.h"
#include "offline/import.h"
#include "offline/still.h"
#include "verbs/options.h"
#include "verbs/show.h"
#include "verbs/verb.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace glint {
namespace {

// Such a PNG says so before its pixels.
bool is_drawn_unasked(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false;
    std::string head(256, '\0');
    std::ifstream(file, std::ios::binary)
        .read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.starts_with("\x89PNG") && head.find(kUnasked) != head.npos;
}

// One that may not be read would look as if nothing were in it.
void require_listable(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::directory_iterator(folder, error);
    if (!error) return;
    say_error(fmt::format("Cannot read {}: {}.", folder.string(), error.message()));
    throw Stop(ExitCode::missing_file);
}

void run_open(const ViewOptions& options, const Stopwatch& since_start) {
    std::error_code error;
    const bool browses =
        options.file.empty() ||
        (std::filesystem::is_directory(options.file, error) && !is_shadertoy(options.file));
    // A window that waits for a file to appear would keep silent about a name that was mistyped.
    if (!browses && !std::filesystem::exists(options.file, error)) open_preset(options);
    if (browses && !options.file.empty()) require_listable(options.file);
    if (show_in_window(options)) return;
    if (browses) return say_first_commands(options.file);
    StillOptions still;
    still.view = options;
    // Nobody named it, so of what is there only a picture goes that nobody named either.
    still.unasked = true;
    still.output = options.file.stem().string() + ".png";
    if (is_taken(still.output) && !is_drawn_unasked(still.output))
        still.output = free_picture_name(options.file);
    // Nothing is promised before what is wrong with it is told.
    ReadPreset read = read_preset(options.file);
    if (read.preset) lay_over(*read.preset, options);
    if (read.preset) say("There is no display; the picture goes to {}.\n", still.output.string());
    run_still(still, since_start);
}

void declare(CLI::App& verb, ViewOptions& options) {
    add_view(verb, options);
    verb.get_option("file")->required(false)->description(
        "a preset (.toml), a scene (.frag), a Shadertoy (.json), or a folder to "
        "choose from; the browser otherwise");
    add_examples(verb,
                 {"glint presets/christmas.toml", "glint presets", "glint",
                  "glint open presets/sea.toml --size 1280x720 --tweak reflections=screen-space"});
}

}  // namespace

std::unique_ptr<Verb> open_verb() {
    return make_verb<ViewOptions>(declare, run_open);
}

}  // namespace glint
