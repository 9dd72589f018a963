// What ANGLE, the compiler of browsers, refuses by rules of its own.
#include "glsl/finding.h"
#include "glsl/operand_type.h"
#include "glsl/operands.h"
#include "glsl/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

namespace glint {
namespace {

// ANGLE takes trees of 256 levels, of which those around an expression are a few.
constexpr int kDeepestTree = 251;

// From what binds least; 0 for what is no operator of two.
int precedence(std::string_view sign) {
    constexpr std::string_view kSigns[][5] = {{"=", "+=", "-=", "*=", "/="},
                                              {"?"},
                                              {"||"},
                                              {"^^"},
                                              {"&&"},
                                              {"|"},
                                              {"^"},
                                              {"&"},
                                              {"==", "!="},
                                              {"<", ">", "<=", ">="},
                                              {"<<", ">>"},
                                              {"+", "-"},
                                              {"*", "/", "%"}};
    for (int i = 0; i < static_cast<int>(std::size(kSigns)); ++i)
        if (!sign.empty() && std::ranges::find(kSigns[i], sign) != std::end(kSigns[i]))
            return i + 1;
    return 0;
}
constexpr int kOfAssignments = 1, kOfChoices = 2, kOfSigns = 100;

// How deep the tree of a function's expressions gets, from token to token.
class Depth {
public:
    void take(const Token& token, const Token* before) {
        if (token.is("(") || token.is("[")) {
            levels_.push_back({.is_call = token.is("[") || (before && before->is_word())});
        } else if ((token.is(")") || token.is("]")) && levels_.size() > 1) {
            end_expression();
            const Level inner = std::move(levels_.back());
            levels_.pop_back();
            Tree& last = levels_.back().last;
            last.depth = std::max(last.depth, inner.deepest + (inner.is_call ? 1 : 0));
            last.is_constant &= inner.is_constant && !inner.is_call;
        } else if (token.is("{") || token.is("}") || token.is(";")) {
            end_expression();
            levels_.assign(1, {});
        } else if (token.is(",")) {
            end_expression();
        } else if (token.is_word() && !token.is("return")) {
            levels_.back().last.is_constant = false;
        } else if (token.kind == TokenKind::symbol) {
            take_operator(token.text, before);
        }
    }
    // Of all expressions that have ended.
    int deepest() const { return deepest_; }

private:
    struct Tree {
        int depth = 0;
        bool is_constant = true;  // which the compiler reckons at once
    };
    struct Operation {
        int precedence;
        Tree left;
    };
    struct Level {
        bool is_call = false;
        std::vector<Operation> open{};
        Tree last{};
        int deepest = 0;  // of what a comma ends
        bool is_constant = true;
    };

    void take_operator(std::string_view sign, const Token* before) {
        Level& level = levels_.back();
        const bool has_left = before && (before->is_word() || before->kind == TokenKind::number ||
                                         before->is(")") || before->is("]"));
        if (!has_left) {
            level.open.push_back({kOfSigns, {}});
        } else if (const int own = precedence(sign); own > 0) {
            const bool from_right = own == kOfAssignments || own == kOfChoices;
            close_to(from_right ? own + 1 : own);
            level.open.push_back({own, std::exchange(level.last, {})});
        } else if (sign == ":") {
            close_to(kOfChoices + 1);
            if (level.open.empty()) return;
            Tree& left = level.open.back().left;
            left = {std::max(left.depth, level.last.depth), false};
            level.last = {};
        }
    }

    // What binds as much or more has its right side now.
    void close_to(int least) {
        Level& level = levels_.back();
        for (; !level.open.empty() && level.open.back().precedence >= least;
             level.open.pop_back()) {
            const Tree& left = level.open.back().left;
            const bool is_constant = left.is_constant && level.last.is_constant;
            level.last = {is_constant ? 0 : std::max(left.depth, level.last.depth) + 1,
                          is_constant};
        }
    }

    void end_expression() {
        close_to(0);
        Level& level = levels_.back();
        level.deepest = std::max(level.deepest, level.last.depth);
        level.is_constant &= level.last.is_constant;
        level.last = {};
        deepest_ = std::max(deepest_, level.deepest);
    }

    std::vector<Level> levels_{1};
    int deepest_ = 0;
};

class BrowserRules {
public:
    BrowserRules(const Reading& reading, const std::vector<bool>& wanted)
        : reading_(reading), wanted_(wanted), variables_(reading) {
        for (const Struct& one : reading.structs)
            if (one.name != kNone) structs_.insert(reading.word(one.name));
    }

