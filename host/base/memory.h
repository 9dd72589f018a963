// How much memory may still be taken, by this machine and by what this process is allowed of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>

namespace glint {

// No limit where the system tells of none.
std::size_t available_memory();

// What control groups leave, those of a container or of a batch job: `groups` as in
// /proc/self/cgroup, their files below `root` as in /sys/fs/cgroup, of either version.
std::size_t memory_left_by_groups(const std::filesystem::path& root, std::istream& groups);

}  // namespace glint
