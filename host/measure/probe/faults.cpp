#include "measure/probe/faults.h"

#include "scene/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace glint {
namespace {

// What glsl/zeros.h writes for what was never given a value, where it is marked.
constexpr std::uint32_t kMark = 0x7FC0DEADu;

bool is_finite(const ProbeCell& cell) {
    return std::ranges::all_of(cell.colour, [](float v) { return std::isfinite(v); });
}

// So many operations can be watched at once, whatever the text: compilers take minutes and
// gigabytes where all those of a long one are.
constexpr std::size_t kMostAtOnce = 48;
// So many times that, each a program of its own, whatever becomes of it.
constexpr std::size_t kMostParts = 6;

std::vector<ProbeSite> sites_of(const Preset& preset, std::size_t pass,
                                const ProgramOptions& options) {
    ProbeWish wish{.kind = ProbeKind::faults};
    std::vector<ProbeSite> sites = pass_text(preset, pass, options, &wish).probed.sites;
    std::ranges::sort(sites, {}, &ProbeSite::at);
    return sites;
}

// The bytes whose operations are watched together; none, where there are none.
std::vector<Span> parts_of(const Preset& preset, const std::vector<ProbeSite>& sites) {
    std::vector<Span> parts;
    for (const ProbeSite& site : sites) {
        if (!parts.empty() && site.at < parts.back().end) continue;
        if (!parts.empty()) parts.back().end = site.at;
        const auto first = static_cast<std::size_t>(&site - sites.data());
        const std::size_t last = first + kMostAtOnce - 1;
        parts.push_back(
            {site.at, last < sites.size() ? sites[last].at + 1 : preset.scene.text.size()});
    }
    return parts;
}

// Where all operations are too many at once, those without what is wrong rarely: operands of others
// that hide it, then bounds, and what becomes a whole number; where these are too many, too, what
// may have no result at all. Few of a long text do, and where something is not finite, one of them
// is mostly why.
std::vector<Span> likely(const Preset& preset, const std::vector<ProbeSite>& sites) {
    if (parts_of(preset, sites).size() <= 1) return {};
    const auto only = [&](const auto& is_wanted) {
        std::vector<Span> places{{0, 0}};  // empty would be all
        for (const ProbeSite& site : sites)
            if (is_wanted(site)) places.push_back({site.at, site.at + 1});
        return places;
    };
    const auto is_no_operand = [](const ProbeSite& site) { return site.kind != SiteKind::operand; };
    const std::vector<Span> all_others = only(is_no_operand);
    if (all_others.size() <= kMostAtOnce + 1) return all_others;
    const std::vector<Span> often = only([&](const ProbeSite& site) {
        return is_no_operand(site) && site.kind != SiteKind::bounds && site.kind != SiteKind::whole;
    });
    if (often.size() <= kMostAtOnce + 1) return often;
    return only([](const ProbeSite& site) {
        return site.kind == SiteKind::domain && !site.name.starts_with("normalize");
    });
}

// What a survey watches together: all, but where they are too many.
std::vector<std::vector<Span>> groups_of(const Preset& preset,
                                         const std::vector<ProbeSite>& sites) {
    const std::vector<Span> parts = parts_of(preset, sites);
    if (parts.size() <= 1) return {{}};
    if (parts.size() > kMostParts) return {likely(preset, sites)};
    std::vector<std::vector<Span>> groups;
    for (const Span part : parts) groups.push_back({part});
    return groups;
}

// The first fault of the fragment, if any, is of an operation that had no result.
bool is_undefined_first(const ProbeCell& cell) {
    return cell.told[0] > 0 && cell.told[1] == cell.told[2];
}

std::size_t site_of(const ProbeCell& cell) {
    return cell.told[1] - 1;
}

double as_float(std::uint32_t bits) {
    return static_cast<double>(std::bit_cast<float>(bits));
}

// `uint(x)`, not `1 << n`.
bool is_conversion(const ProbeSite& site) {
    return site.name.starts_with("int(") || site.name.starts_with("uint(") ||
           site.name.starts_with("ivec") || site.name.starts_with("uvec");
}

// Whatever a driver makes of it, it is a number.
bool has_a_result(const ProbeSite& site) {
    return site.kind == SiteKind::whole || site.kind == SiteKind::remainder ||
           site.kind == SiteKind::index || site.kind == SiteKind::bounds ||
           site.name.starts_with("atan(");
}

// As many as tell it from every other float: acos(1.0000001) is not acos(1).
std::string digits(double value) {
    return fmt::format("{}", static_cast<float>(value));
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
            fault.operands = {std::isnan(a) ? 0.0 : a};  // NaN: of 0/0, what comes of it
            return;
        case SiteKind::remainder:
            fault.what = whole(0) == 0.0 ? "division by zero" : "% of a negative number";
            fault.operands = {whole(0)};
            return;
        case SiteKind::index:
            fault.operands = {whole(0), whole(1)};
            fault.what = fmt::format("index {:.0f} of {:.0f}", whole(0), whole(1));
            return;
        case SiteKind::domain:
            fault.operands = {a};
            fault.what = fmt::format("{}({})", name, digits(a));
            if (name == "pow" || name == "mod" || name == "atan") {
                fault.operands.push_back(b);
                fault.what = fmt::format("{}({}, {})", name, digits(a), digits(b));
            } else if (name == "normalize") {
                fault.what = "normalize of a vector of length 0";
            }
            return;
        case SiteKind::bounds:
            fault.operands = {a, b};
            fault.what = name == "clamp" ? "clamp between reversed bounds"
                                         : "smoothstep between equal edges";
            return;
        case SiteKind::whole:
            fault.operands = {a};
            fault.what = is_conversion(site) ? fmt::format("{}({})", name, digits(a))
                                             : fmt::format("shift({:.0f})", a);
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

FaultWatch::FaultWatch(const Preset& preset, Renderer& renderer, const ProgramOptions& options)
    : preset_(preset),
      renderer_(renderer),
      options_(options),
      is_marked_(options.marked.has_value()) {
    for (const GraphPass& pass : renderer.graph().passes) {
        const std::vector<ProbeSite> sites = sites_of(preset, pass.pass, options);
        parts_.push_back(parts_of(preset, sites));
        probes_.emplace_back(preset, pass.pass, options,
                             ProbeWish{.kind = ProbeKind::faults, .only = likely(preset, sites)});
    }
    for (const std::vector<Span>& parts : parts_) part_probes_.emplace_back(parts.size());
    renderer.before_pass = [this](std::size_t index) { look(index); };
}

std::size_t FaultWatch::unwatched() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (parts_[i].size() <= kMostParts) continue;
        const std::size_t pass = renderer_.graph().passes[i].pass;
        count += sites_of(preset_, pass, options_).size() - probes_[i].probed().sites.size();
    }
    return count;
}

