#include "base/memory.h"

#include "test_folder.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace glint::memory_test {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

std::size_t left(const TestFolder& root, const std::string& groups) {
    std::istringstream in(groups);
    return memory_left_by_groups(root.path(), in);
}

TEST(Memory, TheNarrowestGroupCountsAndWhatCanBeGivenBackIsFree) {
    const TestFolder root;
    root.write("farm/memory.max", "9000\n");
    root.write("farm/memory.current", "6000\n");
    root.write("farm/memory.stat", "anon 5000\ninactive_file 500\nactive_file 500\n");
    root.write("farm/job/memory.max", "max\n");
    root.write("farm/job/memory.current", "5000\n");
    EXPECT_EQ(left(root, "0::/farm/job\n"), 3500u);
    root.write("farm/job/memory.max", "5100\n");
    EXPECT_EQ(left(root, "0::/farm/job\n"), 100u);
    root.write("farm/job/memory.max", "4000\n");
    EXPECT_EQ(left(root, "0::/farm/job\n"), 0u);
}

TEST(Memory, AContainersOwnGroupStandsAtTheRoot) {
    const TestFolder root;
    root.write("memory.max", "9000\n");
    root.write("memory.current", "6000\n");
    EXPECT_EQ(left(root, "0::/\n"), 3000u);
    EXPECT_EQ(left(root, "0::/name/outside\n"), 3000u);
}

TEST(Memory, TheFirstVersionOfGroupsIsReadToo) {
    const TestFolder root;
    root.write("memory/job/memory.limit_in_bytes", "9000\n");
    root.write("memory/job/memory.usage_in_bytes", "6000\n");
    root.write("memory/job/memory.stat", "inactive_file 1\ntotal_inactive_file 500\n");
    EXPECT_EQ(left(root, "5:cpu,cpuacct:/other\n4:memory:/job\n0::/\n"), 3500u);
}

TEST(Memory, WhereThereIsNoGroupThereIsNoLimit) {
    const TestFolder root;
    EXPECT_EQ(left(root, ""), kNoLimit);
    EXPECT_EQ(left(root, "nonsense\n4:cpu:/a\n0::/b\n"), kNoLimit);
    EXPECT_GT(available_memory(), 0u);
}

}  // namespace
}  // namespace glint::memory_test
