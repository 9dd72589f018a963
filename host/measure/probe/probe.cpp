#include "measure/probe/probe.h"

#include "glsl/probe_types.h"
#include "offline/common.h"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace glint {
namespace {

constexpr int kMostTries = 6;  // at leaving out what the driver refuses
constexpr int kCellsInRow = 256;
constexpr int kMostCells = 65536;  // at once
constexpr int kEvery = std::numeric_limits<int>::max();

const char* kind_of(SiteKind kind) {
    switch (kind) {
        case SiteKind::assigned:
            return "assigned";
        case SiteKind::parameter:
            return "parameter";
        case SiteKind::returned:
            return "returned";
        case SiteKind::condition:
            return "condition";
        case SiteKind::reached:
            return "reached";
        case SiteKind::expression:
            return "expression";
        case SiteKind::assertion:
            return "assertion";
        case SiteKind::turn:
            return "turn";
        case SiteKind::read:
            return "read";
        case SiteKind::call:
            return "call";
        case SiteKind::sum:
            return "sum";
        case SiteKind::operand:
            return "operand";
        case SiteKind::division:
            return "division";
        case SiteKind::remainder:
            return "remainder";
        case SiteKind::domain:
            return "domain";
        case SiteKind::bounds:
            return "bounds";
        case SiteKind::whole:
            return "whole";
        case SiteKind::unset:
            return "unset";
        case SiteKind::index:
            return "index";
    }
    return "";
}

std::size_t outputs_of(const Preset& preset, std::size_t pass) {
    return output_names(preset.scene, pass).size();
}

// One number of a value, by its type's first letter: float, int, uint, bool.
double number_of(std::uint32_t bits, std::string_view type) {
    if (type.starts_with("i")) return static_cast<double>(std::bit_cast<std::int32_t>(bits));
    if (type.starts_with("u") || type.starts_with("b")) return static_cast<double>(bits);
    return static_cast<double>(std::bit_cast<float>(bits));
}

std::string said(const Diagnostics& diagnostics, bool with_place) {
    for (const Diagnostic& one : diagnostics)
        if (one.severity == Severity::error) return with_place ? to_string(one) : one.text;
    return "the driver gave no reason";
}

// Of an expression that the driver refuses: nobody but the probe has called a function of it.
std::string in_words_of_the_text(std::string why) {
    if (why.find("glint0_v(") != why.npos)
        return "it is of a type that is not told, such as a whole array: name an element";
    if (why.find("glint0_a(") != why.npos) return "it is neither true nor false";
    return why;
}

}  // namespace

ProbeTarget::ProbeTarget(glm::ivec2 size, std::size_t outputs)
    : size_(size), outputs_(outputs), framebuffer_(make_framebuffer()) {
    std::vector<GLenum> drawn;
    for (std::size_t i = 0; i < outputs + 2; ++i) {
        const GLenum at = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        textures_.push_back(make_unfilled_texture_2d(i < outputs ? GL_RGBA32F : GL_RGBA32UI, size));
        glNamedFramebufferTexture(framebuffer_.id(), at, textures_.back().id(), 0);
        drawn.push_back(at);
    }
    glNamedFramebufferDrawBuffers(framebuffer_.id(), static_cast<GLsizei>(drawn.size()),
                                  drawn.data());
    constexpr std::array<GLuint, 4> kNothing{};
    for (std::size_t i = outputs; i < outputs + 2; ++i)  // where a fragment is discarded
        glClearNamedFramebufferuiv(framebuffer_.id(), GL_COLOR, static_cast<GLint>(i),
                                   kNothing.data());
}

std::vector<ProbeCell> ProbeTarget::read() const {
    const std::size_t count = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
    std::vector<std::array<std::uint32_t, 4>> words(count);
    std::vector<ProbeCell> cells(count);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
    const auto take = [&](std::size_t attachment, GLenum format, GLenum type, auto member) {
        glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
        glReadPixels(0, 0, size_.x, size_.y, format, type, words.data());
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy((cells[i].*member).data(), words[i].data(), sizeof words[i]);
    };
    take(outputs_, GL_RGBA_INTEGER, GL_UNSIGNED_INT, &ProbeCell::kept);
    take(outputs_ + 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, &ProbeCell::told);
    take(0, GL_RGBA, GL_FLOAT, &ProbeCell::colour);
    return cells;
}

