// `glint info`: what a scene consists of, and what was left out.

#include "base/json_text.h"
#include "base/readable_file.h"
#include "base/say.h"
#include "base/workers.h"
#include "gl/context.h"
#include "measure/inlining.h"
#include "measure/second_opinion.h"
#include "render/buffer.h"
#include "render/own_words.h"
#include "scene/lint.h"
#include "scene/scene_text.h"
#include "verbs/options.h"
#include "verbs/verb.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    ViewOptions view;
    std::string source;  // print the GLSL text that the driver sees for this pass instead
};

struct LeftOut {
    std::string what, why;
};

// Both forms of a scene: with uniforms it shows what could be read, specialised what is.
struct Inspection {
    const Preset& preset;
    CompiledScene uniform_fed, specialised;
    std::optional<CompiledScene> heard, heard_specialised;  // of a scene with a sound
};

// Whether this is so of the picture or of the sound.
bool holds(const CompiledScene& picture, const std::optional<CompiledScene>& sound,
           const std::function<bool(const CompiledScene&)>& is_so) {
    return is_so(picture) || (sound && is_so(*sound));
}

bool contains_pass(const CompiledScene& scene, std::size_t pass) {
    return std::ranges::any_of(scene.programs,
                               [&](const PassProgram& program) { return program.pass == pass; });
}

bool reads_sampler(const CompiledScene& scene, std::size_t sampler) {
    return std::ranges::any_of(scene.programs, [&](const PassProgram& program) {
        return std::ranges::any_of(program.samplers,
                                   [&](const SamplerUniform& u) { return u.sampler == sampler; });
    });
}

bool reads_tweak(const CompiledScene& scene, std::size_t tweak) {
    return std::ranges::any_of(scene.programs, [&](const PassProgram& program) {
        return std::ranges::any_of(program.tweaks,
                                   [&](const TweakUniform& u) { return u.tweak == tweak; });
    });
}

const char* why(bool possible) {
    return possible ? "these tweak values switch off all that reads it" : "nothing reads it";
}

std::vector<LeftOut> left_out(const Inspection& seen) {
    const Scene& scene = seen.preset.scene;
    const auto could = [&](const auto& is_so) {
        return holds(seen.uniform_fed, seen.heard, is_so);
    };
    const auto does = [&](const auto& is_so) {
        return holds(seen.specialised, seen.heard_specialised, is_so);
    };
    std::vector<LeftOut> list;
    for (std::size_t i = 0; i < scene.passes.size(); ++i) {
        const auto is_drawn = [&](const CompiledScene& of) { return contains_pass(of, i); };
        if (!does(is_drawn)) list.push_back({"pass " + scene.passes[i].name, why(could(is_drawn))});
    }
    for (std::size_t i = 0; i < sampler_count(seen.preset); ++i) {
        const Sampler& sampler = sampler_at(seen.preset, i);
        if (sampler.source == Source::none || sampler.source == Source::buffer) continue;
        const auto is_read = [&](const CompiledScene& of) { return reads_sampler(of, i); };
        if (!does(is_read)) list.push_back({"sampler " + sampler.name, why(could(is_read))});
    }
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i) {
        const auto is_read = [&](const CompiledScene& of) { return reads_tweak(of, i); };
        if (!could(is_read)) list.push_back({"tweak " + scene.tweaks[i].name, "nothing reads it"});
    }
    for (const GraphPass& pass : seen.specialised.graph.passes) {
        if (pass.pass == kImagePass || pass.feedback) continue;
        list.push_back(
            {"second buffer of " + scene.passes[pass.pass].name, "it does not read itself back"});
    }
    return list;
}

Json tweak_value(const Tweak& tweak, const TweakValue& value) {
    const auto component = [&](double v) -> Json {
        if (tweak.type == TweakType::bool1) return v != 0.0;
        if (tweak.type == TweakType::int1) return static_cast<long>(v);
        return v;
    };
    const int count = component_count(tweak.type);
    if (count == 1) return component(value[0]);
    Json list = Json::array();
    for (int i = 0; i < count; ++i) list.push_back(component(value[static_cast<std::size_t>(i)]));
    return list;
}

