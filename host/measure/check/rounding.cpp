// Which lines lose most digits: their results are rounded up or down by chance, one operation after
// the other, and the picture or buffer is compared with the usual one (stochastic arithmetic;
// Vignes, "A Stochastic Arithmetic for Reliable Scientific Computation", 1993; as CADNA and
// Verificarlo do on processors). Told, not judged.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/probe/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace glint {
namespace {

constexpr std::size_t kSitesAtOnce = 64;  // in one program
constexpr int kRoundedFrames = 30;        // of a simulation, before the one that is looked at
constexpr double kRoundingShare = 0.06;   // of the seconds
constexpr double kDigits = 7.2;           // of a float
constexpr double kWorthAWord = 0.5;       // digits
constexpr std::size_t kLinesTold = 3;

struct LosingLine {
    ProbeValue row;
    std::string pass;
    double digits = 0.0;  // lost, in the mean over all pixels
};

// Decimal digits by which a picture is off beyond the last one, in the mean over all pixels, so
// that an edge that flips counts little.
double digits_lost(const std::vector<ProbeCell>& usual, const std::vector<ProbeCell>& now) {
    double squares = 0.0;
    for (const ProbeCell& cell : usual)
        for (std::size_t c = 0; c < 3; ++c)
            if (std::isfinite(cell.colour[c]))
                squares += static_cast<double>(cell.colour[c]) * cell.colour[c] / 3.0;
    const double size = std::sqrt(squares / std::max(1.0, static_cast<double>(usual.size())));
    double sum = 0.0;
    for (std::size_t i = 0; i < usual.size(); ++i) {
        double off = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double one = std::abs(static_cast<double>(usual[i].colour[c]) - now[i].colour[c]);
            if (std::isfinite(one)) off = std::max(off, one);
        }
        // Where nothing is left of a picture, nothing was right in what is now there.
        const double digits = size > 0.0 ? std::log10(std::max(1.0, off / size * 0x1p23)) : kDigits;
        sum += off > 0.0 ? std::min(digits, kDigits) : 0.0;
    }
    return sum / static_cast<double>(usual.size());
}

class RoundingCase {
public:
    explicit RoundingCase(Check& check) : subject_(check.subject), clock_(check) {
        const auto& passes = subject_.renderer().graph().passes;
        for (const GraphPass& pass : passes) {
            const ProbeWish wish{.kind = ProbeKind::rounding};
            sites_.push_back(
                pass_text(subject_.opened(), pass.pass, options(), &wish).probed.sites);
            std::ranges::sort(sites_.back(), {}, &ProbeSite::at);
            count_ += sites_.back().size();
        }
    }

    void run() {
        if (subject_.stateful()) subject_.play_frames(0, kRoundedFrames, 60.0);
        const double time = subject_.stateful() ? kRoundedFrames / 60.0 : subject_.preset.time;
        const Frame frame = subject_.frame_at(time, 1.0 / 60, std::lround(time * 60.0));
        subject_.renderer().before_pass = [&](std::size_t index) { over_pass(index, frame); };
        subject_.renderer().redraw_all();
        subject_.draw(frame);
        subject_.renderer().before_pass = nullptr;
    }

    std::size_t count() const { return count_; }
    std::size_t done() const { return done_; }
    // Those that lose most first.
    std::vector<LosingLine> lines() const {
        std::vector<LosingLine> list;
        for (const auto& [place, line] : lines_) list.push_back(line);
        std::ranges::stable_sort(list, std::ranges::greater(), &LosingLine::digits);
        return list;
    }

private:
    ProgramOptions options() const { return {.specialise = subject_.specialised()}; }
    bool is_over() const { return clock_.is_over(kRoundingShare); }

    void over_pass(std::size_t index, const Frame& frame) {
        if (subject_.renderer().buffer(index).shape().cube) return;
        const std::vector<ProbeSite>& sites = sites_[index];
        for (std::size_t first = 0; first < sites.size() && !is_over(); first += kSitesAtOnce) {
            const std::size_t end = std::min(first + kSitesAtOnce, sites.size());
            ProbeWish wish{.kind = ProbeKind::rounding,
                           .only = {{sites[first].at, sites[end - 1].at + 1}}};
            try {
                Probe probe(subject_.opened(), subject_.renderer().graph().passes[index].pass,
                            options(), std::move(wish));
                if (subject_.after_frame) subject_.after_frame();  // compiling is no hang
                over_sites(probe, index, frame);
            } catch (const ProbeRefused&) {  // the others are told
            }
        }
    }

    void over_sites(Probe& probe, std::size_t index, const Frame& frame) {
        Renderer& renderer = subject_.renderer();
        const auto usual = probe.rounded(renderer, frame, Probe::kNoSite, 1);
        for (std::size_t site = 0; site < probe.probed().sites.size() && !is_over(); ++site) {
            const double digits =
                digits_lost(usual, probe.rounded(renderer, frame, static_cast<int>(site), 1));
            if (subject_.after_frame) subject_.after_frame();
            ++done_;
            const ProbeValue row = probe.row(site);
            LosingLine& line = lines_[{row.file, row.line}];
            if (digits < kWorthAWord || digits <= line.digits) continue;
            line = {row, pass_name(subject_.scene(), renderer.graph().passes[index].pass), digits};
        }
    }

    CheckSubject& subject_;
    const CaseClock clock_;
    std::vector<std::vector<ProbeSite>> sites_;  // by pass
    std::size_t count_ = 0, done_ = 0;
    std::map<std::pair<std::string, int>, LosingLine> lines_;
};

void run_rounding(Check& check, CaseResult& result) {
    result.verdict = CaseVerdict::report;
    if (!check.subject.is_short() && !check.effort.tries) {
        result.verdict = CaseVerdict::skip;
        result.note = "left out: a long text; with --effort 1 --case rounding it is looked at";
        return;
    }
    RoundingCase rounding(check);
    rounding.run();
    std::string words;
    std::vector<LosingLine> lines = rounding.lines();
    lines.resize(std::min(lines.size(), kLinesTold));
    for (const LosingLine& line : lines) {
        if (line.digits < kWorthAWord) break;
        words += fmt::format("{}{}:{} in {}: `{}` loses {:.1f}{}", words.empty() ? "" : ", ",
                             line.row.file, line.row.line, line.row.function, line.row.name,
                             line.digits, words.empty() ? " digits of 7.2" : "");
        if (line.pass != "image") words += " in " + line.pass;
        if (!result.where)
            result.where = CasePlace{.file = line.row.file,
                                     .line = line.row.line,
                                     .function = line.row.function,
                                     .expression = line.row.name,
                                     .what = fmt::format("loses {:.1f} digits", line.digits),
                                     .operands = {}};
    }
    result.note = fmt::format(
        "{}{} operations rounded the other way: {}", rounding.done(),
        rounding.done() < rounding.count() ? fmt::format(" of {}", rounding.count()) : "",
        words.empty() ? "none loses a digit" : words);
}

}  // namespace

void add_rounding_case(std::vector<Case>& list) {
    list.push_back({"rounding", run_rounding});
}

}  // namespace glint
