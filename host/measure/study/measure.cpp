#include "measure/study/measure.h"

#include "base/median.h"
#include "base/process_time.h"
#include "measure/study/placement.h"
#include "measure/study/statistics.h"
#include "offline/common.h"
#include "offline/input_files.h"
#include "scene/lint.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <fstream>
#include <thread>
#include <utility>

namespace glint {
namespace {

constexpr int kAllPasses = 3;                               // frames in which every pass is drawn
constexpr std::size_t kMostBytes = std::size_t{256} << 20;  // of states that are kept

std::size_t byte_count(const std::vector<PassState>& state) {
    std::size_t bytes = 0;
    for (const PassState& pass : state) bytes += pass.bytes.size();
    return bytes;
}

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

const Played::Reached* Played::find(const std::string& key, int most_frames) const {
    const Reached* farthest = nullptr;
    for (const Reached& one : reached_) {
        const bool fits = one.key == key && one.frames <= most_frames;
        if (fits && (!farthest || one.frames > farthest->frames)) farthest = &one;
    }
    return farthest;
}

void Played::keep(Reached reached) {
    reached_.push_back(std::move(reached));
    std::size_t bytes = 0;
    for (const Reached& one : reached_) bytes += byte_count(one.state);
    for (; bytes > kMostBytes; reached_.pop_front()) bytes -= byte_count(reached_.front().state);
}

MeasuredScene::MeasuredScene(const Preset& preset, const Setting& setting, Context& context,
                             const MeasureOptions& options)
    : preset_(with(preset, setting)), context_(context), options_(options) {
    renderer_ = compile();
    load_inputs(preset_, *renderer_);
    renderer_->compile_ahead();
}

// Takes over the buffers of the one that is there.
std::unique_ptr<Renderer> MeasuredScene::compile() const {
    return std::make_unique<Renderer>(
        preset_, compile_or_stop(preset_, {.root = options_.pass, .program = program_options()}),
        RenderOptions{.size = preset_.size, .picture_format = PixelFormat::rgba32f},
        renderer_.get());
}

void MeasuredScene::find_quick_place() {
    if (!context_.is_software() || std::exchange(stands_well_, true)) return;
    turns_.reset();  // it draws by the program that is there now
    std::unique_ptr<Renderer> aside;
    glint::find_quick_place({.compile_again =
                                 [&] {
                                     aside = std::exchange(renderer_, compile());
                                     renderer_->compile_ahead();
                                 },
                             .swap =
                                 [&] {
                                     aside->adopt(*renderer_);
                                     std::swap(aside, renderer_);
                                 },
                             .frame_ms = [&] { return time_frame().processor; }});
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
    renderer_->set_values(setting.values);
    renderer_->reset();
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

// Programs that say the same to the last bit, with all that the states they draw follow from.
std::string MeasuredScene::key_of_state() const {
    std::string key = options_.specialise ? "constants" : "uniforms";
    for (const std::size_t constant : options_.constants) key += fmt::format(" {}", constant);
    for (const Pass& pass : preset_.scene.passes)
        key += fmt::format(" {}", static_cast<int>(pass.format));
    const std::vector<bool>& acts = options_.played->acts();
    for (std::size_t i = 0; i < acts.size(); ++i) {
        if (!acts[i]) continue;
        key += fmt::format("\n{}", i);
        for (const double number : preset_.values[i]) key += fmt::format(" {}", number);
    }
    return key;
}

// To just before the last frame, which it returns, from as far as another setting has come.
Frame MeasuredScene::play_on() {
    const Playback playback{.end = preset_.time};
    int ignored = 0, first = 0;
    const bool is_shared = options_.played && renderer_->graph().stateful;
    const std::string key = is_shared ? key_of_state() : "";
    const int end = playback.last_frame(), last = end + preset_.settle;
    if (const auto* reached = is_shared ? options_.played->find(key, last) : nullptr) {
        renderer_->set_state(reached->state);
        first = reached->frames;
    }
    Frame frame;
    // Half and a quarter of the frames that settle are what the truth is measured by.
    for (const int share : {4, 2, 1}) {
        const int settle = (preset_.settle + 1) / share - 1;
        if (share > 1 && (!is_shared || settle < 1 || end + settle <= first)) continue;
        frame = play(preset_, *renderer_, playback, settle, ignored, first);
        if (!is_shared || end + settle <= first) continue;
        first = end + settle;
        options_.played->keep({key, first, renderer_->state()});
    }
    return frame;
}

std::vector<float> MeasuredScene::draw_picture() {
    last_ = play_on();
    renderer_->draw(last_);
    context_.finish();
    return renderer_->read_floats(options_.output);
}

std::string MeasuredScene::cut_pass() {
    constexpr std::uint32_t kMany = kLoopBudget / 2;  // at so few pixels
    if (!ends_loops(context_)) return {};
    const std::vector<PlacedFinding> findings = lint(preset_).findings;
    if (std::ranges::none_of(findings, is_of_long_loop)) return {};
    try {
        if (!renderer_->graph().stateful) {
            const std::uint32_t most = coarse().most_turns();
            if (most < kFewTurns) return {};
            if (differs_alone(preset_, *renderer_, program_options(), last_))
                return pass_name(preset_.scene, options_.pass);
            if (most < kMany) return {};
        }
        most_turns();
        return turns_->is_cut() ? turns_->pass() : "";
    } catch (const ProbeRefused&) {  // nobody can tell
        return {};
    }
}

ProgramOptions MeasuredScene::program_options() const {
    return {.specialise = options_.specialise, .constants = options_.constants};
}

// The same picture with a sixteenth of the pixels, drawn.
MeasuredScene& MeasuredScene::coarse() {
    constexpr int kCoarser = 4;
    const Setting setting{.values = preset_.values, .settle = preset_.settle};
    if (coarse_) coarse_->set(setting);
    if (!coarse_) {
        Preset preset = preset_;
        preset.size = glm::max(preset.size / kCoarser, 1);
        coarse_ = std::make_unique<MeasuredScene>(preset, setting, context_, options_);
    }
    coarse_->draw_picture();
    return *coarse_;
}

// In any pixel of the last picture. Throws ProbeRefused.
std::uint32_t MeasuredScene::most_turns() {
    if (!turns_) {
        turns_ = std::make_unique<LoopTurns>(preset_, *renderer_, program_options());
    }
    turns_->forget();
    turns_->count(last_, [&] { renderer_->draw(last_); });
    return turns_->most();
}

FrameTime MeasuredScene::time_frame() {
    TimerQuery query;
    const Frame frame = next_frame();
    renderer_->redraw();
    const double processor_before = own_processor_ms();
    const Stopwatch clock;
    query.begin();
    renderer_->draw(frame);
    query.end();
    context_.finish();
    const double wall = clock.ms(), processor = own_processor_ms() - processor_before;
    const double frames = preset_.settle + 1.0;
    return {.wall = wall * frames, .gpu = query.ms() * frames, .processor = processor * frames};
}

double MeasuredScene::time_all_passes() {
    std::vector<double> ms;
    for (int i = 0; i < kAllPasses; ++i) {
        renderer_->reset();
        context_.finish();
        // A simulation would otherwise be caught up from its start.
        Frame frame = next_frame();
        frame.longest_catch_up = 1.0 / 60;
        const Stopwatch clock;
        renderer_->draw(frame);
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
