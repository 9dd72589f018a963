// Reading scene texts: includes, and the map back to the files.
#include "glsl/source_text.h"

#include "base/words.h"
#include "glsl/condition.h"
#include "glsl/foreign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
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

// What texts for WebGL 1 require by #extension, and GLSL ES 3.00 has without.
constexpr auto kExtensionsWithin = std::to_array<std::string_view>(
    {"GL_OES_standard_derivatives", "GL_EXT_shader_texture_lod", "GL_EXT_frag_depth"});

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

int column_of(std::string_view text, std::size_t line_begin, std::size_t offset) {
    // Counting characters from the start of a very long line for each complaint would be quadratic.
    constexpr std::size_t kLongLine = 4096;
    const std::size_t bytes = offset - line_begin;
    const auto column =
        bytes > kLongLine ? static_cast<std::ptrdiff_t>(bytes)
                          : std::ranges::count_if(text.substr(line_begin, bytes), begins_character);
    return static_cast<int>(column) + 1;
}

class Reader {
public:
    Reader(const Known& known, Diagnostics& diagnostics)
        : known_(known), diagnostics_(diagnostics), macros_(known, spellings_) {}

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
        ScannedText scanned;
        std::size_t done = 0;  // bytes that are appended already
        std::size_t line = 0;  // the number of lines among them
    };

    File* open(const fs::path& path, const std::optional<Place>& named_at);
    File& file_of(const fs::path& path, std::string_view raw);
    void tell_version(File& file);
    void append(File& file, const Place& named_at);
    void obey(File& file, const DirectiveLine& directive);
    void include(File& file, const DirectiveLine& directive);
    void append_up_to(File& file, std::size_t end);
    void append_line(const File& file, std::string_view text);
    void append_blanked(File& file, const DirectiveLine& directive);
    bool is_there(const fs::path& id) const;
    bool may_include(const fs::path& path, const Place& place);
    Place place_in(const File& file, std::size_t offset) const;
    void error(Place place, std::string text) {
        diagnostics_.push_back({Severity::error, std::move(place), std::move(text)});
    }

    const Known& known_;
    Diagnostics& diagnostics_;
    SourceText source_;
    std::deque<std::string> spellings_;
    Macros macros_;
    Conditions conditions_;
    std::deque<File> files_;  // all that were read, as macros have their words from there
    std::vector<std::pair<fs::path, std::string>> chain_;  // identity and name of the open files
    // Files that say #pragma once, and within which branches: those of another tab read it anew.
    std::multimap<fs::path, std::vector<std::uint32_t>> once_;
    std::string version_;  // what #version names; "" where none
    int includes_ = 0;
};

Reader::File* Reader::open(const fs::path& path, const std::optional<Place>& named_at) {
    if (std::ranges::find(source_.files, path) == source_.files.end())
        source_.files.push_back(path);
    std::string why_not;
    const auto raw = read_bytes(path, why_not);
    if (!raw) {
        diagnostics_.push_back(
            {Severity::error, named_at.value_or(Place{path.string()}),
             fmt::format("cannot read {}: {}", in_quotes(path.string()), why_not), true});
        return nullptr;
    }
    return &file_of(path, *raw);
}

// Of a file that stands in source_.files.
Reader::File& Reader::file_of(const fs::path& path, std::string_view raw) {
    File& file = files_.emplace_back();
    const auto known = std::ranges::find(source_.files, path);
    file.index = static_cast<std::size_t>(known - source_.files.begin());
    file.identity = identity(path);
    CleanText cleaned = clean_text(raw);
    if (cleaned.nul_line > 0) {
        error({path.string(), cleaned.nul_line, cleaned.nul_column},
              "a NUL byte stands here: this is no text, or not UTF-8; save it as UTF-8");
    }
    file.text = std::move(cleaned.text);
    file.scanned = scan(file.text, spellings_);
    if (is_foreign(file.scanned)) {
        ForeignText ours = rewrite_foreign(path, file.text, known_, chain_.empty(), diagnostics_);
        file.text = std::move(ours.text);
        file.lines = std::move(ours.lines);
        file.scanned = scan(file.text, spellings_);
    }
    tell_version(file);
    return file;
}

