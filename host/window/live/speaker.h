// The device that a sound is heard on.
#pragma once

#include <span>
#include <string>

namespace glint {

class Speaker {
public:
    // Loads PortAudio. Throws std::runtime_error, with the cause alone, where there is no device.
    Speaker();

    double latency() const;  // s from writing to hearing

    // To be called round a stretch of writing. False when the device is gone.
    bool start();
    bool stop();
    // Pairs of left and right at 44.1 kHz; waits until there is room for them.
    bool write(std::span<const float> pairs);

private:
    void* device_ = nullptr;
};

}  // namespace glint
