// Where no editor is found, a person is told.
#include "window/live/editor.h"

#include "../../base/test_folder.h"
#include "base/launch.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
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

TEST_F(Editors, OfTheDesktopMayBeGlintItself) {
    provide("xdg-open", "exit 0");
    provide("xdg-mime", "echo glint.desktop");
    EXPECT_NE(editor.open({"a.frag", 1, 1}).find("set $EDITOR"), std::string::npos);
    EXPECT_EQ(editor.open({"a.toml", 1, 1}), "") << "presets are another kind";
    provide("xdg-mime", "echo org.gnome.gedit.desktop");
    EXPECT_EQ(editor.open({"a.frag", 1, 1}), "");
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

// A file that an #include names may be called "-c!rm *".
TEST_F(Editors, TakeNoNameForAnOption) {
    for (const char* name : {"vim", "code", "nano", "emacs", "kate", "hx", "other"})
        for (const std::string& word : editor_command(name, {"-c!touch taken", 3, 1}))
            EXPECT_FALSE(word.starts_with("-c!")) << name;
    EXPECT_EQ(editor_command("vim", {"-c!touch taken", 3, 1}).back(), "./-c!touch taken");
}

// As a shell reads a command, and nothing of a file's name.
TEST_F(Editors, AreNamedWithQuotesAndBackslashes) {
    using Words = std::vector<std::string>;
    for (const auto& [line, words] : std::vector<std::pair<std::string, Words>>{
             {"emacsclient -a ''", {"emacsclient", "-a", ""}},
             {R"('/opt/my editor/run' "two  words" a\ b)",
              {"/opt/my editor/run", "two  words", "a b"}},
             {R"(ed "say \"it\" \n" 'a\b"c'd)", {"ed", R"(say "it" \n)", R"(a\b"cd)"}},
             {"  ed\t-x ", {"ed", "-x"}},
             {"ed 'not closed", {"ed", "not closed"}},
             {"ed \\", {"ed", "\\"}}}) {
        Words command = editor_command(line, {"it's $HOME;.frag", 3, 1});
        EXPECT_EQ(command.back(), "it's $HOME;.frag");
        command.resize(words.size());
        EXPECT_EQ(command, words) << line;
    }
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

// A Neovim of the test's own, if there is one to be had: with `it's a.frag` before the person, or
// with a file of no interest.
class OpenNeovim : public Editors {
protected:
    void SetUp() override {
        ::setenv("PATH", path.c_str(), 1);
        if (std::system("nvim --version >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "nvim is not installed";
        ::setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
        ::setenv("EDITOR", "nvim", 1);
        ::unsetenv("NVIM");
        ::unsetenv("NVIM_LISTEN_ADDRESS");
        std::ofstream(file) << "one\ntwo\nthree\n";
    }
    void TearDown() override {
        if (process > 0) ::kill(process, SIGKILL), wait_for(process);
        ::unsetenv("XDG_RUNTIME_DIR");
    }
    void show(const fs::path& shown) {
        process = launch({.words = {"nvim", "--headless", "--clean", "-n", "--listen",
                                    socket.string(), shown.string()}})
                      .process;
        for (int i = 0; i < 500 && !fs::exists(socket); ++i) ::usleep(10'000);
    }
    std::string where() {
        const Launched asked =
            launch({.words = {"nvim", "--server", socket.string(), "--remote-expr",
                              "expand('%:t') . ' ' . line('.') . ' ' . col('.')"},
                    .messages = kPipe});  // of 0.7, for what it prints
        const std::string text = read_to_end(asked.pipe);
        wait_for(asked.process);
        return text;
    }
    const fs::path file = folder / "it's a.frag", socket = folder / "nvim.test";
    pid_t process = 0;
};

TEST_F(OpenNeovim, GoesToThePlaceInTheFileThatItHas) {
    show(file);
    EXPECT_EQ(editor.open({file.string(), 3, 2}), "");
    EXPECT_EQ(where(), "it's a.frag 3 2");
}

TEST_F(OpenNeovim, ThatIsNamedTakesTheFileUp) {
    show(folder / "other");
    ::setenv("EDITOR", ("nvim --server " + socket.string()).c_str(), 1);
    EXPECT_EQ(editor.open({file.string(), 2, 1}), "");
    EXPECT_EQ(where(), "it's a.frag 2 1");
    ::setenv("EDITOR", ("nvim --server " + (folder / "none").string()).c_str(), 1);
    EXPECT_NE(editor.open({file.string(), 2, 1}).find("No Neovim answers at"), std::string::npos);
}

TEST_F(OpenNeovim, WithOtherFilesIsLeftAlone) {
    show(folder / "other");
    ::setenv("PATH", folder.c_str(), 1);  // without a terminal
    provide("nvim", "exit 0");
    EXPECT_NE(editor.open({file.string(), 2, 1}).find("No terminal"), std::string::npos);
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(where(), "other 1 1");
}

}  // namespace
}  // namespace glint::editor_test
