#include "media/cube.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <future>
#include <stdexcept>

namespace glint {
namespace {

constexpr int kFaces = 6;

std::size_t bytes_per_pixel(int channels, ChannelType type) {
    return static_cast<std::size_t>(channels) * (type == ChannelType::f32 ? sizeof(float) : 1);
}

Cube empty_cube(int side, const Image& like) {
    Cube cube{.side = side, .channels = like.channels, .type = like.type, .pixels = {}};
    cube.pixels.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * kFaces *
                       bytes_per_pixel(like.channels, like.type));
    return cube;
}

std::byte* pixel_of(Cube& cube, int face, int x, int y) {
    const auto index =
        static_cast<std::size_t>((face * cube.side + y)) * static_cast<std::size_t>(cube.side) +
        static_cast<std::size_t>(x);
    return cube.pixels.data() + index * bytes_per_pixel(cube.channels, cube.type);
}

// Counted from the upper left, as pictures are looked at.
const std::byte* pixel_of(const Image& image, int x, int y) {
    const auto index =
        static_cast<std::size_t>(image.size.y - 1 - y) * static_cast<std::size_t>(image.size.x) +
        static_cast<std::size_t>(x);
    return image.pixels.data() + index * bytes_per_pixel(image.channels, image.type);
}

// Copies a square of a picture, from its upper left corner on, upright or turned by half.
void copy_face(Cube& cube, int face, const Image& from, glm::ivec2 corner, bool turned = false) {
    const std::size_t bytes = bytes_per_pixel(cube.channels, cube.type);
    const int last = cube.side - 1;
    for (int y = 0; y < cube.side; ++y) {
        for (int x = 0; x < cube.side; ++x) {
            const glm::ivec2 at =
                corner + (turned ? glm::ivec2(last - x, last - y) : glm::ivec2(x, y));
            std::memcpy(pixel_of(cube, face, x, y), pixel_of(from, at.x, at.y), bytes);
        }
    }
}

Cube cube_of_cross(const Image& cross) {
    const bool lies = cross.size.x > cross.size.y;
    const int side = cross.size.x / (lies ? 4 : 3);
    // Columns and rows of +X -X +Y -Y +Z -Z.
    constexpr std::array<glm::ivec2, kFaces> kLying = {
        {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
    constexpr std::array<glm::ivec2, kFaces> kStanding = {
        {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}};
    Cube cube = empty_cube(side, cross);
    for (int face = 0; face < kFaces; ++face) {
        const glm::ivec2 cell = (lies ? kLying : kStanding)[static_cast<std::size_t>(face)];
        copy_face(cube, face, cross, cell * side, !lies && face == 5);
    }
    return cube;
}

Cube cube_of_faces(const std::vector<Image>& pictures) {
    constexpr std::array kNames = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
    const Image& first = pictures.front();
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const Image& picture = pictures[i];
        if (picture.size.x != picture.size.y) {
            throw std::runtime_error(fmt::format("The face {} is {} x {}; the faces are square.",
                                                 kNames[i], picture.size.x, picture.size.y));
        }
        if (picture.size != first.size || picture.channels != first.channels ||
            picture.type != first.type) {
            throw std::runtime_error(fmt::format(
                "The face {} is {} x {} with {} channels, the face +X {} x {} with {}; all six "
                "are of one form.",
                kNames[i], picture.size.x, picture.size.y, picture.channels, first.size.x,
                first.size.y, first.channels));
        }
    }
    Cube cube = empty_cube(first.size.x, first);
    for (int face = 0; face < kFaces; ++face)
        copy_face(cube, face, pictures[static_cast<std::size_t>(face)], {0, 0});
    return cube;
}

// OpenGL 4.5, table 8.19; x and y from -1 to 1, y down the picture.
glm::vec3 direction(int face, float x, float y) {
    switch (face) {
        case 0:
            return {1.0f, -y, -x};
        case 1:
            return {-1.0f, -y, x};
        case 2:
            return {x, 1.0f, y};
        case 3:
            return {x, -1.0f, -y};
        case 4:
            return {x, -y, 1.0f};
        default:
            return {-x, -y, -1.0f};
    }
}

template <class T>
const T* values_of(const Image& image, int x, int y) {
    return reinterpret_cast<const T*>(pixel_of(image, x, y));
}

// Between the four pixels round a point; the panorama goes on round its sides and stops at its
// poles.
template <class T>
glm::vec4 between(const Image& image, float x, float y) {
    const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
    const float right_part = x - 0.5f - left, lower_part = y - 0.5f - top;
    const int width = image.size.x, last = image.size.y - 1;
    const int x0 = (static_cast<int>(left) + width) % width, x1 = (x0 + 1) % width;
    const int y0 = std::clamp(static_cast<int>(top), 0, last);
    const int y1 = std::clamp(static_cast<int>(top) + 1, 0, last);
    const T *upper_left = values_of<T>(image, x0, y0), *upper_right = values_of<T>(image, x1, y0);
    const T *lower_left = values_of<T>(image, x0, y1), *lower_right = values_of<T>(image, x1, y1);
    glm::vec4 value(0.0f);
    for (int c = 0; c < image.channels; ++c) {
        const float upper = glm::mix(static_cast<float>(upper_left[c]),
                                     static_cast<float>(upper_right[c]), right_part);
        const float lower = glm::mix(static_cast<float>(lower_left[c]),
                                     static_cast<float>(lower_right[c]), right_part);
        value[c] = glm::mix(upper, lower, lower_part);
    }
    return value;
}

template <class T>
glm::vec4 panorama_at(const Image& image, glm::vec3 d) {
    const float u = 0.5f + std::atan2(d.x, -d.z) / glm::two_pi<float>();
    const float v = std::acos(d.y / glm::length(d)) / glm::pi<float>();
    return between<T>(image, u * static_cast<float>(image.size.x),
                      v * static_cast<float>(image.size.y));
}

// The mean of four points a pixel: in the middle of a face a pixel covers 1.3 of the panorama's.
template <class T>
void sample_face(Cube& cube, int face, const Image& panorama) {
    const auto side = static_cast<float>(cube.side);
    for (int y = 0; y < cube.side; ++y) {
        for (int x = 0; x < cube.side; ++x) {
            glm::vec4 sum(0.0f);
            for (const float dy : {0.25f, 0.75f})
                for (const float dx : {0.25f, 0.75f})
                    sum += panorama_at<T>(
                        panorama, direction(face, (static_cast<float>(x) + dx) / side * 2.0f - 1.0f,
                                            (static_cast<float>(y) + dy) / side * 2.0f - 1.0f));
            std::byte* to = pixel_of(cube, face, x, y);
            for (int c = 0; c < cube.channels; ++c) {
                const float mean = sum[c] / 4.0f;
                const auto kept = static_cast<T>(std::is_same_v<T, float> ? mean : mean + 0.5f);
                std::memcpy(to + static_cast<std::size_t>(c) * sizeof(T), &kept, sizeof(T));
            }
        }
    }
}

Cube cube_of_panorama(const Image& panorama) {
    Cube cube = empty_cube(std::max(panorama.size.x / 4, 1), panorama);
    std::array<std::future<void>, kFaces> faces;
    for (int face = 0; face < kFaces; ++face) {
        faces[static_cast<std::size_t>(face)] = std::async(std::launch::async, [&, face] {
            if (panorama.type == ChannelType::f32)
                sample_face<float>(cube, face, panorama);
            else
                sample_face<std::uint8_t>(cube, face, panorama);
        });
    }
    for (auto& face : faces) face.get();
    return cube;
}

}  // namespace

Cube make_cube(const std::vector<Image>& pictures) {
    if (pictures.size() == kFaces) return cube_of_faces(pictures);
    const Image& picture = pictures.front();
    const glm::ivec2 size = picture.size;
    if (size.x == 2 * size.y) return cube_of_panorama(picture);
    const bool is_lying = size.x % 4 == 0 && size.x / 4 * 3 == size.y;
    const bool is_standing = size.y % 4 == 0 && size.y / 4 * 3 == size.x;
    if (is_lying || is_standing) return cube_of_cross(picture);
    throw std::runtime_error(fmt::format(
        "A picture of {} x {} is no cube; it is a panorama of 2:1, a cross of 4:3 or 3:4, or six "
        "square pictures.",
        size.x, size.y));
}

void turn_over(Cube& cube) {
    const std::size_t row =
        static_cast<std::size_t>(cube.side) * bytes_per_pixel(cube.channels, cube.type);
    constexpr std::array kOpposite = {0, 1, 3, 2, 4, 5};
    Cube turned = cube;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < cube.side; ++y) {
            std::memcpy(pixel_of(turned, kOpposite[static_cast<std::size_t>(face)], 0, y),
                        pixel_of(cube, face, 0, cube.side - 1 - y), row);
        }
    }
    cube = std::move(turned);
}

}  // namespace glint
