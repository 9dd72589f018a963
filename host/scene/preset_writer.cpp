// The text is read as the preset that it is now; each difference becomes an edit where it stands.
#include "scene/preset_writer.h"

#include "scene/toml.h"
#include "scene/toml_keys.h"
#include "scene/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace glint {

namespace {

namespace fs = std::filesystem;

constexpr const char* kBareKey = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

// Bytes [begin, end) of the text become others.
struct Edit {
    std::size_t begin = 0, end = 0;
    std::string text;
};

// How a table is written, which decides how a key is added to it.
enum class Form {
    missing,  // or only implied by [tweaks.something]
    header,   // [tweaks]
    dotted,   // tweaks.name = 1
    braces,   // tweaks = { name = 1 }
    no_table,
};

// Headers, and the tables below them, begin at the bracket before their name.
bool is_header(const toml::key& key, const toml::node& node) {
    return node.source().begin < key.source().begin;
}

// Where the last value of a node ends; tables with a header of their own are not part of theirs.
toml::source_position last_end(const toml::node& node) {
    toml::source_position last = node.source().end;
    const auto reach = [&last](const toml::node& child) {
        const toml::source_position end = last_end(child);
        if (last < end) last = end;
    };
    const toml::table* table = node.as_table();
    if (!table || table->is_inline()) return last;
    for (const auto& [key, child] : *table)
        if (!is_header(key, child)) reach(child);
    return last;
}

bool names_scene(const toml::table& root, const fs::path& folder, const Scene& scene) {
    const auto name = root["scene"].value<std::string>();
    return name &&
           relative_path(folder / *name, folder) == relative_path(scene.files.front(), folder);
}

// The text of a preset, and where in it things stand.
class Layout {
public:
    Layout(std::string_view text, const toml::table& root);

    Form form(std::string_view table) const;
    // Byte offsets.
    std::size_t offset(const toml::source_position& at) const;
    std::size_t line_begin(std::size_t at) const;
    std::size_t line_end(std::size_t at) const;  // after the line end
    std::size_t end_of_root_keys() const;
    std::size_t end_of_table(std::string_view table) const;

    const toml::node* get(std::string_view name) const { return root.get(name); }
    std::string_view spelled(const toml::node& node) const {
        const std::size_t begin = offset(node.source().begin);
        return text.substr(begin, offset(node.source().end) - begin);
    }

    std::string_view text;
    const toml::table& root;

private:
    std::vector<std::size_t> lines_;  // where each begins
};

Layout::Layout(std::string_view whole_text, const toml::table& table)
    : text(whole_text), root(table) {
    lines_.push_back(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1))
        lines_.push_back(at + 1);
}

// toml++ counts characters; the bytes that continue one have 10 on top.
std::size_t Layout::offset(const toml::source_position& at) const {
    std::size_t byte = lines_[at.line - 1];
    for (toml::source_index column = 1; column < at.column && byte < text.size(); ++column) do
            ++byte;
        while (byte < text.size() && (static_cast<unsigned char>(text[byte]) & 0xC0) == 0x80);
    return byte;
}

std::size_t Layout::line_begin(std::size_t at) const {
    return *std::prev(std::ranges::upper_bound(lines_, at));
}

std::size_t Layout::line_end(std::size_t at) const {
    const auto next = std::ranges::upper_bound(lines_, at);
    return next == lines_.end() ? text.size() : *next;
}

Form Layout::form(std::string_view name) const {
    const auto found = root.find(name);
    if (found == root.end()) return Form::missing;
    const toml::table* table = found->second.as_table();
    if (!table) return Form::no_table;
    if (table->is_inline()) return Form::braces;
    if (!is_header(found->first, *table)) return Form::dotted;
    const std::size_t after_name = offset(found->first.source().end);
    return text.find_first_not_of(" \t", after_name) == text.find(']', after_name) ? Form::header
                                                                                   : Form::missing;
}

