#include "window/live/held_rate.h"

#include "base/median.h"

#include <algorithm>

namespace glint {
namespace {

// A new size has new buffers, and what changes rarely is drawn anew.
constexpr int kUnsettled = 1;
// Frames whose median counts: a program that is exchanged makes one slow frame.
constexpr std::size_t kHeard = 5, kLeast = 3;
// Of the wanted time: what a lower share aims at, and what the next share may take to be tried.
constexpr double kAim = 0.9, kRoom = 0.75;
// A step down that brings less than this was not worth it: the cost is not in the pixels.
constexpr double kWorth = 0.85;
// ... until frames take so much longer than they did then.
constexpr double kWorse = 1.5;
// Part of a frame is not in its pixels, and a busy machine looks like that. So below this part of
// the wanted time a larger share is tried even if it should be too slow by its pixels; again only
// once frames take so much less than before the last try.
constexpr double kTry = 0.6, kBetter = 0.8;
// Of the wanted time, what a scene always has: below it, fewer pixels help a large window no more.
constexpr double kLeastRoom = 0.2;
constexpr int kPatience = 12, kMostPatience = 640, kSoon = 60;  // frames

void keep_last(std::vector<double>& heard, double ms) {
    heard.push_back(ms);
    if (heard.size() > kHeard) heard.erase(heard.begin());
}

}  // namespace

void HeldRate::begin(Cost full, double last_share, double wanted_ms) {
    *this = {};
    wanted_ms_ = wanted_ms;
    expected_full_ms_ = full.scene;
    beside_ = {full.beside};
    const auto last = std::ranges::find(kShares, last_share);
    at_ = last != kShares.end() ? static_cast<std::size_t>(last - kShares.begin())
                                : place_for(full.scene);
}

// Of a frame, for the scene.
double HeldRate::room_ms() const {
    const double beside_ms = beside_.empty() ? 0.0 : median_of(beside_);
    return std::max(wanted_ms_ - beside_ms, kLeastRoom * wanted_ms_);
}

void HeldRate::want(double wanted_ms) {
    if (wanted_ms == wanted_ms_) return;
    wanted_ms_ = wanted_ms;
    lowest_ = kShares.size() - 1;
    refused_ms_ = {};
    patience_ = kPatience;
    roomy_ = 0;
}

// The largest share that holds the rate.
std::size_t HeldRate::place_for(double full_ms) const {
    std::size_t at = 0;
    while (at < lowest_ && full_ms * kShares[at] * kShares[at] > kAim * room_ms()) ++at;
    return full_ms <= room_ms() ? 0 : at;
}

double HeldRate::predicted(double ms, std::size_t at) const {
    const double ratio = kShares[at] / kShares[at_];
    return ms * ratio * ratio;
}

double HeldRate::full_ms() const {
    return heard_.empty() ? expected_full_ms_ : predicted(median_of(heard_), 0);
}

bool HeldRate::go(std::size_t to) {
    if (to == at_) return false;
    came_up_ = to < at_;
    at_ = to;
    heard_.clear();
    frames_ = roomy_ = 0;
    return true;
}

bool HeldRate::go_down(double median_ms) {
    std::size_t to = at_;
    while (to < lowest_ && (to == at_ || predicted(median_ms, to) > kAim * room_ms())) ++to;
    if (to == at_) return false;
    if (came_up_ && frames_ < kSoon) {
        patience_ = std::min(2 * patience_, kMostPatience);
        refused_ms_[came_from_] = came_from_ms_;
    }
    before_at_ = at_;
    before_ms_ = median_ms;
    return go(to);
}

// As many steps at once as are sure to have room; one to try, if none is.
std::size_t HeldRate::place_above(double median_ms) const {
    std::size_t to = at_;
    while (to > 0 && predicted(median_ms, to - 1) <= kRoom * room_ms()) --to;
    const double refused_ms = refused_ms_[at_];
    const bool may_try =
        median_ms <= kTry * room_ms() && (refused_ms == 0.0 || median_ms < kBetter * refused_ms);
    return to == at_ && at_ > 0 && may_try ? at_ - 1 : to;
}

bool HeldRate::go_up(double median_ms) {
    came_from_ = at_;
    came_from_ms_ = median_ms;
    return go(place_above(median_ms));
}

bool HeldRate::hear(Cost cost) {
    if (++frames_ <= kUnsettled) return false;
    keep_last(heard_, cost.scene);
    keep_last(beside_, cost.beside);
    if (heard_.size() < kLeast) return false;
    const double ms = median_of(heard_);
    if (ms > room_ms() && before_ms_ > 0.0 && ms > kWorth * before_ms_) {
        lowest_ms_ = before_ms_;
        before_ms_ = 0.0;
        lowest_ = before_at_;
        return go(before_at_);
    }
    before_ms_ = 0.0;
    if (ms > kWorse * lowest_ms_) lowest_ = kShares.size() - 1;
    // Slow here, too: what spoilt the step up is a busy machine, not the share.
    if (ms > kWorse * refused_ms_[at_]) refused_ms_[at_] = 0.0;
    if (ms > room_ms()) return go_down(ms);
    roomy_ = place_above(ms) < at_ ? roomy_ + 1 : 0;
    return roomy_ >= patience_ && go_up(ms);
}

}  // namespace glint
