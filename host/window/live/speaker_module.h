// The C face of glint-speaker.so, the only binary that is linked with PortAudio. No exception and
// no C++ type crosses it.
#pragma once

#include <stddef.h>

extern "C" {

// The system's usual device, at 44.1 kHz in stereo. Null, with a cause (no sentence), where there
// is none. One is open at a time.
typedef void* GlintSpeakerOpen(char* cause, size_t cause_size);
// Of one that is gone, too. The next one is sought among the devices that there are then.
typedef void GlintSpeakerClose(void* speaker);
// Seconds from writing to hearing.
typedef double GlintSpeakerLatency(void* speaker);
// 1, or 0 when the device is gone.
typedef int GlintSpeakerStart(void* speaker);
typedef int GlintSpeakerStop(void* speaker);
// Waits until there is room for them.
typedef int GlintSpeakerWrite(void* speaker, const float* pairs, size_t count);

GlintSpeakerOpen glint_speaker_open;
GlintSpeakerClose glint_speaker_close;
GlintSpeakerLatency glint_speaker_latency;
GlintSpeakerStart glint_speaker_start;
GlintSpeakerStop glint_speaker_stop;
GlintSpeakerWrite glint_speaker_write;
}
