// What a study renders: knobs, their values, and the references that count as the truth.
#pragma once

#include "measure/study/options.h"
#include "measure/study/scene_facts.h"
#include "scene/preset.h"

#include <optional>
#include <string>
#include <vector>

namespace glint {

// How one pass keeps what it fills, instead of what the scene says.
struct BufferFormat {
    std::size_t pass = 0;  // of the scene
    PixelFormat format = PixelFormat::rgba32f;
    bool operator==(const BufferFormat&) const = default;
};

// Everything that is turned between two pictures of a study.
struct Setting {
    std::vector<TweakValue> values;  // one for each tweak of the scene
    int settle = 0;                  // frames with time held
    std::optional<BufferFormat> format{};
    bool operator==(const Setting&) const = default;
};

// One value of a knob, with all that a picture of it follows from.
struct KnobValue {
    std::string text{};            // as a person types it
    std::optional<double> work{};  // the number; none for menus and switches
    Setting setting{};
    // The preset's own value, which is studied as well: it may lie close to a value of the list, so
    // that nothing follows from how alike their pictures are.
    bool is_between = false;
    // Tweaks that an option or the scene names beside the knob's own, be it with the value that the
    // preset has.
    std::vector<std::size_t> named{};
};

// What the error of a picture that counts as the truth follows from, beside a second one.
struct SecondWork {
    enum class Kind {
        another,  // another way to the truth
        seed,     // the same work with other random numbers
        more,     // the same way with more work, which may share its samples
        share,    // the error has been measured to be this share of the difference
    };
    Kind kind = Kind::another;
    double ratio = 2.0;  // more: how many times the work, less than 1 where it is less; the share
};

constexpr SecondWork kTwiceTheWork{SecondWork::Kind::more, 2.0};

// What counts as the truth as well, by another way, and what it is measured by itself.
struct Rival {
    KnobValue value{};
    std::optional<KnobValue> second{};
    SecondWork work{};
    std::optional<KnobValue> more{};  // as in Knob
    std::optional<KnobValue> less{};  // than the lesser of both, by as much
};

// What is turned while everything else stays as the preset has it.
struct Knob {
    std::string name{};               // of a tweak, "settle", or "waves.format"
    std::vector<KnobValue> values{};  // as they are drawn: from the least, or as they were named
    KnobValue reference{};            // counts as the truth; may lie beyond the values
    // To measure the reference by: more work, a second seed, another method.
    std::optional<KnobValue> second{};
    SecondWork second_work{};
    bool names_second = false;  // --second does
    // Twice the work, to measure it by where another seed changes no pixel: a method that knows no
    // chance would seem to have no error.
    std::optional<KnobValue> more{};
    std::optional<Rival> rival{};
    // Whether a larger number is nearer to the reference.
    bool more_is_better = true;
    // References are drawn with these tweaks alone as constants; none: with all.
    std::optional<std::vector<std::size_t>> constants{};
    std::vector<std::string> notes{};  // what had to be assumed
};

struct StudyPlan {
    std::vector<Knob> knobs;            // in the order in which they are studied
    std::vector<std::string> left_out;  // what is not studied, and why
};

// Every quality tweak with its own values and the preset's, then settle; or what the options name,
// in that order. Throws UsageError for what they name and the scene has not. `facts` are only
// asked.
StudyPlan plan_study(const Preset& preset, const SceneFacts& facts, const StudyOptions& options);

// Why there is nothing to study, and what there is to do about it.
std::string nothing_to_study(const Preset& preset, const StudyPlan& plan);

}  // namespace glint
