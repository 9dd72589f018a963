// The items of an annotation, one after the other: words, quoted texts, values, lists in brackets.
#pragma once

#include "scene/annotation.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glint {

// What fills a sampler, as the first word of its annotation.
inline constexpr std::array<std::string_view, 8> kFillers = {
    "pass", "buffer", "image", "cube", "volume", "sound", "noise", "keyboard"};

// Walks over an annotation's items and collects complaints. Every reading function leaves it at the
// next item.
class Words {
public:
    Words(std::string_view text, std::vector<Complaint>& complaints);

    // A copy that looks ahead without complaining.
    Words ahead() const;

    bool done() const { return at_ >= text_.size(); }
    char peek() const { return done() ? '\0' : text_[at_]; }
    std::size_t at() const { return at_; }

    void complain(std::size_t at, std::string text) { add({at, std::move(text)}); }
    void warn(std::size_t at, std::string text) { add({at, std::move(text), Severity::warning}); }

    bool accept(char c);
    // `=` right behind a word, and how: `unit=m` and `unit = m` have a value, `unit= m` has none.
    enum class Equals { none, with_value, alone };
    Equals equals();
    // Up to white space or one of the stops; may be empty.
    std::string_view bare(std::string_view stops);
    // From the quote here to the next one; all of the rest, with a complaint, when there is none.
    std::string quoted_text();
    // A quoted text or a bare one.
    std::string text();
    // What stands up to `close`, for a list whose bracket at `open_at` has just been accepted;
    // nothing, with a complaint, when that does not come.
    std::optional<std::string_view> list(char close, std::size_t open_at);
    // What is left; leaves it at the end.
    std::string_view rest();
    // A word, a quoted text with its quotes, or numbers with commas, in parentheses or not.
    std::string_view value();

private:
    std::string_view from(std::size_t begin) const { return text_.substr(begin, at_ - begin); }
    void skip_space();
    void add(Complaint complaint);

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<Complaint>* complaints_;
};

// The parts between commas, trimmed.
std::vector<std::string_view> split(std::string_view list);

// "[0, 1]" without its brackets: two finite numbers, the first no larger. Nothing otherwise.
std::optional<std::array<double, 2>> parse_bounds(std::string_view list);

// Without the quotes round it, if there are any.
std::string_view unquoted(std::string_view text);

}  // namespace glint
