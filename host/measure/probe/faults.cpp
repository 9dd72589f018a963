#include "measure/probe/faults.h"

#include "scene/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace glint {
namespace {

// What glsl/zeros.h writes for what was never given a value, where it is marked.
constexpr std::uint32_t kMark = 0x7FC0DEADu;

bool is_finite(const ProbeCell& cell) {
    return std::ranges::all_of(cell.colour, [](float v) { return std::isfinite(v); });
}

std::size_t site_of(const ProbeCell& cell) {
    return cell.told[1] - 1;
}

double as_float(std::uint32_t bits) {
    return static_cast<double>(std::bit_cast<float>(bits));
}

// What is wrong, in words, with its operands.
void describe(const ProbeSite& site, const ProbeCell& cell, ProbeFault& fault) {
    const double a = as_float(cell.kept[0]), b = as_float(cell.kept[1]);
    const auto whole = [&](std::size_t i) {
        return static_cast<double>(std::bit_cast<std::int32_t>(cell.kept[i]));
    };
    const std::string name = site.name.substr(0, site.name.find_first_of(" ("));
    switch (site.kind) {
        case SiteKind::division:
            fault.what = "division by zero";
            fault.operands = {a};
            return;
        case SiteKind::index:
            fault.operands = {whole(0), whole(1)};
            fault.what = fmt::format("index {:.0f} of {:.0f}", whole(0), whole(1));
            return;
        case SiteKind::domain:
            fault.operands = {a};
            fault.what = fmt::format("{}({:.7g})", name, a);
            if (name == "pow" || name == "mod" || name == "atan") {
                fault.operands.push_back(b);
                fault.what = fmt::format("{}({:.7g}, {:.7g})", name, a, b);
            } else if (name == "normalize") {
                fault.what = "normalize of a vector of length 0";
            }
            return;
        case SiteKind::assertion:
            fault.what = "does not hold";
            return;
        default:
            break;
    }
    fault.operands = {a};
    fault.what = cell.kept[0] == kMark ? "a value that nothing has given it"
                 : std::isnan(a)       ? "NaN is born"
                                       : "Inf is born";
}

}  // namespace

FaultWatch::FaultWatch(const Preset& preset, Renderer& renderer, const ProgramOptions& options,
                       const ProbeWish& wish)
    : preset_(preset), renderer_(renderer), is_marked_(options.marked.has_value()) {
    for (const GraphPass& pass : renderer.graph().passes)
        probes_.emplace_back(preset, pass.pass, options, wish);
    renderer.before_pass = [this](std::size_t index) { look(index); };
}

FaultWatch::~FaultWatch() {
    renderer_.before_pass = nullptr;
}

ProbeFault FaultWatch::fault_of(const Probe& probe, const ProbeCell& cell) const {
    const ProbeSite& site = probe.probed().sites[site_of(cell)];
    const ProbeValue row = probe.row(site_of(cell));
    ProbeFault fault{.file = row.file,
                     .line = row.line,
                     .column = row.column,
                     .function = row.function,
                     .expression = site.name};
    describe(site, cell, fault);
    return fault;
}

void FaultWatch::look(std::size_t index) {
    if (is_seen() || !frame_) return;
    Probe& probe = probes_[index];
    const BufferShape& shape = renderer_.buffer(index).shape();
    if (probe.probed().sites.empty()) return;
    for (int face = 0; face < (shape.cube ? 6 : 1); ++face) {
        const std::vector<ProbeCell> cells = probe.map(renderer_, *frame_, 0, 0, face);
        const ProbeCell* found = nullptr;
        const auto has_fault = [&](const ProbeCell& cell) {
            return cell.told[0] > 0 && (!is_marked_ || cell.kept[0] == kMark);
        };
        for (const ProbeCell& cell : cells) {
            if (!has_fault(cell)) continue;
            if (!found || (is_finite(*found) && !is_finite(cell))) found = &cell;
        }
        if (!found || (first_ && is_finite(*found))) continue;
        ProbeFault fault = fault_of(probe, *found);
        const auto at = static_cast<int>(found - cells.data());
        fault.pass = pass_name(preset_.scene, renderer_.graph().passes[index].pass);
        fault.pixel = {at % shape.size.x, at / shape.size.x};
        fault.frame = frame_->frame;
        fault.pixels =
            static_cast<std::size_t>(std::ranges::count_if(cells, [&](const ProbeCell& cell) {
                return has_fault(cell) && cell.told[1] == found->told[1];
            }));
        fault.is_seen = !is_finite(*found);
        first_ = std::move(fault);
        if (first_->is_seen) return;
    }
}

}  // namespace glint
