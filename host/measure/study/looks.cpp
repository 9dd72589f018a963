#include "measure/study/looks.h"

#include "base/json_text.h"
#include "base/say.h"
#include "measure/rows/flip.h"
#include "measure/study/comparison.h"
#include "measure/study/joint.h"
#include "measure/study/page.h"
#include "offline/common.h"
#include "offline/named_files.h"
#include "offline/picture_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

namespace fs = std::filesystem;

// One of the two: a picture, or a preset to draw.
struct Look {
    fs::path file;
    std::optional<ComparedPicture> picture{};
    std::optional<Preset> preset{};
};

ComparedPicture open_picture(const fs::path& file) {
    std::error_code unknown;
    if (!fs::exists(file, unknown))
        report({{Severity::error, Place{file.string()},
                 fmt::format("cannot read {}: there is no such file", in_quotes(file.string())),
                 true}});
    try {
        return read_compared_picture(file);
    } catch (const std::runtime_error& error) {
        report({{Severity::error, Place{file.string()}, error.what(), true}});
        throw;
    }
}

// All but pictures are drawn at the size of those, or at what --size says.
void open_look(Look& look, const StudyOptions& options, glm::ivec2 size) {
    ViewOptions view = options.view;
    view.file = look.file;
    view.size = fmt::format("{}x{}", size.x, size.y);
    look.preset = open_preset(view);
}

glm::ivec2 common_size(const std::array<Look, 2>& looks, const StudyOptions& options) {
    std::optional<glm::ivec2> size;
    if (!options.view.size.empty()) size = size_of(options.view, {});
    for (const Look& look : looks) {
        if (!look.picture) continue;
        if (size && *size != look.picture->size)
            throw UsageError(fmt::format(
                "{} is {}x{}, not {}x{}: pictures are compared as they "
                "are.",
                look.file.string(), look.picture->size.x, look.picture->size.y, size->x, size->y));
        size = look.picture->size;
    }
    return size.value_or(glm::ivec2(640, 360));
}

void require_report_apart(const std::array<Look, 2>& looks, const fs::path& folder) {
    std::vector<NamedFile> outputs, inputs;
    for (const char* name :
         {"a.png", "b.png", "difference.png", "flip.png", "looks.json", "index.html"})
        outputs.push_back({"-o", (folder / name).string()});
    for (const Look& look : looks) {
        if (look.picture) inputs.push_back({"a look", look.file.string()});
        if (!look.preset) continue;
        const std::vector<NamedFile> read = files_read_for(*look.preset);
        inputs.insert(inputs.end(), read.begin(), read.end());
    }
    require_apart(outputs, inputs);
    require_own_report(outputs, folder / "looks.json", "b", "<title>Glint: two looks<");
}

// What this program draws, or has drawn, beside a picture of 8 bits is what a file of these would
// keep. What others have in more bits stays as it is: it may hold light, and more than a display
// shows.
void round_as_the_other(const std::array<Look, 2>& looks, Comparison& found) {
    const auto has_bytes = [&](std::size_t i) {
        return looks[i].picture && looks[i].picture->bytes;
    };
    const auto is_drawn = [&](std::size_t i) {
        return !looks[i].picture || looks[i].picture->is_drawn;
    };
    for (const std::size_t i : {0u, 1u})
        if (is_drawn(i) && !has_bytes(i) && has_bytes(1 - i))
            round_to_bytes(found.pictures[i], found.pictures[1 - i]);
}

Values values_of(const Look& look) {
    if (!look.picture) return Values::display;
    return !look.picture->buffer.empty() ? Values::data
           : look.picture->is_light      ? Values::light
                                         : Values::display;
}

// A picture for a display beside one in light is compared in light; buffers with buffers alone.
void agree_on_values(const std::array<Look, 2>& looks, Comparison& found) {
    const Values a = values_of(looks[0]), b = values_of(looks[1]);
    if (a != b && (a == Values::data || b == Values::data)) {
        const Look& buffer = looks[a == Values::data ? 0 : 1];
        throw UsageError(
            fmt::format("{} holds the buffer {}, and no picture: compare it with "
                        "another buffer.",
                        buffer.file.string(), in_quotes(buffer.picture->buffer)));
    }
    found.values = a == b ? a : Values::light;
    for (const std::size_t i : {0u, 1u})
        if (values_of(looks[i]) != found.values) decode_display(found.pictures[i]);
}

