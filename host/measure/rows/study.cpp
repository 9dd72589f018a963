#include "measure/rows/study.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

// Figures of a row's difference, which stand among its own.
constexpr const char* kErrorKeys[] = {"rmse", "max", "psnr", "share_off", "relative_mse", "flip"};

Json or_null(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(*value) : Json();
}

std::optional<double> number(const Json& json) {
    return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

Clock clock_from(const std::string& words) {
    for (const Clock clock : {Clock::wall, Clock::gpu, Clock::processor})
        if (words == to_string(clock)) return clock;
    return Clock::wall;
}

std::optional<TimeVerdict> verdict_from(const Json& word) {
    for (const TimeVerdict verdict :
         {TimeVerdict::faster, TimeVerdict::slower, TimeVerdict::not_told_apart})
        if (word == to_string(verdict)) return verdict;
    return std::nullopt;
}

Json to_json(const StudyRow& row) {
    Json json = {{"value", row.value},
                 {"ms", row.ms.median},
                 {"ms_min", row.ms.min},
                 {"ms_max", row.ms.max},
                 {"ms_low", row.ms.low},
                 {"ms_high", row.ms.high},
                 {"verdict", row.verdict ? Json(to_string(*row.verdict)) : Json()},
                 {"wall_ms", row.wall.median},
                 {"gpu_timer_ms", row.gpu.median},
                 {"processor_ms", row.processor.median},
                 {"all_passes_ms", row.all_passes_ms}};
    const bool compared = row.error && row.failed.empty();
    const Json error = compared ? glint::to_json(*row.error) : Json::object();
    for (const char* key : kErrorKeys) json[key] = compared ? error.at(key) : Json();
    json["nearer"] = row.nearer;
    json["pareto"] = row.pareto;
    json["near_reference"] = row.near_reference;
    json["is_reference"] = row.is_reference;
    json["is_preset"] = row.is_preset;
    json["resumed"] = row.resumed;
    if (row.worst) json["worst"] = {{"view", row.worst->view}, {"rmse", row.worst->rmse}};
    if (!row.failed.empty()) json["failed"] = row.failed;
    if (!row.picture.empty()) json["picture"] = row.picture;
    if (!row.map.empty()) json["map"] = row.map;
    if (!row.flip_map.empty()) json["flip_map"] = row.flip_map;
    return json;
}

StudyRow row_from(const Json& json) {
    const auto timing = [&](const char* key) {
        return Timing{.median = number(json.at(key)).value_or(0.0)};
    };
    StudyRow row{.value = json.at("value"),
                 .wall = timing("wall_ms"),
                 .gpu = timing("gpu_timer_ms"),
                 .processor = timing("processor_ms"),
                 .all_passes_ms = number(json.at("all_passes_ms")).value_or(0.0),
                 .failed = json.value("failed", ""),
                 .is_preset = json.at("is_preset"),
                 .is_reference = json.at("is_reference"),
                 .resumed = json.at("resumed"),
                 .picture = json.value("picture", ""),
                 .map = json.value("map", ""),
                 .flip_map = json.value("flip_map", ""),
                 .ms = timing("ms"),
                 .verdict = verdict_from(json.at("verdict")),
                 .nearer = json.value("nearer", false),
                 .pareto = json.at("pareto"),
                 .near_reference = json.at("near_reference")};
    row.ms.min = timing("ms_min").median;
    row.ms.max = timing("ms_max").median;
    row.ms.low = timing("ms_low").median;
    row.ms.high = timing("ms_high").median;
    if (json.at("rmse").is_number()) row.error = difference_from_json(json);
    if (json.contains("worst"))
        row.worst = {.view = json["worst"].at("view"), .rmse = json["worst"].at("rmse")};
    return row;
}

}  // namespace

const char* to_string(Clock clock) {
    switch (clock) {
        case Clock::wall:
            return "the wall, after glFinish";
        case Clock::gpu:
            return "timer queries, which agree with the wall";
        case Clock::processor:
            return "the processor, all threads: the machine was busy";
    }
    return "";
}

const char* to_string(TimeVerdict verdict) {
    switch (verdict) {
        case TimeVerdict::faster:
            return "faster";
        case TimeVerdict::slower:
            return "slower";
        case TimeVerdict::not_told_apart:
            return "not told apart";
    }
    return "";
}

Json to_json(const Difference& d) {
    return {{"rmse", d.rmse},
            {"max", d.max},
            {"psnr", or_null(d.psnr)},
            {"share_off", d.share_off},
            {"relative_mse", d.relative_mse},
            {"not_finite", d.not_finite},
            {"reference_not_finite", d.reference_not_finite},
            {"flip", d.flip}};
}

