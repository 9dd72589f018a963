#include "glsl/stored_index.h"

#include "glsl/hidden_zero.h"
#include "glsl/operands.h"
#include "glsl/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace glint {
namespace {

// `i++`, `i -= 2`: the variable, the sign, and by what.
struct Step {
    std::string_view variable;
    char sign;
    std::string_view by;
    bool operator==(const Step&) const = default;
};

class Mender {
public:
    Mender(const Reading& reading, Edits& edits) : reading_(reading), edits_(edits) {}

    void mend(const Statement& loop) {
        const TokenRange all = loop.tokens;
        const std::vector<Step> steps = steps_in(all);
        for (std::uint32_t at = all.begin + 1; at + 2 < all.end; ++at)
            if (token(at - 1).is("[") && token(at + 1).is("]") && token(at).is_word() &&
                is_stored_to(at, all) && std::ranges::any_of(steps, [&](const Step& step) {
                    return token(at).is(step.variable) && is_added_again(step, all);
                }))
                hide(at, loop.function);
    }

private:
    const Token& token(std::uint32_t at) const { return reading_.tokens[at]; }

    std::vector<Step> steps_in(TokenRange range) const {
        std::vector<Step> steps;
        for (std::uint32_t at = range.begin + 1; at + 1 < range.end; ++at) {
            const Token &one = token(at), &before = token(at - 1), &behind = token(at + 1);
            const bool by_one = one.is("++") || one.is("--");
            if (by_one && (before.is_word() || behind.is_word()))
                steps.push_back({before.is_word() ? before.text : behind.text, one.text[0], "1"});
            if ((one.is("+=") || one.is("-=")) && before.is_word())
                steps.push_back({before.text, one.text[0], behind.text});
        }
        return steps;
    }

    // `i + 1` or `1 + i`, which is no part of a product.
    bool is_added_again(const Step& step, TokenRange range) const {
        constexpr std::array<std::string_view, 6> kBind = {"*", "/", "%", "-", "+", "."};
        for (std::uint32_t at = range.begin + 1; at + 3 < range.end; ++at) {
            const Token& sign = token(at + 1);
            if (sign.text.size() != 1 || sign.text[0] != step.sign) continue;
            const auto is_by = [&](const Token& one) {
                return one.is(step.by) || (step.by == "1" && one.is("1u"));
            };
            const bool is_sum =
                (token(at).is(step.variable) && is_by(token(at + 2))) ||
                (step.sign == '+' && is_by(token(at)) && token(at + 2).is(step.variable));
            if (is_sum && std::ranges::find(kBind, token(at - 1).text) == kBind.end()) return true;
        }
        return false;
    }

    // `w[i] = …`, `w[i].x += …`, `grid[i][j] = …`.
    bool is_stored_to(std::uint32_t index, TokenRange range) const {
        std::uint32_t at = index + 2;
        while (at + 1 < range.end && (token(at).is(".") || token(at).is("[")))
            at = token(at).is(".")                ? at + 2
                 : reading_.close_of(at) == kNone ? range.end
                                                  : reading_.close_of(at) + 1;
        return at < range.end && is_assignment(token(at));
    }

    void hide(std::uint32_t at, std::uint32_t function) {
        if (std::ranges::find(hidden_, at) != hidden_.end()) return;  // of a loop in a loop
        if (!variables_) variables_.emplace(reading_);
        const auto found = variables_->find(at, function);
        const std::string_view type =
            found.declaration ? reading_.word(found.declaration->type) : std::string_view();
        if (type == "int") edits_.after(at, fmt::format("+{}_i", kHiddenZero));
        if (type == "uint") edits_.after(at, fmt::format("+uint({}_i)", kHiddenZero));
        hidden_.push_back(at);
    }

    const Reading& reading_;
    Edits& edits_;
    std::optional<Variables> variables_;  // few texts ask
    std::vector<std::uint32_t> hidden_;
};

}  // namespace

void mend_stored_indices(const Reading& reading, Edits& edits) {
    Mender mender(reading, edits);
    for (const Statement& one : reading.statements)
        if (is_loop(one.kind)) mender.mend(one);
}

}  // namespace glint
