// What the scene's own text asserts: `//@ assert t >= 0.0 "behind the eye"`.
#include "measure/check/case.h"
#include "measure/check/space.h"
#include "measure/probe/assertions.h"

#include <fmt/format.h>

namespace glint {
namespace {

constexpr double kAssertedPlayed = 2.0;  // s of a simulation
constexpr std::size_t kAssertedSets = 17;

// "; with a=0, b=2": what is not as the preset has it.
std::string turned_values(const CheckSubject& subject) {
    std::string text;
    const auto& tweaks = subject.scene().tweaks;
    for (std::size_t i = 0; i < tweaks.size(); ++i)
        if (subject.preset.values[i] != subject.opened().values[i])
            text += fmt::format("{}{}={}", text.empty() ? "; with " : ", ", tweaks[i].name,
                                format_value(tweaks[i], subject.preset.values[i]));
    return text;
}

// With each of these values, as long as all hold.
void check_assertions(const std::vector<std::vector<TweakValue>>& sets, Check& check,
                      CaseResult& result) {
    CheckSubject& subject = check.subject;
    // Of a simulation every frame, up to the first in which one does not hold.
    const auto draw = [&](const BrokenAssertions& found) {
        const std::size_t before = found.size();
        for (std::size_t i = 0; i < sets.size() && found.size() == before; ++i) {
            subject.restore();
            subject.preset.values = sets[i];
            subject.show(subject.opened().time, kAssertedPlayed,
                         [&] { return found.size() > before; });
        }
    };
    const std::vector<BrokenAssertion> broken = broken_assertions(
        subject.preset, subject.renderer(), {.specialise = subject.specialised()}, draw);
    if (broken.empty()) return;
    const BrokenAssertion& first = broken.front();
    result.where = CasePlace{.file = first.file,
                             .line = first.line,
                             .expression = first.expression,
                             .what = "an assertion"};
    std::string all;
    for (const BrokenAssertion& one : broken)
        all += fmt::format("{}{}:{}:{}: {}", all.empty() ? "" : "; ", one.file, one.line,
                           one.column, sentence_of(one));
    result.fail(all + turned_values(subject));
}

}  // namespace

void add_assertion_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (has_assertions(subject.scene()))
        list.push_back({.name = "asserted values", .run = [](Check& check, CaseResult& result) {
                            check_assertions({check.subject.opened().values}, check, result);
                        }});
    if (!has_assertions(subject.scene()) || subject.scene().tweaks.empty()) return;
    list.push_back({.name = "asserted at the ranges' ends",
                    .run =
                        [](Check& check, CaseResult& result) {
                            check_assertions(values_at_ends(check.subject, kAssertedSets), check,
                                             result);
                        },
                    .tweaks = Case::Tweaks::all});
}

}  // namespace glint
