#include "glsl/macro.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

namespace glint {
namespace {

// The largest shader of the site's most macro-ridden authors makes some ten thousand tokens.
constexpr std::size_t kMostTokens = 1u << 19;
constexpr int kDeepestArgument = 64;

// Reads `NAME`, `NAME(a, b)` behind `# define`. Nothing where it is neither.
std::optional<Macro> parse_definition(const std::vector<Token>& tokens, TokenRange line) {
    Macro macro;
    std::uint32_t at = line.begin + 2;
    if (at >= line.end || !tokens[at].is_word()) return std::nullopt;
    macro.name = tokens[at++].text;
    if (at < line.end && tokens[at].is("(") && !tokens[at].space_before) {
        macro.takes_arguments = true;
        for (++at; at < line.end && !tokens[at].is(")"); ++at) {
            if (tokens[at].is_word()) macro.parameters.push_back(tokens[at].text);
        }
        if (at == line.end) return std::nullopt;
        ++at;
    }
    macro.body.assign(tokens.begin() + at, tokens.begin() + line.end);
    return macro;
}

}  // namespace

Macros::Macros(const Known& known, std::deque<std::string>& spellings) : open_names_(known.open) {
    for (const auto& [name, value] : known.macros) {
        Macro macro;
        macro.name = spellings.emplace_back(name);
        macro.body = scan(spellings.emplace_back(value), spellings).tokens;
        for (Token& token : macro.body) token.begin = token.end = 0;
        entries_[macro.name] = {static_cast<std::uint32_t>(list_.size()), true, 0};
        list_.push_back(std::move(macro));
    }
}

bool Macros::is_open(std::uint32_t branch) const {
    return branch == 0 || std::ranges::binary_search(branches_, branch);
}

Live Macros::unknown(std::string_view name) const {
    const bool is_open = std::ranges::any_of(
        open_names_, [&](const std::string& begin) { return name.starts_with(begin); });
    return is_open ? Live::maybe : Live::no;
}

Macros::Found Macros::find(std::string_view name) const {
    const auto entry = entries_.find(name);
    if (entry == entries_.end()) return {kNone, unknown(name)};
    const auto& [macro, is_defined, branch] = entry->second;
    if (!is_open(branch)) return {macro, Live::maybe};
    return is_defined ? Found{macro, Live::yes} : Found{};
}

bool Macros::define(const std::vector<Token>& tokens, TokenRange line, Span span,
                    bool ends_in_space) {
    auto macro = parse_definition(tokens, line);
    if (!macro) return false;
    macro->ends_in_space = ends_in_space && !macro->takes_arguments;
    macro->definition = span;
    entries_[macro->name] = {static_cast<std::uint32_t>(list_.size()), true,
                             branches_.empty() ? 0 : branches_.back()};
    list_.push_back(std::move(*macro));
    return true;
}

void Macros::undefine(std::string_view name) {
    Entry& entry = entries_[name];
    entry.is_defined = false;
    entry.branch = branches_.empty() ? 0 : branches_.back();
}

void Macros::open_branch() {
    branches_.push_back(++branch_count_);
}

void Macros::close_branch() {
    branches_.pop_back();
}

Expander::Expander(const Macros& macros, TokenSource& source, std::vector<MacroUse>& uses,
                   std::deque<std::string>& spellings, std::function<int(std::size_t)> line_of)
    : macros_(macros),
      source_(source),
      uses_(uses),
      spellings_(spellings),
      line_of_(std::move(line_of)) {}

void Expander::leave_spaces(int count) {
    spaces_left_ = static_cast<std::uint8_t>(std::min(spaces_left_ + count, 255));
}

void Expander::leave() {
    if (const std::uint32_t macro = contexts_.back().macro; macro != kNone) {
        active_[macro] = false;
        const bool any = !contexts_.back().tokens.empty();
        leave_spaces(any && macros_.at(macro).ends_in_space ? 1 : 0);
    }
    contexts_.pop_back();
}

// The next token, that of an outer context where inner ones have ended; these are left only when it
// is taken. Within an argument, nothing follows its last token.
const Token* Expander::peek() {
    for (std::size_t i = contexts_.size(); i > floor_; --i) {
        const Context& context = contexts_[i - 1];
        if (context.next < context.tokens.size()) return &context.tokens[context.next];
    }
    return floor_ == 0 ? source_.peek() : nullptr;
}

Token Expander::take() {
    while (contexts_.size() > floor_) {
        Context& context = contexts_.back();
        if (context.next < context.tokens.size()) return context.tokens[context.next++];
        leave();
    }
    const Token token = *source_.peek();
    source_.take();
    return token;
}

void Expander::push(std::vector<Token> tokens, std::uint32_t macro) {
    if (macro != kNone) {
        if (active_.size() <= macro) active_.resize(macro + 1);
        active_[macro] = true;
    }
    contexts_.push_back({std::move(tokens), 0, macro});
}

bool Expander::may_grow(std::size_t tokens, std::uint32_t at) {
    grown_ += tokens;
    if (grown_ > kMostTokens && exhausted_at_ == kNone) exhausted_at_ = at;
    return exhausted_at_ == kNone;
}

bool Expander::next(Token& token) {
    do {
        if (!peek()) {
            while (contexts_.size() > floor_) leave();
            return false;
        }
        token = take();
        leave_spaces(std::exchange(token.spaces_left, std::uint8_t()));
    } while (token.is_word() && !token.is_final && expand(token));
    token.spaces_left = std::exchange(spaces_left_, std::uint8_t());
    return true;
}

void Expander::number(Token& token, int value) {
    spellings_.push_back(std::to_string(value));
    token.text = spellings_.back();
    token.kind = TokenKind::number;
}

std::uint32_t Expander::use_of(const Token& name, std::uint32_t macro, bool is_certain) {
    if (name.use != kNone) {
        uses_[name.use].is_certain &= is_certain;
        return name.use;
    }
    if (floor_ > 0) {  // in an argument, which gets the use that it stands in
        if (argument_of_ != kNone) uses_[argument_of_].is_certain &= is_certain;
        return kNone;
    }
    uses_.push_back({name.span(), macro, {}, is_certain});
    return static_cast<std::uint32_t>(uses_.size()) - 1;
}

// Whether the token was a macro's name, of whose expansion the next one comes.
bool Expander::expand(Token& token) {
    const auto [macro, is_defined] = macros_.find(token.text);
    if (macro == kNone) {
        if (token.is("__LINE__") && line_of_)
            number(token, line_of_(token.use == kNone ? token.begin : uses_[token.use].span.begin));
        return false;
    }
    if (is_defined == Live::no || is_exhausted()) return false;
    if (macro < active_.size() && active_[macro]) {
        token.is_final = true;
        return false;
    }
    std::vector<std::vector<Token>> arguments;
    const bool takes_arguments = macros_.at(macro).takes_arguments;
    if (takes_arguments && (!peek() || !peek()->is("("))) return false;
    const std::uint32_t use = use_of(token, macro, is_defined == Live::yes);
    if (takes_arguments) {
        Token name = token;
        name.use = use;
        if (!collect(name, arguments)) {
            if (use != kNone && use + 1 == uses_.size() && token.use == kNone) uses_.pop_back();
            token.is_final = true;
            return false;
        }
    }
    std::vector<Token> tokens = substituted({macro, use, token}, std::move(arguments));
    if (tokens.empty()) leave_spaces(token.space_before && !token.begins_line ? 2 : 1);
    push(std::move(tokens), macro);
    return true;
}

// Takes `( a, b )`. Where it does not end, its tokens are given back.
bool Expander::collect(const Token& name, std::vector<std::vector<Token>>& arguments) {
    std::vector<Token> taken;
    int depth = 0;
    do {
        if (!peek() || !may_grow(1, name.begin)) {
            push(std::move(taken), kNone);
            return false;
        }
        const Token token = take();
        taken.push_back(token);
        if (token.is("(") && depth++ == 0) {
            arguments.emplace_back();
            continue;
        }
        if (token.is(")") && --depth == 0) break;
        if (token.is(",") && depth == 1)
            arguments.emplace_back();
        else
            arguments.back().push_back(token);
    } while (true);
    const Token& last = taken.back();
    if (name.use != kNone && last.use == kNone) uses_[name.use].span.end = last.end;
    return true;
}

// An argument's own expansion, in which nothing of what follows takes part.
// Gives also how many spaces are left behind it.
std::pair<std::vector<Token>, int> Expander::expanded(std::vector<Token> tokens) {
    if (depth_ == kDeepestArgument) {
        if (exhausted_at_ == kNone && !tokens.empty()) exhausted_at_ = tokens.front().begin;
        return {std::move(tokens), 0};
    }
    ++depth_;
    const std::uint8_t outside = std::exchange(spaces_left_, std::uint8_t());
    const std::size_t floor = std::exchange(floor_, contexts_.size() + 1);
    contexts_.push_back({});  // so that the floor is never 0
    push(std::move(tokens), kNone);
    std::vector<Token> result;
    for (Token token; next(token);) result.push_back(token);
    contexts_.pop_back();
    floor_ = floor;
    --depth_;
    return {std::move(result), std::exchange(spaces_left_, outside)};
}

std::vector<Token> Expander::substituted(const Use& use,
                                         std::vector<std::vector<Token>> arguments) {
    const Macro& macro = macros_.at(use.macro);
    if (use.use != kNone) argument_of_ = use.use;
    std::vector<Token> result;
    std::vector<bool> is_expanded(arguments.size());
    std::vector<int> behind(arguments.size());  // spaces
    int left = 0;
    const auto add_space = [&](Token& token) {
        token.spaces_left =
            static_cast<std::uint8_t>(std::min(token.spaces_left + std::exchange(left, 0), 255));
    };
    for (const Token& token : macro.body) {
        const auto parameter = token.is_word() && macro.takes_arguments
                                   ? std::ranges::find(macro.parameters, token.text)
                                   : macro.parameters.end();
        const auto index = static_cast<std::size_t>(parameter - macro.parameters.begin());
        if (parameter == macro.parameters.end() || index >= arguments.size()) {
            result.push_back(token);
            add_space(result.back());
            continue;
        }
        if (!is_expanded[index])
            std::tie(arguments[index], behind[index]) = expanded(std::move(arguments[index]));
        is_expanded[index] = true;
        if (!may_grow(arguments[index].size(), use.name.begin)) break;
        const std::size_t first = result.size();
        result.insert(result.end(), arguments[index].begin(), arguments[index].end());
        if (result.size() == first) {
            left += behind[index] + (token.space_before ? 1 : 0);
            continue;
        }
        add_space(result[first]);
        left = behind[index];
        result[first].space_before = token.space_before;
        result[first].begins_line = false;  // which the body, not the text, says of it
    }
    may_grow(macro.body.size(), use.name.begin);
    for (Token& token : result) {
        token.use = use.use;
        token.space_before |= token.begins_line;
        token.begins_line = false;
    }
    if (!result.empty()) {
        result.front().space_before = use.name.space_before;
        result.front().begins_line = use.name.begins_line;
    }
    return result;
}

}  // namespace glint
