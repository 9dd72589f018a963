// What the verbs of this room are asked for, as the command line fills it in; what makes no sense
// is a UsageError of the verb.
#pragma once

#include "media/image.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// What every verb that opens a scene is asked.
struct ViewOptions {
    std::filesystem::path file;
    std::string size;                 // "1280x720"; empty: the preset's
    std::string quality;              // a name of [quality.NAME] in the preset; "": none
    std::vector<std::string> tweaks;  // "name=value"; over the quality
    std::string device;               // as for make_egl_context
    bool specialise = true;           // tweaks written in as constants
    bool json = false;                // results as one object on stdout
};

// "--quality", "high", "--tweak", "a=1": what turns tweaks, as the command line has it.
std::vector<std::string> tweak_words(const ViewOptions& view);

// What `still` and `sequence` are asked to do with states. Names may hold a frame's number: %06d.
struct StateOptions {
    std::string from;    // a file, or a numbered name: the newest of them that is of use
    std::string save;    // "": none
    int save_every = 0;  // frames; 0: once, before the last
};

// What a still and the pictures of a sequence are asked alike.
struct PictureOptions {
    ViewOptions view;
    double fps = 60.0;     // Hz; frame k stands at k / fps, and simulations are played so
    int samples = 1;       // sub-pixel positions averaged in linear light
    double shutter = 0.0;  // degrees that it stays open, 360 a frame; over the samples
    FileFormat format{};
    StateOptions state{};
};

struct StillOptions : PictureOptions {
    std::filesystem::path output;
    std::optional<double> time{};  // s; the preset's otherwise
    std::optional<int> frame{};    // instead of a time, at `fps`
    std::optional<int> settle{};   // frames drawn with time held; the preset's otherwise
    std::string pass = "image";
    bool unasked = false;  // nobody named the output; its file says so
    int tile = 0;  // pixels: the longest side of the tiles in which to draw; 0: as suits the size
};

struct SequenceOptions : PictureOptions {
    // "out.%04d.png", "out.mp4", or "-" for raw RGB on stdout; empty: only walk the simulation and
    // save its states
    std::string output;
    std::string frames;   // "A:B" or "A:B:STEP", both ends included; empty: the first ten seconds
    std::string shard;    // "K/N": only the K-th of N shares, K from 1; empty: all
    bool resume = false;  // leave pictures alone that are there and are what would be written
    // "frames/%06d.png": check that these are the pictures of this sequence, and make the film of
    // them instead of drawing; without `output` only check
    std::string from_pictures;
};

struct SoundOptions {
    ViewOptions view;
    std::filesystem::path output;
    double seconds = 180.0;  // the site's length
};

struct ExportOptions {
    ViewOptions view;
    std::filesystem::path output;  // a folder, made where it is missing; or a page, NAME.html
    bool controls = true;          // of a page
};

struct ImportOptions {
    std::filesystem::path input;   // a .json file of the site, or a folder of tabs
    std::filesystem::path output;  // a .frag file; of several shaders, the first one's
    bool anywhere = false;         // the shader may name files outside its folder
};

}  // namespace glint
