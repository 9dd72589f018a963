// A folder for files that are of no use once this process has ended.
#pragma once

#include <filesystem>

namespace glint {

// PARENT/PID; made by whoever writes into it, gone with this object. Those of processes that were
// killed go when the next one is made.
class ScratchFolder {
public:
    explicit ScratchFolder(const std::filesystem::path& parent);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace glint
