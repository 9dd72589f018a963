#include "offline/site_names.h"

#include "glsl/edits.h"
#include "glsl/variables.h"
#include "render/pass_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace glint {
namespace {

// Where a text has a word, by what it means there.
struct Places {
    std::vector<std::uint32_t> hosts, own;  // tokens: what the host declares, and anything else
};

class SiteNames {
public:
    explicit SiteNames(const Reading& reading)
        : reading_(reading), variables_(reading), function_(reading.tokens.size(), kNone) {
        for (std::uint32_t i = 0; i < reading.functions.size(); ++i) {
            const TokenRange range = reading.functions[i].tokens;
            std::fill(function_.begin() + range.begin, function_.begin() + range.end, i);
        }
        for (const Declaration& declaration : reading.declarations)
            if (declaration.scope == Scope::member || declaration.scope == Scope::parameter)
                for (const Declarator& one : declaration.names) declared_.push_back(one.name);
        std::ranges::sort(declared_);
    }

    // Of a name that no global has.
    Places places_of(std::string_view name) const {
        Places places;
        for (const std::uint32_t at : reading_.places_of({name}))
            (is_hosts(at) ? places.hosts : places.own).push_back(at);
        return places;
    }

private:
    bool is_hosts(std::uint32_t at) const {
        if (at > 0 && reading_.tokens[at - 1].is(".")) return false;
        if (std::ranges::binary_search(declared_, at)) return false;
        return function_[at] == kNone || !variables_.find(at, function_[at]).declaration;
    }

    const Reading& reading_;
    Variables variables_;
    std::vector<std::uint32_t> function_;  // of each token
    std::vector<std::uint32_t> declared_;  // names of members and parameters
};

// Whether it stands in the text, in branches that are not compiled too.
bool speaks_of(const Reading& reading, std::string_view word) {
    return std::ranges::any_of(reading.written, [&](const Token& token) { return token.is(word); });
}

// Where it is spelled, also in a macro and in the arguments of a use. What one macro means both
// ways is written out.
void rename(const Reading& reading, const Places& places, const SiteName& name, Edits& edits) {
    const auto spelled_at = [&](std::uint32_t at) { return reading.tokens[at].begin; };
    for (const std::uint32_t at : places.hosts) {
        const bool means_both = std::ranges::any_of(
            places.own, [&](std::uint32_t other) { return spelled_at(other) == spelled_at(at); });
        if (means_both)
            edits.replace({at, at + 1}, name.words);
        else if (!edits.is_replaced(reading.tokens[at].span()))
            edits.replace_bytes(reading.tokens[at].span(), name.words);
    }
}

}  // namespace

SiteNamed with_site_names(const std::string& text, const Known& known,
                          std::span<const SiteName> names) {
    const Reading reading = read_glsl(text, known);
    const SiteNames means(reading);
    Edits edits(reading);
    SiteNamed named;
    for (const SiteName& name : names) {
        // A sampler of another tab may be called like what this one has.
        if (!speaks_of(reading, name.name) || means_its_own(reading, name.name)) continue;
        const Places places = means.places_of(name.name);
        if (!places.own.empty()) {
            rename(reading, places, name, edits);
            continue;
        }
        named.defines += fmt::format("#define {} {}{}{}\n", name.name, name.words,
                                     name.note.empty() ? "" : "  // ", name.note);
    }
    named.text = edits.apply().text;
    return named;
}

std::string free_of_macros(const Reading& reading, const std::string& name) {
    std::string free = name;
    for (int i = 1; reading.defines_macro(free); ++i) free = fmt::format("{}{}", name, i);
    return free;
}

}  // namespace glint
