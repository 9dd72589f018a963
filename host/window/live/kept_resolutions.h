// What a person chose for each scene's resolution, and what held its frame rate, kept between runs.
#pragma once

#include "window/live/kept_list.h"

#include <optional>

namespace glint {

struct KeptResolution {
    bool full = false;    // a person wants the full size, however slow
    bool refines = true;  // what stands still
    double share = 0.0;   // of the sides, that held the rate last; 0: not known
    bool operator==(const KeptResolution&) const = default;
};

class KeptResolutions {
public:
    // A scene a line, the newest first, a hundred at the most.
    explicit KeptResolutions(std::filesystem::path file) : list_(std::move(file), 100) {}

    // Of the file at this place (base/canonical_name.h).
    std::optional<KeptResolution> find(const std::filesystem::path& place) const;

    // In the place of what was chosen for it before, as KeptList does.
    void keep(const std::filesystem::path& place, const KeptResolution& resolution) const;

private:
    KeptList list_;
};

}  // namespace glint