FaultWatch::~FaultWatch() {
    renderer_.before_pass = nullptr;
}

Probe FaultWatch::probe_of(std::size_t index, std::vector<Span> only) const {
    return Probe(preset_, renderer_.graph().passes[index].pass, options_,
                 {.kind = ProbeKind::faults, .only = std::move(only)});
}

Probe& FaultWatch::part(std::size_t index, std::size_t number) {
    std::unique_ptr<Probe>& probe = part_probes_[index][number];
    if (!probe) {
        probe = std::make_unique<Probe>(probe_of(index, {parts_[index][number]}));
        if (after_program) after_program();
    }
    return *probe;
}

// The first pixel in which an operation of any part was at fault; of many parts nobody looks.
std::optional<std::size_t> FaultWatch::faulty_pixel(std::size_t index, int face) {
    const std::size_t count = parts_[index].size();
    for (std::size_t number = 0; number < count && count <= kMostParts; ++number) {
        const auto cells = part(index, number).map(renderer_, *frame_, 0, 0, face);
        const auto faulty =
            std::ranges::find_if(cells, [&](const ProbeCell& cell) { return has_fault(cell); });
        if (faulty != cells.end()) return static_cast<std::size_t>(faulty - cells.begin());
    }
    return std::nullopt;
}

ProbeFault FaultWatch::fault_of(std::size_t index, const Probe& probe,
                                const std::vector<ProbeCell>& cells, std::size_t found,
                                int face) const {
    const ProbeCell& cell = cells[found];
    const ProbeSite& site = probe.probed().sites[site_of(cell)];
    const ProbeValue row = probe.row(site_of(cell));
    ProbeFault fault{.file = row.file,
                     .line = row.line,
                     .column = row.column,
                     .function = row.function,
                     .expression = site.name};
    describe(site, cell, fault);
    const int width = renderer_.buffer(index).shape().size.x, at = static_cast<int>(found);
    fault.pass = pass_name(preset_.scene, renderer_.graph().passes[index].pass);
    if (renderer_.buffer(index).shape().cube) fault.face = face;
    fault.pixel = {at % width, at / width};
    fault.frame = frame_->frame;
    fault.pixels =
        static_cast<std::size_t>(std::ranges::count_if(cells, [&](const ProbeCell& other) {
            return has_fault(other) && other.told[1] == cell.told[1];
        }));
    fault.is_seen = !is_finite(cell);
    fault.has_result = has_a_result(site);
    return fault;
}

