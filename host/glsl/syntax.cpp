#include "glsl/parser.h"

#include <algorithm>
#include <array>
#include <utility>

namespace glint {
namespace {

bool is_qualifier(std::string_view word) {
    constexpr std::array<std::string_view, 25> kQualifiers = {
        "const",    "uniform",  "in",        "out",           "inout",    "highp",  "mediump",
        "lowp",     "layout",   "flat",      "smooth",        "centroid", "sample", "invariant",
        "precise",  "varying",  "attribute", "noperspective", "buffer",   "shared", "coherent",
        "volatile", "restrict", "readonly",  "writeonly"};
    return is_one_of(word, kQualifiers);
}

}  // namespace

bool is_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 15> kKeywords = {
        "if",     "else",  "for",      "while",   "do",     "switch", "case",     "default",
        "return", "break", "continue", "discard", "struct", "layout", "precision"};
    return std::ranges::find(kKeywords, word) != kKeywords.end();
}

Syntax Parser::parse() {
    count_ = static_cast<std::uint32_t>(tokens_.size());
    match_brackets();
    while (at_ < count_) parse_item();
    find_calls(tokens_, out_);
    return std::move(out_);
}

// The bytes that tokens stand for, whole macro uses.
Span Parser::cover(TokenRange range) const {
    if (range.empty()) return {};
    const auto outer = [&](const Token& token) {
        return token.use == kNone ? token.span() : text_.uses[token.use].span;
    };
    return {outer(tokens_[range.begin]).begin, outer(tokens_[range.end - 1]).end};
}

void Parser::complain(TokenRange range, const char* why) {
    text_.not_understood.push_back({cover(range), why});
}

void Parser::match_brackets() {
    out_.partner.assign(count_, kNone);
    constexpr std::string_view kOpen = "([{", kClose = ")]}";
    std::vector<std::uint32_t> open;
    std::array<std::size_t, 3> count{};
    for (std::uint32_t at = 0; at < count_; ++at) {
        if (tokens_[at].kind != TokenKind::symbol || tokens_[at].text.size() != 1) continue;
        const char c = tokens_[at].text[0];
        if (const std::size_t kind = kOpen.find(c); kind != kOpen.npos) {
            open.push_back(at);
            ++count[kind];
        } else if (const std::size_t closed = kClose.find(c); closed != kClose.npos) {
            out_.is_balanced &= !open.empty() && tokens_[open.back()].text[0] == kOpen[closed];
            if (count[closed] == 0) continue;
            while (tokens_[open.back()].text[0] != kOpen[closed]) {
                --count[kOpen.find(tokens_[open.back()].text[0])];
                open.pop_back();
            }
            out_.partner[at] = open.back();
            out_.partner[open.back()] = at;
            --count[closed];
            open.pop_back();
        }
    }
    out_.is_balanced &= open.empty();
    if (!out_.is_balanced) complain({0, count_}, "brackets do not balance");
}

// The first token from `from` on that is one of the characters, outside of brackets; or `stop`.
std::uint32_t Parser::skip_to(std::uint32_t from, std::uint32_t stop, std::string_view ends) const {
    for (std::uint32_t at = from; at < stop; ++at) {
        const Token& token = tokens_[at];
        if (token.kind == TokenKind::symbol && token.text.size() == 1 &&
            ends.find(token.text[0]) != ends.npos)
            return at;
        if (const std::uint32_t close = close_of(at); close != kNone) at = std::min(close, stop);
    }
    return stop;
}

// `[3][]`; false where a bracket does not close.
bool Parser::skip_array(TokenRange& array) {
    array = {at_, at_};
    while (is(at_, "[")) {
        const std::uint32_t close = close_of(at_);
        if (close == kNone) return false;
        at_ = close + 1;
    }
    array.end = at_;
    return true;
}

