// A file that gets its final name when whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace glint {

// "Cannot write NAME: CAUSE." Of a library's sentence about a full disk, a quota or a limit only
// the system's own words are left.
std::runtime_error cannot_write(const std::filesystem::path& file, std::string_view cause);

// With all folders above it. Throws cannot_write().
void make_folder(const std::filesystem::path& folder);

// Throws what a TemporaryFile of this target would; for those who only write after hours of work.
void require_writable(const std::filesystem::path& target);

// Whether anything has this name: a link that leads nowhere, too, through which a file would be
// written wherever it points.
bool is_taken(const std::filesystem::path& name);

// The same name, for a file that Glint names itself in a folder: what stands there and is no file,
// such as a link that would have it written elsewhere, goes first.
const std::filesystem::path& cleared(const std::filesystem::path& name);

// "Cannot read NAME: CAUSE."
std::runtime_error cannot_read(const std::filesystem::path& file, std::string_view cause);

// The same of one that a library does not understand; `words` are its own, and may be none.
std::runtime_error cannot_decode(const std::filesystem::path& file, std::string words);

// `no`: what is written stays though the power fails, which takes the disk's time, 10 ms and more.
enum class Haste { yes, no };

// Until commit() the target stays as it was; without commit() nothing stays behind.
class TemporaryFile {
public:
    // Makes an empty file in the folder of `target`. Where `target` is a symbolic link, the file it
    // points to is the one replaced. Throws std::runtime_error when the folder cannot be written,
    // the name is too long, or `target` is there and not a regular file, or write-protected.
    explicit TemporaryFile(const std::filesystem::path& target);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    // Appends bytes through a buffer. False, now and ever after, once the system refused some;
    // commit() then says why. Throws nothing, so that C libraries may call it.
    bool append(std::span<const std::byte> bytes) noexcept;

    // Open for reading and writing, for those who seek. Not to be mixed with append().
    int descriptor() const { return descriptor_; }

    // Records why the content is not whole, as an errno.
    void fail(int error) noexcept;

    // Gives the file its name. Throws std::runtime_error when any byte did not reach it.
    void commit(Haste haste = Haste::yes);

private:
    void write_out(std::span<const std::byte> bytes) noexcept;
    void give_name();

    std::filesystem::path named_;      // as the caller named it, for messages
    std::filesystem::path target_;     // with symbolic links resolved
    std::filesystem::path temporary_;  // the name it has; empty while it has none
    std::vector<std::byte> buffer_;
    int descriptor_ = -1;
    int error_ = 0;
};

// Replaces `file` by `bytes` through a temporary file beside it. Throws cannot_write().
void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes,
                      Haste haste = Haste::yes);

}  // namespace glint
