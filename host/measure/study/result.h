// What a study has found: rows, and what they say together.
#pragma once

#include "measure/study/plan.h"
#include "render/difference.h"

#include <nlohmann/json.hpp>

#include <span>

namespace glint {

struct Timing {
    double median = 0.0, min = 0.0, max = 0.0;  // ms a frame; with settle, of all frames
};

// Which of its clocks a study is told by.
enum class Clock {
    wall,       // after glFinish
    gpu,        // timer queries, where they agree with the wall in all rows
    processor,  // of all threads of this process: a software renderer on a machine that others use
};
const char* to_string(Clock clock);

struct StudyRow {
    std::string value{};
    std::optional<double> work{};
    Timing wall{}, gpu{}, processor{};
    // Of a frame in which every pass is drawn, by the clock on the wall; steady frames leave those
    // out in which nothing has changed.
    double all_passes_ms = 0.0;
    std::optional<Difference> error{};  // none without a reference
    // To the row before, in the order of values: do the values converge, wherever to?
    std::optional<double> rmse_to_previous{};
    std::string failed{};     // why there is no picture to compare
    bool is_preset = false;   // the preset's own value
    bool is_between = false;  // as in KnobValue
    // Judged afterwards.
    bool is_reference = false;
    bool pareto = false;           // no other row is both faster and nearer
    bool near_reference = false;   // within ten times of the reference's own error
    bool resumed = false;          // an earlier call measured it
    std::string picture{}, map{};  // files, seen from the report
};

struct Study {
    std::string scene{}, knob{}, reference{}, second{};
    std::optional<Difference> reference_error{};  // of the second reference to the first
    std::string renderer{}, machine{};
    glm::ivec2 size{0};
    std::string pass{};
    bool time_only = false;
    Clock clock = Clock::wall;
    std::vector<StudyRow> rows{};
    std::optional<double> order{};  // of the error: error ~ work^-order
    std::optional<double>
        cost_exponent{};                  // ms ~ value^exponent, over the larger half of the values
    std::vector<std::string> findings{};  // what looks wrong
    std::vector<std::string> notes{};     // what was assumed, and what was left out
    std::string reference_picture{};      // a file, seen from the report

    const Timing& timing(const StudyRow& row) const {
        return clock == Clock::wall ? row.wall : clock == Clock::gpu ? row.gpu : row.processor;
    }
};

// Fills in what is judged afterwards. `more_is_better` and values as planned.
void judge(Study& study, bool more_is_better, bool on_software);

// Slope of log y over log x by least squares; nothing for fewer than two points.
std::optional<double> log_slope(std::span<const double> x, std::span<const double> y);

nlohmann::ordered_json to_json(const Study& study);
nlohmann::ordered_json to_json(const Difference& difference);
std::string to_table(const Study& study);
std::string csv_header();
std::string to_csv(const Study& study);

// Numbers as reports write them.
std::string three_digits(double value);

}  // namespace glint
