// glint-speaker.so: what is heard. Loaded by the process that plays a scene's sound.
#include "window/live/speaker_module.h"

#include <portaudio.h>

#include <algorithm>
#include <cstdio>

namespace {

constexpr double kLatency = 0.05;  // s; below it a busy machine stutters

// PortAudio looks for devices once, when it is begun: it ends, so that the next call finds others.
void* give_up(const char* why, char* cause, size_t size) {
    std::snprintf(cause, size, "%s", why);
    Pa_Terminate();
    return nullptr;
}

}  // namespace

void* glint_speaker_open(char* cause, size_t size) {
    if (const PaError error = Pa_Initialize(); error != paNoError) {
        std::snprintf(cause, size, "%s", Pa_GetErrorText(error));
        return nullptr;
    }
    const PaDeviceIndex device = Pa_GetDefaultOutputDevice();
    if (device == paNoDevice) return give_up("there is no sound device", cause, size);
    const PaDeviceInfo& info = *Pa_GetDeviceInfo(device);
    PaStreamParameters output{};
    output.device = device;
    output.channelCount = 2;
    output.sampleFormat = paFloat32;
    output.suggestedLatency = std::max(kLatency, info.defaultLowOutputLatency);
    PaStream* stream = nullptr;
    const PaError error = Pa_OpenStream(&stream, nullptr, &output, 44100,
                                        paFramesPerBufferUnspecified, paNoFlag, nullptr, nullptr);
    return error == paNoError ? stream : give_up(Pa_GetErrorText(error), cause, size);
}

void glint_speaker_close(void* speaker) {
    Pa_CloseStream(speaker);
    Pa_Terminate();
}

double glint_speaker_latency(void* speaker) {
    return Pa_GetStreamInfo(speaker)->outputLatency;
}

int glint_speaker_start(void* speaker) {
    return Pa_StartStream(speaker) == paNoError;
}

int glint_speaker_stop(void* speaker) {
    return Pa_StopStream(speaker) == paNoError;
}

int glint_speaker_write(void* speaker, const float* pairs, size_t count) {
    const PaError error = Pa_WriteStream(speaker, pairs, count);
    return error == paNoError || error == paOutputUnderflowed;
}
