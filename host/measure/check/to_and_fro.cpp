#include "measure/check/to_and_fro.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace glint {
namespace {

constexpr int kTurns = 32;
// Of a step: what is followed may move on a little. Of the state.
constexpr double kBack = 0.05, kPart = 0.05;

std::vector<float> all_kept(const CheckSubject& subject) {
    std::vector<float> all;
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!subject.is_fed_back(i)) continue;
        const auto outputs = output_names(subject.scene(), passes[i].pass).size();
        for (std::size_t output = 0; output < outputs; ++output) {
            const std::vector<float> values = subject.renderer().read_buffer(i, output);
            all.insert(all.end(), values.begin(), values.end());
        }
    }
    return all;
}

}  // namespace

double distance(const std::vector<float>& a, const std::vector<float>& b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double off =
            static_cast<double>(a[i]) - (i < b.size() ? static_cast<double>(b[i]) : 0.0);
        squares += off * off;
    }
    return std::sqrt(squares);
}

bool goes_to_and_fro(CheckSubject& subject, int first, double fps) {
    std::vector<std::vector<float>> last;
    int back = 0;
    for (int k = first; k < first + kTurns; ++k) {
        if (!subject.play_frames(k, k + 1, fps)) return false;
        last.push_back(all_kept(subject));
        if (last.size() < 3) continue;
        const double gone = distance(last[1], last[2]);
        back += gone > kPart * distance(last[2], {}) && distance(last[0], last[2]) <= kBack * gone;
        last.erase(last.begin());
    }
    return 4 * back >= 3 * kTurns;
}

}  // namespace glint
