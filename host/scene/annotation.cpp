// The `//@` grammar.
#include "scene/annotation.h"

#include "scene/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace glint {

namespace {

constexpr int kLargestSize = 16384;  // pixels; what every desktop GL can draw into

bool is_space(char c) {
    // A backslash in a comment only joins two lines.
    return c == ' ' || c == '\t' || c == '\n' || c == '\v' || c == '\f' || c == '\\';
}

bool is_identifier(std::string_view text) {
    const auto letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    return !text.empty() && letter(text[0]) && std::all_of(text.begin(), text.end(), [&](char c) {
        return letter(c) || (c >= '0' && c <= '9');
    });
}

// Walks over an annotation's items and collects complaints.
class Words {
public:
    Words(std::string_view text, std::vector<Complaint>& complaints)
        : text_(text), complaints_(&complaints) {
        skip_space();
    }

    // A copy that looks ahead without complaining.
    Words ahead() const {
        Words copy = *this;
        copy.complaints_ = nullptr;
        return copy;
    }

    bool done() const { return at_ >= text_.size(); }
    char peek() const { return done() ? '\0' : text_[at_]; }
    std::size_t at() const { return at_; }
    std::string_view from(std::size_t begin) const { return text_.substr(begin, at_ - begin); }

    void complain(std::size_t at, std::string text) {
        if (complaints_ != nullptr) complaints_->push_back({at, std::move(text)});
    }

    void skip_space() {
        while (at_ < text_.size() && is_space(text_[at_])) ++at_;
        if (text_.substr(at_, 2) == "//") at_ = text_.size();  // an ordinary comment ends it
    }

    bool accept(char c) {
        if (peek() != c) return false;
        ++at_;
        skip_space();
        return true;
    }

    // Up to white space or one of the stops.
    std::string_view bare(std::string_view stops) {
        const std::size_t begin = at_;
        while (!done() && !is_space(text_[at_]) && stops.find(text_[at_]) == std::string_view::npos)
            ++at_;
        const std::string_view word = from(begin);
        skip_space();
        return word;
    }

    // From the quote here to the next one; all of the rest, with a complaint, when there is none.
    std::string string() {
        const std::size_t begin = at_;
        const std::size_t close = std::min(text_.find('"', begin + 1), text_.size());
        if (close == text_.size())
            complain(begin, "this text is never closed; end it with a quote, \"…\"");
        const std::string inside(text_.substr(begin + 1, close - begin - 1));
        at_ = std::min(close + 1, text_.size());
        skip_space();
        return inside;
    }

    // A quoted text or a bare one.
    std::string text() { return peek() == '"' ? string() : std::string(bare("")); }

    // What stands up to `close`, for a list in brackets that has just been opened.
    std::string_view inside(char close, std::size_t open_at) {
        const std::size_t begin = at_;
        const std::size_t end = text_.find(close, begin);
        if (end == std::string_view::npos)
            complain(open_at, fmt::format("this bracket is never closed; end it with {}", close));
        at_ = std::min(end, text_.size());
        const std::string_view list = from(begin);
        at_ = std::min(at_ + 1, text_.size());
        skip_space();
        return list;
    }

    // A value: a word, a quoted colour, or numbers with commas, in parentheses or not.
    std::string_view value() {
        const std::size_t begin = at_;
        if (peek() == '(') {
            const std::size_t close = text_.find(')', at_);
            at_ = close == std::string_view::npos ? text_.size() : close + 1;
            return finish_value(begin);
        }
        if (peek() == '"') {
            string();
            return trimmed(from(begin));
        }
        do {
            bare(",[]{}()\"");
        } while (accept(','));
        return trimmed(from(begin));
    }

private:
    std::string_view finish_value(std::size_t begin) {
        const std::string_view value = from(begin);
        skip_space();
        return value;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<Complaint>* complaints_;
};

std::vector<std::string_view> split(std::string_view list) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t comma = list.find(',', begin);
        parts.push_back(trimmed(list.substr(begin, comma - begin)));
        if (comma == std::string_view::npos) return parts;
        begin = comma + 1;
    }
}

std::string_view unquoted(std::string_view text) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = trimmed(text.substr(1, text.size() - 2));
    return text;
}

