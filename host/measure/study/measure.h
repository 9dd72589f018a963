// One picture of a study, and the time that its frames take.
#pragma once

#include "gl/context.h"
#include "measure/probe/loop_turns.h"
#include "measure/rows/difference.h"
#include "measure/study/plan.h"
#include "measure/study/rounds.h"
#include "render/renderer.h"
#include "scene/passes.h"

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace glint {

// How far simulations have been played in a study of one look, so that settings that do not act on
// them go on from there.
class Played {
public:
    // `acts`: by tweak, whether what later frames depend on reads it.
    explicit Played(std::vector<bool> acts) : acts_(std::move(acts)) {}

    // What has come the farthest, at most so many frames; null for nothing. What is the same for
    // two settings by `key` and by the tweaks that act is played alike.
    struct Reached {
        std::string key;
        int frames = 0;
        std::vector<PassState> state;
    };
    const Reached* find(const std::string& key, int most_frames) const;
    // Forgets the oldest where they would take too much memory.
    void keep(Reached reached);

    const std::vector<bool>& acts() const { return acts_; }

private:
    std::vector<bool> acts_;
    std::deque<Reached> reached_;  // the oldest first
};

// What the numbers of a pass's output are.
inline Values values_of_pass(std::size_t pass) {
    return pass == kImagePass ? Values::display : Values::data;
}

struct MeasureOptions {
    std::size_t pass = kImagePass;         // what is compared
    std::size_t output = 0;                // which of its outputs
    bool specialise = true;                // tweaks written in as constants
    std::vector<std::size_t> constants{};  // without `specialise`: these alone
    Played* played = nullptr;              // of this look; outlives the scene
};

// A scene with a setting, as a still would draw it. `context` is current, and outlives it.
class MeasuredScene {
public:
    // Throws what a still throws.
    MeasuredScene(const Preset& preset, const Setting& setting, Context& context,
                  const MeasureOptions& options);

    // Plays it to the preset's time and draws: RGBA of what is compared, rows bottom up.
    std::vector<float> draw_picture();

    // The pass whose loops the driver ended early in that picture, "" for none. Looked for where
    // neither the text says that they are shorter nor, unless it simulates, a sixteenth of the
    // pixels that they are much shorter. Draws again.
    std::string cut_pass();

    // Another setting, where tweaks are no constants; everything begins anew.
    void set(const Setting& setting);

    // Before it is timed beside others: none is slow for where its program happens to stand. Once
    // is enough; it does nothing then.
    void find_quick_place();

    // One frame more, 1/60 s later; of a scene that settles, with time held, and as long as all its
    // frames together take.
    FrameTime time_frame();

    // Milliseconds of a frame that draws every pass; on the wall. Simulations begin anew.
    double time_all_passes();

private:
    static Preset with(const Preset& preset, const Setting& setting);
    std::unique_ptr<Renderer> compile() const;
    Frame next_frame();
    Frame play_on();
    std::string key_of_state() const;
    MeasuredScene& coarse();
    ProgramOptions program_options() const;
    std::uint32_t most_turns();

    Preset preset_;
    Context& context_;
    MeasureOptions options_;
    std::unique_ptr<Renderer> renderer_;
    Frame last_;  // of the picture
    // What cut_pass() counts with.
    std::unique_ptr<MeasuredScene> coarse_;
    std::unique_ptr<LoopTurns> turns_;
    int drawn_ = 0;
    bool stands_well_ = false;
};

// Of this pass, or of the picture. Throws UsageError for a cube, which has no plane to compare.
glm::ivec2 compared_size(const Preset& preset, std::size_t pass);

// "Xeon …, 2 threads": the processor, and how many of its threads there are.
std::string machine_name();

}  // namespace glint
