#include "measure/study/page.h"

#include "base/markup.h"
#include "base/temporary_file.h"
#include "glsl/raw_text.h"
#include "measure/study/plot.h"
#include "measure/study/result.h"
#include "media/image.h"
#include "offline/common.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace glint {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Glint: error against run time</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: 76em; padding: 0 1em; }
h1, h2 { font-weight: 600; overflow-wrap: anywhere; } h2 { margin-top: 2.5em; border-top: 1px solid #ddd; padding-top: 1em; }
.table { overflow-x: auto; margin: 1em 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .15em .8em; text-align: right; border-bottom: 1px solid #eee; } th { color: #666; font-weight: 500; }
td, th { white-space: nowrap; } td:first-child { white-space: normal; min-width: 12em; } td.words { white-space: normal; min-width: 16em; }
td.text, th.text, td.words { text-align: left; } tr.pareto td, .pareto { background: #fff6e0; } tr.failed td { color: #a02020; }
.finding { color: #a02020; font-weight: 600; } .note, .facts { color: #666; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 1em; }
figure { margin: 0; } figure img { width: 100%; display: block; image-rendering: auto; } figcaption { color: #444; }
svg { max-width: 100%; height: auto; }
.scale { display: inline-block; width: 12em; height: .8em; vertical-align: middle;
         background: linear-gradient(90deg, #000, #1a1a99, #b31a80, #ff991a, #fff); border: 1px solid #999; }
</style>
)";

std::string percent(double share) {
    return fmt::format("{:.2f} %", 100.0 * share);
}

std::string optional_number(const std::optional<double>& value) {
    return value ? fmt::format("{:.2f}", *value) : "–";
}

std::string worst_text(const StudyRow& row) {
    if (!row.worst) return {};
    return fmt::format(" worst {} in {}", three_digits(row.worst->rmse),
                       markup_escaped(row.worst->view));
}

std::string row_text(const Study& study, const StudyRow& row) {
    const Timing& ms = row.ms;
    std::string text = fmt::format(
        "<tr{}><td class=text>{}{}<td>{:.3f}<td>{:.3f} – {:.3f}<td class=text>{}<td>{:.3f}",
        !row.failed.empty() ? " class=failed"
        : row.pareto        ? " class=pareto"
                            : "",
        markup_escaped(row.value), row.is_reference ? " (the reference)" : "", ms.median, ms.low,
        ms.high, row.verdict ? to_string(*row.verdict) : "", row.all_passes_ms);
    if (!row.failed.empty()) {
        return text + fmt::format("<td class=words colspan=7>{}\n", markup_escaped(row.failed));
    }
    if (!row.error) return text + "\n";
    const Difference& e = *row.error;
    const char mark = mark_of(study, row);
    return text +
           fmt::format("<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td class=text>{}\n",
                       three_digits(e.rmse), three_digits(e.max),
                       std::isinf(e.psnr) ? "∞" : fmt::format("{:.1f}", e.psnr),
                       percent(e.share_off), three_digits(e.relative_mse), three_digits(e.flip),
                       (mark == '!' || mark == '~' ? std::string(1, mark) : "") + worst_text(row));
}

std::string table(const Study& study) {
    std::string text = fmt::format(
        "<div class=table><table><tr><th class=text>{}<th>ms<th>95 of 100 within<th "
        "class=text>time<th>ms, all passes",
        markup_escaped(study.knob));
    if (!study.time_only) {
        text += "<th>RMSE<th>max<th>PSNR, dB<th>off by &gt; 1/255<th>relative MSE<th>FLIP<th>";
    }
    text += "\n";
    for (const StudyRow& row : study.rows) text += row_text(study, row);
    text += "</table></div>\n";
    if (study.time_only) return text;
    return text +
           "<p class=facts><span class=pareto>Shaded</span>: no other value is told to be better "
           "in "
           "time or error, and worse in neither. ~: within ten times of the reference's own "
           "error. !: its error means nothing.</p>\n";
}

std::string figure(const std::string& file, const std::string& caption) {
    if (file.empty()) return {};
    return fmt::format(
        "<figure><img src=\"{}\" alt=\"{}\" loading=lazy><figcaption>{}</figcaption></figure>\n",
        markup_escaped(file), markup_escaped(caption), markup_escaped(caption));
}

std::string pictures(const Study& study) {
    if (study.reference_picture.empty()) return {};
    std::string text =
        "<p class=facts>Maps show the largest difference of a channel: 1/10000 <span "
        "class=scale></span> 1; not finite: magenta. FLIP: what a person sees of it, linear from "
        "0 to 1 in the same colours.</p>\n<div class=pictures>\n";
    text += figure(study.reference_picture, fmt::format("reference, {}", study.reference));
    for (const StudyRow& row : study.rows) {
        if (row.is_reference) continue;
        text += figure(row.picture, fmt::format("{} {}", study.knob, row.value));
        text += figure(row.map, fmt::format("{} {}: difference", study.knob, row.value));
        text += figure(row.flip_map, fmt::format("{} {}: FLIP", study.knob, row.value));
    }
    return text + "</div>\n";
}

std::string facts(const Study& study) {
    std::string text = fmt::format("<p class=facts>{}×{}, {}<br>{}<br>Clock: {}.", study.size.x,
                                   study.size.y, markup_escaped(study.renderer),
                                   markup_escaped(study.machine), to_string(study.clock));
    if (!study.views.empty()) {
        text += fmt::format("<br>Over {} views: {}.", study.views.size(),
                            markup_escaped(fmt::format("{}", fmt::join(study.views, ", "))));
    }
    if (!study.time_only) {
        text += fmt::format("<br>Compared: {}. Reference: {}; its own error {}.",
                            study.pass == "image"
                                ? "the picture, decoded from sRGB; PSNR and 1/255 as 8-bit"
                                : markup_escaped(study.pass),
                            markup_escaped(study.reference), markup_escaped(own_error_text(study)));
        if (study.rival) {
            text += fmt::format("<br>Second reference: {}; its own error: {}; they differ by {}.",
                                markup_escaped(study.rival->value),
                                three_digits(study.rival->own_error),
                                three_digits(study.rival->difference.rmse));
        }
    }
    return text + "</p>\n";
}

std::string section(const Study& study, std::size_t number) {
    std::string text = fmt::format("<h2 id=s{}>{}: {}</h2>\n", number, markup_escaped(study.scene),
                                   markup_escaped(study.knob));
    text += facts(study);
    for (const std::string& finding : study.findings) {
        text += fmt::format("<p class=finding>{}</p>\n", markup_escaped(finding));
    }
    const std::string plot = svg_plot(study);
    text += plot.empty() ? "<p class=note>No diagram: gnuplot is not installed, or there are fewer "
                           "than two points to show.</p>\n"
                         : plot + "\n";
    text += table(study);
    if (const auto order = study.told_order()) {
        text += fmt::format("<p>Observed order: error ~ work<sup>{:.2f}</sup></p>\n", -*order);
    }
    if (study.cost_exponent) {
        text += fmt::format("<p>Cost: time ~ {}<sup>{:.2f}</sup> over the larger half</p>\n",
                            markup_escaped(study.knob), *study.cost_exponent);
    }
    if (study.best) {
        const StudyRow& best = study.rows[*study.best];
        text += fmt::format("<p>The budget chooses <b>{}</b>: {:.3f} ms, RMSE {}, FLIP {}.</p>\n",
                            markup_escaped(best.value), best.ms.median,
                            three_digits(best.error->rmse), three_digits(best.error->flip));
    }
    for (const std::string& note : study.notes) {
        text += fmt::format("<p class=note>{}</p>\n", markup_escaped(note));
    }
    return text + pictures(study);
}

std::string index(std::span<const Study> studies) {
    std::string text =
        "<div class=table><table><tr><th class=text>scene<th "
        "class=text>knob<th>rows<th>order<th>cost exponent"
        "<th class=text>findings\n";
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const Study& study = studies[i];
        text += fmt::format(
            "<tr><td class=text>{}<td class=text><a href=\"#s{}\">{}</a><td>{}<td>{}<td>{}"
            "<td class=\"words finding\">{}\n",
            markup_escaped(study.scene), i, markup_escaped(study.knob), study.rows.size(),
            optional_number(study.told_order()), optional_number(study.cost_exponent),
            study.findings.empty() ? "" : markup_escaped(study.findings.front()));
    }
    return text + "</table></div>\n";
}

}  // namespace

void require_own_report(const std::vector<NamedFile>& outputs, const std::filesystem::path& data,
                        const char* key, const char* title) {
    std::string why_not;
    const nlohmann::json known =
        nlohmann::json::parse(read_bytes(data, why_not).value_or(""), nullptr, false);
    if (known.is_object() && known.contains(key)) return;
    // Its page is enough where the file beside it is damaged.
    const std::string page = read_bytes(data.parent_path() / "index.html", why_not).value_or("");
    if (page.find(title) != page.npos) return;
    for (const NamedFile& output : outputs) {
        std::error_code unknown;
        if (std::filesystem::symlink_status(output.name, unknown).type() ==
            std::filesystem::file_type::regular)
            throw UsageError(fmt::format(
                "{} would replace {}, which is of no report of this kind; name another folder.",
                output.role, output.name));
    }
}

void write_page(const std::filesystem::path& folder, std::span<const Study> studies) {
    std::string text = kHead;
    text += "<h1>Error against run time</h1>\n";
    text += index(studies);
    for (std::size_t i = 0; i < studies.size(); ++i) text += section(studies[i], i);
    text += "</html>\n";
    write_whole_file(cleared(folder / "index.html"), std::as_bytes(std::span(text)));
}

}  // namespace glint
