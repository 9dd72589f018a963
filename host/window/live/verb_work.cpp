#include "window/live/verb_work.h"

#include "base/words.h"
#include "offline/common.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace glint {

using Json = nlohmann::ordered_json;

void VerbWork::start(std::vector<std::string> words) {
    clear();
    process_.start(std::move(words));
    fact_.running = true;
}

void VerbWork::cancel() {
    process_.end();
    fact_.running = false;
}

void VerbWork::clear() {
    cancel();
    fact_ = {};
}

bool VerbWork::update(const std::function<void(const Json& line)>& hear) {
    if (!fact_.running) return false;
    const std::vector<std::string> lines = process_.lines();
    for (const std::string& line : lines) {
        const Json json = Json::parse(line, nullptr, false);
        if (!json.is_object()) continue;
        fact_.done = json.at("done");
        fact_.of = json.at("of");
        hear(json);
    }
    if (process_.runs()) return !lines.empty();
    fact_.running = false;
    const auto code = static_cast<ExitCode>(process_.exit_code());
    if (code == ExitCode::done || code == ExitCode::check_failed) return true;
    fact_.problem = process_.complaint();
    explain("It was ended from outside.");
    return true;
}

void VerbWork::rename(const std::string& from, const std::string& to) {
    replace_all(fact_.problem, from, to);
}

void VerbWork::explain(const std::string& problem) {
    if (fact_.problem.empty()) fact_.problem = problem;
}

}  // namespace glint
