#include "modes/study_plot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace glint {
namespace {

namespace fs = std::filesystem;

// A folder that goes with its owner.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / "glint-plot-XXXXXX").string();
        if (::mkdtemp(name.data())) path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

// A word in gnuplot's single quotes.
std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("''") : std::string(1, c);
    return text + "'";
}

bool can_be_shown(const Study& study, const StudyRow& row) {
    if (study.timing(row).median <= 0.0) return false;
    if (study.time_only) return row.work && *row.work > 0.0;
    return row.failed.empty() && row.error && row.error->rmse > 0.0;
}

// x, its ends, y, the label.
std::string data_block(const Study& study, const char* name, bool only_pareto) {
    std::vector<const StudyRow*> rows;
    for (const StudyRow& row : study.rows) {
        if (can_be_shown(study, row) && (!only_pareto || row.pareto)) rows.push_back(&row);
    }
    if (only_pareto) {
        std::sort(rows.begin(), rows.end(), [&](const StudyRow* a, const StudyRow* b) {
            return study.timing(*a).median < study.timing(*b).median;
        });
    }
    std::string text = fmt::format("${} << END\n", name);
    for (const StudyRow* row : rows) {
        const Timing& ms = study.timing(*row);
        if (study.time_only) {
            text += fmt::format("{} {} {} {} \"{}\"\n", *row->work, ms.median, ms.min, ms.max,
                                row->value);
        } else {
            text += fmt::format("{} {} {} {} \"{}\"\n", ms.median, row->error->rmse, ms.min, ms.max,
                                row->value);
        }
    }
    return text + "END\n";
}

constexpr const char* kStyle = R"(
set encoding utf8
set logscale xy
set format y '10^{%T}'
set grid xtics ytics mxtics mytics lc rgb '#d8d8d8', lc rgb '#efefef'
set border 3 lc rgb '#808080'
set tics nomirror textcolor rgb '#404040'
set offsets graph 0.12, graph 0.12, graph 0.12, graph 0.12
set key top right
set bars small
)";

std::string script(const Study& study, const fs::path& output, const std::string& name) {
    std::string text = fmt::format(
        "set terminal svg size 760,440 dynamic font 'sans-serif,13' name {} background '#ffffff'\n"
        "set output {}\n",
        quoted(name), quoted(output.string()));
    text += kStyle + data_block(study, "rows", false);
    if (study.time_only) {
        text += fmt::format(
            "set format x '%g'\nset format y '%g'\nset xlabel {} noenhanced\n"
            "set ylabel 'ms a frame'\n"
            "plot $rows using 1:2:3:4 with yerrorlines lw 2 pt 7 ps 0.6 lc rgb '#1f5fa8' notitle\n",
            quoted(study.knob));
        return text;
    }
    text += data_block(study, "pareto", true);
    text += fmt::format("set format x '%g'\nset xlabel 'ms{}'\nset ylabel 'RMSE{}'\n",
                        study.clock == Clock::wall  ? ""
                        : study.clock == Clock::gpu ? ", by timer queries"
                                                    : " of the processor, all threads",
                        study.pass == "image" ? " in linear light" : "");
    const bool floor = study.reference_error && study.reference_error->rmse > 0.0;
    text += "plot ";
    if (floor) {
        text += fmt::format("{} with lines dt 2 lc rgb '#a04040' title 'error of the reference', ",
                            study.reference_error->rmse);
    }
    text +=
        "$pareto using 1:2 with lines lw 5 lc rgb '#f0c060' title 'Pareto frontier', "
        "$rows using 1:2:3:4 with xerrorbars lw 1.5 pt 7 ps 0.6 lc rgb '#1f5fa8' notitle, "
        "$rows using 1:2:5 with labels left offset 0.8,0.5 tc rgb '#1f5fa8' noenhanced notitle\n";
    return text;
}

std::string read_svg(const fs::path& file) {
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t begin = text.find("<svg"), end = text.rfind("</svg>");
    if (begin == std::string::npos || end == std::string::npos) return {};
    return text.substr(begin, end + 6 - begin);
}

}  // namespace

std::string svg_plot(const Study& study) {
    const auto shown = std::count_if(study.rows.begin(), study.rows.end(),
                                     [&](const StudyRow& r) { return can_be_shown(study, r); });
    const ScratchFolder scratch;
    if (shown < 2 || scratch.path().empty()) return {};
    const fs::path file = scratch.path() / "plot.svg", commands = scratch.path() / "plot.gp";
    // Names of its parts, so that several diagrams can stand in one page.
    const std::string name =
        fmt::format("{}_{}", fs::path(study.scene).stem().string(), study.knob);
    std::ofstream(commands) << script(study, file, name);
    const std::string command =
        fmt::format("gnuplot '{}' >/dev/null 2>&1 </dev/null", commands.string());
    if (std::system(command.c_str()) != 0) return {};
    return read_svg(file);
}

}  // namespace glint
