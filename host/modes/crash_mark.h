// Remembers which scene is open, so that after a crash the next start can offer it paused.
#pragma once

#include <filesystem>

namespace glint {

class CrashMark {
public:
    // Kept in `file`, which is removed when the program ends as it should.
    explicit CrashMark(std::filesystem::path file);
    ~CrashMark();
    CrashMark(const CrashMark&) = delete;
    CrashMark& operator=(const CrashMark&) = delete;

    // Whether the last run ended while this scene was open.
    bool names(const std::filesystem::path& scene) const;

    void set(const std::filesystem::path& scene);

private:
    std::filesystem::path file_;
};

}  // namespace glint
