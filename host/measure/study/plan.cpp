#include "measure/study/plan.h"

#include "base/words.h"
#include "measure/study/formats.h"
#include "measure/study/values.h"
#include "offline/common.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace glint {
namespace {

const std::string kSettle = "settle";
const std::vector<int> kSettleValues = {0, 1, 4, 16, 64};
constexpr int kSettleReference = 256;

// "NAME=rest".
struct Assignment {
    std::string name, rest;
};

Assignment split(const std::string& text, const char* option) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        throw UsageError(fmt::format("{} {}: write NAME=VALUE.", option, text));
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

const Tweak* find_tweak(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.tweaks, name, &Tweak::name);
    return found == scene.tweaks.end() ? nullptr : &*found;
}

// Of the same picture it would be off by nothing.
void require_another(const KnobValue& second, const KnobValue& reference, const std::string& said) {
    if (second.setting == reference.setting)
        throw UsageError(
            fmt::format("--second {}: that is the reference itself, which tells nothing of its own "
                        "error; name another value.",
                        said));
}

int frames(const std::string& text) {
    const auto number = parse_number(text);
    if (!number || *number < 0.0 || *number > 1e6 || *number != std::floor(*number)) {
        throw UsageError(fmt::format("settle={}: write a whole number from 0.", text));
    }
    return static_cast<int>(*number);
}

// Builds settings from what the preset has.
class Planner {
public:
    Planner(const Preset& preset, const SceneFacts& facts, const StudyOptions& options)
        : preset_(preset), facts_(facts), options_(options) {}

    Knob knob(const Tweak& tweak, const std::vector<TweakValue>& values) const;
    Knob settle_knob(const std::vector<int>& values) const;
    Knob format_knob(const std::string& name, const std::vector<std::string>& formats) const {
        return glint::format_knob(preset_, facts_.drawn,
                                  {.name = name,
                                   .formats = formats,
                                   .reference = said(options_.reference, name, "--reference"),
                                   .second = said(options_.second, name, "--second")});
    }
    // With the preset's own value among them.
    Knob with_own(Knob knob, KnobValue own) const;
    // With the reference, where it lies between two: the best of a knob may be in its middle.
    Knob with_reference(Knob knob, const Tweak& tweak) const {
        const auto lies = [&](auto beyond) {
            return std::ranges::any_of(knob.values, [&](const KnobValue& value) {
                return value.work && knob.reference.work &&
                       beyond(*value.work, *knob.reference.work);
            });
        };
        if (!lies(std::less()) || !lies(std::greater())) return knob;
        KnobValue reference = value(tweak, knob.reference.setting.values[index(tweak)]);
        return with_own(std::move(knob), std::move(reference));
    }
    Knob knob_and_own(const Tweak& tweak, const std::vector<TweakValue>& values) const {
        return with_own(knob(tweak, values), value(tweak, preset_.values[index(tweak)]));
    }
    Knob settle_and_own(const std::vector<int>& values) const {
        return with_own(settle_knob(values), settle(preset_.settle));
    }

    KnobValue value(const Tweak& tweak, const TweakValue& value) const {
        KnobValue result{.text = format_value(tweak, value), .work = {}, .setting = setting()};
        if (is_number(tweak)) result.work = value[0];
        result.setting.values[index(tweak)] = value;
        return result;
    }
    KnobValue settle(int frames) const {
        KnobValue result{
            .text = fmt::format("{}", frames), .work = frames + 1.0, .setting = setting()};
        result.setting.settle = frames;
        return result;
    }

    TweakValue parse(const Tweak& tweak, const std::string& text, const char* option) const;
    // What an option says of this knob, if anything.
    std::optional<std::string> said(const std::vector<std::string>& list, const std::string& name,
                                    const char* option) const;

private:
    Setting setting() const { return {preset_.values, preset_.settle}; }
    std::size_t index(const Tweak& tweak) const {
        return static_cast<std::size_t>(&tweak - preset_.scene.tweaks.data());
    }
    bool is_studied(const std::string& name) const;
    KnobValue truth(const Tweak& tweak, const TweakValue& value) const;
    void choose_reference(const Tweak& tweak, Knob& knob) const;
    void choose_direction(const Tweak& tweak, Knob& knob) const;
    void settle_accumulating(KnobValue& truth, Knob& knob) const;
    std::optional<KnobValue> second_seed(const KnobValue& truth) const;
    bool is_another_seed(const KnobValue& value, const KnobValue& truth) const;
    KnobValue turned(KnobValue value, const std::vector<Turned>& list) const;
    std::optional<KnobValue> named_second(const Knob& knob) const;
    struct Named {
        std::vector<Turned> values;
        bool is_own_number = false;  // one value of the tweak's own, which is a number
    };
    Named named_by_scene(const Tweak& tweak) const;
    void choose_second(const Tweak& tweak, Knob& knob) const;
    void choose_rival(const Tweak& tweak, Knob& knob) const;
    std::vector<bool> own_quality(const Tweak& tweak, const Knob& knob,
                                  const KnobValue& truth) const;
    std::optional<KnobValue> with_work(const Tweak& tweak, const Knob& knob, const KnobValue& truth,
                                       double times) const;

