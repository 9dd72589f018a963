// The one way to open a file for reading: a regular one, or a reason why not.
//
// A pipe, a device or a socket would block for good, have no end, or do something when it is
// opened; they are refused without that.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace glint {

// "Cannot read NAME: CAUSE." The cause of a missing file ends with the nearest name, if there is
// one.
struct Unreadable : std::runtime_error {
    Unreadable(const std::filesystem::path& file, std::string why);
    std::string cause;
};

// Throws Unreadable where a file is missing, not regular or not allowed; does not open it.
void require_readable(const std::filesystem::path& file);

class ReadableFile {
public:
    // Follows links. Throws Unreadable.
    explicit ReadableFile(const std::filesystem::path& file);
    ~ReadableFile();
    ReadableFile(ReadableFile&& other) noexcept
        : file_(std::move(other.file_)),
          descriptor_(std::exchange(other.descriptor_, -1)),
          size_(other.size_) {}
    ReadableFile& operator=(ReadableFile&&) = delete;

    int descriptor() const { return descriptor_; }
    std::size_t size() const { return size_; }  // bytes, when it was opened

    // For libraries that open files themselves: leads to this very file, whatever stands under its
    // own name by now. Valid while this lives.
    std::string name() const;

    // Fills `to` with what stands from `offset` on; returns how many bytes, fewer only at the end
    // of the file. Throws Unreadable.
    std::size_t read(std::span<char> to, std::size_t offset) const;

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
    std::size_t size_ = 0;
};

// All of it. Throws Unreadable, also where it is longer than `most` bytes, before it takes memory.
std::string read_whole_file(const std::filesystem::path& file, std::size_t most);

}  // namespace glint
