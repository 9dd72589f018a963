#include "measure/probe/assertions.h"

#include "measure/probe/watches.h"
#include "scene/passes.h"
#include "scene/probe_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

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
        for (std::size_t site = 0; site < sites.size(); ++site) {
            const auto note = static_cast<std::size_t>(
                std::ranges::find(notes, sites[site].at, &ProbeNote::begin) - notes.begin());
            for (std::size_t i = 0; i < cells.size(); ++i) {
                if ((cells[i].kept[site / 32] >> site % 32 & 1u) == 0) continue;
                const auto pixel = static_cast<int>(i);
                if (found[note].pixels++ > 0) continue;
                found[note].pass = pass;
                found[note].pixel = {pixel % shape.size.x, pixel / shape.size.x};
            }
        }
    }
}

// Those of them that the driver takes; of the others it is noted why not.
ProbeWish accepted_of(const Preset& preset, std::size_t pass, const ProgramOptions& options,
                      const ProbeWish& wish, std::vector<BrokenAssertion>& found) {
    ProbeWish rest = wish;
    rest.expressions = accepted(preset, pass, options, wish,
                                [&](const ProbeExpression& one, const std::string& why) {
                                    for (std::size_t i = 0; i < wish.expressions.size(); ++i)
                                        if (wish.expressions[i].line.begin == one.line.begin)
                                            found[i].refused = why;
                                });
    return rest;
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
    ProbeWish wish{.kind = ProbeKind::assertions};
    std::vector<BrokenAssertion> found;
    for (const ProbeNote& note : notes) {
        if (wish.expressions.size() < kMostAssertions)
            wish.expressions.push_back(expression_of(note));
        found.push_back({.file = note.place.file,
                         .line = note.place.line,
                         .column = note.place.column,
                         .expression = note.expression,
                         .why = note.why});
        if (found.size() > kMostAssertions)
            found.back().refused = fmt::format("a text has at most {} of them", kMostAssertions);
    }
    std::vector<std::optional<Probe>> probes;
    for (const GraphPass& pass : renderer.graph().passes) {
        std::optional<Probe>& probe = probes.emplace_back();
        try {
            probe.emplace(preset, pass.pass, options, wish);
        } catch (const ProbeRefused&) {
            const ProbeWish rest = accepted_of(preset, pass.pass, options, wish, found);
            if (!rest.expressions.empty()) probe.emplace(preset, pass.pass, options, rest);
        }
    }
    renderer.before_pass = [&](std::size_t index) {
        const std::string pass = pass_name(preset.scene, renderer.graph().passes[index].pass);
        if (probes[index]) look(*probes[index], renderer, index, pass, notes, found);
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
