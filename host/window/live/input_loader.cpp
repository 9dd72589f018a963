#include "window/live/input_loader.h"

#include <fcntl.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <thread>
#include <utility>

namespace glint {
namespace {

using namespace std::chrono_literals;

// More at once only take each other's memory.
constexpr int kMostAtOnce = 4;

// Small files are there within that, and need not be missing from the first picture.
constexpr auto kGlance = 30ms;

bool is_ready(const std::future<InputContent>& content) {
    return content.valid() && content.wait_for(0s) == std::future_status::ready;
}

// The thread owns all that it uses, so that nobody has to wait for its end.
std::future<InputContent> read_beside(const Sampler& sampler, const TextureLimits& limits,
                                      int wake) {
    std::packaged_task<InputContent()> task(
        [sampler, limits] { return decode_input(sampler, limits); });
    std::future<InputContent> content = task.get_future();
    const int own_wake = ::fcntl(wake, F_DUPFD_CLOEXEC, 0);
    std::thread([task = std::move(task), own_wake]() mutable {
        // Drawing goes first.
        ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10);
        task();
        ::eventfd_write(own_wake, 1);
        ::close(own_wake);
    }).detach();
    return content;
}

}  // namespace

bool same_input(const Sampler& a, const Sampler& b) {
    return a.name == b.name && a.tab == b.tab && a.source == b.source && a.files == b.files &&
           a.vflip == b.vflip;
}

InputLoader::InputLoader(const TextureLimits& limits)
    : limits_(limits), wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (wake_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

InputLoader::~InputLoader() {
    ::close(wake_);
}

InputLoader::Load* InputLoader::find(const Sampler& sampler) {
    const auto load = std::find_if(loads_.begin(), loads_.end(),
                                   [&](const Load& l) { return same_input(l.sampler, sampler); });
    return load == loads_.end() ? nullptr : &*load;
}

void InputLoader::load(const Sampler& sampler) {
    Load* known = find(sampler);
    if (!known) {
        loads_.push_back({.sampler = sampler, .content = {}, .since = {}});
    } else if (!known->wanted) {
        // Nobody has followed the file since.
        known->wanted = known->again = true;
        known->since.restart();
    }
    start_waiting();
}

void InputLoader::load_again(const Sampler& sampler) {
    if (Load* known = find(sampler)) known->again = known->content.valid();
    load(sampler);
}

void InputLoader::keep_only(const Preset& preset) {
    for (Load& load : loads_) {
        bool named = false;
        for (std::size_t i = 0; i < sampler_count(preset); ++i)
            named |= same_input(load.sampler, sampler_at(preset, i));
        load.wanted &= named;
    }
    std::erase_if(loads_, [](const Load& l) { return !l.wanted && !l.content.valid(); });
}

void InputLoader::start_waiting() {
    auto reading = std::ranges::count_if(loads_, [](const Load& l) { return l.content.valid(); });
    for (Load& load : loads_) {
        if (reading >= kMostAtOnce) return;
        if (load.content.valid()) continue;
        load.content = read_beside(load.sampler, limits_, wake_);
        ++reading;
    }
}

InputLoader::Loaded InputLoader::result_of(Load& load) {
    Loaded loaded{.sampler = load.sampler, .input = {}, .error = {}, .ms = load.since.ms()};
    try {
        loaded.input = load.content.get();
    } catch (const std::exception& error) {
        loaded.error = error.what();
    }
    return loaded;
}

std::vector<InputLoader::Loaded> InputLoader::take() {
    eventfd_t count = 0;
    ::eventfd_read(wake_, &count);
    std::vector<Loaded> list;
    for (auto load = loads_.begin(); load != loads_.end();) {
        if (!is_ready(load->content)) {
            ++load;
            continue;
        }
        Loaded loaded = result_of(*load);
        // A file that is written while it is read may look broken; the next reading tells.
        const bool counts = load->wanted && (loaded.input || !load->again);
        if (counts) list.push_back(std::move(loaded));
        const bool once_more = load->wanted && std::exchange(load->again, false);
        load = once_more ? load + 1 : loads_.erase(load);
    }
    start_waiting();
    return list;
}

void InputLoader::glance() const {
    const auto end = std::chrono::steady_clock::now() + kGlance;
    for (const Load& load : loads_)
        if (load.wanted && load.content.valid()) load.content.wait_until(end);
}

bool InputLoader::is_loading() const {
    return std::ranges::any_of(loads_, [](const Load& l) { return l.wanted; });
}

bool InputLoader::is_reading() const {
    return std::ranges::any_of(loads_, [](const Load& l) { return l.content.valid(); });
}

}  // namespace glint