Probe::Probe(const Preset& preset, std::size_t pass, ProgramOptions options, ProbeWish wish,
             GiveUp give_up)
    : preset_(preset),
      pass_(pass),
      outputs_(outputs_of(preset, pass)),
      give_up_(std::move(give_up)) {
    for (const ProbeExpression& one : wish.expressions) {
        const std::string refusal = refusal_of_expression(one.text);
        if (!refusal.empty())
            throw ProbeRefused(fmt::format("{}: {}.", in_quotes(one.text), refusal));
    }
    options.lean = options.feed = options.tiles = options.average = false;
    compile(options, wish);
    ask_location_ = glGetUniformLocation(program_->id, "glint0_ask");
    place_location_ = glGetUniformLocation(program_->id, "glint0_place");
}

// What the driver refuses is left out, line by line.
void Probe::compile(const ProgramOptions& options, ProbeWish& wish) {
    std::optional<CompileWatch> watch;
    if (give_up_) watch.emplace(give_up_, preset_, pass_);
    std::string why;
    for (int i = 0; i < kMostTries; ++i) {
        PassText text = pass_text(preset_, pass_, options, &wish);
        probed_ = std::move(text.probed);
        for (std::size_t k = 0; k < probed_.refused.size(); ++k)
            if (!probed_.refused[k].empty() && !wish.expressions[k].is_note)
                throw ProbeRefused(fmt::format("{}: {}.", in_quotes(wish.expressions[k].text),
                                               probed_.refused[k]));
        CompiledPass compiled = compile_text(preset_, pass_, std::move(text));
        program_ = std::move(compiled.program);
        if (program_) break;
        why = said(compiled.diagnostics, wish.expressions.size() != 1);
        if (!wish.expressions.empty()) why = in_words_of_the_text(std::move(why));
        std::size_t found = 0;
        for (const ProbeSite& site : probed_.sites) {
            const Place place = preset_.scene.place_at(site.at);
            const bool is_wrong =
                std::ranges::any_of(compiled.diagnostics, [&](const Diagnostic& one) {
                    return one.severity == Severity::error && one.place.file == place.file &&
                           one.place.line == place.line;
                });
            if (is_wrong && wish.expressions.empty()) wish.without.push_back(site.at), ++found;
        }
        if (found == 0) break;
    }
    if (!program_ && wish.expressions.size() == 1)  // which stands elsewhere than its line
        throw ProbeRefused(fmt::format("{}: {}", in_quotes(wish.expressions.front().text), why));
    if (!program_)
        throw ProbeRefused(fmt::format("The driver takes no instrumented text of pass {}: {}",
                                       pass_name(preset_.scene, pass_), why));
    for (const std::size_t at : wish.without) probed_.left_out.push_back(at);
}

std::vector<std::string> Probe::notes() const {
    std::vector<std::string> notes;
    std::vector<std::size_t> places = probed_.left_out;
    std::ranges::sort(places);
    places.erase(std::ranges::unique(places).begin(), places.end());
    for (const std::size_t at : places) {
        const Place place = preset_.scene.place_at(at);
        notes.push_back(
            fmt::format("{}:{}:{}: what is given a value here is not told: it is an array of "
                        "arrays, a macro's, "
                        "or an element whose index changes",
                        place.file, place.line, place.column));
    }
    return notes;
}

std::size_t Probe::index_in(const Renderer& renderer) const {
    return renderer.graph_index(pass_);
}

void Probe::draw(Renderer& renderer, const Frame& frame, const ProbeTarget& target, const Ask& ask,
                 glm::ivec4 place, int face) {
    glProgramUniform4i(program_->id, ask_location_, ask.site, ask.hit, ask.site_step, ask.hit_step);
    glProgramUniform4i(program_->id, place_location_, place.x, place.y, place.z, place.w);
    std::optional<CompileWatch> watch;
    if (give_up_ && !std::exchange(is_drawn_, true)) watch.emplace(give_up_, preset_, pass_);
    renderer.draw_variant(
        {.program = *program_, .framebuffer = target.id(), .size = target.size(), .face = face},
        frame);
}

