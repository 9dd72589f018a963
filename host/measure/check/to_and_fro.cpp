#include "measure/check/to_and_fro.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace glint {
namespace {

constexpr int kTurns = 32;
constexpr double kBack = 1e-3, kPart = 0.05;  // of a step, of the state

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

double size_of_state(const std::vector<float>& state) {
    double squares = 0.0;
    for (const float v : state) squares += static_cast<double>(v) * static_cast<double>(v);
    return std::sqrt(squares);
}

double apart(std::vector<float> a, const std::vector<float>& b) {
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) a[i] -= b[i];
    return size_of_state(a);
}

}  // namespace

bool goes_to_and_fro(CheckSubject& subject, int first, double fps) {
    std::vector<std::vector<float>> last;
    int back = 0;
    for (int k = first; k < first + kTurns; ++k) {
        if (!subject.play_frames(k, k + 1, fps)) return false;
        last.push_back(all_kept(subject));
        if (last.size() < 3) continue;
        const double gone = apart(last[1], last[2]);
        back += gone > kPart * size_of_state(last[2]) && apart(last[0], last[2]) <= kBack * gone;
        last.erase(last.begin());
    }
    return 4 * back >= 3 * kTurns;
}

}  // namespace glint
