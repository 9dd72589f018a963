// Names with a number in them, such as "out.%04d.png".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glint {

struct NumberedName {
    std::string before, after;
    int digits = 0;  // at least so many, filled up with zeros

    std::filesystem::path name(int number) const;

    // The numbers of the files that are there, in order.
    std::vector<int> numbers_there() const;
};

// Nothing unless the file's name has exactly one "%d", "%4d" or "%04d" and no other "%"; those of
// its folder are what they are.
std::optional<NumberedName> numbered_name(const std::string& text);

// In the folder at hand: FILE-0001.png with the file's stem, or the first such name that is free.
std::filesystem::path free_picture_name(const std::filesystem::path& file);

}  // namespace glint
