#include "window/live/recent.h"

#include "base/canonical_name.h"

#include <system_error>

namespace glint {

namespace fs = std::filesystem;

std::vector<fs::path> Recent::files() const {
    std::vector<fs::path> files;
    std::error_code error;
    for (const std::string& line : list_.lines())
        if (fs::is_regular_file(line, error)) files.emplace_back(line);
    return files;
}

void Recent::add(const fs::path& opened) const {
    const std::string name = canonical_name(opened).string();
    list_.put_first(name, [&](const std::string& line) { return line == name; });
}

}  // namespace glint
