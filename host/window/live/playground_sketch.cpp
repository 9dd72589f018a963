// What a saved text will look like is drawn by a process that compiles quickly, while another one
// compiles what is to be drawn for good.
#include "window/live/picture_shelf.h"
#include "window/live/playground.h"

#include <algorithm>
#include <ranges>
#include <tuple>
#include <utility>

namespace glint {
namespace {

// A text that is compiled within this time needs none.
constexpr double kSoonMs = 60.0;

// A sketch has this share of the picture's width and height, and no fewer pixels than the least:
// it is seen for less than a second, and code that is not optimised draws slowly.
constexpr float kSketchShare = 0.5f;
constexpr int kLeastPixels = 160 * 90;

// Wherever it stands in the text.
auto declared(const Sampler& s) {
    return std::tie(s.name, s.tab, s.type, s.source, s.filter, s.wrap, s.vflip, s.pass, s.output,
                    s.files, s.noise_channels, s.noise_size, s.plays);
}
auto declared(const Pass& p) {
    return std::tie(p.name, p.entry, p.outputs, p.size, p.scale, p.format, p.cube, p.step.numerator,
                    p.step.denominator);
}

bool same_declared(const auto& a, const auto& b) {
    return std::ranges::equal(
        a, b, [](const auto& x, const auto& y) { return declared(x) == declared(y); });
}

// What was drawn in the picture's size is read in no other.
bool has_picture_size(const Scene& scene, const std::vector<GivenBuffer>& given) {
    return std::ranges::any_of(
        given, [&](const GivenBuffer& one) { return !scene.passes[one.pass].size; });
}

void draw_coarsely(RefineOrder& order) {
    const glm::ivec2 size(kSketchShare * glm::vec2(order.preset.size));
    if (size.x * size.y < kLeastPixels || has_picture_size(order.preset.scene, order.given)) return;
    order.preset.size = size;
}

std::size_t bytes_of_output(glm::ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4 * sizeof(float);
}

}  // namespace

// Else buffers and inputs may hold something else than the new text would put there.
bool Playground::may_sketch() const {
    return context_.is_software() && has_picture_ && replay_at_ < 0 && !awaits_inputs() &&
           reloader_.as_written() &&
           same_declared(preset_->scene.passes, programs_.tried().scene.passes) &&
           same_declared(preset_->scene.samplers, programs_.tried().scene.samplers) &&
           same_declared(preset_->channels, programs_.tried().channels);
}

// True when there is one that was not there before.
bool Playground::follow_sketch() {
    const bool is_heavy = programs_.longest_compile_ms() > kSoonMs;
    if (!awaits_text()) {
        if (sketcher_.is_drawing() || sketch_) sketcher_.stop();
        sketch_.reset();
        wants_sketch_ = false;
        const bool is_quiet = has_picture_ && reloader_.state() == ReloadState::idle;
        if (is_quiet && context_.is_software() && is_heavy) prepare_sketch();
    }
    if (wants_sketch_ && (is_heavy || since_trial_.ms() > kSoonMs)) {
        wants_sketch_ = false;
        if (may_sketch()) start_sketch();
    }
    if (!sketcher_.update() || !awaits_text()) return false;
    sketch_ = buffer_of(sketcher_.picture());
    sketch_ms_ = since_trial_.ms();
    return true;
}

// Maps take long to read, to send and to make smaller ones of, and stay as they are.
void Playground::prepare_sketch() {
    if (!sketcher_.prepare()) return;
    RefineOrder order = order_of(current_preset());
    order.samples = 0;
    order.given = standing_buffers(renderer_->maps());
    note_texts(order.given);
    read_buffers(order.given, sketcher_.memory());
    sketcher_.make_ready(order);
    known_to_sketch_ = order.given;
}

void Playground::start_sketch() {
    RefineOrder order = order_of(programs_.tried());
    std::vector<std::size_t> all = renderer_->maps();  // first, where they stood before
    for (std::size_t i = 0; i < renderer_->graph().passes.size(); ++i)
        if (std::ranges::find(all, i) == all.end()) all.push_back(i);
    order.given = standing_buffers(all);
    note_texts(order.given);
    draw_coarsely(order);
    if (sketcher_.process() != 0) note_known(order.given, known_to_sketch_);
    read_buffers(order.given, sketcher_.memory());
    sketcher_.start(order);
}

// The frame that was drawn last, by this text.
RefineOrder Playground::order_of(Preset preset) const {
    const Frame frame = frame_again();
    RefineOrder order{.preset = std::move(preset),
                      .samples = 1,
                      .time = frame.time,
                      .time_delta = frame.time_delta,
                      .frame_rate = frame.frame_rate,
                      .frame = frame.frame,
                      .date = frame.date,
                      .input = frame.input,
                      .mouse_size = frame.mouse_size};
    order.preset.size = size_;
    return order;
}

// The frame that was drawn last, with the buffers that a pass reads.
RefineOrder Playground::probe_order(std::size_t pass, SharedMemory& memory) {
    Preset preset = current_preset();
    preset.time = preset_->time;
    RefineOrder order = order_of(std::move(preset));
    order.specialise = is_specialised();
    const auto& passes = renderer_->graph().passes;
    const auto reader = std::ranges::find(passes, pass, &GraphPass::pass);
    std::vector<std::size_t> read;
    for (std::size_t i = 0; i < passes.size() && reader != passes.end(); ++i)
        if (std::ranges::find(reader->reads, passes[i].pass) != reader->reads.end())
            read.push_back(i);
    order.given = standing_buffers(read);
    read_buffers(order.given, memory);
    return order;
}

// What stands in the buffers of these passes (places in the graph), and room for it in memory.
std::vector<GivenBuffer> Playground::standing_buffers(const std::vector<std::size_t>& indices) {
    std::vector<GivenBuffer> list;
    std::size_t bytes = 0;
    for (const std::size_t i : indices) {
        const GraphPass& pass = renderer_->graph().passes[i];
        const BufferShape& shape = renderer_->buffer(i).shape();
        if (!fills_a_buffer(pass.pass) || shape.cube) continue;
        list.push_back({.pass = pass.pass,
                        .feeds_state = pass.feeds_state,
                        .reads = pass.reads,
                        .size = shape.size,
                        .outputs = shape.outputs,
                        .begin = bytes});
        bytes += bytes_of_output(shape.size) * static_cast<std::size_t>(shape.outputs);
    }
    return list;
}

// By which texts, which a sketch asks for.
void Playground::note_texts(std::vector<GivenBuffer>& list) {
    const Preset drawn = current_preset();
    for (GivenBuffer& given : list) {
        const std::size_t index = renderer_->graph_index(given.pass);
        const std::string* constants =
            is_specialised() ? programs_.shelf().text_of(renderer_->scene().programs[index].id)
                             : nullptr;
        if (!given.feeds_state && !renderer_->is_mixed_map(index))
            given.text_hash = filling_hash(drawn, given.pass, constants);
    }
}

// Into memory, but for those that are known; none where there is no room.
void Playground::read_buffers(std::vector<GivenBuffer>& list, SharedMemory& shared) {
    std::size_t bytes = 0;
    for (const GivenBuffer& given : list)
        bytes += bytes_of_output(given.size) * static_cast<std::size_t>(given.outputs);
    const std::span<std::byte> memory = shared.room(bytes);
    if (memory.size() < bytes) list.clear();
    for (const GivenBuffer& given : list) {
        if (given.is_known) continue;
        const std::size_t index = renderer_->graph_index(given.pass);
        const std::size_t size = bytes_of_output(given.size);
        for (std::size_t output = 0; output < static_cast<std::size_t>(given.outputs); ++output)
            glGetTextureImage(renderer_->buffer(index).texture(output), 0, GL_RGBA, GL_FLOAT,
                              static_cast<GLsizei>(size),
                              memory.subspan(given.begin + output * size, size).data());
    }
}

}  // namespace glint
