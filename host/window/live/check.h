// A check of the open scene beside its window: run by another process, followed here.
#pragma once

#include "measure/rows/case.h"
#include "scene/preset.h"
#include "window/live/verb_work.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace glint {

class LiveCheck {
public:
    // Pictures of failures are kept below `folder` until the same file is checked again, so that
    // the commands that go with them still work after the window is closed.
    LiveCheck(std::filesystem::path folder, const VerbOptions& options)
        : folder_(std::move(folder)), options_(options) {}

    // Checks the preset's file with the tweaks that it has here, saved or not. What was found
    // before is forgotten. Throws std::runtime_error.
    void start(const Preset& preset);

    void cancel() { work_.cancel(); }  // what was found stays
    void clear();                      // and is forgotten

    // Follows the process; does not wait. True when something is new.
    bool update();

    const VerbProcess& process() const { return work_.process(); }
    const WorkFact& work() const { return work_.fact(); }
    std::span<const CaseResult> cases() const { return cases_; }  // worst first

    // Of a case that failed; empty for any other.
    std::filesystem::path picture(const std::string& name) const;

private:
    void hear(const nlohmann::ordered_json& line);

    std::filesystem::path folder_;
    VerbOptions options_;
    VerbWork work_;
    std::vector<CaseResult> cases_;
};

}  // namespace glint
