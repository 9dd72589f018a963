#include "render/own_words.h"

#include <array>
#include <regex>
#include <string_view>
#include <utility>

namespace glint {

std::string in_own_words(const std::string& complaint) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kOfGl = {
        {{kPlainColour, "gl_FragColor"}, {"glFragCoord_", "gl_FragCoord"}}};
    std::string text = complaint;
    for (const auto& [ours, theirs] : kOfGl)
        for (std::size_t at = text.find(ours); at != text.npos; at = text.find(ours, at + 1))
            text.replace(at, ours.size(), theirs);
    if (text.find("glint_") == text.npos) return text;
    static const std::regex renamed(R"(\bglint_([A-Za-z]\w*))");
    return std::regex_replace(text, renamed, "$1");
}

std::vector<Token> tokens_as_written(const Preprocessed& read, const PassText& pass) {
    std::vector<Token> tokens = read.tokens;
    const auto place = [&](const Token& token) {
        return token.use == kNone ? token.span() : read.uses[token.use].span;
    };
    while (!tokens.empty() && place(tokens.back()).begin >= pass.user_end) tokens.pop_back();
    for (Token& token : tokens) {
        if (token.use == kNone || pass.origin(token.begin)) continue;
        const Span span = place(token);
        const std::string_view word = read.text.substr(span.begin, span.end - span.begin);
        if (pass.origin(span.begin) && word.find('(') == word.npos) token.text = word;
    }
    return tokens;
}

}  // namespace glint
