#include "measure/probe/run.h"

#include "base/json_text.h"
#include "base/say.h"
#include "base/terminal.h"
#include "measure/probe/assertions.h"
#include "measure/probe/cost.h"
#include "measure/probe/faults.h"
#include "measure/probe/series.h"
#include "measure/probe/session.h"
#include "measure/probe/watches.h"
#include "media/image.h"
#include "offline/frames.h"
#include "offline/named_files.h"
#include "scene/passes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace glint {
namespace {

constexpr int kMostHits = 10000;  // of one site

void require_sense(const ProbeOptions& options) {
    if (options.time && options.frame) throw UsageError("Give either --time or --frame, not both.");
    if (!options.line.empty() && !options.expression.empty())
        throw UsageError("Give either --line or --expr, not both.");
    const bool has_site = !options.line.empty() || !options.expression.empty();
    if (options.cost && options.faults)
        throw UsageError("Give either --cost or --faults, not both.");
    if ((options.cost || options.faults) && (has_site || options.hit || !options.along.empty()))
        throw UsageError(
            "--cost and --faults are of the whole pass: leave --line, --expr, --hit "
            "and --along away.");
    const bool is_map = !options.map.empty() && !options.cost;
    if (options.faults && is_map)
        throw UsageError("--map is of one value or of --cost; --faults tells one place.");
    if (options.cost && holds_floats(options.map))
        throw UsageError(fmt::format(
            "--map {}: --cost is drawn in colours from black to white: name a .png or .jpg file.",
            options.map.string()));
    if (!has_site && (options.hit || !options.along.empty() || is_map))
        throw UsageError("--hit, --along and --map are of one value: name it by --line or --expr.");
    if (!options.along.empty() && !options.map.empty())
        throw UsageError("Give either --along or --map, not both.");
    if (!options.frames.empty() && options.along != "time")
        throw UsageError("--frames is for --along time.");
}

ProbeWish wish_of(const ProbeOptions& options, const ProbeSession& session) {
    ProbeWish wish;
    if (!options.line.empty()) wish.only.push_back(session.line(options.line));
    if (!options.expression.empty())
        wish.expressions.push_back(session.expression(options.expression));
    return wish;
}

// A whole sentence about the place that --line or --expr names, and the end.
[[noreturn]] void stop_at_line(const ProbeSession& session, const ProbeOptions& options,
                               const std::string& sentence) {
    const std::string& expression = options.expression;
    const Span line =
        options.line.empty() ? session.expression(expression).line : session.line(options.line);
    const Preset& preset = session.preset();
    const std::size_t first = preset.scene.text.find_first_not_of(" \t", line.begin);
    say_diagnostic({Severity::error, preset.scene.place_at(std::min(first, line.end)), sentence});
    throw Stop(ExitCode::usage);
}

// What is asked of the driver; a usage error where it takes no such expression.
Probe probe_of(const ProbeOptions& options, ProbeSession& session) {
    try {
        return {session.preset(), session.pass(), session.program_options(),
                wish_of(options, session), session.renderer().give_up()};
    } catch (const ProbeRefused& refused) {
        if (options.expression.empty()) throw;
        stop_at_line(session, options, fmt::format("--expr {}", refused.what()));
    }
}

std::string no_value(const ProbeSession& session) {
    return fmt::format("In pass {}, this line gives no variable a value.",
                       pass_name(session.preset().scene, session.pass()));
}

// Which of a line's sites a series is of: the last that is given a value.
std::size_t only_site(const ProbeSession& session, const Probe& probe,
                      const ProbeOptions& options) {
    const auto& sites = probe.probed().sites;
    const auto is_value = [](const ProbeSite& site) { return site.kind != SiteKind::reached; };
    const auto last = std::find_if(sites.rbegin(), sites.rend(), is_value);
    if (last == sites.rend()) stop_at_line(session, options, no_value(session));
    if (const auto count = std::ranges::count_if(sites, is_value); count > 1)
        say_warning(
            fmt::format("of the {} values of this line, {} alone is told; name another by "
                        "--expr",
                        count, in_quotes(last->name)));
    return static_cast<std::size_t>(sites.rend() - last) - 1;
}

// Of one line, or one expression, every call is told.
bool tells_hits(const ProbeOptions& options) {
    return !options.line.empty() || !options.expression.empty();
}

void print_row(const ProbeValue& row, bool has_hits) {
    const std::string how = has_hits        ? fmt::format("  [{} of {}]", row.hit, row.hits)
                            : row.hits == 1 ? std::string()
                                            : fmt::format("  [the last of {}]", row.hits);
    const std::string value = shown_value(row.value, row.type);
    std::string what =
        row.kind == "condition" ? row.name + " is " + value : row.name + " = " + value;
    if (row.kind == "returned")  // `trace.nor`, where that gives back a struct
        what = fmt::format("return{} {}", row.name.substr(row.function.size()), value);
    say_result("{}:{}: {}: {}{}\n", row.file, row.line, row.function,
               row.kind == "reached" ? row.name : what, how);
}

void print(const Probing& probing, const ProbeOptions& options) {
    for (const std::string& note : probing.notes) say_warning(note);
    if (probing.same == "discarded") say_warning("this pixel is discarded, and tells nothing");
    if (probing.same.starts_with("no"))
        say_warning("the instrumented program draws another colour here, " + probing.same);
    if (options.view.json) return say_result("{}\n", json_text(to_json(probing)));
    say_result("{}  {}  pixel {},{} of {}x{}  frame {} ({:g} s)\n",
               std::filesystem::path(probing.scene).filename().string(), probing.pass,
               probing.pixel.x, probing.pixel.y, probing.size.x, probing.size.y, probing.frame,
               probing.time);
    for (const ProbeValue& row : probing.values) print_row(row, tells_hits(options));
    for (const ProbeSeries& series : probing.series) say_result("{}", shown(series));
    if (probing.cost) say_result("{}", shown(*probing.cost));
    if (options.faults)
        say_result("{}\n", probing.first_bad ? sentence_of(*probing.first_bad) : "no fault");
    else if (probing.values.empty() && probing.series.empty() && !probing.cost)
        say_result("nothing of this was reached at this pixel\n");
}

// The wanted hit alone, where one is wanted; a note where there are fewer.
void keep_hit(std::vector<ProbeValue>& rows, const ProbeOptions& options,
              std::vector<std::string>& notes) {
    if (!options.hit) return;
    int most = 0;
    for (const ProbeValue& row : rows) most = std::max(most, row.hits);
    if (most > 0 && most < *options.hit)
        notes.push_back(
            fmt::format("there is no hit {} at this pixel, but {}", *options.hit, most));
    std::erase_if(rows, [&](const ProbeValue& row) { return row.hit != *options.hit; });
}

void probe_pixel(ProbeSession& session, Probe& probe, const ProbeOptions& options,
                 const ProbePlace& place, Probing& found) {
    const bool has_hits = tells_hits(options);
    std::vector<ProbeValue> rows, seen;
    std::optional<Watches> watch;
    if (!has_hits) watch.emplace(session.preset(), session.pass(), session.program_options());
    session.at_frame(options, [&](const Frame& frame) {
        if (watch) seen = watch->values_at(session.renderer(), frame, place);
        rows = has_hits ? probe.hits_at(session.renderer(), frame, place, kMostHits)
                        : probe.values_at(session.renderer(), frame, place);
    });
    found = session.probing(place);
    found.values = std::move(seen);
    for (const std::string& why : watch ? watch->refused() : std::vector<std::string>())
        found.notes.push_back(why);
    keep_hit(rows, options, found.notes);
    found.values.insert(found.values.end(), rows.begin(), rows.end());
    if (probe.is_discarded())
        found.same = "discarded";
    else if (!session.shape().cube && !probe.probed().sites.empty())
        found.same = same_colour(session.renderer().read_pixel(session.index(), 0, place.pixel),
                                 probe.colour(), session.shape().format);
}

// What a map's cells tell: of a matrix, a struct or an array the first part, `m[0]`.
ProbeValue row_of(const Probe& probe, std::size_t site, const std::vector<ProbeCell>& cells) {
    ProbeValue row = probe.row(site);
    const auto reached =
        std::ranges::find_if(cells, [](const ProbeCell& cell) { return cell.told[0] > 0; });
    if (reached == cells.end()) return row;
    row.type = probe_type(reached->told[2]);
    const ProbeLeaves leaves = leaves_of(reached->told[2], probe.probed());
    if (!leaves.empty()) row.name += leaves.front();
    return row;
}

void probe_picture(ProbeSession& session, Probe& probe, const ProbeOptions& options,
                   const ProbePlace& place, Probing& found) {
    const std::size_t site = only_site(session, probe, options);
    std::vector<ProbeCell> cells;
    session.at_frame(options, [&](const Frame& frame) {
        cells = probe.map(session.renderer(), frame, site, options.hit.value_or(0), place.face);
    });
    const auto hit = static_cast<std::uint32_t>(options.hit.value_or(0));
    for (ProbeCell& cell : cells)
        if (cell.told[0] < hit) cell.told[0] = 0;  // it keeps the last of fewer
    found = session.probing(place);
    found.series.push_back(series_of(cells, session.shape().size, place.pixel,
                                     options.along.empty() ? "map" : options.along));
    found.series.back().what = row_of(probe, site, cells);
    if (!options.map.empty()) write_map(options.map, cells, session.shape().size);
}

// Of this site, the last value; of a matrix, a struct or an array its first part.
const ProbeValue* last_of(const std::vector<ProbeValue>& rows, std::size_t site) {
    const ProbeValue* last = nullptr;
    for (const ProbeValue& row : rows)
        if (row.site == site && (!last || row.order > last->order)) last = &row;
    return last;
}

void probe_frames(ProbeSession& session, Probe& probe, const ProbeOptions& options,
                  const ProbePlace& place, Probing& found) {
    const Frames wanted =
        frames_of(options.frames.empty() ? "0:59" : options.frames, "", options.fps);
    const Playback playback{.end = wanted.last() / options.fps, .fps = options.fps};
    const std::size_t site = only_site(session, probe, options);
    ProbeSeries series{.along = "time", .what = probe.row(site)};
    const bool stateful = session.renderer().graph().stateful;
    std::int64_t next = 0;
    for (int k = stateful ? 0 : wanted[0]; k <= wanted.last(); ++k) {
        const Frame frame = playback.frame(session.preset(), k);
        if (k != wanted[next]) {
            if (stateful) session.renderer().advance(frame);
            continue;
        }
        ++next;
        std::vector<ProbeValue> rows;
        session.draw(frame, [&](const Frame& now) {
            rows = probe.hits_at(session.renderer(), now, place, kMostHits);
        });
        std::vector<std::string> fewer;
        keep_hit(rows, options, fewer);
        add_to(series, frame.time, last_of(rows, site));
    }
    found = session.probing(place);
    found.series.push_back(std::move(series));
}

// Plays up to the frame and looks at every pass that is drawn on the way.
std::optional<ProbeFault> find_fault(ProbeSession& session, const ProbeOptions& options,
                                     const ProgramOptions& program, std::size_t& unwatched) {
    FaultWatch watch(session.preset(), session.renderer(), program);
    unwatched = watch.unwatched();
    const Playback playback{.end = time_of(options, session.preset().time), .fps = options.fps};
    const bool stateful = session.renderer().graph().stateful;
    const int first = stateful ? 0 : playback.last_frame();
    Progress progress("frames looked at", playback.last_frame() - first + 1);
    session.renderer().reset();
    session.renderer().redraw();  // later only what differs from the frame before
    for (int k = first; k <= playback.last_frame() && !watch.is_seen(); ++k) {
        const Frame frame = playback.frame(session.preset(), k);
        watch.begin(frame);
        session.renderer().draw(frame);
        session.set_frame(frame);
        progress.update(k - first + 1);
    }
    return watch.first();
}

// Where zeros hide what is never given a value, it is looked for only once nothing else is found.
void probe_faults(ProbeSession& session, const ProbeOptions& options, const ProbePlace& place,
                  Probing& found) {
    ProgramOptions program = session.program_options();
    std::size_t unwatched = 0, of_marked = 0;
    found.first_bad = find_fault(session, options, program, unwatched);
    if (!found.first_bad) {
        program.marked = Marked{{0, session.preset().scene.text.size()}};
        found.first_bad = find_fault(session, options, program, of_marked);
    }
    if (!found.first_bad) {
        program.marked->outputs = true;
        found.first_bad = find_fault(session, options, program, of_marked);
    }
    std::optional<ProbeFault> fault = std::move(found.first_bad);
    found = session.probing(place);
    found.first_bad = std::move(fault);
    if (unwatched > 0 && !found.first_bad)
        found.notes.push_back(fmt::format(
            "of so many operations those that may have no result were watched, and what makes a "
            "pixel NaN or Inf; {} others were not",
            unwatched));
}

}  // namespace

