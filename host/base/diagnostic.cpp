// Diagnostics as text, and the two small helps that make them readable: quoting and "did you mean".
#include "base/diagnostic.h"

#include "base/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace glint {

namespace {

// Letters to insert, delete, change or swap with the next to turn one word into the other
// (Damerau and Levenshtein; optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> above(b.size() + 1), row(b.size() + 1), below(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        below[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = row[j] + (a[i] == b[j] ? 0 : 1);
            below[j + 1] = std::min({below[j] + 1, row[j + 1] + 1, changed});
            const bool swapped = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
            if (swapped) below[j + 1] = std::min(below[j + 1], above[j - 1] + 1);
        }
        std::swap(above, row);
        std::swap(row, below);
    }
    return row.back();
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
    const Place& place = diagnostic.place;
    std::string where = harmless(place.file, '?');
    if (place.line > 0) where += fmt::format(":{}", place.line);
    if (place.line > 0 && place.column > 0) where += fmt::format(":{}", place.column);
    if (!where.empty()) where += ": ";
    const char* severity = diagnostic.severity == Severity::error ? "error" : "warning";
    return fmt::format("{}{}: {}", where, severity, harmless(diagnostic.text, '?', "\n\t"));
}

bool has_errors(std::span<const Diagnostic> diagnostics) {
    return std::ranges::any_of(diagnostics,
                               [](const Diagnostic& d) { return d.severity == Severity::error; });
}

void append_once(Diagnostics& list, const Diagnostics& more) {
    for (const Diagnostic& diagnostic : more) {
        const std::string text = to_string(diagnostic);
        const bool known =
            std::ranges::any_of(list, [&](const Diagnostic& d) { return to_string(d) == text; });
        if (!known) list.push_back(diagnostic);
    }
}

std::string in_quotes(std::string_view words) {
    constexpr std::size_t kLongest = 60;
    std::string text(words.substr(0, kLongest));
    if (words.size() > kLongest) {
        // Never cut a UTF-8 character in two.
        while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80)
            text.pop_back();
        if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0x80) text.pop_back();
        text += "...";
    }
    return fmt::format("'{}'", harmless(std::move(text), ' '));
}

std::string nearest(std::string_view word, std::span<const std::string> known) {
    constexpr std::size_t kLongestWord = 64;
    constexpr std::size_t kMostWords = 1000;  // beyond that a guess costs more than it helps
    if (word.empty() || word.size() > kLongestWord || known.size() > kMostWords) return {};
    std::size_t best_distance = (word.size() + 2) / 3 + 1;
    std::string best;
    const std::string small = in_small_letters(word);  // a capital is no other letter
    for (const std::string& candidate : known) {
        if (candidate.size() > kLongestWord) continue;
        const std::size_t distance = edit_distance(small, in_small_letters(candidate));
        if (distance >= best_distance) continue;
        best_distance = distance;
        best = candidate;
    }
    return best;
}

std::string did_you_mean(const std::string& meant) {
    return fmt::format("; did you mean {}?", in_quotes(meant));
}

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
    const std::string meant = nearest(word, known);
    return meant.empty() ? std::string() : did_you_mean(meant);
}

}  // namespace glint
