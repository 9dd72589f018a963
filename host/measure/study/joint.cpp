#include "measure/study/joint.h"

#include "base/median.h"
#include "base/process_time.h"
#include "base/words.h"
#include "measure/rows/difference.h"
#include "measure/rows/flip.h"
#include "measure/study/result.h"
#include "measure/study/search.h"
#include "measure/study/statistics.h"
#include "offline/common.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <thread>
#include <utility>

namespace glint {
namespace {

constexpr double kLeastWhole = 0.125;  // of each reference
constexpr int kTries = 160;            // joint settings that are tried quickly
constexpr double kSearchShare = 4.0;   // of --seconds, for all of them
constexpr int kQuickFrames = 3;        // of each, beside as many of the preset's own, at least
constexpr int kMostQuick = 15;         // where they are so short
constexpr double kQuickMs = 60.0;      // that all of each take no longer
constexpr std::size_t kWinners = 8;    // that are measured well
constexpr std::size_t kKept = 6;       // programs
constexpr double kMatters = 0.1;       // of the difference: less needs no order

// Within what the preset itself takes, by what is the larger share of its own, so that nothing is
// gained by the one measure and lost by the other; else by the one that limits.
double error_of(const Difference& off, const Limit& limit, const Difference* own) {
    if (!limit.number && own)
        return std::max(off.rmse / std::max(own->rmse, kLeastRmse),
                        off.flip / std::max(own->flip, kLeastRmse));
    return limit.of == Limit::Of::flip ? off.flip : off.rmse;
}

const char* unit_of(const Limit& limit) {
    switch (limit.of) {
        case Limit::Of::ms:
            return "ms";
        case Limit::Of::rmse:
            return "RMSE";
        case Limit::Of::flip:
            return "FLIP";
    }
    return "";
}

// The tweak that a knob turns.
std::size_t tweak_of(const Preset& preset, const Knob& knob) {
    const auto found = std::ranges::find(preset.scene.tweaks, knob.name, &Tweak::name);
    return static_cast<std::size_t>(found - preset.scene.tweaks.begin());
}

class JointSearch {
public:
    JointSearch(const Preset& preset, const std::vector<Knob>& knobs, const Limit& limit,
                double seconds, Context& context, const MeasureOptions& how,
                const SearchCaller& caller)
        : preset_(preset),
          limit_(limit),
          seconds_(seconds),
          context_(context),
          how_(how),
          values_(values_of_pass(how.pass)),
          caller_(caller) {
        how_.specialise = false;
        for (const Knob& knob : knobs) {
            if (tweak_of(preset, knob) < preset.scene.tweaks.size()) knobs_.push_back(knob);
        }
        if (knobs_.empty()) throw UsageError("There is no quality tweak to choose by a budget.");
        for (const Knob& knob : knobs_) {
            tweaks_.push_back(tweak_of(preset, knob));
            menus_.push_back(!knob.values.front().work);
            if (menus_.back()) how_.constants.push_back(tweaks_.back());
            dials_.push_back({knob.values.size(), menus_.back()});
        }
        knob_ = {.name = "quality",
                 .reference = truth(1.0),
                 .second = truth(0.5),
                 .constants = how_.constants};
    }