// What made a pixel not finite is not what every driver gives some finite number for, where another
// operation of the pixel is at fault, too.
void FaultWatch::note(std::size_t index, const Probe& probe, const std::vector<ProbeCell>& cells,
                      std::size_t found, int face) {
    first_ = fault_of(index, probe, cells, found, face);
    const auto& sites = probe.probed().sites;
    if (!first_->is_seen || is_marked_ || !has_a_result(sites[site_of(cells[found])])) return;
    std::vector<Span> others;
    for (const ProbeSite& site : sites)
        if (!has_a_result(site)) others.push_back({site.at, site.at + 1});
    if (others.empty()) return;
    Probe other = probe_of(index, std::move(others));
    const std::vector<ProbeCell> again = other.map(renderer_, *frame_, 0, 0, face);
    if (has_fault(again[found])) first_ = fault_of(index, other, again, found, face);
}

bool FaultWatch::has_fault(const ProbeCell& cell) const {
    return cell.told[0] > 0 && (!is_marked_ || cell.kept[0] == kMark);
}

void FaultWatch::look(std::size_t index) {
    if (is_seen() || !frame_ || parts_[index].empty()) return;
    const int faces = renderer_.buffer(index).shape().cube ? 6 : 1;
    for (int face = 0; face < faces && !is_seen(); ++face) {
        if (parts_[index].size() == 1)
            look_at_once(index, face);
        else
            look_in_parts(index, face);
    }
}

void FaultWatch::look_at_once(std::size_t index, int face) {
    Probe& probe = probes_[index];
    if (probe.probed().sites.empty()) return;
    const std::vector<ProbeCell> cells = probe.map(renderer_, *frame_, 0, 0, face);
    const auto faulty = [&](const ProbeCell& cell) { return has_fault(cell); };
    auto found = std::ranges::find_if(
        cells, [&](const ProbeCell& cell) { return has_fault(cell) && !is_finite(cell); });
    if (found == cells.end() && !first_) found = std::ranges::find_if(cells, faulty);
    if (found == cells.end()) return;
    note(index, probe, cells, static_cast<std::size_t>(found - cells.begin()), face);
}