    const Preset& preset_;
    const SceneFacts& facts_;
    const StudyOptions& options_;
};

TweakValue Planner::parse(const Tweak& tweak, const std::string& text, const char* option) const {
    const auto value = parse_value(tweak, text);
    if (!value) {
        const std::string meant = did_you_mean(text, tweak.names);
        throw UsageError(fmt::format("{} {}: '{}' is not {}{}", option, tweak.name, text,
                                     expected_value(tweak), meant.empty() ? "." : meant));
    }
    return *value;
}

std::optional<std::string> Planner::said(const std::vector<std::string>& list,
                                         const std::string& name, const char* option) const {
    for (const std::string& text : list) {
        const Assignment assignment = split(text, option);
        if (assignment.name == name) return assignment.rest;
    }
    return std::nullopt;
}

// Whether a study of its own turns this tweak.
bool Planner::is_studied(const std::string& name) const {
    const auto names = [&](const std::string& vary) {
        return vary.substr(0, vary.find('=')) == name;
    };
    if (!options_.vary.empty()) return std::ranges::any_of(options_.vary, names);
    const Tweak* tweak = find_tweak(preset_.scene, name);
    return tweak && tweak->quality && facts_.read[index(*tweak)];
}

// With this value, and with what --reference says of tweaks that no study turns.
KnobValue Planner::truth(const Tweak& tweak, const TweakValue& value) const {
    KnobValue result = this->value(tweak, value);
    for (const std::string& text : options_.reference) {
        const Assignment said = split(text, "--reference");
        const Tweak* other = find_tweak(preset_.scene, said.name);
        if (!other || other == &tweak || is_studied(said.name)) continue;
        result.setting.values[index(*other)] = parse(*other, said.rest, "--reference");
        result.named.push_back(index(*other));
        result.text += fmt::format(" with {}={}", said.name, said.rest);
    }
    return result;
}

void Planner::choose_reference(const Tweak& tweak, Knob& knob) const {
    if (const auto text = said(options_.reference, tweak.name, "--reference")) {
        knob.reference = truth(tweak, parse(tweak, *text, "--reference"));
    } else if (tweak.reference) {
        knob.reference = truth(tweak, *tweak.reference);
    } else {
        knob.reference = truth(tweak, knob.values.back().setting.values[index(tweak)]);
        if (!options_.time_only) {
            knob.notes.push_back(
                fmt::format("{} declares no reference: its last value, {}, counts as the truth",
                            tweak.name, knob.reference.text));
        }
    }
    if (!is_number(tweak)) settle_accumulating(knob.reference, knob);
    if (knob.reference.work) choose_direction(tweak, knob);
}

// By a reference beyond the values, the scene's own before another one; else of whole numbers,
// which count something, more is better, and of others the end that it is nearer to, in the way
// that its slider goes.
void Planner::choose_direction(const Tweak& tweak, Knob& knob) const {
    double least = knob.values.front().work.value_or(0.0), most = least;
    for (const KnobValue& v : knob.values) {
        least = std::min(least, v.work.value_or(least));
        most = std::max(most, v.work.value_or(most));
    }
    const double truth = *knob.reference.work;
    const double declared = tweak.reference ? (*tweak.reference)[0] : truth;
    const auto is_among = [&](double work) { return least < work && work < most; };
    if (is_among(truth) && !options_.time_only)
        knob.notes.push_back(fmt::format(
            "the reference, {}, lies among the values: what lies beyond it counts as farther from "
            "the truth, even where it is nearer; name another with --reference",
            knob.reference.text));
    const double by = is_among(declared) ? truth : declared;
    if (is_among(by) && tweak.type == TweakType::int1) return;
    knob.more_is_better =
        tweak.log && least > 0.0 && by > 0.0 ? by / least >= most / by : by - least >= most - by;
}

