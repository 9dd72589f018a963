// Finding `uniform` declarations in GLSL.
#include "glsl/declaration.h"

#include <algorithm>

namespace glint {
namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
std::size_t word_end(std::string_view code, std::size_t begin) {
    while (begin < code.size() && is_word(code[begin])) ++begin;
    return begin;
}

bool is_precision(std::string_view word) {
    return word == "highp" || word == "mediump" || word == "lowp";
}

// Walks over words and single characters, past preprocessor lines.
class Tokens {
public:
    explicit Tokens(std::string_view code) : code_(code) { next(); }

    std::string_view word() const { return code_.substr(begin_, end_ - begin_); }
    std::size_t begin() const { return begin_; }
    std::size_t end() const { return end_; }
    bool done() const { return begin_ == code_.size(); }
    bool is(char c) const { return !done() && code_[begin_] == c; }
    bool is_name() const { return !done() && is_letter(code_[begin_]); }

    void next() {
        begin_ = skip_space(end_);
        if (done())
            end_ = begin_;
        else
            end_ = is_word(code_[begin_]) ? word_end(code_, begin_) : begin_ + 1;
    }

private:
    // A backslash outside preprocessor lines only joins lines, so that it is space here.
    std::size_t skip_space(std::size_t at) {
        for (; at < code_.size(); ++at) {
            const char c = code_[at];
            if (c == '\n') {
                line_begins_ = line_begins_ || at == 0 || code_[at - 1] != '\\';
            } else if (c == '#' && line_begins_) {
                at = directive_end(at);
                if (at == code_.size()) break;
            } else if (c != ' ' && c != '\t' && c != '\\' && c != '\v' && c != '\f') {
                line_begins_ = false;
                return at;
            }
        }
        return code_.size();
    }

    // The newline that ends a directive, or the end of the code.
    std::size_t directive_end(std::size_t at) const {
        do {
            at = code_.find('\n', at + 1);
        } while (at != std::string_view::npos && code_[at - 1] == '\\');
        return std::min(at, code_.size());
    }

    std::string_view code_;
    std::size_t begin_ = 0, end_ = 0;
    bool line_begins_ = true;
};

// Reads `[4]`; false when the bracket does not close before the declaration ends.
bool parse_array(Tokens& tokens, std::string_view code, std::string_view& size) {
    const std::size_t open = tokens.end();
    for (tokens.next(); !tokens.is(']'); tokens.next())
        if (tokens.done() || tokens.is(';') || tokens.is('{')) return false;
    size = code.substr(open, tokens.begin() - open);
    while (!size.empty() && size.front() == ' ') size.remove_prefix(1);
    while (!size.empty() && size.back() == ' ') size.remove_suffix(1);
    tokens.next();
    return true;
}

// Reads `name`, `name[4]` or `name = value`, up to the comma or semicolon.
bool parse_declarator(Tokens& tokens, std::string_view code, Declaration& declaration,
                      Declarator declarator) {
    if (!tokens.is_name()) return false;
    declarator.name = tokens.word();
    declarator.span = {tokens.begin(), tokens.end()};
    tokens.next();
    if (tokens.is('[')) {
        declarator.is_array = true;
        if (!parse_array(tokens, code, declarator.array)) return false;
    }
    if (tokens.is('=')) declarator.has_initial = true;
    for (int depth = 0; declarator.has_initial && !tokens.is(';'); tokens.next()) {
        if (tokens.done()) return false;
        if (tokens.is('(')) ++depth;
        if (tokens.is(')')) --depth;
        if (tokens.is(',') && depth == 0) break;
    }
    if (!tokens.is(',') && !tokens.is(';')) return false;
    declarator.span.end = tokens.begin();
    declaration.names.push_back(declarator);
    return true;
}

// Reads on from `uniform`. Stops at the semicolon or where it no longer understands.
Declaration parse_uniform(Tokens& tokens, std::string_view code, std::size_t begin) {
    Declaration declaration;
    declaration.span = {begin, tokens.end()};
    declaration.is_broken = true;
    tokens.next();
    while (is_precision(tokens.word())) tokens.next();
    declaration.type = tokens.word();
    declaration.type_at = tokens.begin();
    if (!tokens.is_name()) return declaration;
    tokens.next();
    if (declaration.type == "struct" || tokens.is('{')) {
        declaration.is_block = true;
        declaration.span.end = tokens.end();
        return declaration;
    }
    Declarator like;  // `float[4] name` makes each name an array
    if (tokens.is('[')) {
        like.is_array = true;
        if (!parse_array(tokens, code, like.array)) return declaration;
    }
    while (parse_declarator(tokens, code, declaration, like)) {
        declaration.span.end = tokens.end();
        declaration.is_broken = !tokens.is(';');
        if (!declaration.is_broken) break;
        tokens.next();
    }
    return declaration;
}

}  // namespace

