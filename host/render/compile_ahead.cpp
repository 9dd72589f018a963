#include "render/compile_ahead.h"

#include "base/process_time.h"
#include "gl/context.h"
#include "render/compile_watch.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

namespace glint {

CompileAhead::CompileAhead(std::size_t passes, Compile compile, WorksOn works_on)
    : compile_(std::move(compile)), works_on_(std::move(works_on)), states_(passes), ms_(passes) {
    const unsigned most = std::min(std::thread::hardware_concurrency(), kMostTraps);
    for (unsigned i = 1; i < most; ++i) {
        ContextBeside& context = contexts_.emplace_back();
        if (!context.may_be()) break;
        threads_.emplace_back([this, &context] { work(context); });
    }
}

CompileAhead::~CompileAhead() {
    {
        const std::lock_guard lock(mutex_);
        std::ranges::replace(states_, State::waiting, State::done);
        rests_ = false;
    }
    changed_.notify_all();
    threads_.clear();
}

void CompileAhead::take(std::size_t pass) {
    std::unique_lock lock(mutex_);
    rests_ = pass + 1 == states_.size();
    changed_.notify_all();
    if (states_[pass] == State::waiting) states_[pass] = State::done;
    changed_.wait(lock, [&] { return states_[pass] == State::done; });
}

std::vector<double> CompileAhead::finish() {
    {
        const std::lock_guard lock(mutex_);
        rests_ = false;
    }
    changed_.notify_all();
    for (std::size_t pass = 0; pass < states_.size(); ++pass) compile(pass);
    threads_.clear();
    return ms_;
}

void CompileAhead::work(ContextBeside& context) {
    const auto current = context.make_current();
    if (!current) return;
    start_context();
    for (std::size_t pass = states_.size(); pass-- > 0;) compile(pass);
    glFinish();
}

void CompileAhead::compile(std::size_t pass) {
    if (!begin(pass)) return;
    const double began_ms = own_thread_ms();
    compile_(pass);
    end(pass, own_thread_ms() - began_ms);
}

bool CompileAhead::begin(std::size_t pass) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !rests_ || states_[pass] != State::waiting; });
    if (states_[pass] != State::waiting) return false;
    states_[pass] = State::begun;
    begun_.push_back(pass);
    if (begun_.size() == 1) tell();
    return true;
}

void CompileAhead::end(std::size_t pass, double ms) {
    const std::lock_guard lock(mutex_);
    states_[pass] = State::done;
    ms_[pass] = ms;
    const bool was_oldest = begun_.front() == pass;
    std::erase(begun_, pass);
    if (was_oldest) tell();
    changed_.notify_all();
}

void CompileAhead::tell() const {
    if (works_on_ && !begun_.empty()) works_on_(begun_.front());
}

}  // namespace glint