// The driver is given a version of its own: for __VERSION__ stands the number that the text names,
// as wide, so that columns stay.
void Reader::tell_version(File& file) {
    constexpr std::string_view kName = "__VERSION__";
    const auto& tokens = file.scanned.tokens;
    for (const DirectiveLine& directive : file.scanned.directives)
        if (const TokenRange line = directive.tokens;
            line.size() > 2 && tokens[line.begin + 1].is("version"))
            version_ = tokens[line.begin + 2].text;
    if (version_.empty() || version_.size() > kName.size()) return;
    bool is_told = false;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto is_before = [&](std::size_t back, std::string_view word) {
            return i >= back && tokens[i - back].is(word);
        };
        if (!tokens[i].is(kName) || is_before(1, "ifdef") || is_before(1, "ifndef") ||
            is_before(1, "defined") || (is_before(1, "(") && is_before(2, "defined")))
            continue;
        std::string number = version_;
        number.resize(kName.size(), ' ');
        file.text.replace(tokens[i].begin, kName.size(), number);
        is_told = true;
    }
    if (is_told) file.scanned = scan(file.text, spellings_);
}

void Reader::read(const fs::path& path, const std::optional<Place>& named_at) {
    if (File* file = open(path, named_at)) append(*file, named_at.value_or(Place{path.string()}));
}

void Reader::take_text(const fs::path& path, const fs::path& made_from, std::string_view raw) {
    source_.files = {made_from, path};
    append(file_of(path, raw), {path.string()});
}

void Reader::append(File& file, const Place& named_at) {
    if (file.text.size() + source_.text.size() > kLargestText)
        return error(named_at, "the text with its includes is larger than 64 MiB; include less");
    chain_.emplace_back(file.identity, source_.files[file.index].string());
    for (const DirectiveLine& directive : file.scanned.directives) obey(file, directive);
    append_up_to(file, file.text.size());
    if (file.scanned.unclosed)
        error(place_in(file, *file.scanned.unclosed),
              "this comment is never closed; end it with */");
    chain_.pop_back();
}

// What a driver would obey is left to it, but for what counts lines or names files.
void Reader::obey(File& file, const DirectiveLine& directive) {
    const auto& tokens = file.scanned.tokens;
    const TokenRange line = directive.tokens;
    if (conditions_.take(macros_, tokens, line) || conditions_.live() == Live::no) return;
    const std::string_view word = line.size() > 1 ? tokens[line.begin + 1].text : "";
    const std::string_view what = line.size() > 2 ? tokens[line.begin + 2].text : "";
    if (word == "define") macros_.define(tokens, line, directive.span);
    if (word == "undef") macros_.undefine(what);
    if (word == "pragma" && what == "once" && line.size() == 3)
        once_.emplace(file.identity, conditions_.open_branches());
    if (word == "include")
        include(file, directive);
    else if (word == "version" || word == "line" || word == "pragma" || word == "extension")
        append_blanked(file, directive);
    const std::string_view how = line.size() > 4 ? tokens[line.begin + 4].text : "";
    if (word == "extension" && how == "require" && conditions_.live() == Live::yes &&
        std::ranges::find(kExtensionsWithin, what) == kExtensionsWithin.end())
        error(place_in(file, directive.span.begin),
              fmt::format("{} is not here: texts are GLSL ES 3.00, without extensions; leave the "
                          "line out, or write enable where the text does without it",
                          what));
}

Place Reader::place_in(const File& file, std::size_t offset) const {
    const std::string_view before = std::string_view(file.text).substr(0, offset);
    const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n'));
    return {source_.files[file.index].string(),
            file.lines.empty() ? static_cast<int>(line) + 1 : file.lines[line],
            column_of(file.text, before.rfind('\n') + 1, offset)};
}