void Parser::parse_item() {
    const std::uint32_t begin = at_;
    const auto add = [&](Item::Kind kind, std::uint32_t index) {
        out_.items.push_back({kind, {begin, at_}, index});
    };
    if (is(at_, ";")) {
        ++at_;
        return add(Item::Kind::other, kNone);
    }
    if (is(at_, "precision")) {
        at_ = std::min(skip_to(at_, count_, ";") + 1, count_);
        return add(Item::Kind::other, kNone);
    }
    Declaration head;
    head.qualifiers.begin = at_;
    parse_qualifiers(head);
    if (is_name(at_) && !is(at_ + 1, "{")) {
        head.type = at_++;
        if (skip_array(head.type_array) && is_name(at_) && is(at_ + 1, "(")) {
            if (parse_function(begin, head, at_))
                return add(Item::Kind::function,
                           static_cast<std::uint32_t>(out_.functions.size()) - 1);
        }
    }
    at_ = begin;
    const std::uint32_t index = parse_declaration(Scope::global, kNone, count_);
    if (index != kNone) return add(Item::Kind::declaration, index);
    at_ = begin;
    pass_over();
    add(Item::Kind::unknown, kNone);
    complain({begin, at_}, "this declaration is not understood");
}

// Up to where something else may begin: behind a semicolon or a closing brace, before a `uniform`.
void Parser::pass_over() {
    bool ends = false;
    do {
        ends = is(at_, ";") || is(at_, "{");
        if (const std::uint32_t close = close_of(at_); close != kNone) at_ = close;
        ++at_;
    } while (!ends && at_ < count_ && !is(at_, "uniform"));
}

// At its name. False where it turns out to be no function.
bool Parser::parse_function(std::uint32_t begin, const Declaration& head, std::uint32_t name) {
    const std::uint32_t close = close_of(name + 1);
    if (close == kNone || (!is(close + 1, "{") && !is(close + 1, ";"))) return false;
    const std::uint32_t body_end = is(close + 1, "{") ? close_of(close + 1) : close + 1;
    if (body_end == kNone) return false;
    const auto index = static_cast<std::uint32_t>(out_.functions.size());
    Function& function = out_.functions.emplace_back();
    function.name = name;
    function.type = head.type;
    function.type_array = head.type_array;
    function.tokens = {begin, body_end + 1};
    function.parentheses = {name + 1, close + 1};
    if (is(close + 1, "{")) function.body = {close + 1, body_end + 1};
    const TokenRange body = function.body;
    parse_parameters(index);
    if (!body.empty()) {
        at_ = body.begin;
        function_ = index;
        out_.functions[index].first_statement = static_cast<std::uint32_t>(out_.statements.size());
        parse_statement(kNone, body.end, 0);
        function_ = kNone;
    }
    at_ = body_end + 1;
    return true;
}

void Parser::parse_parameters(std::uint32_t function) {
    const TokenRange list = out_.functions[function].parentheses;
    const std::uint32_t end = list.end - 1;
    if (list.size() == 3 && is(list.begin + 1, "void")) return;
    for (at_ = list.begin + 1; at_ < end; ++at_) {
        const std::uint32_t begin = at_, comma = skip_to(at_, end, ",");
        const std::uint32_t index = add_declaration(Scope::parameter, function);
        parse_qualifiers(out_.declarations[index]);
        bool understood = is_name(at_) && parse_type(index, comma);
        if (understood && is_name(at_)) {
            Declarator one;
            one.name = at_++;
            understood = skip_array(one.array);
            one.tokens = {one.name, at_};
            out_.declarations[index].names.push_back(one);
        }
        if (!understood || at_ != comma)
            complain({begin, comma}, "this parameter is not understood");
        out_.declarations[index].tokens.end = comma;
        out_.functions[function].parameters.push_back(index);
        at_ = comma;
    }
}

void Parser::parse_qualifiers(Declaration& declaration) {
    constexpr std::uint32_t kMost = 32;  // so that no token is read over and over
    const std::uint32_t stop = std::min(at_ + kMost, count_);
    for (; at_ < stop && tokens_[at_].is_word() && is_qualifier(tokens_[at_].text); ++at_) {
        const std::string_view word = tokens_[at_].text;
        declaration.is_const |= word == "const";
        declaration.is_uniform |= word == "uniform";
        declaration.is_in |= word == "in" || word == "inout";
        declaration.is_out |= word == "out" || word == "inout";
        if (word == "layout" && close_of(at_ + 1) != kNone) at_ = close_of(at_ + 1);
    }
    declaration.qualifiers.end = at_;
}

