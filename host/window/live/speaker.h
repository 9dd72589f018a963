// The device that a sound is heard on.
#pragma once

#include <span>

namespace glint {

class Speaker {
public:
    // Loads PortAudio. Throws std::runtime_error, with the cause alone, where there is no device.
    Speaker();
    ~Speaker();
    Speaker(const Speaker&) = delete;
    Speaker& operator=(const Speaker&) = delete;

    double latency() const;  // s from writing to hearing

    // To be called round a stretch of writing. False when the device is gone: then nothing is heard
    // any more, and a new speaker has to be made.
    bool start();
    bool stop();
    // Pairs of left and right, -1 to 1, at 44.1 kHz; waits until there is room for them. False as
    // above.
    bool write(std::span<const float> pairs);

private:
    void* device_ = nullptr;
};

}  // namespace glint
