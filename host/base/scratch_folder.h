// A folder for files that are of no use once this process has ended.
#pragma once

#include <filesystem>

namespace glint {

// Below PARENT, by a name that nobody else has, gone with this object. Those of processes that were
// killed go when the next one is made. Where none can be made, whoever writes into it is told.
class ScratchFolder {
public:
    explicit ScratchFolder(const std::filesystem::path& parent);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    int lock_ = -1;  // held while this process runs
};

}  // namespace glint
