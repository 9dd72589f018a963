// The two ways in which the program speaks: messages on stderr, results on stdout.
#pragma once

#include "base/words.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <utility>

namespace glint {

// A message. Throws nothing for a stderr that is closed, full or gone: nobody can be told of it,
// and nothing else is to be lost with it.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
    const std::string text = fmt::format(format, std::forward<Values>(values)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

// Why a result did not reach stdout, as an errno: the first reason that there was; 0: all did.
inline int& result_error() {
    static int error = 0;
    return error;
}

// Sends results that are still on their way.
inline void flush_results() {
    if (std::fflush(stdout) != 0 && result_error() == 0) result_error() = errno;
}

// A result. What stdout refuses stops nobody either: files are still written, and at the end main()
// gives exit code 1 for result_error().
template <class... Values>
void say_result(fmt::format_string<Values...> format, Values&&... values) {
    std::string text = fmt::format(format, std::forward<Values>(values)...);
    static const bool is_terminal = ::isatty(STDOUT_FILENO) != 0;
    if (is_terminal) text = harmless(text, '?', "\n\t\r");
    const bool sent = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!sent && result_error() == 0) result_error() = errno;
}

}  // namespace glint
