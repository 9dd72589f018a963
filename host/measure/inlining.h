// How large a pass's program is once every call has become a copy of what it calls, which is what
// drivers compile.
#pragma once

#include "glsl/reading.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// Sizes are words of SPIR-V's instructions in functions, without branches that constants switch
// off.
struct InlinedFunction {
    std::string name;
    std::size_t copies = 0;  // in the whole program: call sites, times the copies of who calls
    std::size_t words = 0;   // of one copy, all that it calls included
    // What the program would be smaller by with one call site, such as one in a loop.
    std::size_t saved_by_one_call() const { return (copies - 1) * words; }
};

struct ProgramSize {
    std::size_t words = 0;                   // of each function times its copies
    std::vector<InlinedFunction> functions;  // that are called, the costliest first
};

// Of a module of SPIR-V whose functions do not call themselves.
ProgramSize inlined_size(const std::vector<std::uint32_t>& module);

// About the same of a text as it is written, with the branches that constants switch off: the
// tokens of a function of this name, times copies. Says which of several passes is the largest.
double inlined_tokens(const Reading& reading, std::string_view entry);

// Of the text that the driver sees for a pass. Nothing, and why, where glslangValidator or
// spirv-opt is not installed or does not take the text. May be called on several threads.
std::optional<ProgramSize> program_size(std::string_view text, std::string& why_not);

}  // namespace glint
