// What a renderer takes over from another, and the buffers that need not be drawn for it: a map,
// such as the light on a land, may take longer than all the rest of a frame.
#include "render/renderer.h"

#include <algorithm>
#include <utility>

namespace glint {
namespace {

// Drawn or not.
bool has_pass(const Scene& scene, const std::string& name) {
    for (std::size_t i = 0; i < scene.passes.size(); ++i)
        if (pass_name(scene, i) == name) return true;
    return name == pass_name(scene, kImagePass);
}

}  // namespace

bool Renderer::is_map(std::size_t index) const {
    const PassProgram& program = scene_.programs[index];
    const GraphPass& pass = scene_.graph.passes[index];
    if (index == scene_.root || !fills_a_buffer(program.pass)) return false;
    if (pass.feedback || pass.previous || pass.carries || pass.runs != Runs::on_change)
        return false;
    // With a size of its own, its resolution is that.
    const bool asks_for_more = std::ranges::any_of(program.builtins, [](const BuiltinUniform& one) {
        return one.builtin != Builtin::resolution && one.builtin != Builtin::resolution_2d;
    });
    if (asks_for_more) return false;
    if (!preset_.scene.passes[program.pass].size || !channels_told_of(preset_, program).empty())
        return false;
    return std::ranges::all_of(program.samplers, [&](const SamplerUniform& uniform) {
        const Sampler& read = sampler_at(preset_, uniform.sampler);
        return read.source == Source::buffer && is_map(graph_index(read.pass));
    });
}

bool Renderer::is_fed(std::size_t index) const {
    const PassProgram& program = scene_.programs[index];
    return !program.tweaks.empty() || program.numbers_location >= 0;
}

bool Renderer::is_fed() const {
    for (std::size_t i = 0; i < scene_.programs.size(); ++i)
        if (is_fed(i)) return true;
    return false;
}

// As far as a fed program asks for them.
bool Renderer::has_values_of(std::size_t index, const std::vector<TweakValue>& values) const {
    if (values.size() != values_.size()) return false;
    return std::ranges::all_of(scene_.programs[index].tweaks, [&](const TweakUniform& uniform) {
        return values[uniform.tweak] == values_[uniform.tweak];
    });
}

void Renderer::note_content(std::size_t index) {
    if (!is_map(index)) return;
    drawn_[index].content = {.values = is_fed() ? values_ : built_values_,
                             .is_exact = !is_fed(index)};
}

// Everything is looked at again.
void Renderer::offer_maps() {
    for (Drawn& drawn : drawn_) {
        drawn.ever = false;
        drawn.rows = 0;
        if (drawn.content) drawn.content->from = Content::From::offered;
    }
}

// Whether the pass need not be drawn for what it is to be drawn with.
bool Renderer::holds(std::size_t index) {
    using enum Content::From;
    std::optional<Content>& content = drawn_[index].content;
    if (!content || content->from != offered || !content->is_whole || !is_map(index)) return false;
    if (!content->is_exact && !is_fed(index)) return false;
    const bool has_values =
        is_fed() ? has_values_of(index, content->values) : content->values == built_values_;
    const bool has_inputs =
        std::ranges::all_of(scene_.programs[index].samplers, [&](const SamplerUniform& uniform) {
            const std::size_t pass = sampler_at(preset_, uniform.sampler).pass;
            const std::optional<Content>& read = drawn_[graph_index(pass)].content;
            return read && read->from == held;
        });
    if (!has_values || !has_inputs) return false;
    content->from = held;
    return true;
}

bool Renderer::goes_in_parts(std::size_t index) const {
    return map_seconds_ > 0.0 && !buffers_[index]->shape().cube && is_map(index);
}

bool Renderer::is_mixed_map(std::size_t graph_index) const {
    const std::optional<Content>& content = drawn_[graph_index].content;
    return is_map(graph_index) && !(content && content->is_whole);
}

// Looks at what it is to be drawn with, which is sent; a change on the way counts for what is left
// of it, and has it drawn once more.
bool Renderer::is_due(std::size_t index, const Frame& frame) {
    Drawn& drawn = drawn_[index];
    const bool new_uniforms = update_uniforms(index, {.frame = frame});
    const bool new_buffers = update_versions(index);
    const bool is_new = new_uniforms || new_buffers || !drawn.ever;
    drawn.ever = true;
    if (!is_new || (!drawn.is_due && holds(index))) return drawn.is_due;
    drawn.is_due_again |= drawn.rows > 0;
    drawn.is_due = true;
    return true;
}

// In turn, each to its end, until time is over.
void Renderer::draw_maps(const Frame& frame) {
    has_maps_left_ = false;
    const Stopwatch clock;
    for (std::size_t idle = 0; idle < scene_.programs.size();) {
        const bool is_drawn = goes_in_parts(map_at_) && is_due(map_at_, frame);
        if (is_drawn)
            has_maps_left_ = !draw_rows(map_at_, frame, clock) || clock.seconds() > map_seconds_;
        if (drawn_[map_at_].rows > 0) return;
        map_at_ = (map_at_ + 1) % scene_.programs.size();
        if (has_maps_left_) return;
        idle = is_drawn ? 0 : idle + 1;
    }
    map_at_ = 0;  // those that others read go first
}

// From where it was left; false while rows are left.
bool Renderer::draw_rows(std::size_t index, const Frame& frame, const Stopwatch& clock) {
    Drawn& drawn = drawn_[index];
    Buffer& buffer = *buffers_[index];
    const glm::ivec2 size = buffer.shape().size;
    drawing_ = &frame;
    if (before_pass) before_pass(index);
    drawing_ = nullptr;
    if (ahead_) ahead_->take(index);
    glUseProgram(scene_.programs[index].id);
    bind(bindings_of(scene_.programs[index]));
    glBindFramebuffer(GL_FRAMEBUFFER, buffer.target());
    glViewport(0, 0, size.x, size.y);
    glEnable(GL_SCISSOR_TEST);
    for (double now = clock.seconds(), last = now; drawn.rows < size.y; last = now) {
        const double fit =
            drawn.row_seconds > 0.0 ? (map_seconds_ - now) / drawn.row_seconds : size.y / 32.0;
        const int rows = std::clamp(static_cast<int>(std::min(fit, 1e6)), 1, size.y - drawn.rows);
        glScissor(0, drawn.rows, size.x, rows);
        draw_once(index);
        glFinish();
        now = clock.seconds();
        drawn.row_seconds = (now - last) / rows;
        drawn.rows += rows;
        if (now > map_seconds_) break;
    }
    glDisable(GL_SCISSOR_TEST);
    drawn.content = {.values = {}, .is_whole = false};
    const bool is_whole = drawn.rows == size.y;
    if (is_whole) {
        buffer.finish_draw();
        drawn.rows = 0;
        drawn.is_due = std::exchange(drawn.is_due_again, false);
        if (!drawn.is_due) note_content(index);
    } else {
        buffer.finish_part();
    }
    if (after_pass) after_pass(index);
    return is_whole;
}

// What stands here, in the words of another text.
std::optional<Renderer::Content> Renderer::content_for(const Renderer& next,
                                                       std::size_t index) const {
    const PassProgram& program = scene_.programs[index];
    std::optional<Content> content = drawn_[index].content;
    const auto there = std::ranges::find_if(next.scene_.programs, [&](const PassProgram& other) {
        return pass_name(next.preset_.scene, other.pass) == pass_name(preset_.scene, program.pass);
    });
    if (!content || there == next.scene_.programs.end()) return std::nullopt;
    const auto place = static_cast<std::size_t>(there - next.scene_.programs.begin());
    if (!next.is_map(place) || !next.says_the_same(place, *this, index)) return std::nullopt;
    // What no fed program asks for may have moved since.
    const bool holds_now = drawn_[index].ever && is_fed() && has_values_of(index, content->values);
    const std::vector<TweakValue>& values = holds_now ? values_ : content->values;
    if (values.size() != preset_.scene.tweaks.size()) return std::nullopt;
    if (next.values_.size() != next.preset_.scene.tweaks.size()) return std::nullopt;
    Content told{.values = {},
                 .is_exact = content->is_exact,
                 .is_whole = content->is_whole,
                 .from = Content::From::offered};
    for (const Tweak& tweak : next.preset_.scene.tweaks) {
        const auto same = std::ranges::find_if(preset_.scene.tweaks, [&](const Tweak& mine) {
            return mine.name == tweak.name && mine.type == tweak.type;
        });
        const auto mine = static_cast<std::size_t>(same - preset_.scene.tweaks.begin());
        // What says the same does not ask for a new one.
        const bool is_new_tweak = same == preset_.scene.tweaks.end();
        told.values.push_back(is_new_tweak ? next.values_[told.values.size()] : values[mine]);
    }
    return told;
}

// Whether a map is drawn by the same words there, from samplers that are set alike.
bool Renderer::says_the_same(std::size_t index, const Renderer& previous, std::size_t there) const {
    const PassProgram& mine = scene_.programs[index];
    const PassProgram& other = previous.scene_.programs[there];
    for (const SamplerUniform& uniform : mine.samplers) {
        const Sampler& read = sampler_at(preset_, uniform.sampler);
        bool is_same = false;
        for (std::size_t i = 0; i < sampler_count(previous.preset_); ++i) {
            const Sampler& old = sampler_at(previous.preset_, i);
            is_same |=
                old.name == read.name && old.tab == read.tab && old.source == read.source &&
                old.filter == read.filter && old.wrap == read.wrap && old.output == read.output &&
                pass_name(previous.preset_.scene, old.pass) == pass_name(preset_.scene, read.pass);
        }
        if (!is_same) return false;
    }
    if (preset_.scene.text == previous.preset_.scene.text) return true;
    if (mine.id == other.id && mine.numbers == other.numbers) return true;
    constexpr ProgramOptions kPlain{.specialise = false, .lean = true};
    return pass_text(preset_, mine.pass, kPlain).text ==
           pass_text(previous.preset_, other.pass, kPlain).text;
}

std::vector<std::size_t> Renderer::maps() const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < scene_.programs.size(); ++i)
        if (is_map(i)) list.push_back(i);
    return list;
}

