// `glint study`: the error of a scene's pictures against the time that they take.
#pragma once

#include "offline/common.h"

#include <filesystem>
#include <string>
#include <vector>

namespace glint {

struct StudyOptions {
    std::vector<std::filesystem::path> files;
    ViewOptions view;  // but for its file
    // "NAME=a,b,c", or "NAME" with its own values; empty: every quality tweak, and settle
    std::vector<std::string> vary;
    std::vector<std::string> reference;  // "NAME=VALUE"; the tweak's own reference otherwise
    std::vector<std::string> second;     // "NAME=VALUE"; a reference to judge the reference by
    std::string pass = "image";          // what is compared; a buffer has no display curve
    bool time_only = false;              // cost over size: no reference, no errors
    int frames = 15;                     // timed frames a row
    std::filesystem::path output;        // a folder for the report; empty: none
    bool csv = false;                    // on stdout, instead of tables
    bool lines = false;                  // of JSON on stdout, as pictures are drawn
};

// With an output folder it can be stopped at any time; the same call goes on from what is done.
// Throws Stop with the code of the first file that could not be studied, after all others.
void run_study(const StudyOptions& options);

}  // namespace glint