// Of many operations: what has no result, whether or not it shows. Where something shows that they
// do not explain, each part tells whether one of its operations was at fault in that pixel, and a
// last program, of these alone, which came first.
void FaultWatch::look_in_parts(std::size_t index, int face) {
    const std::vector<ProbeCell> cells = probes_[index].map(renderer_, *frame_, 0, 0, face);
    const auto undefined = [&](const ProbeCell& cell) {
        return has_fault(cell) && is_undefined_first(cell);
    };
    auto bad = std::ranges::find_if_not(cells, is_finite);
    if (bad == cells.end() && !first_) bad = std::ranges::find_if(cells, undefined);
    if (bad == cells.end() && first_) return;
    const auto pixel = bad == cells.end()
                           ? faulty_pixel(index, face)
                           : std::optional(static_cast<std::size_t>(bad - cells.begin()));
    if (!pixel) return;
    const std::size_t at = *pixel;
    if (undefined(cells[at])) {
        note(index, probes_[index], cells, at, face);
        return;
    }
    std::vector<Span> faulty;
    for (std::size_t number = 0; number < parts_[index].size(); ++number) {
        Probe& probe = part(index, number);
        const ProbeCell cell = probe.map(renderer_, *frame_, 0, 0, face)[at];
        if (!has_fault(cell)) continue;
        const std::size_t place = probe.probed().sites[site_of(cell)].at;
        faulty.push_back({place, place + 1});
    }
    if (parts_[index].size() > kMostParts)  // of so many none is kept
        for (std::unique_ptr<Probe>& probe : part_probes_[index]) probe.reset();
    if (faulty.empty()) return;
    Probe probe = probe_of(index, std::move(faulty));
    const std::vector<ProbeCell> again = probe.map(renderer_, *frame_, 0, 0, face);
    if (has_fault(again[at])) note(index, probe, again, at, face);
}

FaultSurvey::FaultSurvey(const Preset& preset, Renderer& renderer, const ProgramOptions& options)
    : preset_(preset), renderer_(renderer) {
    for (const GraphPass& pass : renderer.graph().passes) {
        std::vector<Probe>& groups = probes_.emplace_back();
        for (auto& only : groups_of(preset, sites_of(preset, pass.pass, options)))
            groups.emplace_back(preset, pass.pass, options,
                                ProbeWish{.kind = ProbeKind::faults, .only = std::move(only)});
    }
}

FaultSurvey::~FaultSurvey() {
    renderer_.before_pass = nullptr;
}

void FaultSurvey::begin(const Frame& frame, bool anew) {
    std::size_t sites = 0;
    for (const auto& groups : probes_)
        for (const Probe& probe : groups) sites += probe.probed().sites.size();
    distances_.assign(sites, std::numeric_limits<float>::infinity());
    looked_at_.assign(probes_.size(), false);
    fault_.reset();
    frame_ = &frame;
    ++turn_;
    anew ? renderer_.redraw_all() : renderer_.redraw();
    renderer_.before_pass = [this](std::size_t index) { look(index); };
}

void FaultSurvey::end() {
    renderer_.before_pass = nullptr;
}

void FaultSurvey::look(std::size_t index) {
    if (looked_at_[index]) return;
    looked_at_[index] = true;
    const int faces = renderer_.buffer(index).shape().cube ? 6 : 1;
    for (std::size_t group = 0; group < probes_[index].size(); ++group)
        for (int face = 0; face < faces; ++face) look_at(index, group, face);
}

void FaultSurvey::look_at(std::size_t index, std::size_t group, int face) {
    Probe& probe = probes_[index][group];
    const std::size_t sites = probe.probed().sites.size();
    if (sites == 0) return;
    std::size_t before = 0;
    for (std::size_t i = 0; i <= index; ++i)
        for (std::size_t k = 0; k < (i < index ? probes_[i].size() : group); ++k)
            before += probes_[i][k].probed().sites.size();
    const std::vector<ProbeCell> cells = probe.survey(renderer_, *frame_, turn_, 0, face);
    const auto width = static_cast<std::size_t>(renderer_.buffer(index).shape().size.x);
    for (std::size_t at = 0; at < cells.size(); ++at) {
        const float off = std::bit_cast<float>(cells[at].kept[2]);
        const std::size_t site =
            (static_cast<std::size_t>(turn_) + at % width + 37 * (at / width)) % sites;
        if (off < 1e38f) distances_[before + site] = std::min(distances_[before + site], off);
    }
    if (!fault_) judge(probe, index, face, cells);
}

