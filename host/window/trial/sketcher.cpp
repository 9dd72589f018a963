#include "window/trial/sketcher.h"

#include <sys/mman.h>
#include <unistd.h>

#include <functional>

namespace glint {

std::size_t sketch_hash(const std::string& pass_text) {
    return std::hash<std::string>()(pass_text);
}

Sketcher::Sketcher(const std::string& device, const std::filesystem::path& program)
    : file_(::memfd_create("glint-sketch", MFD_CLOEXEC)),
      process_(device, program, "sketch", file_ < 0 ? kNothing : file_) {}

Sketcher::~Sketcher() {
    release();
    if (file_ >= 0) ::close(file_);
}

void Sketcher::release() {
    if (!memory_.empty()) ::munmap(memory_.data(), memory_.size());
    memory_ = {};
}

std::span<std::byte> Sketcher::memory(std::size_t bytes) {
    if (memory_.size() >= bytes) return memory_.first(bytes);
    release();
    if (file_ < 0 || ::ftruncate(file_, static_cast<off_t>(bytes)) != 0) return {};
    void* at = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
    if (at == MAP_FAILED) return {};
    memory_ = {static_cast<std::byte*>(at), bytes};
    return memory_;
}

}  // namespace glint
