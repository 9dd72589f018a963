// What the scene's own text asserts: `//@ assert t >= 0.0 "behind the eye"`.
#include "measure/check/case.h"
#include "measure/probe/assertions.h"

#include <fmt/format.h>

namespace glint {
namespace {

constexpr double kAssertedPlayed = 2.0;  // s of a simulation

void check_assertions(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    // Of a simulation every frame, up to the first in which one does not hold.
    const double time = subject.stateful() ? kAssertedPlayed : subject.opened().time;
    const auto draw = [&](const BrokenAssertions& found) {
        const std::size_t before = found.size();
        subject.show(time, kAssertedPlayed, [&] { return found.size() > before; });
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
    result.fail(all);
}

}  // namespace

void add_assertion_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (has_assertions(subject.scene()))
        list.push_back({.name = "asserted values", .run = check_assertions});
}

}  // namespace glint
