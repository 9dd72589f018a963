#include "window/probe/batches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace glint {
namespace {

constexpr double kUnknown = -1.0;

Span line_of(std::string_view text, std::size_t at) {
    const std::size_t before = at == 0 ? text.npos : text.rfind('\n', at - 1);
    const std::size_t end = text.find('\n', at);
    return {before == text.npos ? 0 : before + 1, end == text.npos ? text.size() : end + 1};
}

double copies_at(const Reading& reading, const std::vector<double>& copies, std::size_t at) {
    for (std::size_t f = 0; f < reading.functions.size(); ++f) {
        const Span place = reading.place(reading.functions[f].tokens);
        if (reading.functions[f].is_defined() && place.begin <= at && at < place.end)
            return std::max(copies[f], 1.0);
    }
    return 1.0;
}

}  // namespace

std::vector<double> copies_in(const Reading& reading, std::string_view entry) {
    std::vector<std::vector<std::uint32_t>> callers(reading.functions.size());
    for (const Call& call : reading.calls)
        for (const std::uint32_t f : reading.functions_named(reading.word(call.name)))
            if (call.function != kNone && reading.functions[f].parameters.size() == call.arity)
                callers[f].push_back(call.function);
    std::vector<double> copies(reading.functions.size(), kUnknown);
    const std::function<double(std::uint32_t)> count = [&](std::uint32_t f) {
        if (copies[f] != kUnknown) return copies[f];
        copies[f] = 0.0;  // GLSL knows no recursion; a broken text ends here
        double sum = reading.word(reading.functions[f].name) == entry ? 1.0 : 0.0;
        for (const std::uint32_t caller : callers[f]) sum += count(caller);
        return copies[f] = sum;
    };
    for (std::uint32_t f = 0; f < copies.size(); ++f) count(f);
    return copies;
}

std::vector<ProbeBatch> batches_of(const Reading& reading, std::string_view text,
                                   const std::vector<ProbeSite>& sites,
                                   const std::vector<double>& copies, Span asked, double most) {
    std::map<std::size_t, double> weights;  // by where the line begins
    for (const ProbeSite& site : sites)
        weights[line_of(text, site.at).begin] += copies_at(reading, copies, site.at);
    std::vector<std::pair<std::size_t, double>> lines(weights.begin(), weights.end());
    const auto middle = static_cast<double>(asked.begin + asked.end) / 2.0;
    std::ranges::stable_sort(lines, {}, [&](const auto& line) {
        return std::abs(static_cast<double>(line.first) - middle);
    });
    std::vector<ProbeBatch> batches;
    double sum = 0.0;
    for (const auto& [begin, weight] : lines) {
        if (batches.empty() || sum + weight > most) batches.emplace_back(), sum = 0.0;
        batches.back().push_back(line_of(text, begin));
        sum += weight;
    }
    return batches;
}

}  // namespace glint
