#include "glsl/finding.h"
#include "glsl/loop_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace glint {
namespace {

// llvmpipe's, of all loops of a pixel together (Mesa 22.3, LP_MAX_TGSI_LOOP_ITERATIONS).
constexpr double kBudget = 65535.0;
constexpr int kDeepestCall = 500;  // functions that call each other; deeper ones count as nothing

class LongLoopFinder {
public:
    LongLoopFinder(const Reading& reading,
                   const std::unordered_map<std::string_view, double>& known)
        : reading_(reading),
          constants_(reading, known),
          bounds_(reading.statements.size()),
          turns_(reading.statements.size()),
          long_within_(reading.statements.size()),
          of_function_(reading.functions.size()),
          calls_in_(reading.functions.size()) {
        for (std::uint32_t i = 0; i < reading.calls.size(); ++i)
            if (reading.calls[i].function != kNone)
                calls_in_[reading.calls[i].function].push_back(i);
        for (std::uint32_t i = 0; i < reading.functions.size(); ++i)
            if (reading.functions[i].first_statement != kNone)
                defined_[{reading.word(reading.functions[i].name),
                          reading.functions[i].parameters.size()}]
                    .push_back(i);
    }

    std::vector<Finding> find(const std::vector<bool>& wanted) {
        std::vector<Finding> findings;
        for (std::uint32_t i = 0; i < reading_.functions.size(); ++i) {
            const std::uint32_t first = reading_.functions[i].first_statement;
            if (!wanted[i] || first == kNone) continue;
            turns_of(i, 0);
            for (std::uint32_t at = first; at < reading_.statements[first].next; ++at)
                if (is_loop(reading_.statements[at].kind)) look_at(at, findings);
        }
        return findings;
    }

private:
    void look_at(std::uint32_t loop, std::vector<Finding>& findings) const {
        const std::size_t at = reading_.place(reading_.statements[loop].tokens.begin).begin;
        if (bounds_[loop].kind == LoopBound::Kind::none)
            findings.push_back({"loop-without-bound",
                                at,
                                "nothing that can be read here ends this loop, and llvmpipe ends "
                                "all loops of a pixel without a word after 65,535 turns: count its "
                                "turns",
                                {}});
        if (turns_[loop] < kBudget || long_within_[loop]) return;
        const double count = turns_[loop];
        const std::string turns = count == kEndless ? "endlessly many"
                                  : count < 1e9     ? fmt::format("{:.0f}", count)
                                                    : fmt::format("{:.1e}", count);
        findings.push_back(
            {"long-loop",
             at,
             fmt::format(
                 "this loop may take {} turns, with those that it holds and calls; llvmpipe "
                 "ends all loops of a pixel without a word after 65,535: share the work "
                 "out over passes, samples or frames",
                 turns),
             {}});
    }

    // The innermost statement of a function in which a token stands.
    std::uint32_t statement_of(const Function& function, std::uint32_t token) const {
        const auto begin = reading_.statements.begin() + function.first_statement;
        const auto end =
            reading_.statements.begin() + reading_.statements[function.first_statement].next;
        auto after = std::upper_bound(begin, end, token, [](std::uint32_t at, const Statement& s) {
            return at < s.tokens.begin;
        });
        auto at = static_cast<std::uint32_t>(after - reading_.statements.begin()) - 1;
        while (reading_.statements[at].tokens.end <= token &&
               reading_.statements[at].parent != kNone)
            at = reading_.statements[at].parent;
        return at;
    }

    double turns_of(std::uint32_t index, int depth) {
        if (of_function_[index]) return *of_function_[index];
        of_function_[index] = 0.0;  // one that calls itself is no GLSL
        if (depth > kDeepestCall) return 0.0;
        const Function& function = reading_.functions[index];
        for (const std::uint32_t call : calls_in_[index]) {
            const Call& one = reading_.calls[call];
            double most = 0.0;
            const auto callees = defined_.find({reading_.word(one.name), one.arity});
            if (callees != defined_.end())
                for (const std::uint32_t callee : callees->second)
                    most = std::max(most, turns_of(callee, depth + 1));
            const std::uint32_t at = statement_of(function, one.name);
            turns_[at] += most;
            if (most >= kBudget) long_within_[at] = true;
        }
        const std::uint32_t first = function.first_statement;
        for (std::uint32_t at = reading_.statements[first].next; at-- > first;) {
            const Statement& statement = reading_.statements[at];
            const bool is_long_within = long_within_[at];
            if (is_loop(statement.kind)) {
                bounds_[at] = loop_bound(reading_, constants_, at);
                const bool is_known = bounds_[at].kind == LoopBound::Kind::number;
                turns_[at] = (is_known ? bounds_[at].turns : 1.0) * (1.0 + turns_[at]);
            }
            if (at == first) break;
            turns_[statement.parent] += turns_[at];
            if (is_long_within || (is_loop(statement.kind) && turns_[at] >= kBudget))
                long_within_[statement.parent] = true;
        }
        return *(of_function_[index] = turns_[first]);
    }

    const Reading& reading_;
    Constants constants_;
    std::vector<LoopBound> bounds_;  // by statement
    std::vector<double> turns_;      // by statement, of all loops in it and in what it calls
    std::vector<bool> long_within_;  // by statement: a loop within is too long by itself
    std::vector<std::optional<double>> of_function_;
    std::vector<std::vector<std::uint32_t>> calls_in_;  // by function
    std::map<std::pair<std::string_view, std::size_t>, std::vector<std::uint32_t>> defined_;
};

}  // namespace

std::vector<Finding> find_long_loops(const Reading& reading, const std::vector<bool>& wanted,
                                     const std::unordered_map<std::string_view, double>& known) {
    return LongLoopFinder(reading, known).find(wanted);
}

}  // namespace glint
