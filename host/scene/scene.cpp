// A scene file becomes plain data: its uniforms are matched with their annotations.
#include "scene/scene.h"

#include "base/canonical_name.h"
#include "base/words.h"
#include "glsl/reading.h"
#include "glsl/source_text.h"
#include "scene/annotation.h"
#include "scene/builtin.h"
#include "scene/lint.h"
#include "scene/other_language.h"
#include "scene/own_main.h"
#include "scene/probe_note.h"
#include "scene/scene_text.h"
#include "scene/shadertoy.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace glint {
namespace {

class Builder {
public:
    Builder(SourceText source, Diagnostics& diagnostics)
        : source_(std::move(source)),
          diagnostics_(diagnostics),
          reading_(read_glsl(source_.text, known_of_scene())) {}

    Scene build();

private:
    void add_declaration(const Uniform& declaration, std::size_t next_begin);
    void add_annotated(const Uniform& declaration, Span note);
    void add_tweak(const Uniform& declaration, TweakType type, Span note);
    void add_sampler(const Uniform& declaration, SamplerType type, Span note);
    void add_pass_output(const SamplerAnnotation& annotation, Span note);
    void add_pass(const SamplerAnnotation& annotation, Span note);
    void check_pass_options(const SamplerAnnotation& annotation, const Pass& pass, Span note);
    void check_builtin(const Uniform& declaration, const UniformName& declarator);
    void blank_builtins(const Uniform& declaration);
    bool claim_name(const UniformName& declarator, const std::string& tab);
    bool is_known_tweak(const Uniform& declaration, Span note);
    std::string words_of(const Uniform& declaration, Span note) const;
    std::string tab_of(const Uniform& declaration, Span note) const;
    std::string tab_at(std::size_t offset) const;
    void warn_unannotated(const Uniform& declaration);
    void use_note(Span note);
    bool is_allowance(Span note);
    void resolve_readers();
    bool stands_in_tab(const Pass& pass) const;
    void find_entries();
    void check_function(const PassCall& call, const std::string& why);
    void check_seconds();
    bool misses_a_part() const {  // in which may stand what is not here
        return std::ranges::any_of(diagnostics_, &Diagnostic::missing_file) ||
               reading_.open_condition || reading_.unclosed_comment;
    }
    bool draws_by_main(const std::vector<std::string>& outputs);
    void check_image();

    std::optional<Span> note_of(const Uniform& declaration, std::size_t next_begin);
    std::string note_text(Span note) const;
    bool report(const std::vector<Complaint>& complaints, Span note);
    void blank(std::size_t begin, std::size_t end) { blanked_.push_back({begin, end}); }
    bool puts_names_together() const;
    void tell(Severity severity, std::size_t offset, std::string text) {
        diagnostics_.push_back({severity, source_.place(offset), std::move(text)});
    }
    void error(std::size_t at, std::string text) { tell(Severity::error, at, std::move(text)); }
    void warning(std::size_t at, std::string text) { tell(Severity::warning, at, std::move(text)); }

    struct Reader {  // `buffer NAME`, until every pass is known
        std::size_t sampler;
        std::string target;
        std::size_t target_offset;
    };

