// Lines that are instrumented together, so that each step compiles about as soon as the pass.
#pragma once

#include "glsl/probe.h"
#include "glsl/reading.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace glint {

// By function: how often its body stands in this one, once every call has its copy, as drivers
// compile it. Calls go to all overloads that take as many arguments. 0: never.
std::vector<double> copies_in(const Reading& reading, std::string_view entry);

// The lines of these sites, nearest to the middle of what is asked for first: as many in a batch as
// have `most` copies of sites, one at least.
using ProbeBatch = std::vector<Span>;
std::vector<ProbeBatch> batches_of(const Reading& reading, std::string_view text,
                                   const std::vector<ProbeSite>& sites,
                                   const std::vector<double>& copies, Span asked, double most);

}  // namespace glint
