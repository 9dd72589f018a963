// What the window and the processes that try candidates and play sound say to each other: plain
// data as bytes, between two copies of one program.
#pragma once

#include "media/feed.h"
#include "window/trial/prober.h"
#include "window/trial/refiner.h"
#include "window/trial/trial.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace glint {

// A candidate as it arrives.
struct TrialOrder {
    std::uint64_t number = 0;  // counts the candidates
    Preset preset;
    CompileOptions compile;
    glm::ivec2 size{0};
    PixelFormat picture_format = PixelFormat::rgba8;
    double time = 0.0;
    double slow_ms = 0.0;
    std::vector<TrialImage> images;
    bool is_text = true;
};

// What the window tells the process that plays a scene's sound.
struct SoundOrder {
    std::vector<Preset> scene;  // one, when it is another than before; none otherwise
    PlayState state;
};

// What the process that refines sends after each sample; the pixels follow, if there are any.
struct RefineAnswer {
    int done = 0;               // samples
    int width = 0, height = 0;  // of the picture, RGBA in bytes; 0: none follows
    std::int64_t pixel_bytes() const { return std::int64_t{4} * width * height; }
};

enum class TrialStage { ready, compiling, drawing, done };

struct TrialAnswer {
    std::uint64_t number = 0;  // of the order
    TrialStage stage = TrialStage::ready;
    std::string text;  // ready: the renderer; compiling and drawing: the name of the pass
    std::string size;  // drawing: "32x18"
    Verdict verdict;   // as far as it is known
};

// Length and bytes, ready to be sent.
std::string pack(std::uint64_t number, const Candidate& candidate, double slow_ms);
std::string pack(const TrialAnswer& answer);
std::string pack(const SoundOrder& order);
std::string pack(const RefineOrder& order);
std::string pack(const ProbeOrder& order);
std::string pack(const ProbeAnswer& answer);

// Takes the first whole message off what has arrived; nothing when it is not whole yet.
std::optional<std::string> take_message(std::string& arrived);

// Throws std::runtime_error for bytes that are no such message.
TrialOrder unpack_order(std::string_view message);
TrialAnswer unpack_answer(std::string_view message);
SoundOrder unpack_sound_order(std::string_view message);
RefineOrder unpack_refine_order(std::string_view message);
ProbeOrder unpack_probe_order(std::string_view message);
ProbeAnswer unpack_probe_answer(std::string_view message);

}  // namespace glint