Json tweak_json(const Tweak& tweak, const TweakValue& value) {
    const auto optional = [](const std::optional<double>& v) { return v ? Json(*v) : Json(); };
    Json json = {{"name", tweak.name},
                 {"type", glsl_name(tweak.type)},
                 {"default", tweak_value(tweak, tweak.initial)},
                 {"value", tweak_value(tweak, value)},
                 {"min", optional(tweak.min)},
                 {"max", optional(tweak.max)},
                 {"quality", tweak.quality},
                 {"reference", tweak.reference ? tweak_value(tweak, *tweak.reference) : Json()},
                 {"second", tweak.second.empty() ? Json() : Json(tweak.second)},
                 {"group", tweak.group},
                 {"unit", tweak.unit},
                 {"description", tweak.description}};
    if (!tweak.names.empty()) json["names"] = tweak.names;
    return json;
}

Json pass_json(const Inspection& seen, const PassProgram& program, const GraphPass& graph) {
    const Scene& scene = seen.preset.scene;
    Json reads = Json::array();
    for (const SamplerUniform& u : program.samplers) {
        if (sampler_at(seen.preset, u.sampler).source != Source::none) {
            reads.push_back(sampler_at(seen.preset, u.sampler).name);
        }
    }
    const bool image = program.pass == kImagePass;
    const Pass* pass = image ? nullptr : &scene.passes[program.pass];
    const BufferShape shape =
        image ? BufferShape{.size = seen.preset.size, .format = PixelFormat::rgba8}
              : shape_of(*pass, seen.preset.size, graph.feedback);
    return {{"name", pass_name(scene, program.pass)},
            {"entry", image ? scene.image_entry : pass->entry},
            {"samplers", image ? Json::array() : Json(pass->outputs)},
            {"size", {shape.size.x, shape.size.y}},
            {"format", name_of(shape.format)},
            {"bytes", byte_count(shape)},
            {"feedback", graph.feedback},
            {"reads", reads},
            {"runs", to_string(graph.runs)},
            {"step", pass && pass->step ? Json(pass->step.seconds()) : Json()}};
}

Json inspect(const Inspection& seen) {
    const Scene& scene = seen.preset.scene;
    Json json = {{"scene", scene.files.front().string()},
                 {"passes", Json::array()},
                 {"tweaks", Json::array()},
                 {"uniforms", Json::array()},
                 {"left_out", Json::array()}};
    const auto& graph = seen.specialised.graph.passes;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        json["passes"].push_back(pass_json(seen, seen.specialised.programs[i], graph[i]));
    }
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i) {
        json["tweaks"].push_back(tweak_json(scene.tweaks[i], seen.preset.values[i]));
    }
    std::set<std::string> uniforms;
    for (const PassProgram& program : seen.uniform_fed.programs) {
        for (const BuiltinUniform& u : program.builtins) uniforms.insert(u.name);
        for (const TweakUniform& u : program.tweaks) uniforms.insert(scene.tweaks[u.tweak].name);
    }
    json["uniforms"] = uniforms;
    for (const LeftOut& item : left_out(seen)) {
        json["left_out"].push_back({{"what", item.what}, {"why", item.why}});
    }
    json["stateful"] = seen.specialised.graph.stateful;
    json["sound"] = scene.has_sound;
    return json;
}

double inlined_tokens_of(const Scene& scene, std::size_t pass) {
    const Reading reading = read_glsl(scene.text, known_of_pass(output_names(scene, pass)));
    return inlined_tokens(reading, entry_of(scene, pass));
}

// The passes that are largest as they are written: looking into each of a dozen takes a second.
std::vector<std::size_t> largest_passes(const Preset& preset, const CompiledScene& compiled) {
    constexpr std::size_t kMost = 4;
    std::vector<std::pair<double, std::size_t>> sizes;
    for (const PassProgram& program : compiled.programs)
        sizes.emplace_back(inlined_tokens_of(preset.scene, program.pass), program.pass);
    std::ranges::stable_sort(sizes, std::greater(), &std::pair<double, std::size_t>::first);
    std::vector<std::size_t> passes;
    for (const auto& [size, pass] : sizes)
        if (passes.size() < kMost) passes.push_back(pass);
    return passes;
}

