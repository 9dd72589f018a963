// A complaint about what a person wrote: how bad, where in their own text, and what to do.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// A place in a file as an editor shows it: lines and columns count from 1; 0 means the whole file.
struct Place {
    std::string file;
    int line = 0;
    int column = 0;
};

// Where a line of a text that is put together from several files comes from.
struct Origin {
    std::size_t file = 0;  // index into the list of files beside it
    int line = 0;          // from 1
};

enum class Severity { error, warning };

struct Diagnostic {
    Severity severity = Severity::error;
    Place place;
    std::string text;           // what is wrong and what to do
    bool missing_file = false;  // the text is right, but a file that it names cannot be read
};

using Diagnostics = std::vector<Diagnostic>;

// "file:line:col: error: text", the form that editors jump to. A line or column of 0 is left out.
std::string to_string(const Diagnostic& diagnostic);

bool has_errors(std::span<const Diagnostic> diagnostics);

// All passes share one text, so most complaints come once for each of them.
void append_once(Diagnostics& list, const Diagnostics& more);

// What a person wrote, in quotes, fit for a message: cut when long, control characters blanked.
std::string in_quotes(std::string_view words);

// The known word that was probably meant, or "" when none is near.
std::string nearest(std::string_view word, std::span<const std::string> known);

// "; did you mean 'size'?"
std::string did_you_mean(const std::string& meant);

// The same of the nearest word, or "" when no known word is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace glint