std::optional<std::vector<std::byte>> Renderer::map_bytes() const {
    std::vector<std::byte> all;
    for (const std::size_t index : maps()) {
        const std::optional<Content>& content = drawn_[index].content;
        if (!content || !drawn_[index].ever || !content->is_exact || !content->is_whole ||
            is_fed() || content->values != built_values_)
            return std::nullopt;
        const std::vector<std::byte> bytes = buffers_[index]->bytes();
        all.insert(all.end(), bytes.begin(), bytes.end());
    }
    return all;
}

bool Renderer::set_map_bytes(std::span<const std::byte> bytes) {
    std::size_t wanted = 0;
    for (const std::size_t index : maps()) wanted += buffers_[index]->byte_count();
    if (wanted != bytes.size()) return false;
    for (const std::size_t index : maps()) {
        const std::size_t count = buffers_[index]->byte_count();
        buffers_[index]->set_bytes(bytes.first(count));
        bytes = bytes.subspan(count);
        drawn_[index].content = {.values = built_values_, .from = Content::From::offered};
    }
    return true;
}

void Renderer::adopt(Renderer& previous) {
    options_.size = previous.options_.size;
    channels_.adopt(previous.channels_);
    parked_ = std::move(previous.parked_);
    // What was drawn last is kept whatever it is called: `previous` may have to go on.
    std::erase_if(parked_, [&](const auto& kept) { return !has_pass(preset_.scene, kept.first); });
    std::vector<std::pair<std::string, std::optional<Content>>> contents;
    for (std::size_t i = 0; i < previous.buffers_.size(); ++i) {
        const std::string name =
            pass_name(previous.preset_.scene, previous.scene_.programs[i].pass);
        contents.emplace_back(name, previous.content_for(*this, i));
        parked_[name] = {std::move(previous.buffers_[i]), previous.steps_done_[i]};
    }
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        forget_drawn(i);  // the other one may have fed the same programs
        const BufferShape shape = wanted_shape(i);
        const auto kept = parked_.find(pass_name(preset_.scene, scene_.programs[i].pass));
        if (kept != parked_.end() && kept->second.buffer->shape() == shape) {
            buffers_[i] = std::move(kept->second.buffer);
            const auto content =
                std::ranges::find(contents, kept->first, &decltype(contents)::value_type::first);
            if (content != contents.end()) drawn_[i].content = std::move(content->second);
        } else {
            if (!buffers_[i] || buffers_[i]->shape() != shape)
                buffers_[i] = std::make_unique<Buffer>(shape);
            if (kept != parked_.end()) buffers_[i]->copy_from(*kept->second.buffer);
        }
        if (kept == parked_.end()) continue;
        steps_done_[i] = kept->second.steps_done;
        parked_.erase(kept);
    }
}

}  // namespace glint
