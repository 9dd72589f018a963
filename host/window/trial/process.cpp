// The process that tries candidates: compiles one, draws it small, and says how far it has come.
#include "gl/context.h"
#include "glsl/lean.h"
#include "scene/blame.h"
#include "window/trial/message.h"
#include "window/trial/socket_process.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csignal>
#include <ctime>
#include <limits>
#include <mutex>
#include <thread>

namespace glint {
namespace {

// A draw as small as this shows all that can go wrong. The driver compiles differently for textures
// whose sides are powers of two, so a small side is one where the real one is; then what was
// compiled here serves the window too. A huge side is not made smaller than a 64th: the time of a
// tiny draw is mostly chance, which scaled up to 8192x8192 would look like half a minute.
int small_side(int real, int least) {
    const bool power = std::has_single_bit(static_cast<unsigned>(real));
    int side = std::max(least, real / 64);
    if (!power && std::has_single_bit(static_cast<unsigned>(side))) side += side / 8;
    return std::min(real, side);
}

glm::ivec2 small_size(glm::ivec2 real) {
    return {small_side(real.x, 32), small_side(real.y, 16)};
}

double pixels(glm::ivec2 size) {
    return static_cast<double>(size.x) * static_cast<double>(size.y);
}

class Trier {
public:
    explicit Trier(const std::string& device) : context_(make_egl_context(device)) {
        software_ = context_->is_software();
        find_overhead();
        answer_.text = context_->renderer();
        send(answer_);
    }

    void answer(TrialOrder order);

    static void send(const TrialAnswer& answer);

private:
    double spent_ms() const;
    void find_overhead();
    void shrink(TrialOrder& order);
    bool compile(const TrialOrder& order, CompiledScene& scene);
    CompileResult compile_passes(const TrialOrder& order, const CompileOptions& options,
                                 ProgramShelf* shelf);
    CompileResult judged(const TrialOrder& order, CompileResult lean);
    bool is_silent(const TrialOrder& order);
    void compile_sound(const TrialOrder& order);
    void set_images(const TrialOrder& order, Renderer& renderer);
    void draw(const TrialOrder& order, CompiledScene scene);
    void draw_once(const TrialOrder& order, Renderer& renderer, int frame);
    void estimate(PassTrial& trial, std::size_t pass, double draw_ms);
    void tell(TrialStage stage, std::size_t pass);
    void warn_of_slowness(const TrialOrder& order);
    void give_up(const Preset& preset, std::size_t pass, const std::string& why);

    struct Sizes {
        std::size_t pass;
        glm::ivec2 real, small;
    };
    const Sizes& sizes(std::size_t pass) const {
        return *std::ranges::find(sizes_, pass, &Sizes::pass);
    }

