#include "measure/probe/series.h"

#include "glsl/probe.h"
#include "media/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace glint {
namespace {

constexpr std::size_t kPlotWidth = 72, kPlotRows = 12;

void add_value(ProbeSeries& series, const std::vector<double>& value) {
    if (value.empty()) {
        ++series.unreached;
        return;
    }
    const double infinite = std::numeric_limits<double>::infinity();
    series.min.resize(std::max(series.min.size(), value.size()), infinite);
    series.max.resize(series.min.size(), -infinite);
    series.nan += std::ranges::any_of(value, [](double v) { return std::isnan(v); });
    series.infinite += std::ranges::any_of(value, [](double v) { return std::isinf(v); });
    for (std::size_t c = 0; c < value.size(); ++c) {
        if (!std::isfinite(value[c])) continue;
        series.min[c] = std::min(series.min[c], value[c]);
        series.max[c] = std::max(series.max[c], value[c]);
    }
}

// Lines of text from the largest value down, a letter for each component.
std::string plot(const ProbeSeries& series) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double v : series.min) low = std::min(low, v);
    for (const double v : series.max) high = std::max(high, v);
    if (!(low <= high) || series.values.size() < 2) return {};
    const std::size_t width = std::min(kPlotWidth, series.values.size());
    std::vector<std::string> rows(kPlotRows, std::string(width, ' '));
    for (std::size_t i = 0; i < series.values.size(); ++i) {
        const std::size_t column = i * width / series.values.size();
        for (std::size_t c = 0; c < series.values[i].size(); ++c) {
            const double v = series.values[i][c];
            if (!std::isfinite(v)) continue;
            const double up = high > low ? (v - low) / (high - low) : 0.5;
            const auto row = static_cast<std::size_t>(
                std::lround((1.0 - up) * static_cast<double>(kPlotRows - 1)));
            rows[row][column] = series.values[i].size() == 1 ? '*' : "xyzw"[c % 4];
        }
    }
    std::string text;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const std::string edge = row == 0               ? fmt::format("{:.5g}", high)
                                 : row + 1 == kPlotRows ? fmt::format("{:.5g}", low)
                                                        : "";
        text += fmt::format("{:>12} |{}\n", edge, rows[row]);
    }
    return text;
}

std::string range_of(const ProbeSeries& series) {
    std::string text;
    std::vector<double> low = series.min, high = series.max;
    std::size_t nowhere = 0;  // components
    for (std::size_t c = 0; c < low.size(); ++c) {
        if (low[c] <= high[c]) continue;
        low[c] = high[c] = std::numeric_limits<double>::quiet_NaN();
        ++nowhere;
    }
    if (nowhere > 0 && nowhere == low.size())
        text = "none is finite  ";
    else if (!low.empty())
        text = fmt::format("min {}  max {}  ", shown_value(low, series.what.type),
                           shown_value(high, series.what.type));
    return text + fmt::format("NaN {}  Inf {}  not reached {}\n", series.nan, series.infinite,
                              series.unreached);
}

}  // namespace

ProbeSeries series_of(const std::vector<ProbeCell>& cells, glm::ivec2 size, glm::ivec2 pixel,
                      const std::string& along) {
    ProbeSeries series{.along = along};
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            if ((along == "x" && y != pixel.y) || (along == "y" && x != pixel.x)) continue;
            const ProbeCell& cell = cells[static_cast<std::size_t>(y * size.x + x)];
            const std::vector<double> value =
                cell.told[0] == 0 ? std::vector<double>() : value_of(cell);
            add_value(series, value);
            if (along == "map") continue;
            series.at.push_back(along == "x" ? x : y);
            series.values.push_back(value);
        }
    }
    return series;
}

void add_to(ProbeSeries& series, double at, const ProbeValue* row) {
    if (row) series.what = *row;
    series.at.push_back(at);
    series.values.push_back(row ? row->value : std::vector<double>());
    add_value(series, series.values.back());
}

std::string shown(const ProbeSeries& series) {
    std::string text = fmt::format("line {}: {}: {} along {}\n", series.what.line,
                                   series.what.function, series.what.name, series.along);
    for (std::size_t i = 0; i < series.values.size(); ++i) {
        text += fmt::format("{:>12g}", series.at[i]);
        for (const double v : series.values[i])
            text += fmt::format("  {:>14}", shown_value({v}, series.what.type));
        text += series.values[i].empty() ? "  not reached\n" : "\n";
    }
    return text + range_of(series) + plot(series);
}

void write_map(const std::filesystem::path& file, const std::vector<ProbeCell>& cells,
               glm::ivec2 size) {
    const bool floats = holds_floats(file);
    const ProbeSeries all = series_of(cells, size, glm::ivec2(0), "map");
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double v : all.min) low = std::min(low, v);
    for (const double v : all.max) high = std::max(high, v);
    Image image{.size = size,
                .channels = floats ? 4 : 3,
                .type = floats ? ChannelType::f32 : ChannelType::u8,
                .pixels = {}};
    const auto put = [&](const auto& texel) {
        const auto* bytes = reinterpret_cast<const std::byte*>(texel.data());
        image.pixels.insert(image.pixels.end(), bytes, bytes + sizeof texel);
    };
    for (const ProbeCell& cell : cells) {
        std::vector<double> v = cell.told[0] == 0 ? std::vector<double>() : value_of(cell);
        const bool is_reached = !v.empty();
        if (floats) {
            const bool has_fourth = v.size() == 4;
            v.resize(4, 0.0);
            if (!has_fourth) v[3] = is_reached ? 1.0 : 0.0;
            put(std::array<float, 4>{static_cast<float>(v[0]), static_cast<float>(v[1]),
                                     static_cast<float>(v[2]), static_cast<float>(v[3])});
            continue;
        }
        std::array<std::uint8_t, 3> bytes{};
        const bool is_finite = std::ranges::all_of(v, [](double n) { return std::isfinite(n); });
        if (is_reached && v.size() == 1) v.resize(3, v[0]);
        for (std::size_t c = 0; c < 3 && c < v.size() && is_finite; ++c)
            bytes[c] = static_cast<std::uint8_t>(
                std::lround(255.0 * (high > low ? (v[c] - low) / (high - low) : 0.5)));
        if (!is_finite) bytes = {255, 0, 255};
        put(bytes);
    }
    write_image(file, image);
}

}  // namespace glint