std::size_t Layout::end_of_root_keys() const {
    std::size_t end = lines_.front();
    for (const auto& [key, node] : root)
        if (!is_header(key, node)) end = std::max(end, line_end(offset(last_end(node))));
    return end;
}

std::size_t Layout::end_of_table(std::string_view table) const {
    return form(table) == Form::header ? line_end(offset(last_end(*get(table))))
                                       : end_of_root_keys();
}

class Editor {
public:
    // `old` is what the text says now.
    Editor(const Preset& preset, const Preset& old, const fs::path& folder, const Layout& layout)
        : preset_(preset), old_(old), folder_(folder), layout_(layout) {}

    std::vector<Edit> edits() {
        edit_root();
        edit_tweaks();
        edit_channels();
        edit_qualities();
        edit_events();
        edit_expect();
        return std::move(edits_);
    }

private:
    using Lines = std::vector<TomlLine>;
    using Names = std::vector<std::string>;

    void edit_root();
    void edit_tweaks();
    void edit_channels();
    void edit_qualities();
    void edit_events();
    void edit_expect();

    void replace(const toml::node& node, std::string text);
    void insert(std::size_t at, std::string text) { edits_.push_back({at, at, std::move(text)}); }
    void remove_lines(const toml::key& key, const toml::node& node);
    void remove_events(const toml::array& events);
    void remove_tables(const toml::array& tables);
    void merge(const toml::table& table, std::size_t otherwise_at, const Lines& lines);
    void set_root(std::string_view key, bool same, const std::string& value);
    void set_names(std::string_view key, const Names& was, const Names& names);
    bool edit_names(const toml::array& list, Names names);
    bool has_comma(std::size_t begin, std::size_t end) const;
    std::size_t behind_comma(const toml::node& value) const;
    void remove_from_list(const toml::node& value);
    void add_lines(std::string_view table, std::size_t otherwise_at, const Lines& lines);
    Lines channel(const Preset& preset, std::size_t index) const;
    Lines quality(const Preset& preset, std::string_view name) const;

    const Preset& preset_;
    const Preset& old_;
    const fs::path& folder_;
    const Layout& layout_;
    std::vector<Edit> edits_;
};

void Editor::replace(const toml::node& node, std::string text) {
    const toml::source_region& source = node.source();
    edits_.push_back({layout_.offset(source.begin), layout_.offset(source.end), std::move(text)});
}

void Editor::remove_lines(const toml::key& key, const toml::node& node) {
    edits_.push_back({layout_.line_begin(layout_.offset(key.source().begin)),
                      layout_.line_end(layout_.offset(last_end(node))), ""});
}

void Editor::edit_root() {
    set_root("scene", names_scene(layout_.root, folder_, preset_.scene),
             toml_string(relative_path(preset_.scene.files.front(), folder_)));
    const bool is_new = layout_.text.empty();
    const auto title = layout_.root.find("title");
    if (preset_.title.empty() && !old_.title.empty() && title != layout_.root.end())
        remove_lines(title->first, title->second);
    else
        set_root("title", preset_.title == old_.title, toml_string(preset_.title));
    set_root("time", preset_.time == old_.time && !is_new, toml_number(preset_.time));
    set_root("size", preset_.size == old_.size && !is_new,
             fmt::format("[{}, {}]", preset_.size.x, preset_.size.y));
    set_root("settle", preset_.settle == old_.settle, fmt::format("{}", preset_.settle));
    const std::string date = toml_date(preset_.date);
    set_root("date", date == toml_date(old_.date), date);
    set_names("locked", old_.locked, preset_.locked);
    set_names("watch", old_.watch, preset_.watch);
}

std::string joined(std::span<const std::string> names) {
    std::string text;
    for (const std::string& each : names)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", toml_string(each));
    return text;
}

// In any order. A list with comments in it keeps them.
void Editor::set_names(std::string_view key, const Names& was, const Names& names) {
    if (std::ranges::is_permutation(was, names)) return;
    const toml::node* node = layout_.get(key);
    const toml::array* list = node ? node->as_array() : nullptr;
    const bool has_comment = list && layout_.spelled(*list).find('#') != std::string::npos;
    if (!has_comment || !edit_names(*list, names))
        set_root(key, false, fmt::format("[{}]", joined(names)));
}

