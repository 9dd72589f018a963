// What names hide, and which are kept. A name's scope ends with the block, loop or switch in which
// it is declared (GLSL ES 3.00, 4.2.2).
#include "glsl/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>

namespace glint {
namespace {

// Functions of GLSL ES 3.00, chapter 8.
constexpr auto kBuiltIn = std::to_array<std::string_view>({"abs",
                                                           "acos",
                                                           "acosh",
                                                           "all",
                                                           "any",
                                                           "asin",
                                                           "asinh",
                                                           "atan",
                                                           "atanh",
                                                           "ceil",
                                                           "clamp",
                                                           "cos",
                                                           "cosh",
                                                           "cross",
                                                           "dFdx",
                                                           "dFdy",
                                                           "degrees",
                                                           "determinant",
                                                           "distance",
                                                           "dot",
                                                           "equal",
                                                           "exp",
                                                           "exp2",
                                                           "faceforward",
                                                           "floatBitsToInt",
                                                           "floatBitsToUint",
                                                           "floor",
                                                           "fract",
                                                           "fwidth",
                                                           "greaterThan",
                                                           "greaterThanEqual",
                                                           "intBitsToFloat",
                                                           "inverse",
                                                           "inversesqrt",
                                                           "isinf",
                                                           "isnan",
                                                           "length",
                                                           "lessThan",
                                                           "lessThanEqual",
                                                           "log",
                                                           "log2",
                                                           "matrixCompMult",
                                                           "max",
                                                           "min",
                                                           "mix",
                                                           "mod",
                                                           "modf",
                                                           "normalize",
                                                           "not",
                                                           "notEqual",
                                                           "outerProduct",
                                                           "packHalf2x16",
                                                           "packSnorm2x16",
                                                           "packUnorm2x16",
                                                           "pow",
                                                           "radians",
                                                           "reflect",
                                                           "refract",
                                                           "round",
                                                           "roundEven",
                                                           "sign",
                                                           "sin",
                                                           "sinh",
                                                           "smoothstep",
                                                           "sqrt",
                                                           "step",
                                                           "tan",
                                                           "tanh",
                                                           "texelFetch",
                                                           "texelFetchOffset",
                                                           "texture",
                                                           "textureGrad",
                                                           "textureGradOffset",
                                                           "textureLod",
                                                           "textureLodOffset",
                                                           "textureOffset",
                                                           "textureProj",
                                                           "textureProjGrad",
                                                           "textureProjGradOffset",
                                                           "textureProjLod",
                                                           "textureProjLodOffset",
                                                           "textureProjOffset",
                                                           "textureSize",
                                                           "transpose",
                                                           "trunc",
                                                           "uintBitsToFloat",
                                                           "unpackHalf2x16",
                                                           "unpackSnorm2x16",
                                                           "unpackUnorm2x16"});

struct Name {
    std::uint32_t token = kNone;
    std::uint32_t end = kNone;  // the first token behind its scope
    const char* what = "";
};

class ShadowFinder {
public:
    ShadowFinder(const Reading& reading, const std::vector<bool>& wanted,
                 bool (*is_hosts)(std::string_view))
        : reading_(reading), wanted_(wanted), is_hosts_(is_hosts) {
        const auto end = static_cast<std::uint32_t>(reading.tokens.size());
        for (const Function& function : reading.functions)
            outside_[reading.word(function.name)].push_back({function.name, end, "function"});
        for (const Declaration& declaration : reading.declarations) {
            if (declaration.scope != Scope::global) continue;
            const char* what = declaration.is_uniform ? "uniform" : "global";
            for (const Declarator& one : declaration.names)
                outside_[reading.word(one.name)].push_back({one.name, end, what});
        }
    }

