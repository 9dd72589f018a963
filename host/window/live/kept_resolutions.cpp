#include "window/live/kept_resolutions.h"

#include <fmt/format.h>

#include <sstream>

namespace glint {
namespace {

namespace fs = std::filesystem;

struct Line {
    std::string place;
    KeptResolution resolution;
};

// "held refined 0.25 /home/ada/sea.toml"
std::optional<Line> parse(const std::string& line) {
    std::istringstream words(line);
    std::string choice, refining, place;
    double share = 0.0;
    if (!(words >> choice >> refining >> share && std::getline(words >> std::ws, place)))
        return std::nullopt;
    return Line{place, {choice == "full", refining == "refined", share}};
}

}  // namespace

std::optional<KeptResolution> KeptResolutions::find(const fs::path& place) const {
    for (const std::string& text : list_.lines()) {
        const std::optional<Line> line = parse(text);
        if (line && line->place == place.string()) return line->resolution;
    }
    return std::nullopt;
}

void KeptResolutions::keep(const fs::path& place, const KeptResolution& resolution) const {
    const std::string text =
        fmt::format("{} {} {:g} {}", resolution.full ? "full" : "held",
                    resolution.refines ? "refined" : "plain", resolution.share, place.string());
    list_.put_first(text, [&](const std::string& other) {
        const std::optional<Line> line = parse(other);
        return !line || line->place == place.string();
    });
}

}  // namespace glint