bool is_word(char c) {
    return is_letter(c) || is_digit(c);
}

std::size_t find_word(std::string_view text, std::string_view word, std::size_t from) {
    for (std::size_t at = text.find(word, from); at != text.npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_word(text[at - 1])) && (end == text.size() || !is_word(text[end]))) {
            return at;
        }
    }
    return text.npos;
}

std::vector<Declaration> find_uniforms(std::string_view code) {
    std::vector<Declaration> declarations;
    Tokens tokens(code);
    std::size_t statement = tokens.begin();
    bool has_layout = false;  // the statement begins with something that belongs to a declaration
    bool begins = true;
    while (!tokens.done()) {
        if (begins) {
            statement = tokens.begin();
            has_layout = tokens.word() == "layout" || is_precision(tokens.word());
        }
        if (tokens.word() == "uniform") {
            const std::size_t begin = has_layout ? statement : tokens.begin();
            declarations.push_back(parse_uniform(tokens, code, begin));
            // Whatever stopped the parser is looked at again, it may be the next `uniform`.
            begins = false;
            has_layout = false;
            continue;
        }
        begins = tokens.is(';') || tokens.is('}') || tokens.is('{');
        tokens.next();
    }
    return declarations;
}

std::vector<Tab> find_tabs(std::string_view code) {
    std::vector<Tab> tabs, open;  // open: an entry for each #if; no name where it is no tab
    const auto close = [&](std::size_t end) {
        if (open.back().pass.empty()) return;
        tabs.push_back({{open.back().span.begin, end}, open.back().pass});
        open.back().pass = {};
    };
    for (std::size_t begin = 0, end = 0; begin < code.size(); begin = end + 1) {
        end = std::min(code.find('\n', begin), code.size());
        const std::string_view line = code.substr(begin, end - begin);
        const std::size_t hash = line.find_first_not_of(" \t");
        if (hash == line.npos || line[hash] != '#') continue;
        Tokens words(line.substr(hash + 1));
        const std::string_view directive = words.word();
        if (directive.starts_with("if")) {
            words.next();
            if (words.word() == "defined") words.next();
            if (words.is('(')) words.next();
            const bool is_tab = directive != "ifndef" && words.word().starts_with("PASS_");
            open.push_back({{end, end}, is_tab ? words.word().substr(5) : std::string_view()});
        } else if (directive.starts_with("el") && !open.empty()) {
            close(begin);
        } else if (directive == "endif" && !open.empty()) {
            close(begin);
            open.pop_back();
        }
    }
    return tabs;
}

std::vector<std::string> find_pass_functions(std::string_view code) {
    std::vector<std::string> names;
    for (Tokens tokens(code); !tokens.done();) {
        const bool is_void = tokens.word() == "void";
        tokens.next();
        if (!is_void || !tokens.is_name()) continue;
        const std::string name(tokens.word());
        tokens.next();
        if (!tokens.is('(')) continue;
        tokens.next();
        if (tokens.word() != "out" && tokens.word() != "inout") continue;
        tokens.next();
        while (is_precision(tokens.word())) tokens.next();
        if (tokens.word() != "vec4") continue;
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

std::unordered_set<std::string_view> find_identifiers(std::string_view code) {
    std::unordered_set<std::string_view> words;
    for (std::size_t i = 0; i < code.size();) {
        const std::size_t end = is_word(code[i]) ? word_end(code, i) : i + 1;
        if (is_letter(code[i])) words.insert(code.substr(i, end - i));
        i = end;
    }
    return words;
}

}  // namespace glint