    Knob run() {
        draw_truth();
        knob_.second->text = "half of each of them";
        knob_.second_work = {SecondWork::Kind::share, share_of_second()};
        knob_.rival = rival();
        take_named_second();
        size_ = compared_size(preset_, how_.pass);
        start();
        const Budget budget = this->budget();
        const double begun = spent_ms();
        const bool has_truth = pixels_not_finite(truth_, values_) == 0;
        int count = 0;  // the preset's own is measured, however little time there is
        const auto tried =
            search(dials_, own(), budget, kTries, [&](const Stand& at) -> std::optional<Tried> {
                const bool over = spent_ms() - begun > 1e3 * kSearchShare * seconds_;
                if (count > 0 && (over || !has_truth)) return std::nullopt;
                caller_.told(++count, kTries);
                return measure(at);
            });
        std::vector<Tried> winners = best_of(tried, budget, kWinners);
        if (std::ranges::find(winners, own(), &Tried::at) == winners.end())
            winners.insert(winners.begin(), tried.front());
        std::ranges::stable_sort(winners, {}, &Tried::ms);
        for (const Tried& winner : winners) {
            knob_.values.push_back({.text = text(winner.at), .setting = setting(winner.at)});
        }
        knob_.notes.push_back(fmt::format("{} joint settings of {} tweaks were tried, {} measured",
                                          tried.size(), knobs_.size(), winners.size()));
        if (!lacks_.empty()) knob_.notes.push_back(lacks_);
        return knob_;
    }

private:
    void draw_truth() {
        knob_.reference.text = "all references";
        DrawnPicture drawn = picture_of(knob_.reference);
        while (!drawn.cut_pass.empty() && whole_ > kLeastWhole) {
            whole_ *= 0.5;
            knob_.reference = truth(1.0);
            knob_.second = truth(0.5);
            knob_.reference.text = fmt::format("{} of each reference", whole_);
            knob_.notes = {fmt::format("with all references it is {}", loops_cut(drawn.cut_pass))};
            drawn = picture_of(knob_.reference);
        }
        truth_ = std::move(drawn.rgba);
    }

    // All references, with so much of the work, or with so much of that of one knob alone; the one
    // after the last is the frames that settle.
    KnobValue truth(double work, std::optional<std::size_t> only = {}) const {
        KnobValue value{.text = fmt::format("{} of {}", work, only ? name_of(*only) : "all"),
                        .setting = {.values = knobs_.front().reference.setting.values,
                                    .settle = preset_.settle},
                        .named = knobs_.front().reference.named};
        const auto turns = [&](std::size_t i) { return work < 1.0 && only.value_or(i) == i; };
        for (std::size_t i = 0; i < knobs_.size(); ++i) {
            const Setting& reference = knobs_[i].reference.setting;
            double& number = value.setting.values[tweaks_[i]][0];
            number = reference.values[tweaks_[i]][0];
            value.setting.settle = std::max(value.setting.settle, reference.settle);
            const double share = whole_ * (turns(i) ? work : 1.0);
            if (menus_[i] || share == 1.0) continue;
            const Tweak& tweak = preset_.scene.tweaks[tweaks_[i]];
            number *= knobs_[i].more_is_better ? share : 1.0 / share;
            if (tweak.type == TweakType::int1) number = std::floor(number);
            if (knobs_[i].more_is_better && tweak.min) number = std::max(number, *tweak.min);
            if (!knobs_[i].more_is_better && tweak.max) number = std::min(number, *tweak.max);
        }
        if (turns(knobs_.size())) {
            const int frames = value.setting.settle + 1;
            value.setting.settle = std::max(static_cast<int>(frames * work), 1) - 1;
        }
        return value;
    }

    // The truth with so much of the work, turned as another picture of each knob is turned from the
    // knob's own; nothing where none is.
    template <typename Picture>
    std::optional<KnobValue> turned(Picture picture, double work = 1.0) const {
        KnobValue value = truth(work);
        std::string how;
        for (const Knob& knob : knobs_) {
            const std::optional<KnobValue> other = picture(knob);
            if (!other) continue;
            const Setting& from = knob.reference.setting;
            value.named.insert(value.named.end(), other->named.begin(), other->named.end());
            value.setting.settle = std::max(value.setting.settle, other->setting.settle);
            for (std::size_t i = 0; i < from.values.size(); ++i) {
                const TweakValue& wanted = other->setting.values[i];
                if (wanted == from.values[i] || wanted == value.setting.values[i]) continue;
                const Tweak& tweak = preset_.scene.tweaks[i];
                value.setting.values[i] = wanted;
                how += fmt::format("{}{}={}", how.empty() ? "" : " ", tweak.name,
                                   format_value(tweak, wanted));
            }
        }
        value.text = how;
        return how.empty() ? std::nullopt : std::optional(value);
    }

    // All second ways to the truth that the scene names, at once. What it is off by itself is the
    // same share of what half of the work changes as it is without them, or more where a quarter
    // tells that it converges more slowly.
    std::optional<Rival> rival() const {
        const auto named = [](const Knob& knob) {
            return knob.rival ? std::optional(knob.rival->value) : std::nullopt;
        };
        const auto value = turned(named);
        if (!value) return std::nullopt;
        return Rival{.value = *value,
                     .second = turned(named, 0.5),
                     .work = knob_.second_work,
                     .less = turned(named, 0.25)};
    }