// A cell is a quad whose fragments evaluate the pixel's own quad, so that derivatives are true.
std::vector<ProbeCell> Probe::ask(Renderer& renderer, const Frame& frame, const ProbePlace& place,
                                  const Ask& ask) {
    std::vector<ProbeCell> cells;
    const glm::ivec2 quad = place.pixel - place.pixel % 2;
    for (int from = 0; from < ask.count; from += kMostCells) {
        const int count = std::min(ask.count - from, kMostCells);
        const int row = std::min(count, kCellsInRow);
        const ProbeTarget target({2 * row, 2 * ((count + row - 1) / row)}, outputs_);
        Ask part = ask;
        part.site += from * ask.site_step;
        if (ask.hit_step != 0) part.hit += from * ask.hit_step;
        draw(renderer, frame, target, part, {quad, row, 0}, place.face);
        const std::vector<ProbeCell> all = target.read();
        for (int i = 0; i < count; ++i) {
            const glm::ivec2 at = glm::ivec2(i % row, i / row) * 2 + place.pixel % 2;
            cells.push_back(all[static_cast<std::size_t>(at.y * 2 * row + at.x)]);
        }
    }
    if (cells.empty()) return cells;
    colour_ = cells.front().colour;
    is_discarded_ = cells.front().told[3] == 0;
    return cells;
}

ProbeValue Probe::row(std::size_t index) const {
    const ProbeSite& site = probed_.sites[index];
    const Place place = preset_.scene.place_at(site.at);
    return {.file = place.file,
            .line = place.line,
            .column = place.column,
            .function = site.function,
            .name = site.name,
            .kind = kind_of(site.kind),
            .site = index};
}

std::vector<double> value_of(const ProbeCell& cell) {
    const std::string_view type = probe_type(cell.told[2]);
    if (type.empty()) return {};
    const char last = type.back();
    const int count = last >= '2' && last <= '4' ? last - '0' : 1;
    std::vector<double> value;
    for (int i = 0; i < count; ++i)
        value.push_back(number_of(cell.kept[static_cast<std::size_t>(i)], type));
    return value;
}

namespace {

void fill(ProbeValue& row, const ProbeCell& cell, int hit) {
    row.type = probe_type(cell.told[2]);
    row.hits = static_cast<int>(cell.told[0]);
    row.hit = std::min(hit, row.hits);
    row.order = static_cast<int>(cell.told[1]);
    row.value = value_of(cell);
}

}  // namespace

// The second leaf and further ones of a matrix or a struct, whose first is at the end of `rows`.
void Probe::add_leaves(Renderer& renderer, const Frame& frame, const ProbePlace& place,
                       std::size_t site, const Ask& like, std::uint32_t tag,
                       std::vector<ProbeValue>& rows) {
    const ProbeLeaves leaves = leaves_of(tag, probed_);
    if (leaves.empty()) return;
    const ProbeValue first = rows.back();
    rows.back().name += leaves.front();
    if (leaves.size() == 1) return;
    const std::vector<ProbeCell> cells =
        ask(renderer, frame, place,
            {.site = static_cast<int>(site) + (1 << kProbeLeafShift),
             .hit = like.hit,
             .site_step = 1 << kProbeLeafShift,
             .count = static_cast<int>(leaves.size()) - 1});
    for (std::size_t i = 1; i < leaves.size(); ++i) {
        ProbeValue leaf = first;
        leaf.name += leaves[i];
        fill(leaf, cells[i - 1], first.hit);
        leaf.order = first.order;
        rows.push_back(std::move(leaf));
    }
}

std::vector<ProbeValue> Probe::values_at(Renderer& renderer, const Frame& frame,
                                         const ProbePlace& place,
                                         std::vector<std::uint32_t>* hits) {
    const Ask every{.hit = kEvery, .site_step = 1, .count = static_cast<int>(probed_.sites.size())};
    const std::vector<ProbeCell> cells = ask(renderer, frame, place, every);
    std::vector<ProbeValue> rows;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (hits) hits->push_back(cells[i].told[0]);
        if (cells[i].told[0] == 0) continue;
        rows.push_back(row(i));
        fill(rows.back(), cells[i], kEvery);
        add_leaves(renderer, frame, place, i, every, cells[i].told[2], rows);
    }
    std::ranges::stable_sort(
        rows, {}, [](const ProbeValue& one) { return std::tuple(one.file, one.line, one.column); });
    return rows;
}

