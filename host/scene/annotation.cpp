// The `//@` grammar of tweaks and group headings.
#include "scene/annotation.h"

#include "base/words.h"
#include "glsl/token.h"
#include "scene/annotation_words.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>

namespace glint {

namespace {

// Words are kept with their places until all is read: a default's meaning depends on the menu that
// follows it.
struct Written {
    std::string_view text;
    std::size_t at = 0;
};

struct TweakParser {
    Tweak tweak;
    Words words;
    std::optional<Written> initial, reference;
    std::size_t safe_at = 0, range_at = 0, log_at = 0, step_at = 0, menu_at = 0;
    bool described = false, has_no_default = false;  // the latter as is told
    std::unordered_set<std::string_view> options;    // those seen

    bool is_number_type() const { return tweak.type != TweakType::bool1 && tweak.names.empty(); }

    void parse();
    void parse_item();
    void parse_word(std::size_t at);
    void parse_option(std::string_view key, std::size_t at, bool is_empty);
    void parse_range();
    void parse_menu();
    void check();
    std::optional<TweakValue> resolve(const Written& written, std::string_view what);
    bool in_range(const TweakValue& value) const;
    bool is_safe_within() const;
    bool is_name_of_menu() const;
};

constexpr std::array<std::string_view, 3> kAlone = {"log", "quality", "norandom"};
const std::vector<std::string> kTweakWords = {"log",      "unit",      "step",   "group", "quality",
                                              "norandom", "reference", "second", "safe"};

constexpr const char* kSafeOfMenu =
    "safe is a part of the menu; write safe=[0, 1] for the first two of its names";

constexpr std::string_view kConstructors[] = {"float", "int",  "bool", "vec2",
                                              "vec3",  "vec4", "uint"};

void TweakParser::parse() {
    while (!words.done()) parse_item();
    check();
}

// Whether what stands in quotes here is one of the names that the menu behind it has.
bool TweakParser::is_name_of_menu() const {
    Words ahead = words.ahead();
    const std::string name = ahead.quoted_text();
    while (!ahead.done() && ahead.peek() != '{') {
        if (ahead.peek() == '"')
            ahead.quoted_text();
        else if (ahead.bare("{\"").empty())
            ahead.accept(ahead.peek());
    }
    if (tweak.type != TweakType::int1 || !ahead.accept('{')) return false;
    const auto names = ahead.list('}', 0);
    return names && std::ranges::any_of(split(*names), [&](std::string_view one) {
               return unquoted(one) == trimmed(name);
           });
}

void TweakParser::parse_item() {
    const std::size_t at = words.at();
    switch (words.peek()) {
        case '[':
            return parse_range();
        case '{':
            return parse_menu();
        case '"': {
            const bool hash = tweak.type == TweakType::vec3 || tweak.type == TweakType::vec4;
            Words ahead = words.ahead();
            if (!initial && ((hash && parse_value(tweak, ahead.value())) || is_name_of_menu())) {
                initial = Written{words.value(), at};
                return;
            }
            if (described) words.complain(at, "a second description; keep one");
            described = true;
            tweak.description = words.quoted_text();
            return;
        }
        case '(':
            if (initial) words.complain(at, "a second default; keep one");
            initial = Written{words.value(), at};
            return;
        case ']':
        case '}':
        case ')':
        case ',':
        case '=':
            words.complain(at, fmt::format("'{}' has nothing to stand for here", words.peek()));
            words.accept(words.peek());
            return;
        default:
            return parse_word(at);
    }
}

void TweakParser::parse_word(std::size_t at) {
    Words after = words;  // bare and equals never complain
    const std::string_view word = after.bare(",[]{}()\"=");
    if (const auto equals = after.equals(); equals != Words::Equals::none) {
        words = after;
        return parse_option(word, at, equals == Words::Equals::alone);
    }
    if (is_one_of(word, kAlone)) {
        words = after;
        if (word == "log") log_at = at;
        (word == "log" ? tweak.log : word == "quality" ? tweak.quality : tweak.no_random) = true;
        return;
    }
    if (!initial && is_one_of(word, kFillers) &&
        words.ahead().rest().find('{') == std::string::npos) {
        words.complain(
            at, fmt::format("{} fills a sampler; declare one, such as uniform sampler2D", word));
        words.rest();
        has_no_default = true;
        return;
    }
    if (!initial && after.peek() == '(' && is_one_of(word, kConstructors)) {
        words = after;
        words.value();
        words.complain(at, fmt::format("a default is numbers alone; write {} without {}",
                                       expected_value(tweak), in_quotes(word)));
        has_no_default = true;
        return;
    }
    if (!initial) {
        initial = Written{words.value(), at};
        return;
    }
    words = after;
    constexpr std::array<std::string_view, 6> kWithValue = {"unit",      "step",   "group",
                                                            "reference", "second", "safe"};
    if (is_one_of(word, kWithValue))
        return words.complain(at, fmt::format("{0} has no value; write {0}= and what it is", word));
    words.warn(
        at, fmt::format("unknown word {}; known are log, quality, norandom, unit=, step=, group=, "
                        "reference=, second=, safe=, [min, max], {{names}} and a \"description\"{}",
                        in_quotes(word), did_you_mean(word, kTweakWords)));
}

void TweakParser::parse_option(std::string_view key, std::size_t at, bool is_empty) {
    const std::size_t value_at = words.at();
    if (!options.insert(key).second) words.complain(at, fmt::format("a second {}=; keep one", key));
    constexpr std::string_view kKeys[] = {"unit", "group", "second", "safe", "reference"};
    if (is_empty && is_one_of(key, kKeys))
        return words.complain(at, fmt::format("{0}= has no value; write it right behind, as in "
                                              "{0}={1}",
                                              key, key == "unit" ? "m" : "…"));
    if (key == "unit") {
        tweak.unit = words.text();
    } else if (key == "group") {
        tweak.group = words.text();
    } else if (key == "step") {
        step_at = value_at;
        const std::string_view text = words.bare("");
        const auto step = parse_number(text);
        if (!step || *step <= 0.0)
            words.complain(value_at,
                           fmt::format("step is {}; write a number above 0", in_quotes(text)));
        tweak.step = step.value_or(0.0);
        return;
    } else if (key == "second") {
        tweak.second = words.text();
    } else if (key == "safe") {
        safe_at = value_at;
        if (words.accept('[')) {
            const auto inside = words.list(']', value_at);
            if (!inside) return;
            tweak.safe = parse_bounds(*inside);
        } else {
            words.text();
        }
        if (!tweak.safe)
            words.complain(value_at, tweak.names.empty() ? "safe is two numbers, the smaller "
                                                           "first; write safe=[0, 0.8]"
                                                         : kSafeOfMenu);
        return;
    } else if (key == "reference") {
        reference = Written{words.value(), value_at};
    } else if (is_one_of(key, kAlone)) {
        words.complain(at, fmt::format("{0} has no value; write {0} alone", key));
        words.text();
    } else {
        words.warn(at, fmt::format("unknown word {}; known are log, quality, norandom, unit=, "
                                   "step=, group=, reference=, second= and safe={}",
                                   in_quotes(key), did_you_mean(key, kTweakWords)));
        words.text();
    }
}

void TweakParser::parse_range() {
    const std::size_t at = words.at();
    words.accept('[');
    const auto inside = words.list(']', at);
    if (!inside) return;
    const auto bounds = split(*inside);
    if (tweak.min) words.complain(at, "a second range; keep one");
    range_at = at;
    const auto min = parse_number(bounds.front());
    const auto max = parse_number(bounds.back());
    if (bounds.size() != 2 || !min || !max || std::abs(*min) > std::numeric_limits<float>::max() ||
        std::abs(*max) > std::numeric_limits<float>::max())
        return words.complain(at, "a range is two finite numbers; write it as [0, 1]");
    if (*min > *max)
        return words.complain(at, fmt::format("the range is upside down; write [{}, {}]",
                                              bounds.back(), bounds.front()));
    tweak.min = min;
    tweak.max = max;
}

void TweakParser::parse_menu() {
    const std::size_t at = words.at();
    words.accept('{');
    const auto inside = words.list('}', at);
    if (!inside) return;
    const auto names = split(*inside);
    if (menu_at != 0) words.complain(at, "a second menu; keep one");
    menu_at = at + 1;
    if (tweak.type != TweakType::int1)
        return words.complain(at, "only an int has a menu; declare it as uniform int");
    std::unordered_set<std::string_view> known;
    for (const std::string_view name : names) {
        const std::string_view text = unquoted(name);
        if (text.empty())
            words.complain(at, "a name of this menu is empty; write {off, on}");
        else if (!known.insert(text).second)
            words.complain(at, fmt::format("{} stands twice in this menu", in_quotes(text)));
        tweak.names.emplace_back(text);
    }
}

std::optional<TweakValue> TweakParser::resolve(const Written& written, std::string_view what) {
    const auto value = parse_value(tweak, unquoted(written.text));
    if (!value) {
        Tweak any = tweak;  // the range is a complaint of its own
        any.min = any.max = std::nullopt;
        words.complain(
            written.at,
            fmt::format("{} is {}; this {} is {}{}", what, in_quotes(written.text),
                        tweak.names.empty() ? glsl_name(tweak.type) : "menu", expected_value(any),
                        parse_number(written.text)
                            ? ""
                            : did_you_mean(unquoted(written.text), tweak.names)));
    }
    return value;
}

bool TweakParser::in_range(const TweakValue& value) const {
    return !tweak.min || clamp_to_range(tweak, value) == value;
}

// Of a menu the names are counted from 0, as its default is.
bool TweakParser::is_safe_within() const {
    const auto [first, last] = *tweak.safe;
    if (tweak.names.empty()) return tweak.min && first >= *tweak.min && last <= *tweak.max;
    return first >= 0.0 && last < static_cast<double>(tweak.names.size()) &&
           first == std::floor(first) && last == std::floor(last);
}

void TweakParser::check() {
    if (tweak.min && !is_number_type()) {
        words.complain(range_at, "a range is for numbers; take it out of this bool or menu");
        tweak.min = tweak.max = std::nullopt;
    }
    constexpr double kLeastInt = std::numeric_limits<std::int32_t>::min(),
                     kLargestInt = std::numeric_limits<std::int32_t>::max();
    if (tweak.min && tweak.type == TweakType::int1 &&
        (*tweak.min != std::floor(*tweak.min) || *tweak.max != std::floor(*tweak.max) ||
         *tweak.min < kLeastInt || *tweak.max > kLargestInt))
        words.complain(range_at,
                       "the range of an int is two whole numbers, from -2147483648 to 2147483647");
    if (tweak.safe && !is_safe_within())
        words.complain(safe_at, tweak.names.empty()
                                    ? "safe is a part of the range; write it within [min, max]"
                                    : kSafeOfMenu);
    if (tweak.log && !is_number_type())
        words.complain(log_at, "log is for numbers; take it out of this bool or menu");
    else if (tweak.log && (!tweak.min || *tweak.min <= 0.0))
        words.complain(log_at, "log needs a range that begins above 0, such as [0.01, 100]");
    if (tweak.step > 0.0 && !is_number_type())
        words.complain(step_at, "step is for numbers; take it out of this bool or menu");
    if (tweak.step != std::floor(tweak.step) && tweak.type == TweakType::int1)
        words.complain(step_at, "the step of an int is a whole number");

    if (!initial && !has_no_default) {
        words.complain(
            0, fmt::format("the default is missing; write {} first", expected_value(tweak)));
    } else if (const auto value = initial ? resolve(*initial, "the default") : std::nullopt) {
        tweak.initial = *value;
        tweak.is_colour = unquoted(initial->text).starts_with('#');
        if (!in_range(*value))
            words.complain(
                initial->at,
                fmt::format("the default {} is outside [{}, {}]; move one of them", initial->text,
                            format_number(*tweak.min), format_number(*tweak.max)));
    }
    if (reference) tweak.reference = resolve(*reference, "reference");
}

}  // namespace

Tweak parse_tweak(Tweak tweak, std::string_view annotation, std::vector<Complaint>& complaints) {
    TweakParser parser{.tweak = std::move(tweak),
                       .words = Words(annotation, complaints),
                       .initial = {},
                       .reference = {},
                       .options = {}};
    parser.parse();
    return parser.tweak;
}

std::optional<std::string> parse_group(std::string_view annotation) {
    const std::string_view text = trimmed(annotation);
    constexpr std::string_view kGroup = "group";
    if (!text.starts_with(kGroup)) return std::nullopt;
    if (text.size() > kGroup.size() && text[kGroup.size()] != ' ' && text[kGroup.size()] != '\t')
        return std::nullopt;
    return std::string(unquoted(trimmed(text.substr(kGroup.size()))));
}

}  // namespace glint
