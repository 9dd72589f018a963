// A folder has a file that is locked while its process runs: the kernel lifts the lock, however
// that ends, and in every container that shares the folder.
#include "base/scratch_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = "lock";

bool take(int lock) {
    return lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) == 0;
}

// It gets its name when it is locked, so that nobody takes a new folder for one that was left.
int lock_in(const fs::path& folder) {
    const fs::path unlocked = folder / "new";
    const int lock = ::open(unlocked.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    std::error_code error;
    if (take(lock)) fs::rename(unlocked, folder / kLock, error);
    return lock;
}

// While its lock is held, nobody else finds it left.
void remove_if_left(const fs::path& folder) {
    const int lock = ::open((folder / kLock).c_str(), O_RDWR | O_CLOEXEC);
    std::error_code error;
    if (take(lock)) fs::remove_all(folder, error);
    if (lock >= 0) ::close(lock);
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& parent) : path_(parent / "none") {
    std::error_code error;
    fs::create_directories(parent, error);
    std::vector<fs::path> folders;
    for (const fs::directory_entry& entry : fs::directory_iterator(parent, error))
        folders.push_back(entry);
    for (const fs::path& folder : folders) remove_if_left(folder);
    std::string name = (parent / "XXXXXX").string();
    if (!::mkdtemp(name.data())) return;
    path_ = name;
    lock_ = lock_in(path_);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

}  // namespace glint