    std::vector<Finding> find() {
        for (const Declaration& declaration : reading_.declarations) {
            for (const Declarator& one : declaration.names) look_at(declaration, one);
            refuse_output(declaration);
        }
        for (std::uint32_t i = 0; i < reading_.statements.size(); ++i)
            if (is_wanted(reading_.statements[i].function)) look_at(i);
        for (std::uint32_t i = 0; i < reading_.functions.size(); ++i)
            if (is_wanted(i)) look_at_expressions(i);
        for (const std::uint32_t index : reading_.functions_named("mainImage"))
            look_at_entry(reading_.functions[index]);
        std::ranges::stable_sort(findings_, {}, &Finding::at);
        return std::move(findings_);
    }

private:
    bool is_wanted(std::uint32_t function) const { return function == kNone || wanted_[function]; }
    bool is_of_struct(const Declaration& declaration) const {
        return declaration.structure != kNone || structs_.contains(reading_.word(declaration.type));
    }

    void add(std::size_t at, std::string text) {
        findings_.push_back({kWebGl, at, std::move(text), {}});
    }

    // The `?` of `c ? a : b`, where that is all of the range; kNone for none.
    std::uint32_t choice_in(TokenRange range) const {
        range = without_parentheses(reading_, range);
        for (std::uint32_t at = range.begin; at < range.end; ++at) {
            if (reading_.tokens[at].is("?")) return at;
            if (const std::uint32_t close = reading_.close_of(at); close != kNone) at = close;
        }
        return kNone;
    }

    void refuse_choice(std::uint32_t choice, std::string_view of) {
        add(reading_.place(choice).begin,
            fmt::format(
                "browsers refuse ?: for {}, which desktop compilers take: write if and else", of));
    }

    // `out vec4 colour;` beside the output that mainImage writes.
    void refuse_output(const Declaration& declaration) {
        const bool is_output = declaration.scope == Scope::global && declaration.is_out;
        const TokenRange words = declaration.qualifiers;
        for (std::uint32_t at = words.begin; at < words.end; ++at)
            if (reading_.tokens[at].is("location")) return;
        if (!is_output || reading_.functions_named("mainImage").empty()) return;
        add(reading_.place(declaration.tokens.begin).begin,
            "browsers refuse a second output without a location, and the site has one of its own: "
            "take out this 'out'");
    }

    // Of a global's first value; those of functions are looked for in their bodies.
    void look_at(const Declaration& declaration, const Declarator& one) {
        if (one.initial.empty() || declaration.scope != Scope::global) return;
        const std::uint32_t choice = choice_in(one.initial);
        if (choice == kNone) return;
        if (!one.array.empty() || !declaration.type_array.empty())
            refuse_choice(choice, "arrays");
        else if (is_of_struct(declaration))
            refuse_choice(choice, "structures");
    }

    void look_at(std::uint32_t index) {
        const Statement& statement = reading_.statements[index];
        if (statement.kind == StatementKind::for_ || statement.kind == StatementKind::while_) {
            refuse_endless(index);
            refuse_second_names(index);
        }
        if (statement.kind != StatementKind::expression) return;
        const TokenRange all = {statement.tokens.begin, statement.tokens.end - 1};
        const std::uint32_t choice = choice_in(all);
        if (choice != kNone && gives_nothing(choice + 1)) refuse_choice(choice, "void");
    }

    // One that always goes on, with neither a return nor a break of its own.
    void refuse_endless(std::uint32_t index) {
        const Statement& loop = reading_.statements[index];
        const TokenRange condition = without_parentheses(reading_, loop.condition);
        const bool goes_on = condition.empty() ||
                             (condition.size() == 1 && reading_.tokens[condition.begin].is("true"));
        if (!goes_on) return;
        for (std::uint32_t at = index + 1; at < loop.next; ++at) {
            const StatementKind kind = reading_.statements[at].kind;
            if (kind == StatementKind::return_) return;
            if (kind == StatementKind::break_ && holder_of(at) == index) return;
        }
        add(reading_.place(loop.tokens.begin).begin,
            "browsers refuse a loop that always goes on, with no break or return of its own; give "
            "it an end");
    }

