#include "measure/check/case.h"

#include "base/stopwatch.h"
#include "base/temporary_file.h"
#include "base/words.h"
#include "measure/check/budget.h"
#include "measure/check/curves.h"
#include "measure/probe/faults.h"
#include "scene/preset_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace glint {
namespace {

namespace fs = std::filesystem;

std::string shell_tweaks(const ViewOptions& view) {
    std::string words;
    for (const std::string& word : tweak_words(view)) words += " " + shell_word(word);
    return words;
}

std::string device_words(const ViewOptions& view) {
    return view.device.empty() ? "" : " --device " + shell_word(view.device);
}

// What the command line said about tweaks, then what the case changed.
std::string shell_tweaks(const CheckSubject& subject) {
    std::string words = shell_tweaks(subject.view());
    for (std::size_t i = 0; i < subject.preset.values.size(); ++i) {
        if (subject.preset.values[i] == subject.opened().values[i]) continue;
        const Tweak& tweak = subject.scene().tweaks[i];
        words += " --tweak " +
                 shell_word(tweak.name + "=" + format_value(tweak, subject.preset.values[i]));
    }
    return words;
}

// Mouse, keys and date come from a preset; one that has those of the case is written beside the
// picture.
fs::path file_with_events(const CheckSubject& subject, const fs::path& folder,
                          const std::string& stem) {
    const fs::path file = folder / (stem + ".toml");
    const PresetText written = write_preset(subject.preset, file);
    if (!written.text) throw std::runtime_error(to_string(written.diagnostics.front()));
    write_whole_file(cleared(file), std::as_bytes(std::span(*written.text)));
    return file;
}

bool same_events(const std::vector<Event>& a, const std::vector<Event>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Event& x, const Event& y) {
        return x.time == y.time && x.key == y.key && x.down == y.down && x.mouse == y.mouse;
    });
}

// The command that shows the frame again. A still cannot put NaN into a buffer or let a clock
// jump: then it is the check itself that is called for this one case.
std::string command_for(const CheckSubject& subject, const CaseResult& result,
                        const fs::path& folder) {
    const glm::ivec2 size = subject.preset.size;
    if (!subject.still) return command_for_case(subject.view(), result.name);
    const std::string stem = case_stem(subject.opened(), result.name);
    const bool own_events = !same_events(subject.preset.events, subject.opened().events) ||
                            subject.preset.date != subject.opened().date;
    const fs::path file =
        own_events ? file_with_events(subject, folder, stem) : subject.opened().file;
    const std::string output =
        subject.observed().found.empty() ? "image" : subject.observed().found.back().output;
    return fmt::format(
        "glint still {} --size {}x{} --time {}{}{}{}{}{} -o {}", shell_file(file.string()), size.x,
        size.y, format_number(subject.still->time),
        subject.still->fps == 60.0 ? "" : " --fps " + format_number(subject.still->fps),
        own_events ? "" : shell_tweaks(subject), device_words(subject.view()),
        subject.specialised() ? "" : " --no-specialise",
        output == "image" ? "" : " --pass " + output,
        shell_file((folder / (stem + ".exr")).string()));
}

// "NaN and Inf in 36 pixels of smoke, 104 of image".
std::string describe(const Observed& seen) {
    std::string text = seen.infinite == 0 ? "NaN" : seen.nan == 0 ? "Inf" : "NaN and Inf";
    text += " in";
    for (const Observed::Found& found : seen.found) {
        const bool first = &found == &seen.found.front();
        text += fmt::format("{} {}{} of {}", first ? "" : ",", found.pixels, first ? " pixels" : "",
                            found.output);
    }
    return text;
}

// Values as a display shows them, and in magenta what is not finite.
void write_picture(const CheckSubject& subject, const fs::path& file) {
    const Observed& seen = subject.observed();
    const bool finite = seen.is_finite();
    const std::vector<float> values = finite ? subject.picture() : seen.values;
    Image image{.size = finite ? subject.preset.size : seen.size, .channels = 3, .pixels = {}};
    image.pixels.reserve(values.size() / 4 * 3);
    const auto push = [&](float v) {
        image.pixels.push_back(
            static_cast<std::byte>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f)));
    };
    for (std::size_t i = 0; i + 3 < values.size(); i += 4) {
        bool shown = true;
        for (std::size_t c = 0; c < (finite ? 3u : 4u); ++c) shown &= std::isfinite(values[i + c]);
        push(shown ? values[i] : 1.0f);
        push(shown ? values[i + 1] : 0.0f);
        push(shown ? values[i + 2] : 1.0f);
    }
    make_folder(file.parent_path());
    write_image(cleared(file), image);
}

// What buffers promise and what they did stands beside the pictures, held or broken.
void write_curves(const Check& check, CaseResult& result) {
    const std::string svg = svg_curves(result.curves);
    if (svg.empty()) return;
    const fs::path file = check.folder / (case_stem(check.subject.opened(), result.name) + ".svg");
    try {
        make_folder(check.folder);
        write_whole_file(cleared(file), std::as_bytes(std::span(svg)));
        result.diagram = file.string();
    } catch (const std::runtime_error& error) {  // the verdict stands all the same
        result.note += fmt::format("; no diagram: {}", error.what());
    }
}

