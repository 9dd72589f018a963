// Programs that another process has compiled, taken up here pass by pass: each comes from what the
// driver keeps on the disk, in some milliseconds, and the window draws its frames between them.
#pragma once

#include "offline/common.h"
#include "render/renderer.h"
#include "window/trial/trial.h"

#include <optional>
#include <string>
#include <vector>

namespace glint {

// The pass of this name; nothing where there is none.
std::optional<std::size_t> pass_named(const Scene& scene, std::string_view name);

class ProgramLoader {
public:
    // Of the passes that were tried those that the preset has; in the place of what was to be
    // loaded.
    void start(const Preset& preset, const ProgramOptions& options,
               const std::vector<PassTrial>& passes);
    void stop() { passes_.clear(), linked_.reset(); }
    bool is_loading() const { return !passes_.empty() || linked_.has_value(); }

    // Links one that is not on the shelf, or, where the renderer draws the same text, draws what
    // was linked for the first time, for nobody. What does not compile is left out.
    void step(ProgramShelf& shelf, Renderer* same_text);

private:
    std::optional<Preset> preset_;
    ProgramOptions options_;
    std::vector<std::string> passes_;  // by name; the next one is the last
    std::optional<PassProgram> linked_;
};

}  // namespace glint