// A method that accumulates, of a scene that otherwise does not, is the truth only after it has.
void Planner::settle_accumulating(KnobValue& truth, Knob& knob) const {
    if (facts_.accumulates(preset_.values) || !facts_.accumulates(truth.setting.values)) return;
    const auto named = said(options_.reference, kSettle, "--reference");
    int& settle = truth.setting.settle;
    settle = std::max(settle, named ? frames(*named) : kSettleReference);
    knob.notes.push_back(
        fmt::format("the reference, {}, accumulates {} more frames", truth.text, settle));
}

// The same work with other random numbers, and nothing else.
bool Planner::is_another_seed(const KnobValue& value, const KnobValue& truth) const {
    const std::optional<KnobValue> seeded = second_seed(truth);
    if (!seeded) return false;
    Setting setting = value.setting;
    const Tweak& seed = *find_tweak(preset_.scene, "seed");
    setting.values[index(seed)] = truth.setting.values[index(seed)];
    return setting == truth.setting;
}

std::optional<KnobValue> Planner::second_seed(const KnobValue& truth) const {
    const Tweak* seed = find_tweak(preset_.scene, "seed");
    if (!seed || !is_number(*seed) || !facts_.read[index(*seed)]) return std::nullopt;
    KnobValue result = truth;
    result.setting.values[index(*seed)][0] += 1.0;
    result.text += ", another seed";
    return result;
}

// By tweak: quality that the truth's method reads and no other of the menu does. What they all
// read, such as rays through a pixel, changes the picture and not how far the method is from it.
std::vector<bool> Planner::own_quality(const Tweak& tweak, const Knob& knob,
                                       const KnobValue& truth) const {
    const TweakValue& method = truth.setting.values[index(tweak)];
    std::vector<bool> own = facts_.read_with(index(tweak), method);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const Tweak& other = preset_.scene.tweaks[i];
        own[i] = own[i] && other.quality && is_number(other);
    }
    for (const KnobValue& value : knob.values) {
        const TweakValue& other = value.setting.values[index(tweak)];
        if (other == method) continue;
        const std::vector<bool> read = facts_.read_with(index(tweak), other);
        for (std::size_t i = 0; i < own.size(); ++i) own[i] = own[i] && !read[i];
    }
    return own;
}

// Twice or half the work of a number; of a method, twice or half the frames, or so much of its own
// quality, or, where it has none, of all other quality tweaks.
std::optional<KnobValue> Planner::with_work(const Tweak& tweak, const Knob& knob,
                                            const KnobValue& truth, double times) const {
    KnobValue result = truth;
    const auto multiply = [&](const Tweak& of, double by) {
        double& number = result.setting.values[index(of)][0];
        number *= by;
        constexpr double kMost = std::numeric_limits<int>::max();
        if (of.type == TweakType::int1) number = std::clamp(std::floor(number), -kMost, kMost);
    };
    const bool is_more = times > 1.0;
    // Its own slider's way to its own reference.
    const auto multiply_work = [&](const Tweak& of, double by) {
        Knob one{.reference = value(of, of.reference.value_or(preset_.values[index(of)]))};
        for (const TweakValue& v : values_of(of)) one.values.push_back(value(of, v));
        if (one.values.empty() && !of.reference) return;  // which is left out
        if (!one.values.empty() && of.reference) choose_direction(of, one);
        multiply(of, one.more_is_better ? by : 1.0 / by);
    };
    const auto unless_same = [&] {
        return result.setting == truth.setting ? std::nullopt : std::optional(result);
    };
    if (is_number(tweak)) {
        multiply(tweak, knob.more_is_better ? times : 1.0 / times);
        const TweakValue& value = result.setting.values[index(tweak)];
        result.text = format_value(tweak, value);
        result.work = value[0];
        return unless_same();
    }
    if (facts_.accumulates(result.setting.values)) {
        result.setting.settle = static_cast<int>((result.setting.settle + 1) * times) - 1;
        result.text += is_more ? ", twice the frames" : ", half the frames";
        return unless_same();
    }
    const std::vector<bool> own = own_quality(tweak, knob, truth);
    const bool any_own = std::ranges::find(own, true) != own.end();
    for (const Tweak& other : preset_.scene.tweaks) {
        const bool is_wanted = any_own ? own[index(other)] : other.quality && is_number(other);
        if (is_wanted && &other != &tweak) multiply_work(other, times);
    }
    result.text += fmt::format(", {} quality {}", any_own ? "its own" : "all other",
                               is_more ? "doubled" : "halved");
    return unless_same();
}