    // `for (int i = 0; …) { int i; }`: head and body are one scope there.
    void refuse_second_names(std::uint32_t index) {
        const Statement& loop = reading_.statements[index];
        if (loop.declaration == kNone) return;
        const bool has_block =
            index + 1 < loop.next && reading_.statements[index + 1].kind == StatementKind::block;
        const std::uint32_t scope = has_block ? index + 1 : index;
        for (std::uint32_t at = index + 1; at < loop.next; ++at) {
            const Statement& inner = reading_.statements[at];
            if (inner.parent != scope || inner.kind != StatementKind::declaration) continue;
            for (const Declarator& second : reading_.declarations[inner.declaration].names)
                for (const Declarator& first : reading_.declarations[loop.declaration].names)
                    if (reading_.word(first.name) == reading_.word(second.name))
                        add(reading_.place(second.name).begin,
                            fmt::format("browsers refuse a second '{}', which the loop's head "
                                        "declares; give it another name",
                                        reading_.word(second.name)));
        }
    }

    // The loop or switch that a break leaves.
    std::uint32_t holder_of(std::uint32_t index) const {
        std::uint32_t at = reading_.statements[index].parent;
        while (at != kNone && !is_loop(reading_.statements[at].kind) &&
               reading_.statements[at].kind != StatementKind::switch_)
            at = reading_.statements[at].parent;
        return at;
    }

    void look_at_expressions(std::uint32_t function) {
        const TokenRange body = reading_.functions[function].body;
        Depth depth;
        std::uint32_t begin = body.begin;  // of what has no end yet
        for (std::uint32_t at = body.begin; at < body.end; ++at) {
            const Token& token = reading_.tokens[at];
            if (token.is("?")) refuse_choice_at(at, function);
            const bool was_deep = depth.deepest() >= kDeepestTree;
            depth.take(token, at > body.begin ? &reading_.tokens[at - 1] : nullptr);
            if (!was_deep && depth.deepest() >= kDeepestTree)
                add(reading_.place(begin).begin,
                    "browsers refuse an expression of more than 250 operators or calls within one "
                    "another; keep parts of it in variables");
            if (token.is(";") || token.is("{") || token.is("}")) begin = at + 1;
        }
    }

    // By the first of the two between which it chooses.
    void refuse_choice_at(std::uint32_t choice, std::uint32_t function) {
        const std::uint32_t end =
            operand_end(reading_, choice + 1, reading_.functions[function].body.end);
        const TokenRange first = {choice + 1, end};
        const auto type = type_of_operand(reading_, variables_, first, function);
        const bool is_array = type ? type->lengths > 0 : makes_array(first);
        const bool is_struct = type && type->lengths == 0 && type->structure != kNone;
        if (is_array || is_struct) refuse_choice(choice, is_array ? "arrays" : "structures");
    }

    // `float[2](1.0, 2.0)`
    bool makes_array(TokenRange range) const {
        range = without_parentheses(reading_, range);
        if (range.size() < 4 || !reading_.tokens[range.begin + 1].is("[")) return false;
        const std::uint32_t size_end = reading_.close_of(range.begin + 1);
        return size_end != kNone && size_end + 1 < range.end &&
               reading_.tokens[size_end + 1].is("(") &&
               reading_.close_of(size_end + 1) + 1 == range.end;
    }

    // Whether a void function of the text is called there.
    bool gives_nothing(std::uint32_t at) const {
        const auto functions = reading_.functions_named(reading_.word(at));
        return !functions.empty() && std::ranges::all_of(functions, [&](std::uint32_t index) {
            return reading_.word(reading_.functions[index].type) == "void";
        });
    }

    void look_at_entry(const Function& function) {
        if (function.parameters.empty()) return;
        const Declaration& colour = reading_.declarations[function.parameters.front()];
        if (colour.is_in && colour.is_out && reading_.word(function.type) == "void")
            add(reading_.place(colour.tokens.begin).begin,
                "browsers refuse mainImage(inout …): the site declares it with `out vec4, in "
                "vec2`; write out");
        for (const std::uint32_t parameter : function.parameters) {
            const TokenRange words = reading_.declarations[parameter].qualifiers;
            for (std::uint32_t at = words.begin; at < words.end; ++at)
                if (reading_.tokens[at].is("const"))
                    add(reading_.place(at).begin,
                        "the site refuses this const, since it declares mainImage with `in vec2`: "
                        "take it out");
        }
    }

    const Reading& reading_;
    const std::vector<bool>& wanted_;
    Variables variables_;
    std::unordered_set<std::string_view> structs_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> find_refused_by_browsers(const Reading& reading,
                                              const std::vector<bool>& wanted) {
    return reading.is_balanced ? BrowserRules(reading, wanted).find() : std::vector<Finding>();
}

}  // namespace glint
