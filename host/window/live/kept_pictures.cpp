#include "window/live/kept_pictures.h"

#include "base/hash.h"
#include "offline/examples.h"

#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;

std::string name_of(const fs::path& place) {
    Hash digest;
    digest.add(place.string());
    return digest.text() + ".png";
}

}  // namespace

fs::path KeptPictures::find(const fs::path& place) const {
    std::error_code error;
    const fs::path kept = files_.folder() / name_of(place);
    return fs::is_regular_file(kept, error) ? kept : gallery_picture(place);
}

void KeptPictures::keep(const fs::path& place, Image picture) {
    files_.keep(name_of(place), [picture = std::move(picture)](const fs::path& file) {
        write_image(file, picture);
    });
}

}  // namespace glint
