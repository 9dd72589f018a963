#include "glsl/variables.h"

namespace glint {

Variables::Variables(const Reading& reading) : reading_(reading) {
    for (std::uint32_t i = 0; i < reading.declarations.size(); ++i) {
        const Declaration& declaration = reading.declarations[i];
        if (declaration.scope == Scope::member) continue;
        for (std::uint32_t k = 0; k < declaration.names.size(); ++k)
            places_[reading.word(declaration.names[k].name)].push_back({i, k});
    }
}

// Of a local: whether the block, or the statement in whose head it is declared, holds the token.
bool Variables::is_seen(const Declaration& declaration, std::uint32_t token) const {
    if (declaration.statement == kNone) return true;
    const Statement& own = reading_.statements[declaration.statement];
    const bool is_head = own.kind != StatementKind::declaration;
    if (!is_head && own.parent == kNone) return true;
    const TokenRange room = is_head ? own.tokens : reading_.statements[own.parent].tokens;
    return room.begin <= token && token < room.end;
}

Variables::Found Variables::find(std::uint32_t token, std::uint32_t function) const {
    const auto places = places_.find(reading_.word(token));
    if (places == places_.end()) return {};
    Found best;
    for (const Place& place : places->second) {
        const Declaration& declaration = reading_.declarations[place.declaration];
        const Declarator& name = declaration.names[place.name];
        if (name.name > token) break;
        // Its scope begins behind its own value (GLSL ES 3.00, 4.2.2).
        if (name.initial.begin <= token && token < name.initial.end) continue;
        const bool is_outside = declaration.scope == Scope::global;
        if (!is_outside && declaration.owner != function) continue;
        if (declaration.scope == Scope::local && !is_seen(declaration, token)) continue;
        best = {&declaration, &name};
    }
    return best;
}

}  // namespace glint
