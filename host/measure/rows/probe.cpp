#include "measure/rows/probe.h"

#include "measure/rows/number_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <string_view>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

bool is_whole(std::string_view type) {  // and bools, 0 or 1
    return type.starts_with('i') || type.starts_with('u') || type.starts_with('b');
}

// Whole numbers have all their digits, up to nine.
std::string shown_float(double number) {
    if (std::isnan(number)) return "nan";
    const bool is_short = std::abs(number) < 1e9 && number == std::trunc(number);
    return is_short ? fmt::format("{:.0f}", number) : fmt::format("{:.7g}", number);
}

// Of whole numbers all digits, which a float has not.
Json numbers(const std::vector<double>& values, std::string_view type = "float") {
    Json list = Json::array();
    for (const double value : values) {
        if (is_whole(type) && std::isfinite(value))
            list.push_back(static_cast<std::int64_t>(value));
        else
            list.push_back(number_json(value));
    }
    return list;
}

Json pair(glm::ivec2 v) {
    return {v.x, v.y};
}

Json to_json(const ProbeValue& value) {
    return {{"file", value.file},
            {"line", value.line},
            {"column", value.column},
            {"function", value.function},
            {"name", value.name},
            {"kind", value.kind},
            {"type", value.type},
            {"hit", value.hit},
            {"hits", value.hits},
            {"order", value.order},
            {"value", numbers(value.value, value.type)}};
}

ProbeValue value_from(const Json& json) {
    ProbeValue value{.file = json.at("file"),
                     .line = json.at("line"),
                     .column = json.at("column"),
                     .function = json.at("function"),
                     .name = json.at("name"),
                     .kind = json.at("kind"),
                     .type = json.at("type"),
                     .hit = json.at("hit"),
                     .hits = json.at("hits"),
                     .order = json.at("order")};
    for (const Json& one : json.at("value")) value.value.push_back(number_from(one));
    return value;
}

// null for a component that is nowhere finite.
Json ends(const ProbeSeries& series, const std::vector<double>& side) {
    Json list = numbers(side, series.what.type);
    for (std::size_t c = 0; c < side.size(); ++c)
        if (series.min[c] > series.max[c]) list[c] = nullptr;
    return list;
}

Json to_json(const ProbeSeries& series) {
    const std::string& type = series.what.type;
    Json json = {{"along", series.along},
                 {"name", series.what.name},
                 {"line", series.what.line},
                 {"type", type},
                 {"min", ends(series, series.min)},
                 {"max", ends(series, series.max)},
                 {"nan", series.nan},
                 {"infinite", series.infinite},
                 {"unreached", series.unreached}};
    if (series.along == "map") return json;
    Json rows = Json::array();
    for (std::size_t i = 0; i < series.values.size(); ++i)
        rows.push_back({{"at", series.at[i]}, {"value", numbers(series.values[i], type)}});
    json["rows"] = std::move(rows);
    return json;
}

Json counts(const std::array<double, 3>& three) {
    return {{"loops", three[0]}, {"reads", three[1]}, {"calls", three[2]}};
}

Json to_json(const ProbeCost& cost) {
    Json json = counts(cost.mean);
    json["most"] = counts(cost.most);
    json["lines"] = Json::array();
    for (const ProbeLineCost& line : cost.lines)
        json["lines"].push_back({{"file", line.file},
                                 {"line", line.line},
                                 {"function", line.function},
                                 {"name", line.name},
                                 {"kind", line.kind},
                                 {"a_pixel", line.a_pixel},
                                 {"most", line.most}});
    json["runs"] = Json::array();
    for (const ProbeCost::Run& run : cost.runs) {
        Json row = {{"size", pair(run.size)}, {"time", run.time}, {"ms", run.ms}};
        row.update(counts(run.counts));
        json["runs"].push_back(std::move(row));
    }
    constexpr std::array kNames = {"loops", "reads", "calls"};
    const auto number = [](const std::optional<double>& one) { return one ? Json(*one) : Json(); };
    for (std::size_t i = 0; i < 3; ++i) {
        json["explains"][kNames[i]] = number(cost.explains[i]);
        json["explains_views"][kNames[i]] = number(cost.explains_views[i]);
    }
    return json;
}