    std::unique_ptr<Context> context_;
    ProgramShelf shelf_;  // what the last candidate that compiled was drawn with
    std::string judged_;  // the last text of which there was nothing to say, without its numbers
    bool software_ = false;
    double overhead_ms_ = 0.0;  // of a draw that does nothing
    // Of the answer and of sending it, while others than the main thread do so: threads that
    // compile ahead, and the watch of a driver that takes too much.
    std::mutex telling_;
    TrialAnswer answer_;
    std::vector<Sizes> sizes_;
    std::vector<std::pair<std::size_t, double>> compile_ms_;  // by pass
    const Scene* scene_ = nullptr;
    const GiveUp give_up_ = [this](const Preset& preset, std::size_t pass, const std::string& why) {
        give_up(preset, pass, why);
    };
};

void Trier::send(const TrialAnswer& answer) {
    const std::string message = pack(answer);
    for (std::size_t at = 0; at < message.size();) {
        const ssize_t sent =
            ::send(STDIN_FILENO, message.data() + at, message.size() - at, MSG_NOSIGNAL);
        if (sent <= 0) _exit(0);  // the window is gone
        at += static_cast<std::size_t>(sent);
    }
}

void Trier::tell(TrialStage stage, std::size_t pass) {
    const std::scoped_lock lock(telling_);
    answer_.stage = stage;
    answer_.text = pass_name(*scene_, pass);
    if (stage == TrialStage::drawing) {
        const glm::ivec2 small = sizes(pass).small;
        answer_.size = fmt::format("{}x{}", small.x, small.y);
    }
    send(answer_);
}

// A clock for the cost of a draw. A software renderer's is the process's own processor time: on a
// busy machine the wall clock also counts everybody else's, and a hiccup of 50 ms, scaled up from a
// small picture, would look like minutes.
double Trier::spent_ms() const {
    timespec now{};
    clock_gettime(software_ ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// Also brings the driver's own start-up behind us.
void Trier::find_overhead() {
    Preset preset;
    preset.scene.files = {"nothing"};
    preset.scene.text = "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, iTime, 1.0); }\n";
    preset.scene.origins = {{.file = 0, .line = 1}};
    auto compiled = compile_scene(preset, {});
    if (!compiled.scene) return;
    Renderer renderer(preset, std::move(*compiled.scene), {.size = {36, 18}});
    overhead_ms_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) {
        const double start_ms = spent_ms();
        Frame frame;
        frame.time = i;
        renderer.draw(frame);
        context_->finish();
        overhead_ms_ = std::min(overhead_ms_, spent_ms() - start_ms);
    }
}

// Buffers of a given size become small as well.
void Trier::shrink(TrialOrder& order) {
    sizes_ = {{kImagePass, order.size, small_size(order.size)}};
    auto& passes = order.preset.scene.passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const glm::ivec2 real = buffer_size(passes[i], order.size);
        glm::ivec2 small = small_size(real);
        if (passes[i].cube) small.y = small.x;
        passes[i].size = small;
        sizes_.push_back({i, real, small});
    }
    for (TrialImage& image : order.images) image.size = small_size(image.size);
}

CompileResult Trier::compile_passes(const TrialOrder& order, const CompileOptions& options,
                                    ProgramShelf* shelf) {
    compile_ms_.clear();
    Stopwatch clock;
    CompileResult result = compile_scene(
        order.preset, options,
        [&](std::size_t pass) {
            if (!compile_ms_.empty()) compile_ms_.back().second = clock.ms();
            compile_ms_.push_back({pass, 0.0});
            tell(TrialStage::compiling, pass);
            clock.restart();
        },
        give_up_, shelf);
    compile_ms_.back().second = clock.ms();
    return result;
}

// Whether the driver says nothing of what the root's text holds, called or not. Other numbers make
// no text wrong.
bool Trier::is_silent(const TrialOrder& order) {
    const std::size_t root = order.compile.root;
    std::string text =
        without_comments(pass_text(order.preset, root, {.specialise = false, .feed = true}).text);
    if (text == judged_) return true;
    tell(TrialStage::compiling, root);
    const CompileWatch watch(give_up_, order.preset, root);
    if (!complaints_of(pass_text(order.preset, root, {.specialise = false}).text).empty())
        return false;
    judged_ = std::move(text);
    return true;
}

// What is to be said of a text is said of all of it, by programs that are not lean: these leave out
// what nobody calls, and know no places.
CompileResult Trier::judged(const TrialOrder& order, CompileResult lean) {
    if (lean.scene && lean.diagnostics.empty() && is_silent(order)) return lean;
    CompileOptions whole{.root = order.compile.root, .program = {.specialise = false}};
    CompileResult result = compile_passes(order, whole, nullptr);
    if (result.scene && !lean.scene) {
        whole.program.specialise = order.compile.program.specialise;
        return compile_passes(order, whole, nullptr);
    }
    if (!result.scene) return result;
    lean.diagnostics = std::move(result.diagnostics);
    return lean;
}

bool Trier::compile(const TrialOrder& order, CompiledScene& scene) {
    CompileResult result = compile_passes(order, order.compile, &shelf_);
    if (order.is_text && order.compile.program.lean) result = judged(order, std::move(result));
    answer_.verdict.diagnostics = std::move(result.diagnostics);
    if (!result.scene) {
        answer_.verdict.state = TrialState::rejected;
        return false;
    }
    scene = std::move(*result.scene);
    for (const PassProgram& program : scene.programs) {
        const auto timed =
            std::ranges::find(compile_ms_, program.pass, &decltype(compile_ms_)::value_type::first);
        answer_.verdict.passes.push_back(
            {.name = pass_name(order.preset.scene, program.pass), .compile_ms = timed->second});
    }
    return true;
}

// What is wrong with the sound alone keeps no picture back, and is told with the rest. Constants
// change nothing of that.
void Trier::compile_sound(const TrialOrder& order) {
    if (!order.preset.scene.has_sound || !order.is_text) return;
    const CompileResult sound = compile_scene(
        order.preset, {.root = kSoundPass, .program = {.specialise = false}},
        [&](std::size_t pass) { tell(TrialStage::compiling, pass); }, give_up_);
    append_once(answer_.verdict.diagnostics, sound.diagnostics);
}

// Grey ones of the right form.
void Trier::set_images(const TrialOrder& order, Renderer& renderer) {
    for (const std::size_t sampler : renderer.inputs_needed()) {
        const auto image = std::ranges::find(order.images, sampler, &TrialImage::sampler);
        if (image == order.images.end()) continue;
        if (sampler_at(order.preset, sampler).type != SamplerType::sampler2D) continue;
        const auto values =
            static_cast<std::size_t>(image->size.x * image->size.y * image->channels);
        const std::vector<std::uint8_t> bytes(values, 128);
        const std::vector<float> floats(image->floats ? values : 0, 0.5f);
        renderer.set_image(sampler, {.size = image->size,
                                     .channels = image->channels,
                                     .floats = image->floats,
                                     .data = image->floats ? std::as_bytes(std::span(floats))
                                                           : std::as_bytes(std::span(bytes))});
    }
}

void Trier::draw_once(const TrialOrder& order, Renderer& renderer, int frame) {
    double start_ms = 0.0;
    // Drivers finish compiling inside the first draw call; the pixels are waited for afterwards.
    renderer.before_pass = [&](std::size_t index) {
        tell(frame == 0 ? TrialStage::compiling : TrialStage::drawing,
             renderer.graph().passes[index].pass);
        start_ms = spent_ms();
    };
    renderer.after_pass = [&](std::size_t index) {
        const double submit_ms = spent_ms() - start_ms;
        if (frame == 0) tell(TrialStage::drawing, renderer.graph().passes[index].pass);
        start_ms = spent_ms();
        context_->finish();
        const double finish_ms = spent_ms() - start_ms;
        PassTrial& pass = answer_.verdict.passes[index];
        if (frame == 0) pass.first_ms = submit_ms + finish_ms;
        if (frame == 1) pass.second_ms = submit_ms + finish_ms;
        estimate(pass, renderer.graph().passes[index].pass,
                 frame == 0 ? finish_ms : submit_ms + finish_ms);
    };
    // Far enough apart that every simulation takes a step, and no further.
    double step = 1.0 / 60.0;
    for (const Pass& pass : order.preset.scene.passes) step = std::max(step, pass.step.seconds());
    renderer.redraw();
    Frame inputs;
    inputs.time = order.time + step * (frame + 1);
    inputs.time_delta = step;
    inputs.frame_rate = 1.0 / step;
    inputs.frame = frame;
    inputs.date = shadertoy_date(order.preset.date, inputs.time);
    inputs.longest_catch_up = step * 1.001;
    renderer.draw(inputs);
}

// The shortest of several draws counts. A small picture is drawn
// by one thread of a software renderer and by one corner of a GPU, which draws some 16,384 pixels
// at a time.
void Trier::estimate(PassTrial& trial, std::size_t pass, double draw_ms) {
    const auto& [index, real, small] = sizes(pass);
    const double threads = std::clamp(std::thread::hardware_concurrency(), 1u, 16u);
    const double ratio =
        software_ ? pixels(real) / pixels(small) / threads : pixels(real) / 16384.0;
    const double ms = std::max(0.0, draw_ms - overhead_ms_) * std::max(1.0, ratio);
    trial.expected_ms = trial.expected_ms == 0.0 ? ms : std::min(trial.expected_ms, ms);
}

void Trier::draw(const TrialOrder& order, CompiledScene scene) {
    Renderer renderer(order.preset, std::move(scene),
                      {.size = sizes(kImagePass).small, .picture_format = order.picture_format});
    set_images(order, renderer);
    Verdict& verdict = answer_.verdict;
    if (order.compile.side_by_side)
        renderer.compile_ahead([&](std::size_t index) {
            tell(TrialStage::compiling, renderer.graph().passes[index].pass);
        });
    const std::vector<double> ahead_ms = renderer.finish_compiling();
    // Two draws; a few more where the estimate would alarm somebody, and only while that is quick.
    const double start_ms = spent_ms();
    const auto is_quick = [&] { return spent_ms() - start_ms < 100.0; };
    for (int frame = 0;
         frame < 2 || (frame < 6 && verdict.expected_ms > order.slow_ms / 2 && is_quick());
         ++frame) {
        draw_once(order, renderer, frame);
        verdict.expected_ms = 0.0;
        for (const PassTrial& pass : verdict.passes) verdict.expected_ms += pass.expected_ms;
    }
    // What was compiled on its own belongs to the first draw, too.
    for (std::size_t i = 0; i < ahead_ms.size(); ++i) verdict.passes[i].first_ms += ahead_ms[i];
    verdict.state = TrialState::passed;
    if (verdict.expected_ms > order.slow_ms) warn_of_slowness(order);
}

void Trier::warn_of_slowness(const TrialOrder& order) {
    const auto& passes = answer_.verdict.passes;
    const PassTrial& worst = *std::ranges::max_element(
        passes,
        [](const PassTrial& a, const PassTrial& b) { return a.expected_ms < b.expected_ms; });
    const auto loop = likely_endless_loop(order.preset.scene);
    answer_.verdict.diagnostics.push_back(
        {Severity::warning, loop.value_or(entry_place(order.preset.scene, worst.name)),
         fmt::format("pass {}: about {:.1f} s a frame at {}x{}{}", worst.name,
                     worst.expected_ms / 1000.0, order.size.x, order.size.y,
                     loop ? "; does this loop ever end?" : "")});
}

// On the watch's thread, while the driver has the other one. The window starts a new process.
void Trier::give_up(const Preset& preset, std::size_t pass, const std::string& why) {
    const std::scoped_lock lock(telling_);  // to the end of the process: nothing is told after it
    answer_.verdict.state = TrialState::rejected;
    answer_.verdict.diagnostics = {given_up(preset, pass, why)};
    answer_.stage = TrialStage::done;
    send(answer_);
    _exit(0);
}

void Trier::answer(TrialOrder order) {
    answer_ = {};
    answer_.number = order.number;
    answer_.verdict.state = TrialState::running;
    scene_ = &order.preset.scene;
    try {
        shrink(order);
        CompiledScene scene;
        if (compile(order, scene)) {
            const std::vector<GLuint> ids = ids_of(scene);
            compile_sound(order);
            draw(order, std::move(scene));
            shelf_.keep_only(ids);
        }
    } catch (const ContextLost& error) {
        answer_.verdict.state = TrialState::lost;
        answer_.verdict.diagnostics.push_back(
            {Severity::error, entry_place(order.preset.scene, answer_.text),
             fmt::format("pass {}: {}", answer_.text, error.what())});
    } catch (const std::exception& error) {
        answer_.verdict.state = TrialState::rejected;
        answer_.verdict.diagnostics.push_back(
            {Severity::error, entry_place(order.preset.scene, answer_.text), error.what()});
    }
    answer_.stage = TrialStage::done;
    send(answer_);
    if (answer_.verdict.state == TrialState::lost) _exit(0);  // nothing can be drawn here any more
}

// The newest order; older ones that wait behind it are of no use to anybody.
std::string receive_order() {
    static std::string arrived;
    std::string newest;
    std::array<char, 64 * 1024> buffer;
    for (;;) {
        while (auto message = take_message(arrived)) newest = std::move(*message);
        const ssize_t length = recv(STDIN_FILENO, buffer.data(), buffer.size(),
                                    newest.empty() || !arrived.empty() ? 0 : MSG_DONTWAIT);
        if (length < 0 && !newest.empty()) return newest;
        if (length <= 0) _exit(0);  // the window is gone
        arrived.append(buffer.data(), static_cast<std::size_t>(length));
    }
}

}  // namespace

void run_trial(const std::string& device) {
    require_socket("trial");
    std::optional<Trier> trier;
    try {
        trier.emplace(device);
    } catch (const std::exception& error) {
        TrialAnswer answer;
        answer.verdict.state = TrialState::unavailable;
        answer.verdict.diagnostics.emplace_back().text = error.what();
        Trier::send(answer);
        return;
    }
    for (;;) trier->answer(unpack_order(receive_order()));
}

}  // namespace glint
