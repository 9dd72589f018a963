#include "measure/rows/case.h"

#include "base/names.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace glint {
namespace {

constexpr Names<CaseVerdict, 4> kCaseVerdicts = {{{CaseVerdict::fail, "fail"},
                                                  {CaseVerdict::report, "report"},
                                                  {CaseVerdict::pass, "pass"},
                                                  {CaseVerdict::skip, "skip"}}};

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
                      .picture = json.value("picture", "")};
    const auto verdict = kCaseVerdicts.find(json.at("verdict").get<std::string>());
    result.verdict = verdict.value_or(result.verdict);
    return result;
}

}  // namespace glint
