// The files that were open last, kept between runs.
#pragma once

#include "window/live/kept_list.h"

namespace glint {

class Recent {
public:
    // One canonical name a line, a dozen at the most.
    explicit Recent(std::filesystem::path file) : list_(std::move(file), 12) {}

    // Those that are still there, the newest first.
    std::vector<std::filesystem::path> files() const;

    // Puts it first, as KeptList does.
    void add(const std::filesystem::path& opened) const;

private:
    KeptList list_;
};

}  // namespace glint