Difference difference_from_json(const Json& json) {
    return {.rmse = number(json.at("rmse")).value_or(0.0),
            .max = number(json.at("max")).value_or(0.0),
            .relative_mse = number(json.at("relative_mse")).value_or(0.0),
            .psnr = number(json.at("psnr")).value_or(std::numeric_limits<double>::infinity()),
            .share_off = number(json.at("share_off")).value_or(0.0),
            .not_finite = json.value("not_finite", std::size_t{0}),
            .reference_not_finite = json.value("reference_not_finite", std::size_t{0}),
            .flip = number(json.at("flip")).value_or(0.0)};
}

namespace {

Json rival_json(const RivalReference& rival) {
    Json json = {
        {"value", rival.value}, {"own_error", rival.own_error}, {"disagrees", rival.disagrees}};
    json.update(to_json(rival.difference));
    return json;
}

// "a=1 b=2" as an object.
Json tweaks_json(const std::string& text) {
    Json tweaks = Json::object();
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::size_t equals = text.find('=', at);
        if (equals < end)
            tweaks[text.substr(at, equals - at)] = text.substr(equals + 1, end - equals - 1);
        at = end + 1;
    }
    return tweaks;
}

Json frontier_json(const Study& study) {
    Json frontier = Json::array();
    for (const StudyRow& row : study.rows) {
        if (!row.pareto) continue;
        frontier.push_back({{"tweaks", tweaks_json(row.value)},
                            {"ms", row.ms.median},
                            {"ms_low", row.ms.low},
                            {"ms_high", row.ms.high},
                            {"rmse", row.error ? Json(row.error->rmse) : Json()},
                            {"flip", row.error ? Json(row.error->flip) : Json()}});
    }
    return frontier;
}

Json best_json(const Study& study) {
    if (!study.best) return {};
    const StudyRow& row = study.rows[*study.best];
    return {{"row", *study.best},
            {"tweaks", tweaks_json(row.value)},
            {"ms", row.ms.median},
            {"error", row.error ? Json(row.error->rmse) : Json()},
            {"flip", row.error ? Json(row.error->flip) : Json()}};
}

}  // namespace

Json to_json(const Study& study) {
    Json rows = Json::array();
    for (const StudyRow& row : study.rows) rows.push_back(to_json(row));
    Json json = {
        {"scene", study.scene},
        {"knob", study.knob},
        {"reference", study.reference},
        {"second_reference", study.second},
        {"reference_not_finite", study.reference_not_finite},
        {"reference_cut", study.reference_cut},
        {"reference_error", study.reference_error ? to_json(*study.reference_error) : Json()},
        {"own_error", study.has_own_error() ? Json(study.own_error) : Json()},
        {"rival", study.rival ? rival_json(*study.rival) : Json()},
        {"converges", study.converges},
        {"renderer", study.renderer},
        {"machine", study.machine},
        {"clock", to_string(study.clock)},
        {"size", {study.size.x, study.size.y}},
        {"compared", study.pass},
        {"metric", study.time_only ? "time" : "error"},
        {"order", or_null(study.order)},
        {"cost_exponent", or_null(study.cost_exponent)},
        {"findings", study.findings},
        {"notes", study.notes},
        {"rows", rows}};
    if (!study.views.empty()) json["views"] = study.views;
    if (study.is_joint) {
        json["best"] = best_json(study);
        json["frontier"] = frontier_json(study);
    }
    if (!study.reference_picture.empty()) json["reference_picture"] = study.reference_picture;
    return json;
}

Study study_from_json(const Json& json) {
    Study study{.scene = json.at("scene"),
                .knob = json.at("knob"),
                .reference = json.at("reference"),
                .second = json.at("second_reference"),
                .reference_not_finite = json.value("reference_not_finite", std::size_t{0}),
                .reference_cut = json.value("reference_cut", ""),
                .renderer = json.at("renderer"),
                .machine = json.at("machine"),
                .size = {json.at("size").at(0), json.at("size").at(1)},
                .pass = json.at("compared"),
                .time_only = json.at("metric") == "time",
                .clock = clock_from(json.at("clock")),
                .order = number(json.at("order")),
                .cost_exponent = number(json.at("cost_exponent")),
                .findings = json.at("findings"),
                .notes = json.at("notes"),
                .reference_picture = json.value("reference_picture", "")};
    study.own_error = number(json.at("own_error")).value_or(0.0);
    study.converges = json.at("converges");
    if (const Json& rival = json.at("rival"); rival.is_object()) {
        study.rival = {.value = rival.at("value"),
                       .difference = difference_from_json(rival),
                       .own_error = number(rival.at("own_error")).value_or(0.0),
                       .disagrees = rival.at("disagrees")};
    }
    const Json& error = json.at("reference_error");
    if (error.is_object()) study.reference_error = difference_from_json(error);
    for (const Json& row : json.at("rows")) study.rows.push_back(row_from(row));
    if (json.contains("views")) study.views = json["views"];
    study.is_joint = json.contains("frontier");
    if (study.is_joint && json.at("best").is_object()) study.best = json.at("best").at("row");
    return study;
}

}  // namespace glint
