// Pictures of the scenes that were shown here, kept between runs: what stands in the window until a
// scene draws again.
#pragma once

#include "media/image.h"

#include <cstdint>
#include <filesystem>
#include <future>

namespace glint {

class KeptPictures {
public:
    // One PNG a scene, by a digest of its place, all together within `most_bytes`; the oldest go.
    explicit KeptPictures(std::filesystem::path folder, std::uintmax_t most_bytes = 32u << 20)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    // Waits for what is being written.
    ~KeptPictures() = default;
    KeptPictures(const KeptPictures&) = delete;
    KeptPictures& operator=(const KeptPictures&) = delete;

    // The picture of the file at this place (base/canonical_name.h): the one kept here, else the
    // gallery's. Empty where there is neither.
    std::filesystem::path find(const std::filesystem::path& place) const;

    // Writes it whole or not at all, on a thread of its own. Where it cannot be written, or one is
    // being written, nothing is kept.
    void keep(const std::filesystem::path& place, Image picture);

    bool is_writing() const;

private:
    std::filesystem::path name_of(const std::filesystem::path& place) const;

    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
    std::future<void> writing_;
};

}  // namespace glint
