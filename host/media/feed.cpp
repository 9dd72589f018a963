#include "media/feed.h"

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr double kAhead = 1.0;  // s of listening that are made beforehand
// Smaller differences between the device's clock and ours are caught up by playing up to 1 % faster
// or slower, which nobody hears; larger ones are jumps.
constexpr double kLargestDrift = 0.08;  // s
constexpr double kMostCorrection = 0.01;

long block_of(double position) {
    return static_cast<long>(std::floor(position / kFeedBlock));
}

}  // namespace

double SoundFeed::position(double clock) const {
    const double moved = state_.playing ? (clock - state_.at) * state_.rate : 0.0;
    return (state_.time + moved) * kSoundRate;
}

long SoundFeed::block_at(double clock) const {
    return std::max(block_of(position(clock)), 0L);
}

std::optional<long> SoundFeed::wanted_block(double clock) const {
    const double from = position(clock);
    const double ahead = state_.playing ? kAhead * std::max(state_.rate, 1.0) * kSoundRate : 0.0;
    for (long block = block_at(clock); block <= block_of(from + ahead); ++block)
        if (!blocks_.contains(block)) return block;
    return std::nullopt;
}

// What lies far from the newest is not heard soon.
void SoundFeed::add(long block, std::vector<float> pairs) {
    constexpr long kKept = 64;  // blocks
    blocks_[block] = std::move(pairs);
    std::erase_if(blocks_,
                  [&](const auto& known) { return std::abs(known.first - block) > kKept; });
}

// Between two samples; at the usual rate the position lies on one, all but for the drift.
float SoundFeed::value(double position, int channel) const {
    const auto at = [&](long index) {
        const auto block = blocks_.find(index / kFeedBlock);
        if (index < 0 || block == blocks_.end()) return 0.0f;
        return block->second[static_cast<std::size_t>(index % kFeedBlock * 2 + channel)];
    };
    const double whole = std::floor(position);
    const auto part = static_cast<float>(position - whole);
    const auto index = static_cast<long>(whole);
    return at(index) * (1.0f - part) + at(index + 1) * part;
}

void SoundFeed::fill(std::span<float> pairs, double heard_at) {
    const std::size_t count = pairs.size() / 2;
    const double target = position(heard_at), drift = (target - at_) / kSoundRate;
    const bool jumps = !sounds_ || std::abs(drift) > kLargestDrift;
    const float old_volume = sounds_ ? last_volume_ : 0.0f;
    const float new_volume = state_.playing ? state_.volume : 0.0f;
    const bool leaves = jumps || !state_.playing;  // what sounded fades out by itself
    const double from = jumps ? target : at_;
    const double correction = jumps ? 0.0 : std::clamp(drift, -kMostCorrection, kMostCorrection);
    const double step = state_.rate * (1.0 + correction);
    for (std::size_t i = 0; i < count; ++i) {
        const float part = static_cast<float>(i + 1) / static_cast<float>(count);
        const double moved = static_cast<double>(i) * step;
        const float begin = leaves ? 0.0f : old_volume;
        const float loud = begin + (new_volume - begin) * part;
        const float fading = leaves ? old_volume * (1.0f - part) : 0.0f;
        for (int channel = 0; channel < 2; ++channel) {
            float sum = 0.0f;
            if (loud > 0.0f) sum += loud * value(from + moved, channel);
            if (fading > 0.0f) sum += fading * value(at_ + moved, channel);
            pairs[2 * i + static_cast<std::size_t>(channel)] = std::clamp(sum, -1.0f, 1.0f);
        }
    }
    at_ = from + static_cast<double>(count) * step;
    last_volume_ = new_volume;
    sounds_ = state_.playing;
}

}  // namespace glint
