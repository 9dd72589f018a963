#include "measure/rows/case.h"

#include "base/names.h"
#include "measure/rows/number_json.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace glint {
namespace {

constexpr Names<CaseVerdict, 4> kCaseVerdicts = {{{CaseVerdict::fail, "fail"},
                                                  {CaseVerdict::report, "report"},
                                                  {CaseVerdict::pass, "pass"},
                                                  {CaseVerdict::skip, "skip"}}};

nlohmann::ordered_json to_json(const CasePlace& place) {
    nlohmann::ordered_json operands = nlohmann::ordered_json::array();
    for (const double operand : place.operands) operands.push_back(number_json(operand));
    return {{"file", place.file},         {"line", place.line},
            {"function", place.function}, {"expression", place.expression},
            {"what", place.what},         {"operands", std::move(operands)}};
}

CasePlace place_from(const nlohmann::ordered_json& json) {
    CasePlace place{.file = json.at("file"),
                    .line = json.at("line"),
                    .function = json.at("function"),
                    .expression = json.at("expression"),
                    .what = json.at("what")};
    for (const auto& operand : json.at("operands")) place.operands.push_back(number_from(operand));
    return place;
}

}  // namespace

const char* to_string(CaseVerdict verdict) {
    return kCaseVerdicts.of(verdict);
}

void CaseResult::fail(std::string why) {
    verdict = CaseVerdict::fail;
    note = std::move(why);
}

bool is_worse(const CaseResult& a, const CaseResult& b) {
    return a.verdict != b.verdict ? a.verdict < b.verdict : a.not_finite() > b.not_finite();
}

nlohmann::ordered_json to_json(const CaseResult& result) {
    nlohmann::ordered_json json = {{"case", result.name}, {"verdict", to_string(result.verdict)},
                                   {"nan", result.nan},   {"inf", result.infinite},
                                   {"min", result.min},   {"max", result.max},
                                   {"note", result.note}};
    if (!result.reproduce.empty()) json["reproduce"] = result.reproduce;
    if (!result.picture.empty()) json["picture"] = result.picture;
    if (result.where) json["where"] = to_json(*result.where);
    if (!result.diagram.empty()) json["diagram"] = result.diagram;
    for (const InvariantCurve& curve : result.curves) json["curves"].push_back(to_json(curve));
    return json;
}

CaseResult case_from_json(const nlohmann::ordered_json& json) {
    CaseResult result{.name = json.at("case"),
                      .nan = json.at("nan"),
                      .infinite = json.at("inf"),
                      .min = json.at("min"),
                      .max = json.at("max"),
                      .note = json.at("note"),
                      .reproduce = json.value("reproduce", ""),
                      .picture = json.value("picture", ""),
                      .diagram = json.value("diagram", "")};
    const auto verdict = kCaseVerdicts.find(json.at("verdict").get<std::string>());
    result.verdict = verdict.value_or(result.verdict);
    if (json.contains("where")) result.where = place_from(json.at("where"));
    for (const auto& curve : json.value("curves", nlohmann::ordered_json::array()))
        result.curves.push_back(curve_from_json(curve));
    return result;
}

}  // namespace glint
