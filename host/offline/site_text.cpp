#include "offline/site_text.h"

#include "glsl/reachable.h"
#include "render/pass_text.h"
#include "scene/scene_text.h"

#include <ranges>

namespace glint {
namespace {

// An annotation means nothing there; its words still describe the constant.
void make_notes_plain(const Reading& reading, Edits& edits) {
    for (const Comment& comment : reading.comments) {
        const std::size_t begin = comment.span.begin;
        if (reading.text.substr(begin, 4) == "//@ ")
            edits.replace_bytes({begin, begin + 4}, "// ");
        else if (reading.text.substr(begin, 3) == "//@")
            edits.replace_bytes({begin, begin + 3}, "// ");
    }
}

}  // namespace

SiteText site_text(const Preset& preset, std::size_t pass) {
    const Known known = known_of_pass(output_names(preset.scene, pass));
    const EditedText constant = specialised_text(preset);
    const EditedText reached =
        reachable_text(read_glsl(constant.text, known), entry_of(preset.scene, pass), kPassPrefix);
    const Reading reading = read_glsl(reached.text, known);
    Edits edits(reading);
    make_notes_plain(reading, edits);
    EditedText plain = edits.apply();
    return {std::move(plain.text), {constant.map, reached.map, std::move(plain.map)}};
}

std::size_t SiteText::origin(std::size_t at) const {
    for (const EditMap& map : maps | std::views::reverse) at = map.origin(at);
    return at;
}

}  // namespace glint
