// What ANGLE, the compiler of browsers, refuses by rules of its own.
#include "glsl/finding.h"
#include "glsl/operands.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace glint {
namespace {

class BrowserRules {
public:
    BrowserRules(const Reading& reading, const std::vector<bool>& wanted)
        : reading_(reading), wanted_(wanted) {
        for (const Struct& one : reading.structs)
            if (one.name != kNone) structs_.insert(reading.word(one.name));
    }

    std::vector<Finding> find() {
        for (const Declaration& declaration : reading_.declarations) {
            for (const Declarator& one : declaration.names) look_at(declaration, one);
            refuse_output(declaration);
        }
        for (const Statement& statement : reading_.statements)
            if (is_wanted(statement.function)) look_at(statement);
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

    void refuse_choice(TokenRange range, std::string_view of) {
        const std::uint32_t choice = choice_in(range);
        if (choice == kNone) return;
        add(reading_.place(choice).begin,
            fmt::format(
                "browsers refuse ?: for {}, which desktop compilers take: write if and else", of));
    }

    // `out vec4 colour;` beside the output that mainImage writes.
    void refuse_output(const Declaration& declaration) {
        const bool is_output = declaration.scope == Scope::global && declaration.is_out;
        if (!is_output || reading_.functions_named("mainImage").empty()) return;
        add(reading_.place(declaration.tokens.begin).begin,
            "browsers refuse a second output without a location, and the site has one of its own: "
            "take out this 'out'");
    }

    void look_at(const Declaration& declaration, const Declarator& one) {
        const bool is_local = declaration.scope == Scope::local;
        if (one.initial.empty() || (is_local && !is_wanted(declaration.owner))) return;
        if (!one.array.empty() || !declaration.type_array.empty())
            refuse_choice(one.initial, "arrays");
        else if (is_of_struct(declaration))
            refuse_choice(one.initial, "structures");
    }

    void look_at(const Statement& statement) {
        if (statement.kind == StatementKind::return_) {
            const Function& function = reading_.functions[statement.function];
            if (!function.type_array.empty())
                refuse_choice(statement.head, "arrays");
            else if (structs_.contains(reading_.word(function.type)))
                refuse_choice(statement.head, "structures");
        }
        if (statement.kind != StatementKind::expression) return;
        const TokenRange all = {statement.tokens.begin, statement.tokens.end - 1};
        const bool assigns = all.size() > 2 && reading_.tokens[all.begin + 1].is("=");
        const TokenRange value = {all.begin + 2, all.end};
        if (assigns && choice_in(value) != kNone &&
            is_struct_variable(all.begin, statement.function))
            refuse_choice(value, "structures");
        const std::uint32_t choice = assigns ? kNone : choice_in(all);
        if (choice != kNone && gives_nothing(choice + 1)) refuse_choice(all, "void");
    }

    // Of what was declared last by that name, in the function or outside of all.
    bool is_struct_variable(std::uint32_t name, std::uint32_t function) const {
        bool is_struct = false;
        for (const Declaration& declaration : reading_.declarations) {
            const bool is_seen =
                declaration.scope == Scope::global ||
                (declaration.scope != Scope::member && declaration.owner == function);
            for (const Declarator& one : declaration.names)
                if (is_seen && one.name < name && reading_.word(one.name) == reading_.word(name))
                    is_struct = one.array.empty() && is_of_struct(declaration);
        }
        return is_struct;
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
    }

    const Reading& reading_;
    const std::vector<bool>& wanted_;
    std::unordered_set<std::string_view> structs_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> find_refused_by_browsers(const Reading& reading,
                                              const std::vector<bool>& wanted) {
    return reading.is_balanced ? BrowserRules(reading, wanted).find() : std::vector<Finding>();
}

}  // namespace glint
