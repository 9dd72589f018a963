// Remembers which scene is open, so that after a crash the next start can offer it paused.
#pragma once

#include <filesystem>

namespace glint {

class CrashMark {
public:
    // Kept in a file of this folder, one a process, which is removed when the program ends as it
    // should: not where an exception, such as that of a lost GPU, ends it.
    explicit CrashMark(std::filesystem::path folder);
    ~CrashMark();
    CrashMark(const CrashMark&) = delete;
    CrashMark& operator=(const CrashMark&) = delete;

    // Whether a run that is over ended while this scene was open. Its mark is gone then.
    bool take(const std::filesystem::path& scene);

    void set(const std::filesystem::path& scene);

private:
    std::filesystem::path folder_, file_;
};

}  // namespace glint