// Names come and go one by one. False, and nothing is changed, where commas stand elsewhere than
// right behind them.
bool Editor::edit_names(const toml::array& list, Names names) {
    const std::size_t bracket = layout_.offset(list.source().end) - 1;
    std::vector<const toml::node*> kept, gone;
    for (const toml::node& one : list) {
        const std::size_t end = layout_.offset(one.source().end);
        const bool is_last = &one == &list.back();
        if (behind_comma(one) == end && (!is_last || has_comma(end, bracket))) return false;
        const auto found = std::ranges::find(names, one.value_or(std::string()));
        (found == names.end() ? gone : kept).push_back(&one);
        if (found != names.end()) names.erase(found);
    }
    for (const toml::node* one : gone) remove_from_list(*one);
    const Names& added = names;
    if (added.empty()) return true;
    const std::size_t line = layout_.line_begin(bracket);
    const std::size_t last = kept.empty() ? bracket : layout_.offset(kept.back()->source().end);
    const std::size_t behind = kept.empty() ? bracket : behind_comma(*kept.back());
    if (!kept.empty() && behind == last) insert(last, ",");
    if (layout_.text.find_first_not_of(" \t", line) != bracket) {
        insert(behind, (kept.empty() ? "" : " ") + joined(added));
        return true;
    }
    const std::size_t first = list.empty() ? bracket : layout_.offset(list.front().source().begin);
    const std::size_t margin = layout_.line_begin(first);
    const bool is_indented =
        !list.empty() && layout_.text.find_first_not_of(" \t", margin) == first;
    const std::string indent(is_indented ? layout_.text.substr(margin, first - margin) : "    ");
    for (const std::string& each : added)
        insert(line, fmt::format("{}{},\n", indent, toml_string(each)));
    return true;
}

// Outside of comments.
bool Editor::has_comma(std::size_t begin, std::size_t end) const {
    for (std::size_t at = begin; at < end; ++at) {
        if (layout_.text[at] == ',') return true;
        if (layout_.text[at] == '#') at = layout_.line_end(at) - 1;
    }
    return false;
}

// Where the value of a list ends, with its comma if that stands right behind it.
std::size_t Editor::behind_comma(const toml::node& value) const {
    const std::size_t end = layout_.offset(value.source().end);
    const std::size_t word = layout_.text.find_first_not_of(" \t", end);
    return word != std::string::npos && layout_.text[word] == ',' ? word + 1 : end;
}

// With the comment beside it, where it has a line of its own.
void Editor::remove_from_list(const toml::node& value) {
    const std::size_t begin = layout_.offset(value.source().begin), end = behind_comma(value);
    const std::size_t line = layout_.line_begin(begin);
    const std::size_t next = layout_.text.find_first_not_of(" \t", end);
    const bool is_alone = layout_.text.find_first_not_of(" \t", line) == begin &&
                          std::string_view("#\r\n").find(layout_.text[next]) != std::string::npos;
    if (is_alone)
        edits_.push_back({line, layout_.line_end(end), ""});
    else
        edits_.push_back({begin, next, ""});
}

void Editor::set_root(std::string_view key, bool same, const std::string& value) {
    if (same) return;
    if (const toml::node* node = layout_.get(key))
        replace(*node, value);
    else
        insert(layout_.end_of_root_keys(), fmt::format("{} = {}\n", key, value));
}

void Editor::edit_tweaks() {
    const toml::node* node = layout_.get("tweaks");
    const toml::table* table = node ? node->as_table() : nullptr;
    Lines added;
    for (std::size_t i = 0; i < preset_.values.size(); ++i) {
        const Tweak& tweak = preset_.scene.tweaks[i];
        const std::string value = toml_value(tweak, preset_.values[i]);
        if (value == toml_value(tweak, old_.values[i])) continue;
        const toml::node* written = table ? table->get(tweak.name) : nullptr;
        if (written)
            replace(*written, value);
        else
            added.push_back({tweak.name, value});
    }
    add_lines("tweaks", layout_.end_of_root_keys(), added);
}