// The truth with some values turned.
KnobValue Planner::turned(KnobValue value, const std::vector<Turned>& list) const {
    for (const Turned& item : list) {
        value.setting.values[item.tweak] = item.value;
        value.named.push_back(item.tweak);
    }
    return value;
}

// The truth with what --second says of other tweaks, and of settling; nothing where it says
// nothing. Of a knob that it names it tells nothing else.
std::optional<KnobValue> Planner::named_second(const Knob& knob) const {
    KnobValue result = knob.reference;
    std::string named;
    for (const std::string& text : options_.second) {
        const Assignment said = split(text, "--second");
        if (said.name == knob.name || names_a_format(said.name)) continue;
        if (said.name == kSettle) {
            result.setting.settle = frames(said.rest);
        } else {
            const Tweak& tweak = *find_tweak(preset_.scene, said.name);
            result.setting.values[index(tweak)] = parse(tweak, said.rest, "--second");
            result.named.push_back(index(tweak));
        }
        named += fmt::format("{}{}={}", named.empty() ? "" : ", ", said.name, said.rest);
    }
    // Of the same picture the reference would be off by nothing.
    if (result.setting == knob.reference.setting) return std::nullopt;
    result.text += " with " + named;
    return result;
}

// What `second=` says of this tweak.
Planner::Named Planner::named_by_scene(const Tweak& tweak) const {
    std::string wrong;  // was told when the scene was read
    Named named{.values = turned_values(preset_.scene.tweaks, tweak, tweak.second, wrong)};
    named.is_own_number =
        is_number(tweak) && named.values.size() == 1 && named.values[0].tweak == index(tweak);
    return named;
}

// By what is named, else by what the scene names, else by another seed, else by more work.
void Planner::choose_second(const Tweak& tweak, Knob& knob) const {
    const auto by_value = [&](const TweakValue& v) {
        knob.second = truth(tweak, v);
        if (!is_number(tweak) || v[0] <= 0.0 || knob.reference.work.value_or(0.0) <= 0.0) return;
        const double ratio = v[0] / *knob.reference.work;
        knob.second_work = {SecondWork::Kind::more, knob.more_is_better ? ratio : 1.0 / ratio};
    };
    if (const auto text = said(options_.second, tweak.name, "--second")) {
        by_value(parse(tweak, *text, "--second"));
        knob.names_second = true;
        return require_another(*knob.second, knob.reference,
                               fmt::format("{}={}", tweak.name, *text));
    }
    knob.second = named_second(knob);
    knob.names_second = knob.second.has_value();
    if (knob.names_second && is_another_seed(*knob.second, knob.reference)) {
        knob.second_work = {SecondWork::Kind::seed, 1.0};
        knob.more = with_work(tweak, knob, knob.reference, 2.0);
    }
    if (knob.names_second) return;
    if (!options_.second.empty())
        knob.notes.push_back(
            fmt::format("--second says nothing of {}: its reference, {}, has that already",
                        tweak.name, knob.reference.text));
    // A reference that another one has taken the place of may be what measures it in the scene.
    if (const Named named = named_by_scene(tweak);
        named.is_own_number && named.values[0].value[0] != knob.reference.work)
        return by_value(named.values[0].value);
    knob.more = with_work(tweak, knob, knob.reference, 2.0);
    knob.second_work = {SecondWork::Kind::seed, 1.0};
    if ((knob.second = second_seed(knob.reference))) return;
    knob.second_work = kTwiceTheWork;
    knob.second = knob.more;
}

