#include "measure/probe/cost.h"

#include "base/median.h"
#include "media/image.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace glint {
namespace {

constexpr glm::ivec2 kGrid{16, 9};  // pixels at which lines are counted
constexpr std::size_t kLines = 10;
constexpr int kDraws = 3;  // whose median is taken

}  // namespace

ProbeCost totals_of(const std::vector<ProbeCell>& cells) {
    ProbeCost totals;
    for (const ProbeCell& cell : cells) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto count = static_cast<double>(cell.kept[i]);
            totals.mean[i] += count / static_cast<double>(cells.size());
            totals.most[i] = std::max(totals.most[i], count);
        }
    }
    return totals;
}

double count_of(const ProbeCell& cell) {
    return static_cast<double>(cell.kept[0]) + cell.kept[1] + cell.kept[2];
}

std::vector<ProbeLineCost> dearest_lines(Probe& probe, Renderer& renderer, const Frame& frame,
                                         glm::ivec2 size) {
    std::vector<ProbeLineCost> lines;
    const std::size_t sites = probe.probed().sites.size();
    for (std::size_t i = 0; i < sites; ++i) {
        const ProbeValue row = probe.row(i);
        lines.push_back({row.file, row.line, row.function, row.name, row.kind});
    }
    const double share = 1.0 / (kGrid.x * kGrid.y);
    for (int i = 0; i < kGrid.x * kGrid.y; ++i) {
        const glm::ivec2 at =
            glm::ivec2(i % kGrid.x, i / kGrid.x) * size / kGrid + size / kGrid / 2;
        const std::vector<std::uint32_t> hits = probe.hits_of_sites(renderer, frame, {.pixel = at});
        for (std::size_t k = 0; k < sites; ++k) {
            lines[k].a_pixel += hits[k] * share;
            lines[k].most = std::max(lines[k].most, static_cast<double>(hits[k]));
        }
    }
    std::ranges::stable_sort(lines, std::greater(), &ProbeLineCost::a_pixel);
    std::erase_if(lines, [](const ProbeLineCost& line) { return line.most == 0.0; });
    if (lines.size() > kLines) lines.resize(kLines);
    return lines;
}

namespace {

// From black over red and yellow to white.
void write_heat(const std::filesystem::path& file, const std::vector<ProbeCell>& cells,
                glm::ivec2 size) {
    double most = 1.0;
    for (const ProbeCell& cell : cells) most = std::max(most, count_of(cell));
    Image image{.size = size, .channels = 3, .pixels = {}};
    for (const ProbeCell& cell : cells)
        for (const double from : {0.0, 1.0, 2.0})
            image.pixels.push_back(static_cast<std::byte>(
                std::lround(255.0 * std::clamp(3.0 * count_of(cell) / most - from, 0.0, 1.0))));
    write_image(file, image);
}

double median_ms(ProbeSession& session, const Frame& frame) {
    std::vector<double> ms;
    double in_pass = 0.0;
    Stopwatch clock;
    Renderer& renderer = session.renderer();
    renderer.before_pass = [&](std::size_t index) {
        session.context().finish();
        if (index == session.index()) clock.restart();
    };
    renderer.after_pass = [&](std::size_t index) {
        session.context().finish();
        if (index == session.index()) in_pass = clock.ms();
    };
    for (int i = 0; i < kDraws + 1; ++i) {
        renderer.redraw();
        renderer.draw(frame);
        if (i > 0) ms.push_back(in_pass);  // the first may compile
    }
    renderer.before_pass = renderer.after_pass = nullptr;
    return median_of(std::move(ms));
}

std::optional<double> correlation(const std::vector<ProbeCost::Run>& runs, std::size_t of) {
    double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
    const auto n = static_cast<double>(runs.size());
    for (const ProbeCost::Run& run : runs) {
        const double a = run.counts[of], b = run.ms;
        x += a / n, y += b / n, xx += a * a / n, yy += b * b / n, xy += a * b / n;
    }
    const double varies = (xx - x * x) * (yy - y * y);
    constexpr double kLeast = 0.02;  // of the mean; a clock is not surer than that
    if (runs.size() < 3 || !(varies > 0.0) || xx - x * x < kLeast * kLeast * x * x) return {};
    return (xy - x * y) / std::sqrt(varies);
}

// Of the picture: three sizes and four times, which a simulation takes for its next frames.
std::vector<ProbeCost::Run> runs_of(ProbeSession& session, Probe& probe, const Frame& frame) {
    std::vector<ProbeCost::Run> runs;
    const glm::ivec2 full = session.preset().size;
    for (const int part : {4, 2, 1}) {
        const glm::ivec2 size = glm::max(full / part, glm::ivec2(1));
        session.renderer().resize(size);
        for (const double later : {0.0, 1.0, 2.5, 5.0}) {
            Frame moved = frame;
            moved.time += later;
            ProbeCost::Run run{.size = size, .time = moved.time};
            run.ms = median_ms(session, moved);
            const std::vector<ProbeCell> cells = probe.map(session.renderer(), moved, 0, 0);
            run.counts = totals_of(cells).mean;
            for (double& count : run.counts) count *= static_cast<double>(cells.size());
            runs.push_back(run);
        }
    }
    session.renderer().resize(full);
    return runs;
}

// Each as a multiple of the mean over its size, so that views alone make a difference.
std::vector<ProbeCost::Run> shares_of(std::vector<ProbeCost::Run> runs) {
    const std::vector<ProbeCost::Run> all = runs;
    const auto share = [&](ProbeCost::Run& run, const auto& number) {
        double sum = 0.0, count = 0.0;
        for (ProbeCost::Run one : all)
            if (one.size == run.size) sum += number(one), ++count;
        if (sum > 0.0) number(run) *= count / sum;
    };
    for (ProbeCost::Run& run : runs) {
        share(run, [](ProbeCost::Run& one) -> double& { return one.ms; });
        for (std::size_t i = 0; i < 3; ++i)
            share(run, [i](ProbeCost::Run& one) -> double& { return one.counts[i]; });
    }
    return runs;
}

}  // namespace

