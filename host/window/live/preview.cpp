#include "window/live/preview.h"

#include <stb/stb_image.h>

#include <cstring>
#include <memory>

namespace glint {

Image read_preview(const std::filesystem::path& file) {
    if (file.extension() != ".jpg") return read_image(file);
    constexpr int kChannels = 3;
    stbi_set_flip_vertically_on_load_thread(1);  // rows run bottom up
    Image image{.size = {}, .channels = kChannels, .pixels = {}};
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load(file.c_str(), &image.size.x, &image.size.y, nullptr, kChannels), stbi_image_free);
    if (!pixels) return read_image(file);  // which says why, or knows better
    image.pixels.resize(static_cast<std::size_t>(image.size.x) *
                        static_cast<std::size_t>(image.size.y) * kChannels);
    std::memcpy(image.pixels.data(), pixels.get(), image.pixels.size());
    return image;
}

}  // namespace glint
