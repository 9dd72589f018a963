#include "base/nearest_file.h"

#include "base/diagnostic.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNames = 1000;  // in a larger folder a guess takes too long

std::vector<fs::path> names_in(const fs::path& folder) {
    std::vector<fs::path> names;
    std::error_code error;
    fs::directory_iterator at(folder.empty() ? "." : folder, error), end;
    for (; !error && at != end && names.size() <= kMostNames; at.increment(error))
        if (std::error_code gone; !at->path().filename().string().starts_with('.') &&
                                  fs::exists(at->path(), gone))  // no link into nowhere
            names.push_back(at->path().filename());
    if (names.size() > kMostNames) return {};
    std::ranges::sort(names);  // not in the order of the disk
    return names;
}

// By letters, among those with the same ending; without one, of presets and scenes too.
fs::path nearest_name(const fs::path& name, const std::vector<fs::path>& names) {
    std::vector<std::string> stems;
    for (const fs::path& known : names)
        if (known.extension() == name.extension()) stems.push_back(known.stem().string());
    const std::string stem = nearest(name.stem().string(), stems);
    if (!stem.empty()) return stem + name.extension().string();
    for (const char* ending : {".toml", ".frag"}) {
        if (name.has_extension()) break;
        const fs::path found = nearest_name(name.string() + ending, names);
        if (!found.empty()) return found;
    }
    return {};
}

// A preset before a scene, a scene before all else.
fs::path same_stem(const fs::path& name, const std::vector<fs::path>& names) {
    std::vector<std::string> endings;
    for (const fs::path& known : names)
        if (known.stem() == name.stem()) endings.push_back(known.extension().string());
    if (name.has_extension()) {
        const std::string ending = nearest(name.extension().string(), endings);
        return ending.empty() ? fs::path() : fs::path(name.stem().string() + ending);
    }
    for (const char* preferred : {".toml", ".frag"})
        if (std::ranges::find(endings, preferred) != endings.end())
            return name.string() + preferred;
    return endings.empty() ? fs::path() : fs::path(name.string() + endings.front());
}

fs::path in(const fs::path& folder, const fs::path& name) {
    return name.empty() ? name : folder / name;
}

// The very name, or for one without an ending that of a preset or a scene, one folder below.
fs::path found_below(const fs::path& folder, const fs::path& name) {
    for (const char* ending : {"", ".toml", ".frag"}) {
        if (*ending && name.has_extension()) break;
        for (const fs::path& below : names_in(folder)) {
            const fs::path file = folder / below / (name.string() + ending);
            std::error_code error;
            if (fs::is_regular_file(file, error)) return file;
        }
    }
    return {};
}

}  // namespace

fs::path nearest_file(const fs::path& missing) {
    const fs::path folder = missing.parent_path(), name = missing.filename();
    if (name.empty()) return {};
    std::error_code error;
    if (!folder.empty() && !fs::is_directory(folder, error)) {
        if (fs::exists(folder, error)) return {};
        const fs::path other = nearest_file(folder);
        if (other.empty() || !fs::is_directory(other, error)) return {};
        return fs::exists(other / name, error) ? other / name : nearest_file(other / name);
    }
    const std::vector<fs::path> names = names_in(folder);
    fs::path found = in(folder, same_stem(name, names));
    if (found.empty()) found = found_below(folder, name);
    if (found.empty()) found = in(folder, nearest_name(name, names));
    if (found.empty() && folder.has_relative_path())
        found = found_below(folder.parent_path(), name);
    return found;
}

}  // namespace glint