    // What --second says of the knobs, at once.
    void take_named_second() {
        const auto named =
            turned([](const Knob& knob) { return knob.names_second ? knob.second : std::nullopt; });
        if (!named) return;
        knob_.second = named;
        knob_.second->text = knob_.reference.text + " with " + named->text;
        knob_.second_work = {};
    }

    std::string name_of(std::size_t knob) const {
        return knob < knobs_.size() ? knobs_[knob].name : "settle";
    }

    DrawnPicture picture_of(const KnobValue& value) {
        if (auto kept = caller_.find(knob_, value)) return *kept;
        MeasuredScene& turned = scene(value.setting);
        DrawnPicture drawn{.rgba = turned.draw_picture()};
        aside([&] {
            drawn.cut_pass = turned.cut_pass();
            caller_.keep(knob_, value, drawn);
        });
        return drawn;
    }

    double apart(const std::vector<float>& a, const std::vector<float>& b) const {
        return difference(a, b, values_).rmse;
    }

    // By pictures of a quarter and of half of the work, the last of which is so far from the truth.
    Fall fall(const std::vector<float>& quarter, const std::vector<float>& half,
              double last) const {
        return fall_by_doubling(apart(quarter, half), last, apart(quarter, truth_));
    }

    // How much of the difference to this other picture the truth's own error is: of each number
    // what is left after it, by the order that half and a quarter of it show, all else at its
    // reference. These have causes of their own, so that their squares add up. All halved together
    // would not do: what converges fast would pass for what does not, and the other way round.
    // Where that changes nothing, as in a ratio of two of them, the other picture is of the one
    // alone that lacks most.
    double share_of_second() {
        double between = apart(picture_of(*knob_.second).rgba, truth_);
        const bool cancels = between == 0.0;
        double squares = 0.0, most = 0.0;
        for (std::size_t i = 0; i <= knobs_.size(); ++i) {
            const KnobValue half = truth(0.5, i), quarter = truth(0.25, i);
            if (half.setting == truth(1.0).setting) continue;
            const std::vector<float> picture = picture_of(half).rgba;
            const double last = apart(picture, truth_);
            const bool matters = last > kMatters * between && quarter.setting != half.setting;
            const double left =
                own_error(last, {SecondWork::Kind::more, 0.5},
                          matters ? fall(picture_of(quarter).rgba, picture, last) : Fall{});
            squares += left * left;
            if (cancels && last > between) {
                between = last;
                knob_.second = half;
                knob_.second->text = "half of " + name_of(i);
            }
            if (left <= most) continue;
            most = left;
            lacks_ = fmt::format("the truth lacks most of {}: {}", name_of(i), three_digits(left));
        }
        return between > 0.0 ? std::sqrt(squares) / between : 1.0;
    }

    // Knobs whose least number is the most work stand the other way round.
    std::size_t value_index(std::size_t knob, std::size_t at) const {
        const bool turned = !menus_[knob] && !knobs_[knob].more_is_better;
        return turned ? knobs_[knob].values.size() - 1 - at : at;
    }

    Setting setting(const Stand& at) const {
        Setting result{.values = preset_.values, .settle = preset_.settle};
        for (std::size_t i = 0; i < at.size(); ++i) {
            const KnobValue& value = knobs_[i].values[value_index(i, at[i])];
            result.values[tweaks_[i]] = value.setting.values[tweaks_[i]];
        }
        return result;
    }

    std::string text(const Stand& at) const {
        std::string result;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const KnobValue& value = knobs_[i].values[value_index(i, at[i])];
            // An option of a menu may have a space in its name, by which the list is read again.
            const bool is_one_word = value.text.find_first_of(" ,=") == std::string::npos;
            result += fmt::format("{}{}={}", i > 0 ? " " : "", knobs_[i].name,
                                  menus_[i] && !is_one_word
                                      ? format_number(value.setting.values[tweaks_[i]][0])
                                      : value.text);
        }
        return result;
    }

