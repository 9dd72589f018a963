// The six faces of a cube from pictures: one a face, a cross of them, or a panorama.
#pragma once

#include "media/image.h"

namespace glint {

// The faces +X -X +Y -Y +Z -Z, one after the other, each with its rows in GL's order for cubes: the
// first row is the upper one of the picture.
struct Cube {
    int side = 0;      // pixels
    int channels = 0;  // 1 to 4
    ChannelType type = ChannelType::u8;
    std::vector<std::byte> pixels;
};

// One picture is a cross (4:3 with -X +Z +X -Z in the row, or 3:4 with +Y +Z -Y -Z in the column,
// -Z on its head) or a panorama (2:1, latitude and longitude, -Z in the middle, +X right of it, +Y
// up), which is sampled into faces of a quarter of its width. Six are the faces themselves. Throws
// std::runtime_error with a whole sentence where the pictures make no cube.
Cube make_cube(const std::vector<Image>& pictures);

// The world on its head: up and down change places.
void turn_over(Cube& cube);

}  // namespace glint