    std::vector<Finding> find() {
        std::uint32_t inside = kNone;
        for (const Declaration& declaration : reading_.declarations) {
            const bool is_parameter = declaration.scope == Scope::parameter;
            if (!is_parameter && declaration.scope != Scope::local) continue;
            const Function& function = reading_.functions[declaration.owner];
            if (!wanted_[declaration.owner] || !function.is_defined()) continue;
            if (declaration.owner != inside) inside_.clear();
            inside = declaration.owner;
            const std::uint32_t end =
                is_parameter ? function.tokens.end : scope_end(declaration, function);
            for (const Declarator& one : declaration.names)
                if (one.name != kNone)
                    look_at({one.name, end, is_parameter ? "parameter" : "local"});
        }
        for (std::uint32_t i = 0; i < reading_.functions.size(); ++i)
            if (wanted_[i] && reading_.functions[i].is_defined()) look_at(reading_.functions[i]);
        return std::move(findings_);
    }

private:
    std::uint32_t scope_end(const Declaration& declaration, const Function& function) const {
        if (declaration.statement == kNone) return function.tokens.end;
        const Statement& own = reading_.statements[declaration.statement];
        const bool is_in_block = own.kind == StatementKind::declaration && own.parent != kNone &&
                                 reading_.statements[own.parent].kind == StatementKind::block;
        return is_in_block ? reading_.statements[own.parent].tokens.end : own.tokens.end;
    }

    void look_at(const Name& name) {
        const std::string_view word = reading_.word(name.token);
        std::vector<Name>& known = inside_[word];
        while (!known.empty() && known.back().end <= name.token) known.pop_back();
        const Name* hidden = known.empty() ? nullptr : &known.back();
        if (const auto found = outside_.find(word); !hidden && found != outside_.end())
            for (const Name& one : found->second)
                if (one.token < name.token) hidden = &one;
        if (hidden)
            findings_.push_back({"shadowed-name", reading_.place(name.token).begin,
                                 fmt::format("the {} `{}` hides the {} of this name", name.what,
                                             word, hidden->what),
                                 reading_.place(hidden->token).begin});
        else if (known.empty() && is_hosts_ && is_hosts_(word))
            findings_.push_back(
                {"shadowed-name",
                 reading_.place(name.token).begin,
                 fmt::format("the {} `{}` hides the host's uniform of this name", name.what, word),
                 {}});
        known.push_back(name);
    }

    void look_at(const Function& function) {
        const std::string_view word = reading_.word(function.name);
        if (std::ranges::find(kBuiltIn, word) == kBuiltIn.end()) return;
        findings_.push_back({"shadowed-name",
                             reading_.place(function.name).begin,
                             fmt::format("the function `{}` has the name of one that GLSL has; "
                                         "GLSL ES 3.00 forbids that, and browsers take few such "
                                         "names: give it another",
                                         word),
                             {}});
    }

    const Reading& reading_;
    const std::vector<bool>& wanted_;
    bool (*is_hosts_)(std::string_view);
    std::unordered_map<std::string_view, std::vector<Name>> outside_, inside_;
    std::vector<Finding> findings_;
};

}  // namespace

std::span<const std::string_view> built_in_functions() {
    return kBuiltIn;
}

std::vector<Finding> find_shadowed_names(const Reading& reading, const std::vector<bool>& wanted,
                                         bool (*is_hosts)(std::string_view)) {
    return ShadowFinder(reading, wanted, is_hosts).find();
}

std::vector<Finding> find_reserved_names(const Reading& reading, const std::vector<bool>& wanted) {
    std::vector<Finding> findings;
    std::unordered_set<std::string_view> seen;
    for (const Item& item : reading.items) {
        if (item.kind == Item::Kind::function && !wanted[item.index]) continue;
        for (std::uint32_t at = item.tokens.begin; at < item.tokens.end; ++at) {
            const std::string_view word = reading.word(at);
            const bool is_reserved = word.find("__") != word.npos || word.starts_with("webgl_") ||
                                     word.starts_with("_webgl_");
            if (!is_reserved || !reading.tokens[at].is_word() || !seen.insert(word).second)
                continue;
            findings.push_back(
                {kWebGl,
                 reading.place(at).begin,
                 fmt::format("`{}` is a name that GLSL ES 3.00 and WebGL keep for themselves, and "
                             "browsers refuse it: give it another{}",
                             word, word.find("__") != word.npos ? " without __" : ""),
                 {}});
        }
    }
    return findings;
}

}  // namespace glint
