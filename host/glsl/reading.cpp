#include "glsl/reading.h"

#include <algorithm>
#include <utility>

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

std::vector<std::uint32_t> Reading::places_of(std::initializer_list<std::string_view> words) const {
    if (places_.empty())
        for (std::uint32_t at = 0; at < tokens.size(); ++at) places_[tokens[at].text].push_back(at);
    std::vector<std::uint32_t> all;
    for (const std::string_view one : words)
        if (const auto found = places_.find(one); found != places_.end())
            all.insert(all.end(), found->second.begin(), found->second.end());
    if (words.size() > 1) std::ranges::sort(all);
    return all;
}

std::vector<std::uint32_t> Reading::functions_named(std::string_view name) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < functions.size(); ++i)
        if (word(functions[i].name) == name) found.push_back(i);
    return found;
}

bool Reading::is_for_the_host(const Function& function, std::string_view entry) const {
    return word(function.name) == entry && std::ranges::none_of(calls, [&](const Call& call) {
               return word(call.name) == entry && call.arity == function.parameters.size();
           });
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

std::vector<bool> Reading::reached_from(const std::vector<std::string_view>& names,
                                        bool with_globals) const {
    using Key = std::pair<std::string_view, std::size_t>;
    std::vector<std::pair<Key, std::uint32_t>> by_name;  // sorted
    for (std::uint32_t i = 0; i < functions.size(); ++i)
        by_name.push_back({{word(functions[i].name), functions[i].parameters.size()}, i});
    std::ranges::sort(by_name);
    std::vector<bool> reached(functions.size());
    std::vector<std::uint32_t> fresh;
    const auto reach = [&](std::uint32_t function) {
        if (!reached[function]) fresh.push_back(function);
        reached[function] = true;
    };
    const auto reach_called = [&](const Call& call) {
        const Key key = {word(call.name), call.arity};
        for (auto i = std::ranges::lower_bound(by_name, std::pair{key, 0u});
             i != by_name.end() && i->first == key; ++i)
            reach(i->second);
    };
    for (const std::string_view name : names)
        for (const std::uint32_t function : functions_named(name)) reach(function);
    std::vector<std::vector<std::uint32_t>> calls_of(functions.size());
    for (std::uint32_t i = 0; i < calls.size(); ++i) {
        if (calls[i].function != kNone)
            calls_of[calls[i].function].push_back(i);
        else if (with_globals)
            reach_called(calls[i]);
    }
    while (!fresh.empty()) {
        const std::uint32_t function = fresh.back();
        fresh.pop_back();
        for (const std::uint32_t call : calls_of[function]) reach_called(calls[call]);
    }
    return reached;
}

std::vector<TokenRange> Reading::arguments_of(const Call& call) const {
    std::vector<TokenRange> arguments;
    if (call.arity == 0) return arguments;
    const std::uint32_t end = call.brackets.end - 1;
    std::uint32_t begin = call.brackets.begin + 1;
    for (std::uint32_t at = begin; at <= end; ++at) {
        if (at == end || tokens[at].is(",")) {
            arguments.push_back({begin, at});
            begin = at + 1;
        } else if (const std::uint32_t close = close_of(at); close != kNone) {
            at = close;
        }
    }
    return arguments;
}

Reading read_glsl(std::string_view text, const Known& known) {
    Reading reading;
    static_cast<Preprocessed&>(reading) = preprocess(text, known);
    static_cast<Syntax&>(reading) = parse(reading);
    return reading;
}

}  // namespace glint
