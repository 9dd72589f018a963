// A study of the open scene beside its window: run by another process, followed here.
#pragma once

#include "base/scratch_folder.h"
#include "measure/rows/study.h"
#include "scene/preset.h"
#include "window/live/verb_work.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace glint {

class LiveStudy {
public:
    // Pictures lie in a folder below `folder` as long as this lives.
    LiveStudy(const std::filesystem::path& folder, const VerbOptions& options)
        : folder_(folder), options_(options) {}

    // Studies one knob, "" for all, of the preset as it stands here, saved or not. What was found
    // before is forgotten. Throws std::runtime_error.
    void start(const Preset& preset, const std::string& knob);

    void cancel() { work_.cancel(); }  // what was found stays
    void clear();                      // and is forgotten

    // Follows the process; does not wait. True when something is new.
    bool update();

    const VerbProcess& process() const { return work_.process(); }
    const WorkFact& work() const { return work_.fact(); }
    std::span<const Study> studies() const { return studies_; }

    // Of a row: its picture, how far that is from the reference, and the reference. Empty where
    // there is none.
    struct Pictures {
        std::filesystem::path row, map, reference;
    };
    Pictures pictures(std::size_t study, std::size_t row) const;

private:
    void hear(const nlohmann::ordered_json& line);

    std::filesystem::path run_folder() const { return folder_.path() / std::to_string(runs_); }

    ScratchFolder folder_;  // goes after the process, which may be writing
    VerbOptions options_;
    VerbWork work_;
    int runs_ = 0;
    std::vector<Study> studies_;
};

}  // namespace glint
