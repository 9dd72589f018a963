#include "glsl/reachable.h"

#include "glsl/declaration.h"
#include "glsl/raw_text.h"

#include <algorithm>
#include <unordered_set>
#include <vector>

namespace glint {
namespace {

// Something that stands outside all braces, or a preprocessor line, with the comments before it.
// What has a preprocessor line in its midst, outside braces, counts as one itself.
struct Item {
    Span span;
    bool is_directive = false, is_uniform = false, kept = false;
    std::unordered_set<std::string_view> names, words;  // what it declares, and all it speaks of
};

// The name of a function or struct, or the names of variables: words outside brackets that an
// operator, a bracket or the end follows.
std::unordered_set<std::string_view> declared_names(std::string_view code) {
    std::unordered_set<std::string_view> names;
    int depth = 0;
    bool in_value = false;
    for (std::size_t i = 0; i < code.size();) {
        if (!is_word(code[i])) {
            const char c = code[i++];
            if (c == '(' || c == '[' || c == '{') ++depth;
            if (c == ')' || c == ']' || c == '}') --depth;
            if (c == '=' && depth == 0) in_value = true;
            if (c == ',' && depth == 0) in_value = false;
            continue;
        }
        std::size_t end = i;
        while (end < code.size() && is_word(code[end])) ++end;
        const std::size_t next = code.find_first_not_of(" \t\n", end);
        const bool ends_name = next == code.npos || std::string_view("=,;[({").find(code[next]) !=
                                                        std::string_view::npos;
        if (depth == 0 && !in_value && ends_name) names.insert(code.substr(i, end - i));
        i = end;
    }
    return names;
}

// Cuts the text into items. A function ends with its brace, everything else with a semicolon.
std::vector<Item> find_items(std::string_view text, std::string_view code) {
    std::vector<Item> items;
    std::size_t begin = 0;
    int depth = 0;
    bool has_parameters = false, is_blank = true, holds_directive = false;
    const auto add = [&](std::size_t end, bool is_directive) {
        // The rest of the line belongs to it: a comment behind it.
        const std::size_t line_end = std::min(text.find('\n', end), text.size() - 1) + 1;
        if (code.substr(end, line_end - end).find_first_not_of(" \t\n") == code.npos)
            end = line_end;
        Item item{.span = {begin, end},
                  .is_directive = is_directive || holds_directive,
                  .names = {},
                  .words = {}};
        const std::string_view own = code.substr(begin, end - begin);
        item.words = find_identifiers(own);
        item.is_uniform = item.words.contains("uniform");
        if (!is_directive) item.names = declared_names(own);
        items.push_back(std::move(item));
        begin = end;
        has_parameters = false;
        is_blank = true;
        holds_directive = false;
        return end;
    };
    for (std::size_t i = 0; i < code.size();) {
        const char c = code[i];
        const bool line_begins = i == 0 || code[i - 1] == '\n';
        if (line_begins && depth == 0) {
            const std::size_t first = code.find_first_not_of(" \t", i);
            if (first != code.npos && code[first] == '#') {
                std::size_t end = std::min(code.find('\n', first), code.size());
                while (end < code.size() && code[end - 1] == '\\')
                    end = std::min(code.find('\n', end + 1), code.size());
                holds_directive = true;
                i = is_blank ? add(end, true) : end;
                continue;
            }
        }
        if (c != ' ' && c != '\t' && c != '\n') is_blank = false;
        if (c == '(' && depth == 0) has_parameters = true;
        if (c == '{') ++depth;
        if (c == '}') --depth;
        ++i;
        if (depth == 0 && (c == ';' || (c == '}' && has_parameters))) i = add(i, false);
    }
    if (begin < text.size()) add(text.size(), true);
    return items;
}

}  // namespace

std::string reachable_text(std::string_view text, std::string_view entry) {
    const std::string code = find_comments(text).code;
    std::vector<Item> items = find_items(text, code);
    std::vector<std::string_view> wanted = {entry};
    std::unordered_set<std::string_view> seen = {entry};
    const auto want = [&](const Item& item) {
        for (const std::string_view word : item.words)
            if (seen.insert(word).second) wanted.push_back(word);
    };
    for (Item& item : items) {
        item.kept = item.is_directive;
        if (item.is_directive) want(item);
    }
    while (!wanted.empty()) {
        const std::string_view name = wanted.back();
        wanted.pop_back();
        for (Item& item : items) {
            if (item.kept || item.is_uniform || !item.names.contains(name)) continue;
            item.kept = true;
            want(item);
        }
    }
    std::string result;
    for (const Item& item : items)
        if (item.kept) result.append(text, item.span.begin, item.span.end - item.span.begin);
    return result;
}

}  // namespace glint