// What the scene names as another way to the truth.
void Planner::choose_rival(const Tweak& tweak, Knob& knob) const {
    const Named named = named_by_scene(tweak);
    if (named.values.empty() || named.is_own_number) return;
    if (said(options_.reference, tweak.name, "--reference")) return;  // of the scene's own it is
    Rival rival{.value = turned(knob.reference, named.values)};
    rival.value.text = tweak.second;
    settle_accumulating(rival.value, knob);
    if (rival.value.setting == knob.reference.setting) return;  // bears nothing out
    rival.more = with_work(tweak, knob, rival.value, 2.0);
    rival.less = with_work(tweak, knob, rival.value, 0.5);
    rival.work = {SecondWork::Kind::seed, 1.0};
    rival.second = second_seed(rival.value);
    if (!rival.second) {
        rival.work = kTwiceTheWork;
        rival.second = rival.more;
    }
    knob.rival = std::move(rival);
}

Knob Planner::knob(const Tweak& tweak, const std::vector<TweakValue>& values) const {
    Knob result{.name = tweak.name};
    for (const TweakValue& v : values) result.values.push_back(value(tweak, v));
    choose_reference(tweak, result);
    if (options_.time_only) return result;
    choose_second(tweak, result);
    choose_rival(tweak, result);
    return result;
}

Knob Planner::settle_knob(const std::vector<int>& values) const {
    Knob result{.name = kSettle};
    for (const int frames : values) result.values.push_back(settle(frames));
    const auto reference = said(options_.reference, kSettle, "--reference");
    const auto second = said(options_.second, kSettle, "--second");
    const int truth = reference ? frames(*reference) : std::max(kSettleReference, values.back());
    result.reference = settle(truth);
    if (options_.time_only) return result;
    const auto more = [&](int n) {
        result.second = settle(n);
        result.second_work = {SecondWork::Kind::more, (n + 1.0) / (truth + 1.0)};
    };
    if (second) {
        more(frames(*second));
        require_another(*result.second, result.reference, fmt::format("{}={}", kSettle, *second));
    } else if (!(result.second = named_second(result))) {
        more(2 * truth + 1);
        result.more = result.second;
        if (const auto seed = second_seed(result.reference)) {
            result.second_work = {SecondWork::Kind::seed, 1.0};
            result.second = seed;
        }
    }
    return result;
}

Knob Planner::with_own(Knob knob, KnobValue own) const {
    const auto same = [&](const KnobValue& v) { return v.text == own.text; };
    if (std::ranges::any_of(knob.values, same)) return knob;
    own.is_between = own.work.has_value();
    const auto after = std::ranges::find_if(
        knob.values, [&](const KnobValue& v) { return v.work && own.work && *v.work > *own.work; });
    knob.values.insert(after, std::move(own));
    return knob;
}

bool has_budget(const StudyOptions& options) {
    return options.ms_budget || options.rmse_budget || options.flip_budget;
}

// Those that a study takes of this tweak.
std::vector<TweakValue> studied_values(const Tweak& tweak, const Preset& preset,
                                       const StudyOptions& options) {
    std::vector<TweakValue> list = values_of(tweak);
    if (!has_budget(options) || list.empty()) return list;
    const auto index = static_cast<std::size_t>(&tweak - preset.scene.tweaks.data());
    return values_to_choose(tweak, std::move(list), preset.values[index][0]);
}

// A knob with its own values: those that it takes where nobody names any.
Knob named_knob(const Planner& planner, const Preset& preset, const SceneFacts& facts,
                const StudyOptions& options, const std::string& name) {
    const Tweak* tweak = find_tweak(preset.scene, name);
    if (!tweak && name == kSettle && facts.accumulates(preset.values))
        return planner.settle_and_own(kSettleValues);
    if (!tweak && names_a_format(name)) return planner.format_knob(name, {});
    if (!tweak) throw UsageError("--vary: " + no_such_tweak(preset.scene, name));
    const std::vector<TweakValue> values = studied_values(*tweak, preset, options);
    if (values.empty()) {
        throw UsageError(
            fmt::format("--vary {}: it has neither a range nor a menu; name its values with "
                        "--vary {}=a,b,c.",
                        name, name));
    }
    return planner.knob_and_own(*tweak, values);
}

