#include "render/graph.h"

#include "render/pass_text.h"

#include <algorithm>

namespace glint {
namespace {

bool contains(const std::vector<std::size_t>& list, std::size_t value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

// A pass feeds the state when it carries something into a later frame: a buffer that an earlier
// pass (or itself) reads, a simulation step, or anything that such a pass reads.
void mark_state(std::vector<GraphPass>& graph, const std::vector<Pass>& passes) {
    const auto is_kept = [&](const GraphPass& kept) {
        if (kept.pass < passes.size() && passes[kept.pass].step) return true;
        return std::any_of(graph.begin(), graph.end(), [&](const GraphPass& reader) {
            return reader.pass <= kept.pass && contains(reader.reads, kept.pass);
        });
    };
    for (GraphPass& pass : graph) pass.feeds_state = pass.carries = is_kept(pass);
    // Each round reaches one edge further; there are at most as many edges in a row as passes.
    for (std::size_t round = 0; round < graph.size(); ++round) {
        for (const GraphPass& reader : graph) {
            if (!reader.feeds_state) continue;
            for (GraphPass& pass : graph) {
                if (contains(reader.reads, pass.pass)) pass.feeds_state = true;
            }
        }
    }
}

// Whether a pass reads itself, directly or through others: then every frame brings something new.
bool is_cyclic(const std::vector<GraphPass>& graph, std::size_t start) {
    std::vector<std::size_t> open = graph[start].reads, seen;
    while (!open.empty()) {
        const std::size_t at = open.back();
        open.pop_back();
        if (at == graph[start].pass) return true;
        if (contains(seen, at)) continue;
        seen.push_back(at);
        for (const GraphPass& pass : graph) {
            if (pass.pass == at) open.insert(open.end(), pass.reads.begin(), pass.reads.end());
        }
    }
    return false;
}

// What is new in every frame spreads along the reads.
void mark_runs(std::vector<GraphPass>& graph, const std::vector<Pass>& passes,
               const std::vector<PassReads>& reads) {
    for (std::size_t i = 0; i < graph.size(); ++i) {
        GraphPass& pass = graph[i];
        if (pass.pass < passes.size() && passes[pass.pass].step) {
            pass.runs = Runs::every_step;
        } else if (reads[i].changes_by_itself || is_cyclic(graph, i)) {
            pass.runs = Runs::every_frame;
        }
    }
    for (std::size_t round = 0; round < graph.size(); ++round) {
        for (GraphPass& reader : graph) {
            if (reader.runs != Runs::on_change) continue;
            for (const GraphPass& pass : graph) {
                if (contains(reader.reads, pass.pass) && pass.runs != Runs::on_change) {
                    reader.runs = Runs::every_frame;
                }
            }
        }
    }
}

}  // namespace

const char* to_string(Runs runs) {
    switch (runs) {
        case Runs::every_frame:
            return "every frame";
        case Runs::on_change:
            return "on change";
        case Runs::every_step:
            return "every step";
    }
    return "";
}

PassGraph build_graph(const std::vector<Pass>& passes, std::vector<PassReads> reads) {
    std::sort(reads.begin(), reads.end(),
              [](const PassReads& a, const PassReads& b) { return a.pass < b.pass; });
    PassGraph graph;
    for (const PassReads& read : reads) {
        GraphPass pass{.pass = read.pass, .reads = read.buffers};
        pass.feedback = contains(read.buffers, read.pass);
        pass.previous = std::any_of(read.buffers.begin(), read.buffers.end(),
                                    [&](std::size_t buffer) { return buffer >= read.pass; });
        graph.passes.push_back(std::move(pass));
    }
    mark_state(graph.passes, passes);
    mark_runs(graph.passes, passes, reads);
    graph.stateful =
        std::any_of(graph.passes.begin(), graph.passes.end(), [&](const GraphPass& pass) {
            return pass.previous || (pass.pass < passes.size() && passes[pass.pass].step);
        });
    return graph;
}

bool keeps_picture_size(const Scene& scene, const PassGraph& graph) {
    return std::any_of(graph.passes.begin(), graph.passes.end(), [&](const GraphPass& pass) {
        if (!fills_a_buffer(pass.pass)) return false;
        const Pass& declared = scene.passes[pass.pass];
        return pass.carries && !declared.cube && !declared.size;
    });
}

bool is_jittered(const Scene& scene, const GraphPass& pass) {
    if (!fills_a_buffer(pass.pass)) return true;
    const Pass& declared = scene.passes[pass.pass];
    return !pass.feeds_state && !pass.previous && !declared.cube && !declared.size &&
           declared.scale == 1.0;
}

}  // namespace glint
