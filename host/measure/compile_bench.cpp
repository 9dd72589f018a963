#include "measure/compile_bench.h"

#include "base/end_signals.h"
#include "base/json_text.h"
#include "base/launch.h"
#include "base/median.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "base/temporary_folder.h"
#include "gl/context.h"
#include "measure/inlining.h"
#include "offline/common.h"
#include "offline/input_files.h"
#include "render/pass_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSize = "160x90";
constexpr int kRounds = 3;
constexpr int kMostFrames = 120;  // until every pass has been drawn, those with long steps too

// The driver keeps what it has compiled here, and nowhere else.
void use_cache(const std::string& folder) {
    for (const char* variable :
         {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "__GL_SHADER_DISK_CACHE_PATH"})
        ::setenv(variable, folder.c_str(), 1);
    for (const char* variable : {"MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DISABLE"})
        ::unsetenv(variable);
    ::setenv("__GL_SHADER_DISK_CACHE", "1", 1);
}

// Milliseconds by pass.
using PassMs = std::map<std::size_t, double>;

CompiledScene compile_timed(const Preset& preset, bool specialise, PassMs& ms) {
    std::optional<std::size_t> compiling;
    Stopwatch clock;
    const auto note = [&](std::size_t next) {
        const double elapsed = clock.restart();
        if (compiling) ms[*compiling] = elapsed;
        compiling = next;
    };
    CompileResult result = compile_scene(preset, {.program = {.specialise = specialise}}, note);
    note(kImagePass);
    report(result.diagnostics);
    if (!result.scene) throw Stop(ExitCode::shader);
    return std::move(*result.scene);
}

// The first draw of every pass; its pixels take their part of it.
PassMs draw_timed(const Preset& preset, Context& context, Renderer& renderer) {
    PassMs ms;
    Stopwatch clock;
    const auto& passes = renderer.graph().passes;
    renderer.after_pass = [&](std::size_t index) {
        context.finish();
        ms.try_emplace(passes[index].pass, clock.ms());
        clock.restart();
    };
    for (int k = 0; k < kMostFrames && ms.size() < passes.size(); ++k) {
        const Playback playback{.end = k / 60.0};
        const Frame frame = playback.frame(preset, playback.last_frame());
        clock.restart();
        renderer.draw(frame);
    }
    renderer.after_pass = nullptr;
    return ms;
}

// Milliseconds of the clock from the text to the first frame, by the way that `still` takes: the
// driver compiles passes side by side where that is worth it.
double ms_to_first_frame(const Preset& preset, bool specialise, Context& context) {
    const Stopwatch clock;
    Renderer renderer(preset, compile_or_stop(preset, {.program = {.specialise = specialise}}),
                      {.size = preset.size});
    load_inputs(preset, renderer);
    renderer.compile_ahead();
    const Playback playback{.end = 0.0};
    renderer.draw(playback.frame(preset, playback.last_frame()));
    context.finish();
    return clock.ms();
}

std::vector<std::string> words_of(const BenchOptions& options, const std::string& cache,
                                  bool together) {
    const ViewOptions& view = options.view;
    std::vector<std::string> words = {"/proc/self/exe", "bench", view.file.string(), "--size",
                                      view.size.empty() ? kSize : view.size};
    for (std::string& word : tweak_words(view)) words.push_back(std::move(word));
    if (!view.device.empty()) words.insert(words.end(), {"--device", view.device});
    if (!view.specialise) words.push_back("--no-specialise");
    words.insert(words.end(), {"--compile-cache", cache});
    if (together) words.push_back("--compile-together");
    return words;
}

// A process that failed is silent, for it is one of twelve: what was wrong is found once more,
// aloud.
[[noreturn]] void explain(const Preset& preset, const BenchOptions& options) {
    const auto context = make_egl_context(options.view.device);
    compile_or_stop(preset, {.program = {.specialise = options.view.specialise}});
    throw std::runtime_error("The process that compiles ended without a result.");
}

// What a process with this cache has measured: passes one by one, or all together.
Json measure(const Preset& preset, const BenchOptions& options, const std::string& cache,
             bool together) {
    const Launched child = launch({.words = words_of(options, cache, together), .output = kPipe});
    if (child.process == 0) throw std::runtime_error("No process could be started to measure in.");
    const std::string text = read_to_end(child.pipe);
    Json json = Json::parse(text, nullptr, false);
    if (wait_for(child.process) != 0 || json.is_discarded()) explain(preset, options);
    return json;
}

// One key of one pass in all rounds.
double median_of(const std::vector<Json>& rounds, std::size_t pass, const char* key) {
    std::vector<double> values;
    for (const Json& round : rounds) values.push_back(round["passes"][pass][key].get<double>());
    return glint::median_of(values);
}

// All passes together: the median of the rounds' sums, each of them one process.
double total_of(const std::vector<Json>& rounds, const char* key) {
    std::vector<double> sums;
    for (const Json& round : rounds) {
        double& sum = sums.emplace_back(0.0);
        for (const Json& pass : round["passes"]) sum += pass[key].get<double>();
    }
    return glint::median_of(sums);
}

// With the driver's cache empty, and full.
struct Rounds {
    std::vector<Json> cold, warm;
};

double together_of(const std::vector<Json>& rounds) {
    std::vector<double> values;
    for (const Json& round : rounds) values.push_back(round["together_ms"].get<double>());
    return glint::median_of(values);
}

