#include "measure/study/gnuplot.h"

#include "base/launch.h"
#include "base/words.h"

#include <unistd.h>

#include <cstdio>

namespace glint {

std::string gnuplot_word(const std::string& word) {
    return quoted(word, '\'', "''");
}

std::string gnuplot_svg(const std::string& commands) {
    std::FILE* file = std::tmpfile();
    if (!file) return {};
    std::fputs(commands.c_str(), file);
    std::fflush(file);
    std::string text;
    const Launched gnuplot =
        launch({.words = {"gnuplot", "/dev/stdin"}, .input = ::fileno(file), .output = kPipe});
    if (gnuplot.error == 0) {
        text = read_to_end(gnuplot.pipe);
        wait_for(gnuplot.process);
    }
    std::fclose(file);
    const std::size_t begin = text.find("<svg"), end = text.rfind("</svg>");
    if (begin == std::string::npos || end == std::string::npos) return {};
    return text.substr(begin, end + 6 - begin);
}

}  // namespace glint