// The file's text stands between what is before the #include (the end of a comment) and what is
// after it (the start of one), each on a line of its own at its own columns.
void Reader::include(File& file, const DirectiveLine& directive) {
    const auto& tokens = file.scanned.tokens;
    const Place place = place_in(file, directive.span.begin);
    const std::uint32_t at = directive.tokens.begin + 2;
    if (at >= directive.tokens.end || tokens[at].kind != TokenKind::quoted ||
        tokens[at].text.size() < 3) {
        error(place, "the file's name is missing; write #include \"file.glsl\"");
        return append_blanked(file, directive);
    }
    if (at + 1 < directive.tokens.end)
        error(place, fmt::format("{} after the file's name; put it on the next line",
                                 in_quotes(tokens[at + 1].text)));
    const std::size_t line = file.text.rfind('\n', directive.span.begin) + 1;
    const std::string_view before =
        std::string_view(file.text).substr(line, directive.span.begin - line);
    append_up_to(file, line);
    if (!trimmed(before).empty()) append_line(file, before);

    const std::string_view name = tokens[at].text.substr(1, tokens[at].text.size() - 2);
    const fs::path path = tidied(source_.files[file.index].parent_path() / name);
    if (may_include(path, place)) read(path, place);
    const std::size_t end = file.text.find('\n', tokens[at].end);
    const std::size_t last_line = file.text.rfind('\n', tokens[at].end - 1) + 1;
    append_line(file, std::string(tokens[at].end - last_line, ' ') +
                          file.text.substr(tokens[at].end, end - tokens[at].end));
    const auto begin = file.text.begin();
    file.line += static_cast<std::size_t>(
        std::count(begin + static_cast<long>(line), begin + static_cast<long>(end) + 1, '\n'));
    file.done = end + 1;
}

// Of a file that says #pragma once.
bool Reader::is_there(const fs::path& id) const {
    const std::vector<std::uint32_t> around = conditions_.open_branches();
    const auto [begin, end] = once_.equal_range(id);
    return std::any_of(begin, end, [&](const auto& once) {
        const auto& within = once.second;
        return within.size() <= around.size() &&
               std::equal(within.begin(), within.end(), around.begin());
    });
}

bool Reader::may_include(const fs::path& path, const Place& place) {
    const fs::path id = identity(path);
    if (is_there(id)) return false;
    const auto open = std::ranges::find(chain_, id, &decltype(chain_)::value_type::first);
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

// Appends whole lines.
void Reader::append_up_to(File& file, std::size_t end) {
    while (file.done < end) {
        const std::size_t line_end = file.text.find('\n', file.done);
        append_line(file, std::string_view(file.text).substr(file.done, line_end - file.done));
        file.done = line_end + 1;
        ++file.line;
    }
}

void Reader::append_line(const File& file, std::string_view text) {
    source_.line_begins.push_back(source_.text.size());
    const int number = file.lines.empty() ? static_cast<int>(file.line) + 1 : file.lines[file.line];
    source_.origins.push_back({file.index, number});
    source_.text += text;
    source_.text += '\n';
}

// Appends the lines of a directive, and takes its words out.
void Reader::append_blanked(File& file, const DirectiveLine& directive) {
    append_up_to(file, directive.span.end);
    const std::size_t moved = source_.text.size() - file.done;  // may wrap around, and back
    for (std::uint32_t at = directive.tokens.begin; at < directive.tokens.end; ++at) {
        const Token& token = file.scanned.tokens[at];
        for (std::size_t i = token.begin; i < token.end; ++i) {
            char& c = source_.text[i + moved];
            if (c != '\n' && c != '\\') c = ' ';
        }
    }
}

}  // namespace

std::size_t SourceText::line_index(std::size_t offset) const {
    const auto after = std::ranges::upper_bound(line_begins, offset);
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

SourceText read_source(const fs::path& file, const Known& known, Diagnostics& diagnostics) {
    Reader reader(known, diagnostics);
    reader.read(file, std::nullopt);
    return reader.take();
}

SourceText made_source(const fs::path& file, const fs::path& made_from, std::string_view text,
                       const Known& known, Diagnostics& diagnostics) {
    Reader reader(known, diagnostics);
    reader.take_text(file, made_from, text);
    return reader.take();
}

}  // namespace glint
