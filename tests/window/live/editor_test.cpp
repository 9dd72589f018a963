// Where no editor is found, a person is told.
#include "window/live/editor.h"

#include "../../base/test_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace glint::editor_test {
namespace {

namespace fs = std::filesystem;

class Editors : public ::testing::Test {
protected:
    Editors() {
        ::setenv("PATH", folder.c_str(), 1);
        ::unsetenv("VISUAL");
        ::unsetenv("EDITOR");
    }
    ~Editors() override { ::setenv("PATH", path.c_str(), 1); }
    void provide(const char* name, const char* script) {
        std::ofstream(folder / name) << "#!/bin/sh\n" << script << "\n";
        fs::permissions(folder / name, fs::perms::owner_all);
    }
    std::string problem() {
        pollfd polled{.fd = editor.descriptor(), .events = POLLIN, .revents = 0};
        ::poll(&polled, 1, 20'000);
        return editor.problem();
    }

    std::string path = std::getenv("PATH");
    TestFolder made;
    const fs::path folder = made.path();
    Editor editor;
};

TEST_F(Editors, ThatAreNotThereAreNamed) {
    EXPECT_NE(editor.open({"a.frag", 1, 1}).find("there is no xdg-open"), std::string::npos);
    ::setenv("EDITOR", "nothing -w", 1);
    EXPECT_NE(editor.open({"a.frag", 1, 1}).find("there is no nothing"), std::string::npos);
    ::setenv("EDITOR", "vim", 1);
    provide("vim", "exit 0");
    EXPECT_NE(editor.open({"a.frag", 1, 1}).find("No terminal"), std::string::npos);
    ::setenv("EDITOR", "emacs -nw", 1);
    provide("emacs", "exit 0");
    EXPECT_NE(editor.open({"a.frag", 1, 1}).find("No terminal"), std::string::npos);
}

TEST_F(Editors, OfTheDesktopMayBeNone) {
    provide("xdg-open", "exit 3");
    EXPECT_EQ(editor.open({"a.frag", 1, 1}), "");
    EXPECT_NE(problem().find("No editor is found"), std::string::npos);
    EXPECT_EQ(editor.problem(), "") << "it is told once";
}

TEST_F(Editors, AreGivenThePlace) {
    const fs::path told = folder / "told";
    ::mkfifo(told.c_str(), 0600);
    provide("kate", ("echo \"$@\" > " + told.string()).c_str());
    ::setenv("EDITOR", "kate", 1);
    EXPECT_EQ(editor.open({"a.frag", 3, 7}), "");
    std::string words;
    std::getline(std::ifstream(told) >> std::ws, words);
    EXPECT_EQ(words, "-l 3 -c 7 a.frag");
    EXPECT_EQ(editor.problem(), "");
}

// Ctrl+C in the terminal goes to all that belong to its session.
TEST_F(Editors, OutliveTheTerminal) {
    const fs::path told = folder / "told";
    ::mkfifo(told.c_str(), 0600);
    provide("kate", ("read -r all < /proc/$$/stat; echo \"$all\" > " + told.string()).c_str());
    ::setenv("EDITOR", "kate", 1);
    EXPECT_EQ(editor.open({"a.frag", 3, 7}), "");
    std::ifstream stat(told);
    std::string name, state;
    pid_t process = 0, parent = 0, group = 0, session = 0;
    stat >> process >> name >> state >> parent >> group >> session;
    EXPECT_EQ(session, process);
    EXPECT_NE(session, 0);
}

}  // namespace
}  // namespace glint::editor_test
