// What a person chose for each scene's resolution, and what held its frame rate, kept between runs.
#pragma once

#include <filesystem>
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
    explicit KeptResolutions(std::filesystem::path file) : file_(std::move(file)) {}

    // Of the file at this place (base/canonical_name.h).
    std::optional<KeptResolution> find(const std::filesystem::path& place) const;

    // Where it cannot be written nothing is remembered.
    void keep(const std::filesystem::path& place, const KeptResolution& resolution) const;

private:
    std::filesystem::path file_;
};

}  // namespace glint
