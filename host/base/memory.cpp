#include "base/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// The number that stands after `name`, or first in the file; nothing where it is "max" or none.
std::optional<std::size_t> number_in(const fs::path& file, const std::string& name = "") {
    std::ifstream in(file);
    std::string word;
    while (!name.empty() && in >> word && word != name) {
    }
    std::size_t number = 0;
    if (in >> number) return number;
    return std::nullopt;
}

// The files of a group, by the version of control groups.
struct GroupFiles {
    const char *limit, *used, *reclaimable;
};
constexpr GroupFiles kVersion1 = {"memory.limit_in_bytes", "memory.usage_in_bytes",
                                  "total_inactive_file"};
constexpr GroupFiles kVersion2 = {"memory.max", "memory.current", "inactive_file"};

// What is read from files counts as used until somebody needs the room.
std::size_t left_by(const fs::path& group, const GroupFiles& files) {
    const auto limit = number_in(group / files.limit);
    const std::size_t used = number_in(group / files.used).value_or(0);
    const std::size_t reclaimable = number_in(group / "memory.stat", files.reclaimable).value_or(0);
    if (!limit) return kNoLimit;
    return *limit - std::min(*limit, used - std::min(used, reclaimable));
}

}  // namespace

// A container sees its own group as the root, under whatever name it has outside: groups that are
// not there are passed over, and every one above counts.
std::size_t memory_left_by_groups(const fs::path& root, std::istream& groups) {
    std::size_t left = kNoLimit;
    for (std::string line; std::getline(groups, line);) {  // such as 4:cpu,memory:/a/b, or 0::/a/b
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const bool is_version1 = controllers.find(",memory,") != std::string::npos;
        if (!is_version1 && controllers != ",,") continue;
        fs::path group = line.substr(second + 1);
        for (bool is_root = false; !is_root; group = group.parent_path()) {
            is_root = group.relative_path().empty();
            left =
                std::min(left, left_by(root / (is_version1 ? "memory" : "") / group.relative_path(),
                                       is_version1 ? kVersion1 : kVersion2));
        }
    }
    return left;
}

std::size_t available_memory() {
    const auto kib = number_in("/proc/meminfo", "MemAvailable:");
    std::ifstream groups("/proc/self/cgroup");
    return std::min(kib ? *kib * 1024 : kNoLimit, memory_left_by_groups("/sys/fs/cgroup", groups));
}

}  // namespace glint
