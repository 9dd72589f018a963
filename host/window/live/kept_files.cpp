#include "window/live/kept_files.h"

#include "base/temporary_file.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <system_error>
#include <utility>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Another window may do the same at the same time.
void keep_within(const fs::path& folder, std::uintmax_t most_bytes) {
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

using Write = std::function<void(const fs::path&)>;

void keep_in(const fs::path& folder, const std::string& name, std::uintmax_t most_bytes,
             const Write& write) {
    try {
        if (write) {
            make_folder(folder);
            write(folder / name);
        }
        keep_within(folder, most_bytes);
    } catch (const std::exception&) {
        // A disk that is full or not ours; no memory. The next start does without.
    }
}

}  // namespace

void KeptFiles::keep(const std::string& name, Write write) {
    const bool is_writing =
        writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    if (is_writing) return;
    writing_ =
        std::async(std::launch::async, keep_in, folder_, name, most_bytes_, std::move(write));
}

void KeptFiles::forget_oldest() {
    keep({}, {});
}

}  // namespace glint
