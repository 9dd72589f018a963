#include "window/trial/shared_memory.h"

#include "base/launch.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stdexcept>

namespace glint {

SharedMemory::SharedMemory() : file_(::memfd_create("glint-buffers", MFD_CLOEXEC)) {
    if (file_ < 0) file_ = kNothing;
}

SharedMemory::~SharedMemory() {
    release();
    if (file_ >= 0) ::close(file_);
}

void SharedMemory::release() {
    if (!memory_.empty()) ::munmap(memory_.data(), memory_.size());
    memory_ = {};
}

std::span<std::byte> SharedMemory::room(std::size_t bytes) {
    if (memory_.size() >= bytes) return memory_.first(bytes);
    release();
    if (file_ < 0 || ::ftruncate(file_, static_cast<off_t>(bytes)) != 0) return {};
    void* at = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
    if (at == MAP_FAILED) return {};
    memory_ = {static_cast<std::byte*>(at), bytes};
    return memory_;
}

SeenMemory::SeenMemory() {
    struct stat status {};
    if (::fstat(STDOUT_FILENO, &status) != 0 || status.st_size == 0) return;
    const auto bytes = static_cast<std::size_t>(status.st_size);
    void* at = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, STDOUT_FILENO, 0);
    if (at == MAP_FAILED) throw std::runtime_error("The window's buffers cannot be seen.");
    bytes_ = {static_cast<const std::byte*>(at), bytes};
}

SeenMemory::~SeenMemory() {
    if (!bytes_.empty())
        ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());  // maps take no const
}

}  // namespace glint
