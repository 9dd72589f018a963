// What a preset's picture and time are held against: `[expect]`.
#pragma once

#include <filesystem>
#include <optional>

namespace glint {

struct Expect {
    std::filesystem::path picture{};  // that it shall show, at the size of that; "": none
    // How far it may be from that at the most: RMSE in light, and the mean of FLIP. With neither it
    // shall be that picture.
    std::optional<double> rmse{}, flip{};
    // How many times longer than another look its frames may take, and which: a preset or a scene.
    std::optional<double> ms_ratio{};
    std::filesystem::path ms_of{};
    bool operator==(const Expect&) const = default;
};

}  // namespace glint