    SourceText source_;
    Diagnostics& diagnostics_;
    Reading reading_;  // of source_.text
    std::vector<Span> notes_;
    std::vector<Span> blanked_;  // bytes that the driver does not see
    Scene scene_;
    std::unordered_set<std::string_view> identifiers_;
    std::size_t next_note_ = 0;
    std::string group_;
    std::vector<Tab> tabs_;
    // Name to offset; a sampler of one tab as "PASS_bufferA iChannel0".
    std::unordered_map<std::string, std::size_t> declared_;
    std::unordered_map<std::string, std::string> tweak_words_;  // by name; see words_of()
    std::unordered_set<std::size_t> told_mains_;                // bytes
    std::unordered_map<std::string, std::size_t> pass_of_;      // function to index of pass
    std::vector<Reader> readers_;
    std::vector<std::pair<std::string, std::size_t>> seconds_;  // of tweaks: names, and bytes
    std::vector<std::size_t> entries_;  // by pass: where its function is named
};

Scene Builder::build() {
    identifiers_ = find_words(reading_);
    tabs_ = find_tabs(reading_);
    notes_ = find_notes(reading_);
    std::erase_if(notes_, [&](Span note) { return is_allowance(note); });
    scene_.files = source_.files;
    const auto declarations = find_uniforms(reading_);
    for (std::size_t i = 0; i < declarations.size(); ++i) {
        const bool last = i + 1 == declarations.size();
        add_declaration(declarations[i],
                        last ? source_.text.size() : declarations[i + 1].span.begin);
    }
    while (next_note_ < notes_.size()) use_note(notes_[next_note_++]);
    resolve_readers();
    find_entries();
    check_seconds();
    scene_.has_sound = has_sound(reading_, identifiers_);
    if (const auto strange = find_strange(reading_))
        error(strange->begin, about_strange(reading_, *strange));
    else
        check_image();
    for (const Span span : blanked_)
        for (std::size_t i = span.begin; i < span.end; ++i)
            if (source_.text[i] != '\n') source_.text[i] = ' ';
    scene_.text = std::move(source_.text);
    scene_.origins = std::move(source_.origins);
    return std::move(scene_);
}

// What is wrong with it is told.
bool Builder::draws_by_main(const std::vector<std::string>& outputs) {
    const OwnMain main = own_main_for(reading_, outputs);
    // Several passes may have the same main().
    if (main.wrong && told_mains_.insert(main.wrong->at.value_or(0)).second)
        error(main.wrong->at.value_or(0), main.wrong->text);
    return main.draws;
}

void Builder::check_image() {
    if (reading_.open_condition && !reading_.unclosed_comment) {  // the rest goes with it
        const auto [at, why] = about_open_condition(reading_);
        return error(at, why);
    }
    if (draws_by_main({"image"})) scene_.image_entry = "main";
    if (scene_.image_entry == "mainImage")
        check_function({"mainImage", {"color"}}, "this draws the picture");
    else if (has_errors(diagnostics_))
        return;
    if (identifiers_.contains(scene_.image_entry) || scene_.has_sound) return;
    // What another language includes is none of ours.
    if (other_language(reading_)) std::erase_if(diagnostics_, &Diagnostic::missing_file);
    if (misses_a_part()) return;
    const NoPicture why = why_no_picture(reading_);
    if (why.at) return error(*why.at, why.text);
    diagnostics_.push_back({Severity::error, {source_.files.front().string(), 1, 1}, why.text});
}

// A note's words, byte for byte, but with space for control characters (tabs too: messages and
// menus show these words) and for the backslashes that join lines.
std::string Builder::note_text(Span note) const {
    std::string text = source_.text.substr(note.begin, note.end - note.begin);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n' && i > 0) text[i - 1] = ' ';
        if ((text[i] >= 0 && text[i] < ' ') || text[i] == '\x7F') text[i] = ' ';
    }
    return text;
}

// `//@ allow unused-function` is for scene/lint.h.
bool Builder::is_allowance(Span note) {
    const std::string text = note_text(note);
    const auto names = parse_allow(text);
    const auto known = finding_names();
    for (const std::string_view name : names.value_or(std::vector<std::string_view>()))
        if (std::ranges::find(known, name) == known.end())
            warning(note.begin + static_cast<std::size_t>(name.data() - text.data()),
                    fmt::format("no finding of glint info is called {}{}", in_quotes(name),
                                did_you_mean(name, known)));
    return names.has_value();
}

std::string_view first_word(std::string_view text) {
    text = trimmed(text);
    return text.substr(0, text.find_first_of(" \t("));
}

// A note without a uniform: a heading, or a mistake.
void Builder::use_note(Span note) {
    static const std::string kWords[] = {"group", "allow", "assert", "watch"};
    const std::string text = note_text(note);
    if (auto heading = parse_group(text))
        group_ = std::move(*heading);
    else if (!parse_probe_note(text))
        warning(note.begin - 3,
                fmt::format("no uniform on this line, so this annotation does nothing; put it "
                            "behind a uniform, or write //@ group NAME{}",
                            did_you_mean(first_word(text), kWords)));
}

// The note behind a declaration, on its last line (or within it). Notes before it are used up. Of
// several declarations on one line the last one has the note.
std::optional<Span> Builder::note_of(const Uniform& declaration, std::size_t next_begin) {
    const auto& notes = notes_;
    while (next_note_ < notes.size() && notes[next_note_].begin < declaration.span.begin)
        use_note(notes[next_note_++]);
    if (next_note_ == notes.size() || notes[next_note_].begin > next_begin) return std::nullopt;
    const std::size_t next_line = source_.line_index(declaration.span.end - 1) + 1;
    const auto& lines = source_.line_begins;
    if (next_line < lines.size() && notes[next_note_].begin >= lines[next_line])
        return std::nullopt;
    return notes[next_note_];
}

