#include "window/live/kept_resolutions.h"

#include "base/readable_file.h"
#include "base/temporary_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMost = 100;             // scenes
constexpr std::size_t kLongestList = 1 << 18;  // bytes

// "held refined 0.25 /home/ada/sea.toml"
struct Line {
    std::string place;
    KeptResolution resolution;
};

std::vector<Line> read_lines(const fs::path& file) {
    std::vector<Line> list;
    try {
        std::istringstream text(read_whole_file(file, kLongestList));
        for (std::string line; std::getline(text, line) && list.size() < kMost;) {
            std::istringstream words(line);
            std::string choice, refining, place;
            double share = 0.0;
            if (words >> choice >> refining >> share && std::getline(words >> std::ws, place))
                list.push_back({place, {choice == "full", refining == "refined", share}});
        }
    } catch (const Unreadable&) {
        return {};
    }
    return list;
}

}  // namespace

std::optional<KeptResolution> KeptResolutions::find(const fs::path& place) const {
    for (const Line& line : read_lines(file_))
        if (line.place == place.string()) return line.resolution;
    return std::nullopt;
}

void KeptResolutions::keep(const fs::path& place, const KeptResolution& resolution) const {
    if (place.string().find('\n') != std::string::npos) return;
    std::vector<Line> list = read_lines(file_);
    std::erase_if(list, [&](const Line& line) { return line.place == place.string(); });
    list.insert(list.begin(), {place.string(), resolution});
    list.resize(std::min(list.size(), kMost));
    std::string text;
    for (const Line& line : list)
        text += fmt::format("{} {} {:g} {}\n", line.resolution.full ? "full" : "held",
                            line.resolution.refines ? "refined" : "plain", line.resolution.share,
                            line.place);
    try {
        make_folder(file_.parent_path());
        write_whole_file(file_, std::as_bytes(std::span(text)));
    } catch (const std::runtime_error&) {
        // A disk that is full or not ours.
    }
}

}  // namespace glint
