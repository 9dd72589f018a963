// What trials said of texts, kept between runs: what passed here before, by the same driver, with
// the same values and at the same size, is drawn without being tried again.
#pragma once

#include "window/live/kept_files.h"
#include "window/trial/trial.h"

#include <optional>
#include <string>

namespace glint {

class KeptVerdicts {
public:
    // One small file a candidate. An empty folder keeps none. `driver` names it and its version.
    KeptVerdicts(std::filesystem::path folder, std::string driver)
        : files_(std::move(folder), 1u << 20), driver_(std::move(driver)) {}

    // What was kept of this candidate. It is gone then until it is kept again: a run that comes to
    // a bad end leaves the next one to try.
    std::optional<Verdict> take(const Candidate& candidate);

    // Of the candidate that was asked for last, once it has been drawn: beside the thread that
    // draws, once. One that did not pass is not kept.
    void keep(const Verdict& verdict);

private:
    KeptFiles files_;
    std::string driver_;
    std::string name_;  // in the folder; empty: nothing is to be kept
};

}  // namespace glint
