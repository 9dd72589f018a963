#include "scene/probe_note.h"

#include "base/words.h"
#include "scene/scene_text.h"

#include <algorithm>
#include <charconv>

namespace glint {

namespace {

// `shaders/inc/shared.glsl` in `inc/shared.glsl`, and in itself.
bool ends_in(const std::filesystem::path& path, const std::filesystem::path& end) {
    auto part = path.end();
    for (auto wanted = end.end(); wanted != end.begin();)
        if (part == path.begin() || *--part != *--wanted) return false;
    return true;
}

bool is_same(const std::filesystem::path& path, const std::filesystem::path& other) {
    std::error_code error;
    return std::filesystem::equivalent(path, other, error);
}

// `nor, dot(a, b)` is `nor` and `dot(a, b)`.
std::vector<std::string> parts_of(std::string_view list) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t i = 0; i <= list.size(); ++i) {
        const char c = i < list.size() ? list[i] : ',';
        depth += (c == '(' || c == '[') - (c == ')' || c == ']');
        if (c != ',' || (depth > 0 && i < list.size())) continue;
        parts.emplace_back(trimmed(list.substr(begin, i - begin)));
        begin = i + 1;
    }
    return parts;
}

}  // namespace

std::optional<ProbeNote> parse_probe_note(std::string_view annotation) {
    const std::string_view text = trimmed(annotation);
    const std::string_view word = text.substr(0, text.find_first_of(" \t("));
    if (word != "assert" && word != "watch") return std::nullopt;
    ProbeNote note{.is_assertion = word == "assert"};
    std::string_view rest = trimmed(text.substr(word.size()));
    if (const std::size_t quote = rest.find('"'); quote != rest.npos && rest.ends_with('"')) {
        if (quote + 1 < rest.size()) note.why = rest.substr(quote + 1, rest.size() - quote - 2);
        rest = trimmed(rest.substr(0, quote));
    }
    note.expression = rest;
    return note;
}

std::vector<ProbeNote> find_probe_notes(const Scene& scene) {
    std::vector<ProbeNote> notes;
    if (scene.text.find("//@") == scene.text.npos) return notes;
    const Reading reading = read_glsl(scene.text, known_of_scene());
    for (const Span span : find_notes(reading)) {
        auto note = parse_probe_note(
            std::string_view(scene.text).substr(span.begin, span.end - span.begin));
        if (!note) continue;
        const std::size_t before = scene.text.rfind('\n', span.begin);
        const std::size_t behind = scene.text.find('\n', span.begin);
        note->begin = before == scene.text.npos ? 0 : before + 1;
        note->end = behind == scene.text.npos ? scene.text.size() : behind + 1;
        note->place = scene.place_at(span.begin - 3);
        note->is_in_function = std::ranges::any_of(reading.functions, [&](const Function& one) {
            const Span whole = reading.place(one.tokens);
            return note->begin < whole.end && whole.begin < note->end;
        });
        if (note->is_assertion) {
            notes.push_back(std::move(*note));
            continue;
        }
        for (std::string& part : parts_of(note->expression)) {
            notes.push_back(*note);
            notes.back().expression = std::move(part);
        }
    }
    return notes;
}

std::optional<Span> find_line(const Scene& scene, std::string_view name) {
    const std::size_t colon = name.rfind(':');
    const std::string_view digits = colon == name.npos ? name : name.substr(colon + 1);
    const std::string_view file = colon == name.npos ? "" : name.substr(0, colon);
    int number = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (read.ec != std::errc() || read.ptr != digits.data() + digits.size()) return {};
    std::size_t begin = 0;
    for (const Origin& origin : scene.origins) {
        const std::size_t end = std::min(scene.text.find('\n', begin), scene.text.size() - 1) + 1;
        const std::filesystem::path& path = scene.files[origin.file];
        const auto is_file = [&] {
            return file.empty() ? origin.file == 0 : ends_in(path, file) || is_same(path, file);
        };
        if (origin.line == number && is_file()) return Span{begin, end};
        begin = end;
    }
    return {};
}

std::optional<ProbeNote> note_of_watch(const Scene& scene, std::string_view watch) {
    const std::size_t at = watch.rfind('@');
    if (at == watch.npos) return {};
    const std::optional<Span> line = find_line(scene, trimmed(watch.substr(at + 1)));
    if (!line) return {};
    return ProbeNote{.expression = std::string(trimmed(watch.substr(0, at))),
                     .begin = line->begin,
                     .end = line->end,
                     .place = scene.place_at(line->begin)};
}

}  // namespace glint