namespace {

bool is_another(const ProbeCell& a, const ProbeCell& b) {
    for (std::size_t c = 0; c < 4; ++c) {
        const float x = a.colour[c], y = b.colour[c];
        if (std::isnan(x) && std::isnan(y)) continue;
        if (!(std::abs(x - y) <= std::max(1.0f, std::abs(y)) / 255.0f) && x != y) return true;
    }
    return false;
}

// What no program may do, whether or not it shows.
bool is_never_right(const ProbeSite& site, const ProbeCell& cell) {
    const bool is_whole = !std::isnan(as_float(cell.kept[3]));
    return (site.kind == SiteKind::division && is_whole) ||
           (site.kind == SiteKind::remainder && cell.kept[3] == 0) ||
           (site.kind == SiteKind::index && !site.name.starts_with("texelFetch"));
}

// The middle of polar coordinates, one pixel at odd sizes: every other scene of rings has one.
bool is_lone_angle(const ProbeSite& site, const std::vector<ProbeCell>& cells, std::size_t number) {
    return site.name.starts_with("atan(") &&
           std::ranges::count_if(
               cells, [&](const ProbeCell& cell) { return cell.told[2] == number + 1; }) == 1;
}

// What is undefined, or, in the picture's alpha, which the plain picture has not, no number.
bool is_undefined(const ProbeCell& cell) {
    return cell.told[2] != 0 || (cell.told[1] != 0 && !is_finite(cell));
}

// Another colour with any of the results that it may have.
std::vector<bool> shows(Probe& probe, Renderer& renderer, const Frame& frame, int turn, int face,
                        const std::vector<ProbeCell>& cells) {
    std::vector<bool> shown(cells.size());
    for (std::size_t at = 0; at < cells.size(); ++at)
        shown[at] = is_undefined(cells[at]) && !is_finite(cells[at]);
    for (int mend = 1; mend <= Probe::kMends && std::ranges::find(shown, true) == shown.end();
         ++mend) {
        const std::vector<ProbeCell> mended = probe.survey(renderer, frame, turn, mend, face);
        for (std::size_t at = 0; at < cells.size(); ++at)
            shown[at] = is_undefined(cells[at]) && is_another(cells[at], mended[at]);
    }
    return shown;
}

}  // namespace

void FaultSurvey::judge(Probe& probe, std::size_t index, int face,
                        const std::vector<ProbeCell>& cells) {
    if (std::ranges::none_of(cells, is_undefined)) return;
    const std::vector<bool> shown = shows(probe, renderer_, *frame_, turn_, face, cells);
    for (std::size_t at = 0; at < cells.size(); ++at) {
        if (!is_undefined(cells[at])) continue;
        const bool is_told = cells[at].told[2] != 0;
        const std::size_t number = cells[at].told[is_told ? 2 : 1] - 1;
        const ProbeSite& site = probe.probed().sites[number];
        if (!shown[at] && !(is_told && is_never_right(site, cells[at]))) continue;
        if (is_lone_angle(site, cells, number)) continue;
        const ProbeValue row = probe.row(number);
        fault_ = ProbeFault{.file = row.file,
                            .line = row.line,
                            .column = row.column,
                            .function = row.function,
                            .expression = site.name};
        ProbeCell worst = cells[at];
        if (is_told) worst.kept[0] = worst.kept[3];
        describe(site, worst, *fault_);
        fault_->has_result = has_a_result(site);
        fault_->operands.resize(1);  // of the second nothing is known
        if (site.kind == SiteKind::index)
            fault_->what = fmt::format("index {:.0f} out of range", fault_->operands.front());
        if (const auto comma = fault_->what.find(", "); comma != std::string::npos)
            fault_->what.replace(comma, std::string::npos, ", ...)");
        const int width = renderer_.buffer(index).shape().size.x;
        fault_->pass = pass_name(preset_.scene, renderer_.graph().passes[index].pass);
        if (renderer_.buffer(index).shape().cube) fault_->face = face;
        fault_->pixel = {static_cast<int>(at) % width, static_cast<int>(at) / width};
        fault_->frame = frame_->frame;
        fault_->is_seen = !is_finite(cells[at]);
        fault_->pixels =
            static_cast<std::size_t>(std::ranges::count_if(cells, [&](const ProbeCell& cell) {
                return cell.told[is_told ? 2 : 1] == number + 1;
            }));
        return;
    }
}

}  // namespace glint
