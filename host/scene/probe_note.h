// `//@ assert t >= 0.0 "behind the eye"` and `//@ watch nor`: what a text says of its own values.
#pragma once

#include "glsl/raw_text.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct ProbeNote {
    bool is_assertion = false;  // else it is watched
    bool is_in_function = false;
    std::string expression{};
    std::string why{};               // "" where nothing is said
    std::size_t begin = 0, end = 0;  // bytes of Scene::text: the line on which it stands
    Place place{};
};

// Of what follows `//@`; nothing where it is another kind of note. Has no place.
std::optional<ProbeNote> parse_probe_note(std::string_view annotation);

// In the order of the text; `//@ watch a, b` is two.
std::vector<ProbeNote> find_probe_notes(const Scene& scene);

// The bytes of Scene::text of a line that a person names: "412", or "shared.glsl:12" of a file that
// is included. Nothing where there is none.
std::optional<Span> find_line(const Scene& scene, std::string_view name);

// What a preset watches: `dot(nor, rd)@412`. Nothing where there is no such line.
std::optional<ProbeNote> note_of_watch(const Scene& scene, std::string_view watch);

}  // namespace glint
