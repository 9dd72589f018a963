#include "measure/study/gnuplot.h"

#include "base/launch.h"
#include "base/words.h"

#include <unistd.h>

#include <cstdio>

namespace glint {

std::string gnuplot_word(const std::string& word) {
    std::string line = word;  // gnuplot takes what follows a line's end for a command
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
    return quoted(line, '\'', "''");
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
