#include "window/live/kept_pictures.h"

#include "base/hash.h"
#include "base/temporary_file.h"
#include "offline/examples.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Another window may do the same at the same time; what is gone is gone.
void forget_oldest(const fs::path& folder, std::uintmax_t most_bytes) {
    struct Kept {
        fs::path file;
        fs::file_time_type time;
        std::uintmax_t bytes;
    };
    std::vector<Kept> pictures;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        std::error_code gone;
        const Kept kept{entry.path(), entry.last_write_time(gone), entry.file_size(gone)};
        if (!gone) pictures.push_back(kept);
    }
    std::ranges::sort(pictures, std::greater(), &Kept::time);
    std::uintmax_t bytes = 0;
    for (const Kept& kept : pictures) {
        bytes += kept.bytes;
        if (bytes > most_bytes) fs::remove(kept.file, error);
    }
}

void write(const fs::path& file, const Image& picture, std::uintmax_t most_bytes) {
    try {
        make_folder(file.parent_path());
        write_image(file, picture);
        forget_oldest(file.parent_path(), most_bytes);
    } catch (const std::exception&) {
        // A disk that is full or not ours; no memory. The next start does without.
    }
}

}  // namespace

fs::path KeptPictures::name_of(const fs::path& place) const {
    Hash digest;
    digest.add(place.string());
    return folder_ / (digest.text() + ".png");
}

fs::path KeptPictures::find(const fs::path& place) const {
    std::error_code error;
    const fs::path kept = name_of(place);
    return fs::is_regular_file(kept, error) ? kept : gallery_picture(place);
}

bool KeptPictures::is_writing() const {
    return writing_.valid() &&
           writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

void KeptPictures::keep(const fs::path& place, Image picture) {
    if (is_writing()) return;
    writing_ = std::async(std::launch::async, [file = name_of(place), picture = std::move(picture),
                                               most = most_bytes_] { write(file, picture, most); });
}

}  // namespace glint
