// Pictures that stand for a scene until its own are there.
#pragma once

#include "media/image.h"

#include <filesystem>

namespace glint {

// As read_image, but a JPEG, such as the gallery's, by a decoder that is at hand: the library that
// reads all other kinds takes a quarter of a second of a processor to load, when the window has
// least to spare. Its bytes may differ from that library's in the last digit.
Image read_preview(const std::filesystem::path& file);

}  // namespace glint
