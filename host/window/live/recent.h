// The files that were open last, kept between runs.
#pragma once

#include <filesystem>
#include <vector>

namespace glint {

class Recent {
public:
    // One canonical name a line, the newest first.
    explicit Recent(std::filesystem::path file) : file_(std::move(file)) {}

    // Those that are still there.
    std::vector<std::filesystem::path> files() const;

    // Where it cannot be written nothing is remembered.
    void add(const std::filesystem::path& opened) const;

private:
    std::filesystem::path file_;
};

}  // namespace glint
