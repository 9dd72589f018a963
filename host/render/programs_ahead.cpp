#include "render/programs_ahead.h"

#include <utility>

namespace glint {

ProgramsAhead::ProgramsAhead(const Preset& preset, const ProgramOptions& options,
                             const GiveUp& give_up)
    : preset_(preset), options_(options), give_up_(give_up), passes_(preset.scene.passes.size()) {
    if (context_.is_there()) thread_ = std::thread([this] { work(); });
}

ProgramsAhead::~ProgramsAhead() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    if (thread_.joinable()) thread_.join();
}

std::optional<ProgramsAhead::Linked> ProgramsAhead::take(std::size_t pass) {
    if (pass >= passes_.size()) return std::nullopt;
    std::unique_lock lock(mutex_);
    Pass& one = passes_[pass];
    if (one.state == State::waiting) one.state = State::done;
    changed_.wait(lock, [&] { return one.state == State::done; });
    return std::exchange(one.linked, std::nullopt);
}

// From the last one on: who asks begins with those that the picture's text names first.
void ProgramsAhead::work() {
    const auto current = context_.make_current();
    for (std::size_t pass = passes_.size(); pass-- > 0;) {
        if (!begin(pass)) continue;
        std::optional<Linked> linked;
        if (current) linked = link(pass);
        const std::lock_guard lock(mutex_);
        passes_[pass] = {State::done, std::move(linked)};
        changed_.notify_all();
    }
}

bool ProgramsAhead::begin(std::size_t pass) {
    const std::lock_guard lock(mutex_);
    if (ends_ || passes_[pass].state != State::waiting) return false;
    passes_[pass].state = State::begun;
    return true;
}

std::optional<ProgramsAhead::Linked> ProgramsAhead::link(std::size_t pass) const {
    std::optional<CompileWatch> watch;
    if (give_up_) watch.emplace(give_up_, preset_, pass);
    PassText source = pass_text(preset_, pass, options_);
    LinkedProgram linked = make_pass_program(source.text);
    if (!linked.program || !linked.log.empty()) return std::nullopt;
    return Linked{std::move(source), std::move(linked.program)};
}

}  // namespace glint
