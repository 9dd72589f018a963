#include "base/module.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace glint {

namespace fs = std::filesystem;

namespace {

// Beside the program in the build folder; of one that is installed, in lib/glint/modules/ of its
// prefix; of the tests' programs, in the build folder's host/.
constexpr const char* kFolders[] = {"", "../lib/glint/modules", "../host", "../../host"};

fs::path module_file(const char* name) {
    std::error_code error;
    const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* folder : kFolders)
        if (const fs::path file = here / folder / name; fs::exists(file, error)) return file;
    return here / name;
}

}  // namespace

void* open_module(const char* name, std::string_view what) {
    const fs::path file = module_file(name);
    void* module = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (module) return module;
    throw std::runtime_error(fmt::format("The {} library does not load: {}.", what, ::dlerror()));
}

}  // namespace glint
