#include "window/live/live_probe.h"

#include "window/live/picture_shelf.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <utility>

namespace glint {
namespace {

constexpr double kStands = 200.0;  // ms that a text and its values stand before they are compiled
constexpr double kApart = 150.0;   // ms between two answers about a picture that moves
constexpr double kSayBusy = 250.0;
constexpr int kLinesAround = 8;  // compiled with those in view, so that scrolling a little is free

bool is_same(Span a, Span b) {
    return a.begin == b.begin && a.end == b.end;
}

}  // namespace

void LiveProbe::stop() {
    if (prober_.process() == 0 && !subject_) return;
    prober_.stop();
    subject_.reset();
    next_.reset();
    asked_ = {};
    is_known_ = is_waiting_ = false;
    found_ = {};
    answer_ = {};
    forget_map();
}

void LiveProbe::forget_map() {
    map_.reset();
    picture_.reset();
    look_.reset();
    mapped_ = {};
    facts_ = {};
}

bool LiveProbe::hear() {
    std::optional<ProbeAnswer> answer = prober_.update();
    if (!answer) return false;
    take(std::move(*answer));
    return true;
}

void LiveProbe::take(ProbeAnswer answer) {
    is_known_ = answer.is_whole;
    if (!answer.is_whole && answer.map == ProbeMap::none) mapped_ = {};  // of a line still to come
    since_answer_.restart();
    std::optional<ProbeCost> cost = std::move(found_.cost);
    found_ = {};
    if (answer.problem.empty())
        found_ = probing_from_json(nlohmann::ordered_json::parse(answer.found));
    if (answer.map != ProbeMap::none) {
        ValueMap map{.size = answer.size, .components = answer.components, .values = {}};
        map.values.resize(answer.values.size() / sizeof(glm::vec4));
        std::memcpy(map.values.data(), answer.values.data(), answer.values.size());
        map.reached = std::move(answer.reached);
        facts_ = facts_of(map);
        map_ = std::move(map);
        row_ = -1;
        look_.reset();
        answer.values.clear();
    }
    if (map_ && asked_.pixel && row_ != asked_.pixel->y) {
        row_ = asked_.pixel->y;
        facts_.row = row_of(*map_, row_);
    }
    if (!found_.cost && asked_.cost) found_.cost = std::move(cost);  // it comes with a map alone
    answer_ = std::move(answer);
}

// Lines in view, and some around them; the same as before while that is enough.
Span LiveProbe::widened(const std::string& text, Span lines) const {
    if (asked_.lines.begin <= lines.begin && lines.end <= asked_.lines.end &&
        lines.begin < lines.end)
        return asked_.lines;
    for (int i = 0; i < kLinesAround + 1 && lines.begin > 0; ++i) {
        const std::size_t before = text.rfind('\n', lines.begin - 1);
        lines.begin = before == text.npos ? 0 : before;
    }
    if (lines.begin > 0) ++lines.begin;
    for (int i = 0; i < kLinesAround && lines.end < text.size(); ++i)
        lines.end = std::min(text.find('\n', lines.end), text.size() - 1) + 1;
    return lines;
}

// False while it does not rest.
bool LiveProbe::follow_subject(Playground& playground, const ProbeQuestion& question) {
    Subject now{.text = playground.preset()->scene.text,
                .values = playground.tweaks.values(),
                .watch = question.watch,
                .size = playground.size(),
                .pass = question.pass,
                .reports = playground.report_count()};
    if (subject_ && *subject_ == now) {
        next_.reset();
        return true;
    }
    if (!next_ || *next_ != now) {
        next_ = std::move(now);
        since_next_.restart();
    }
    if (subject_ && since_next_.ms() < kStands) return false;
    const bool is_other_text =
        !subject_ || subject_->text != next_->text || subject_->pass != next_->pass;
    if (is_other_text) {  // what was told is about other lines
        found_ = {};
        answer_ = {};
    }
    if (prober_.is_asking()) prober_.stop();  // nobody wants to know any more
    forget_map();
    subject_ = std::exchange(next_, std::nullopt);
    ++subject_number_;
    asked_ = {};
    is_known_ = false;
    return true;
}

bool LiveProbe::follow(Playground& playground, const ProbeQuestion& question) {
    const bool is_new = hear();
    is_waiting_ = false;
    prober_.prepare();
    const bool is_wanted =
        question.pixel || question.value || question.cost || !question.watch.empty();
    if (!is_wanted) return is_new;
    if (!follow_subject(playground, question)) {
        is_waiting_ = true;
        return is_new;
    }
    if (!question.value && !question.cost) forget_map();
    if (!is_same(seen_, question.lines)) since_scroll_.restart();
    seen_ = question.lines;
    // Who scrolls past some lines does not wait for what is compiled for them.
    const bool scrolls = since_scroll_.ms() < kStands;
    const Span lines = scrolls ? asked_.lines : widened(subject_->text, question.lines);
    if (prober_.is_asking()) {
        const bool has_lines = asked_.lines.begin < asked_.lines.end;
        if (!has_lines || is_same(lines, asked_.lines) || prober_.waited_ms() < kSayBusy)
            return is_new;
        prober_.stop();
        is_known_ = false;
        mapped_ = {};
    }
    const bool is_other_instant = instant_ != playground.picture_count();
    const bool wants_map =
        (question.value || question.cost) &&
        (is_other_instant || mapped_.value != question.value || mapped_.cost != question.cost);
    ProbeQuestion now = question;
    now.lines = lines;
    const bool is_other =
        !is_known_ || asked_.pixel != now.pixel || !is_same(asked_.lines, now.lines);
    if (!is_other && !wants_map && !is_other_instant) {
        is_waiting_ = scrolls;
        return is_new;
    }
    is_waiting_ = !is_other && !wants_map && since_answer_.ms() < kApart;
    if (!is_waiting_) ask(playground, now, wants_map);
    return is_new;
}

void LiveProbe::ask(Playground& playground, const ProbeQuestion& question, bool wants_map) {
    ProbeOrder order{.number = ++number_,
                     .subject = subject_number_,
                     .instant = playground.picture_count(),
                     .scene = playground.probe_order(question.pass, prober_.memory()),
                     .pass = question.pass,
                     .pixel = question.pixel,
                     .lines = question.lines};
    order.scene.preset.watch = question.watch;
    if (question.pass == kImagePass && question.pixel) {
        const Renderer& renderer = *playground.renderer();
        order.colour = renderer.read_pixel(renderer.graph_index(question.pass), 0, *question.pixel);
    }
    if (wants_map && question.value) {
        order.map = ProbeMap::value;
        order.line = question.value->line;
        order.column = question.value->column;
        order.file = question.value->file;
        order.name = question.value->name;
        order.kind = question.value->kind;
    } else if (wants_map) {
        order.map = ProbeMap::cost;
    }
    if (wants_map) mapped_ = question;
    asked_ = question;
    instant_ = playground.picture_count();
    prober_.ask(order);
}

const Buffer* LiveProbe::picture(ValueLook look) {
    if (!map_) return nullptr;
    if (look_ != look) {
        picture_ =
            buffer_of(mapped_.cost ? heat_of(*map_, facts_) : picture_of(*map_, facts_, look));
        look_ = look;
    }
    return picture_.get();
}

void LiveProbe::tell(ProbeFact& fact) const {
    fact.is_busy = prober_.is_asking();
    fact.compiles = prober_.waited_ms() > kSayBusy;
    fact.problem = answer_.problem;
    fact.notes = found_.notes;
    if (found_.same.starts_with("no"))
        fact.notes.push_back("The instrumented text draws another colour here, " + found_.same);
    if (found_.same == "discarded") fact.notes.push_back("This pixel is discarded.");
    const auto watched = static_cast<std::size_t>(answer_.watched);
    const std::span<const ProbeValue> all = found_.values;
    fact.watched = all.first(std::min(watched, all.size()));
    fact.values = all.subspan(std::min(watched, all.size()));
    fact.ran = answer_.ran;
    if (found_.cost) fact.cost = &*found_.cost;
    if (map_) fact.picture = &facts_;
}

}  // namespace glint
