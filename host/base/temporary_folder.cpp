#include "base/temporary_folder.h"

#include <errno.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace glint {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    const fs::path system = fs::temp_directory_path(error);
    if (error)
        throw std::runtime_error("No temporary folder can be made: TMPDIR names no folder (" +
                                 error.message() + ").");
    std::string name = (system / "glint-XXXXXX").string();
    if (!::mkdtemp(name.data())) {
        throw std::runtime_error("No temporary folder can be made as " + name + ": " +
                                 std::generic_category().message(errno) + ".");
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace glint
