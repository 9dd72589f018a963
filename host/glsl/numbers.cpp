#include "glsl/numbers.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

namespace glint {
namespace {

// The value of `0.25`, `1e-3`, `.5f`; nothing for integers and what is none.
std::optional<float> float_of(const Token& token) {
    std::string_view text = token.text;
    if (token.kind != TokenKind::number || text.starts_with("0x") || text.starts_with("0X"))
        return std::nullopt;
    if (text.find_first_of(".eE") == text.npos) return std::nullopt;
    if (text.ends_with('f') || text.ends_with('F')) text.remove_suffix(1);
    float value = 0.0f;
    const char* end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || read != end) return std::nullopt;
    return value;
}

// By token: whether it stands where a constant is wanted, or does more good.
std::vector<bool> wanted_constants(const Reading& reading) {
    std::vector<bool> wanted(reading.tokens.size());
    const auto want = [&](TokenRange range) {
        std::fill(wanted.begin() + range.begin, wanted.begin() + range.end, true);
    };
    for (const Declaration& declaration : reading.declarations)
        if (declaration.is_const) want(declaration.tokens);
    for (const Call& call : reading.calls) {
        if (reading.word(call.name) != "pow") continue;
        const std::vector<TokenRange> arguments = reading.arguments_of(call);
        if (arguments.size() == 2) want(arguments[1]);
    }
    return wanted;
}

}  // namespace

std::vector<float> feed_numbers(const Reading& reading, const std::vector<bool>& functions,
                                std::string_view array, Edits& edits) {
    const std::vector<bool> constants = wanted_constants(reading);
    std::vector<float> numbers;
    for (std::uint32_t i = 0; i < reading.functions.size(); ++i) {
        if (!functions[i]) continue;
        const TokenRange body = reading.functions[i].body;
        for (std::uint32_t at = body.begin; at < body.end; ++at) {
            const std::optional<float> value = float_of(reading.tokens[at]);
            if (!value || constants[at] || *value == 0.0f || *value == 1.0f) continue;
            const std::string element = std::string(array) + '[' +
                                        std::to_string(numbers.size() / 4) + "]." +
                                        "xyzw"[numbers.size() % 4];
            if (edits.replace({at, at + 1}, element)) numbers.push_back(*value);
        }
    }
    return numbers;
}

}  // namespace glint