// New keys go to the end of their table, indented like its last one.
void Editor::add_lines(std::string_view name, std::size_t otherwise_at, const Lines& lines) {
    if (lines.empty()) return;
    const Form form = layout_.form(name);
    const toml::node* node = layout_.get(name);
    const toml::table* table = node ? node->as_table() : nullptr;
    if (form == Form::no_table || (form == Form::braces && table->empty()))
        return replace(*node, toml_braces(lines));
    std::string text = form == Form::missing ? fmt::format("\n[{}]\n", name) : "";
    std::string before, after = "\n";
    std::size_t at = otherwise_at;
    if (form != Form::missing) {
        const std::size_t end = layout_.offset(last_end(*table));
        const std::size_t begin = layout_.line_begin(end);
        const std::size_t word = layout_.text.find_first_not_of(" \t", begin);
        before = layout_.text.substr(begin, std::min(word, end) - begin);
        at = layout_.line_end(end);
    }
    if (form == Form::dotted) before += fmt::format("{}.", name);
    if (form == Form::braces) {
        before = ", ";
        after = "";
        at = 0;
        for (const auto& [key, child] : *table)
            at = std::max(at, layout_.offset(child.source().end));
    }
    for (const TomlLine& line : lines)
        text += fmt::format("{}{} = {}{}", before, line.key, line.value, after);
    insert(at, text);
}

Editor::Lines Editor::channel(const Preset& preset, std::size_t index) const {
    return toml_channel(preset.channels[index], preset.scene, folder_);
}

void Editor::edit_channels() {
    Lines all, added;
    bool same = true;
    const toml::node* node = layout_.get("channels");
    const toml::table* table = node ? node->as_table() : nullptr;
    const bool braces = layout_.form("channels") == Form::braces;
    for (std::size_t i = 0; i < preset_.channels.size(); ++i) {
        const std::string name = fmt::format("iChannel{}", i);
        const Lines now = channel(preset_, i), was = channel(old_, i);
        if (!now.empty()) all.push_back({name, toml_braces(now)});
        if (toml_braces(now) == toml_braces(was)) continue;
        same = false;
        const auto written = table ? table->find(name) : toml::table::const_iterator();
        const bool stands = table && written != table->end();
        const bool in_place =
            stands && !now.empty() &&
            (!written->second.is_table() || written->second.as_table()->is_inline());
        if (in_place && !braces) replace(written->second, toml_braces(now));
        if (stands && !in_place && !braces) remove_lines(written->first, written->second);
        if (!now.empty() && !in_place) added.push_back(all.back());
    }
    if (same) return;
    if (braces) return replace(*node, all.empty() ? "{}" : toml_braces(all));
    add_lines("channels", layout_.end_of_table("tweaks"), added);
}

Editor::Lines Editor::quality(const Preset& preset, std::string_view name) const {
    Lines lines;
    const auto found = std::ranges::find(preset.qualities, name, &QualitySet::name);
    if (found == preset.qualities.end()) return lines;
    for (const Turned& turned : found->values) {
        const Tweak& tweak = preset.scene.tweaks[turned.tweak];
        lines.push_back({tweak.name, toml_value(tweak, turned.value)});
    }
    std::ranges::sort(lines, {}, &TomlLine::key);  // as they are read
    return lines;
}

// Each line keeps its place and its comments; what is new follows the last one, or `otherwise_at`.
void Editor::merge(const toml::table& table, std::size_t otherwise_at, const Lines& lines) {
    std::size_t last = otherwise_at;
    std::string before, text;  // `  best.` of `  best.steps = 3`
    for (const auto& [key, child] : table) {
        const std::size_t at = layout_.offset(key.source().begin), begin = layout_.line_begin(at);
        const std::size_t end = layout_.line_end(layout_.offset(last_end(child)));
        if (end >= last) before = layout_.text.substr(begin, at - begin);
        last = std::max(last, end);
        const auto line = std::ranges::find(lines, key.str(), &TomlLine::key);
        if (line == lines.end())
            edits_.push_back({begin, end, ""});
        else if (layout_.spelled(child) != line->value)
            replace(child, line->value);
    }
    for (const TomlLine& line : lines)
        if (!table.contains(line.key))
            text += fmt::format("{}{} = {}\n", before, line.key, line.value);
    if (!text.empty()) insert(last, text);
}