void Builder::add_declaration(const Uniform& declaration, std::size_t next_begin) {
    const auto note = note_of(declaration, next_begin);
    const bool has_builtin = std::ranges::any_of(
        declaration.names, [](const UniformName& d) { return find_builtin(d.name) != nullptr; });
    if (note) return add_annotated(declaration, *note);
    if (has_builtin && !declaration.is_broken) blank_builtins(declaration);
    warn_unannotated(declaration);
}

void Builder::warn_unannotated(const Uniform& declaration) {
    for (const UniformName& declarator : declaration.names) {
        if (find_builtin(declarator.name)) continue;
        if (declarator.has_initial && !declaration.is_block) {
            error(declarator.span.begin,
                  fmt::format("GLSL ES gives uniforms no value here; write the default behind: "
                              "uniform {} {}; //@ DEFAULT",
                              declaration.type, declarator.name));
            continue;
        }
        if (find_foreign_name(declaration.type, declarator.name) && !declarator.is_array) continue;
        if (declaration.is_block) continue;  // all of which is told below
        warning(declarator.span.begin,
                fmt::format("{} has no annotation, so it stays 0; {}", in_quotes(declarator.name),
                            what_fills(declaration.type, declarator.is_array)));
    }
    if (declaration.is_block)
        warning(declaration.span.begin,
                "nothing fills a uniform block or struct here; declare its members as uniforms "
                "of their own");
}

void Builder::add_annotated(const Uniform& declaration, Span note) {
    ++next_note_;
    const std::size_t at = declaration.span.begin;
    if (declaration.is_block)
        return error(at, "an annotation is for one plain uniform, not for a block or struct");
    if (declaration.no_semicolon) return error(*declaration.no_semicolon, "';' is missing here");
    if (declaration.is_broken || declaration.names.empty())
        return error(at, "this declaration is not understood; write uniform TYPE NAME; //@ …");
    if (declaration.names.size() > 1)
        return error(declaration.names[1].span.begin,
                     "an annotation is for one uniform; declare each on a line of its own");
    const UniformName& declarator = declaration.names.front();
    const std::size_t name_at = declarator.span.begin;
    if (declarator.is_array)
        return error(name_at, "an annotation is for one plain uniform, not for an array");
    if (declarator.has_initial)
        return error(name_at, "GLSL ES gives uniforms no value here; write the default behind //@");
    const auto tweak = kTweakTypeNames.find(declaration.type);
    const auto sampler = kSamplerTypeNames.find(declaration.type);
    if (!tweak && !sampler)
        return error(declaration.type_at,
                     fmt::format("{} cannot be annotated; use float, int, bool, vec2, vec3, vec4, "
                                 "sampler2D, samplerCube or sampler3D",
                                 in_quotes(declaration.type)));
    const HostUniform* builtin = find_builtin(declarator.name);
    if (builtin && !(sampler && builtin->type == "sampler"))
        return error(name_at, fmt::format("{} is the host's own; give this uniform another name, "
                                          "or take the annotation away",
                                          in_quotes(declarator.name)));
    if (tweak && is_known_tweak(declaration, note)) return;
    if (!claim_name(declarator, sampler ? tab_of(declaration, note) : "")) return;
    if (tweak) return add_tweak(declaration, *tweak, note);
    add_sampler(declaration, *sampler, note);
}

// Each tab of pasted text has an iChannel0 of its own. A buffer has one name for all, wherever the
// pass that fills it is written.
std::string Builder::tab_of(const Uniform& declaration, Span note) const {
    const bool is_pass = trimmed(note_text(note)).starts_with("pass ");
    return is_pass ? std::string() : tab_at(declaration.span.begin);
}

std::string Builder::tab_at(std::size_t offset) const {
    for (const Tab& tab : tabs_)
        if (tab.span.begin <= offset && offset < tab.span.end) return std::string(tab.pass);
    return {};
}

