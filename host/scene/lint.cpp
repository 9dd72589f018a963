#include "scene/lint.h"

#include "base/canonical_name.h"
#include "base/words.h"
#include "glsl/finding.h"
#include "scene/builtin.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace glint {
namespace {

// The text as one pass has it.
struct PassView {
    std::size_t pass = kImagePass;
    std::string entry;
    Reading reading;
    std::vector<bool> reached;                   // by function
    std::unordered_set<std::string_view> words;  // in what is reached and in values of globals
    bool is_used = false;
};

PassView view_of(const Scene& scene, std::size_t pass) {
    PassView view;
    view.pass = pass;
    view.entry = entry_of(scene, pass);
    view.reading = read_glsl(scene.text, known_of_pass(output_names(scene, pass)));
    view.reached = view.reading.reached_from({view.entry});
    const auto add = [&](TokenRange range) {
        for (std::uint32_t at = range.begin; at < range.end; ++at)
            if (view.reading.tokens[at].is_word()) view.words.insert(view.reading.word(at));
    };
    for (std::size_t i = 0; i < view.reached.size(); ++i)
        if (view.reached[i]) add(view.reading.functions[i].body);
    for (const Declaration& declaration : view.reading.declarations) {
        if (declaration.scope != Scope::global) continue;
        for (const Declarator& one : declaration.names) add(one.initial), add(one.array);
    }
    return view;
}

class Linter {
public:
    explicit Linter(const Preset& preset) : preset_(preset), scene_(preset.scene) {
        views_.push_back(view_of(scene_, kImagePass));
        if (scene_.has_sound) views_.push_back(view_of(scene_, kSoundPass));
        for (std::size_t i = 0; i < scene_.passes.size(); ++i) views_.push_back(view_of(scene_, i));
    }

    Lint run() {
        find_undescribed();
        for (const PassView& view : views_)
            for (const NotUnderstood& one : view.reading.not_understood)
                add_unread(scene_.place_at(one.span.begin), one.why);
        if (result_.unread.empty()) {
            find_used();
            find_unused_passes();
            find_unused_uniforms();
            find_unused_functions();
            look_into_functions();
        }
        drop_allowed(scene_, result_.findings);
        return std::move(result_);
    }

private:
    void add(std::string_view name, const Place& place, std::string text) {
        const bool is_new =
            seen_.insert({std::string(name), place.file, place.line, place.column, text}).second;
        if (is_new) result_.findings.push_back({std::string(name), place, std::move(text)});
    }
    void add_unread(const Place& place, const std::string& why) {
        const bool is_known = std::ranges::any_of(result_.unread, [&](const Unread& one) {
            return to_string({{}, one.place, one.why}) == to_string({{}, place, why});
        });
        if (!is_known) result_.unread.push_back({place, why});
    }
    // Whether a place stands in the scene's own file.
    bool is_own(const Place& place) const {
        const bool is_made = ending_of(scene_.files.front()) == ".json" && scene_.files.size() > 1;
        return place.file == scene_.files[is_made ? 1 : 0].string();
    }

    void find_used();
    void find_unused_passes();
    void find_unused_uniforms();
    void find_unused_functions();
    void find_undescribed();
    void look_into_functions();

