#include "measure/study/measure.h"

#include "base/median.h"
#include "base/process_time.h"
#include "measure/study/statistics.h"
#include "offline/common.h"
#include "offline/input_files.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace glint {
namespace {

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

}  // namespace

MeasuredScene::MeasuredScene(const Preset& preset, const Setting& setting, Context& context,
                             const MeasureOptions& options)
    : preset_(with(preset, setting)),
      context_(context),
      options_(options),
      renderer_(preset_,
                compile_or_stop(preset_, {.root = options.pass,
                                          .program = {.specialise = options.specialise,
                                                      .constants = options.constants}}),
                {.size = preset_.size, .picture_format = PixelFormat::rgba32f}) {
    load_inputs(preset_, renderer_);
    renderer_.compile_ahead();
}

Preset MeasuredScene::with(const Preset& preset, const Setting& setting) {
    Preset result = preset;
    result.values = setting.values;
    result.settle = setting.settle;
    if (setting.format) result.scene.passes[setting.format->pass].format = setting.format->format;
    return result;
}

void MeasuredScene::set(const Setting& setting) {
    preset_.values = setting.values;
    preset_.settle = setting.settle;
    renderer_.set_values(setting.values);
    renderer_.reset();
    drawn_ = 0;
}

Frame MeasuredScene::next_frame() {
    ++drawn_;
    if (preset_.settle > 0) {
        return settled_frame(preset_, {.end = preset_.time}, preset_.settle + drawn_);
    }
    const Playback later{.end = preset_.time + drawn_ / 60.0};
    return later.frame(preset_, later.last_frame());
}

std::vector<float> MeasuredScene::draw_picture() {
    int ignored = 0;
    renderer_.draw(play(preset_, renderer_, {.end = preset_.time}, preset_.settle, ignored));
    context_.finish();
    return renderer_.read_floats(options_.output);
}

FrameTime MeasuredScene::time_frame() {
    TimerQuery query;
    const Frame frame = next_frame();
    renderer_.redraw();
    const double processor_before = own_processor_ms();
    const Stopwatch clock;
    query.begin();
    renderer_.draw(frame);
    query.end();
    context_.finish();
    const double wall = clock.ms(), processor = own_processor_ms() - processor_before;
    const double frames = preset_.settle + 1.0;
    return {.wall = wall * frames, .gpu = query.ms() * frames, .processor = processor * frames};
}

double MeasuredScene::time_all_passes() {
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
    return median_of(ms);
}

glm::ivec2 compared_size(const Preset& preset, std::size_t pass) {
    if (pass == kImagePass) return preset.size;
    const Pass& declared = preset.scene.passes[pass];
    if (declared.cube) throw UsageError("--pass: a cube has no plane to compare.");
    return buffer_size(declared, preset.size);
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