std::vector<ProbeValue> Probe::hits_at(Renderer& renderer, const Frame& frame,
                                       const ProbePlace& place, int most) {
    const Ask every{.hit = kEvery, .site_step = 1, .count = static_cast<int>(probed_.sites.size())};
    const std::vector<ProbeCell> found = ask(renderer, frame, place, every);
    std::vector<ProbeValue> rows;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const int hits = static_cast<int>(found[i].told[0]);
        if (hits == 0) continue;
        const ProbeLeaves leaves = leaves_of(found[i].told[2], probed_);
        std::vector<std::vector<ProbeCell>> cells;
        for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
            cells.push_back(ask(renderer, frame, place,
                                {.site = static_cast<int>(i + (leaf << kProbeLeafShift)),
                                 .hit = 1,
                                 .hit_step = 1,
                                 .count = std::min(hits, most)}));
        for (int hit = 1; hit <= std::min(hits, most); ++hit) {
            for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
                const auto at = static_cast<std::size_t>(hit) - 1;
                rows.push_back(row(i));
                rows.back().name += leaves[leaf];
                fill(rows.back(), cells[leaf][at], hit);
                rows.back().order = static_cast<int>(cells[0][at].told[1]);
            }
        }
    }
    std::ranges::stable_sort(rows, {}, &ProbeValue::order);
    return rows;
}

std::vector<std::uint32_t> Probe::hits_of_sites(Renderer& renderer, const Frame& frame,
                                                const ProbePlace& place) {
    std::vector<std::uint32_t> hits;
    const Ask every{.hit = kEvery, .site_step = 1, .count = static_cast<int>(probed_.sites.size())};
    for (const ProbeCell& cell : ask(renderer, frame, place, every)) hits.push_back(cell.told[0]);
    return hits;
}

std::vector<ProbeCell> Probe::map(Renderer& renderer, const Frame& frame, std::size_t site, int hit,
                                  int face) {
    const glm::ivec2 size = renderer.buffer(index_in(renderer)).shape().size;
    const ProbeTarget target(size, outputs_);
    draw(renderer, frame, target, {.site = static_cast<int>(site), .hit = hit == 0 ? kEvery : hit},
         glm::ivec4(0), face);
    return target.read();
}

std::vector<ProbeCell> Probe::rounded(Renderer& renderer, const Frame& frame, int site, int seed) {
    const ProbeTarget target(renderer.buffer(index_in(renderer)).shape().size, outputs_);
    draw(renderer, frame, target, {.site = site, .hit = seed}, glm::ivec4(0), 0);
    return target.read();
}

std::vector<ProbeCell> Probe::survey(Renderer& renderer, const Frame& frame, int first, int mend,
                                     int face) {
    const ProbeTarget target(renderer.buffer(index_in(renderer)).shape().size, outputs_);
    draw(renderer, frame, target, {.site = first, .hit = mend},
         {0, 0, 0, static_cast<int>(probed_.sites.size())}, face);
    return target.read();
}

namespace {

// A half that this may become: that which was drawn, where it is one of the two around it.
float as_half(float value, float drawn) {
    const float nearest = glm::unpackHalf1x16(glm::packHalf1x16(value));
    if (std::isnan(value) || std::abs(nearest) <= std::abs(value)) return nearest;
    const auto bits = static_cast<std::uint16_t>(glm::packHalf1x16(nearest) - 1);
    const float cut = glm::unpackHalf1x16(bits);  // towards zero
    return drawn == cut ? cut : nearest;
}

}  // namespace

std::string same_colour(const glm::vec4& plain, const std::array<float, 4>& probed,
                        PixelFormat format) {
    bool same_bits = true, same_bytes = true;
    const auto byte = [](float v) {
        return v > 0.0f ? std::lround(std::min(v, 1.0f) * 255.0f) : 0;
    };
    for (int c = 0; c < channel_count(format); ++c) {
        float a = plain[c], b = probed[static_cast<std::size_t>(c)];
        if (bytes_a_channel(format) == 2) b = as_half(b, a);
        const bool both_nan = std::isnan(a) && std::isnan(b);
        if (bytes_a_channel(format) == 1 && b > 0.0f) {  // of halves a driver takes either byte
            constexpr float kHalf = 0.5f + 1e-4f;
            if (std::abs(std::min(b, 1.0f) * 255.0f - a * 255.0f) <= kHalf) b = a;
        }
        same_bits &= both_nan || a == b;
        same_bytes &= byte(a) == byte(b);
    }
    if (same_bits) return "bits";
    if (same_bytes) return "bytes";
    return fmt::format("no: plain ({:.7g}, {:.7g}, {:.7g}), probed ({:.7g}, {:.7g}, {:.7g})",
                       plain.x, plain.y, plain.z, probed[0], probed[1], probed[2]);
}

}  // namespace glint