// One that other tabs declare in the same words.
bool Builder::is_known_tweak(const Uniform& declaration, Span note) {
    const std::string_view name = declaration.names.front().name;
    const auto known = std::ranges::find(scene_.tweaks, name, &Tweak::name);
    const std::string tab = tab_at(declaration.span.begin);
    if (known == scene_.tweaks.end() || tab.empty()) return false;
    const bool is_alike = words_of(declaration, note) == tweak_words_[known->name] &&
                          std::ranges::all_of(known->declarations, [&](Span other) {
                              const std::string its = tab_at(other.begin);
                              return !its.empty() && its != tab;
                          });
    if (is_alike) known->declarations.push_back(declaration.span);
    return is_alike;
}

std::string Builder::words_of(const Uniform& declaration, Span note) const {
    return fmt::format("{} {}", declaration.type, trimmed(note_text(note)));
}

bool Builder::claim_name(const UniformName& declarator, const std::string& tab) {
    const std::string name(declarator.name);
    const auto everywhere = declared_.find(name);
    const auto [entry, is_new] =
        everywhere != declared_.end()
            ? std::pair(everywhere, false)
            : declared_.emplace(tab.empty() ? name : "PASS_" + tab + " " + name,
                                declarator.span.begin);
    if (is_new) return true;
    if (reading_.open_condition) return false;  // which is told
    const Place first = source_.place(entry->second);
    const std::string other = tab_at(entry->second), own = tab_at(declarator.span.begin);
    const bool is_of_tabs = !other.empty() && !own.empty() && other != own && tab.empty();
    error(declarator.span.begin,
          fmt::format("{} is declared already at {}:{}; {}", in_quotes(declarator.name), first.file,
                      first.line,
                      is_of_tabs ? "all tabs have one tweak of a name: declare it alike"
                                 : "take one of them out (or write #pragma once in a file that is "
                                   "included twice)"));
    return false;
}

bool Builder::report(const std::vector<Complaint>& complaints, Span note) {
    for (const auto& [at, text, severity] : complaints) tell(severity, note.begin + at, text);
    return std::ranges::find(complaints, Severity::error, &Complaint::severity) == complaints.end();
}

void Builder::add_tweak(const Uniform& declaration, TweakType type, Span note) {
    const UniformName& declarator = declaration.names.front();
    Tweak tweak;
    tweak.name = declarator.name;
    tweak.type = type;
    tweak.group = group_;
    tweak.place = source_.place(declarator.span.begin);
    tweak.declarations = {declaration.span};
    std::vector<Complaint> complaints;
    tweak = parse_tweak(std::move(tweak), note_text(note), complaints);
    if (!report(complaints, note)) return;
    if (!tweak.second.empty())
        seconds_.push_back({tweak.name, note.begin + note_text(note).find("second=")});
    tweak_words_[tweak.name] = words_of(declaration, note);
    scene_.tweaks.push_back(std::move(tweak));
}

// Other tweaks may stand behind the one that names them.
void Builder::check_seconds() {
    for (const auto& [name, at] : seconds_) {
        const auto tweak = std::ranges::find(scene_.tweaks, name, &Tweak::name);
        if (tweak == scene_.tweaks.end()) continue;
        std::string wrong;
        const auto turned = turned_values(scene_.tweaks, *tweak, tweak->second, wrong);
        const bool is_own = turned.size() == 1 && &scene_.tweaks[turned[0].tweak] == &*tweak;
        if (is_own && tweak->reference == turned[0].value)
            wrong = fmt::format(
                "{}: that is the reference itself, which tells nothing of its own error; name "
                "another value",
                tweak->second);
        if (!wrong.empty()) error(at, "second=" + wrong);
    }
}

void Builder::add_sampler(const Uniform& declaration, SamplerType type, Span note) {
    const UniformName& declarator = declaration.names.front();
    Sampler sampler;
    sampler.name = declarator.name;
    sampler.tab = tab_of(declaration, note);
    sampler.type = type;
    sampler.place = source_.place(declarator.span.begin);
    std::vector<Complaint> complaints;
    SamplerAnnotation annotation = parse_sampler(std::move(sampler), note_text(note), complaints);
    if (!report(complaints, note)) return;
    for (std::filesystem::path& file : annotation.sampler.files)
        file = source_.file(note.begin).parent_path() / file;
    if (annotation.reads_another)
        readers_.push_back(
            {scene_.samplers.size(), annotation.target, note.begin + annotation.target_at});
    if (annotation.sampler.source == Source::buffer && !annotation.reads_another)
        return add_pass_output(annotation, note);
    scene_.samplers.push_back(std::move(annotation.sampler));
}