std::array<double, 3> counts_from(const Json& json) {
    return {json.at("loops"), json.at("reads"), json.at("calls")};
}

// Without runs.
ProbeCost cost_from(const Json& json) {
    ProbeCost cost{.mean = counts_from(json), .most = counts_from(json.at("most"))};
    for (const Json& line : json.at("lines"))
        cost.lines.push_back({.file = line.at("file"),
                              .line = line.at("line"),
                              .function = line.at("function"),
                              .name = line.at("name"),
                              .kind = line.at("kind"),
                              .a_pixel = line.at("a_pixel"),
                              .most = line.at("most")});
    return cost;
}

Json to_json(const ProbeFault& fault) {
    Json json = {{"file", fault.file},
                 {"line", fault.line},
                 {"column", fault.column},
                 {"function", fault.function},
                 {"expression", fault.expression},
                 {"what", fault.what},
                 {"operands", numbers(fault.operands)},
                 {"pass", fault.pass},
                 {"pixel", pair(fault.pixel)},
                 {"frame", fault.frame},
                 {"pixels", fault.pixels},
                 {"is_seen", fault.is_seen}};
    if (fault.face) json["face"] = *fault.face;
    return json;
}

}  // namespace

Json to_json(const Probing& probing) {
    Json json = {{"scene", probing.scene},     {"renderer", probing.renderer},
                 {"size", pair(probing.size)}, {"pixel", pair(probing.pixel)},
                 {"frame", probing.frame},     {"time", probing.time},
                 {"pass", probing.pass},       {"same", probing.same},
                 {"values", Json::array()}};
    for (const ProbeValue& value : probing.values) json["values"].push_back(to_json(value));
    for (const ProbeSeries& series : probing.series) json["series"].push_back(to_json(series));
    if (probing.cost) json["cost"] = to_json(*probing.cost);
    if (probing.first_bad) json["first_bad"] = to_json(*probing.first_bad);
    json["notes"] = probing.notes;
    return json;
}

Probing probing_from_json(const Json& json) {
    Probing probing{.scene = json.at("scene"),
                    .renderer = json.at("renderer"),
                    .pass = json.at("pass"),
                    .size = {json.at("size")[0], json.at("size")[1]},
                    .pixel = {json.at("pixel")[0], json.at("pixel")[1]},
                    .frame = json.at("frame"),
                    .time = json.at("time"),
                    .same = json.at("same"),
                    .notes = json.at("notes")};
    for (const Json& value : json.at("values")) probing.values.push_back(value_from(value));
    if (json.contains("cost")) probing.cost = cost_from(json.at("cost"));
    return probing;
}

std::string shown_value(const std::vector<double>& value, const std::string& type) {
    if (value.empty()) return "";
    std::string text;
    for (const double number : value) {
        if (!text.empty()) text += ", ";
        if (type.starts_with('b'))
            text += number != 0.0 ? "true" : "false";
        else if (is_whole(type) && std::isfinite(number))
            text += fmt::format("{:.0f}", number);
        else
            text += shown_float(number);
    }
    return value.size() == 1 ? text : "(" + text + ")";
}

std::string sentence_of(const ProbeFault& fault) {
    const std::string function =
        fault.function.starts_with("main") ? "" : fmt::format("in {}, ", fault.function);
    const std::string pass = fault.pass == "image" ? "" : fmt::format("pass {}, ", fault.pass);
    const std::string face = fault.face ? fmt::format("face {}, ", *fault.face) : "";
    return fmt::format("{}:{}: {}: {}, {}{}{}pixel {},{}, frame {}", fault.file, fault.line,
                       fault.expression, fault.what, function, pass, face, fault.pixel.x,
                       fault.pixel.y, fault.frame);
}

}  // namespace glint
