// A folder for pictures, and pictures to put there.
#pragma once

#include "../base/test_folder.h"
#include "media/image.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

namespace fs = std::filesystem;

inline constexpr const char* kWritable[] = {"a.png", "a.exr", "a.jpg", "a.tif", "a.hdr"};

// Hard to compress, so that its file is about as large as its pixels.
inline Image noise(glm::ivec2 size, ChannelType type) {
    Image image{.size = size, .channels = 3, .type = type, .pixels = {}};
    std::uint32_t state = 1;
    const auto values = static_cast<std::size_t>(size.x * size.y * 3);
    for (std::size_t i = 0; i < values; ++i) {
        state = state * 747796405U + 2891336453U;
        const float value = static_cast<float>(state >> 8) / 16777216.0F;
        if (type == ChannelType::u8) {
            image.pixels.push_back(static_cast<std::byte>(state >> 24));
        } else {
            const auto bytes = std::bit_cast<std::array<std::byte, 4>>(value);
            image.pixels.insert(image.pixels.end(), bytes.begin(), bytes.end());
        }
    }
    return image;
}

inline Image noise_for(const fs::path& file, glm::ivec2 size) {
    return noise(size, holds_floats(file) ? ChannelType::f32 : ChannelType::u8);
}

inline std::string content_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void put_content(const fs::path& file, std::string_view content) {
    std::ofstream(file, std::ios::binary) << content;
}

// What the exception says, or nothing.
template <class F>
std::string complaint(F&& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class ImageFile : public testing::Test {
protected:
    fs::path in(const std::string& name) const { return folder_ / name; }

    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder_)) {
            found.push_back(entry.path().filename().string());
        }
        return found;
    }

    TestFolder made_;
    fs::path folder_ = made_.path();
};

}  // namespace glint
