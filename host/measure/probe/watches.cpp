#include "measure/probe/watches.h"

#include "scene/probe_note.h"

#include <fmt/format.h>

namespace glint {
namespace {

ProbeExpression watched_expression(const ProbeNote& note) {
    return {.text = note.expression, .line = {note.begin, note.end}, .is_note = true};
}

}  // namespace

std::vector<ProbeExpression> accepted(
    const Preset& preset, std::size_t pass, const ProgramOptions& options, const ProbeWish& wish,
    const std::function<void(const ProbeExpression&, const std::string& why)>& refuse) {
    std::vector<ProbeExpression> list;
    for (const ProbeExpression& one : wish.expressions) {
        try {
            Probe(preset, pass, options, {.kind = wish.kind, .expressions = {one}});
            list.push_back(one);
        } catch (const ProbeRefused& refused) {
            refuse(one, refused.what());
        }
    }
    return list;
}

Watches::Watches(const Preset& preset, std::size_t pass, const ProgramOptions& options) {
    ProbeWish wish;
    for (const ProbeNote& note : find_probe_notes(preset.scene)) {
        if (note.is_assertion) continue;
        if (note.is_in_function)
            wish.expressions.push_back(watched_expression(note));
        else
            refused_.push_back(fmt::format("watch {}@{}: it stands in no function", note.expression,
                                           note.place.line));
    }
    for (const std::string& watch : preset.watch) {
        const auto note = note_of_watch(preset.scene, watch);
        if (note)
            wish.expressions.push_back(watched_expression(*note));
        else
            refused_.push_back(fmt::format("watch {}: the scene has no such line", watch));
    }
    if (wish.expressions.empty()) return;
    try {
        probe_.emplace(preset, pass, options, wish);
    } catch (const ProbeRefused&) {
        wish.expressions = accepted(
            preset, pass, options, wish, [&](const ProbeExpression& one, const std::string& why) {
                const Place place = preset.scene.place_at(one.line.begin);
                refused_.push_back(fmt::format("watch {}@{}: {}", one.text, place.line, why));
            });
        if (!wish.expressions.empty()) probe_.emplace(preset, pass, options, wish);
    }
}

std::vector<ProbeValue> Watches::values_at(Renderer& renderer, const Frame& frame,
                                           const ProbePlace& place) {
    if (!probe_) return {};
    return probe_->values_at(renderer, frame, place);
}

}  // namespace glint
