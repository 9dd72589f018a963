// What the scene's own text asserts: `//@ assert t >= 0.0 "behind the eye"`.
#include "measure/check/case.h"
#include "measure/check/situation.h"
#include "measure/probe/assertions.h"

#include <fmt/format.h>

namespace glint {
namespace {

constexpr double kAssertedPlayed = 2.0;  // s of a simulation
constexpr std::size_t kAssertedSets = 17;
constexpr int kAssertedSpread = 16;  // points within all ranges

// In each of these situations, as long as all hold.
void check_assertions(const std::vector<Situation>& all, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    std::size_t at = 0;
    // Of a simulation every frame, up to the first in which one does not hold.
    const auto draw = [&](const BrokenAssertions& found) {
        const std::size_t before = found.size();
        for (std::size_t i = 0; i < all.size() && found.size() == before; ++i) {
            at = i;
            all[i].bring(subject);
            subject.show(all[i].time, kAssertedPlayed, [&] { return found.size() > before; });
            if (!subject.observed().is_finite()) return;
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
    std::string words;
    for (const BrokenAssertion& one : broken)
        words += fmt::format("{}{}:{}:{}: {}", words.empty() ? "" : "; ", one.file, one.line,
                             one.column, sentence_of(one));
    result.fail(words + where_words(all[at], subject));
}

}  // namespace

void add_assertion_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (!has_assertions(subject.scene())) return;
    list.push_back(
        {.name = "asserted values", .run = [](Check& check, CaseResult& result) {
             const Preset& opened = check.subject.opened();
             check_assertions({{opened.values, opened.events, opened.time}}, check, result);
         }});
    const bool has_tweaks = !subject.scene().tweaks.empty();
    list.push_back({.name = "asserted at the ranges' ends",
                    .run =
                        [](Check& check, CaseResult& result) {
                            check_assertions(
                                situations(check.subject, kAssertedSets, kAssertedSpread), check,
                                result);
                        },
                    .tweaks = has_tweaks ? Case::Tweaks::all : Case::Tweaks::none});
}

}  // namespace glint
