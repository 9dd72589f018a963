// The cases of a check: the extremes that a scene is brought to, and who draws and judges them.
#pragma once

#include "measure/check/options.h"
#include "measure/check/subject.h"
#include "measure/rows/case.h"
#include "measure/rows/probe.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// How a scene moves at an age: see age.cpp.
struct Motion {
    double moving = 0.0;         // share of frames at 60 Hz that differ from the one before
    double finely_moving = 0.0;  // of frames 1/960 s apart
    double unevenness = 0.0;     // of the change from frame to frame
    double mean = 0.0;           // change of a frame at 60 Hz, root mean square over the picture
    double frame = 0.0, fine_frame = 0.0;  // one of those, as a share
    double often = 1.0;                    // share of moments at which it moves at all
};

// What a simulation has come to at a time, drawn at 60 Hz.
struct State {
    std::vector<float> picture;
    std::vector<std::vector<float>> buffers{};  // of the passes with a step of their own
    float largest = 0.0f;                       // of all that is fed back
};

// A scene under check, and what several cases need and one works out.
struct Check {
    CheckSubject& subject;
    Effort effort;
    Stopwatch begun{};               // with the first of its cases
    double pace = 1.0;               // 0.1 to 1, less for a scene whose frames take long
    std::filesystem::path folder{};  // for pictures of failures; made when there is one
    int birthplaces = 3;  // how many failures may still be led back to the operation they came from
    std::optional<Motion> young{};         // of the preset
    std::optional<bool> rests{};           // whether the motion of the preset is over after an hour
    std::optional<float> usual_largest{};  // of what is fed back, over some hundred frames
    std::optional<State> early{}, later{}, whole{};  // after 0.35, 0.93 and 1 s
    std::unique_ptr<CheckSubject> wide{};            // with all floats of buffers of 32 bits

    // How many frames to draw where a quick scene gets so many.
    int paced(int frames, int least) const {
        return std::max(least, static_cast<int>(frames * pace));
    }
};

struct Case {
    std::string name;  // for people and for --case; no two of a scene are the same
    // Draws and judges; what is not finite is found by the subject and needs no words here.
    std::function<void(Check&, CaseResult&)> run;
    // What it changes of the tweaks, for which the subject has to be fed with uniforms.
    enum class Tweaks { none, one, all, random } tweaks = Tweaks::none;
    bool shows = true;         // a picture of what it drew tells something
    std::size_t group = 0;     // cases of a group share the seconds that it may take
    bool ends_itself = false;  // looks at the clock after each frame: no limit may cut it short
};

// In the order in which they run. Which cases there are depends on the scene alone.
std::vector<Case> all_cases(const CheckSubject& subject, const Effort& effort);

// The parts of that list, one function a group.
void add_expected_picture_case(std::vector<Case>& list, const CheckSubject& subject);
void add_expected_time_case(std::vector<Case>& list, const CheckSubject& subject);
void add_age_cases(std::vector<Case>& list, const CheckSubject& subject);
void add_tweak_cases(std::vector<Case>& list, const CheckSubject& subject);
void add_random_cases(std::vector<Case>& list, const CheckSubject& subject, const Effort& effort);
void add_size_cases(std::vector<Case>& list);
void add_mouse_cases(std::vector<Case>& list, const CheckSubject& subject);
void add_step_cases(std::vector<Case>& list, const CheckSubject& subject);
void add_poison_cases(std::vector<Case>& list, const CheckSubject& subject, const Effort& effort);
void add_unset_case(std::vector<Case>& list, const CheckSubject& subject);
void add_assertion_case(std::vector<Case>& list, const CheckSubject& subject);
void add_endurance_cases(std::vector<Case>& list, const CheckSubject& subject);
void add_healing_cases(std::vector<Case>& list, const CheckSubject& subject, const Effort& effort);
void add_frame_rate_case(std::vector<Case>& list, const CheckSubject& subject);
void add_flash_case(std::vector<Case>& list, const CheckSubject& subject);
void add_stiffness_cases(std::vector<Case>& list, const CheckSubject& subject);
void add_conditioning_case(std::vector<Case>& list, const CheckSubject& subject);
void add_rounding_case(std::vector<Case>& list);
void add_sound_case(std::vector<Case>& list, const CheckSubject& subject);
void add_loop_case(std::vector<Case>& list, const CheckSubject& subject);
void add_key_case(std::vector<Case>& list, const CheckSubject& subject);
void add_search_case(std::vector<Case>& list, const CheckSubject& subject);
void add_worst_case(std::vector<Case>& list, const CheckSubject& subject);
void add_long_case(std::vector<Case>& list, const CheckSubject& subject);
void add_other_cases(std::vector<Case>& list, const CheckSubject& subject);
void add_halves_case(std::vector<Case>& list, const CheckSubject& subject);

// Whether --tweak makes it another look than its file's; then the case is left out, and says so.
bool is_another_look(const CheckSubject& subject, CaseResult& result);

CasePlace place_of(const ProbeFault& fault);

// The scene with floats of 32 bits in all its buffers, at the tweaks, events, date and size of now;
// as it was opened otherwise.
CheckSubject& wide_of(Check& check);

// Fails where a buffer of 16-bit floats is to hold more than they can, which the driver at hand may
// hide: what the case drew last is drawn again with floats of 32 bits.
void judge_overflow(Check& check, CaseResult& result);

// "random tweaks 7" of "christmas.toml" as "christmas-random-tweaks-7": its pictures' names.
std::string case_stem(const Preset& preset, const std::string& name);

// Calls for this one case of a file again.
std::string command_for_case(const ViewOptions& view, const std::string& name);

// Runs one case on a subject that is as it was opened, and leaves its traces: the numbers, and for
// a failure a picture in the folder and the command that shows it again.
CaseResult run_case(Check& check, const Case& wanted);

}  // namespace glint
