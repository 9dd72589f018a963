// Pictures of the scenes that were shown here, kept between runs: what stands in the window until a
// scene draws again.
#pragma once

#include "media/image.h"
#include "window/live/kept_files.h"

namespace glint {

class KeptPictures {
public:
    // One PNG a scene, by a digest of its place.
    explicit KeptPictures(std::filesystem::path folder, std::uintmax_t most_bytes = 32u << 20)
        : files_(std::move(folder), most_bytes) {}

    // The picture of the file at this place (base/canonical_name.h): the one kept here, else the
    // gallery's. Empty where there is neither.
    std::filesystem::path find(const std::filesystem::path& place) const;

    // As KeptFiles keeps it.
    void keep(const std::filesystem::path& place, Image picture);

private:
    KeptFiles files_;
};

}  // namespace glint
