#include "measure/study/comparison.h"

#include "base/json_text.h"
#include "base/markup.h"
#include "base/temporary_file.h"
#include "measure/rows/heat.h"
#include "measure/study/result.h"
#include "offline/picture_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kLooksHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Glint: two looks</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: 76em; padding: 0 1em; }
h1, h2 { font-weight: 600; overflow-wrap: anywhere; } .facts { color: #666; }
.wipe { position: relative; --at: 50%; } .wipe img { display: block; width: 100%; }
.wipe .a { position: absolute; inset: 0; clip-path: inset(0 calc(100% - var(--at)) 0 0); }
.wipe .line { position: absolute; top: 0; bottom: 0; left: var(--at); width: 1px; background: #fff; mix-blend-mode: difference; }
.wipe input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; cursor: ew-resize; }
.names { display: flex; justify-content: space-between; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 1em; }
figure { margin: 0; } figure img { width: 100%; display: block; } figcaption { color: #444; }
.scale { display: inline-block; width: 12em; height: .8em; vertical-align: middle;
         background: linear-gradient(90deg, #000, #1a1a99, #b31a80, #ff991a, #fff); border: 1px solid #999; }
</style>
)";

std::string numbers_text(const glm::vec4& numbers, Values values) {
    const std::string rgb = fmt::format("{:.3g} {:.3g} {:.3g}", numbers.x, numbers.y, numbers.z);
    return values == Values::data ? fmt::format("({} {:.3g})", rgb, numbers.w) : "(" + rgb + ")";
}

std::string error_text(const Comparison& c) {
    const Difference& e = c.error;
    const std::string alpha =
        c.alpha_off > 0
            ? fmt::format(" Their alpha, which is not compared, differs in {} pixels.", c.alpha_off)
            : "";
    if (e.max == 0.0 && e.not_finite == 0) return "The pictures are the same." + alpha;
    if (std::isnan(e.rmse)) return "No pixel is finite in both.";
    std::string text = fmt::format(
        "RMSE {}, FLIP {}, PSNR {} dB, {:.2f} % off by more than 1/255; most at {},{}: {} off, A "
        "{}, B {}",
        three_digits(e.rmse), three_digits(e.flip),
        std::isinf(e.psnr) ? "inf" : fmt::format("{:.1f}", e.psnr), 100.0 * e.share_off, c.worst.x,
        c.worst.y, three_digits(e.max), numbers_text(c.at_worst[0], c.values),
        numbers_text(c.at_worst[1], c.values));
    if (e.not_finite > 0) text += fmt::format("; {} pixels are not finite", e.not_finite);
    return alpha.empty() ? text : text + "." + alpha;
}

std::string values_text(Values values) {
    return values == Values::light  ? "\nvalues: linear light"
           : values == Values::data ? "\nvalues: numbers of a buffer"
                                    : "";
}

std::string time_text(const Comparison& c) {
    if (!c.times) return "No times: a picture takes none.";
    const TimedPair& t = *c.times;
    const auto one = [](const Timing& ms) {
        return fmt::format("{:.3f} ms ({:.3f} to {:.3f})", ms.median, ms.low, ms.high);
    };
    const std::string verdict = t.verdict == TimeVerdict::faster   ? "B is faster"
                                : t.verdict == TimeVerdict::slower ? "B is slower"
                                                                   : "not told apart";
    return fmt::format("A {}, B {}; {}: B takes {:.3f} of A's time ({:.3f} to {:.3f})", one(t.a),
                       one(t.b), verdict, t.ratio, t.between.low, t.between.high);
}

std::string page(const Comparison& c) {
    const auto name = [&](std::size_t i) { return markup_escaped(c.files[i]); };
    std::string text = kLooksHead;
    text += fmt::format("<h1>{} and {}</h1>\n", name(0), name(1));
    text += fmt::format("<p>{}</p>\n<p>{}</p>\n", markup_escaped(error_text(c)),
                        markup_escaped(time_text(c)));
    text += fmt::format("<p class=facts>{}×{}{}</p>\n", c.size.x, c.size.y,
                        c.renderer.empty() ? ""
                                           : ", " + markup_escaped(c.renderer) + "<br>" +
                                                 markup_escaped(c.machine));
    text += fmt::format(
        "<div class=wipe><img src=\"b.png\" alt=\"B: {1}\"><img class=a src=\"a.png\" alt=\"A: "
        "{0}\">"
        "<span class=line></span><input type=range min=0 max=100 step=0.1 value=50 "
        "aria-label=\"where A ends and B begins\" "
        "oninput=\"this.parentNode.style.setProperty('--at', this.value + '%')\"></div>\n"
        "<p class=names><span>A: {0}</span><span>B: {1}</span></p>\n",
        name(0), name(1));
    text +=
        "<div class=pictures>\n<figure><img src=\"difference.png\" alt=\"difference\">"
        "<figcaption>The largest difference of a channel in light, 1/10000 <span "
        "class=scale></span> 1; not finite: magenta</figcaption></figure>\n"
        "<figure><img src=\"flip.png\" alt=\"FLIP\"><figcaption>FLIP: what a person sees of it, 0 "
        "<span class=scale></span> 1</figcaption></figure>\n</div>\n</html>\n";
    return text;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    write_whole_file(cleared(file), std::as_bytes(std::span(text)));
}

Json to_json(const Timing& ms) {
    return {{"ms", ms.median}, {"ms_low", ms.low}, {"ms_high", ms.high}};
}

}  // namespace

std::string to_table(const Comparison& c) {
    return fmt::format("A  {}\nB  {}\n{}x{}{}{}\n{}\n{}\n{}", c.files[0], c.files[1], c.size.x,
                       c.size.y, c.renderer.empty() ? "" : "  " + c.renderer, values_text(c.values),
                       error_text(c), time_text(c),
                       c.times ? fmt::format("clock: {}\n", to_string(c.times->clock)) : "");
}

Json to_json(const Comparison& c) {
    Json json = {{"a", {{"file", c.files[0]}}},
                 {"b", {{"file", c.files[1]}}},
                 {"size", {c.size.x, c.size.y}},
                 {"renderer", c.renderer},
                 {"machine", c.machine}};
    json.update(glint::to_json(c.error));
    const auto numbers = [&](const glm::vec4& n) {
        return c.values == Values::data ? Json{n.x, n.y, n.z, n.w} : Json{n.x, n.y, n.z};
    };
    json["worst"] = {{"pixel", {c.worst.x, c.worst.y}},
                     {"a", numbers(c.at_worst[0])},
                     {"b", numbers(c.at_worst[1])}};
    json["alpha_off"] = c.alpha_off;
    if (!c.times) return json;
    json["a"].update(to_json(c.times->a));
    json["b"].update(to_json(c.times->b));
    json["ms_ratio"] = c.times->ratio;
    json["ms_ratio_low"] = c.times->between.low;
    json["ms_ratio_high"] = c.times->between.high;
    json["verdict"] = to_string(c.times->verdict);
    json["clock"] = to_string(c.times->clock);
    return json;
}

void write_comparison(const std::filesystem::path& folder, const Comparison& c) {
    make_folder(folder);
    write_text(folder / "looks.json",
               json_text(to_json(c)) + "\n");  // by which the others are known
    write_shown(folder / "a.png", for_display(c.pictures[0], c.values), c.size);
    write_shown(folder / "b.png", for_display(c.pictures[1], c.values), c.size);
    write_rgb(folder / "difference.png", difference_heat(c.pictures[0], c.pictures[1], c.values),
              c.size);
    write_rgb(folder / "flip.png", heat(c.seen), c.size);
    write_text(folder / "index.html", page(c));
}

}  // namespace glint
