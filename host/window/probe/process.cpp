#include "window/probe/process.h"

#include "base/json_text.h"
#include "gl/context.h"
#include "measure/probe/cost.h"
#include "measure/probe/watches.h"
#include "offline/input_files.h"
#include "render/pass_text.h"
#include "scene/scene_text.h"
#include "window/probe/batches.h"
#include "window/probe/lines.h"
#include "window/trial/given_buffers.h"
#include "window/trial/message.h"
#include "window/trial/refine_socket.h"
#include "window/trial/shared_memory.h"
#include "window/trial/socket_process.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <string_view>

namespace glint {
namespace {

// Copies of sites in one text. A copy adds some 2 ms to half a second that the picture of magic
// takes without any, and twice that where the driver polishes it: so this is about what the pass
// takes.
constexpr double kMostCopies = 300.0;

bool is_simulated(const CompiledScene& scene) {
    return scene.graph.passes.size() > 1 && scene.graph.stateful;
}

// The scene of an order, with the pass compiled that is looked into; what it reads stands still.
class Subject {
public:
    explicit Subject(const ProbeOrder& order)
        : number_(order.subject), pass_(order.pass), preset_(order.scene.preset) {
        options_ = {.specialise = order.scene.specialise};
        pictures_ = as_pictures(preset_, order.scene.given);
        ProgramOptions plain = options_;
        plain.lean = true;  // as the window draws it: the driver may have it at hand
        CompileResult result =
            compile_scene(preset_, {.root = pass_, .program = plain, .as_written = true});
        // A simulation that the window does not run, for nothing shown hangs on it, is left empty.
        if (result.scene && is_simulated(*result.scene))
            result = compile_scene(preset_, {.root = pass_, .program = plain});
        if (!result.scene) throw ProbeRefused("The text does not compile.");
        if (is_simulated(*result.scene))
            throw ProbeRefused("This pass reads a cube that is simulated, and cannot be probed.");
        renderer_.emplace(
            preset_, std::move(*result.scene),
            RenderOptions{.size = preset_.size, .picture_format = PixelFormat::rgba32f});
        load_inputs(preset_, *renderer_);
        reading_ = read_glsl(preset_.scene.text, known_of_pass(output_names(preset_.scene, pass_)));
        reached_ = reading_.reached_from({entry_of(preset_.scene, pass_)});
    }
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    std::uint64_t number() const { return number_; }

    // The buffers and the frame of this order.
    void take_instant(const ProbeOrder& order) {
        frame_ = next_step(frame_of(order.scene));
        if (instant_ == order.instant) return;
        instant_ = order.instant;
        const SeenMemory memory;
        SentPictures none;
        hand_over(pictures_, memory.bytes(), none, *renderer_);
        if (renderer_->graph().passes.size() > 1) renderer_->draw(frame_);
    }

    void answer(const ProbeOrder& order, ProbeAnswer& answer);

private:
    // A simulation is asked about its next step, which is what it would do from here on.
    Frame next_step(Frame frame) const {
        if (!fills_a_buffer(pass_)) return frame;
        const Step step = preset_.scene.passes[pass_].step;
        if (!step) return frame;
        const auto done = static_cast<int>(frame.time / step.seconds());
        frame.frame = done;
        frame.time = (done + 1) * step.seconds();
        frame.time_delta = step.seconds();
        frame.frame_rate = 1.0 / step.seconds();
        return frame;
    }
    bool compile_next(const ProbeOrder& order);
    bool is_whole() const { return lines_.size() + refused_.size() >= batches_.size(); }
    void add_values(const ProbeOrder& order, Probing& found, ProbeAnswer& answer);
    void add_costs(const ProbeOrder& order, Probing& found, ProbeAnswer& answer);
    void add_map(const ProbeOrder& order, ProbeAnswer& answer);
    glm::ivec2 size() const { return renderer_->root_size(); }

