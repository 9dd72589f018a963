// A short list of lines that is kept between runs, the newest first.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace glint {

class KeptList {
public:
    // In this file, which is made with the first line; `most` lines.
    KeptList(std::filesystem::path file, std::size_t most) : file_(std::move(file)), most_(most) {}

    // As they were left; none where the file cannot be read or is larger than such a list gets.
    std::vector<std::string> lines() const;

    // Puts a line before the others, of which those go that `is_replaced` holds for. One that holds
    // a line end is not kept; where the file cannot be written nothing changes.
    void put_first(const std::string& line,
                   const std::function<bool(const std::string&)>& is_replaced) const;

private:
    std::filesystem::path file_;
    std::size_t most_;
};

}  // namespace glint
