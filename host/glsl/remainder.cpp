#include "glsl/remainder.h"

#include "glsl/operands.h"
#include "glsl/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace glint {
namespace {

constexpr std::size_t kMost = 512;  // each is a call that drivers inline

class Finder {
public:
    Finder(const Reading& reading, const Edits& edits)
        : reading_(reading), edits_(edits), is_constant_(reading.tokens.size()) {}

    std::vector<Remainder> find() {
        const std::vector<std::uint32_t> signs = reading_.places_of({"%", "%="});
        if (signs.empty() || signs.size() > kMost) return {};
        find_constants();
        for (const std::uint32_t at : signs) {
            if (at == 0 || at + 1 == count() || is_constant_[at]) continue;
            Remainder one = token(at).is("%") ? remainder(at) : assignment(at);
            const TokenRange range = one.range;
            if (!range.empty() && !(token(at).is("%") && is_known(range)) && takes(range.begin) &&
                takes(at) && takes(range.end - 1) && edits_.takes_before(range.begin) &&
                edits_.takes_replacement(at) && edits_.takes_after(range.end - 1))
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
        std::unordered_set<std::string_view> variables;
        for (const Declaration& declaration : reading_.declarations) {
            mark(declaration.qualifiers);
            mark(declaration.type_array);
            for (const Declarator& one : declaration.names) {
                const bool is_constant =
                    declaration.is_const && declaration.scope != Scope::parameter;
                (is_constant ? constants_ : variables).insert(reading_.word(one.name));
                mark(one.array);
                if (declaration.is_const || declaration.scope == Scope::global) mark(one.initial);
            }
        }
        // One that is called like a constant of another function.
        std::erase_if(constants_, [&](std::string_view name) { return variables.contains(name); });
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

    // Of a macro's use that another mend has written out nothing is left to change.
    bool takes(std::uint32_t at) const {
        const std::uint32_t use = token(at).use;
        return use == kNone || !edits_.is_replaced(reading_.uses[use].span);
    }

    // Numbers and constants, which the compiler reckons, and right: offsets of textures must be
    // such.
    bool is_known(TokenRange range) const {
        for (std::uint32_t at = range.begin; at < range.end; ++at) {
            const Token& one = token(at);
            static constexpr std::array<std::string_view, 8> kWholeTypes = {
                "int", "ivec2", "ivec3", "ivec4", "uint", "uvec2", "uvec3", "uvec4"};
            if (one.is_word() && !is_one_of(one.text, kWholeTypes) &&
                !constants_.contains(one.text))
                return false;
        }
        return true;
    }

    bool is_sign(std::uint32_t at) const {
        return token(at).is("-") || token(at).is("+") || token(at).is("~") || is_step(at);
    }
    bool is_step(std::uint32_t at) const { return token(at).is("++") || token(at).is("--"); }

    bool ends_operand(std::uint32_t at) const {
        const Token& one = token(at);
        return (one.is(")") && !closes_head(reading_, at)) || one.is("]") ||
               one.kind == TokenKind::number || (one.is_word() && !is_keyword(one.text)) ||
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
            if (is_step(i) || token(i).is("(") || token(i).is("%") || is_assignment(token(i)))
                return {};
        return {
            {at, end}, at, "", fmt::format("= {}({},", kRemainder, reading_.spelled({begin, at}))};
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(reading_.tokens.size()); }

    const Reading& reading_;
    const Edits& edits_;
    std::unordered_set<std::string_view> constants_;
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

std::vector<Remainder> find_remainders(const Reading& reading, const Edits& edits) {
    return reading.is_balanced ? Finder(reading, edits).find() : std::vector<Remainder>();
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
    mend_remainders(find_remainders(reading, edits), edits);
    return edits.apply().text;
}

}  // namespace glint
