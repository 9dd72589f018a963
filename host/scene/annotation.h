// What the `//@` comment on a uniform's line says: `0.6 [0, 1] log unit=1/m "steepness"`.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// Something wrong in an annotation, at a byte of it.
struct Complaint {
    std::size_t at = 0;
    std::string text;
    Severity severity = Severity::error;  // a warning of a word that a later version may know
};

// A tweak that has its name and type already gets everything else. It is only good when there was
// nothing to complain about but by warnings.
Tweak parse_tweak(Tweak tweak, std::string_view annotation, std::vector<Complaint>& complaints);

// An option of a pass, and where it was written.
template <typename T>
struct Option {
    T value;
    std::size_t at = 0;
};

// What a sampler's line says. The sampler's pass, and the place of its files among the folders, are
// the scene's to find.
struct SamplerAnnotation {
    Sampler sampler;
    std::string target;          // pass: the function's name; buffer: the other sampler's name
    bool reads_another = false;  // written `buffer NAME`
    std::size_t target_at = 0;
    std::optional<Option<glm::ivec2>> size;
    std::optional<Option<double>> scale;
    std::optional<Option<Step>> step;
    std::optional<Option<PixelFormat>> format;
};

// A sampler that has its name and type already. Filter and wrap are the source's defaults unless
// written; `files` are the paths as they were written.
SamplerAnnotation parse_sampler(Sampler sampler, std::string_view annotation,
                                std::vector<Complaint>& complaints);

// The heading in `group Water`, "" to end a group; nothing if the annotation is no heading.
std::optional<std::string> parse_group(std::string_view annotation);

// The single values, which presets write too. Nothing if the text is none of them.
// "1/240", "0.01": exact.
std::optional<Step> parse_step(std::string_view text);
// "rgba 256", "r 64x32", "32x32x32"; the sampler's type says how many lengths may stand there.
// Returns what is wrong, or "".
std::string parse_noise(std::string_view text, Sampler& sampler);

// What is wrong with so many files for a cube, or "".
std::string check_cube_files(std::size_t count);

// Whether `vflip` or `plays` means anything to it; what else there is does to all.
bool takes_option(Source source, std::string_view option);

// What a sampler of this source and type does unless told otherwise.
void set_defaults(Sampler& sampler, Source source);

}  // namespace glint
