// The window under Wayland. The compositor, Weston, has its screen, mouse and keyboard from Xvfb,
// of which glint knows nothing: without a mouse GLFW 3.3 crashes by itself.
#include "live.h"
#include "media/image.h"

#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>

namespace glint::window::wayland_test {
namespace {

// What a command prints on stdout, without the end of its line, and its exit code.
std::pair<std::string, int> output_of(const std::string& command) {
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string text;
    std::array<char, 256> part;
    while (pipe && std::fgets(part.data(), part.size(), pipe)) text += part.data();
    const int status = pipe ? ::pclose(pipe) : -1;
    while (text.ends_with('\n')) text.pop_back();
    return {text, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

class Wayland : public ::testing::Test {
protected:
    void SetUp() override {
        if (output_of("command -v weston").second != 0)
            GTEST_SKIP() << "weston, a Wayland compositor, is not installed";
        const auto [folder, code] =
            output_of(GLINT_REPOSITORY "/tests/window/wayland_glfw " GLINT_WAYLAND_FOLDER);
        if (code != 0) GTEST_SKIP() << folder;
        glfw_ = folder;
        start_weston();
    }

    void TearDown() override {
        glint_.reset();
        if (weston_ <= 0) return;
        ::kill(weston_, SIGTERM);
        ::waitpid(weston_, nullptr, 0);
    }

    void start_weston() {
        const std::string log = (folder_.path() / "weston.txt").string();
        ::chmod(folder_.path().c_str(), 0700);
        weston_ = ::fork();
        if (weston_ == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);
            ::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
            ::setenv("DISPLAY", screen_.name().c_str(), 1);
            if (!::freopen(log.c_str(), "w", stderr) || !::freopen("/dev/null", "w", stdout))
                ::_exit(127);
            ::execlp("weston", "weston", "--backend=x11-backend.so", "--use-pixman",
                     "--socket=screen", "--width=1280", "--height=720", "--idle-time=0",
                     "--no-config", static_cast<char*>(nullptr));
            ::_exit(127);
        }
        ASSERT_TRUE(eventually([&] { return fs::exists(folder_.path() / "screen"); })) << read(log);
    }

    Environment environment() const {
        return {{"XDG_RUNTIME_DIR", folder_.path().string()},
                {"WAYLAND_DISPLAY", "screen"},
                {"LD_LIBRARY_PATH", glfw_}};
    }

    void open(std::string_view text) {
        write(scene(), text);
        glint_ = std::make_unique<Glint>("", folder_.path(),
                                         std::vector<std::string>{scene().string()}, environment());
        ASSERT_TRUE(glint_->says("scene.frag: shown")) << glint_->errors();
    }

    // Whether this colour fills a good part of the screen: where the window stands is up to the
    // compositor, and panels cover some of it.
    bool shows(const Colour& colour) const {
        const auto wanted = static_cast<std::uint32_t>(colour.r << 16 | colour.g << 8 | colour.b);
        return eventually([&] {
            const auto pixels = screen_.picture({0, 0}, {1280, 720});
            return std::count(pixels.begin(), pixels.end(), wanted) > 1280 * 720 / 8;
        });
    }

    fs::path scene() const { return folder_.path() / "scene.frag"; }

    Folder folder_;
    Screen screen_;
    std::string glfw_;
    pid_t weston_ = 0;
    std::unique_ptr<Glint> glint_;
};

TEST_F(Wayland, TheWindowOpensDrawsAndShowsASave) {
    open(flat({10, 200, 30}));
    EXPECT_TRUE(shows({10, 200, 30})) << glint_->errors();
    write(scene(), flat({200, 20, 90}));
    ASSERT_TRUE(glint_->says("scene.frag: shown", 2)) << glint_->errors();
    EXPECT_TRUE(shows({200, 20, 90})) << glint_->errors();
    // Full screen and back, the clipboard, a key that is held: nothing of it needs X11.
    screen_.click({900, 600});
    for (const char* chord : {"F11", "F11", "Control_L+c", "Control_L+v", "Tab", "Tab"})
        screen_.tap(chord);
    screen_.key("Right", true);
    write(scene(), flat({30, 20, 190}));
    EXPECT_TRUE(shows({30, 20, 190})) << glint_->errors();
    screen_.key("Right", false);
    EXPECT_TRUE(glint_->runs()) << glint_->errors();
}

TEST_F(Wayland, TheWindowEndsWithItsCompositor) {
    open(flat({10, 200, 30}));
    ::kill(weston_, SIGKILL);
    ::waitpid(weston_, nullptr, 0);
    weston_ = 0;
    const Glint::End end = glint_->wait();
    EXPECT_EQ(end.signal, 0) << glint_->errors();
    EXPECT_EQ(end.code, 1) << glint_->errors();
}

}  // namespace
}  // namespace glint::window::wayland_test
