// What a person sees who calls glint from a terminal, and what a program reads.
#include "command.h"

#include <sys/ioctl.h>

namespace glint::cli::terminal_test {
namespace {

// A terminal of 80 columns with nobody before it.
class Terminal {
public:
    Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
        winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
        if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
            ::ioctl(master_, TIOCSWINSZ, &size) != 0)
            throw std::runtime_error("no terminal");
        name_ = ::ptsname(master_);
        // Keeps what is written until it is read, also once nobody else has it open.
        held_ = ::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    }
    ~Terminal() {
        ::close(held_);
        ::close(master_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    const std::string& name() const { return name_; }

    // All that was written to it, without the carriage returns that it adds.
    std::string shown() const {
        std::string text;
        pollfd end{master_, POLLIN, 0};
        std::array<char, 4096> chunk;
        while (::poll(&end, 1, 0) > 0 && (end.revents & POLLIN)) {
            const ssize_t count = ::read(master_, chunk.data(), chunk.size());
            if (count <= 0) break;
            text.append(chunk.data(), static_cast<std::size_t>(count));
        }
        std::erase(text, '\r');
        return text;
    }

private:
    int master_ = -1, held_ = -1;
    std::string name_;
};

class AtATerminal : public InAFolder {
protected:
    std::string told(std::vector<std::string> arguments,
                     std::vector<std::pair<std::string, std::string>> environment) const {
        const Terminal terminal;
        Command command = this->command(std::move(arguments));
        command.environment = std::move(environment);
        command.err_to = terminal.name();
        EXPECT_NE(run(command).code, 0);
        return terminal.shown();
    }
};

constexpr std::string_view kWrong =
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "\t/* \u6c34 */ c = wrong;\n"
    "}\n";

TEST_F(AtATerminal, AnErrorHasItsLineAndACaretBelowTheWord) {
    write("scene.frag", kWrong);
    const std::string plain = glint({"info", "scene.frag"}).err;
    const std::string first = plain.substr(0, plain.find('\n'));
    EXPECT_TRUE(first.starts_with("scene.frag:2:")) << first;
    EXPECT_EQ(plain.find('^'), std::string::npos) << "no terminal, no caret";
    EXPECT_EQ(plain.find('\033'), std::string::npos);

    const std::string text = told({"info", "scene.frag"}, {{"NO_COLOR", "1"}, {"TERM", "xterm"}});
    EXPECT_EQ(text.find('\033'), std::string::npos) << text;
    // The tab stands for four cells, the character of two cells for one column.
    EXPECT_TRUE(text.starts_with(first + "\n    2 |     /* \u6c34 */ c = wrong;"
                                         "\n      |                  ^\n"))
        << text;
}

TEST_F(AtATerminal, TheSeverityHasAColourUnlessNobodyWantsOne) {
    write("scene.frag", kWrong);
    const std::vector<std::pair<std::string, std::string>> colourful = {{"NO_COLOR", ""},
                                                                        {"TERM", "xterm"}};
    EXPECT_NE(told({"info", "scene.frag"}, colourful).find("\033[1;31merror:\033[0m"),
              std::string::npos);
    EXPECT_NE(told({"still", "scene.frag"}, colourful).find("\033[1;31merror:\033[0m --output"),
              std::string::npos);
    EXPECT_EQ(told({"still", "scene.frag"}, {{"NO_COLOR", ""}, {"TERM", "dumb"}}).find('\033'),
              std::string::npos);
    EXPECT_EQ(told({"still", "scene.frag"},
                   {{"NO_COLOR", ""}, {"TERM", "xterm"}, {"INSIDE_EMACS", "28.2,compile"}})
                  .find('\033'),
              std::string::npos);
}

}  // namespace
}  // namespace glint::cli::terminal_test
