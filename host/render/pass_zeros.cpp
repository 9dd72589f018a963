#include "render/pass_zeros.h"

#include "glsl/zeros.h"

#include <utility>

namespace glint {

void write_zeros(PassText& pass, const std::optional<UnsetRange>& marked) {
    const Reading reading = read_glsl(pass.text, known_of_driver());
    const auto note = [&](const Unset& unset) {
        const std::optional<std::size_t> at = pass.origin(unset.at);
        if (!at) return false;  // the host's own text
        const bool is_same = !pass.unset.empty() && pass.unset.back().place.at == *at;
        const UnsetPlace place{*at, is_same ? pass.unset.back().place.number + 1 : 0};
        pass.unset.push_back({place, unset.name, unset.is_result});
        return marked && marked->begin <= place && place < marked->end;
    };
    Zeroed zeroed = write_zeros(reading, note);
    const std::size_t behind = pass.text.size() - pass.user_end;
    pass.text = std::move(zeroed.edited.text);
    pass.user_end = pass.text.size() - behind;
    pass.zeros = std::move(zeroed.edited.map);
}

}  // namespace glint
