#include "base/scratch_folder.h"

#include <unistd.h>

#include <string>
#include <system_error>
#include <vector>

namespace glint {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const fs::path& parent) : path_(parent / std::to_string(::getpid())) {
    std::error_code error;
    std::vector<fs::path> left_behind;
    for (const fs::directory_entry& entry : fs::directory_iterator(parent, error)) {
        const std::string name = entry.path().filename().string();
        const bool is_ours = name.find_first_not_of("0123456789") == std::string::npos;
        if (is_ours && !fs::exists(fs::path("/proc") / name, error)) left_behind.push_back(entry);
    }
    for (const fs::path& folder : left_behind) fs::remove_all(folder, error);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace glint
