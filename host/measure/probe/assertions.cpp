#include "measure/probe/assertions.h"

#include "measure/probe/watches.h"
#include "scene/passes.h"
#include "scene/probe_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace glint {
namespace {

ProbeExpression expression_of(const ProbeNote& note) {
    return {.text = note.expression,
            .line = {note.begin, note.end},
            .is_assertion = note.is_assertion,
            .is_note = true};
}

BrokenAssertion broken(const ProbeNote& note) {
    return {.file = note.place.file,
            .line = note.place.line,
            .column = note.place.column,
            .expression = note.expression,
            .why = note.why};
}

bool is_of(const BrokenAssertion& one, const Place& place) {
    return one.file == place.file && one.line == place.line && one.column == place.column;
}

// What does not hold at the pixels of one pass that is about to be drawn, and held so far.
void look(Probe& probe, Renderer& renderer, std::size_t index, const std::string& pass,
          const std::vector<ProbeNote>& notes, BrokenAssertions& found) {
    const BufferShape& shape = renderer.buffer(index).shape();
    const auto& sites = probe.probed().sites;
    if (sites.empty()) return;
    std::vector<BrokenAssertion> here;
    for (const ProbeSite& site : sites) {
        here.push_back(broken(*std::ranges::find(notes, site.at, &ProbeNote::begin)));
        here.back().pass = pass;
    }
    for (int face = 0; face < (shape.cube ? 6 : 1); ++face) {
        const std::vector<ProbeCell> cells = probe.map(renderer, Frame{}, 0, 0, face);
        for (std::size_t site = 0; site < sites.size(); ++site) {
            for (std::size_t i = 0; i < cells.size(); ++i) {
                if ((cells[i].kept[site / 32] >> site % 32 & 1u) == 0) continue;
                const auto pixel = static_cast<int>(i);
                if (here[site].pixels++ == 0)
                    here[site].pixel = {pixel % shape.size.x, pixel / shape.size.x};
            }
        }
    }
    for (BrokenAssertion& one : here) {
        const bool is_known = std::ranges::any_of(found, [&](const BrokenAssertion& other) {
            return other.pass == pass && is_of(other, {one.file, one.line, one.column});
        });
        if (one.pixels > 0 && !is_known) found.push_back(std::move(one));
    }
}

// Those of them that the driver takes; of the others `refused` tells why not.
ProbeWish accepted_of(const Preset& preset, std::size_t pass, const ProgramOptions& options,
                      const ProbeWish& wish, const std::vector<ProbeNote>& notes,
                      std::map<std::size_t, std::string>& refused) {
    ProbeWish rest = wish;
    rest.expressions = accepted(preset, pass, options, wish,
                                [&](const ProbeExpression& one, const std::string& why) {
                                    for (std::size_t i = 0; i < notes.size(); ++i)
                                        if (notes[i].begin == one.line.begin) refused[i] = why;
                                });
    return rest;
}

// In the order of the text; of one line, passes as they were drawn.
void put_in_order(BrokenAssertions& found, const std::vector<ProbeNote>& notes) {
    const auto number_of = [&](const BrokenAssertion& one) {
        return std::ranges::find_if(notes,
                                    [&](const ProbeNote& note) { return is_of(one, note.place); }) -
               notes.begin();
    };
    std::ranges::stable_sort(found, {}, number_of);
}

}  // namespace

bool has_assertions(const Scene& scene) {
    return std::ranges::any_of(find_probe_notes(scene), &ProbeNote::is_assertion);
}

BrokenAssertions broken_assertions(const Preset& preset, Renderer& renderer,
                                   const ProgramOptions& options,
                                   const std::function<void(const BrokenAssertions&)>& draw) {
    std::vector<ProbeNote> notes = find_probe_notes(preset.scene);
    std::erase_if(notes, [](const ProbeNote& note) { return !note.is_assertion; });
    ProbeWish wish{.kind = ProbeKind::assertions};
    std::map<std::size_t, std::string> refused;  // by the number of the note
    for (std::size_t i = 0; i < notes.size(); ++i) {
        if (!notes[i].is_in_function)
            refused[i] = "it stands in no function";
        else if (i < kMostAssertions)
            wish.expressions.push_back(expression_of(notes[i]));
        else
            refused[i] = fmt::format("a text has at most {} of them", kMostAssertions);
    }
    std::vector<std::optional<Probe>> probes;
    for (const GraphPass& pass : renderer.graph().passes) {
        std::optional<Probe>& probe = probes.emplace_back();
        try {
            probe.emplace(preset, pass.pass, options, wish);
        } catch (const ProbeRefused&) {
            const ProbeWish rest = accepted_of(preset, pass.pass, options, wish, notes, refused);
            if (!rest.expressions.empty()) probe.emplace(preset, pass.pass, options, rest);
        }
    }
    BrokenAssertions found;
    for (const auto& [note, why] : refused) {
        found.push_back(broken(notes[note]));
        found.back().refused = why;
    }
    renderer.before_pass = [&](std::size_t index) {
        const std::string pass = pass_name(preset.scene, renderer.graph().passes[index].pass);
        if (probes[index]) look(*probes[index], renderer, index, pass, notes, found);
    };
    renderer.redraw_all();  // and looked at
    draw(found);
    renderer.before_pass = nullptr;
    put_in_order(found, notes);
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
