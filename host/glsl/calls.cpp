// Who calls whom.
#include "glsl/parser.h"

namespace glint {
namespace {

class CallFinder {
public:
    CallFinder(const std::vector<Token>& tokens, Syntax& syntax)
        : tokens_(tokens), syntax_(syntax) {}

    void find_in(TokenRange range, std::uint32_t function);

private:
    void open(std::uint32_t at, std::uint32_t begin, std::uint32_t function);

    const std::vector<Token>& tokens_;
    Syntax& syntax_;
    std::vector<std::uint32_t> open_;  // calls whose parentheses are open, kNone for other brackets
};

void CallFinder::find_in(TokenRange range, std::uint32_t function) {
    open_.clear();
    for (std::uint32_t at = range.begin; at < range.end; ++at) {
        if (tokens_[at].is(",")) {
            if (!open_.empty() && open_.back() != kNone) ++syntax_.calls[open_.back()].arity;
        } else if (syntax_.partner[at] != kNone) {
            if (syntax_.close_of(at) != kNone)
                open(at, range.begin, function);
            else if (!open_.empty())
                open_.pop_back();
        }
    }
}

// At a bracket.
void CallFinder::open(std::uint32_t at, std::uint32_t begin, std::uint32_t function) {
    open_.push_back(kNone);
    if (!tokens_[at].is("(")) return;
    std::uint32_t name = at;  // before an array's length, too: `float[2](a, b)`
    while (name > begin && tokens_[name - 1].is("]") && syntax_.partner[name - 1] != kNone)
        name = syntax_.partner[name - 1];
    if (name <= begin || !tokens_[name - 1].is_word() || is_keyword(tokens_[name - 1].text)) return;
    open_.back() = static_cast<std::uint32_t>(syntax_.calls.size());
    const std::uint32_t close = syntax_.close_of(at);
    const bool is_bare = close == at + 1 || (close == at + 2 && tokens_[at + 1].is("void"));
    syntax_.calls.push_back({name - 1, {at, close + 1}, is_bare ? 0u : 1u, function});
}

}  // namespace

void find_calls(const std::vector<Token>& tokens, Syntax& syntax) {
    CallFinder finder(tokens, syntax);
    for (const Item& item : syntax.items) {
        if (item.kind == Item::Kind::function && syntax.functions[item.index].is_defined())
            finder.find_in(syntax.functions[item.index].body, item.index);
        else if (item.kind == Item::Kind::declaration)
            finder.find_in(item.tokens, kNone);
    }
}

}  // namespace glint