// Text that is compiled for this pass alone, or for all but the picture (behind an #else).
bool Builder::stands_in_tab(const Pass& pass) const {
    const auto is_told_apart = [&](const std::string& name) {
        return identifiers_.contains("PASS_" + name);
    };
    return is_told_apart("image") || std::ranges::any_of(pass.outputs, is_told_apart);
}

// A function's name stands somewhere in the text, be it as a macro's argument: GLSL ES puts no
// names together. (Where a text tries to, the driver has the word.) What is a uniform is no
// function.
void Builder::find_entries() {
    for (std::size_t i = 0; i < scene_.passes.size(); ++i) {
        Pass& pass = scene_.passes[i];
        if (identifiers_.contains(pass.entry) && !declared_.contains(pass.entry)) {
            check_function({pass.entry, pass.outputs, pass.cube},
                           fmt::format("it fills {}", fmt::join(pass.outputs, ", ")));
            continue;
        }
        if (stands_in_tab(pass))
            pass.entry = pass.cube && identifiers_.contains("mainCubemap") ? "mainCubemap"
                         : !pass.cube && draws_by_main(pass.outputs)       ? "main"
                                                                           : "mainImage";
        else if (!misses_a_part() && !puts_names_together())
            error(entries_[i], no_pass_function(reading_, pass));
    }
}

// Of a function that is there and cannot be called, drivers only say that there is none.
void Builder::check_function(const PassCall& call, const std::string& why) {
    if (const auto wrong = find_uncallable(reading_, call))
        error(wrong->begin, fmt::format("{}, and so has to be {}", why, signature(call)));
}

// As `a##b`, which GLSL ES does not have.
bool Builder::puts_names_together() const {
    return std::ranges::any_of(reading_.written, [](const Token& token) { return token.is("##"); });
}

// Samplers that name the same function are its `out` parameters, in order.
void Builder::add_pass_output(const SamplerAnnotation& annotation, Span note) {
    const auto [entry, is_new] = pass_of_.emplace(annotation.target, scene_.passes.size());
    if (is_new)
        add_pass(annotation, note);
    else
        check_pass_options(annotation, scene_.passes[entry->second], note);
    Pass& pass = scene_.passes[entry->second];
    Sampler sampler = annotation.sampler;
    sampler.pass = entry->second;
    sampler.output = pass.outputs.size();
    constexpr std::size_t kMostOutputs = 8;  // what every GL draws into at once
    if (pass.outputs.size() == kMostOutputs)
        return error(note.begin + annotation.target_at,
                     fmt::format("{} fills {} buffers already, the most that one pass can; use "
                                 "another pass",
                                 in_quotes(annotation.target), kMostOutputs));
    pass.outputs.push_back(sampler.name);
    scene_.samplers.push_back(std::move(sampler));
}

void Builder::add_pass(const SamplerAnnotation& annotation, Span note) {
    const Sampler& sampler = annotation.sampler;
    Pass pass;
    pass.name = sampler.name;
    pass.cube = sampler.type == SamplerType::samplerCube;
    pass.entry = annotation.target;
    pass.place = sampler.place;
    if (pass.cube) {
        pass.size = glm::ivec2(1024);
        pass.format = PixelFormat::rgba16f;
    }
    if (annotation.size) pass.size = annotation.size->value;
    if (annotation.scale) pass.scale = annotation.scale->value;
    if (annotation.step) pass.step = annotation.step->value;
    if (annotation.format) pass.format = annotation.format->value;
    scene_.passes.push_back(std::move(pass));
    entries_.push_back(note.begin + annotation.target_at);
}

// The outputs of one pass are drawn at once: what the first one says holds for all.
void Builder::check_pass_options(const SamplerAnnotation& annotation, const Pass& pass, Span note) {
    const auto contradicts = [&](std::string_view option, std::size_t at) {
        error(note.begin + at,
              fmt::format("this {} is not that of {}, which the same pass fills; write it there",
                          option, in_quotes(pass.name)));
    };
    if (pass.cube || annotation.sampler.type == SamplerType::samplerCube)
        error(note.begin + annotation.target_at,
              fmt::format("a cube pass fills one samplerCube; to read it once more write //@ "
                          "buffer {}",
                          pass.name));
    if (annotation.size && annotation.size->value != pass.size)
        contradicts("size", annotation.size->at);
    if (annotation.scale && annotation.scale->value != pass.scale)
        contradicts("scale", annotation.scale->at);
    if (annotation.step && annotation.step->value != pass.step)
        contradicts("step", annotation.step->at);
    if (annotation.format && annotation.format->value != pass.format)
        contradicts("format", annotation.format->at);
}

