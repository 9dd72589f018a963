// Reading scene texts: odd bytes and line ends, comments, includes.
#include "scene/source_text.h"

#include "scene/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace glint {

namespace {

namespace fs = std::filesystem;

// No scene is near these; includes that double themselves would otherwise fill the memory.
constexpr std::size_t kLargestFile = 64u << 20;
constexpr std::size_t kLargestText = 64u << 20;
constexpr int kMostIncludes = 4096;
constexpr std::size_t kDeepestInclude = 200;

// The length of the valid UTF-8 character at the front, or 0.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool surrogate = lead == 0xED && byte(1) > 0x9F;
    const bool too_far = lead == 0xF4 && byte(1) > 0x8F;
    return overlong || surrogate || too_far ? 0 : length;
}

struct Cleaned {
    std::string text;
    std::optional<Span> nul_line_column;  // of the first NUL byte, counted from 1
};

// Takes off a byte order mark, makes every line end '\n' and every byte printable in a message:
// what is not UTF-8 (an old comment in Latin-1) becomes '?', a byte for a byte.
Cleaned clean(std::string_view raw) {
    if (raw.starts_with("\xEF\xBB\xBF")) raw.remove_prefix(3);
    Cleaned cleaned;
    std::string& text = cleaned.text;
    text.reserve(raw.size() + 1);
    std::size_t line = 1, line_begin = 0;
    for (std::size_t i = 0; i < raw.size();) {
        const char c = raw[i];
        const std::size_t length = utf8_length(raw.substr(i, 4));
        if (c == '\0') {
            if (!cleaned.nul_line_column)
                cleaned.nul_line_column = Span{line, text.size() - line_begin + 1};
            text += ' ';
        } else if (c == '\r' || c == '\n') {
            text += '\n';
            ++line;
            line_begin = text.size();
            if (c == '\r' && i + 1 < raw.size() && raw[i + 1] == '\n') ++i;
        } else if (length == 0) {
            text += '?';
        } else {
            text.append(raw, i, length);
        }
        i += std::max<std::size_t>(length, 1);
    }
    // A backslash at the very end would join the file with what includes it.
    if (!text.empty() && text.back() == '\\') text.back() = ' ';
    if (!text.empty() && text.back() != '\n') text += '\n';
    return cleaned;
}

struct Comments {
    std::string code;  // the text with spaces for comments
    std::vector<Span> notes;
    std::optional<std::size_t> unclosed;  // where a block comment begins that never ends
};

// The end of a `//` comment: the line's end, or a later one's where a backslash joins the lines.
std::size_t line_comment_end(std::string_view text, std::size_t begin) {
    std::size_t end = begin;
    do {
        end = text.find('\n', end + 1);
    } while (end != std::string_view::npos && text[end - 1] == '\\');
    return end == std::string_view::npos ? text.size() : end;
}

Comments find_comments(std::string_view text) {
    Comments comments{std::string(text), {}, {}};
    // The first characters of the line that are neither space nor comment: the name in
    // `#include "a//b"` holds no comment.
    std::string head;
    const std::string_view include = "#include";
    const auto blank = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (text[i] != '\n') comments.code[i] = ' ';
    };
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view here = text.substr(i, 2);
        std::size_t end = i + 1;
        if (here == "//") {
            end = line_comment_end(text, i + 1);
            if (text.substr(i + 2, 1) == "@") comments.notes.push_back({i + 3, end});
            blank(i, end);
        } else if (here == "/*") {
            const std::size_t close = text.find("*/", i + 2);
            if (close == std::string_view::npos) comments.unclosed = i;
            end = close == std::string_view::npos ? text.size() : close + 2;
            blank(i, end);
        } else if (here[0] == '\n') {
            if (i == 0 || text[i - 1] != '\\') head.clear();
        } else if ((here[0] == '"' || here[0] == '<') && head == include) {
            const std::size_t close = text.find_first_of(here[0] == '<' ? ">\n" : "\"\n", i + 1);
            if (close != std::string_view::npos && text[close] != '\n') end = close + 1;
            head += here[0];
        } else if (here[0] != ' ' && here[0] != '\t' && head.size() <= include.size()) {
            head += here[0];
        }
        i = end;
    }
    return comments;
}

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

    // Appends a file's text. `named_at` is the place of the #include, or nothing for the scene.
    void read(const fs::path& path, const std::optional<Place>& named_at);

    SourceText take() { return std::move(source_); }

private:
    struct File {
        std::size_t index = 0;  // into source_.files
        fs::path identity;
        std::string text;
        Comments comments;
        std::size_t next_note = 0;
    };

    std::optional<File> open(const fs::path& path, const std::optional<Place>& named_at);
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
    File file;
    auto& files = source_.files;
    const auto known = std::find(files.begin(), files.end(), path);
    file.index = static_cast<std::size_t>(known - files.begin());
    if (known == files.end()) files.push_back(path);
    file.identity = identity(path);

    std::string why_not;
    const auto raw = read_bytes(path, why_not);
    if (!raw) {
        diagnostics_.push_back(
            {Severity::error, named_at.value_or(Place{path.string()}),
             fmt::format("cannot read {}: {}", in_quotes(path.string()), why_not), true});
        return std::nullopt;
    }
    Cleaned cleaned = clean(*raw);
    if (cleaned.nul_line_column) {
        error({path.string(), static_cast<int>(cleaned.nul_line_column->begin),
               static_cast<int>(cleaned.nul_line_column->end)},
              "a NUL byte stands here: this is no text, or not UTF-8; save it as UTF-8");
    }
    file.text = std::move(cleaned.text);
    file.comments = find_comments(file.text);
    return file;
}

void Reader::read(const fs::path& path, const std::optional<Place>& named_at) {
    auto file = open(path, named_at);
    if (!file) return;
    if (file->text.size() + source_.text.size() > kLargestText) {
        error(named_at.value_or(Place{path.string()}),
              "the text with its includes is larger than 64 MiB; include less");
        return;
    }
    chain_.emplace_back(file->identity, path.string());
    append_lines(*file);
    chain_.pop_back();
}

void Reader::append_lines(File& file) {
    const std::string_view text = file.text, code = file.comments.code;
    bool joined = false;  // the line before ends with a backslash
    bool blanking = false;
    int number = 1;
    for (std::size_t begin = 0; begin < text.size(); ++number) {
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
        if (!joined) {
            const bool once = directive && directive->word == "pragma" &&
                              trimmed(code.substr(begin + directive->rest,
                                                  end - begin - directive->rest)) == "once";
            if (once) once_.insert(file.identity);
            blanking =
                once || (directive && (directive->word == "version" || directive->word == "line"));
        }
        if (directive && directive->word == "include")
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
        out.notes.push_back({at, at + note.end - note.begin});
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

std::optional<std::string> read_bytes(const fs::path& file, std::string& why_not) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
        why_not = "it is a folder";
        return std::nullopt;
    }
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::string bytes;
    std::array<char, 1 << 16> chunk;
    while (stream && bytes.size() <= kLargestFile) {
        stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
        bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.eof()) return bytes;
    why_not = bytes.size() > kLargestFile ? "it is larger than 64 MiB"
              : errno != 0                ? std::generic_category().message(errno)
                                          : "reading failed";
    return std::nullopt;
}

}  // namespace glint