std::size_t pixels_of_other_alpha(std::span<const float> a, std::span<const float> b) {
    std::size_t count = 0;
    for (std::size_t i = 3; i < std::min(a.size(), b.size()); i += 4)
        count += std::abs(a[i] - b[i]) > 1.0f / 255.0f;
    return count;
}

void compare_pictures(Comparison& found) {
    const auto& [a, b] = found.pictures;
    found.error = difference(a, b, found.values);
    found.seen = flip_map(a, b, found.size, {.values = found.values});
    found.error.flip = mean_where_finite(found.seen, b);
    const std::size_t worst = worst_pixel(a, b, found.values);
    const auto width = static_cast<std::size_t>(found.size.x);
    found.worst = {static_cast<int>(worst % width),
                   found.size.y - 1 - static_cast<int>(worst / width)};
    for (std::size_t i = 0; i < 2; ++i) {
        const float* numbers = &found.pictures[i][worst * 4];
        found.at_worst[i] = {numbers[0], numbers[1], numbers[2], numbers[3]};
    }
}

// Draws what is to be drawn; and times it where both are.
void draw(const std::array<Look, 2>& looks, const StudyOptions& options, Comparison& found) {
    const bool any = looks[0].preset || looks[1].preset;
    const auto context = any ? make_egl_context(options.view.device) : nullptr;
    if (any) {
        found.renderer = context->renderer();
        found.machine = machine_name();
    }
    std::array<std::optional<MeasuredScene>, 2> scenes;  // gone before the context
    for (std::size_t i = 0; i < 2; ++i) {
        const Look& look = looks[i];
        if (look.picture) {
            found.pictures[i] = look.picture->rgba;
            continue;
        }
        scenes[i].emplace(*look.preset,
                          Setting{.values = look.preset->values, .settle = look.preset->settle},
                          *context, MeasureOptions{.specialise = options.view.specialise});
        found.pictures[i] = scenes[i]->draw_picture();
    }
    if (scenes[0] && scenes[1])
        found.times = time_pair(*scenes[0], *scenes[1],
                                {.least = options.frames,
                                 .seconds = options.seconds,
                                 .on_software = context->is_software()});
}

}  // namespace

bool compares_looks(const StudyOptions& options) {
    const bool two = options.files.size() == 2;
    const bool names_knobs = !options.vary.empty() || !options.reference.empty() ||
                             !options.second.empty() || options.time_only || options.each ||
                             limit_of(options) || !options.over.empty();
    if (std::ranges::any_of(options.files, is_picture_file)) {
        if (!two || names_knobs || options.pass != "image")
            throw UsageError(
                "A picture has no tweaks to study; compare it with one other look: "
                "glint study A B.");
        return true;
    }
    if (two && !names_knobs && options.pass != "image")
        throw UsageError(fmt::format(
            "--pass {0}: of two looks the pictures are compared. Write the buffer of each with "
            "glint still FILE --pass {0} -o FILE.exr and compare these, or study the tweaks of "
            "both, by that buffer, with --each.",
            options.pass));
    return two && !names_knobs;
}

void run_looks(const StudyOptions& options) {
    if (options.csv || options.lines)
        throw UsageError("--csv and --lines tell of rows; of two looks --json tells.");
    if (is_preset(options.output))
        throw UsageError("-o of two looks is a folder; a preset is written for a budget.");
    const bool turns = !options.view.tweaks.empty() || !options.view.quality.empty();
    if (turns && std::ranges::all_of(options.files, is_picture_file))
        throw UsageError("Pictures have no tweaks: leave out --tweak and --quality.");
    std::array<Look, 2> looks = {Look{options.files[0]}, Look{options.files[1]}};
    for (Look& look : looks)
        if (is_picture_file(look.file)) look.picture = open_picture(look.file);
    Comparison found{.files = {looks[0].file.string(), looks[1].file.string()},
                     .size = common_size(looks, options)};
    for (Look& look : looks)
        if (!look.picture) open_look(look, options, found.size);
    require_folder(options.output);
    if (!options.output.empty()) require_report_apart(looks, options.output);
    draw(looks, options, found);
    round_as_the_other(looks, found);
    agree_on_values(looks, found);
    compare_pictures(found);
    if (looks[0].picture && looks[1].picture && found.values != Values::data)
        found.alpha_off = pixels_of_other_alpha(found.pictures[0], found.pictures[1]);
    if (!options.output.empty()) write_comparison(options.output, found);
    if (options.view.json)
        say_result("{}\n", json_text(to_json(found)));
    else
        say_result("{}", to_table(found));
}

}  // namespace glint
