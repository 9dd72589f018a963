// A folder for one test's files, gone with the test.
#pragma once

#include "base/temporary_folder.h"

#include <fstream>
#include <string>
#include <string_view>

namespace glint {

class TestFolder : public TemporaryFolder {
public:
    // Writes a file, with the folders above it.
    std::filesystem::path write(const std::string& name, std::string_view text) const {
        const std::filesystem::path file = path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }
};

}  // namespace glint
