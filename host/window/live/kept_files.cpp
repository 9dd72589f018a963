#include "window/live/kept_files.h"

#include <algorithm>
#include <functional>
#include <system_error>
#include <vector>

namespace glint {

namespace fs = std::filesystem;

// Another window may do the same at the same time.
void forget_oldest(const fs::path& folder, std::uintmax_t most_bytes) {
    struct Kept {
        fs::path file;
        fs::file_time_type time;
        std::uintmax_t bytes;
    };
    std::vector<Kept> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        std::error_code gone;
        const Kept kept{entry.path(), entry.last_write_time(gone), entry.file_size(gone)};
        if (!gone) files.push_back(kept);
    }
    std::ranges::sort(files, std::greater(), &Kept::time);
    std::uintmax_t bytes = 0;
    for (const Kept& kept : files) {
        bytes += kept.bytes;
        if (bytes > most_bytes) fs::remove(kept.file, error);
    }
}

}  // namespace glint
