#include "glsl/first_use.h"

#include "glsl/stack.h"

#include <algorithm>

namespace glint {
namespace {

constexpr std::size_t kMostSteps = 2'000'000;  // some 50 ms

bool is_member(const std::vector<Token>& tokens, std::uint32_t at) {
    return at > 0 && tokens[at - 1].is(".");
}

}  // namespace

FirstUses::FirstUses(const Reading& reading)
    : reading_(reading), conditions_(reading.places_of({"?", "&&", "||"})) {
    for (const Declaration& declaration : reading.declarations)
        for (const Declarator& one : declaration.names)
            if (declaration.scope == Scope::local)
                locals_[reading.word(one.name)].push_back(one.name);
    for (std::uint32_t i = 0; i < reading.functions.size(); ++i)
        functions_[reading.word(reading.functions[i].name)].push_back(i);
    for (std::uint32_t i = 0; i < reading.calls.size(); ++i)
        call_at_[reading.calls[i].brackets.begin] = i;
    for (const Statement& statement : reading.statements) {
        const bool is_leap =
            statement.kind == StatementKind::break_ || statement.kind == StatementKind::continue_;
        if (is_leap) leaps_.push_back(statement.tokens.begin);
        if (is_leap || statement.kind == StatementKind::return_)
            jumps_.push_back(statement.tokens.begin);
    }
    has_maybe_ = std::ranges::any_of(
        reading.branches, [](const Branch& branch) { return branch.live == Live::maybe; });
}

const FirstUses::Places& FirstUses::mentions_of(std::string_view name) {
    const auto [found, is_new] = mentions_of_.try_emplace(name);
    if (is_new) {
        found->second = reading_.places_of({name});
        std::erase_if(found->second,
                      [&](std::uint32_t at) { return is_member(reading_.tokens, at); });
    }
    return found->second;
}

bool FirstUses::is_mentioned_again(std::string_view name) {
    return mentions_of(name).size() > 1;
}

bool FirstUses::any(const Places& places, TokenRange range) const {
    const auto found = std::ranges::lower_bound(places, range.begin);
    return found != places.end() && *found < range.end;
}

std::uint32_t FirstUses::next_mention(TokenRange range) const {
    const auto found = std::ranges::lower_bound(*mentions_, range.begin);
    return found != mentions_->end() && *found < range.end ? *found : kNone;
}

bool FirstUses::is_event(TokenRange range) const {
    return any(*mentions_, range) || any(jumps_, range);
}

bool FirstUses::is_conditional(TokenRange range) const {
    return any(conditions_, range) ||
           (has_maybe_ && reading_.live_at(reading_.place(range.end).begin) != Live::yes);
}

// The first token from `from` on that ends an operand: a comma, a semicolon or a closing bracket.
std::uint32_t FirstUses::close_before(std::uint32_t from, std::uint32_t end) const {
    for (std::uint32_t at = from; at < end; ++at) {
        const Token& token = reading_.tokens[at];
        if (token.is(",") || token.is(";")) return at;
        if (const std::uint32_t close = reading_.close_of(at); close != kNone)
            at = close;
        else if (reading_.partner[at] != kNone)
            return at;
    }
    return end;
}

// Whether a mention is all of an argument that every function of that name and arity gives back.
bool FirstUses::is_given_by_call(std::uint32_t mention, TokenRange range) const {
    const auto& tokens = reading_.tokens;
    if (mention == range.begin || mention + 1 >= range.end) return false;
    if (!tokens[mention - 1].is("(") && !tokens[mention - 1].is(",")) return false;
    if (!tokens[mention + 1].is(")") && !tokens[mention + 1].is(",")) return false;
    std::size_t argument = 0;
    std::uint32_t open = mention;
    while (open > range.begin) {
        --open;
        if (tokens[open].is(",")) ++argument;
        if (reading_.partner[open] == kNone) continue;
        if (reading_.partner[open] > open) break;
        open = reading_.partner[open];
    }
    const auto call = call_at_.find(open);
    if (call == call_at_.end()) return false;
    const Call& called = reading_.calls[call->second];
    if (next_mention({mention + 1, called.brackets.end}) != kNone) return false;
    const auto named = functions_.find(reading_.word(called.name));
    if (named == functions_.end()) return false;
    bool found = false;
    for (const std::uint32_t index : named->second) {
        const Function& function = reading_.functions[index];
        if (function.parameters.size() != called.arity) continue;
        const Declaration& parameter = reading_.declarations[function.parameters[argument]];
        if (!parameter.is_out || parameter.is_in) return false;
        found = true;
    }
    return found;
}

FirstUses::Flow FirstUses::over_expression(TokenRange range) const {
    const std::uint32_t mention = next_mention(range);
    if (mention == kNone) return Flow::open;
    if (is_conditional({range.begin, mention})) return Flow::read;
    if (mention + 1 < range.end && reading_.tokens[mention + 1].is("=")) {
        const std::uint32_t end = close_before(mention + 2, range.end);
        return next_mention({mention + 1, end}) == kNone ? Flow::given : Flow::read;
    }
    return is_given_by_call(mention, range) ? Flow::given : Flow::read;
}

FirstUses::Flow FirstUses::over_statements(std::uint32_t first, std::uint32_t end) const {
    for (std::uint32_t i = first; i < end; i = reading_.statements[i].next) {
        if (++steps_ > kMostSteps) return Flow::read;
        const Statement& statement = reading_.statements[i];
        if (statement.kind != StatementKind::unknown && !is_event(statement.tokens)) continue;
        if (const Flow flow = over_statement(i); flow != Flow::open) return flow;
    }
    return Flow::open;
}

FirstUses::Flow FirstUses::over_statement(std::uint32_t index) const {
    const Statement& statement = reading_.statements[index];
    switch (statement.kind) {
        case StatementKind::block:
            return over_statements(index + 1, statement.next);
        case StatementKind::declaration:
        case StatementKind::expression:
        case StatementKind::case_:
        case StatementKind::discard:
        case StatementKind::empty:
            return over_expression(statement.tokens);
        case StatementKind::return_: {
            const Flow flow = over_expression(statement.tokens);
            return flow == Flow::open && is_out_ ? Flow::read
                   : flow == Flow::open          ? Flow::given
                                                 : flow;
        }
        case StatementKind::break_:
        case StatementKind::continue_:
            return Flow::given;
        case StatementKind::if_:
            return over_if(statement, index);
        case StatementKind::for_:
            return over_for(statement, index);
        case StatementKind::while_: {
            const Flow head = over_expression(statement.head);
            if (head != Flow::open) return head;
            return over_statement(index + 1) == Flow::read ? Flow::read : Flow::open;
        }
        case StatementKind::do_:
            return over_do(statement, index);
        case StatementKind::switch_:
            return over_switch(statement, index);
        case StatementKind::unknown:
            return is_out_ || any(*mentions_, statement.tokens) ? Flow::read : Flow::open;
    }
    return Flow::read;
}

FirstUses::Flow FirstUses::over_if(const Statement& statement, std::uint32_t index) const {
    const Flow head = over_expression(statement.head);
    if (head != Flow::open) return head;
    const std::uint32_t other = reading_.statements[index + 1].next;
    const Flow first = over_statement(index + 1);
    const Flow second =
        statement.has_else && other < statement.next ? over_statement(other) : Flow::open;
    if (first == Flow::read || second == Flow::read) return Flow::read;
    return first == Flow::given && second == Flow::given ? Flow::given : Flow::open;
}

// From the condition on where the variable is declared in the head.
FirstUses::Flow FirstUses::over_for(const Statement& statement, std::uint32_t index) const {
    const Flow start = over_expression({statement.head.begin, statement.condition.begin});
    if (start != Flow::open) return start;
    const Flow condition = over_expression(statement.condition);
    if (condition != Flow::open) return condition;
    const Flow body = over_statement(index + 1);
    if (body == Flow::read) return body;
    const bool is_given =
        body == Flow::given && !any(leaps_, reading_.statements[index + 1].tokens);
    return !is_given && over_expression(statement.step) == Flow::read ? Flow::read : Flow::open;
}

FirstUses::Flow FirstUses::over_do(const Statement& statement, std::uint32_t index) const {
    const Flow body = over_statement(index + 1);
    if (body == Flow::read) return body;
    if (body == Flow::given && !any(leaps_, reading_.statements[index + 1].tokens)) return body;
    return over_expression(statement.head) == Flow::read ? Flow::read : Flow::open;
}

// Each label is jumped to from the head.
FirstUses::Flow FirstUses::over_switch(const Statement& statement, std::uint32_t index) const {
    const Flow head = over_expression(statement.head);
    if (head != Flow::open) return head;
    if (reading_.statements[index + 1].kind != StatementKind::block)
        return is_event(statement.tokens) ? Flow::read : Flow::open;
    Flow flow = Flow::open;
    const std::uint32_t end = reading_.statements[index + 1].next;
    for (std::uint32_t i = index + 2; i < end; i = reading_.statements[i].next) {
        if (reading_.statements[i].kind == StatementKind::case_) flow = Flow::open;
        if (flow == Flow::open) flow = over_statement(i);
        if (flow == Flow::read) return flow;
    }
    return Flow::open;
}

bool FirstUses::local_is_read(const Declaration& declaration, const Declarator& one) {
    const std::string_view name = reading_.word(one.name);
    const auto& statements = reading_.statements;
    if (declaration.statement == kNone) return true;
    const Statement& statement = statements[declaration.statement];
    mentions_ = &mentions_of(name);
    is_out_ = false;
    const bool is_head = statement.kind == StatementKind::for_;
    const std::uint32_t block = is_head ? declaration.statement : statement.parent;
    if (block == kNone) return true;
    const TokenRange scope = {one.tokens.end, statements[block].tokens.end};
    if (next_mention(scope) == kNone) return false;
    if (any(locals_.at(name), {one.name + 1, scope.end})) return true;  // another of that name
    const Flow own = over_expression({one.tokens.end, declaration.tokens.end});
    if (own != Flow::open) return own == Flow::read;
    if (is_head) {
        Statement rest = statement;
        rest.head.begin = rest.condition.begin;
        return over_for(rest, declaration.statement) == Flow::read;
    }
    const std::uint32_t holder = statements[block].parent;
    if (statements[block].kind != StatementKind::block ||
        (holder != kNone && statements[holder].kind == StatementKind::switch_))
        return next_mention(scope) != kNone;
    if (over_statements(statement.next, statements[block].next) != Flow::read) return false;
    const auto first = std::ranges::upper_bound(*mentions_, one.name);
    const auto end = std::ranges::lower_bound(*mentions_, scope.end);
    const bool is_array = !one.array.empty() || !declaration.type_array.empty();
    if (!is_array || has_maybe_) return true;
    steps_ += scope.size() + reading_.declarations.size();
    return steps_ > kMostSteps || !Stack(reading_, {first, end}, scope, block).is_certain();
}

bool FirstUses::out_is_read(std::uint32_t index, std::string_view name) {
    const Function& function = reading_.functions[index];
    if (const auto found = locals_.find(name);
        found != locals_.end() && any(found->second, function.body))
        return true;
    mentions_ = &mentions_of(name);
    is_out_ = true;
    return over_statement(function.first_statement) != Flow::given;
}

// A `for (;;)` or `while (true)` that nothing leaves.
bool FirstUses::ends_loop(std::uint32_t index) const {
    const Statement& statement = reading_.statements[index];
    const bool is_endless =
        (statement.condition.empty() && statement.kind == StatementKind::for_) ||
        (statement.condition.size() == 1 && reading_.tokens[statement.condition.begin].is("true"));
    return is_endless && !any(leaps_, statement.tokens);
}

// Whether nothing comes behind a statement.
bool FirstUses::ends(std::uint32_t index) const {
    const Statement& statement = reading_.statements[index];
    switch (statement.kind) {
        case StatementKind::return_:
            return true;
        case StatementKind::block:
            for (std::uint32_t i = index + 1; i < statement.next; i = reading_.statements[i].next)
                if (ends(i)) return true;
            return false;
        case StatementKind::if_: {
            const std::uint32_t other = reading_.statements[index + 1].next;
            return statement.has_else && other < statement.next && ends(index + 1) && ends(other);
        }
        case StatementKind::for_:
        case StatementKind::while_:
            return ends_loop(index);
        case StatementKind::do_:
            return ends_loop(index) ||
                   (ends(index + 1) && !any(leaps_, reading_.statements[index + 1].tokens));
        case StatementKind::declaration:
        case StatementKind::expression:
        case StatementKind::switch_:
        case StatementKind::case_:
        case StatementKind::break_:
        case StatementKind::continue_:
        case StatementKind::discard:
        case StatementKind::empty:
        case StatementKind::unknown:
            return false;
    }
    return false;
}

bool FirstUses::lacks_return(const Function& function) const {
    if (function.first_statement == kNone || ends(function.first_statement)) return false;
    const auto& statements = reading_.statements;
    for (std::uint32_t i = function.first_statement; i < statements[function.first_statement].next;
         ++i)
        if (statements[i].kind == StatementKind::return_) return true;
    return false;
}

}  // namespace glint
