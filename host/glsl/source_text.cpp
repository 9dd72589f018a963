// Reading scene texts: includes, and the map back to the files.
#include "glsl/source_text.h"

#include "base/words.h"
#include "glsl/foreign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace glint {

namespace {

namespace fs = std::filesystem;

// No scene is near these; includes that double themselves would otherwise fill the memory.
constexpr std::size_t kLargestText = 64u << 20;
constexpr int kMostIncludes = 4096;
constexpr std::size_t kDeepestInclude = 200;

// A line that begins with '#', taken apart.
struct Directive {
    std::size_t hash = 0;   // offset in the line
    std::string_view word;  // "include", "version", …
    std::size_t rest = 0;   // offset in the line of what follows the word
};

std::optional<Directive> parse_directive(std::string_view code) {
    const std::size_t hash = code.find_first_not_of(" \t\v\f");
    if (hash == std::string_view::npos || code[hash] != '#') return std::nullopt;
    const std::size_t word = std::min(code.find_first_not_of(" \t", hash + 1), code.size());
    const std::size_t end =
        std::min(code.find_first_not_of("abcdefghijklmnopqrstuvwxyz", word), code.size());
    return Directive{hash, code.substr(word, end - word), end};
}

// What stands between `#if 0` and its #else or #endif is put aside: nothing in it counts. Other
// conditions are the compiler's; both their sides count. Returns the depth after this line.
int dead_depth(int depth, std::string_view line, const std::optional<Directive>& directive) {
    if (!directive) return depth;
    const std::string_view word = directive->word;
    const bool opens = word == "if" || word == "ifdef" || word == "ifndef";
    if (depth == 0) return word == "if" && trimmed(line.substr(directive->rest)) == "0" ? 1 : 0;
    if (opens) return depth + 1;
    if (word == "endif" || (depth == 1 && (word == "else" || word == "elif"))) return depth - 1;
    return depth;
}

// The name between quotes or angle brackets, as a range of the line.
std::optional<Span> parse_include_name(std::string_view line, std::size_t rest) {
    const std::size_t open = line.find_first_not_of(" \t", rest);
    if (open == std::string_view::npos || (line[open] != '"' && line[open] != '<'))
        return std::nullopt;
    const std::size_t close = line.find(line[open] == '<' ? '>' : '"', open + 1);
    if (close == std::string_view::npos || close == open + 1) return std::nullopt;
    return Span{open + 1, close};
}

// A path without "x/.." in it, where that names the same file.
fs::path tidied(const fs::path& path) {
    std::error_code error;
    const fs::path tidy = path.lexically_normal();
    return fs::equivalent(tidy, path, error) && !error ? tidy : path;
}

fs::path identity(const fs::path& path) {
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(path, error);
    return error ? path : canonical;
}

std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

int column_of(std::string_view text, std::size_t line_begin, std::size_t offset) {
    // Counting characters from the start of a very long line for each complaint would be quadratic.
    constexpr std::size_t kLongLine = 4096;
    const std::size_t bytes = offset - line_begin;
    const std::size_t column =
        bytes > kLongLine ? bytes : characters(text.substr(line_begin, bytes));
    return static_cast<int>(column) + 1;
}

class Reader {
public:
    explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    // Appends a text that would stand in `path`, and is made from another file.
    void take_text(const fs::path& path, const fs::path& made_from, std::string_view raw);

    // Appends a file's text. `named_at` is the place of the #include, or nothing for the scene.
    void read(const fs::path& path, const std::optional<Place>& named_at);

    SourceText take() { return std::move(source_); }

private:
    struct File {
        std::size_t index = 0;  // into source_.files
        fs::path identity;
        std::string text;
        std::vector<int> lines;  // of rewritten text: which line of the file each stands for
        Comments comments;
        std::size_t next_note = 0;
        int dead_depth = 0;  // how many #if are open, from an `#if 0` on
    };

    std::optional<File> open(const fs::path& path, const std::optional<Place>& named_at);
    File file_of(const fs::path& path, std::string_view raw);
    void append(File file, const Place& named_at);
    void append_lines(File& file);
    void include(File& file, Span line, int number, const Directive& directive);
    void emit(File& file, Span line, int number, Span blanked);
    bool may_include(const fs::path& path, const Place& place);
    void error(Place place, std::string text) {
        diagnostics_.push_back({Severity::error, std::move(place), std::move(text)});
    }