void Editor::remove_tables(const toml::array& tables) {
    for (const toml::node& one : tables)
        edits_.push_back({layout_.line_begin(layout_.offset(one.source().begin)),
                          layout_.line_end(layout_.offset(last_end(one))), ""});
}

// One that has changed keeps its place; one that is new stands under a header at the end.
void Editor::edit_qualities() {
    const toml::node* node = layout_.get("quality");
    const toml::table* table = node ? node->as_table() : nullptr;
    for (const QualitySet& set : preset_.qualities) {
        const Lines now = quality(preset_, set.name);
        if (toml_braces(now) == toml_braces(quality(old_, set.name))) continue;
        const bool is_bare =
            !set.name.empty() && set.name.find_first_not_of(kBareKey) == std::string::npos;
        const std::string name = is_bare ? set.name : toml_string(set.name);
        const auto written = table ? table->find(set.name) : toml::table::const_iterator();
        if (table && written != table->end()) {
            const toml::node& value = written->second;
            const bool is_table = value.is_table() && !value.as_table()->is_inline();
            if (value.is_array_of_tables() && value.as_array()->front().is_table() &&
                !value.as_array()->front().as_table()->is_inline()) {
                remove_tables(*value.as_array());
            } else if (is_table) {
                const std::size_t head = layout_.offset(written->first.source().begin);
                merge(*value.as_table(), layout_.line_end(head), now);
                continue;
            } else {
                replace(value, toml_braces(now));
                continue;
            }
        } else if (node && (!table || table->is_inline())) {
            add_lines("quality", 0, {{name, toml_braces(now)}});
            continue;
        }
        std::string text = fmt::format("\n[quality.{}]\n", name);
        for (const TomlLine& line : now) text += fmt::format("{} = {}\n", line.key, line.value);
        insert(layout_.text.size(), text);
    }
}

std::vector<std::string> spelled(const std::vector<Event>& events) {
    std::vector<std::string> texts;
    for (const Event& event : events) texts.push_back(toml_braces(toml_event(event)));
    return texts;
}

void Editor::edit_events() {
    const std::vector<std::string> inline_texts = spelled(preset_.events);
    if (inline_texts == spelled(old_.events)) return;
    const auto written = layout_.root.find("events");
    if (written != layout_.root.end() && !is_header(written->first, written->second)) {
        const std::string list = fmt::format("[\n    {},\n]", fmt::join(inline_texts, ",\n    "));
        return replace(written->second, inline_texts.empty() ? "[]" : list);
    }
    std::string text;
    for (const Event& event : preset_.events) {
        text += "[[events]]\n";
        for (const TomlLine& line : toml_event(event))
            text += fmt::format("{} = {}\n", line.key, line.value);
    }
    const toml::array* events = layout_.get("events") ? written->second.as_array() : nullptr;
    if (!events || events->empty()) return insert(layout_.text.size(), "\n" + text);
    insert(layout_.line_begin(layout_.offset(events->front().source().begin)), text);
    remove_events(*events);
}

// From header to header, as far as nothing but comments and blank lines stands between them.
void Editor::remove_events(const toml::array& events) {
    const std::size_t first = edits_.size();
    for (const toml::node& event : events) {
        const std::size_t begin = layout_.line_begin(layout_.offset(event.source().begin));
        const std::size_t end = layout_.line_end(layout_.offset(last_end(event)));
        bool follows = edits_.size() > first;
        for (std::size_t at = follows ? edits_.back().end : begin; at < begin && follows;
             at = layout_.line_end(at)) {
            const std::size_t word = layout_.text.find_first_not_of(" \t", at);
            follows = std::string_view("#\r\n").find(layout_.text[word]) != std::string::npos;
        }
        if (follows)
            edits_.back().end = end;
        else
            edits_.push_back({begin, end, ""});
    }
}