    Stand own() const {
        Stand at;
        for (std::size_t i = 0; i < knobs_.size(); ++i) {
            std::size_t index = 0;
            for (std::size_t v = 0; v < knobs_[i].values.size(); ++v) {
                const KnobValue& value = knobs_[i].values[value_index(i, v)];
                if (value.setting.values[tweaks_[i]] == preset_.values[tweaks_[i]]) index = v;
            }
            at.push_back(index);
        }
        return at;
    }

    MeasuredScene& scene(const Setting& wanted) {
        std::vector<double> menus;
        for (const std::size_t menu : how_.constants) menus.push_back(wanted.values[menu][0]);
        auto& kept = scenes_[menus];
        if (!kept) {
            aside([&] { kept = std::make_unique<MeasuredScene>(preset_, wanted, context_, how_); });
            if (scenes_.size() > kKept)
                scenes_.erase(scenes_.begin()->first == menus ? std::prev(scenes_.end())
                                                              : scenes_.begin());
        }
        kept->set(wanted);
        return *kept;
    }

    // On the wall; of a software renderer as long as the machine would take were it alone with it,
    // so that what is found does not hang on what else runs. Nor does it on what the driver has
    // kept of earlier calls: compiling is not counted, nor is keeping.
    double spent_ms() const {
        const unsigned processors = std::max(std::thread::hardware_concurrency(), 1u);
        const double all = context_.is_software() ? own_processor_ms() / processors : clock_.ms();
        return all - aside_ms_;
    }

    // Does what is no part of that.
    template <typename Work>
    void aside(Work work) {
        const double begun = spent_ms();
        work();
        aside_ms_ += spent_ms() - begun;
    }

    double time(const FrameTime& frame) const {
        return context_.is_software() ? frame.processor : frame.wall;
    }

    // The preset's own setting, beside which all others are timed.
    void start() {
        base_ = std::make_unique<MeasuredScene>(preset_, setting(own()), context_, how_);
        base_->draw_picture();
        aside([&] { base_->find_quick_place(); });
        const Rounds rounds = time_rounds(1, [&](std::size_t) { return base_->time_frame(); },
                                          {.seconds = 0.0, .on_software = context_.is_software()});
        const Clock clock = best_clock(rounds.rows, context_.is_software());
        base_ms_ = median_of(times_by(clock, rounds.rows.front()));
        quick_frames_ = static_cast<int>(
            std::clamp(kQuickMs / base_ms_, double{kQuickFrames}, double{kMostQuick}));
    }

    Tried measure(const Stand& at) {
        MeasuredScene& tried = scene(setting(at));
        const std::vector<float> picture = tried.draw_picture();
        aside([&] { tried.find_quick_place(); });
        Difference off = difference(picture, truth_, values_);
        if (limit_.of == Limit::Of::flip || !limit_.number)
            off.flip =
                mean_where_finite(flip_map(picture, truth_, size_, {.values = values_}), truth_);
        std::vector<double> ratios;
        for (int i = 0; i < quick_frames_; ++i)
            ratios.push_back(time(tried.time_frame()) / time(base_->time_frame()));
        const bool failed = off.not_finite > off.reference_not_finite;
        if (!own_error_) own_error_ = off;  // the preset's own is the first
        return {.at = at,
                .ms = base_ms_ * median_of(ratios),
                .error = failed ? 1e9 : error_of(off, limit_, &*own_error_)};
    }

    Budget budget() const {
        if (limit_.of == Limit::Of::ms)
            return {.ms = limit_.number.value_or(base_ms_), .error = {}};
        return {.ms = {}, .error = limit_.number.value_or(kAsGood)};
    }