void Builder::resolve_readers() {
    std::unordered_map<std::string, const Sampler*> filled;
    std::vector<std::string> names;
    for (const Sampler& sampler : scene_.samplers) {
        if (sampler.source != Source::buffer || sampler.pass >= scene_.passes.size()) continue;
        if (scene_.passes[sampler.pass].outputs[sampler.output] != sampler.name) continue;
        filled.emplace(sampler.name, &sampler);
        names.push_back(sampler.name);
    }
    for (const Reader& reader : readers_) {
        Sampler& sampler = scene_.samplers[reader.sampler];
        const auto found = filled.find(reader.target);
        if (found == filled.end()) {
            // A sampler that was declared with a mistake has had its error already.
            if (declared_.contains(reader.target) && has_errors(diagnostics_)) continue;
            error(reader.target_offset,
                  fmt::format("no pass fills a sampler {}; write the name of one with //@ pass{}",
                              in_quotes(reader.target), did_you_mean(reader.target, names)));
        } else if (found->second->type != sampler.type) {
            error(reader.target_offset, fmt::format("{} is not of the same sampler type; declare "
                                                    "both alike",
                                                    in_quotes(reader.target)));
        } else {
            sampler.pass = found->second->pass;
            sampler.output = found->second->output;
        }
    }
}

void Builder::check_builtin(const Uniform& declaration, const UniformName& declarator) {
    const HostUniform& builtin = *find_builtin(declarator.name);
    const bool type_fits = builtin.type == "sampler"
                               ? kSamplerTypeNames.find(declaration.type).has_value()
                               : declaration.type == builtin.type;
    const bool array_fits =
        declarator.is_array == !builtin.array.empty() && declarator.array == builtin.array;
    if (type_fits && array_fits) {
        if (builtin.type == "sampler")
            scene_.channel_types[static_cast<std::size_t>(declarator.name.back() - '0')] =
                kSamplerTypeNames.find(declaration.type);
        return;
    }
    const std::string array = builtin.array.empty() ? "" : fmt::format("[{}]", builtin.array);
    error(declarator.span.begin,
          fmt::format("{} is the host's own, of another type: uniform {} {}{}; write that, or "
                      "take the line out",
                      in_quotes(declarator.name),
                      builtin.type == "sampler" ? "sampler2D" : builtin.type, declarator.name,
                      array));
}

// Takes the host's own uniforms out of a declaration, with the comma that goes with each.
void Builder::blank_builtins(const Uniform& declaration) {
    bool keeps_any = false;
    std::size_t before = 0;  // the end of the name before
    for (const UniformName& declarator : declaration.names) {
        // A main() of its own means what its text says.
        const bool is_foreign =
            find_foreign_name(declaration.type, declarator.name) && has_own_main(reading_);
        if (find_builtin(declarator.name) && !is_foreign) {
            check_builtin(declaration, declarator);
            if (!declaration.is_plain) continue;
            if (keeps_any)
                blank(before, declarator.span.end);
            else
                blank(declarator.span.begin, declarator.span.end + 1);
        } else {
            keeps_any = true;
        }
        before = declarator.span.end;
    }
    if (!keeps_any) blank(declaration.span.begin, declaration.span.end);
}

}  // namespace

ReadScene read_scene(const std::filesystem::path& file) {
    ReadScene result;
    const bool is_json = ending_of(file) == ".json";
    SourceText source = is_json ? imported_source(file, result.diagnostics)
                                : read_source(file, known_of_scene(), result.diagnostics);
    result.files = source.files;
    Scene scene = Builder(std::move(source), result.diagnostics).build();
    result.named = result.files;
    for (const Sampler& sampler : scene.samplers)
        result.named.insert(result.named.end(), sampler.files.begin(), sampler.files.end());
    if (is_json) refuse_outside(file, result);
    if (!has_errors(result.diagnostics)) result.scene = std::move(scene);
    return result;
}

std::vector<std::filesystem::path> files_outside(const ReadScene& read,
                                                 const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files = read.named;
    std::erase_if(files, [&](const auto& file) { return is_within(file, folder); });
    return files;
}

}  // namespace glint
