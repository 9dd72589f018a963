#include "measure/study/measure.h"

#include "base/process_time.h"
#include "offline/common.h"
#include "offline/input_files.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace glint {
namespace {

constexpr int kWarmUp = 3;     // frames: the driver compiles to machine code at the first draw
constexpr int kAllPasses = 3;  // frames in which every pass is drawn

// GPU time between begin and end, in ms; waits for the result.
class TimerQuery {
public:
    TimerQuery() { glCreateQueries(GL_TIME_ELAPSED, 1, &id_); }
    ~TimerQuery() { glDeleteQueries(1, &id_); }
    TimerQuery(const TimerQuery&) = delete;
    TimerQuery& operator=(const TimerQuery&) = delete;

    void begin() { glBeginQuery(GL_TIME_ELAPSED, id_); }
    void end() { glEndQuery(GL_TIME_ELAPSED); }
    double ms() const {
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(id_, GL_QUERY_RESULT, &nanoseconds);
        return static_cast<double>(nanoseconds) * 1e-6;
    }

private:
    GLuint id_ = 0;
};

Timing timing_of(std::vector<double> ms, double frames) {
    if (ms.empty()) return {};
    std::sort(ms.begin(), ms.end());
    const double median = (ms[(ms.size() - 1) / 2] + ms[ms.size() / 2]) / 2.0;
    return {.median = median * frames, .min = ms.front() * frames, .max = ms.back() * frames};
}

// A scene with its setting, as a still would draw it.
class Subject {
public:
    Subject(const Preset& preset, const Setting& setting, Context& context,
            const MeasureOptions& options)
        : preset_(with(preset, setting)),
          context_(context),
          options_(options),
          renderer_(preset_,
                    compile_or_stop(preset_, {.root = options.pass,
                                              .program = {.specialise = options.specialise}}),
                    {.size = preset_.size, .picture_format = PixelFormat::rgba32f}) {
        load_inputs(preset_, renderer_);
    }

    std::vector<float> draw_picture() {
        int ignored = 0;
        renderer_.draw(play(preset_, renderer_, {.end = preset_.time}, preset_.settle, ignored));
        context_.finish();
        return renderer_.read_floats(options_.output);
    }

    // Frames that go on at 60 Hz, or, for one that settles, with time held.
    void time_frames(Measured& result) {
        std::vector<double> wall, gpu, processor;
        TimerQuery query;
        for (int i = 0; i < kWarmUp + options_.frames; ++i) {
            const Frame frame = next_frame();
            renderer_.redraw();
            const double processor_before = own_processor_ms();
            const Stopwatch clock;
            query.begin();
            renderer_.draw(frame);
            query.end();
            context_.finish();
            const double ms = clock.ms();
            if (i < kWarmUp) continue;
            wall.push_back(ms);
            gpu.push_back(query.ms());
            processor.push_back(own_processor_ms() - processor_before);
        }
        const double frames = preset_.settle + 1.0;
        result.wall = timing_of(std::move(wall), frames);
        result.gpu = timing_of(std::move(gpu), frames);
        result.processor = timing_of(std::move(processor), frames);
    }

    double time_all_passes() {
        std::vector<double> ms;
        for (int i = 0; i < kAllPasses; ++i) {
            renderer_.reset();
            context_.finish();
            // A simulation would otherwise be caught up from its start.
            Frame frame = next_frame();
            frame.longest_catch_up = 1.0 / 60;
            const Stopwatch clock;
            renderer_.draw(frame);
            context_.finish();
            ms.push_back(clock.ms());
        }
        return timing_of(std::move(ms), 1.0).median;
    }

private:
    static Preset with(const Preset& preset, const Setting& setting) {
        Preset result = preset;
        result.values = setting.values;
        result.settle = setting.settle;
        if (setting.format)
            result.scene.passes[setting.format->pass].format = setting.format->format;
        return result;
    }

    Frame next_frame() {
        ++drawn_;
        if (preset_.settle > 0) {
            return settled_frame(preset_, {.end = preset_.time}, preset_.settle + drawn_);
        }
        const Playback later{.end = preset_.time + drawn_ / 60.0};
        return later.frame(preset_, later.last_frame());
    }

    Preset preset_;
    Context& context_;
    MeasureOptions options_;
    Renderer renderer_;
    int drawn_ = 0;
};

}  // namespace

Measured measure(const Preset& preset, const Setting& setting, Context& context,
                 const MeasureOptions& options) {
    Subject subject(preset, setting, context, options);
    Measured result{.picture = subject.draw_picture()};
    if (options.frames == 0) return result;
    subject.time_frames(result);
    result.all_passes_ms = subject.time_all_passes();
    return result;
}

std::string machine_name() {
    std::ifstream list("/proc/cpuinfo");
    std::string line, model = "unknown processor";
    while (std::getline(list, line)) {
        if (!line.starts_with("model name")) continue;
        model = line.substr(std::min(line.find(':') + 2, line.size()));
        break;
    }
    return fmt::format("{}, {} threads", model, std::thread::hardware_concurrency());
}

}  // namespace glint
