// The worst of what is no fault by itself: the largest jump from a frame to the next, a pixel, row
// or column that stands out, and how far the picture is from its reference, by the same search. It
// is told alone: a spring at its stiffest may well flash, and no search can know what was meant.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/flicker.h"
#include "measure/check/lines.h"
#include "measure/check/space.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace glint {
namespace {

constexpr int kLookedAt = 48;         // points of one effort
constexpr double kWorstShare = 0.05;  // of the seconds
constexpr int kWorstFrames = 8;       // of a simulation, at each point
constexpr double kDull = 0.02;        // less is not worth a word

// Mean over all pixels and colours of how far a frame is from the next.
double jump(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (i % 4 != 3) sum += std::abs(shown(a[i]) - shown(b[i]));
    return sum / std::max(1.0, 0.75 * static_cast<double>(a.size()));
}

// How far one pixel stands out from its neighbours on all sides, or, if that is more, the mean of a
// row or column from those beside it.
double oddity(const std::vector<float>& picture, glm::ivec2 size) {
    const auto at = [&](int x, int y, int c) {
        return shown(picture[static_cast<std::size_t>((y * size.x + x) * 4 + c)]);
    };
    double most = 0.0;
    for (int y = 1; y + 1 < size.y; ++y)
        for (int x = 1; x + 1 < size.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const double value = at(x, y, c);
                double out = 1.0;
                for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}})
                    out =
                        std::min(out, beyond(at(x - dx, y - dy, c), value, at(x + dx, y + dy, c)));
                most = std::max(most, out);
            }
    for (const int axis : {0, 1}) most = std::max(most, lone_line(picture, size, axis));
    return most;
}

class WorstJudge {
public:
    explicit WorstJudge(Check& check) : subject_(check.subject), space_(check.subject) {}
    const Space& space() const { return space_; }

    struct Found {
        double most = 0.0;
        Point at{};
    };
    enum What : std::size_t { of_frames, of_pixels, of_reference };
    const Found& worst(What what) const { return worst_[what]; }

    Trial operator()(const Point& point) {
        Trial trial;
        const double time = draw(point, false);
        const std::vector<float> before = subject_.picture();
        if (!draw_next(time)) return trial;
        const std::vector<float> now = subject_.picture();
        std::array<double, 3> found = {jump(before, now), oddity(before, subject_.preset.size),
                                       0.0};
        if (has_reference()) {
            draw(point, true);
            found[of_reference] = difference(before, subject_.picture()).share_off;
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            trial.distances.push_back(static_cast<float>(1.0 - 0.99 * std::min(found[i], 1.0)));
            if (found[i] > worst_[i].most) worst_[i] = {found[i], point};
        }
        return trial;
    }

    // The subject as it is at a point; gives the time.
    double bring_to(const Point& point) {
        subject_.restore();
        return space_.apply(point, subject_);
    }

private:
    bool has_reference() const {
        return std::ranges::any_of(subject_.scene().tweaks,
                                   [](const Tweak& tweak) { return tweak.reference.has_value(); });
    }
    double draw(const Point& point, bool as_reference) {
        const double time = bring_to(point);
        const auto& tweaks = subject_.scene().tweaks;
        for (std::size_t i = 0; i < tweaks.size() && as_reference; ++i)
            if (tweaks[i].reference) subject_.preset.values[i] = *tweaks[i].reference;
        if (subject_.stateful())
            subject_.play_frames(0, kWorstFrames, 60.0);
        else
            subject_.show(time, 0.0);
        return time;
    }
    bool draw_next(double time) {
        return subject_.stateful() ? subject_.play_frames(kWorstFrames, kWorstFrames + 1, 60.0)
                                   : subject_.show(time + 1.0 / 60, 0.0);
    }

    CheckSubject& subject_;
    Space space_;
    std::array<Found, 3> worst_;
};

void run_worst(Check& check, CaseResult& result) {
    const CaseClock clock(check);
    result.verdict = CaseVerdict::report;
    WorstJudge judge(check);
    Search search(judge.space().usual(), judge.space().rare());
    const int wanted = kLookedAt * check.effort.tries.value_or(1);
    for (int done = 0; done < wanted; ++done) {
        if (clock.is_over(kWorstShare)) break;
        const Point point = search.next();
        search.tell(point, judge(point));
        if (!check.subject.observed().is_finite()) {  // a failure of its own
            result.note = "at " + judge.space().words(point, check.subject);
            return;
        }
    }
    std::string words;
    const auto tell = [&](WorstJudge::What what, const char* text, double scale) {
        const WorstJudge::Found& found = judge.worst(what);
        if (found.most < kDull) return;
        judge.bring_to(found.at);
        words += fmt::format("{}{}", words.empty() ? "" : "; ",
                             fmt::format(fmt::runtime(text), found.most * scale,
                                         judge.space().words(found.at, check.subject)));
    };
    tell(WorstJudge::of_pixels, "a pixel or line stands out by {:.2f} at {}", 1.0);
    tell(WorstJudge::of_reference, "{:.1f} % of pixels are off the reference at {}", 100.0);
    tell(WorstJudge::of_frames, "a frame is off the next by {:.2f} at {}", 1.0);
    const WorstJudge::Found& jumps = judge.worst(WorstJudge::of_frames);
    if (jumps.most >= kDull && check.subject.moves()) {
        const auto area = flashing_area(check, judge.bring_to(jumps.at));
        const std::string flashes = area ? too_many_flashes(*area) : "";
        if (!flashes.empty()) words += fmt::format("; {} there", flashes);
    }
    result.note = words.empty() ? "nothing jumps or stands out" : words;
}

}  // namespace

void add_worst_case(std::vector<Case>& list, const CheckSubject& subject) {
    list.push_back({"worst", run_worst,
                    subject.scene().tweaks.empty() ? Case::Tweaks::none : Case::Tweaks::all});
}

}  // namespace glint
