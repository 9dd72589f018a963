#include "render/consequences.h"

#include "render/advice.h"
#include "render/syntax_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <span>
#include <string>
#include <utility>

namespace glint {
namespace {

constexpr std::string_view kOtherResult = "return type doesn't match prototype";

// The type of the first of what stands between brackets: `texture(sampler2D, vec3)'.
std::string_view first_type(std::string_view call) {
    const std::size_t open = std::min(call.find('('), call.size() - 1);
    return call.substr(open + 1, call.find_first_of(",)", open) - open - 1);
}

// Mesa gives what it does not understand no type, and then complains of each expression round it,
// all of which stand behind that complaint and begin no later in the text; in a macro they may
// begin at an argument.
bool is_consequence(const Diagnostic& one, const Diagnostic& cause) {
    static const std::regex words(
        "^operands? (to|of) |^type mismatch$|^cannot construct |^condition of |condition must be "
        "scalar|"
        "[(, ]error[,)]|of type error$|with wrong type error,|convert error to |^[LR]HS of .* must "
        "be |^second and third operands|^array size must be|^array index must be|"
        "^switch-statement expression|must be a constant expression|[(]error vs |found error$|"
        "^unknown method: ");
    const Place &at = one.place, &before = cause.place;
    const bool encloses =
        at.file == before.file && at.column > 0 &&
        (at.line < before.line || (at.line == before.line && at.column <= before.column) ||
         (at.line == before.line && cause.text.find(kInMacro) != std::string::npos));
    return one.severity == Severity::error && encloses &&
           std::regex_search(
               one.text.substr(0, std::min(one.text.find('\n'), one.text.find(kInMacro))), words);
}

// Complaints of Mesa's about what it could not make of the mistake that it told before, in the same
// declaration: whose type, or name, stands no later.
struct Repeated {
    std::string_view cause, consequence;
    bool is_behind = false;  // it may stand later, too
};
constexpr Repeated kRepeated[] = {
    {"array constructor must have", "unsized array declarations"},
    {"array size must be", "unsized array declarations"},
    {"array size must be", "arrays passed as parameters must"},
    {"arrays passed as parameters must", "type mismatch", true},
    // What has no first value has one of ours.
    {"redeclaration of `", "initializer of type", true},
    {"redeclaration of `", "cannot initialize uniform", true},
    {"image/sampler variables may only", "opaque variables must be", true},
    {"image/sampler variables may only", "cannot initialize", true},
    {"image/sampler variables may only", "what stands left of this '='", true},
    {"what stands left of this '='", "value of type"},
    {"a macro's name begins with", "a name or the line's end"},
    {"operand of `!' must be", "initializer of type bool"},
    {"operand of `!' must be", "value of type bool"},
    {"Macro names starting with", "Redefinition of macro"},
    {kNoName, "this is not expected here; behind #if", true},
};

// A call of what the text was not allowed to define.
bool calls_refused(const Diagnostic& one, const Diagnostic& cause) {
    constexpr std::string_view kCall = "no matching function for call to `";
    constexpr std::string_view kRefused = "cannot redefine or overload built-in function `";
    constexpr std::string_view kVariable = "function name `",
                               kNoFunction = "no function with name '";
    if (cause.text.starts_with(kVariable) && one.text.starts_with(kNoFunction)) {
        const std::string_view name = std::string_view(cause.text).substr(kVariable.size());
        return std::string_view(one.text)
            .substr(kNoFunction.size())
            .starts_with(name.substr(0, name.find('\'') + 1));
    }
    if (cause.text.starts_with("arrays passed as parameters must") && one.text.starts_with(kCall))
        return one.text.find("error)") != one.text.npos || one.text.find("error,") != one.text.npos;
    const std::size_t at = cause.text.find(kRefused);
    if (at == cause.text.npos || !one.text.starts_with(kCall)) return false;
    const std::string_view name = std::string_view(cause.text).substr(at + kRefused.size());
    return std::string_view(one.text)
        .substr(kCall.size())
        .starts_with(std::string(name.substr(0, name.find('\''))) + "(");
}

bool is_repeated(const Diagnostic& one, const Diagnostic& cause) {
    const bool hides_end = cause.text.starts_with("Illegal non-directive") ||
                           cause.text.starts_with("the line ends too soon") ||
                           cause.text == kNoName || cause.text == kNoCondition ||
                           cause.text.ends_with(kConditionBehind);
    if (hides_end && one.text == "Unterminated #if") return true;
    if (one.place.file != cause.place.file || one.place.line != cause.place.line) return false;
    const bool is_other_head = cause.text.find(kOtherResult) != cause.text.npos ||
                               cause.text.ends_with("' qualifiers don't match prototype");
    if (is_other_head)
        return one.text.ends_with("' redefined") ||
               one.text.starts_with("`return' with wrong type");
    const bool is_before = one.place.column <= cause.place.column;
    if (cause.text.find("' redeclared") != cause.text.npos)
        return one.text.starts_with("cannot initialize uniform") ||
               one.text.starts_with("assignment to read-only variable");
    if (is_before && one.text == cause.text) return true;
    return std::ranges::any_of(kRepeated, [&](const Repeated& both) {
        return (is_before || both.is_behind) && cause.text.starts_with(both.cause) &&
               one.text.starts_with(both.consequence);
    });
}

// What belongs to the complaint before.
bool is_note(std::string_view said) {
    return said == "this is the previous case label" || said == "this is the first default label";
}

bool is_of_unsized(std::string_view said) {
    return said == "unsized array index must be constant" || said.starts_with("length called on ");
}

// Where the candidates say nothing of the mistake.
std::string why_none_fits(const std::string& call, std::span<const Diagnostic> candidates) {
    constexpr std::string_view kCall = "no matching function for call to `";
    if (!call.starts_with(kCall) || !call.ends_with(kCandidates)) return "";
    const std::string given = call.substr(kCall.size(), call.find('\'') - kCall.size());
    const auto samples = [](const Diagnostic& one) {
        return first_type(one.text).find("sampler") != std::string_view::npos;
    };
    if (!candidates.empty() && std::ranges::all_of(candidates, samples) &&
        first_type(given).find("sampler") == std::string_view::npos)
        return "its first argument has to be a sampler, such as iChannel0";
    const auto is_called = [&](const Diagnostic& one) { return one.text.ends_with(" " + given); };
    if (std::ranges::any_of(candidates, is_called))
        return "a variable of that name hides the function here; give it another";
    return "";
}

// "(int, vec2)" of "f(int, vec2)".
std::string arguments_in(std::string_view call) {
    const std::size_t open = std::min(call.find('('), call.size());
    return std::string(call.substr(open, call.find(')', open) + 1 - open));
}

// Whether a candidate takes what a call gives once its whole numbers are floats.
bool would_take(const std::string& call, const std::string& candidate) {
    static const std::regex whole(R"(\bint\b)");
    const std::string given = arguments_in(call);
    return !given.empty() && given.find("int") != given.npos && call.ends_with(kCandidates) &&
           call.find(kNoChange) == call.npos &&
           std::regex_replace(given, whole, "float") == arguments_in(candidate);
}

constexpr std::string_view kIdleComma = "left-hand operand of comma expression has no effect";
constexpr std::string_view kLastAlone = "; of numbers in brackets the last alone counts: write ";

// Whether both stand on one line.
bool are_beside(const Diagnostic& one, const Diagnostic& other) {
    return one.place.file == other.place.file && one.place.line == other.place.line;
}

}  // namespace

// Of `c = (1.0, 0.0, 0.0, 1.0);` Mesa warns thrice before it complains.
Diagnostics with_vectors_named(Diagnostics list) {
    static const std::regex said(
        R"(^(?:value|initializer) of type (?:float|int) cannot be assigned to variable of type (vec[234])$)");
    std::smatch m;
    for (Diagnostic& one : list) {
        if (!std::regex_match(one.text, m, said)) continue;
        const std::string type = m[1];
        const bool has_commas = std::ranges::any_of(list, [&](const Diagnostic& other) {
            return other.text == kIdleComma && are_beside(one, other);
        });
        one.text += has_commas ? fmt::format("{}{}(\u2026)", kLastAlone, type)
                               : fmt::format("; write {}(x)", type);
    }
    const auto is_told = [&](const Diagnostic& warning) {
        return warning.text == kIdleComma && std::ranges::any_of(list, [&](const Diagnostic& one) {
                   return one.text.find(kLastAlone) != one.text.npos && are_beside(one, warning);
               });
    };
    Diagnostics left;
    std::ranges::remove_copy_if(list, std::back_inserter(left), is_told);
    return left;
}

// Mesa makes an error of its own of each function that a call could have meant, whatever its
// samplers: 47 for texture(). They join the call's, those alone that take what it gives first.
Diagnostics with_candidates_joined(Diagnostics list) {
    Diagnostics joined;
    for (std::size_t i = 0; i < list.size();) {
        const std::size_t call = i++;
        const Place& place = list[call].place;
        const auto is_candidate = [&](const Diagnostic& one) {
            return one.place.line == place.line && one.place.column == place.column &&
                   one.text.ends_with(')');
        };
        if (list[call].text.ends_with(kCandidates))
            while (i < list.size() && is_candidate(list[i])) ++i;
        const auto begin = list.begin() + static_cast<std::ptrdiff_t>(call) + 1;
        const auto end = list.begin() + static_cast<std::ptrdiff_t>(i);
        const std::string given(first_type(list[call].text));
        const auto fits = [&](const Diagnostic& one) { return first_type(one.text) == given; };
        const bool any_fits = std::any_of(begin, end, fits);
        const std::string why = why_none_fits(list[call].text, {begin, end});
        joined.push_back(std::move(list[call]));
        if (!why.empty()) {
            std::string& text = joined.back().text;
            text.replace(text.size() - kCandidates.size(), kCandidates.size(), "; " + why);
            continue;
        }
        if (std::any_of(begin, end, [&](const Diagnostic& one) {
                return would_take(joined.back().text, one.text);
            }))
            joined.back().text.insert(joined.back().text.size() - kCandidates.size(),
                                      fmt::format("{}1.0 for 1, or float(i)", kNoChange));
        for (auto one = begin; one != end; ++one)
            if (!any_fits || fits(*one))
                joined.back().text += "\n    " + one->text.substr(0, one->text.find(kInMacro));
    }
    return joined;
}

// Of a text with an error Mesa also warns that what should hold its value has none.
Diagnostics without_consequences(const Diagnostics& list) {
    Diagnostics left;
    const bool fails = has_errors(list);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Diagnostic& one = list[i];
        const std::string_view said = std::string_view(one.text).substr(0, one.text.find(kInMacro));
        if (fails && said.ends_with("' used uninitialized")) continue;
        if (said.ends_with(kAgain)) continue;
        if (is_note(said)) continue;
        const auto is_same = [&](const Diagnostic& told) {
            return said.size() < one.text.size() && told.text == one.text;
        };
        if (std::ranges::any_of(left, is_same))
            continue;  // a macro's mistake, told at its first use
        // Of an array that has no size, for the sake of its declaration.
        if (!left.empty() && has_errors(left) && is_of_unsized(said)) continue;
        // Behind a word that no text may have Mesa understands nothing.
        const bool is_behind_reserved = !left.empty() && one.place.line == left.back().place.line &&
                                        left.back().text.starts_with("illegal use of reserved");
        if (is_behind_reserved) continue;
        const auto causes = [&](const Diagnostic& cause) {
            return cause.severity == Severity::error &&
                   (is_consequence(one, cause) || is_repeated(one, cause) ||
                    calls_refused(one, cause));
        };
        if (std::none_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), causes))
            left.push_back(one);
    }
    return left;
}

}  // namespace glint
