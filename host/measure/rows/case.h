// One case of a check: what came of the extreme that a scene was brought to. Plain facts, and the
// one JSON that `--json`, `--lines`, the process of a check and the check panel share.
#pragma once

#include "measure/rows/curve.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glint {

enum class CaseVerdict { fail, report, pass, skip };  // worst first
const char* to_string(CaseVerdict verdict);

// The operation that a failure came from.
struct CasePlace {
    std::string file{};
    int line = 0;
    std::string function{}, expression{}, what{};
    std::vector<double> operands{};
};

struct CaseResult {
    std::string name{};
    CaseVerdict verdict = CaseVerdict::pass;
    // Pixels of all buffers and of the picture, in the frame where the first were found.
    std::size_t nan = 0, infinite = 0;
    float min = 0.0f, max = 0.0f;          // of all finite values in all frames
    std::string note{};                    // why, in words; ""
    std::string reproduce{};               // the command that shows it again; failures only
    std::string picture{};                 // a file; failures only
    std::optional<CasePlace> where{};      // of failures, where it is known
    std::vector<InvariantCurve> curves{};  // of what the text promises; "long run" only
    std::string diagram{};                 // a file with them

    std::size_t not_finite() const { return nan + infinite; }
    void fail(std::string why);
};

// Whether `a` stands above `b`: failures first, and among them those with the most that is not
// finite.
bool is_worse(const CaseResult& a, const CaseResult& b);

// Reading throws nlohmann::json::exception for what is no case.
nlohmann::ordered_json to_json(const CaseResult& result);
CaseResult case_from_json(const nlohmann::ordered_json& json);

}  // namespace glint
