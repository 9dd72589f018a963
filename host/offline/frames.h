// Which frames of a sequence are wanted. However many they are, none is listed.
#pragma once

#include <cstdint>
#include <string>

namespace glint {

// First, first + step, and so on.
struct Frames {
    std::int64_t first = 0, step = 1, count = 0;

    int operator[](std::int64_t i) const { return static_cast<int>(first + i * step); }
    int last() const { return count > 0 ? (*this)[count - 1] : 0; }
};

// Those of "A:B" or "A:B:STEP", both ends included, or of the first ten seconds; with a shard "K/N"
// every N-th of them from the K-th on. Throws UsageError.
Frames frames_of(const std::string& text, const std::string& shard, double fps);

}  // namespace glint
