#include "offline/examples.h"

#include <algorithm>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;

void append_sorted(std::vector<fs::path>& list, const fs::path& folder, const char* ending) {
    std::error_code error;
    const auto first = static_cast<std::ptrdiff_t>(list.size());
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ending) list.push_back(entry.path());
    std::sort(list.begin() + first, list.end());
}

// Of the build folder's program the repository; of one that is installed share/glint of its prefix;
// of one that was copied with its folders, theirs.
fs::path home_of_examples() {
    std::error_code error;
    fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (; folder.has_relative_path(); folder = folder.parent_path())
        for (const fs::path& home : {folder, folder / "share/glint"})
            if (fs::is_directory(home / "presets", error) &&
                fs::is_directory(home / "fragments", error))
                return home;
    return {};
}

}  // namespace

std::vector<fs::path> scenes_in(const fs::path& folder) {
    std::vector<fs::path> list;
    append_sorted(list, folder, ".toml");
    append_sorted(list, folder, ".frag");
    return list;
}

fs::path documentation(const std::string& page) {
    const fs::path home = home_of_examples();
    std::error_code error;
    for (const fs::path& folder : {home / "docs", home / "../doc/glint/docs"}) {
        if (home.empty() || !fs::exists(folder / page, error)) continue;
        const fs::path whole = fs::canonical(folder / page, error);
        const fs::path from_here = whole.lexically_proximate(fs::current_path(error));
        return from_here.begin()->string() == ".." ? whole : from_here;
    }
    return fs::path("docs") / page;
}

fs::path gallery_picture(const fs::path& preset) {
    const fs::path home = home_of_examples();
    std::error_code error;
    if (home.empty() ||
        !fs::equivalent(fs::absolute(preset, error).parent_path(), home / "presets", error))
        return {};
    const fs::path picture = home / "docs" / "pictures" / (preset.stem().string() + ".jpg");
    return fs::exists(picture, error) ? picture : fs::path();
}

std::vector<fs::path> examples() {
    const fs::path home = home_of_examples();
    std::vector<fs::path> list;
    if (!home.empty()) append_sorted(list, home / "presets", ".toml");
    // The preset that bears its scene's name.
    std::error_code error;
    std::erase_if(list, [&](const fs::path& preset) {
        return !fs::exists(home / "fragments" / (preset.stem().string() + ".frag"), error);
    });
    return list;
}

}  // namespace glint
