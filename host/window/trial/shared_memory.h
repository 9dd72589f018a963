// Memory that two processes see: what the window's buffers hold, for one that draws with it.
#pragma once

#include <cstddef>
#include <span>

namespace glint {

// Our side of it.
class SharedMemory {
public:
    SharedMemory();
    ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    // Room for so many bytes; empty where there is none. Valid until it is asked for again.
    std::span<std::byte> room(std::size_t bytes);

    // What the other process is started with as its standard output.
    int descriptor() const { return file_; }

private:
    void release();
    int file_;
    std::span<std::byte> memory_;
};

// The other side: what stands at our standard output, as large as it is by now.
class SeenMemory {
public:
    SeenMemory();
    ~SeenMemory();
    SeenMemory(const SeenMemory&) = delete;
    SeenMemory& operator=(const SeenMemory&) = delete;
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::span<const std::byte> bytes_;
};

}  // namespace glint