// Each key with its value, "" for what is not expected.
std::vector<TomlLine> expect_lines(const Expect& expect, const fs::path& folder) {
    const auto file = [&](const fs::path& name) {
        return name.empty() ? std::string() : toml_string(relative_path(name, folder));
    };
    const auto bound = [](const std::optional<double>& most) {
        return most ? toml_number(*most) : std::string();
    };
    std::vector<TomlLine> lines;
    lines.push_back({"picture", file(expect.picture)});
    lines.push_back({"rmse", bound(expect.rmse)});
    lines.push_back({"flip", bound(expect.flip)});
    std::string ratio;
    if (expect.ms_ratio)
        ratio = toml_braces({{"of", file(expect.ms_of)}, {"most", bound(expect.ms_ratio)}});
    lines.push_back({"ms_ratio", ratio});
    return lines;
}

// Only files' names change, where the preset moves to another folder; or all of it is new.
void Editor::edit_expect() {
    const toml::node* node = layout_.get("expect");
    const toml::table* table = node ? node->as_table() : nullptr;
    const Lines now = expect_lines(preset_.expect, folder_);
    const Lines was = expect_lines(old_.expect, folder_);
    Lines added;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (now[i].value == was[i].value || now[i].value.empty()) continue;
        if (const toml::node* written = table ? table->get(now[i].key) : nullptr)
            replace(*written, now[i].value);
        else
            added.push_back(now[i]);
    }
    add_lines("expect", layout_.end_of_table("tweaks"), added);
}

std::string edited(std::string_view text, std::vector<Edit> edits) {
    const std::size_t first_end = text.find('\n');
    const bool crlf = first_end != text.npos && first_end > 0 && text[first_end - 1] == '\r';
    std::ranges::stable_sort(edits, {}, &Edit::begin);
    std::string result;
    std::size_t at = 0;
    const auto add = [&](std::string_view added) {
        for (const char c : added) result += c == '\n' && crlf ? "\r\n" : std::string(1, c);
    };
    for (const Edit& edit : edits) {
        if (edit.begin > at) result += text.substr(at, edit.begin - at);
        at = std::max(at, edit.end);
        const bool is_line = edit.text.ends_with('\n');
        if (is_line && edit.begin == text.size() && !result.empty() && !result.ends_with('\n'))
            add("\n");
        add(edit.text);
    }
    return result + std::string(text.substr(at));
}

}  // namespace

PresetText write_preset(const Preset& preset, const fs::path& file, std::string_view existing) {
    PresetText result;
    const fs::path folder = file.parent_path();
    std::string text(existing);
    // The second round finds nothing to change, unless the text is laid out in a way not foreseen.
    for (int round = 0; round < 2; ++round) {
        const ReadPreset old = parse_preset(text, file, preset.scene);
        if (!old.preset && round == 0) {
            result.diagnostics = old.diagnostics;
            return result;
        }
        std::vector<Edit> edits;
        if (old.preset) {
            const toml::parse_result parsed = toml::parse(std::string_view(text));
            const Layout layout(text, parsed.table());
            edits = Editor(preset, *old.preset, folder, layout).edits();
            if (edits.empty()) break;
        }
        if (round == 1) {
            result.diagnostics.push_back(
                {Severity::error, Place{file.string()},
                 "this look cannot be written into the file as it is laid out; save it under a "
                 "new name"});
            return result;
        }
        text = edited(text, std::move(edits));
    }
    result.text = std::move(text);
    return result;
}

bool names_scene(std::string_view text, const fs::path& file, const Scene& scene) {
    if (find_deep_key(text)) return false;
    const toml::parse_result parsed = toml::parse(text);
    return parsed && names_scene(parsed.table(), file.parent_path(), scene);
}

}  // namespace glint
