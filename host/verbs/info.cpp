// `glint info`: what a scene consists of, and what was left out.

#include "base/json_text.h"
#include "base/say.h"
#include "base/workers.h"
#include "gl/context.h"
#include "measure/inlining.h"
#include "verbs/options.h"
#include "verbs/verb.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <thread>

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
};

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
    std::vector<LeftOut> list;
    for (std::size_t i = 0; i < scene.passes.size(); ++i) {
        if (contains_pass(seen.specialised, i)) continue;
        list.push_back({"pass " + scene.passes[i].name, why(contains_pass(seen.uniform_fed, i))});
    }
    for (std::size_t i = 0; i < sampler_count(seen.preset); ++i) {
        const Sampler& sampler = sampler_at(seen.preset, i);
        if (sampler.source == Source::none || sampler.source == Source::buffer) continue;
        if (reads_sampler(seen.specialised, i)) continue;
        list.push_back({"sampler " + sampler.name, why(reads_sampler(seen.uniform_fed, i))});
    }
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i) {
        if (reads_tweak(seen.uniform_fed, i)) continue;
        list.push_back({"tweak " + scene.tweaks[i].name, "nothing reads it"});
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
    const glm::ivec2 size = image ? seen.preset.size : buffer_size(*pass, seen.preset.size);
    return {{"name", pass_name(scene, program.pass)},
            {"entry", image ? scene.image_entry : pass->entry},
            {"samplers", image ? Json::array() : Json(pass->outputs)},
            {"size", {size.x, size.y}},
            {"format", kFormatNames.of(image ? PixelFormat::rgba8 : pass->format)},
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

// The function of all passes whose copies cost most. Every pass has the whole text to go through:
// as many at a time as there are processors.
Json costliest_copies(const Preset& preset, const CompiledScene& compiled, bool specialise) {
    const auto& programs = compiled.programs;
    std::vector<std::optional<ProgramSize>> sizes(programs.size());
    std::vector<std::string> why_not(programs.size());
    Workers workers(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
    for (std::size_t i = 0; i < programs.size(); ++i)
        workers.run([&, i] {
            const PassText text = pass_text(preset, programs[i].pass, {.specialise = specialise});
            sizes[i] = program_size(text.text, why_not[i]);
        });
    workers.finish();
    Json worst = {{"function", nullptr}};
    std::size_t most = 0;
    for (std::size_t i = 0; i < programs.size(); ++i) {
        if (!sizes[i]) worst["why_not"] = why_not[i];
        if (!sizes[i] || sizes[i]->functions.empty()) continue;
        const InlinedFunction& function = sizes[i]->functions.front();
        if (function.saved_by_one_call() <= most) continue;
        most = function.saved_by_one_call();
        worst = {
            {"function", function.name},        {"pass", pass_name(preset.scene, programs[i].pass)},
            {"copies", function.copies},        {"words", function.words},
            {"program_words", sizes[i]->words}, {"saved_by_one_call", most}};
    }
    return worst;
}

void print_copies(const Json& worst) {
    say_result("\ncopies that drivers make of a function, one a call\n");
    if (worst["function"].is_null())
        return say_result("  {}\n", worst.contains("why_not") ? worst["why_not"].get<std::string>()
                                                              : "none is called twice");
    say_result(
        "  the costliest: {}, {} of {} words each, in {} of {} words; one call site would save "
        "{}\n",
        worst["function"].get<std::string>(), worst["copies"].get<std::size_t>(),
        worst["words"].get<std::size_t>(), worst["pass"].get<std::string>(),
        worst["program_words"].get<std::size_t>(), worst["saved_by_one_call"].get<std::size_t>());
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
    say_result("\ntweaks\n");
    for (std::size_t i = 0; i < seen.preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = seen.preset.scene.tweaks[i];
        say_result(
            "  {:<20} {:<6} {:<14} {:<18} {}\n", tweak.name, glsl_name(tweak.type),
            format_value(tweak, seen.preset.values[i]),
            tweak.min ? fmt::format("[{}, {}] {}", *tweak.min, *tweak.max, tweak.unit) : tweak.unit,
            tweak.description);
    }
    say_result("\nleft out\n");
    for (const Json& item : json["left_out"]) {
        say_result("  {:<32} {}\n", item["what"].get<std::string>(),
                   item["why"].get<std::string>());
    }
    print_copies(json["copies"]);
}

void run_info(const InfoOptions& options, const Stopwatch&) {
    const Preset preset = open_preset(options.view);
    if (!options.source.empty()) {
        const bool sound = options.source == "sound" && preset.scene.has_sound;
        const std::size_t pass = sound ? kSoundPass : find_pass(preset.scene, options.source);
        say_result("{}", pass_text(preset, pass, {.specialise = options.view.specialise}).text);
        return;
    }
    const auto context = make_egl_context(options.view.device);
    Diagnostics told;  // by one form, and not again by the other
    const Inspection seen{
        .preset = preset,
        .uniform_fed = compile_or_stop(preset, {.program = {.specialise = false}}, &told),
        .specialised =
            compile_or_stop(preset, {.program = {.specialise = options.view.specialise}}, &told)};
    Json json = inspect(seen);
    json["renderer"] = context->renderer();
    json["copies"] = costliest_copies(preset, seen.specialised, options.view.specialise);
    if (options.view.json)
        say_result("{}\n", json_text(json));
    else
        print_tables(seen, json);
}

void declare(CLI::App& verb, InfoOptions& info) {
    add_view(verb, info.view);
    verb.add_option("--source", info.source, "print the GLSL that the driver sees for a pass");
    add_examples(verb, {"glint info presets/christmas.toml",
                        "glint info presets/water.toml --source image"});
}

}  // namespace

std::unique_ptr<Verb> info_verb() {
    return std::make_unique<VerbWith<InfoOptions>>(declare, run_info);
}

}  // namespace glint