Json total_json(const Json& passes, const Rounds& alone, const Rounds& together) {
    std::size_t words = 0;
    for (const Json& pass : passes)
        if (pass["words"].is_number()) words += pass["words"].get<std::size_t>();
    const bool all = std::all_of(passes.begin(), passes.end(),
                                 [](const Json& pass) { return pass["words"].is_number(); });
    return {{"cold_ms", total_of(alone.cold, "compile_ms")},
            {"warm_ms", total_of(alone.warm, "compile_ms")},
            {"first_draw_ms", total_of(alone.cold, "first_draw_ms")},
            {"first_draw_warm_ms", total_of(alone.warm, "first_draw_ms")},
            {"together_ms", together_of(together.cold)},
            {"together_warm_ms", together_of(together.warm)},
            {"words", all ? Json(words) : Json()}};
}

Json passes_json(const Preset& preset, bool specialise, const Rounds& rounds) {
    const auto& [cold, warm] = rounds;
    Json list = Json::array();
    for (std::size_t i = 0; i < cold.front()["passes"].size(); ++i) {
        const std::string name = cold.front()["passes"][i]["name"];
        std::string why_not;
        const PassText text =
            pass_text(preset, find_pass(preset.scene, name), {.specialise = specialise});
        const auto size = program_size(text.text, why_not);
        list.push_back({{"name", name},
                        {"cold_ms", median_of(cold, i, "compile_ms")},
                        {"warm_ms", median_of(warm, i, "compile_ms")},
                        {"first_draw_ms", median_of(cold, i, "first_draw_ms")},
                        {"first_draw_warm_ms", median_of(warm, i, "first_draw_ms")},
                        {"words", size ? Json(size->words) : Json()}});
        if (!size) list.back()["why_no_words"] = why_not;
    }
    return list;
}

void print_row(const std::string& name, const Json& times) {
    const Json& words = times["words"];
    say_result("{:<22} {:>7.1f} ms {:>8.1f} ms {:>7.1f} ms {:>8.1f} ms {:>10}\n", name,
               times["cold_ms"].get<double>(), times["first_draw_ms"].get<double>(),
               times["warm_ms"].get<double>(), times["first_draw_warm_ms"].get<double>(),
               words.is_null() ? "-" : fmt::format("{}", words.get<std::size_t>()));
}

void print_compile_table(const Json& json) {
    say_result("{}, {}x{}, {}, medians of {} rounds\n", json["renderer"].get<std::string>(),
               json["size"][0].get<int>(), json["size"][1].get<int>(),
               json["specialised"] ? "specialised" : "uniform-fed", json["rounds"].get<int>());
    say_result("{:<22} {:>22} {:>22} {:>10}\n", "", "cache empty", "cache full", "");
    say_result("{:<22} {:>10} {:>11} {:>10} {:>11} {:>10}\n", "pass", "compile", "first draw",
               "compile", "first draw", "words");
    for (const Json& pass : json["passes"]) print_row(pass["name"].get<std::string>(), pass);
    const Json& total = json["total"];
    print_row("all passes", total);
    say_result("{:<22} {:>22.1f} ms {:>19.1f} ms\n", "side by side, clock",
               total["together_ms"].get<double>(), total["together_warm_ms"].get<double>());
}

// With caches that are gone afterwards, whatever ends it: the signal that did, or 0.
int measure_rounds(const Preset& preset, const BenchOptions& options, Rounds& alone,
                   Rounds& together) {
    const EndSignals ended;
    const TemporaryFolder scratch;
    Progress progress("rounds", kRounds);
    try {
        for (int round = 0; round < kRounds && ended.arrived() == 0; ++round) {
            for (Rounds* rounds : {&alone, &together}) {
                const bool all = rounds == &together;
                const auto cache = scratch.path() / fmt::format("{}{}", all ? "all" : "one", round);
                make_folder(cache);
                rounds->cold.push_back(measure(preset, options, cache.string(), all));
                rounds->warm.push_back(measure(preset, options, cache.string(), all));
            }
            progress.update(round + 1);
        }
    } catch (...) {  // the signal may have ended what is waited for
        if (ended.arrived() == 0) throw;
    }
    return ended.arrived();
}

}  // namespace

void run_compile_once(const BenchOptions& options) {
    use_cache(options.compile_cache.string());
    const Preset preset = open_preset(options.view);
    const auto context = make_egl_context(options.view.device);
    if (options.compile_together) {
        const double ms = ms_to_first_frame(preset, options.view.specialise, *context);
        say_result("{}\n", json_text(Json{{"together_ms", ms}}));
        return;
    }
    PassMs compile_ms;
    Renderer renderer(preset, compile_timed(preset, options.view.specialise, compile_ms),
                      {.size = preset.size});
    load_inputs(preset, renderer);
    context->finish();
    PassMs first_draw_ms = draw_timed(preset, *context, renderer);
    Json json = {{"renderer", context->renderer()}, {"passes", Json::array()}};
    for (const GraphPass& pass : renderer.graph().passes)
        json["passes"].push_back({{"name", pass_name(preset.scene, pass.pass)},
                                  {"compile_ms", compile_ms[pass.pass]},
                                  {"first_draw_ms", first_draw_ms[pass.pass]}});
    say_result("{}\n", json_text(json));
}

void run_compile_bench(const BenchOptions& options) {
    ViewOptions view = options.view;
    if (view.size.empty()) view.size = kSize;
    const Preset preset = open_preset(view);
    Rounds alone, together;
    if (const int signal = measure_rounds(preset, options, alone, together)) end_by(signal);
    const Json passes = passes_json(preset, options.view.specialise, alone);
    const Json json = {
        {"scene", options.view.file.string()},         {"renderer", alone.cold.front()["renderer"]},
        {"size", {preset.size.x, preset.size.y}},      {"rounds", kRounds},
        {"specialised", options.view.specialise},      {"passes", passes},
        {"total", total_json(passes, alone, together)}};
    if (options.view.json)
        say_result("{}\n", json_text(json));
    else
        print_compile_table(json);
}

}  // namespace glint
