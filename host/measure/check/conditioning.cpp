// How far the picture moves when one input moves by the smallest amount that a float can: told, not
// judged, since an edge may flip by a rounding.
#include "base/temporary_file.h"
#include "measure/check/case.h"
#include "measure/probe/probe.h"
#include "measure/rows/difference.h"
#include "measure/rows/heat.h"
#include "offline/picture_file.h"

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
// From this share on there is a picture of where.
constexpr double kWorthAMap = 0.005;

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
        : subject_(subject), time_(subject.shown_time(subject.opened().time, kNudgedPlayed)) {
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
    // Where the middles of pixels lie; of a long text only where there is time for its program.
    void move_pixels(const Effort& effort) {
        if (!subject_.is_short() && !effort.tries) return;
        Renderer& renderer = subject_.renderer();
        const Playback playback{.end = time_};
        const Frame frame = playback.frame(subject_.preset, playback.last_frame());
        try {
            Probe probe(subject_.opened(), kImagePass, {.specialise = subject_.specialised()},
                        {.kind = ProbeKind::rounding, .only = {{0, 0}}});
            std::vector<float> usual, now;
            const auto put = [](const std::vector<ProbeCell>& cells, std::vector<float>& picture) {
                for (const ProbeCell& cell : cells)
                    picture.insert(picture.end(), cell.colour.begin(), cell.colour.end());
            };
            draw(0.0);
            renderer.before_pass = [&](std::size_t index) {
                if (index != probe.index_in(renderer)) return;
                put(probe.rounded(renderer, frame, Probe::kNoSite, 1), usual);
                put(probe.rounded(renderer, frame, Probe::kPixelsMoved, 1), now);
            };
            renderer.redraw();
            subject_.draw_blindly(frame);
            renderer.before_pass = nullptr;
            add("the place of pixels", usual, now);
        } catch (const ProbeRefused&) {  // the other inputs are told
        }
    }
    // How far each pixel went at most, a step of colour a decade.
    std::vector<std::byte> map() const {
        std::vector<float> off(usual_);
        for (std::size_t i = 0; i < off.size(); ++i) off[i] += i % 4 == 3 ? 0.0f : most_[i / 4];
        return difference_heat(off, usual_, Values::light);
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
    void add(const std::string& what) { add(what, usual_, subject_.picture()); }
    void add(const std::string& what, const std::vector<float>& usual,
             const std::vector<float>& now) {
        ++count_;
        const Moved moved = moved_picture(what, usual, now, subject_.preset.size);
        most_.resize(usual_.size() / 4);
        for (std::size_t i = 0; i < std::min(usual.size(), now.size()); ++i)
            if (i % 4 != 3 && std::isfinite(now[i] - usual[i]))
                most_[i / 4] = std::max(most_[i / 4], std::abs(now[i] - usual[i]));
        if (moved.share > worst_.share || (moved.share == worst_.share && moved.most > worst_.most))
            worst_ = moved;
    }

    CheckSubject& subject_;
    double time_;
    std::vector<float> usual_, most_;  // the latter by pixel
    Moved worst_;
    int count_ = 0;
};

void run_conditioning(Check& check, CaseResult& result) {
    result.verdict = CaseVerdict::report;
    Mover mover(check.subject);
    mover.move_time();
    mover.move_tweaks();
    mover.move_mouse();
    mover.move_pixels(check.effort);
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
    if (worst.share < kWorthAMap) return;
    const auto file = check.folder / (case_stem(check.subject.opened(), result.name) + ".png");
    make_folder(check.folder);
    write_rgb(file, mover.map(), check.subject.preset.size);
    result.picture = file.string();
}

}  // namespace

void add_conditioning_case(std::vector<Case>& list, const CheckSubject& subject) {
    list.push_back({"one ulp", run_conditioning,
                    subject.scene().tweaks.empty() ? Case::Tweaks::none : Case::Tweaks::one});
}

}  // namespace glint
