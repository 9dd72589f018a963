// What a study has measured, in its output folder: so that a call that was stopped goes on.
#pragma once

#include "measure/rows/study.h"
#include "measure/study/plan.h"
#include "measure/study/rounds.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// One picture with all that it depends on.
struct StudyKey {
    std::string name;  // for people, part of file names
    std::string text;  // two pictures may differ where this differs
};

// The text, as far as it is the same for all pictures of a preset.
std::string key_of_preset(const Preset& preset, const std::string& renderer,
                          const std::string& pass, bool specialise);
std::string key_of_setting(const Preset& preset, const Setting& setting);

// The folder of one report: data/ has what goes on, pictures/ what people look at. Writing throws
// std::runtime_error; what is written stands whole or not at all.
class StudyStore {
public:
    // Without a folder nothing is kept and nothing is found.
    explicit StudyStore(std::filesystem::path folder);

    // A row that an earlier call has finished, if all of it is whole, its pictures of this size,
    // too. What is damaged is told on stderr, and is to be made anew.
    std::optional<StudyRow> row(const StudyKey& key, glm::ivec2 size) const;
    void keep(const StudyKey& key, const StudyRow& row) const;

    // The times of all rows of a knob, in rounds.
    std::optional<Rounds> rounds(const StudyKey& key) const;
    void keep(const StudyKey& key, const Rounds& rounds) const;

    // RGBA, exact but for alpha. Beside it lies a PNG to look at, whole as well, whose name, seen
    // from the folder, is that of shown_file().
    std::optional<std::vector<float>> picture(const StudyKey& key, glm::ivec2 size) const;
    std::string shown_file(const StudyKey& key) const;
    std::string keep_picture(const StudyKey& key, std::span<const float> rgba,
                             glm::ivec2 size) const;

    // A pass of such a picture, or "" for none, that is to be known wherever the picture is.
    std::optional<std::string> cut_pass(const StudyKey& key) const;
    void keep_cut_pass(const StudyKey& key, const std::string& pass) const;

    // Where the two pictures differ: the largest channel, in light, on a scale of colours from
    // 1/10000 (black) to 1 (white), a decade a step. Not finite: magenta. The file's name.
    std::string keep_map(const StudyKey& key, std::span<const float> picture,
                         std::span<const float> reference, glm::ivec2 size, Values values) const;

    // The same colours for what a person sees of it: flip_map(), from 0 (black) to 1 (white).
    std::string keep_flip_map(const StudyKey& key, std::span<const float> map,
                              glm::ivec2 size) const;

    const std::filesystem::path& folder() const { return folder_; }

private:
    std::string map_file(const StudyKey& key) const;
    std::string flip_file(const StudyKey& key) const;
    std::filesystem::path file(const char* kind, const StudyKey& key, const char* end) const;

    std::filesystem::path folder_;
};

}  // namespace glint