ProbeCost cost_of(ProbeSession& session, const ProbeOptions& options,
                  const std::filesystem::path& heat) {
    Probe probe(session.preset(), session.pass(), session.program_options(),
                {.kind = ProbeKind::cost}, session.renderer().give_up());
    ProbeCost cost;
    std::vector<ProbeCell> cells;
    session.at_frame(options, [&](const Frame& frame) {
        cells = probe.map(session.renderer(), frame, 0, 0);
        cost = totals_of(cells);
        cost.lines = dearest_lines(probe, session.renderer(), frame, session.shape().size);
    });
    if (!heat.empty()) write_heat(heat, cells, session.shape().size);
    const bool is_picture = !fills_a_buffer(session.pass());
    if (is_picture) cost.runs = runs_of(session, probe, session.frame());
    const std::vector<ProbeCost::Run> shares = shares_of(cost.runs);
    for (std::size_t i = 0; i < 3; ++i) {
        cost.explains[i] = correlation(cost.runs, i);
        cost.explains_views[i] = correlation(shares, i);
    }
    return cost;
}

std::string shown(const ProbeCost& cost) {
    constexpr std::array kNames = {"turns of loops", "reads of textures", "calls"};
    std::string text;
    for (std::size_t i = 0; i < 3; ++i) {
        text += fmt::format("{:<18} {:>10.1f} a pixel, {:.0f} at most", kNames[i], cost.mean[i],
                            cost.most[i]);
        if (cost.explains[i])
            text += fmt::format("; correlation with milliseconds {:.3f}", *cost.explains[i]);
        if (cost.explains_views[i])
            text += fmt::format(", over views alone {:.3f}", *cost.explains_views[i]);
        text += "\n";
    }
    if (!cost.runs.empty())
        text += fmt::format("milliseconds of {} draws, {}x{} to {}x{}, {:g} to {:g} s\n",
                            cost.runs.size(), cost.runs.front().size.x, cost.runs.front().size.y,
                            cost.runs.back().size.x, cost.runs.back().size.y,
                            cost.runs.front().time, cost.runs.back().time);
    if (!cost.lines.empty())
        text += fmt::format("lines, counted at {}x{} pixels\n", kGrid.x, kGrid.y);
    for (const ProbeLineCost& line : cost.lines)
        text +=
            fmt::format("{}:{}: {}: {} {}  {:.1f} a pixel, {:.0f} at most\n", line.file, line.line,
                        line.function, line.kind, line.name, line.a_pixel, line.most);
    return text;
}

}  // namespace glint