// Tweaks.

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
    std::size_t range_at = 0, log_at = 0, step_at = 0, menu_at = 0;
    bool described = false;

    bool is_number_type() const { return tweak.type != TweakType::bool1 && tweak.names.empty(); }

    void parse();
    void parse_item();
    void parse_word(std::size_t at);
    void parse_option(std::string_view key, std::size_t at);
    void parse_range();
    void parse_menu();
    void check();
    void check_number(std::optional<double> bound, std::string_view text, std::size_t at);
    std::optional<TweakValue> resolve(const Written& written, std::string_view what);
    bool in_range(const TweakValue& value) const;
};

const std::vector<std::string> kTweakWords = {"log",   "unit",    "step",
                                              "group", "quality", "reference"};

void TweakParser::parse() {
    while (!words.done()) parse_item();
    check();
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
            if (hash && !initial && parse_value(tweak, ahead.value())) {
                initial = Written{words.value(), at};
                return;
            }
            if (described) words.complain(at, "a second description; keep one");
            described = true;
            tweak.description = words.string();
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
    Words after = words;  // bare and accept never complain
    const std::string_view word = after.bare(",[]{}()\"=");
    if (after.accept('=')) {
        words = after;
        return parse_option(word, at);
    }
    if (word == "log" || word == "quality") {
        words = after;
        if (word == "log") log_at = at;
        (word == "log" ? tweak.log : tweak.quality) = true;
        return;
    }
    if (!initial) {
        initial = Written{words.value(), at};
        return;
    }
    words = after;
    words.complain(at, fmt::format("unknown word {}; known are log, quality, unit=, step=, group=, "
                                   "reference=, [min, max], {{names}} and a \"description\"{}",
                                   in_quotes(word), did_you_mean(word, kTweakWords)));
}

void TweakParser::parse_option(std::string_view key, std::size_t at) {
    const std::size_t value_at = words.at();
    const bool is_empty = words.done();
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
    } else if (key == "reference") {
        reference = Written{words.value(), value_at};
    } else {
        words.complain(at, fmt::format("unknown word {}; known are log, quality, unit=, step=, "
                                       "group= and reference={}",
                                       in_quotes(key), did_you_mean(key, kTweakWords)));
        words.text();
        return;
    }
    if (is_empty) words.complain(at, fmt::format("{}= has no value", key));
}

void TweakParser::parse_range() {
    const std::size_t at = words.at();
    words.accept('[');
    const auto bounds = split(words.inside(']', at));
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
    const auto names = split(words.inside('}', at));
    if (menu_at != 0) words.complain(at, "a second menu; keep one");
    menu_at = at + 1;
    if (tweak.type != TweakType::int1)
        return words.complain(at, "only an int has a menu; declare it as uniform int");
    for (const std::string_view name : names) {
        const std::string text(unquoted(name));
        if (text.empty())
            words.complain(at, "a name of this menu is empty; write {off, on}");
        else if (std::find(tweak.names.begin(), tweak.names.end(), text) != tweak.names.end())
            words.complain(at, fmt::format("{} stands twice in this menu", in_quotes(text)));
        tweak.names.push_back(text);
    }
}

std::optional<TweakValue> TweakParser::resolve(const Written& written, std::string_view what) {
    const auto value = parse_value(tweak, written.text);
    if (!value) {
        Tweak any = tweak;  // the range is a complaint of its own
        any.min = any.max = std::nullopt;
        words.complain(
            written.at,
            fmt::format("{} is {}; this {} is {}", what, in_quotes(written.text),
                        tweak.names.empty() ? glsl_name(tweak.type) : "menu", expected_value(any)));
    }
    return value;
}

bool TweakParser::in_range(const TweakValue& value) const {
    return !tweak.min || clamp_to_range(tweak, value) == value;
}