void run_probe(const ProbeOptions& options) {
    require_sense(options);
    ProbeSession session(options);
    const NamedFile map{"--map", options.map.string()};
    if (!options.map.empty() && !can_write(options.map))
        throw UsageError(fmt::format("--map {}: name a .png, .jpg, .exr, .tif or .hdr file.",
                                     options.map.string()));
    require_apart({map}, files_read_for(session.preset()));
    require_apart({map}, files_expected(session.preset()));
    const ProbePlace place = session.place(options);
    Probing found;
    if (options.faults) {
        probe_faults(session, options, place, found);
        return print(found, options);
    }
    if (options.cost) {
        ProbeCost cost = cost_of(session, options, options.map);
        found = session.probing(place);
        found.cost = std::move(cost);
        return print(found, options);
    }
    Probe probe = probe_of(options, session);
    if (options.along == "time")
        probe_frames(session, probe, options, place, found);
    else if (!options.line.empty() && probe.probed().sites.empty() && probe.notes().empty())
        stop_at_line(session, options, no_value(session));
    else if (!options.map.empty() || !options.along.empty())
        probe_picture(session, probe, options, place, found);
    else
        probe_pixel(session, probe, options, place, found);
    for (std::string& note : probe.notes()) found.notes.push_back(std::move(note));
    print(found, options);
}

void say_broken_assertions(Preset preset, const ProbeOptions& options) {
    if (!has_assertions(preset.scene)) return;
    ProbeSession session(std::move(preset), options);
    const Frame& frame = session.play_to(options);
    const auto draw = [&](const BrokenAssertions&) { session.renderer().draw(frame); };
    for (const BrokenAssertion& broken :
         broken_assertions(session.preset(), session.renderer(), session.program_options(), draw))
        say_diagnostic(
            {Severity::warning, {broken.file, broken.line, broken.column}, sentence_of(broken)});
}

}  // namespace glint
