// What `probe` is asked for.
#pragma once

#include "offline/options.h"

namespace glint {

struct ProbeOptions {
    ViewOptions view;
    std::string pass = "image";
    std::string at{};              // "X,Y" as fragCoord counts; empty: the middle
    std::optional<double> time{};  // s; the preset's otherwise
    std::optional<int> frame{};    // instead of a time, at `fps`
    std::optional<int> settle{};   // as for a still
    double fps = 60.0;             // Hz
    int face = 0;                  // of a cube
    std::string line{};            // "412" or "shared.glsl:12"; empty: all
    std::optional<int> hit{};      // of the line's values, from 1
    std::string expression{};      // "dot(nor, rd)@412"
    std::string along{};           // "x", "y" or "time"
    std::string frames{};          // of --along time: "A:B:STEP"
    std::filesystem::path map{};   // a picture of the value, or of the cost, at every pixel
    bool cost = false;             // counts instead of values
    bool faults = false;           // the first fault instead of values
};

// What is looked at, s; `own`: the preset's time.
inline double time_of(const ProbeOptions& options, double own) {
    return options.frame ? *options.frame / options.fps : options.time.value_or(own);
}

}  // namespace glint