void TweakParser::check() {
    if (tweak.min && !is_number_type()) {
        words.complain(range_at, "a range is for numbers; take it out of this bool or menu");
        tweak.min = tweak.max = std::nullopt;
    }
    if (tweak.min && tweak.type == TweakType::int1 &&
        (*tweak.min != std::floor(*tweak.min) || *tweak.max != std::floor(*tweak.max)))
        words.complain(range_at, "the range of an int is two whole numbers");
    if (tweak.log && !is_number_type())
        words.complain(log_at, "log is for numbers; take it out of this bool or menu");
    else if (tweak.log && (!tweak.min || *tweak.min <= 0.0))
        words.complain(log_at, "log needs a range that begins above 0, such as [0.01, 100]");
    if (tweak.step > 0.0 && !is_number_type())
        words.complain(step_at, "step is for numbers; take it out of this bool or menu");
    if (tweak.step != std::floor(tweak.step) && tweak.type == TweakType::int1)
        words.complain(step_at, "the step of an int is a whole number");

    if (!initial) {
        words.complain(
            0, fmt::format("the default is missing; write {} first", expected_value(tweak)));
    } else if (const auto value = resolve(*initial, "the default")) {
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

// Samplers.

std::optional<int> parse_length(std::string_view text) {
    int length = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if (length < 1 || length > kLargestSize) return std::nullopt;
    return length;
}

// "256", "256x128", "32x32x32": as many lengths as are written, at most three.
std::optional<std::vector<int>> parse_lengths(std::string_view text) {
    std::vector<int> lengths;
    for (std::size_t begin = 0;;) {
        const std::size_t x = text.find('x', begin);
        const auto length = parse_length(text.substr(begin, x - begin));
        if (!length || lengths.size() == 3) return std::nullopt;
        lengths.push_back(*length);
        if (x == std::string_view::npos) return lengths;
        begin = x + 1;
    }
}

std::optional<int> noise_channels(std::string_view text) {
    if (text == "r" || text == "gray") return 1;
    if (text == "rg") return 2;
    if (text == "rgb") return 3;
    if (text == "rgba") return 4;
    return std::nullopt;
}

std::optional<PixelFormat> parse_format(std::string_view text) {
    if (text == "rgba8") return PixelFormat::rgba8;
    if (text == "rgba16f") return PixelFormat::rgba16f;
    if (text == "rgba32f") return PixelFormat::rgba32f;
    return std::nullopt;
}

struct SamplerParser {
    SamplerAnnotation result;
    Words words;

    void parse();
    void parse_source(std::string_view word, std::size_t at);
    void parse_target(std::string_view what);
    void parse_image();
    void parse_noise_words();
    void parse_option(std::string_view key, std::size_t at);
    void parse_pass_option(std::string_view key, std::string_view value, std::size_t at);
    void parse_size(std::string_view value, std::size_t at);
    std::vector<std::string> known_options() const;
    bool is_cube() const { return result.sampler.type == SamplerType::samplerCube; }
};

void SamplerParser::parse() {
    const std::size_t at = words.at();
    const std::string_view source = words.bare("=\"");
    parse_source(source, at);
    if (result.sampler.source == Source::none) return;
    while (!words.done()) {
        const std::size_t option_at = words.at();
        const std::string_view key = words.bare("=\"");
        if (words.accept('=') && !key.empty()) {
            parse_option(key, option_at);
            continue;
        }
        if (key.empty() && words.peek() == '"') {
            words.string();  // a description; nothing shows it
            continue;
        }
        words.complain(option_at, fmt::format("unknown word {}; known here are {}=", in_quotes(key),
                                              fmt::join(known_options(), "=, ")));
    }
    if (result.size && result.scale)
        words.complain(result.scale->at, "size and scale contradict each other; keep one");
}

void SamplerParser::parse_source(std::string_view word, std::size_t at) {
    Sampler& sampler = result.sampler;
    if (word == "pass") {
        if (sampler.type == SamplerType::sampler3D)
            return words.complain(at, "a pass fills a sampler2D or a samplerCube, no sampler3D");
        set_defaults(sampler, Source::buffer);
        return parse_target("function, such as pass mainWaves");
    }
    if (word == "buffer") {
        set_defaults(sampler, Source::buffer);
        result.reads_another = true;
        return parse_target("sampler that has the pass, such as buffer waves");
    }
    if (word == "image") {
        set_defaults(sampler, Source::image);
        return parse_image();
    }
    if (word == "noise") {
        if (sampler.type == SamplerType::samplerCube)
            return words.complain(at, "noise fills a sampler2D or a sampler3D, no samplerCube");
        set_defaults(sampler, Source::noise);
        return parse_noise_words();
    }
    if (word == "keyboard") {
        if (sampler.type != SamplerType::sampler2D)
            return words.complain(at, "the keyboard is a sampler2D");
        return set_defaults(sampler, Source::keyboard);
    }
    static const std::vector<std::string> kSources = {"pass", "buffer", "image", "noise",
                                                      "keyboard"};
    words.complain(at, fmt::format("{} fills no sampler; write pass, buffer, image, noise or "
                                   "keyboard{}",
                                   in_quotes(word), did_you_mean(word, kSources)));
}

void SamplerParser::parse_target(std::string_view what) {
    result.target_at = words.at();
    result.target = words.bare("=\"");
    if (is_identifier(result.target)) return;
    words.complain(result.target_at, fmt::format("here stands the name of a {}", what));
}

void SamplerParser::parse_image() {
    const std::size_t at = words.at();
    const std::string path = words.text();
    if (path.empty()) words.complain(at, "the image's path is missing; write image wood.png");
    result.sampler.image = path;
}

void SamplerParser::parse_noise_words() {
    const std::size_t at = words.at();
    std::string text(words.bare("=\""));
    Words ahead = words;
    const std::string_view more = ahead.bare("=\"");
    if (noise_channels(text) && !more.empty() && ahead.peek() != '=') {
        text += " " + std::string(more);
        words = ahead;
    }
    const std::string wrong = parse_noise(text, result.sampler);
    if (!wrong.empty()) words.complain(at, wrong);
}

std::vector<std::string> SamplerParser::known_options() const {
    std::vector<std::string> known = {"filter", "wrap"};
    const bool is_pass = result.sampler.source == Source::buffer && !result.reads_another;
    if (is_pass) known.insert(known.end(), {"size", "scale", "step", "format"});
    if (result.sampler.source == Source::image) known.push_back("vflip");
    return known;
}

void SamplerParser::parse_option(std::string_view key, std::size_t at) {
    const auto known = known_options();
    const std::size_t value_at = words.at();
    const std::string value = words.text();
    const auto complain = [&](std::string_view what) {
        words.complain(value_at, fmt::format("{} is {}; write {}", key, in_quotes(value), what));
    };
    if (std::find(known.begin(), known.end(), key) == known.end()) {
        words.complain(at, fmt::format("unknown word {}; known here are {}={}", in_quotes(key),
                                       fmt::join(known, "=, "), did_you_mean(key, known)));
    } else if (key == "filter") {
        if (const auto filter = parse_filter(value))
            result.sampler.filter = *filter;
        else
            complain("nearest, linear or mipmap");
    } else if (key == "wrap") {
        if (const auto wrap = parse_wrap(value))
            result.sampler.wrap = *wrap;
        else
            complain("clamp, repeat or mirror");
    } else if (key == "vflip") {
        if (const auto vflip = parse_switch(value))
            result.sampler.vflip = *vflip;
        else
            complain("on or off");
    } else {
        parse_pass_option(key, value, value_at);
    }
}

void SamplerParser::parse_pass_option(std::string_view key, std::string_view value,
                                      std::size_t at) {
    const auto complain = [&](std::string_view what) {
        words.complain(at, fmt::format("{} is {}; write {}", key, in_quotes(value), what));
    };
    if (key == "size") {
        parse_size(value, at);
    } else if (key == "scale") {
        constexpr double kLargestScale = 16.0;
        const auto scale = parse_number(value);
        if (!scale || *scale <= 0.0 || *scale > kLargestScale)
            return complain("a number above 0, at most 16");
        if (is_cube()) return words.complain(at, "a cube has no scale; write size=256");
        result.scale = Option<double>{*scale, at};
    } else if (key == "step") {
        // Shorter steps are below iTick's own, longer ones would never come.
        const auto step = parse_step(value);
        if (!step || step->seconds() < 1.0 / 65536 || step->seconds() > 3600.0)
            return complain("seconds from 1/65536 to 3600, such as 1/240");
        result.step = Option<Step>{*step, at};
    } else if (key == "format") {
        const auto format = parse_format(value);
        if (!format) return complain("rgba8, rgba16f or rgba32f");
        result.format = Option<PixelFormat>{*format, at};
    }
}

void SamplerParser::parse_size(std::string_view value, std::size_t at) {
    const auto lengths = parse_lengths(value);
    if (!lengths || lengths->size() > 2)
        return words.complain(at, fmt::format("size is {}; write 256 or 256x128, each from 1 to {}",
                                              in_quotes(value), kLargestSize));
    if (is_cube() && lengths->front() != lengths->back())
        return words.complain(at, "the faces of a cube are square; write size=256");
    result.size = Option<glm::ivec2>{{lengths->front(), lengths->back()}, at};
}

// A decimal as an exact fraction.
std::optional<Step> parse_rational(std::string_view text) {
    Step step;
    bool after_point = false, any_digit = false;
    constexpr long kLargest = 1'000'000'000;  // products of two stay exact
    for (const char c : text) {
        if (c == '.' && !after_point) {
            after_point = true;
            continue;
        }
        if (c < '0' || c > '9' || step.numerator > kLargest / 10 - 1 ||
            (after_point && step.denominator >= kLargest))
            return std::nullopt;
        any_digit = true;
        step.numerator = step.numerator * 10 + (c - '0');
        if (after_point) step.denominator *= 10;
    }
    return any_digit ? std::optional(step) : std::nullopt;
}

}  // namespace

Tweak parse_tweak(Tweak tweak, std::string_view annotation, std::vector<Complaint>& complaints) {
    TweakParser parser{.tweak = std::move(tweak),
                       .words = Words(annotation, complaints),
                       .initial = {},
                       .reference = {}};
    parser.parse();
    return parser.tweak;
}

SamplerAnnotation parse_sampler(Sampler sampler, std::string_view annotation,
                                std::vector<Complaint>& complaints) {
    SamplerParser parser{.result = {}, .words = Words(annotation, complaints)};
    parser.result.sampler = std::move(sampler);
    parser.parse();
    return parser.result;
}

std::optional<std::string> parse_group(std::string_view annotation) {
    const std::string_view text = trimmed(annotation);
    constexpr std::string_view kGroup = "group";
    if (!text.starts_with(kGroup)) return std::nullopt;
    if (text.size() > kGroup.size() && !is_space(text[kGroup.size()])) return std::nullopt;
    return std::string(unquoted(trimmed(text.substr(kGroup.size()))));
}

std::optional<Filter> parse_filter(std::string_view text) {
    if (text == "nearest") return Filter::nearest;
    if (text == "linear") return Filter::linear;
    if (text == "mipmap") return Filter::mipmap;
    return std::nullopt;
}

std::optional<Wrap> parse_wrap(std::string_view text) {
    if (text == "clamp") return Wrap::clamp;
    if (text == "repeat") return Wrap::repeat;
    if (text == "mirror") return Wrap::mirror;
    return std::nullopt;
}

std::optional<Step> parse_step(std::string_view text) {
    const std::size_t slash = text.find('/');
    const auto above = parse_rational(text.substr(0, slash));
    auto below = std::optional<Step>(Step{1, 1});
    if (slash != std::string_view::npos) below = parse_rational(text.substr(slash + 1));
    if (!above || !below || below->numerator == 0 || above->numerator == 0) return std::nullopt;
    Step step{above->numerator * below->denominator, above->denominator * below->numerator};
    const long common = std::gcd(step.numerator, step.denominator);
    return Step{step.numerator / common, step.denominator / common};
}

std::string parse_noise(std::string_view text, Sampler& sampler) {
    text = trimmed(text);
    const bool is_volume = sampler.type == SamplerType::sampler3D;
    const std::string how = is_volume ? "write noise rgba 32 or noise r 32x32x32"
                                      : "write noise rgba 256 or noise r 256x128";
    const std::size_t space = text.find(' ');
    std::string_view size = text;
    if (const auto channels = noise_channels(text.substr(0, space))) {
        sampler.noise_channels = *channels;
        size = space == std::string_view::npos ? std::string_view() : trimmed(text.substr(space));
    }
    if (size.empty()) return fmt::format("the size of the noise is missing; {}", how);
    const auto lengths = parse_lengths(size);
    const std::size_t dimensions = is_volume ? 3 : 2;
    if (!lengths || (lengths->size() != 1 && lengths->size() != dimensions))
        return fmt::format("{} is no noise; {}, each from 1 to {}", in_quotes(text), how,
                           kLargestSize);
    const bool one = lengths->size() == 1;
    const glm::ivec3 pixels(lengths->front(), (*lengths)[one ? 0 : 1],
                            is_volume ? lengths->back() : 1);
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;
    if (std::int64_t{pixels.x} * pixels.y > kMostPixels / pixels.z)
        return fmt::format("{} is more noise than memory can hold; write less", in_quotes(text));
    sampler.noise_size = pixels;
    return {};
}

void set_defaults(Sampler& sampler, Source source) {
    const bool is_cube = sampler.type == SamplerType::samplerCube;
    const bool is_picture = source == Source::image || source == Source::noise;
    sampler.source = source;
    sampler.filter = source == Source::keyboard ? Filter::nearest
                     : is_picture               ? Filter::mipmap
                                                : Filter::linear;
    sampler.wrap = is_picture && !is_cube ? Wrap::repeat : Wrap::clamp;
    sampler.vflip = !is_cube;
}

}  // namespace glint