    const Preset& preset_;
    const Limit& limit_;
    double seconds_;
    Context& context_;
    // A program has its menus as constants, so that each method costs what it costs, and numbers as
    // uniforms, so that it serves all of them.
    MeasureOptions how_;
    Values values_;  // of what is compared
    const SearchCaller& caller_;
    Knob knob_;  // what is found
    std::vector<Knob> knobs_;
    std::vector<std::size_t> tweaks_;  // by knob
    std::vector<bool> menus_;          // by knob
    std::vector<Dial> dials_;
    std::vector<float> truth_;
    std::string lacks_;   // the truth; "": nothing
    glm::ivec2 size_{0};  // of what is compared
    std::map<std::vector<double>, std::unique_ptr<MeasuredScene>> scenes_;  // by menus
    std::unique_ptr<MeasuredScene> base_;
    double base_ms_ = 0.0;
    std::optional<Difference> own_error_;
    int quick_frames_ = kQuickFrames;
    double aside_ms_ = 0.0;
    double whole_ = 1.0;  // of each reference's work, what the truth has
    Stopwatch clock_;
};

}  // namespace

std::optional<Limit> limit_of(const StudyOptions& options) {
    struct Option {
        Limit::Of of;
        const char* name;
        const std::optional<std::string>& text;
    };
    for (const Option& option : {Option{Limit::Of::ms, "--ms", options.ms_budget},
                                 Option{Limit::Of::rmse, "--rmse", options.rmse_budget},
                                 Option{Limit::Of::flip, "--flip", options.flip_budget}}) {
        if (!option.text) continue;
        if (*option.text == "own") return Limit{.of = option.of};
        const auto number = parse_number(*option.text);
        if (option.of == Limit::Of::flip && number && *number > 1.0)
            throw UsageError(fmt::format(
                "--flip {}: FLIP is at most 1, and hardly anybody sees 0.05.", *option.text));
        if (number && std::isfinite(*number) && *number > 0.0)
            return Limit{.of = option.of, .number = number};
        throw UsageError(
            fmt::format("{} {}: write a number above 0, or own: what the preset takes.",
                        option.name, *option.text));
    }
    return std::nullopt;
}

Knob joint_knob(const Preset& preset, const std::vector<Knob>& knobs, const Limit& limit,
                double seconds, Context& context, const MeasureOptions& how,
                const SearchCaller& caller) {
    return JointSearch(preset, knobs, limit, seconds, context, how, caller).run();
}

void choose_best(Study& study, const Limit& limit) {
    study.is_joint = true;
    if (!study.has_truth()) {
        study.findings.push_back("no setting is chosen, since the reference is no truth");
        return;
    }
    if (limit.of == Limit::Of::rmse && limit.number && study.own_error > *limit.number) {
        study.findings.push_back(fmt::format(
            "no setting is chosen: the truth itself may be off by {}, and nothing can be "
            "told to be within {} of it; name references that do more",
            three_digits(study.own_error), three_digits(*limit.number)));
        return;
    }
    const auto own = std::ranges::find_if(study.rows, &StudyRow::is_preset);
    const bool any = own != study.rows.end() && own->error, by_time = limit.of == Limit::Of::ms;
    const Difference* own_error = any ? &*own->error : nullptr;
    const double own_most = by_time && any ? own->ms.median : kAsGood;
    const double most = limit.number.value_or(any ? own_most : 0.0);
    // What a budget limits, and what is the least within it.
    const auto limited = [&](const StudyRow& row) {
        return by_time ? row.ms.median : error_of(*row.error, limit, own_error);
    };
    const auto wanted = [&](const StudyRow& row) {
        return by_time ? row.error->rmse : row.ms.median;
    };
    std::optional<double> least;
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        const StudyRow& row = study.rows[i];
        if (!row.error || !row.failed.empty()) continue;
        least = std::min(least.value_or(limited(row)), limited(row));
        // What is not told to take longer than the preset's own does not, unless its median says
        // so: on a busy machine hardly anything is told. And what is nearer is not to seem farther.
        const bool is_as_good = !any || (row.ms.median <= (1.0 + kEnough) * own->ms.median &&
                                         row.error->flip <= kAsGood * own_error->flip);
        const bool is_within = by_time && !limit.number
                                   ? row.verdict != TimeVerdict::slower && is_as_good
                                   : limited(row) <= most;
        if (is_within && (!study.best || wanted(row) < wanted(study.rows[*study.best])))
            study.best = i;
    }
    if (study.best) return;
    study.findings.push_back(
        fmt::format("nothing that was tried is within {} {}{}", three_digits(most), unit_of(limit),
                    least ? fmt::format("; the least is {}", three_digits(*least)) : ""));
}

}  // namespace glint