    std::uint64_t number_ = 0, instant_ = 0;
    std::size_t pass_;
    Preset preset_;
    ProgramOptions options_{};
    std::vector<GivenPicture> pictures_;
    std::optional<Renderer> renderer_;
    Reading reading_;
    std::vector<bool> reached_;
    Frame frame_{};
    std::optional<Watches> watches_;
    Span asked_{};
    std::vector<ProbeBatch> batches_;  // of the lines that are asked for
    std::deque<Probe> lines_;          // of the first of them, as far as they are compiled
    std::vector<std::string> refused_;
    std::optional<Probe> cost_;
};

// The watches, or a batch of lines; false where all was at hand.
bool Subject::compile_next(const ProbeOrder& order) {
    if (asked_.begin != order.lines.begin || asked_.end != order.lines.end) {
        asked_ = order.lines;
        lines_.clear();
        refused_.clear();
        batches_.clear();
        const ProbeWish wish{.only = {asked_}};
        if (asked_.begin < asked_.end)
            batches_ = batches_of(reading_, preset_.scene.text,
                                  pass_text(preset_, pass_, options_, &wish).probed.sites,
                                  copies_in(reading_, entry_of(preset_.scene, pass_)), asked_,
                                  kMostCopies);
    }
    if (!watches_) {
        watches_.emplace(preset_, pass_, options_);
        if (watches_->probe()) return true;
    }
    if (is_whole()) return false;
    try {
        const ProbeBatch& batch = batches_[lines_.size() + refused_.size()];
        lines_.emplace_back(preset_, pass_, options_, ProbeWish{.only = batch});
    } catch (const ProbeRefused& refused) {
        refused_.push_back(refused.what());
    }
    return true;
}

void Subject::add_values(const ProbeOrder& order, Probing& found, ProbeAnswer& answer) {
    if (!order.pixel) return;
    const ProbePlace place{.pixel = *order.pixel};
    found.pixel = place.pixel;
    found.values = watches_->values_at(*renderer_, frame_, place);
    answer.watched = static_cast<int>(found.values.size());
    Probed all;
    std::vector<std::uint32_t> hits;
    for (Probe& probe : lines_) {
        const std::vector<ProbeValue> rows = probe.values_at(*renderer_, frame_, place, &hits);
        found.values.insert(found.values.end(), rows.begin(), rows.end());
        const auto& sites = probe.probed().sites;
        all.sites.insert(all.sites.end(), sites.begin(), sites.end());
        if (probe.is_discarded())
            found.same = "discarded";
        else if (order.colour && !sites.empty() && !found.same.starts_with("no"))
            found.same = same_colour(*order.colour, probe.colour(), PixelFormat::rgba8);
    }
    if (!is_whole()) return;  // what is not compiled yet may have run
    for (const LineState state : line_states(preset_.scene, reading_, reached_, all, hits, asked_))
        answer.ran.push_back(static_cast<std::uint8_t>(state));
}

// What each line has cost at the pixel, and the dearest lines of all.
void Subject::add_costs(const ProbeOrder& order, Probing& found, ProbeAnswer& answer) {
    if (order.map != ProbeMap::cost) return;
    if (!cost_) cost_.emplace(preset_, pass_, options_, ProbeWish{.kind = ProbeKind::cost});
    const std::vector<ProbeCell> cells = cost_->map(*renderer_, frame_, 0, 0);
    found.cost = totals_of(cells);
    found.cost->lines = dearest_lines(*cost_, *renderer_, frame_, size());
    answer.components = 1;
    for (const ProbeCell& cell : cells) {
        const std::array<float, 4> value{static_cast<float>(count_of(cell)), 0.0f, 0.0f, 0.0f};
        const auto* bytes = reinterpret_cast<const std::byte*>(value.data());
        answer.values.insert(answer.values.end(), bytes, bytes + sizeof value);
        answer.reached.push_back(std::byte{1});
    }
}

// `m[1]` and `hit.nor`, of `m` and `hit`, and these themselves.
bool is_part_of(std::string_view name, std::string_view whole) {
    return name.starts_with(whole) &&
           (name.size() == whole.size() || name[whole.size()] == '.' || name[whole.size()] == '[');
}

void Subject::add_map(const ProbeOrder& order, ProbeAnswer& answer) {
    if (order.map != ProbeMap::value) return;
    std::vector<Probe*> probes;
    if (watches_->probe()) probes.push_back(watches_->probe());
    for (Probe& probe : lines_) probes.push_back(&probe);
    for (Probe* probe : probes) {
        for (std::size_t i = 0; i < probe->probed().sites.size(); ++i) {
            const ProbeValue row = probe->row(i);
            if (row.line != order.line || row.column != order.column || row.file != order.file ||
                row.kind != order.kind || !is_part_of(order.name, row.name))
                continue;
            // A leaf's number stands in the row's name: `m[1]`, `hit.nor`.
            const std::vector<ProbeCell> first = probe->map(*renderer_, frame_, i, 0);
            std::vector<ProbeCell> cells = first;
            const auto reached =
                std::ranges::find_if(first, [](const ProbeCell& cell) { return cell.told[0] > 0; });
            if (reached != first.end()) {
                const ProbeLeaves leaves = leaves_of(reached->told[2], probe->probed());
                const auto leaf = static_cast<std::size_t>(
                    std::ranges::find(leaves, order.name.substr(row.name.size())) - leaves.begin());
                if (leaf > 0 && leaf < leaves.size())
                    cells = probe->map(*renderer_, frame_, i + (leaf << kProbeLeafShift), 0);
            }
            for (const ProbeCell& cell : cells) {
                std::array<float, 4> value{};
                const std::vector<double> kept =
                    cell.told[0] > 0 ? value_of(cell) : std::vector<double>();
                for (std::size_t c = 0; c < kept.size() && c < 4; ++c)
                    value[c] = static_cast<float>(kept[c]);
                answer.components = std::max(answer.components, static_cast<int>(kept.size()));
                const auto* bytes = reinterpret_cast<const std::byte*>(value.data());
                answer.values.insert(answer.values.end(), bytes, bytes + sizeof value);
                answer.reached.push_back(std::byte(!kept.empty()));
            }
            return;
        }
    }
}

void Subject::answer(const ProbeOrder& order, ProbeAnswer& answer) {
    const Stopwatch clock;
    const bool counts = order.map == ProbeMap::cost && !cost_;
    const bool compiles = compile_next(order) || counts;
    Probing found{.scene = preset_.scene.files.front().string(),
                  .pass = pass_name(preset_.scene, pass_),
                  .size = size(),
                  .frame = frame_.frame,
                  .time = frame_.time};
    if (compiles) answer.compile_ms = clock.ms();
    add_values(order, found, answer);
    add_costs(order, found, answer);
    add_map(order, answer);
    if (!answer.values.empty()) answer.map = order.map, answer.size = size();
    answer.is_whole = is_whole();
    found.notes = watches_->refused();
    found.notes.insert(found.notes.end(), refused_.begin(), refused_.end());
    answer.found = json_text(to_json(found), -1);
}

}  // namespace

void run_probing(const std::string& device) {
    require_socket("probing");
    // Code that the driver does not polish is there in half of the time, and draws a few pixels
    // only.
    ::setenv("GALLIVM_PERF", "nopt", 0);
    const auto context = make_egl_context(device);
    std::unique_ptr<Subject> subject;
    for (;;) {
        const ProbeOrder order = unpack_probe_order(receive_message());
        ProbeAnswer answer{.number = order.number};
        try {
            if (!subject || subject->number() != order.subject) {
                subject.reset();
                subject = std::make_unique<Subject>(order);
            }
            subject->take_instant(order);
            subject->answer(order, answer);
        } catch (const ProbeRefused& refused) {
            answer = {.number = order.number, .problem = refused.what()};
        }
        const std::string message = pack(answer);
        send_all(std::as_bytes(std::span(message)));
    }
}

}  // namespace glint
