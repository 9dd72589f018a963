#include "window/trial/sketcher.h"

#include <functional>

namespace glint {

std::size_t sketch_hash(const std::string& pass_text) {
    return std::hash<std::string>()(pass_text);
}

Sketcher::Sketcher(const std::string& device, const std::filesystem::path& program)
    : process_(device, program, "sketch", memory_.descriptor()) {}

}  // namespace glint
