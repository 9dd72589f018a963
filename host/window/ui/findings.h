// What a study and a check have found so far, for their panels.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// Work that another process does for the window.
struct WorkFact {
    bool running = false;
    long done = 0, of = 0;  // pictures or cases; `of` is 0 until it is known
    std::string problem{};  // why it has found nothing, or not all
    bool stale = false;     // the scene or its tweaks have changed since it began
};

// One value of a knob, as a study has measured it. Times are milliseconds a frame; errors are of
// values from 0 to 1, as in docs/study-and-check.md.
struct RowFact {
    std::string value{};                          // as it is written behind --tweak
    double ms = 0.0, ms_min = 0.0, ms_max = 0.0;  // the median, and the least and the most
    std::optional<double> rmse{};  // to the reference; none where there is no picture to compare
    double max = 0.0, psnr = 0.0, share_off = 0.0;  // psnr: dB, infinite for equal pictures
    bool is_reference = false, pareto = false;      // pareto: no row is both faster and better
    bool near_reference = false;                    // within ten times of the reference's own error
    std::string failed{};                           // why there is no picture
};

// A knob with its rows, in the order of its values.
struct StudyFact {
    std::string knob{};  // a tweak, or "settle"
    std::string reference{};
    std::optional<double> reference_error{};  // RMSE of the reference itself
    std::optional<double> order{};            // error ~ work^-order
    std::string clock{};
    std::vector<RowFact> rows{};
    std::vector<std::string> findings{};  // what looks wrong
};

// One case of a check.
struct CaseFact {
    enum class Verdict { fail, report, pass, skip };  // worst first
    std::string name{};
    Verdict verdict = Verdict::pass;
    std::size_t not_finite = 0;  // pixels
    std::string note{};
    std::string reproduce{};  // the command that shows it again; failures only
    bool has_picture = false;
};

// What stands in the view: the scene itself, or a picture that a study or a check has left.
enum class Shown { scene, wipe, map, failure };

}  // namespace glint
