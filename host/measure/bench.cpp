#include "measure/bench.h"

#include "base/json_text.h"
#include "base/process_time.h"
#include "base/say.h"
#include "gl/context.h"
#include "offline/common.h"
#include "offline/input_files.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const double at = q * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const auto above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], at - static_cast<double>(below));
}

Json summary(const std::vector<double>& ms) {
    return {{"median", quantile(ms, 0.5)}, {"p95", quantile(ms, 0.95)}, {"min", quantile(ms, 0.0)}};
}

// Of one pass, each time that it was drawn.
struct PassTimes {
    std::vector<double> wall_ms, processor_ms;
};

// A scene that is played in real frames of 1/60 s from the preset's time on.
class Subject {
public:
    Subject(const Preset& preset, Context& context, bool specialise)
        : preset_(preset),
          context_(context),
          renderer_(preset, compile_or_stop(preset, {.program = {.specialise = specialise}}),
                    {.size = preset.size}) {
        load_inputs(preset, renderer_);
        renderer_.compile_ahead();
        int ignored = 0;
        play(preset, renderer_, playback(), 0, ignored);
        // The driver compiles to machine code at the first draw.
        for (int warm_up = 0; warm_up < 3; ++warm_up) draw();
        frame_ms.clear();
        processor_ms.clear();
        host_ms.clear();
    }

    // One frame, waited for by the clock on the wall: timer queries lie on software renderers.
    void draw() {
        const Frame frame = next_frame();
        renderer_.redraw();
        renderer_.draw_call_seconds = 0.0;
        const double processor_before = own_processor_ms();
        Stopwatch clock;
        renderer_.draw(frame);
        const double submitted = clock.ms();
        context_.finish();
        frame_ms.push_back(clock.ms());
        processor_ms.push_back(own_processor_ms() - processor_before);
        host_ms.push_back(submitted - renderer_.draw_call_seconds * 1000.0);
    }

    // As draw(), but waits after every pass, so that each can be told apart.
    void draw_passes(std::vector<PassTimes>& times) {
        times.resize(renderer_.graph().passes.size());
        Stopwatch clock;
        double processor_before = 0.0;
        renderer_.after_pass = [&](std::size_t pass) {
            context_.finish();
            const double processor = own_processor_ms();
            times[pass].wall_ms.push_back(clock.restart());
            times[pass].processor_ms.push_back(processor - processor_before);
            processor_before = processor;
        };
        const Frame frame = next_frame();
        renderer_.redraw();
        clock.restart();
        processor_before = own_processor_ms();
        renderer_.draw(frame);
        renderer_.after_pass = nullptr;
    }

    const PassGraph& graph() const { return renderer_.graph(); }
    std::size_t buffer_bytes(std::size_t i) const { return renderer_.buffer(i).byte_count(); }

    // One a frame: by the clock on the wall, on all processors together, beside the draw calls.
    std::vector<double> frame_ms, processor_ms, host_ms;

private:
    Playback playback() const { return {.end = preset_.time}; }

    Frame next_frame() {
        const Playback later{.end = preset_.time + ++drawn_ / 60.0};
        return later.frame(preset_, later.last_frame());
    }

    const Preset& preset_;
    Context& context_;
    Renderer renderer_;
    int drawn_ = 0;
};

Json passes_json(const Preset& preset, Subject& subject, int frames) {
    std::vector<PassTimes> times;
    for (int i = 0; i < frames; ++i) subject.draw_passes(times);
    Json list = Json::array();
    for (std::size_t i = 0; i < times.size(); ++i) {
        const GraphPass& pass = subject.graph().passes[i];
        list.push_back({{"name", pass_name(preset.scene, pass.pass)},
                        {"ms", quantile(times[i].wall_ms, 0.5)},
                        {"processor_ms", quantile(times[i].processor_ms, 0.5)},
                        {"drawn", times[i].wall_ms.size()},
                        {"frames", frames},
                        {"bytes", subject.buffer_bytes(i)},
                        {"runs", to_string(pass.runs)}});
    }
    return list;
}

void print_table(const Json& json) {
    say_result("{}, {}x{}, {} frames, {}\n", json["renderer"].get<std::string>(),
               json["size"][0].get<int>(), json["size"][1].get<int>(), json["frames"].get<int>(),
               json["specialised"] ? "specialised" : "uniform-fed");
    const Json& ms = json["ms"];
    say_result("frame  median {:.3f} ms  p95 {:.3f} ms  min {:.3f} ms   host {:.3f} ms\n",
               ms["median"].get<double>(), ms["p95"].get<double>(), ms["min"].get<double>(),
               json["host_ms"].get<double>());
    for (const Json& pass : json["passes"]) {
        const double once = pass["ms"].get<double>();
        const double a_frame = pass["drawn"].get<double>() / pass["frames"].get<double>();
        const std::string often =
            a_frame == 0.0  ? ", not in these frames"
            : a_frame > 1.0 ? fmt::format(", {:.3g} a frame of {:.3f} ms each", a_frame, once)
                            : "";
        say_result("  {:<20} {:>9.3f} ms  {}{}\n", pass["name"].get<std::string>(),
                   once * std::max(a_frame, 1.0), pass["runs"].get<std::string>(), often);
    }
    if (json.contains("uniform_ms")) {
        say_result("uniform-fed  median {:.3f} ms: {:.2f} times the specialised frame\n",
                   json["uniform_ms"]["median"].get<double>(), json["ratio"].get<double>());
    }
}

}  // namespace

void run_bench(const BenchOptions& options) {
    if (options.compare && !options.view.specialise) {
        throw UsageError("--compare needs both forms; leave --no-specialise out.");
    }
    const Preset preset = open_preset(options.view);
    const auto context = make_egl_context(options.view.device);
    Subject subject(preset, *context, options.view.specialise);
    std::optional<Subject> uniform_fed;
    if (options.compare) uniform_fed.emplace(preset, *context, false);

    Progress progress("frames", options.frames);
    for (int i = 0; i < options.frames; ++i) {
        subject.draw();
        if (uniform_fed) uniform_fed->draw();
        progress.update(i);
    }
    Json json = {{"scene", preset.file.string()},
                 {"renderer", context->renderer()},
                 {"clock", "wall, after glFinish"},
                 {"size", {preset.size.x, preset.size.y}},
                 {"frames", options.frames},
                 {"ms", summary(subject.frame_ms)},
                 {"processor_ms", summary(subject.processor_ms)},
                 {"host_ms", quantile(subject.host_ms, 0.5)},
                 {"passes", passes_json(preset, subject, std::min(options.frames, 20))},
                 {"specialised", options.view.specialise}};
    if (uniform_fed) {
        json["uniform_ms"] = summary(uniform_fed->frame_ms);
        json["ratio"] = quantile(uniform_fed->frame_ms, 0.5) / quantile(subject.frame_ms, 0.5);
    }
    if (options.view.json)
        say_result("{}\n", json_text(json));
    else
        print_table(json);
}

}  // namespace glint
