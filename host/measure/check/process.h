// Runs the cases of one file in processes of their own, so that a shader that hangs, a GPU that is
// reset and a driver that crashes are failed cases, and the rest is still checked. Seconds are
// spread over the cores, an effort is not: what it finds is the same on any machine.
#pragma once

#include "measure/check/case.h"

#include <functional>
#include <string>
#include <vector>

namespace glint {

// What came of a file: its cases in their order; while they run, as they end.
struct CheckedFile {
    std::string scene;  // the file, as it was named
    std::string renderer{};
    ExitCode code = ExitCode::done;  // why it could not be checked at all
    std::vector<CaseResult> cases{};
    double seconds = 0.0;  // that all of it took
};

// What one file is asked.
struct FileCheck {
    ViewOptions view;
    Effort effort;
    std::filesystem::path folder;  // for pictures of failures; made when there is one
    std::string only;              // cases whose name begins so; empty: all
    // Leave out what does not depend on the preset's tweaks: another preset of the scene went
    // before.
    bool scene_is_known = false;
    double hang_seconds = 60.0;  // how long one frame may take
    bool is_told = false;        // what it warns of, by another process
};

// `progress` hears what is known so far, and how many cases there are. Call before this process has
// a GL context: drivers do not survive a fork.
CheckedFile check_file(const FileCheck& wanted,
                       const std::function<void(const CheckedFile& so_far, long total)>& progress);

}  // namespace glint
