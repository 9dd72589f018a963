#include "window/live/unsaved_work.h"

#include "base/canonical_name.h"
#include "base/temporary_file.h"
#include "glsl/raw_text.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <span>
#include <system_error>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr const char* kText = "work.toml";        // as the preset would be saved
constexpr const char* kWritten = "written.toml";  // what the file said then
constexpr const char* kFile = "file";             // the name of what it is work on

std::optional<std::string> read(const fs::path& file) {
    std::string why_not;
    return read_bytes(file, why_not);
}

void write(const fs::path& file, const std::string& text) {
    write_whole_file(file, std::as_bytes(std::span(text)));
}

HeldFolder make_folder_in(const fs::path& parent) {
    make_folder(parent);
    std::string name = (parent / "XXXXXX").string();
    if (!::mkdtemp(name.data())) throw cannot_write(parent, std::strerror(errno));
    return HeldFolder(name);
}

}  // namespace

// The lock is the kernel's, which lifts it when the process ends, and knows no process by a number
// that another may have by then.
HeldFolder::HeldFolder(const fs::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(std::exchange(descriptor_, -1));
}

HeldFolder::~HeldFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

HeldFolder::HeldFolder(HeldFolder&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

HeldFolder& HeldFolder::operator=(HeldFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

void HeldFolder::remove() {
    if (descriptor_ < 0) return;
    std::error_code error;
    fs::remove_all(path_, error);
    ::close(std::exchange(descriptor_, -1));
}

void UnsavedWork::keep(const fs::path& file, const UnsavedLook& look, std::size_t set) {
    // A new one where somebody has cleared the state folder, or there is none yet.
    std::error_code error;
    HeldFolder& own = own_[set];
    if (!own || !fs::exists(own.path(), error)) own = make_folder_in(folder_);
    if (!own) throw cannot_write(folder_, "another process holds what was just made");
    write(own.path() / kFile, canonical_name(file).string());
    // In this order: a crash between them leaves a look that takes nothing back of what the file
    // says by now.
    write(own.path() / kText, look.text);
    if (look.written) write(own.path() / kWritten, *look.written);
}

void UnsavedWork::discard_found() {
    passed_.insert(found_.path());
    found_.remove();
}

void UnsavedWork::pass_found() {
    passed_.insert(found_.path());
    leave_found();
}

std::optional<UnsavedLook> UnsavedWork::find(const fs::path& file) {
    found_ = {};
    const std::string wanted = canonical_name(file).string();
    fs::file_time_type newest{};
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_, error)) {
        const fs::path text = entry.path() / kText;
        if (passed_.contains(entry.path())) continue;
        if (read(entry.path() / kFile) != wanted) continue;
        const auto written = fs::last_write_time(text, error);
        if (error || (found_ && written < newest)) continue;
        HeldFolder folder(entry.path());
        if (!folder) continue;  // its window is open
        found_ = std::move(folder);
        newest = written;
    }
    if (!found_) return std::nullopt;
    return UnsavedLook{read(found_.path() / kText).value_or(""), read(found_.path() / kWritten)};
}

}  // namespace glint
