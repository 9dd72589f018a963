// A folder of one's own under the system's temporary one.
#pragma once

#include <filesystem>

namespace glint {

// Made with a name that nobody else has, for this user alone, and gone with this object; one of a
// process that was killed stays until the system clears up. Throws std::runtime_error where none
// can be made.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace glint
