// How long the reader takes for each text, by the median of 21 readings: glsl_times FILE...
#include "base/readable_file.h"
#include "glsl/reading.h"
#include "glsl/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace {

// Milliseconds of one call.
template <class Work>
double median_ms(Work work) {
    std::vector<double> times;
    for (int i = 0; i < 21; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                .count());
    }
    std::ranges::nth_element(times, times.begin() + 10);
    return times[10];
}

}  // namespace

int main(int count, char** files) {
    for (int i = 1; i < count; ++i) {
        glint::Diagnostics diagnostics;
        const glint::Known known = glint::known_of_driver();
        const glint::SourceText source = glint::read_source(files[i], known, diagnostics);
        const auto whole = glint::read_glsl(source.text, known);
        const double all = median_ms([&] { glint::read_glsl(source.text, known); });
        const double tokens = median_ms([&] { glint::preprocess(source.text, known); });
        const double files_read =
            median_ms([&] { glint::read_source(files[i], known, diagnostics); });
        fmt::print(
            "{:7} bytes {:6} tokens {:4} functions {:2} not understood  {:6.3f} ms ({:6.3f} "
            "tokens, {:6.3f} files)  {}\n",
            source.text.size(), whole.tokens.size(), whole.functions.size(),
            whole.not_understood.size(), all, tokens, files_read, files[i]);
    }
}