    const Preset& preset_;
    const Scene& scene_;
    std::vector<PassView> views_;
    std::set<std::size_t>
        read_samplers_;  // as in sampler_at; by others than the pass that fills it
    Lint result_;
    std::set<std::tuple<std::string, std::string, int, int, std::string>> seen_;
};

void Linter::find_used() {
    std::vector<PassView*> fresh;
    const auto use = [&](PassView& view) {
        if (!view.is_used) fresh.push_back(&view);
        view.is_used = true;
    };
    for (PassView& view : views_)
        if (!fills_a_buffer(view.pass)) use(view);
    while (!fresh.empty()) {
        const PassView& view = *fresh.back();
        fresh.pop_back();
        for (const std::string_view word : view.words) {
            // The site's Image tab may call a channel by its struct.
            const bool is_struct = word.size() == 4 && word.starts_with("iCh");
            const std::string name =
                is_struct ? fmt::format("iChannel{}", word.back()) : std::string(word);
            const auto sampler = find_sampler(preset_, view.pass, name);
            if (!sampler) continue;
            read_samplers_.insert(*sampler);
            const Sampler& read = sampler_at(preset_, *sampler);
            if (read.source != Source::buffer || read.pass == view.pass) continue;
            for (PassView& other : views_)
                if (other.pass == read.pass) use(other);
        }
    }
}

void Linter::find_unused_passes() {
    for (const PassView& view : views_)
        if (!view.is_used)
            add("unused-pass", scene_.passes[view.pass].place,
                fmt::format("neither the picture nor a pass that it needs reads `{}`: the pass is "
                            "never drawn",
                            scene_.passes[view.pass].name));
}

void Linter::find_unused_uniforms() {
    std::unordered_set<std::string_view> named;  // by what any entry reaches
    for (const PassView& view : views_) named.insert(view.words.begin(), view.words.end());
    for (const Tweak& tweak : scene_.tweaks)
        if (!named.contains(tweak.name))
            add("unused-uniform", tweak.place,
                fmt::format("nothing that is drawn reads the tweak `{}`", tweak.name));
    for (std::size_t i = 0; i < scene_.samplers.size(); ++i) {
        const Sampler& sampler = scene_.samplers[i];
        const bool fills = sampler.source == Source::buffer &&
                           scene_.passes[sampler.pass].outputs[sampler.output] == sampler.name;
        const auto is_filling = [&](const PassView& view) { return view.pass == sampler.pass; };
        if (fills && !std::ranges::find_if(views_, is_filling)->is_used) continue;  // said already
        if (read_samplers_.contains(i) || named.contains(sampler.name)) continue;
        // Another sampler may read the buffer that it fills.
        const bool is_read = fills && std::ranges::any_of(read_samplers_, [&](std::size_t other) {
                                 const Sampler& one = sampler_at(preset_, other);
                                 return one.source == Source::buffer && one.pass == sampler.pass &&
                                        one.output == sampler.output;
                             });
        if (!is_read)
            add("unused-uniform", sampler.place,
                fmt::format("nothing that is drawn reads the sampler `{}`", sampler.name));
    }
}

// An overload counts as called with all that take as many arguments.
void Linter::find_unused_functions() {
    std::set<std::pair<std::size_t, std::string_view>> used;
    for (const PassView& view : views_)
        for (std::size_t i = 0; i < view.reached.size(); ++i)
            if (const Function& function = view.reading.functions[i]; view.reached[i])
                used.insert(
                    {view.reading.place(function.name).begin, view.reading.word(function.name)});
    for (const PassView& view : views_)
        for (const Function& function : view.reading.functions) {
            const std::string_view name = view.reading.word(function.name);
            const std::size_t at = view.reading.place(function.name).begin;
            // The site's entry for headsets.
            if (!function.is_defined() || used.contains({at, name}) || name == "mainVR") continue;
            const Place place = scene_.place_at(at);
            if (!is_own(place)) continue;
            add("unused-function", place,
                fmt::format("nothing that is drawn calls the function `{}`", name));
        }
}

void Linter::find_undescribed() {
    for (const Tweak& tweak : scene_.tweaks)
        if (tweak.description.empty())
            add("undescribed-tweak", tweak.place,
                fmt::format("the tweak `{}` has no description; say behind its //@ in \"quotes\" "
                            "what it does",
                            tweak.name));
}

bool declares(const Reading& reading, std::string_view name) {
    return std::ranges::any_of(reading.declarations, [&](const Declaration& declaration) {
        return std::ranges::any_of(declaration.names, [&](const Declarator& one) {
            return reading.word(one.name) == name;
        });
    });
}

void Linter::look_into_functions() {
    std::unordered_map<std::string_view, double> values;
    for (std::size_t i = 0; i < scene_.tweaks.size(); ++i)
        if (component_count(scene_.tweaks[i].type) == 1)
            values[scene_.tweaks[i].name] = preset_.values[i][0];
    for (const PassView& view : views_) {
        if (declares(view.reading, "iTime"))
            values.erase("iTime");
        else
            values["iTime"] = preset_.time;
        const auto add_all = [&](const std::vector<Finding>& found) {
            for (const Finding& one : found) {
                std::string text = one.text;
                if (one.other) {
                    const Place other = scene_.place_at(*one.other);
                    text += fmt::format(", {}:{}:{}", other.file, other.line, other.column);
                }
                add(one.name, scene_.place_at(one.at), std::move(text));
            }
        };
        add_all(find_shadowed_names(view.reading, view.reached, [](std::string_view name) {
            return find_builtin(name) != nullptr;
        }));
        add_all(find_reserved_names(view.reading, view.reached));
        add_all(find_refused_by_browsers(view.reading, view.reached));
        add_all(find_long_loops(view.reading, view.reached, values));
    }
}

}  // namespace

std::span<const std::string> finding_names() {
    static const std::vector<std::string> names = {
        "unused-function",   "unused-uniform", "unused-pass",        "shadowed-name",
        "undescribed-tweak", "long-loop",      "loop-without-bound", std::string(kWebGl)};
    return names;
}

bool is_of_long_loop(const PlacedFinding& finding) {
    return finding.name == "long-loop" || finding.name == "loop-without-bound";
}

Lint lint(const Preset& preset) {
    return Linter(preset).run();
}

void drop_allowed(const Scene& scene, std::vector<PlacedFinding>& findings) {
    const Reading reading = read_glsl(scene.text, known_of_scene());
    std::set<std::tuple<std::string, int, std::string_view>> allowed;
    for (const Span note : find_notes(reading)) {
        const std::string_view text =
            std::string_view(scene.text).substr(note.begin, note.end - note.begin);
        const auto names = parse_allow(text);
        if (!names) continue;
        const Place place = scene.place_at(note.begin);
        const std::string_view before = std::string_view(scene.text).substr(0, note.begin - 3);
        const std::string_view line = before.substr(before.rfind('\n') + 1);
        const bool is_alone = trimmed(line).empty();
        for (const std::string_view name : *names)
            allowed.insert({place.file, place.line + (is_alone ? 1 : 0), name});
    }
    std::erase_if(findings, [&](const PlacedFinding& one) {
        return allowed.contains({one.place.file, one.place.line, one.name});
    });
    std::ranges::stable_sort(findings, {}, [](const PlacedFinding& one) {
        return std::tuple(one.place.file, one.place.line, one.place.column);
    });
}

}  // namespace glint
