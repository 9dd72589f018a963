#include "glsl/remainder.h"

#include "glsl/operands.h"
#include "glsl/parser.h"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace glint {
namespace {

class Finder {
public:
    explicit Finder(const Reading& reading)
        : reading_(reading), takes_(reading), is_constant_(reading.tokens.size()) {}

    std::vector<Remainder> find() {
        bool any = false;
        for (std::uint32_t at = 1; at + 1 < count(); ++at) {
            if (!token(at).is("%") && !token(at).is("%=")) continue;
            if (!any) find_constants();
            any = true;
            if (is_constant_[at]) continue;
            Remainder one = token(at).is("%") ? remainder(at) : assignment(at);
            const TokenRange range = one.range;
            if (!range.empty() && takes_.takes_before(range.begin) &&
                takes_.takes_replacement(at) && takes_.takes_after(range.end - 1))
                found_.push_back(std::move(one));
        }
        return std::move(found_);
    }

private:
    const Token& token(std::uint32_t at) const { return reading_.tokens[at]; }

    void mark(TokenRange range) {
        for (std::uint32_t at = range.begin; at < range.end; ++at) is_constant_[at] = true;
    }

    // Values of constants and globals, lengths of arrays, labels.
    void find_constants() {
        for (const Declaration& declaration : reading_.declarations) {
            mark(declaration.qualifiers);
            mark(declaration.type_array);
            for (const Declarator& one : declaration.names) {
                mark(one.array);
                if (declaration.is_const || declaration.scope == Scope::global) mark(one.initial);
            }
        }
        for (const Function& function : reading_.functions) mark(function.type_array);
        for (const Statement& statement : reading_.statements)
            if (statement.kind == StatementKind::case_) mark(statement.tokens);
        for (std::uint32_t at = 0; at < is_constant_.size(); ++at) {  // int[2](…)
            const std::uint32_t close = token(at).is("[") ? reading_.close_of(at) : kNone;
            if (close != kNone && close + 1 < is_constant_.size() &&
                (token(close + 1).is("(") || token(close + 1).is_word()))
                mark({at, close});
        }
    }

    bool is_sign(std::uint32_t at) const {
        return token(at).is("-") || token(at).is("+") || token(at).is("~") || is_step(at);
    }
    bool is_step(std::uint32_t at) const { return token(at).is("++") || token(at).is("--"); }

    bool ends_operand(std::uint32_t at) const {
        const Token& one = token(at);
        return one.is(")") || one.is("]") || one.kind == TokenKind::number ||
               (one.is_word() && !is_keyword(one.text)) ||
               (is_step(at) && at > 0 && ends_operand(at - 1));
    }

    // Of a factor that ends before `end`, with its signs; `end` for none.
    std::uint32_t factor_begin(std::uint32_t end) const {
        std::uint32_t last = end;
        while (last > 0 && is_step(last - 1)) --last;
        std::uint32_t at = operand_begin(reading_, last, 0);
        if (at == last) return end;
        while (at > 0 && is_sign(at - 1) && !(at > 1 && ends_operand(at - 2))) --at;
        return at;
    }

    // `a * -b` of `c + a * -b % d`.
    std::uint32_t left_begin(std::uint32_t end) const {
        std::uint32_t at = factor_begin(end);
        while (at != end && at > 0 &&
               (token(at - 1).is("*") || token(at - 1).is("/") || token(at - 1).is("%"))) {
            const std::uint32_t before = factor_begin(at - 1);
            if (before == at - 1) return end;
            at = before;
        }
        return at;
    }

    // Of none an empty range.
    Remainder remainder(std::uint32_t at) const {
        const std::uint32_t begin = left_begin(at);
        const std::uint32_t end = operand_end(reading_, at + 1, count());
        if (begin == at || end == at + 1) return {};
        return {{begin, end}, at, fmt::format("{}(", kRemainder), ","};
    }

    // What stands on the left is named twice, so it may do nothing.
    Remainder assignment(std::uint32_t at) const {
        const std::uint32_t begin = operand_begin(reading_, at, 0);
        const std::uint32_t end = expression_end(reading_, at + 1, count());
        if (begin == at || end == at + 1) return {};
        for (std::uint32_t i = begin; i < at; ++i)
            if (is_step(i) || token(i).is("(") || is_assignment(token(i))) return {};
        return {
            {at, end}, at, "", fmt::format("= {}({},", kRemainder, reading_.spelled({begin, at}))};
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(reading_.tokens.size()); }

    const Reading& reading_;
    const Edits takes_;
    std::vector<bool> is_constant_;
    std::vector<Remainder> found_;
};

}  // namespace

std::string remainder_functions() {
    std::string text;
    for (const auto& [scalar, vector, value] :
         {std::array{"int", "ivec", "a - b * (a / b)"}, std::array{"uint", "uvec", "a % b"}}) {
        const auto define = [&](const std::string& result, const std::string& a,
                                const std::string& b) {
            text += fmt::format("{} {}({} a, {} b) {{ return {}; }}\n", result, kRemainder, a, b,
                                value);
        };
        define(scalar, scalar, scalar);
        for (const char* count : {"2", "3", "4"}) {
            const std::string many = std::string(vector) + count;
            define(many, many, many);
            define(many, many, scalar);
            define(many, scalar, many);
        }
    }
    return text;
}

std::vector<Remainder> find_remainders(const Reading& reading) {
    return reading.is_balanced ? Finder(reading).find() : std::vector<Remainder>();
}

void mend_remainders(const std::vector<Remainder>& remainders, Edits& edits) {
    for (const Remainder& one : remainders) {
        if (!one.before.empty()) edits.before(one.range.begin, one.before);
        edits.replace({one.sign, one.sign + 1}, one.instead);
        edits.after(one.range.end - 1, ")");
    }
}

std::string with_mended_remainders(std::string_view expression) {
    const Reading reading = read_glsl(expression, {});
    Edits edits(reading);
    mend_remainders(find_remainders(reading), edits);
    return edits.apply().text;
}

}  // namespace glint
