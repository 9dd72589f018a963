// What a person has not saved, kept in the state folder from the moment it changes: a crash takes
// nothing of it.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace glint {

// A folder that this process alone holds: another can take it once this one has ended, however.
class HeldFolder {
public:
    HeldFolder() = default;
    // Takes it; holds nothing where another process does.
    explicit HeldFolder(const std::filesystem::path& path);
    ~HeldFolder();
    HeldFolder(HeldFolder&& other) noexcept;
    HeldFolder& operator=(HeldFolder&& other) noexcept;

    explicit operator bool() const { return descriptor_ >= 0; }
    const std::filesystem::path& path() const { return path_; }
    void remove();  // with all that lies in it

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

// Work on a file, as presets: the look as it would be saved, and what the file said meanwhile. The
// work is what differs between them; all else is the file's, which may be edited before it is
// offered.
struct UnsavedLook {
    std::string text;
    std::optional<std::string> written;  // not where an older Glint has kept it
    bool operator==(const UnsavedLook&) const = default;
};

// The unsaved work of one window on one file, in each of the two sets of tweaks. Every window has
// folders of its own inside that of all, so that two on the same file keep both.
class UnsavedWork {
public:
    // `folder` holds the work of all windows; it is made when there is something to keep.
    explicit UnsavedWork(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Keeps this look as the work on `file` in a set, 0 or 1. What was kept of that before is
    // replaced. Throws std::runtime_error where it cannot be written.
    void keep(const std::filesystem::path& file, const UnsavedLook& look, std::size_t set);

    // It is saved, or not wanted.
    void forget(std::size_t set) { own_[set].remove(); }
    void forget() {
        for (HeldFolder& folder : own_) folder.remove();
    }

    // It waits for the next window that opens its file.
    void leave() {
        own_ = {};
        aside_.clear();
    }
    // So it does once this window ends, unless what was set aside is forgotten before.
    void set_aside(std::size_t set) { aside_.push_back(std::exchange(own_[set], {})); }
    void forget_aside() {
        for (HeldFolder& folder : aside_) folder.remove();
        aside_.clear();
    }

    // The newest work on `file` of windows that have ended. It is this window's to offer until
    // discard_found(); where the window ends before, the next one finds it again.
    std::optional<UnsavedLook> find(const std::filesystem::path& file);
    // Not found again by this window, even where its folder cannot be removed.
    void discard_found();

    // Lets go of what was found for another file, unharmed.
    void leave_found() { found_ = {}; }
    // The same of what this window can do nothing with, which it does not find again.
    void pass_found();
    const std::filesystem::path& found_folder() const { return found_.path(); }

private:
    std::filesystem::path folder_;
    std::array<HeldFolder, 2> own_;
    std::vector<HeldFolder> aside_;
    HeldFolder found_;
    std::set<std::filesystem::path> passed_;
};

}  // namespace glint
