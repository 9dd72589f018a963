#include "glsl/reading.h"

#include <algorithm>

namespace glint {

bool Reading::is_plain(TokenRange range) const {
    for (std::uint32_t at = range.begin; at < range.end; ++at)
        if (tokens[at].use != kNone) return false;
    return true;
}

bool Reading::stands_alone(TokenRange range) const {
    if (range.empty()) return false;
    const std::uint32_t first = tokens[range.begin].use, last = tokens[range.end - 1].use;
    return (first == kNone || uses[first].tokens.begin == range.begin) &&
           (last == kNone || uses[last].tokens.end == range.end);
}

std::string Reading::spelled(TokenRange range) const {
    std::string result;
    for (std::uint32_t at = range.begin; at < range.end; ++at) {
        if (at > range.begin) result += ' ';
        result += tokens[at].text;
    }
    return result;
}

std::vector<std::uint32_t> Reading::functions_named(std::string_view name) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < functions.size(); ++i)
        if (word(functions[i].name) == name) found.push_back(i);
    return found;
}

bool Reading::defines_macro(std::string_view name) const {
    return std::ranges::any_of(
        macros, [&](const Macro& macro) { return macro.name == name && macro.definition.end > 0; });
}

const Declaration* Reading::find_global(std::string_view name) const {
    const auto found = std::ranges::find_if(declarations, [&](const Declaration& declaration) {
        return declaration.scope == Scope::global &&
               std::ranges::any_of(declaration.names,
                                   [&](const Declarator& one) { return word(one.name) == name; });
    });
    return found == declarations.end() ? nullptr : &*found;
}

Reading read_glsl(std::string_view text, const Known& known) {
    Reading reading;
    static_cast<Preprocessed&>(reading) = preprocess(text, known);
    static_cast<Syntax&>(reading) = parse(reading);
    return reading;
}

}  // namespace glint
