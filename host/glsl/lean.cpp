#include "glsl/lean.h"

#include <algorithm>
#include <deque>

namespace glint {
namespace {

// The name that a global declares alone, of a constant or one that will be.
std::string_view constant_name(const Reading& reading, const Declaration& declaration,
                               const std::unordered_set<std::string_view>& uniforms) {
    if (declaration.names.size() != 1 || declaration.structure != kNone) return {};
    const std::string_view name = reading.word(declaration.names.front().name);
    return declaration.is_const || uniforms.contains(name) ? name : std::string_view();
}

}  // namespace

bool stands_for_itself(const Reading& reading, Span span) {
    int depth = 0;
    auto directive = std::ranges::lower_bound(reading.directives, span.begin, {},
                                              [](const Directive& d) { return d.span.begin; });
    for (; directive != reading.directives.end() && directive->span.begin < span.end; ++directive) {
        const std::string_view word = directive->word;
        if (word == "if" || word == "ifdef" || word == "ifndef")
            ++depth;
        else if (word == "endif")
            --depth;
        else if (word != "else" && word != "elif")
            return false;
        if (depth < 0 || (depth == 0 && word != "endif")) return false;
    }
    return depth == 0;
}

bool may_be_left_out(const Reading& reading, TokenRange tokens) {
    return reading.stands_alone(tokens) && stands_for_itself(reading, reading.place(tokens));
}

bool can_be_lean(const Reading& reading) {
    return reading.is_balanced && reading.not_understood.empty() && !reading.unclosed_comment &&
           !reading.mentions("__LINE__");
}

void leave_out_functions(const Reading& reading, const std::vector<bool>& reached, Edits& edits) {
    for (std::uint32_t i = 0; i < reading.functions.size(); ++i) {
        const TokenRange tokens = reading.functions[i].tokens;
        if (!reached[i] && may_be_left_out(reading, tokens))
            edits.replace_bytes(reading.place(tokens), "");
    }
}

std::unordered_set<std::string_view> unused_constants(
    const Reading& reading, const std::vector<bool>& reached,
    const std::unordered_set<std::string_view>& uniforms) {
    std::unordered_set<std::string_view> used, unused;
    const auto use = [&](TokenRange range) {
        for (std::uint32_t at = range.begin; at < range.end; ++at)
            if (reading.tokens[at].is_word()) used.insert(reading.tokens[at].text);
    };
    for (std::uint32_t i = 0; i < reading.functions.size(); ++i) {
        const TokenRange tokens = reading.functions[i].tokens;
        if (reached[i] || !may_be_left_out(reading, tokens)) use(tokens);
    }
    // What a global asks for stands before it.
    for (auto item = reading.items.rbegin(); item != reading.items.rend(); ++item) {
        if (item->kind == Item::Kind::function) continue;
        std::string_view name;
        if (item->kind == Item::Kind::declaration)
            name = constant_name(reading, reading.declarations[item->index], uniforms);
        if (!name.empty() && !used.contains(name) && may_be_left_out(reading, item->tokens))
            unused.insert(name);
        else
            use(item->tokens);
    }
    return unused;
}

void leave_out_constants(const Reading& reading, const std::unordered_set<std::string_view>& unused,
                         Edits& edits) {
    for (const Item& item : reading.items) {
        if (item.kind != Item::Kind::declaration) continue;
        const Declaration& declaration = reading.declarations[item.index];
        if (declaration.is_const && unused.contains(constant_name(reading, declaration, {})))
            edits.replace_bytes(reading.place(item.tokens), "");
    }
}

void leave_out_semicolons(const Reading& reading, Edits& edits) {
    for (const Item& item : reading.items)
        if (item.tokens.size() == 1 && reading.tokens[item.tokens.begin].is(";"))
            edits.replace(item.tokens, " ");  // so that no column moves
}

std::string without_comments(std::string_view text) {
    std::deque<std::string> spellings;
    const ScannedText scanned = scan(text, spellings);
    std::string result;
    auto directive = scanned.directives.begin();
    for (std::uint32_t at = 0; at < scanned.tokens.size(); ++at) {
        const Token& token = scanned.tokens[at];
        if (!result.empty() && token.begins_line)
            result += '\n';
        else if (!result.empty() && token.space_before)
            result += ' ';
        if (directive != scanned.directives.end() && directive->tokens.begin == at) {
            const Span span = directive->span;
            result += text.substr(span.begin, span.end - span.begin);
            at = directive->tokens.end - 1;
            ++directive;
        } else {
            result += token.text;
        }
    }
    return result += '\n';
}

}  // namespace glint
