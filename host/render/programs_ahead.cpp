#include "render/programs_ahead.h"

#include "gl/context.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace glint {
namespace {

std::vector<std::size_t> passes_read(const Preset& preset, std::size_t reader,
                                     const std::string& text) {
    std::vector<std::size_t> passes;
    for (const std::size_t sampler : samplers_named(preset, reader, text))
        if (sampler_at(preset, sampler).source == Source::buffer)
            passes.push_back(sampler_at(preset, sampler).pass);
    return passes;
}

}  // namespace

ProgramsAhead::ProgramsAhead(const Preset& preset, const ProgramOptions& options,
                             const GiveUp& give_up)
    : preset_(preset), options_(options), give_up_(give_up), passes_(preset.scene.passes.size()) {
    using namespace std::chrono_literals;
    const auto patience = draws_in_software() ? 0ms : 60ms;
    if (context_.may_be()) thread_ = std::thread([this, patience] { work(patience); });
}

ProgramsAhead::~ProgramsAhead() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

std::optional<ProgramsAhead::Linked> ProgramsAhead::take(std::size_t pass) {
    if (pass >= passes_.size()) return std::nullopt;
    std::unique_lock lock(mutex_);
    Pass& one = passes_[pass];
    if (one.state == State::waiting) one.state = State::done;
    while (one.state != State::done) {
        const auto other = std::ranges::find_if(wanted_.rbegin(), wanted_.rend(), [&](auto at) {
            return passes_[at].state == State::waiting;
        });
        if (other == wanted_.rend()) {
            changed_.wait(lock);
            continue;
        }
        const std::size_t begun = *other;
        passes_[begun].state = State::begun;
        lock.unlock();
        link(begun);
        lock.lock();
    }
    return std::exchange(one.linked, std::nullopt);
}

// A GPU's driver that has kept what it compiled needs no help, and its contexts take 10 to 40 ms.
bool ProgramsAhead::ends_before(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return ends_; });
}

void ProgramsAhead::work(std::chrono::milliseconds patience) {
    if (ends_before(patience)) return;
    const auto current = context_.make_current();
    if (!current) return;
    want(passes_read(preset_, kImagePass, pass_text(preset_, kImagePass, options_).text));
    while (const auto pass = begin_next()) link(*pass);
}

std::optional<std::size_t> ProgramsAhead::begin_next() {
    const std::lock_guard lock(mutex_);
    const auto next = std::ranges::find_if(
        wanted_, [&](std::size_t pass) { return passes_[pass].state == State::waiting; });
    if (ends_ || next == wanted_.end()) return std::nullopt;
    passes_[*next].state = State::begun;
    return *next;
}

void ProgramsAhead::want(const std::vector<std::size_t>& passes) {
    const std::lock_guard lock(mutex_);
    for (const std::size_t pass : passes)
        if (std::ranges::find(wanted_, pass) == wanted_.end()) wanted_.push_back(pass);
}

void ProgramsAhead::link(std::size_t pass) {
    PassText source = pass_text(preset_, pass, options_);
    want(passes_read(preset_, pass, source.text));
    std::optional<CompileWatch> watch;
    if (give_up_) watch.emplace(give_up_, preset_, pass);
    LinkedProgram linked = make_pass_program(source.text);
    watch.reset();
    glFinish();  // before another context takes it (GL 4.5, 5.3)
    const std::lock_guard lock(mutex_);
    Pass& one = passes_[pass];
    if (linked.program && linked.log.empty())
        one.linked = Linked{std::move(source), std::move(linked.program)};
    one.state = State::done;
    changed_.notify_all();
}

}  // namespace glint
