#include "glsl/foreign_file.h"

#include "base/diagnostic.h"
#include "base/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace glint {
namespace {

std::string unquoted(const Token& token) {
    return std::string(token.text.substr(1, token.text.size() - 2));
}

// Walks over what follows `#iUniform`.
class UniformWords {
public:
    explicit UniformWords(std::span<const Token> tokens) : tokens_(tokens) {}

    bool take(std::string_view word) {
        const bool found = !done() && tokens_[at_].is(word);
        at_ += found;
        return found;
    }
    bool done() const { return at_ == tokens_.size(); }
    std::string_view name() {
        return !done() && tokens_[at_].is_word() ? tokens_[at_++].text : std::string_view();
    }
    // `1.0`, `-1.0`, `true`, and a list of these.
    std::string number() {
        std::string text(take("-") ? "-" : "");
        if (text.empty()) take("+");
        const bool is_number =
            !done() && (tokens_[at_].kind == TokenKind::number || tokens_[at_].is_word());
        return is_number ? text += tokens_[at_++].text : std::string();
    }
    std::vector<std::string> list() {
        std::vector<std::string> numbers = {number()};
        while (take(",")) numbers.push_back(number());
        return numbers;
    }
    // A number, or `vec3(…)`.
    std::vector<std::string> value() {
        const bool has_brackets = at_ + 1 < tokens_.size() && tokens_[at_ + 1].is("(");
        if (!has_brackets) return {number()};
        at_ += 2;
        std::vector<std::string> numbers = list();
        if (!take(")")) numbers = {""};
        return numbers;
    }
    // `{ 0.0, 5.0 }` or `[…]`, also of `vec2(…)`: the least and the most of all components. Empty
    // where it is none.
    std::vector<std::string> range() {
        const std::string_view end = take("{") ? "}" : take("[") ? "]" : "";
        const std::vector<std::string> low = value();
        const bool has_two = take(",");
        const std::vector<std::string> high = has_two ? value() : low;
        if (end.empty() || !has_two || !take(end)) return {};
        const auto by_value = [](const std::string& text) {
            return parse_number(text).value_or(0);
        };
        return {*std::ranges::min_element(low, {}, by_value),
                *std::ranges::max_element(high, {}, by_value)};
    }

private:
    std::span<const Token> tokens_;
    std::size_t at_ = 0;
};

}  // namespace

bool is_channel(std::string_view word) {
    return word.size() == 9 && word.starts_with("iChannel") && word[8] >= '0' && word[8] <= '3';
}

ForeignFile::ForeignFile(std::string_view text, const Known& known)
    : text_(text), read_(preprocess(text_, known)) {
    for (std::size_t at = 0; at < text_.size(); at = text_.find('\n', at) + 1)
        line_begins_.push_back(at);
    for (const Directive& directive : read_.directives) {
        if (directive.live == Live::no) continue;
        const auto after = std::ranges::upper_bound(line_begins_, directive.span.begin);
        directives_.emplace(static_cast<int>(after - line_begins_.begin()), &directive);
    }
}

std::string ForeignFile::line(int number) const {
    const std::size_t begin = line_begins_[static_cast<std::size_t>(number) - 1];
    return text_.substr(begin, text_.find('\n', begin) - begin);
}

std::span<const Token> ForeignFile::rest(const Directive& directive) const {
    return std::span(read_.written).subspan(directive.rest.begin, directive.rest.size());
}

// `#iChannel0 "file.png"`, `#iChannel0::WrapMode "Repeat"`.
ForeignChannels ForeignFile::channels() const {
    ForeignChannels channels;
    for (const auto& [line, directive] : directives_) {
        const std::span<const Token> rest = this->rest(*directive);
        const bool has_option = rest.size() > 3 && rest[0].is(":") && rest[1].is(":");
        const std::size_t quoted = has_option ? 3 : 0;
        if (!is_channel(directive->word) || quoted >= rest.size() ||
            rest[quoted].kind != TokenKind::quoted)
            continue;
        ForeignChannel& channel = channels[static_cast<std::size_t>(directive->word[8] - '0')];
        const std::string value = unquoted(rest[quoted]);
        const std::string_view option = has_option ? rest[2].text : "";
        if (option.empty()) channel.line = line, channel.source = value;
        if (option == "MinFilter") channel.min_filter = value;
        if (option == "MagFilter") channel.mag_filter = value;
        if (option == "WrapMode") channel.wrap = value;
        if (option == "Type") channel.type = value;
    }
    return channels;
}

std::string ForeignFile::why_nothing_is_said(const Directive& channel) const {
    const std::vector<std::string> filters = {"Nearest",
                                              "Linear",
                                              "NearestMipMapNearest",
                                              "LinearMipMapNearest",
                                              "NearestMipMapLinear",
                                              "LinearMipMapLinear"};
    const std::map<std::string, std::vector<std::string>> known = {
        {"MinFilter", filters},
        {"MagFilter", {"Nearest", "Linear"}},
        {"WrapMode", {"Repeat", "Clamp", "Mirror"}},
        {"Type", {"Texture2D", "CubeMap"}}};
    const std::span<const Token> rest = this->rest(channel);
    const bool has_option = rest.size() > 2 && rest[0].is(":") && rest[1].is(":");
    const std::string option(has_option ? rest[2].text : "");
    const std::size_t at = has_option ? 3 : 0;
    if (has_option && !known.contains(option)) {
        std::vector<std::string> names;
        for (const auto& [name, values] : known) names.push_back(name);
        return fmt::format("unknown option {}; known are {}{}", in_quotes(option),
                           fmt::join(names, ", "), did_you_mean(option, names));
    }
    if (at >= rest.size()) return "";
    if (rest[at].kind != TokenKind::quoted)
        return fmt::format("what fills a channel stands in quotes: #{}{} \"{}\"", channel.word,
                           has_option ? "::" + option : "", rest[at].text);
    const std::string value = unquoted(rest[at]);
    if (!has_option || std::ranges::find(known.at(option), value) != known.at(option).end())
        return "";
    return fmt::format("{} is no {}; known are {}{}", in_quotes(value), option,
                       fmt::join(known.at(option), ", "), did_you_mean(value, known.at(option)));
}

std::optional<ForeignUniform> ForeignFile::uniform(const Directive& directive) const {
    UniformWords words(rest(directive));
    ForeignUniform uniform;
    uniform.type = words.name();
    uniform.name = words.name();
    if (uniform.name.empty()) return std::nullopt;
    const bool has_value = words.take("=");
    if (has_value) uniform.value = words.value();
    words.take(";");
    if (words.take("in") && (uniform.range = words.range()).empty()) return std::nullopt;
    if (!has_value) uniform.value = {uniform.range.empty() ? "0" : uniform.range.front()};
    if (words.take("step") && (uniform.step = words.value().front()).empty()) return std::nullopt;
    words.take(";");
    const auto is_empty = [](const std::string& text) { return text.empty(); };
    if (!words.done() || std::ranges::any_of(uniform.value, is_empty) ||
        std::ranges::any_of(uniform.range, is_empty))
        return std::nullopt;
    uniform.description = comment_in(directive.span);
    return uniform;
}

// What is said behind `//` on a directive's line.
std::string ForeignFile::comment_in(Span span) const {
    for (const Comment& comment : read_.comments) {
        if (!comment.is_line || comment.span.begin < span.begin || comment.span.begin > span.end)
            continue;
        return std::string(trimmed(std::string_view(text_).substr(
            comment.span.begin + 2, comment.span.end - comment.span.begin - 2)));
    }
    return {};
}

}  // namespace glint