std::uint32_t Parser::add_declaration(Scope scope, std::uint32_t owner) {
    const auto index = static_cast<std::uint32_t>(out_.declarations.size());
    Declaration& declaration = out_.declarations.emplace_back();
    declaration.tokens = declaration.qualifiers = {at_, at_};
    declaration.scope = scope;
    declaration.owner = owner;
    return index;
}

// `float`, `float[3]`, `struct S { … }`, or a block's `Name { … }`.
bool Parser::parse_type(std::uint32_t index, std::uint32_t stop) {
    if (is(at_, "struct")) {
        ++at_;
        const bool has_name = is_name(at_) && is(at_ + 1, "{");
        const std::uint32_t name = has_name ? at_++ : kNone;
        out_.declarations[index].type = name;
        if (!is(at_, "{") || !parse_struct(index, name)) return false;
    } else if (is_name(at_)) {
        out_.declarations[index].type = at_++;
        if (is(at_, "{")) {
            out_.declarations[index].is_block = true;
            if (out_.declarations[index].qualifiers.empty() || !parse_struct(index, at_ - 1))
                return false;
        }
    } else {
        return false;
    }
    return skip_array(out_.declarations[index].type_array) && at_ <= stop;
}

bool Parser::parse_struct(std::uint32_t index, std::uint32_t name) {
    const std::uint32_t close = close_of(at_);
    if (close == kNone) return false;
    const auto number = static_cast<std::uint32_t>(out_.structs.size());
    Struct& made = out_.structs.emplace_back();
    made.name = name;
    made.body = {at_, close + 1};
    made.tokens = {name == kNone ? at_ - 1 : name - 1, close + 1};
    made.function = function_;
    out_.declarations[index].structure = number;
    for (++at_; at_ < close;) {
        const std::uint32_t begin = at_;
        const bool nested = is(at_, "struct");  // which GLSL ES does not have
        const std::uint32_t member =
            nested ? kNone : parse_declaration(Scope::member, number, close);
        if (member != kNone) {
            out_.structs[number].members.push_back(member);
            continue;
        }
        at_ = std::min(skip_to(begin, close, ";") + 1, close);
        complain({begin, at_}, "this member is not understood");
    }
    at_ = close + 1;
    return true;
}

// `a, b[3] = …` up to the semicolon, which is not taken, or to `stop`.
bool Parser::parse_names(std::uint32_t index, std::uint32_t stop) {
    for (bool more = !is(at_, ";"); more; ++at_) {
        if (!is_name(at_)) return false;
        Declarator one;
        one.name = at_++;
        if (!skip_array(one.array)) return false;
        if (is(at_, "=")) {
            one.initial.begin = at_ + 1;
            at_ = one.initial.end = skip_to(at_, stop, ",;");
        }
        if (at_ > stop) return false;
        one.tokens = {one.name, at_};
        out_.declarations[index].names.push_back(one);
        more = at_ < stop && is(at_, ",");
        if (!more) break;
    }
    return at_ == stop || is(at_, ";");
}

// Up to and with the semicolon, or up to `stop`. kNone where it is not understood.
std::uint32_t Parser::parse_declaration(Scope scope, std::uint32_t owner, std::uint32_t stop) {
    const Mark before = mark();
    const std::uint32_t index = add_declaration(scope, owner);
    parse_qualifiers(out_.declarations[index]);
    const bool is_bare = is(at_, ";") && !out_.declarations[index].qualifiers.empty();
    const bool understood = is_bare || (parse_type(index, stop) && parse_names(index, stop));
    if (!understood || (at_ == stop && scope == Scope::global)) {
        return_to(before);
        return kNone;
    }
    if (at_ < stop) ++at_;
    out_.declarations[index].tokens.end = at_;
    return index;
}

bool Parser::begins_declaration(std::uint32_t at) const {
    if (!tokens_[at].is_word()) return false;
    const std::string_view word = tokens_[at].text;
    if (is_qualifier(word) || word == "struct") return true;
    if (!is_name(at)) return false;
    std::uint32_t next = at + 1;
    while (is(next, "[") && close_of(next) != kNone) next = close_of(next) + 1;
    return is_name(next);
}

Syntax parse(Preprocessed& text) {
    return Parser(text).parse();
}

}  // namespace glint
