// What `study` is asked for.
#pragma once

#include "offline/options.h"

#include <optional>
#include <string>
#include <vector>

namespace glint {

constexpr const char* kBest = "best";  // the name of what is found, where nobody gives one

struct StudyOptions {
    std::vector<std::filesystem::path> files{};
    ViewOptions view{};  // but for its file
    // "NAME=a,b,c", or "NAME" with its own values; empty: every quality tweak, and settle
    std::vector<std::string> vary{};
    std::vector<std::string> reference{};  // "NAME=VALUE"; the tweak's own reference otherwise
    std::vector<std::string> second{};     // "NAME=VALUE"; a reference to judge the reference by
    bool each = false;                     // two files, too, are studied and not compared
    std::string pass = "image";            // what is compared; a buffer has no display curve
    bool time_only = false;                // cost over size: no reference, no errors
    int frames = 15;                       // timed frames a row, at least
    double seconds = 30.0;                 // of timing a knob, after which no verdict is waited for
    // Milliseconds of a frame, or an error, within which the best joint setting of all quality
    // tweaks is sought: a number, or "own". One of them at most.
    std::optional<std::string> ms_budget{}, rmse_budget{}, flip_budget{};
    std::string over{};        // "presets", or "time=A:B:STEP"; "": the view alone
    std::string name = kBest;  // of what is found, in a preset
    std::filesystem::path
        output{};  // a preset (.toml) for what is found; else a folder for the report; empty: none
    bool csv = false;    // on stdout, instead of tables
    bool lines = false;  // of JSON on stdout, as pictures are drawn
};

}  // namespace glint