// The function of these passes whose copies cost most: as many at a time as there are processors.
Json costliest_copies(const Preset& preset, const std::vector<std::size_t>& passes,
                      bool specialise) {
    std::vector<std::optional<ProgramSize>> sizes(passes.size());
    std::vector<std::string> why_not(passes.size());
    Workers workers(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
    for (std::size_t i = 0; i < passes.size(); ++i)
        workers.run([&, i] {
            const PassText text = pass_text(preset, passes[i], {.specialise = specialise});
            sizes[i] = program_size(text.text, why_not[i]);
        });
    workers.finish();
    Json worst = {{"function", nullptr}};
    std::size_t most = 0;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!sizes[i]) worst["why_not"] = why_not[i];
        if (!sizes[i] || sizes[i]->functions.empty()) continue;
        const InlinedFunction& function = sizes[i]->functions.front();
        if (function.saved_by_one_call() <= most) continue;
        most = function.saved_by_one_call();
        worst = {{"function", in_own_words(function.name)},
                 {"pass", pass_name(preset.scene, passes[i])},
                 {"copies", function.copies},
                 {"words", function.words},
                 {"program_words", sizes[i]->words},
                 {"saved_by_one_call", most}};
    }
    return worst;
}

void print_copies(const Json& worst) {
    say_result("\ncopies: drivers compile a function once for each of its calls\n");
    if (worst["function"].is_null())
        return say_result("  {}\n", worst.contains("why_not") ? worst["why_not"].get<std::string>()
                                                              : "none is called twice");
    say_result(
        "  the costliest: {} in {}, {} copies of {} SPIR-V words; of all {} words one call site "
        "would save {}\n",
        worst["function"].get<std::string>(), worst["pass"].get<std::string>(),
        worst["copies"].get<std::size_t>(), worst["words"].get<std::size_t>(),
        worst["program_words"].get<std::size_t>(), worst["saved_by_one_call"].get<std::size_t>());
}

// The scene's, and what the validator says of the passes that it needs and its sound.
void add_findings(const Inspection& seen, Json& json) {
    Lint found = lint(seen.preset);
    std::vector<std::size_t> passes;
    for (const PassProgram& program : seen.specialised.programs) passes.push_back(program.pass);
    if (seen.preset.scene.has_sound) passes.push_back(kSoundPass);
    SecondOpinion second = second_opinion(seen.preset, passes);
    std::ranges::move(second.findings, std::back_inserter(found.findings));
    drop_allowed(seen.preset.scene, found.findings);
    json["findings"] = Json::array();
    for (const PlacedFinding& one : found.findings)
        json["findings"].push_back({{"name", one.name},
                                    {"file", one.place.file},
                                    {"line", one.place.line},
                                    {"column", one.place.column},
                                    {"text", one.text}});
    json["not_looked_into"] = Json::array();
    const auto leave_out = [&](const Place& place, const std::string& why) {
        json["not_looked_into"].push_back(
            {{"file", place.file}, {"line", place.line}, {"column", place.column}, {"why", why}});
    };
    for (const Unread& one : found.unread)
        leave_out(one.place,
                  "the text is not understood here, so nothing is said of it: " + one.why);
    if (!second.why_none.empty())
        leave_out({seen.preset.scene.files.front().string()},
                  "nothing is said of what WebGL 2 refuses: " + second.why_none);
}

std::string placed(const Json& one, std::string_view text) {
    return to_string(
        {Severity::warning, {one["file"], one["line"], one["column"]}, std::string(text)});
}

void print_findings(const Json& json) {
    constexpr std::size_t kMostOfAKind = 8;
    say_result("\nfindings\n");
    std::map<std::string, std::size_t> count;
    for (const Json& one : json["findings"]) {
        const std::string name = one["name"];
        if (++count[name] <= kMostOfAKind)
            say_result("  {} [{}]\n", placed(one, one["text"].get<std::string>()), name);
    }
    for (const auto& [name, number] : count)
        if (number > kMostOfAKind)
            say_result("  and {} more [{}]; --json lists all\n", number - kMostOfAKind, name);
    for (const Json& one : json["not_looked_into"])
        say_result("  {}\n", placed(one, one["why"].get<std::string>()));
    if (json["findings"].empty() && json["not_looked_into"].empty()) say_result("  none\n");
}

// "[0, 1] m", or the names of a menu.
std::string values_of(const Tweak& tweak) {
    if (!tweak.names.empty()) return fmt::format("{{{}}}", fmt::join(tweak.names, ", "));
    if (!tweak.min) return tweak.unit;
    return fmt::format("[{}, {}] {}", *tweak.min, *tweak.max, tweak.unit);
}

