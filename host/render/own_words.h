// What the text that a driver reads calls by other names than a person wrote.
#pragma once

#include "glsl/preprocess.h"
#include "render/pass_text.h"

#include <string>
#include <vector>

namespace glint {

// A complaint in the words of the scene: `glint_round` is its round, `glFragColor_` gl_FragColor.
std::string in_own_words(const std::string& complaint);

// The tokens that a compiler sees, up to the end of what a person wrote; where a macro of the host
// stands for a word, that word.
std::vector<Token> tokens_as_written(const Preprocessed& read, const PassText& pass);

}  // namespace glint
