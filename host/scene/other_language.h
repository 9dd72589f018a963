// Texts of shading languages that only look like GLSL.
#pragma once

#include "glsl/reading.h"

#include <cstddef>
#include <optional>
#include <string>

namespace glint {

struct OtherLanguage {
    std::size_t at;    // in the text, where a word tells
    std::string text;  // what is wrong, and what to do
};

// By words that no text of GLSL has a use for; nothing where there is none of them.
std::optional<OtherLanguage> other_language(const Reading& reading);

}  // namespace glint
