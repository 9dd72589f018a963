// NVIDIA's complaints in Mesa's words, which the rest of the room reads, and where on a line they
// stand: NVIDIA tells lines alone.
#pragma once

#include "glsl/token.h"

#include <optional>
#include <span>
#include <string>

namespace glint {

struct NvidiaComplaint {
    std::string words;                 // "": nothing that a person can mend
    std::optional<std::size_t> token;  // that it is about; none where its words name none
};

// Reads "undefined variable "x"" of the tokens [line.begin, line.end) of a text.
NvidiaComplaint read_nvidia(std::string words, std::span<const Token> tokens, TokenRange line);

}  // namespace glint
