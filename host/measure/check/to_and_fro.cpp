#include "measure/check/to_and_fro.h"

#include "measure/check/poison.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace glint {
namespace {

// Of a step: what is followed may move on a little. Of the state.
constexpr double kBack = 0.05, kPart = 0.05;

// One output of what is fed back.
struct Plane {
    std::size_t pass, output;
    std::size_t width;          // pixels
    std::vector<float> values;  // RGBA
};
using Planes = std::vector<Plane>;

Planes planes_of(const CheckSubject& subject) {
    Planes planes;
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!subject.is_fed_back(i)) continue;
        const auto outputs = output_names(subject.scene(), passes[i].pass).size();
        const auto width = static_cast<std::size_t>(subject.renderer().buffer(i).shape().size.x);
        for (std::size_t output = 0; output < outputs; ++output)
            planes.push_back({i, output, width, subject.renderer().read_buffer(i, output)});
    }
    return planes;
}

std::vector<float> all_kept(const CheckSubject& subject) {
    std::vector<float> all;
    for (const Plane& plane : planes_of(subject))
        all.insert(all.end(), plane.values.begin(), plane.values.end());
    return all;
}

double moved(const Planes& a, const Planes& b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double off = distance(a[i].values, b[i].values);
        squares += off * off;
    }
    return std::sqrt(squares);
}

// How neighbours move, beside each other or above: 1 alike, -1 one up where the other goes down.
double alike(const Planes& a, const Planes& b) {
    double products[2] = {0.0, 0.0}, squares[2] = {1e-30, 1e-30};
    for (std::size_t plane = 0; plane < a.size(); ++plane) {
        const std::vector<float>&from = a[plane].values, &to = b[plane].values;
        const std::size_t row = 4 * a[plane].width;
        const auto off = [&](std::size_t i) { return static_cast<double>(to[i] - from[i]); };
        for (std::size_t i = 0; i < from.size(); ++i) {
            for (const int side : {0, 1}) {
                const std::size_t next = i + (side == 0 ? 4 : row);
                if (next >= from.size() || (side == 0 && i % row >= row - 4)) continue;
                products[side] += off(i) * off(next);
                squares[side] += 0.5 * (off(i) * off(i) + off(next) * off(next));
            }
        }
    }
    return std::min(products[0] / squares[0], products[1] / squares[1]);
}

// What lies between two states, and a little beside it: in the very middle it might rest.
void put_between(const CheckSubject& subject, const Planes& a, const Planes& b) {
    std::mt19937 random(1);
    for (std::size_t plane = 0; plane < a.size(); ++plane) {
        std::vector<float> values = a[plane].values;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const float way = b[plane].values[i] - values[i];
            const auto beside = static_cast<float>(static_cast<int>(random() % 2001) - 1000);
            values[i] += (0.5f + 1e-6f * beside) * way;
        }
        put_values(subject, a[plane].pass, a[plane].output, values);
    }
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

bool grows_to_a_chessboard(CheckSubject& subject, int first, double fps) {
    constexpr int kGrown = 400;                   // steps
    constexpr double kOpposed = -0.5;             // most of them are
    constexpr double kLittle = 0.2, kMost = 0.5;  // of how far they go to and fro
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i)
        if (subject.is_fed_back(i) && subject.renderer().buffer(i).shape().cube) return false;
    Planes before = planes_of(subject);
    if (!subject.play_frames(first, first + 1, fps)) return false;
    Planes after = planes_of(subject);
    const double whole = moved(before, after);
    if (alike(before, after) > kOpposed) return false;
    put_between(subject, before, after);
    before = planes_of(subject);
    for (int k = 1; k < kGrown; ++k) {
        if (!subject.play_frames(first + k, first + k + 1, fps)) return false;
        after = planes_of(subject);
        const double now = moved(before, after);
        if (k == 1 && now > kLittle * whole) return false;
        if (now >= kMost * whole) return alike(before, after) <= kOpposed;
        before = std::move(after);
    }
    return false;
}

}  // namespace glint
