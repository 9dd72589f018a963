// Runs glint where memory ends: in a control group of its own.
#pragma once

#include "command.h"

namespace glint::cli {

// A group with a limit, of either version of control groups; gone with this object. Only root, or
// whom a group was given to, can make one.
class MemoryGroup {
public:
    explicit MemoryGroup(std::size_t bytes) {
        make("/sys/fs/cgroup", "memory.max", "0::", bytes) ||
            make("/sys/fs/cgroup/memory", "memory.limit_in_bytes", ":memory:", bytes);
    }
    ~MemoryGroup() {
        std::error_code ignored;
        if (is_there()) fs::remove(folder_, ignored);
    }
    MemoryGroup(const MemoryGroup&) = delete;
    MemoryGroup& operator=(const MemoryGroup&) = delete;

    bool is_there() const { return !folder_.empty(); }

    // A child begins in the group of its parent, who only visits this one.
    Outcome run(const Command& command) const {
        put(folder_ / "cgroup.procs", ::getpid());
        Process process(command);
        put(home_ / "cgroup.procs", ::getpid());
        return process.wait();
    }

private:
    static bool put(const fs::path& file, std::size_t number) {
        return fs::exists(file) && (std::ofstream(file) << number << std::flush).good();
    }
    static bool put(const fs::path& file, pid_t number) {
        return put(file, static_cast<std::size_t>(number));
    }

    // Where this process is at home: a container may see its own group as the root.
    static fs::path home(const fs::path& root, const std::string& mark) {
        std::ifstream in("/proc/self/cgroup");
        for (std::string line; std::getline(in, line);) {
            const std::size_t at = line.find(mark);
            if (at == std::string::npos) continue;
            const fs::path group = root / fs::path(line.substr(at + mark.size())).relative_path();
            if (fs::exists(group / "cgroup.procs")) return group;
        }
        return root;
    }

    bool make(const fs::path& root, const char* limit, const std::string& mark, std::size_t bytes) {
        std::error_code error;
        if (!fs::exists(root / "cgroup.procs")) return false;
        if (fs::exists(root / "cgroup.subtree_control"))
            std::ofstream(root / "cgroup.subtree_control") << "+memory" << std::flush;
        const fs::path folder = root / ("glint-test-" + std::to_string(::getpid()));
        if (!fs::create_directory(folder, error)) return false;
        home_ = home(root, mark);
        // Joining once shows that it will do.
        const bool joins = put(folder / limit, bytes) && put(folder / "cgroup.procs", ::getpid()) &&
                           put(home_ / "cgroup.procs", ::getpid());
        if (joins) folder_ = folder;
        if (!joins) fs::remove(folder, error);
        return joins;
    }

    fs::path folder_, home_;
};

}  // namespace glint::cli
