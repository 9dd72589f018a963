// What a study has found: one row a value of a knob, and what the rows say together. Plain numbers,
// and the one JSON that `--json`, `--lines`, study.json and the study panel share.
#pragma once

#include "measure/rows/difference.h"

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace glint {

// Milliseconds of a frame; with settle, of all its frames.
struct Timing {
    double median = 0.0, min = 0.0, max = 0.0;
    double low = 0.0, high = 0.0;  // between which the median lies in 95 of 100 cases
};

// Each timed frame by each clock, ms; the i-th of all rows of a study were drawn in one round.
struct FrameTimes {
    std::vector<double> wall{}, gpu{}, processor{};
};

// A time beside another: what the measurement tells, and not what the medians are.
enum class TimeVerdict { faster, slower, not_told_apart };
const char* to_string(TimeVerdict verdict);  // "not told apart"

// Which of its clocks a study is told by.
enum class Clock {
    wall,       // after glFinish
    gpu,        // timer queries, where they agree with the wall in all rows
    processor,  // of all threads of this process: a software renderer on a machine that others use
};
const char* to_string(Clock clock);  // a sentence for people, which JSON has, too

// Where a row of several views is the farthest off.
struct WorstView {
    std::string view{};
    double rmse = 0.0;
};

struct StudyRow {
    bool has_error() const { return failed.empty() && error.has_value(); }

    std::string value{};                // of the knob, as a person types it
    std::optional<double> work{};       // the number; none for menus and switches. Not in JSON
    Timing wall{}, gpu{}, processor{};  // JSON has the medians alone
    FrameTimes times{};                 // Not in JSON
    // Of a frame in which every pass is drawn, by the clock on the wall; steady frames leave those
    // out in which nothing has changed.
    double all_passes_ms = 0.0;
    // To the reference; none without one. Where `failed` says something it means nothing, and JSON
    // has none.
    std::optional<Difference> error{};
    std::optional<WorstView> worst{};
    std::vector<double> apart{};   // RMSE to each row of the study; empty: not known. Not in JSON
    std::string failed{};          // why there is no picture to compare
    bool is_preset = false;        // the preset's own value
    bool is_between = false;       // as in KnobValue; not in JSON
    bool is_reference = false;     // its setting is the reference's
    bool resumed = false;          // an earlier call measured it
    std::string picture{}, map{};  // files, seen from the report; "": none
    std::string flip_map{};        // as map, of what people see
    // Judged from all rows together.
    Timing ms{};  // by the clock of the study
    std::optional<TimeVerdict>
        verdict{};                // beside the preset's own value; else beside the first row
    bool nearer = false;          // is told to have less error than the preset's own value
    bool pareto = false;          // no other row is told to be better in one, and worse in none
    bool near_reference = false;  // within ten times of the reference's own error
};

// A second way to the truth, which the scene names.
struct RivalReference {
    std::string value{};
    Difference difference{};  // of it to the reference
    double own_error = 0.0;   // RMSE, as it claims
    std::string cut{};        // as Study's; not in JSON
    bool disagrees = false;   // they differ by more than both claim
};

struct Study {
    std::string scene{}, knob{};           // a file; a tweak, or "settle"
    std::string reference{}, second{};     // values; a second one to judge the first by, or ""
    std::size_t reference_not_finite = 0;  // pixels of the reference, by which no error can be told
    // What its values reach, but for a tenth of them: what rounding is depends on it. Not in JSON.
    double reference_size = 1.0;
    // A pass of the reference, and of the second one, whose loops the driver ended early; "": none.
    std::string reference_cut{}, second_cut{};
    std::string broken_view{};  // the first of several whose reference is no truth. Not in JSON
    std::optional<Difference> reference_error{};  // of the second reference to the first
    // RMSE by which the reference claims to be off, which follows from that; 0: not known.
    double own_error = 0.0;
    std::optional<RivalReference> rival{};
    bool converges = true;             // otherwise no row is nearer to any truth
    std::vector<std::string> views{};  // names, of a study over several
    std::string renderer{}, machine{};
    glm::ivec2 size{0};
    std::string pass{};  // what is compared: "image" or a buffer
    bool time_only = false;
    Clock clock = Clock::wall;
    std::vector<StudyRow> rows{};   // in the order of values
    int look = 0;                   // as in TimeVerdicts. Not in JSON
    std::optional<double> order{};  // of the error: error ~ work^-order
    std::optional<double>
        cost_exponent{};  // ms ~ value^exponent, over the larger half of the values
    // Rows are joint settings of all quality tweaks, "a=1 b=2"; `best` is that which a budget
    // chooses.
    bool is_joint = false;
    std::optional<std::size_t> best{};
    std::vector<std::string> findings{};  // what looks wrong
    std::vector<std::string> notes{};     // what was assumed, and what was left out
    std::string reference_picture{};      // a file, seen from the report; "": none

    // The order as people are told it: none where the error does not fall.
    std::optional<double> told_order() const {
        constexpr double kFalls = 0.05;
        return order && *order >= kFalls ? order : std::nullopt;
    }

    // What is no number, or was not drawn to its end, is nobody's truth: no error is told by it.
    bool has_truth() const { return reference_not_finite == 0 && reference_cut.empty(); }

    // Otherwise the own error is not known, and null in JSON.
    bool has_own_error() const {
        return has_truth() && second_cut.empty() && reference_error &&
               reference_error->not_finite == 0;
    }

    // RMSE below which nothing can be told from the reference; 0 where that is not known.
    double reference_rmse() const {
        return rival && rival->disagrees ? rival->difference.rmse : own_error;
    }
};

// What is infinite or not a number is null in JSON; read back, that is an infinite PSNR, and 0 of
// any other figure. Reading throws nlohmann::json::exception for what is no study.
nlohmann::ordered_json to_json(const Study& study);
Study study_from_json(const nlohmann::ordered_json& json);

nlohmann::ordered_json to_json(const Difference& difference);
Difference difference_from_json(const nlohmann::ordered_json& json);

}  // namespace glint
