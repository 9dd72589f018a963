#include "base/module.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace glint {

namespace fs = std::filesystem;

void* open_module(const char* name, std::string_view what) {
    std::error_code error;
    fs::path file = fs::read_symlink("/proc/self/exe", error).parent_path() / name;
    if (!fs::exists(file, error)) file = fs::path(GLINT_MODULE_FOLDER) / name;
    void* module = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (module) return module;
    throw std::runtime_error(fmt::format("The {} library does not load: {}.", what, ::dlerror()));
}

}  // namespace glint
