// The sound of the scene in the window: played by another process, led from here.
#pragma once

#include "media/feed.h"
#include "offline/common.h"
#include "scene/preset.h"
#include "window/trial/socket_process.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glint {

// Seconds of the steady clock, which all processes share.
double clock_seconds();

// The sound files that a scene listens to, each once.
std::vector<std::filesystem::path> sounds_of(const Preset& preset);

// Starts no process before there is something to be heard.
class LiveSound {
public:
    explicit LiveSound(std::string device) : device_(std::move(device)) {}

    // What is on the screen, the values of its tweaks, and where its time stands; null for nothing.
    // Tweaks are followed once they rest.
    void follow(const Preset* preset, std::vector<TweakValue> values, const PlayState& state);

    // Hears the process; does not wait. True when something is new.
    bool update();
    // For ::poll(): readable when update() has something to hear; -1 when there is no process.
    int descriptor() const { return process_.descriptor(); }

    // Whether the scene has a sound, and why it is not heard: "" while all is well.
    bool has_sound() const { return content_.has_value(); }
    const std::string& why_silent() const { return why_silent_; }

private:
    // What a sound is made from.
    struct Content {
        std::string text;
        std::vector<TweakValue> values;
        std::string samplers;  // what fills them
        std::vector<std::pair<std::filesystem::path, std::filesystem::file_time_type>> files;
        bool operator==(const Content&) const = default;
    };
    static Content content_of(const Preset& preset, std::vector<TweakValue> values);

    bool start();
    void end();

    std::string device_;
    SocketProcess process_;
    std::optional<Content> content_, sent_;  // what there is; what the process has
    Stopwatch since_change_;
    bool answered_ = true;        // the process has made something of what it was sent last
    bool is_begun_anew_ = false;  // for this text
    PlayState told_;
    std::string why_silent_;
};

}  // namespace glint
