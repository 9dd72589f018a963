#include "measure/probe/assertions.h"

#include "measure/probe/watches.h"
#include "scene/passes.h"
#include "scene/probe_note.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

ProbeExpression expression_of(const ProbeNote& note) {
    return {.text = note.expression,
            .line = {note.begin, note.end},
            .is_assertion = note.is_assertion,
            .may_be_unreached = true};
}

// What does not hold at the pixels of one pass that is about to be drawn.
void look(Probe& probe, Renderer& renderer, std::size_t index, const std::string& pass,
          const std::vector<ProbeNote>& notes, std::vector<BrokenAssertion>& found) {
    const BufferShape& shape = renderer.buffer(index).shape();
    const auto& sites = probe.probed().sites;
    if (sites.empty()) return;
    for (int face = 0; face < (shape.cube ? 6 : 1); ++face) {
        const std::vector<ProbeCell> cells = probe.map(renderer, Frame{}, 0, 0, face);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (cells[i].told[0] == 0) continue;
            const std::size_t at = sites[cells[i].told[1] - 1].at;
            const auto note = static_cast<std::size_t>(
                std::ranges::find(notes, at, &ProbeNote::begin) - notes.begin());
            if (note >= notes.size()) continue;
            BrokenAssertion& broken = found[note];
            const auto pixel = static_cast<int>(i);
            if (broken.pixels++ == 0) {
                broken.pass = pass;
                broken.pixel = {pixel % shape.size.x, pixel / shape.size.x};
            }
        }
    }
}

}  // namespace

bool has_assertions(const Scene& scene) {
    return std::ranges::any_of(find_probe_notes(scene), &ProbeNote::is_assertion);
}

std::vector<BrokenAssertion> broken_assertions(const Preset& preset, Renderer& renderer,
                                               const ProgramOptions& options,
                                               const std::function<void()>& draw) {
    std::vector<ProbeNote> notes = find_probe_notes(preset.scene);
    std::erase_if(notes, [](const ProbeNote& note) { return !note.is_assertion; });
    ProbeWish wish{.kind = ProbeKind::faults};
    std::vector<BrokenAssertion> found;
    for (const ProbeNote& note : notes) {
        wish.expressions.push_back(expression_of(note));
        found.push_back({.file = note.place.file,
                         .line = note.place.line,
                         .column = note.place.column,
                         .expression = note.expression,
                         .why = note.why});
    }
    std::vector<Probe> probes;
    for (const GraphPass& pass : renderer.graph().passes) {
        try {
            probes.emplace_back(preset, pass.pass, options, wish);
        } catch (const ProbeRefused&) {
            ProbeWish rest = wish;
            rest.expressions = accepted(preset, pass.pass, options, wish,
                                        [&](const ProbeExpression& one, const std::string& why) {
                                            for (std::size_t i = 0; i < notes.size(); ++i)
                                                if (notes[i].begin == one.line.begin)
                                                    found[i].refused = why;
                                        });
            // Of none, all values would be told.
            if (rest.expressions.empty()) rest.only = {Span{0, 0}};
            probes.emplace_back(preset, pass.pass, options, rest);
        }
    }
    renderer.before_pass = [&](std::size_t index) {
        const std::string pass = pass_name(preset.scene, renderer.graph().passes[index].pass);
        look(probes[index], renderer, index, pass, notes, found);
    };
    renderer.reset();  // what nothing has changed would not be drawn, and not be looked at
    draw();
    renderer.before_pass = nullptr;
    std::erase_if(
        found, [](const BrokenAssertion& one) { return one.pixels == 0 && one.refused.empty(); });
    return found;
}

std::string sentence_of(const BrokenAssertion& broken) {
    if (!broken.refused.empty())
        return fmt::format("assert {} cannot be evaluated, and was not: {}", broken.expression,
                           broken.refused);
    return fmt::format("assert {}{} does not hold in {} pixel{} of {}, first at {},{}",
                       broken.expression,
                       broken.why.empty() ? "" : fmt::format(" \"{}\"", broken.why), broken.pixels,
                       broken.pixels == 1 ? "" : "s", broken.pass, broken.pixel.x, broken.pixel.y);
}

}  // namespace glint
