#include "window/live/recent.h"

#include "base/canonical_name.h"
#include "base/readable_file.h"
#include "base/temporary_file.h"

#include <algorithm>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMost = 12;              // files
constexpr std::size_t kLongestList = 1 << 16;  // bytes

std::vector<fs::path> read_list(const fs::path& file) {
    std::vector<fs::path> list;
    try {
        std::istringstream lines(read_whole_file(file, kLongestList));
        for (std::string line; std::getline(lines, line) && list.size() < kMost;)
            if (!line.empty()) list.emplace_back(line);
    } catch (const Unreadable&) {
        return {};
    }
    return list;
}

}  // namespace

std::vector<fs::path> Recent::files() const {
    std::vector<fs::path> list = read_list(file_);
    std::erase_if(list, [](const fs::path& file) {
        std::error_code error;
        return !fs::is_regular_file(file, error);
    });
    return list;
}

void Recent::add(const fs::path& opened) const {
    const fs::path name = canonical_name(opened);
    if (name.string().find('\n') != std::string::npos) return;
    std::vector<fs::path> list = read_list(file_);
    std::erase(list, name);
    list.insert(list.begin(), name);
    list.resize(std::min(list.size(), kMost));
    std::string text;
    for (const fs::path& file : list) text += file.string() + "\n";
    try {
        make_folder(file_.parent_path());
        write_whole_file(file_, std::as_bytes(std::span(text)));
    } catch (const std::runtime_error&) {
        // A disk that is full or not ours.
    }
}

}  // namespace glint