// Where the first value was born that is not finite, of a frame that a still can show again.
void find_birthplace(CheckSubject& subject, CaseResult& result) {
    constexpr double kMostMs = 5000.0;
    const Stopwatch clock;
    const StillPlace at = *subject.still;
    const Playback playback{.end = at.time, .fps = at.fps};
    const bool stateful = subject.stateful();
    try {
        FaultWatch watch(subject.opened(), subject.renderer(),
                         {.specialise = subject.specialised()});
        watch.after_program = subject.after_frame;  // compiling is no hang
        if (stateful) subject.renderer().reset();
        for (int k = stateful ? 0 : playback.last_frame();
             k <= playback.last_frame() && !watch.is_seen(); ++k) {
            const Frame frame = playback.frame(subject.preset, k);
            watch.begin(frame);
            subject.renderer().redraw_all();
            subject.draw_blindly(frame);
            if (stateful && clock.ms() > kMostMs) return;
        }
        if (!watch.first()) return;
        result.where = place_of(*watch.first());
        result.note += "; born at " + sentence_of(*watch.first());
    } catch (const ProbeRefused&) {  // the case has failed all the same
    }
}

void run_in_its_seconds(Check& check, const Case& wanted, CaseResult& result) {
    const CaseLimit limit(check, wanted);
    try {
        wanted.run(check, result);
    } catch (const CaseIsOver& over) {
        if (result.verdict == CaseVerdict::fail || !check.subject.observed().is_finite()) return;
        result.verdict = CaseVerdict::skip;
        result.note = fmt::format(
            "left out: its frames took {:.1f} s, its share of --seconds; longer ones reach it",
            over.seconds);
    }
}

}  // namespace

bool is_another_look(const CheckSubject& subject, CaseResult& result) {
    if (subject.view().tweaks.empty()) return false;
    result.verdict = CaseVerdict::skip;
    result.note = "left out: --tweak makes it another look";
    return true;
}

CasePlace place_of(const ProbeFault& fault) {
    return {fault.file, fault.line, fault.function, fault.expression, fault.what, fault.operands};
}

std::string case_stem(const Preset& preset, const std::string& name) {
    std::string stem = preset.file.stem().string() + "-";
    for (const char c : name) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.';
        if (plain || stem.back() != '-') stem += plain ? c : '-';
    }
    return stem.substr(0, 120);
}

std::string command_for_case(const ViewOptions& view, const std::string& name) {
    const std::string size = view.size.empty() ? "" : " --size " + view.size;
    return fmt::format("glint check {}{}{}{} --case {}", shell_file(view.file.string()), size,
                       shell_tweaks(view), device_words(view), shell_word(name));
}

std::vector<Case> all_cases(const CheckSubject& subject, const Effort& effort) {
    std::vector<Case> list;
    std::size_t group = 0, begin = 0;
    const auto end_group = [&] {
        for (; begin < list.size(); ++begin) list[begin].group = group;
        ++group;
    };
    add_expected_picture_case(list, subject);
    add_expected_time_case(list, subject);
    end_group();
    add_size_cases(list);
    add_mouse_cases(list, subject);
    add_key_case(list, subject);
    end_group();
    add_tweak_cases(list, subject);
    end_group();
    add_loop_case(list, subject);  // which tells why the frames of others take long
    end_group();
    add_age_cases(list, subject);
    end_group();
    add_poison_cases(list, subject, effort);
    add_other_cases(list, subject);
    add_halves_case(list, subject);
    add_unset_case(list, subject);
    add_assertion_case(list, subject);
    add_sound_case(list, subject);
    end_group();
    add_step_cases(list, subject);
    add_frame_rate_case(list, subject);
    add_flash_case(list, subject);
    end_group();
    add_long_case(list, subject);
    end_group();
    add_search_case(list, subject);
    add_worst_case(list, subject);
    end_group();
    add_healing_cases(list, subject, effort);
    add_endurance_cases(list, subject);
    end_group();
    add_conditioning_case(list, subject);
    end_group();
    add_rounding_case(list);
    end_group();
    add_stiffness_cases(list, subject);
    end_group();
    add_random_cases(list, subject, effort);
    end_group();
    return list;
}

CaseResult run_case(Check& check, const Case& wanted) {
    CheckSubject& subject = check.subject;
    subject.restore();
    CaseResult result{.name = wanted.name};
    run_in_its_seconds(check, wanted, result);
    const Observed& seen = subject.observed();
    result.nan += seen.nan;  // those of a sound are there
    result.infinite += seen.infinite;
    result.min = seen.min;
    result.max = seen.max;
    if (!seen.is_finite()) {
        result.fail(describe(seen) + (result.note.empty() ? "" : "; " + result.note));
    }
    judge_overflow(check, result);
    write_curves(check, result);
    if (result.verdict != CaseVerdict::fail) return result;
    result.reproduce = command_for_case(subject.view(), result.name);
    if (!wanted.shows) return result;
    try {
        const fs::path picture = check.folder / (case_stem(subject.opened(), result.name) + ".png");
        write_picture(subject, picture);
        result.picture = picture.string();
        result.reproduce = command_for(subject, result, check.folder);
        // One is enough of those that follow each other.
        if (!seen.is_finite() && !result.where && subject.still && check.birthplaces > 0) {
            check.birthplaces -= subject.is_short() ? 1 : check.birthplaces;
            find_birthplace(subject, result);
        }
    } catch (const std::runtime_error& error) {  // the case has failed all the same
        result.note += fmt::format("; no picture: {}", error.what());
    }
    return result;
}

}  // namespace glint
