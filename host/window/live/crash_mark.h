// Remembers which scene is open, so that after a crash the next start can offer it paused.
#pragma once

#include <filesystem>
#include <utility>

namespace glint {

class CrashMark {
public:
    // Kept in a file of this folder, one a process, which is removed when the program ends as it
    // should: not where an exception, such as that of a lost GPU, ends it.
    explicit CrashMark(std::filesystem::path folder) : folder_(std::move(folder)) {}
    ~CrashMark();
    CrashMark(const CrashMark&) = delete;
    CrashMark& operator=(const CrashMark&) = delete;

    // Whether a run that is over ended while this scene was open. Its mark is gone then; those of
    // other scenes wait for their own next start.
    bool take(const std::filesystem::path& scene);

    // The program ends as it should, where no destructor runs.
    void clear() const;

    // `scene` is one name for it, however it is opened: see canonical_name().
    void set(const std::filesystem::path& scene);

private:
    std::filesystem::path folder_, file_;
    int descriptor_ = -1;
};

}  // namespace glint
