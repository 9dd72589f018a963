// What a file says of its picture before the pixels are read.
#include "../base/test_folder.h"
#include "media/image.h"

#include <gtest/gtest.h>

#include <fstream>

namespace glint::facts_test {
namespace {

TEST(ImageFacts, AgreeWithThePictureOfEveryKindOfFile) {
    const TestFolder folder;
    for (const std::string name : {"a.png", "a.jpg", "a.exr", "a.tif", "a.hdr"}) {
        SCOPED_TRACE(name);
        const bool floats = holds_floats(name);
        Image image{.size = {13, 7},
                    .channels = 3,
                    .type = floats ? ChannelType::f32 : ChannelType::u8,
                    .pixels = {}};
        image.pixels.resize(std::size_t{13} * 7 * 3 * (floats ? 4 : 1));
        write_image(folder.path() / name, image);
        const ImageFacts facts = read_image_facts(folder.path() / name);
        const Image read = read_image(folder.path() / name);
        EXPECT_EQ(facts.size, read.size);
        EXPECT_EQ(facts.channels, read.channels);
        EXPECT_EQ(facts.type, read.type);
        EXPECT_EQ(facts.pixel_bytes, read.pixels.size());
        EXPECT_GT(facts.decoder_bytes, 0u);
    }
}

TEST(ImageFacts, RefuseWhatIsNoPicture) {
    const TestFolder folder;
    folder.write("text.png", "no picture");
    EXPECT_THROW(read_image_facts(folder.path() / "text.png"), std::runtime_error);
    EXPECT_THROW(read_image_facts(folder.path() / "gone.png"), std::runtime_error);
    std::ofstream(folder.path() / "cut.exr") << "\x76\x2f\x31\x01";
    EXPECT_THROW(read_image_facts(folder.path() / "cut.exr"), std::runtime_error);
}

}  // namespace
}  // namespace glint::facts_test
