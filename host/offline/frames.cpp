#include "offline/frames.h"

#include "offline/common.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <vector>

namespace glint {
namespace {

// The whole numbers of a text such as "10:20:2"; empty when it is not made of them.
std::vector<int> numbers_in(const std::string& text, char separator) {
    std::vector<int> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (;;) {
        const auto [rest, error] = std::from_chars(at, end, numbers.emplace_back());
        if (error != std::errc()) return {};
        if (rest == end) return numbers;
        if (*rest != separator) return {};
        at = rest + 1;
    }
}

struct Share {
    int number = 1, count = 1;
};

Share share_of(const std::string& text) {
    if (text.empty()) return {};
    const std::vector<int> numbers = numbers_in(text, '/');
    if (numbers.size() != 2 || numbers[0] < 1 || numbers[0] > numbers[1]) {
        throw UsageError(fmt::format("--shard {}: write K/N with K from 1 to N, as in 2/7.", text));
    }
    return {numbers[0], numbers[1]};
}

constexpr int kLastFrame = 1 << 30;  // as `still` takes them

}  // namespace

Frames frames_of(const std::string& text, const std::string& shard, double fps) {
    std::vector<int> range = {0, std::max(static_cast<int>(fps * 10.0) - 1, 0), 1};
    if (!text.empty()) {
        range = numbers_in(text, ':');
        if (range.size() == 2) range.push_back(1);
        if (range.size() != 3 || range[0] < 0 || range[1] < range[0] || range[1] > kLastFrame ||
            range[2] < 1) {
            throw UsageError(fmt::format(
                "--frames {}: write FIRST:LAST or FIRST:LAST:STEP, as in 0:299, the last "
                "one not before the first; frames end at {}.",
                text, kLastFrame));
        }
    }
    const Share share = share_of(shard);
    const std::int64_t all = (range[1] - range[0]) / range[2] + 1;
    return {.first = range[0] + (share.number - std::int64_t{1}) * range[2],
            .step = std::int64_t{range[2]} * share.count,
            .count = (all - share.number + share.count) / share.count};
}

}  // namespace glint
