// The gallery's pictures, read without the library of pictures.
#include "window/live/preview.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace glint::preview_test {
namespace {

namespace fs = std::filesystem;

int largest_difference(const Image& a, const Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(std::to_integer<int>(a.pixels[i]) -
                                             std::to_integer<int>(b.pixels[i])));
    return largest;
}

TEST(Preview, OfTheGalleryIsThePictureAllButForTheLastDigits) {
    const fs::path picture = fs::path(GLINT_REPOSITORY) / "docs/pictures/christmas.jpg";
    const Image preview = read_preview(picture), read = read_image(picture);
    EXPECT_EQ(preview.size, read.size);
    EXPECT_EQ(preview.channels, read.channels);
    ASSERT_EQ(preview.pixels.size(), read.pixels.size());
    // Both decoders round colours that are stored at half the size in their own way.
    EXPECT_LE(largest_difference(preview, read), 12);
}

TEST(Preview, OfABrokenFileSaysWhyAsReadingItDoes) {
    const TestFolder folder;
    const fs::path file = folder.path() / "broken.jpg";
    std::ofstream(file) << "no picture";
    EXPECT_THROW(read_preview(file), std::runtime_error);
    EXPECT_THROW(read_preview(folder.path() / "none.jpg"), std::runtime_error);
}

}  // namespace
}  // namespace glint::preview_test
