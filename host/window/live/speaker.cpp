#include "window/live/speaker.h"

#include "base/module.h"
#include "window/live/speaker_module.h"

#include <array>
#include <stdexcept>

namespace glint {
namespace {

template <class Function>
Function* find(const char* name) {
    static void* const kModule = open_module("glint-speaker.so", "speaker");
    return find_function<Function>(kModule, name);
}

}  // namespace

Speaker::Speaker() {
    std::array<char, 256> cause{};
    device_ = find<GlintSpeakerOpen>("glint_speaker_open")(cause.data(), cause.size());
    if (!device_) throw std::runtime_error(cause.data());
}

Speaker::~Speaker() {
    find<GlintSpeakerClose>("glint_speaker_close")(device_);
}

double Speaker::latency() const {
    return find<GlintSpeakerLatency>("glint_speaker_latency")(device_);
}

bool Speaker::start() {
    return find<GlintSpeakerStart>("glint_speaker_start")(device_) != 0;
}

bool Speaker::stop() {
    return find<GlintSpeakerStop>("glint_speaker_stop")(device_) != 0;
}

bool Speaker::write(std::span<const float> pairs) {
    static auto* const kWrite = find<GlintSpeakerWrite>("glint_speaker_write");
    return kWrite(device_, pairs.data(), pairs.size() / 2) != 0;
}

}  // namespace glint
