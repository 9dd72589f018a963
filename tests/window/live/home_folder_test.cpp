// Where the window keeps things, whatever the environment says.
#include "window/live/home_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

namespace glint::home_folder_test {
namespace {

TEST(HomeFolder, IsWhatTheVariableNamesOrBelowTheHome) {
    ::setenv("HOME", "/home/somebody", 1);
    ::setenv("GLINT_TEST_HOME", "/var/state", 1);
    EXPECT_EQ(home_folder("GLINT_TEST_HOME", ".state"), "/var/state/glint");
    ::unsetenv("GLINT_TEST_HOME");
    EXPECT_EQ(home_folder("GLINT_TEST_HOME", ".state"), "/home/somebody/.state/glint");
}

// As the XDG Base Directory Specification has it; the program runs in one folder or another.
TEST(HomeFolder, APathThatIsNotAbsoluteIsIgnored) {
    ::setenv("HOME", "/home/somebody", 1);
    for (const char* told : {"", "state", "./state"}) {
        ::setenv("GLINT_TEST_HOME", told, 1);
        EXPECT_EQ(home_folder("GLINT_TEST_HOME", ".state"), "/home/somebody/.state/glint") << told;
    }
    ::unsetenv("GLINT_TEST_HOME");
}

}  // namespace
}  // namespace glint::home_folder_test