std::string joined(const Json& list) {
    std::string text;
    for (const auto& item : list) text += (text.empty() ? "" : ", ") + item.get<std::string>();
    return text.empty() ? "nothing" : text;
}

void print_tables(const Inspection& seen, const Json& json) {
    say_result("scene {}\n\npasses\n", json["scene"].get<std::string>());
    for (const Json& pass : json["passes"]) {
        say_result("  {:<16} {:<16} {:>5}x{:<5} {:<8} {}{}, reads {}\n",
                   pass["name"].get<std::string>(), pass["entry"].get<std::string>(),
                   pass["size"][0].get<int>(), pass["size"][1].get<int>(),
                   pass["format"].get<std::string>(), pass["runs"].get<std::string>(),
                   pass["feedback"] ? ", feedback" : "", joined(pass["reads"]));
    }
    if (seen.preset.scene.has_sound) say_result("  {:<16} mainSound\n", "sound");
    say_result("\ntweaks\n");
    for (std::size_t i = 0; i < seen.preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = seen.preset.scene.tweaks[i];
        say_result("  {:<20} {:<6} {:<14} {:<18} {}\n", tweak.name, glsl_name(tweak.type),
                   format_value(tweak, seen.preset.values[i]), values_of(tweak), tweak.description);
    }
    if (seen.preset.scene.tweaks.empty()) say_result("  none\n");
    say_result("\nleft out\n");
    for (const Json& item : json["left_out"]) {
        say_result("  {:<32} {}\n", item["what"].get<std::string>(),
                   item["why"].get<std::string>());
    }
    if (json["left_out"].empty()) say_result("  nothing\n");
    print_copies(json["copies"]);
    print_findings(json);
}

// Of what is read and not here, though the text is right.
Diagnostics missing_files(const Inspection& seen) {
    Diagnostics missing;
    for (std::size_t i = 0; i < sampler_count(seen.preset); ++i) {
        const auto is_read = [&](const CompiledScene& of) { return reads_sampler(of, i); };
        if (!holds(seen.specialised, seen.heard_specialised, is_read)) continue;
        const Sampler& sampler = sampler_at(seen.preset, i);
        try {
            for (const auto& file : sampler.files) require_readable(file);
        } catch (const std::runtime_error& error) {
            missing.push_back({Severity::error, sampler.place, error.what(), true});
        }
    }
    return missing;
}

void run_info(const InfoOptions& options, const Stopwatch&) {
    const Preset preset = open_preset(options.view);
    if (!options.source.empty()) {
        const std::size_t pass = find_pass(preset.scene, options.source, true);
        say_result("{}", pass_text(preset, pass, {.specialise = options.view.specialise}).text);
        return;
    }
    const auto context = make_egl_context(options.view.device);
    const auto compiled = [&](std::size_t root, bool specialise) {
        return compile_or_stop(preset, {.root = root, .program = {.specialise = specialise}});
    };
    Inspection seen{.preset = preset,
                    .uniform_fed = compiled(kImagePass, false),
                    .specialised = compiled(kImagePass, options.view.specialise),
                    .heard = {},
                    .heard_specialised = {}};
    if (preset.scene.has_sound) {
        seen.heard = compiled(kSoundPass, false);
        seen.heard_specialised = compiled(kSoundPass, options.view.specialise);
    }
    Json json = inspect(seen);
    json["renderer"] = context->renderer();
    json["copies"] =
        costliest_copies(preset, largest_passes(preset, seen.specialised), options.view.specialise);
    add_findings(seen, json);
    if (options.view.json)
        say_result("{}\n", json_text(json));
    else
        print_tables(seen, json);
    report(missing_files(seen));
}

void declare(CLI::App& verb, InfoOptions& info) {
    add_view(verb, info.view);
    verb.add_option("--source", info.source, "print the GLSL that the driver sees for a pass")
        ->type_name(kPass)
        ->excludes("--json");
    add_examples(verb, {"glint info presets/christmas.toml",
                        "glint info presets/water.toml --source image"});
}

}  // namespace

std::unique_ptr<Verb> info_verb() {
    return make_verb<InfoOptions>(declare, run_info);
}

}  // namespace glint
