// Taking an annotation apart.
#include "scene/annotation_words.h"

#include "base/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace glint {

namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\v' || c == '\f';
}

// Where a name begins with a quote that is closed the signs in it are its own.
std::size_t find_outside_quotes(std::string_view text, char sign, std::size_t from) {
    bool begins = true;
    for (std::size_t at = from; at < text.size(); ++at) {
        if (text[at] == sign) return at;
        const std::size_t close =
            begins && text[at] == '"' ? text.find('"', at + 1) : std::string_view::npos;
        begins = text[at] == ',' || (begins && is_space(text[at]));
        if (close != text.npos) at = close;
    }
    return text.npos;
}

}  // namespace

Words::Words(std::string_view text, std::vector<Complaint>& complaints)
    : text_(text), complaints_(&complaints) {
    skip_space();
}

Words Words::ahead() const {
    Words copy = *this;
    copy.complaints_ = nullptr;
    return copy;
}

void Words::add(Complaint complaint) {
    constexpr std::size_t kMost = 20;  // of one annotation; nobody reads on
    if (!complaints_) return;
    if (complaints_->size() < kMost)
        complaints_->push_back(std::move(complaint));
    else if (complaint.severity == Severity::error)  // without which the line would count
        complaints_->back() = std::move(complaint);
}

void Words::skip_space() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (text_.substr(at_, 2) == "//") at_ = text_.size();  // an ordinary comment ends it
}

bool Words::accept(char c) {
    if (peek() != c) return false;
    ++at_;
    skip_space();
    return true;
}

Words::Equals Words::equals() {
    const bool is_spaced = at_ > 0 && is_space(text_[at_ - 1]);
    if (peek() != '=') return Equals::none;
    const std::size_t behind = at_ + 1;
    accept('=');
    return done() || (!is_spaced && at_ > behind) ? Equals::alone : Equals::with_value;
}

std::string_view Words::bare(std::string_view stops) {
    const std::size_t begin = at_;
    while (!done() && !is_space(text_[at_]) && stops.find(text_[at_]) == std::string_view::npos)
        ++at_;
    const std::string_view word = from(begin);
    skip_space();
    return word;
}

std::string Words::quoted_text() {
    const std::size_t begin = at_;
    const std::size_t close = std::min(text_.find('"', begin + 1), text_.size());
    if (close == text_.size())
        complain(begin, "this text is never closed; end it with a second \"");
    const std::string inside(text_.substr(begin + 1, close - begin - 1));
    at_ = std::min(close + 1, text_.size());
    skip_space();
    return inside;
}

std::string Words::text() {
    return peek() == '"' ? quoted_text() : std::string(bare(""));
}

std::optional<std::string_view> Words::list(char close, std::size_t open_at) {
    const std::size_t begin = at_;
    const std::size_t end = find_outside_quotes(text_, close, begin);
    if (end == std::string_view::npos) {
        complain(open_at, fmt::format("this bracket is never closed; end it with {}", close));
        rest();
        return std::nullopt;
    }
    at_ = end;
    const std::string_view inside = from(begin);
    ++at_;
    skip_space();
    return inside;
}

std::string_view Words::rest() {
    return text_.substr(std::exchange(at_, text_.size()));
}

std::string_view Words::value() {
    const std::size_t begin = at_;
    if (peek() == '(') {
        const std::size_t close = text_.find(')', at_);
        at_ = close == std::string_view::npos ? text_.size() : close + 1;
        const std::string_view tuple = from(begin);
        skip_space();
        return tuple;
    }
    if (peek() == '"') {
        quoted_text();
        return trimmed(text_.substr(begin, text_.find('"', begin + 1) + 1 - begin));
    }
    std::size_t end = at_;
    do {
        end = at_ + bare(",[]{}()\"").size();
        if (peek() == ',') end = at_ + 1;
    } while (accept(','));
    return trimmed(text_.substr(begin, end - begin));
}

std::vector<std::string_view> split(std::string_view list) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t comma = find_outside_quotes(list, ',', begin);
        parts.push_back(trimmed(list.substr(begin, comma - begin)));
        if (comma == std::string_view::npos) return parts;
        begin = comma + 1;
    }
}

std::optional<std::array<double, 2>> parse_bounds(std::string_view list) {
    const auto bounds = split(list);
    const auto low = parse_number(bounds.front()), high = parse_number(bounds.back());
    if (bounds.size() != 2 || !low || !high || *low > *high) return std::nullopt;
    return std::array{*low, *high};
}

std::string_view unquoted(std::string_view text) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = trimmed(text.substr(1, text.size() - 2));
    return text;
}

}  // namespace glint