Knob varied_knob(const Planner& planner, const Preset& preset, const SceneFacts& facts,
                 const Assignment& vary) {
    const std::vector<std::string> words = parse_list(vary.rest);
    const Tweak* tweak = find_tweak(preset.scene, vary.name);
    if (!tweak && vary.name == kSettle) {
        if (!facts.accumulates(preset.values)) {
            throw UsageError("--vary settle: no pass of this scene accumulates frames.");
        }
        std::vector<int> frames;
        for (const std::string& word : words) frames.push_back(glint::frames(word));
        return planner.settle_knob(frames);
    }
    if (!tweak && names_a_format(vary.name)) return planner.format_knob(vary.name, words);
    if (!tweak) throw UsageError("--vary: " + no_such_tweak(preset.scene, vary.name));
    if (component_count(tweak->type) > 1) {
        throw UsageError(fmt::format(
            "--vary {}: only a tweak of one number, or a menu, can be varied.", vary.name));
    }
    std::vector<TweakValue> values;
    for (const std::string& word : words) {
        const TweakValue value = planner.parse(*tweak, word, "--vary");
        if (clamp_to_range(*tweak, value) != value) {
            throw UsageError(
                fmt::format("--vary {}: '{}' is not {}.", vary.name, word, expected_value(*tweak)));
        }
        if (std::ranges::find(values, value) == values.end()) values.push_back(value);
    }
    return planner.knob(*tweak, values);
}

// A name that no knob has would say nothing, nor would the second of two values.
void require_known(const Scene& scene, const std::vector<std::string>& list, const char* option) {
    std::set<std::string> known;
    for (const std::string& text : list) {
        const auto [name, rest] = split(text, option);
        if (name == kSettle) frames(rest);
        if (name != kSettle && !names_a_format(name) && !find_tweak(scene, name))
            throw UsageError(fmt::format("{}: {}", option, no_such_tweak(scene, name)));
        if (!known.insert(name).second)
            throw UsageError(fmt::format("{}: {} is named twice.", option, name));
    }
}

// What all other settings are measured beside is one of them, whatever is named.
KnobValue own_value(const Planner& planner, const Preset& preset, const Knob& knob) {
    const Tweak* tweak = find_tweak(preset.scene, knob.name);
    if (!tweak)
        throw UsageError(fmt::format(
            "--vary {}: a budget chooses quality tweaks alone; study it without one.", knob.name));
    const auto index = static_cast<std::size_t>(tweak - preset.scene.tweaks.data());
    return planner.value(*tweak, preset.values[index]);
}

}  // namespace

std::string nothing_to_study(const Preset& preset, const StudyPlan& plan) {
    const std::string file = preset.file.string();
    std::string names;
    for (const Tweak& tweak : preset.scene.tweaks)
        names += (names.empty() ? "" : ", ") + tweak.name;
    if (names.empty())
        return fmt::format(
            "{} has no tweaks, so that nothing is studied; what it costs: glint bench {}", file,
            file);
    if (!plan.left_out.empty())
        return fmt::format("of {} nothing is studied; {}", file, fmt::join(plan.left_out, "; "));
    return fmt::format(
        "{} has no quality tweaks and accumulates nothing, so that nothing is studied; mark one "
        "with quality, or name one of {}: glint study {} --vary {}",
        file, names, file, preset.scene.tweaks.front().name);
}

StudyPlan plan_study(const Preset& preset, const SceneFacts& facts, const StudyOptions& options) {
    require_known(preset.scene, options.reference, "--reference");
    require_known(preset.scene, options.second, "--second");
    const Planner planner(preset, facts, options);
    StudyPlan plan;
    for (const std::string& text : options.vary) {
        const bool only_named = text.find('=') == std::string::npos;
        Knob knob = only_named ? named_knob(planner, preset, facts, options, text)
                               : varied_knob(planner, preset, facts, split(text, "--vary"));
        if (has_budget(options)) knob = planner.with_own(knob, own_value(planner, preset, knob));
        plan.knobs.push_back(std::move(knob));
    }
    if (!plan.knobs.empty()) return plan;
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = preset.scene.tweaks[i];
        if (!tweak.quality) continue;
        const std::vector<TweakValue> values = studied_values(tweak, preset, options);
        if (!facts.read[i]) {
            plan.left_out.push_back(tweak.name + ": nothing reads it");
        } else if (values.empty()) {
            plan.left_out.push_back(tweak.name + (is_number(tweak)
                                                      ? ": it has no range; name values with --vary"
                                                      : ": it is of several numbers"));
        } else {
            Knob knob = planner.knob_and_own(tweak, values);
            if (has_budget(options)) knob = planner.with_reference(std::move(knob), tweak);
            plan.knobs.push_back(std::move(knob));
        }
    }
    if (facts.accumulates(preset.values))
        plan.knobs.push_back(planner.settle_and_own(kSettleValues));
    return plan;
}

}  // namespace glint
