// Reads input files beside the thread that draws, so that no file is too large and no disk too slow
// for a window.
#pragma once

#include "offline/common.h"
#include "offline/input_files.h"

#include <future>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// To be used on one thread.
class InputLoader {
public:
    // Throws std::system_error when the process has no descriptor left.
    explicit InputLoader(const TextureLimits& limits);
    // Does not wait: what is still read is left to itself.
    ~InputLoader();
    InputLoader(const InputLoader&) = delete;
    InputLoader& operator=(const InputLoader&) = delete;

    // Starts reading what a sampler names, unless that is under way.
    void load(const Sampler& sampler);
    // The same after a file of it has changed: what is under way is read once more afterwards.
    void load_again(const Sampler& sampler);
    // Nothing is wanted any more but what the samplers of this preset name.
    void keep_only(const Preset& preset);

    struct Loaded {
        Sampler sampler;
        std::optional<InputContent> input;
        std::string error;  // a whole sentence where there is no input
        double ms = 0.0;    // since it was asked for
    };
    // What has been read since the last call; does not wait.
    std::vector<Loaded> take();

    // Waits until all that is wanted is read, but no longer than somebody sees.
    void glance() const;

    // Whether anything that is wanted is not read yet.
    bool is_loading() const;
    // Whether anything is read, wanted or not.
    bool is_reading() const;
    // For ::poll(): readable when take() has something.
    int descriptor() const { return wake_; }

private:
    struct Load {
        Sampler sampler;
        std::future<InputContent> content;  // not valid: it waits for its turn
        Stopwatch since;
        bool wanted = true, again = false;
    };
    static Loaded result_of(Load& load);
    Load* find(const Sampler& sampler);
    void start_waiting();

    TextureLimits limits_;
    int wake_ = -1;
    std::vector<Load> loads_;
};

// Whether both read the same in the same place of a scene.
bool same_input(const Sampler& a, const Sampler& b);

}  // namespace glint