    Diagnostics& diagnostics_;
    SourceText source_;
    std::vector<std::pair<fs::path, std::string>> chain_;  // identity and name of the open files
    std::set<fs::path> once_;                              // files that say #pragma once
    int includes_ = 0;
};

std::optional<Reader::File> Reader::open(const fs::path& path,
                                         const std::optional<Place>& named_at) {
    if (std::ranges::find(source_.files, path) == source_.files.end())
        source_.files.push_back(path);
    std::string why_not;
    const auto raw = read_bytes(path, why_not);
    if (!raw) {
        diagnostics_.push_back(
            {Severity::error, named_at.value_or(Place{path.string()}),
             fmt::format("cannot read {}: {}", in_quotes(path.string()), why_not), true});
        return std::nullopt;
    }
    return file_of(path, *raw);
}

// Of a file that stands in source_.files.
Reader::File Reader::file_of(const fs::path& path, std::string_view raw) {
    File file;
    const auto known = std::ranges::find(source_.files, path);
    file.index = static_cast<std::size_t>(known - source_.files.begin());
    file.identity = identity(path);
    CleanText cleaned = clean_text(raw);
    if (cleaned.nul_line > 0) {
        error({path.string(), cleaned.nul_line, cleaned.nul_column},
              "a NUL byte stands here: this is no text, or not UTF-8; save it as UTF-8");
    }
    file.text = std::move(cleaned.text);
    if (is_foreign(file.text)) {
        ForeignText ours = rewrite_foreign(path, file.text, chain_.empty(), diagnostics_);
        file.text = std::move(ours.text);
        file.lines = std::move(ours.lines);
    }
    file.comments = find_comments(file.text);
    return file;
}

void Reader::read(const fs::path& path, const std::optional<Place>& named_at) {
    if (auto file = open(path, named_at))
        append(std::move(*file), named_at.value_or(Place{path.string()}));
}

void Reader::append(File file, const Place& named_at) {
    if (file.text.size() + source_.text.size() > kLargestText)
        return error(named_at, "the text with its includes is larger than 64 MiB; include less");
    chain_.emplace_back(file.identity, source_.files[file.index].string());
    append_lines(file);
    chain_.pop_back();
}

void Reader::take_text(const fs::path& path, const fs::path& made_from, std::string_view raw) {
    source_.files = {made_from, path};
    append(file_of(path, raw), {path.string()});
}

void Reader::append_lines(File& file) {
    const std::string_view text = file.text, code = file.comments.code;
    bool joined = false;  // the line before ends with a backslash
    bool blanking = false;
    std::size_t index = 0;
    for (std::size_t begin = 0; begin < text.size(); ++index) {
        const int number = file.lines.empty() ? static_cast<int>(index) + 1 : file.lines[index];
        const std::size_t end = text.find('\n', begin);
        const Span line{begin, end};
        if (file.comments.unclosed && *file.comments.unclosed >= begin &&
            *file.comments.unclosed < end) {
            error({source_.files[file.index].string(), number,
                   column_of(text, begin, *file.comments.unclosed)},
                  "this comment is never closed; end it with */");
        }
        const auto directive =
            joined ? std::nullopt : parse_directive(code.substr(begin, end - begin));
        file.dead_depth = dead_depth(file.dead_depth, code.substr(begin, end - begin), directive);
        if (!joined) {
            const bool once = directive && directive->word == "pragma" &&
                              trimmed(code.substr(begin + directive->rest,
                                                  end - begin - directive->rest)) == "once";
            if (once && file.dead_depth == 0) once_.insert(file.identity);
            blanking =
                once || (directive && (directive->word == "version" || directive->word == "line"));
        }
        if (directive && directive->word == "include" && file.dead_depth == 0)
            include(file, line, number, *directive);
        else
            emit(file, line, number, blanking ? line : Span{begin, begin});
        joined = end > begin && code[end - 1] == '\\';
        begin = end + 1;
    }
}

// The file's text stands between what is before the #include (the end of a comment) and what is
// after it (the start of one), each on a line of its own at its own columns.
void Reader::include(File& file, Span line, int number, const Directive& directive) {
    const std::string_view text =
        std::string_view(file.text).substr(line.begin, line.end - line.begin);
    const fs::path from = source_.files[file.index];
    const Place place{from.string(), number,
                      column_of(file.text, line.begin, line.begin + directive.hash)};
    const auto name = parse_include_name(text, directive.rest);
    if (!name) {
        error(place, "the file's name is missing; write #include \"file.glsl\"");
        return emit(file, line, number, line);
    }
    const std::size_t after = line.begin + name->end + 1;
    const auto rest = trimmed(std::string_view(file.comments.code).substr(after, line.end - after));
    if (!rest.empty())
        error(place,
              fmt::format("{} after the file's name; put it on the next line", in_quotes(rest)));

    const std::size_t hash = line.begin + directive.hash;
    if (!trimmed(text.substr(0, directive.hash)).empty())
        emit(file, {line.begin, hash}, number, {line.begin, line.begin});
    const fs::path path =
        tidied(from.parent_path() / text.substr(name->begin, name->end - name->begin));
    if (may_include(path, place)) read(path, place);
    emit(file, line, number, {line.begin, after});
}

bool Reader::may_include(const fs::path& path, const Place& place) {
    const fs::path id = identity(path);
    if (once_.contains(id)) return false;
    const auto open = std::find_if(chain_.begin(), chain_.end(),
                                   [&id](const auto& entry) { return entry.first == id; });
    if (open != chain_.end()) {
        std::string names;
        for (auto entry = open; entry != chain_.end(); ++entry) names += entry->second + " -> ";
        error(place, fmt::format("this include closes a circle: {}{}; take one of them out", names,
                                 path.string()));
        return false;
    }
    if (++includes_ > kMostIncludes || chain_.size() > kDeepestInclude) {
        if (includes_ <= kMostIncludes + 1)
            error(place, "too many includes; do the files include each other over and over?");
        includes_ = kMostIncludes + 1;
        return false;
    }
    return true;
}

// Appends one line. The code in `blanked` (offsets in the file) becomes spaces.
void Reader::emit(File& file, Span line, int number, Span blanked) {
    SourceText& out = source_;
    const std::size_t begin = out.text.size();
    out.line_begins.push_back(begin);
    out.origins.push_back({file.index, number});
    out.text.append(file.text, line.begin, line.end - line.begin);
    if (file.dead_depth > 0)
        out.code.append(line.end - line.begin, ' ');
    else
        out.code.append(file.comments.code, line.begin, line.end - line.begin);
    for (std::size_t i = blanked.begin; i < blanked.end; ++i) {
        const std::size_t at = begin + i - line.begin;
        if (out.code[at] != ' ') out.text[at] = out.code[at] = ' ';
    }
    out.text += '\n';
    out.code += '\n';
    const auto& notes = file.comments.notes;
    for (; file.next_note < notes.size() && notes[file.next_note].begin <= line.end;
         ++file.next_note) {
        const Span note = notes[file.next_note];
        const std::size_t at = begin + note.begin - line.begin;
        if (file.dead_depth == 0) out.notes.push_back({at, at + note.end - note.begin});
    }
}

}  // namespace

std::size_t SourceText::line_index(std::size_t offset) const {
    const auto after = std::upper_bound(line_begins.begin(), line_begins.end(), offset);
    return static_cast<std::size_t>(after - line_begins.begin()) - 1;
}

const fs::path& SourceText::file(std::size_t offset) const {
    return files[origins[line_index(offset)].file];
}

Place SourceText::place(std::size_t offset) const {
    const std::size_t line = line_index(offset);
    return {files[origins[line].file].string(), origins[line].line,
            column_of(text, line_begins[line], offset)};
}

SourceText read_source(const fs::path& file, Diagnostics& diagnostics) {
    Reader reader(diagnostics);
    reader.read(file, std::nullopt);
    return reader.take();
}

SourceText made_source(const fs::path& file, const fs::path& made_from, std::string_view text,
                       Diagnostics& diagnostics) {
    Reader reader(diagnostics);
    reader.take_text(file, made_from, text);
    return reader.take();
}

}  // namespace glint
