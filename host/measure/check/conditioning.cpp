// How far the picture moves when one input moves by the smallest amount that a float can: told, not
// judged, since an edge may flip by a rounding.
#include "measure/check/case.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glint {
namespace {

constexpr double kNudgedPlayed = 0.5;  // s of a simulation
// Beyond this share of pixels it is no edge: what is computed has lost its digits.
constexpr double kMostPixels = 0.05;

double next_float(double value) {
    return static_cast<double>(
        std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity()));
}

struct Moved {
    std::string what;
    double share = 0.0, most = 0.0;  // of pixels off by more than 1/255; the largest difference
    glm::ivec2 pixel{0};
};

Moved moved_picture(const std::string& what, const std::vector<float>& usual,
                    const std::vector<float>& now, glm::ivec2 size) {
    Moved moved{.what = what, .share = difference(now, usual).share_off};
    for (std::size_t i = 0; i < std::min(usual.size(), now.size()); ++i) {
        const double off = std::abs(std::clamp(static_cast<double>(usual[i]), 0.0, 1.0) -
                                    std::clamp(static_cast<double>(now[i]), 0.0, 1.0));
        if (i % 4 == 3 || !(off > moved.most)) continue;
        moved.most = off;
        const auto at = static_cast<int>(i / 4);
        moved.pixel = {at % size.x, at / size.x};
    }
    return moved;
}

class Mover {
public:
    explicit Mover(CheckSubject& subject)
        : subject_(subject),
          time_(subject.stateful() ? std::min(subject.opened().time, kNudgedPlayed)
                                   : subject.opened().time) {
        draw(0.0);
        usual_ = subject.picture();
    }

    void move_time() {
        // Half an ulp would round back; frames of a simulation stay where they are.
        if (!subject_.moves() || subject_.stateful()) return;
        draw(next_float(time_) - static_cast<double>(static_cast<float>(time_)));
        add("iTime");
    }
    void move_tweaks() {
        const auto& tweaks = subject_.scene().tweaks;
        for (std::size_t i = 0; i < tweaks.size(); ++i) {
            const TweakType type = tweaks[i].type;
            if (type == TweakType::int1 || type == TweakType::bool1) continue;
            const TweakValue old = subject_.preset.values[i];
            for (double& component : subject_.preset.values[i]) component = next_float(component);
            draw(0.0);
            add(tweaks[i].name);
            subject_.preset.values[i] = old;
        }
    }
    void move_mouse() {
        if (!subject_.renderer().reads_mouse()) return;
        const auto events = subject_.preset.events;
        const auto at = [&](double x) {
            subject_.preset.events = {{.time = 0.0, .down = true, .mouse = glm::dvec2(x)}};
            draw(0.0);
            return subject_.picture();
        };
        const std::vector<float> usual = std::exchange(usual_, at(0.37));
        at(0.37 * (1.0 + 0x1p-23));
        add("iMouse");
        usual_ = usual;
        subject_.preset.events = events;
    }
    const Moved& worst() const { return worst_; }
    int count() const { return count_; }

private:
    void draw(double later) {
        if (subject_.stateful()) subject_.renderer().reset();
        const Playback playback{.end = time_};
        const int last = playback.last_frame();
        for (int k = subject_.stateful() ? 0 : last; k <= last; ++k) {
            Frame frame = playback.frame(subject_.preset, k);
            frame.time += later;
            if (!subject_.draw(frame)) return;
        }
    }
    void add(const std::string& what) {
        ++count_;
        const Moved moved = moved_picture(what, usual_, subject_.picture(), subject_.preset.size);
        if (moved.share > worst_.share || (moved.share == worst_.share && moved.most > worst_.most))
            worst_ = moved;
    }

    CheckSubject& subject_;
    double time_;
    std::vector<float> usual_;
    Moved worst_;
    int count_ = 0;
};

void run_conditioning(Check& check, CaseResult& result) {
    result.verdict = CaseVerdict::report;
    Mover mover(check.subject);
    mover.move_time();
    mover.move_tweaks();
    mover.move_mouse();
    const Moved& worst = mover.worst();
    if (worst.most == 0.0) {
        result.note = fmt::format("{} inputs moved by one ulp, no pixel moves", mover.count());
        return;
    }
    result.note = fmt::format(
        "{} moved by one ulp moves {:.2f} % of pixels by more than 1/255, pixel {},{} by {:.2g}{}",
        worst.what, 100.0 * worst.share, worst.pixel.x, worst.pixel.y, worst.most,
        worst.share > kMostPixels ? "; float itself is at fault here, more work mends nothing"
                                  : "");
}

}  // namespace

void add_conditioning_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (subject.moves() || !subject.scene().tweaks.empty() || subject.renderer().reads_mouse())
        list.push_back({"one ulp", run_conditioning,
                        subject.scene().tweaks.empty() ? Case::Tweaks::none : Case::Tweaks::one});
}

}  // namespace glint
