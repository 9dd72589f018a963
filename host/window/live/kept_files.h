// A folder of a cache that is written beside the thread that draws, and does not grow without end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <string>

namespace glint {

class KeptFiles {
public:
    // All files together within `most_bytes`: those written longest ago go. The folder is made with
    // the first of them. The destructor waits for what is being written.
    KeptFiles(std::filesystem::path folder, std::uintmax_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    const std::filesystem::path& folder() const { return folder_; }

    // Calls `write` with the place of this name on a thread of its own; it writes the file whole or
    // throws. Where it throws, or one is still being written, nothing is kept.
    void keep(const std::string& name, std::function<void(const std::filesystem::path&)> write);
    // Another process has written one: what is too much by now goes, on that thread.
    void forget_oldest();

private:
    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
    std::future<void> writing_;
};

}  // namespace glint
