// What the maps of a scene held when its first frame was drawn, kept between runs: the next start
// need not draw them. A map follows from the text and the tweaks alone (render/renderer.h).
#pragma once

#include "render/renderer.h"
#include "window/live/kept_files.h"

#include <string>

namespace glint {

class KeptMaps {
public:
    // One file a set of maps, by a digest of all that they follow from. An empty folder keeps none.
    explicit KeptMaps(std::filesystem::path folder, std::uintmax_t most_bytes = 192u << 20)
        : files_(std::move(folder), most_bytes) {}

    // Gives a renderer that has drawn nothing what was kept of the same programs, where there is
    // any; asks for it to be kept where there is not. Its programs are constants from this shelf;
    // `driver` names it and its version.
    void give(const Preset& preset, Renderer& renderer, const ProgramShelf& shelf,
              const std::string& driver);

    // What is given is of no use any more, or was no help.
    void forget() { name_.clear(); }

    // Keeps its maps, once, where that was asked for; beside the thread that draws.
    bool wants() const { return !name_.empty(); }
    void keep(const Renderer& renderer);

private:
    KeptFiles files_;
    std::string name_;  // in the folder; empty: nothing is to be kept
};

}  // namespace glint
