// What Mesa takes and no driver may: `tone(c) *= 2.0;`, which it then forgets, and
// `struct S { float a; vec2 a; };`.
#include "glsl/finding.h"
#include "glsl/operands.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace glint {
namespace {

class Finder {
public:
    explicit Finder(const Reading& reading) : reading_(reading) {
        for (const Function& function : reading.functions)
            for (const std::uint32_t parameter : function.parameters)
                if (reading.declarations[parameter].is_out)
                    handing_back_.insert(reading.word(function.name));
    }

    std::vector<Finding> find() {
        for (const std::uint32_t sign : reading_.places_of(
                 {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "<<=", ">>=", "^="}))
            look_at({operand_begin(reading_, sign, 0), sign});
        for (const std::uint32_t sign : reading_.places_of({"++", "--"})) {
            const std::uint32_t begin = operand_begin(reading_, sign, 0), next = sign + 1;
            if (begin < sign) {
                look_at({begin, sign});
            } else if (next < count() && (token(next).is("(") || token(next).is_word())) {
                look_at({next, operand_end(reading_, next, count())});  // after signs is no value
            }
        }
        for (const Call& call : reading_.calls) look_at_arguments(call);
        for (const Struct& structure : reading_.structs) look_at_members(structure);
        std::ranges::stable_sort(found_, {}, &Finding::at);
        return std::move(found_);
    }

private:
    std::uint32_t count() const { return static_cast<std::uint32_t>(reading_.tokens.size()); }
    const Token& token(std::uint32_t at) const { return reading_.tokens[at]; }

    // What a call gives back, and what `?:`, a comma or an assignment in parentheses comes to. Of
    // parentheses a text may have any number.
    bool is_value(TokenRange range) const {
        while (!range.empty() && token(range.begin).is("(")) {
            const std::uint32_t close = reading_.close_of(range.begin);
            if (close == kNone) return false;
            for (std::uint32_t at = range.begin + 1; at < close; ++at) {
                if (token(at).is("?") || token(at).is(",") || is_assignment(token(at))) return true;
                if (const std::uint32_t inner = reading_.close_of(at); inner != kNone) at = inner;
            }
            range = {range.begin + 1, close};
        }
        return range.size() > 1 && token(range.begin).is_word() && token(range.begin + 1).is("(");
    }

    void look_at(TokenRange range) {
        if (!is_value(range)) return;
        found_.push_back({.name = {},
                          .at = reading_.place(range.begin).begin,
                          .text = fmt::format("'{}' is a value, and no variable that can be given "
                                              "another one; keep it in a variable first",
                                              close_spelling(reading_, range)),
                          .other = {}});
    }

    // Those that all functions of the call's name hand back.
    void look_at_arguments(const Call& call) {
        const std::string_view name = reading_.word(call.name);
        const bool is_of_glsl = hands_out(name, 1) || hands_out(name, 2) || hands_out(name, 3);
        if (call.function == kNone || (!is_of_glsl && !handing_back_.contains(name))) return;
        const std::vector<TokenRange> arguments = reading_.arguments_of(call);
        for (std::size_t i = 0; i < arguments.size(); ++i)
            if (is_value(arguments[i]) && is_handed_back(call, i)) look_at(arguments[i]);
    }

    void look_at_members(const Struct& structure) {
        std::unordered_set<std::string_view> names;
        for (const std::uint32_t member : structure.members)
            for (const Declarator& one : reading_.declarations[member].names)
                if (!names.insert(reading_.word(one.name)).second)
                    found_.push_back({.name = {},
                                      .at = reading_.place(one.name).begin,
                                      .text = fmt::format("a second member '{}'; give it another "
                                                          "name",
                                                          reading_.word(one.name)),
                                      .other = {}});
    }

    bool is_handed_back(const Call& call, std::size_t argument) const {
        const std::string_view name = reading_.word(call.name);
        bool any = false;
        for (const std::uint32_t index : reading_.functions_named(name)) {
            const Function& function = reading_.functions[index];
            if (function.parameters.size() != call.arity) continue;
            if (!reading_.declarations[function.parameters[argument]].is_out) return false;
            any = true;
        }
        return any || (reading_.functions_named(name).empty() && hands_out(name, argument));
    }

    const Reading& reading_;
    std::unordered_set<std::string_view> handing_back_;  // functions with an `out` parameter
    std::vector<Finding> found_;
};

}  // namespace

std::vector<Finding> find_taken_by_mesa(const Reading& reading) {
    return reading.is_balanced ? Finder(reading).find() : std::vector<Finding>();
}

}  // namespace glint
