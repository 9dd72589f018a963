#include "base/canonical_name.h"

#include "base/words.h"

#include <system_error>

namespace glint {

std::filesystem::path canonical_name(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path full = std::filesystem::absolute(file, error);
    if (error) return file;
    std::filesystem::path name = std::filesystem::weakly_canonical(full, error);
    return error ? full.lexically_normal() : name;
}

std::string ending_of(const std::filesystem::path& file) {
    return in_small_letters(file.extension().string());
}

}  // namespace glint
