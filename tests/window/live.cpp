#include "live.h"

#include "base/process_time.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace glint::window {
namespace {

// Fields of /proc/PID/stat after the name, which may hold anything: 0 is the state, field 3.
std::vector<std::string> stat_of(const std::string& process) {
    const std::string text = read("/proc/" + process + "/stat");
    std::istringstream stream(text.substr(std::min(text.rfind(')') + 1, text.size())));
    return {std::istream_iterator<std::string>(stream), {}};
}

double cpu_seconds_of(const std::string& process) {
    const auto fields = stat_of(process);
    if (fields.size() < 15) return 0.0;
    double ticks = 0.0;
    for (std::size_t i = 11; i < 15; ++i) ticks += std::stod(fields[i]);
    return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

[[noreturn]] void become(const std::string& display, const fs::path& folder, const fs::path& errors,
                         std::vector<std::string> words, const Environment& environment) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that is killed leaves nothing behind
    for (const int signal : {SIGINT, SIGHUP}) ::signal(signal, SIG_DFL);  // nohup, or a shell's &
    const std::string home = (folder / "home").string();
    ::setenv("DISPLAY", display.c_str(), 1);
    ::setenv("HOME", home.c_str(), 1);
    const char* path = std::getenv("PATH");
    ::setenv("PATH", ((folder / "bin").string() + ":" + (path ? path : "")).c_str(), 1);
    // Mesa does not ask $HOME. Shared: every window has the same panels to compile.
    for (const auto& [name, value] : shader_cache(GLINT_SHADER_CACHE))
        ::setenv(name.c_str(), value.c_str(), 1);
    for (const char* name : {"XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_DATA_HOME",
                             "WAYLAND_DISPLAY", "EDITOR", "VISUAL"}) {
        ::unsetenv(name);
    }
    if (display.empty()) ::unsetenv("DISPLAY");
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    const int err = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    const int in = ::open("/dev/null", O_RDWR);
    if (::chdir(folder.c_str()) != 0 || ::dup2(in, 0) < 0 || ::dup2(in, 1) < 0 ||
        ::dup2(err, 2) < 0) {
        ::_exit(126);
    }
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
}

// Another build, to compare with, where one is named.
std::string program() {
    const char* benched = std::getenv("GLINT_BENCHED");
    return benched ? benched : GLINT_BINARY;
}

}  // namespace

void write(const fs::path& file, std::string_view text) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::string read(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();  // ends where a process that is read of in /proc has gone
    return text.str();
}

std::string text_in(const fs::path& png, std::string_view key) {
    const std::string bytes = read(png);
    const std::string head = "tEXt" + std::string(key) + '\0';
    const std::size_t at = bytes.find(head);
    if (at == std::string::npos || at < 4) return {};
    // The length of key and text stands before the chunk's name; a checksum follows the text, and
    // its bytes may look like more of a number.
    std::size_t length = 0;
    for (std::size_t i = at - 4; i < at; ++i) length = length << 8 | std::uint8_t(bytes[i]);
    return bytes.substr(at + head.size(), length - key.size() - 1);
}

std::string flat(const Colour& colour) {
    return fmt::format(
        "void mainImage(out vec4 c, in vec2 p) {{ c = vec4({}, {}, {}, 255) / 255.0; }}\n",
        colour.r, colour.g, colour.b);
}

Environment shader_cache(const fs::path& folder) {
    return {{"MESA_SHADER_CACHE_DIR", folder.string()},
            {"__GL_SHADER_DISK_CACHE_PATH", folder.string()}};
}

fs::path repository() {
    const fs::path folder = fs::path(program()) / "../../../..";  // of build/release/host/glint
    return fs::weakly_canonical(folder);
}

Glint::Glint(const std::string& display, const fs::path& folder, std::vector<std::string> arguments,
             const Environment& environment)
    : errors_(folder / "stderr.txt") {
    arguments.insert(arguments.begin(), program());
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("no process");
    if (process_ == 0) become(display, folder, errors_, std::move(arguments), environment);
}

Glint::~Glint() {
    if (!runs()) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

bool Glint::runs() {
    if (process_ <= 0) return false;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) != process_) return true;
    process_ = 0;
    end_ = {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            WIFSIGNALED(status) ? WTERMSIG(status) : 0};
    return false;
}

void Glint::signal(int number) {
    if (process_ > 0) ::kill(process_, number);
}

Glint::End Glint::wait(double seconds) {
    if (!eventually([&] { return !runs(); }, seconds)) {
        signal(SIGKILL);
        eventually([&] { return !runs(); });
    }
    return end_;
}

std::string Glint::errors() const {
    return read(errors_);
}

int Glint::count(std::string_view text) const {
    const std::string all = errors();
    int found = 0;
    for (std::size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) {
        ++found;
    }
    return found;
}

bool Glint::says(std::string_view text, int times, double seconds) {
    bool ended = false;  // asked before its last words are read
    eventually(
        [&] {
            ended = !runs();
            return count(text) >= times || ended;
        },
        seconds);
    if (count(text) >= times) return true;
    if (ended) ADD_FAILURE() << "glint has ended: code " << end_.code << ", signal " << end_.signal;
    return false;
}

std::vector<pid_t> Glint::children() const {
    std::vector<pid_t> list;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const auto fields = stat_of(name);
        if (fields.size() > 1 && fields[1] == std::to_string(process_) && fields[0] != "Z") {
            list.push_back(static_cast<pid_t>(std::stol(name)));
        }
    }
    return list;
}

double Glint::cpu_seconds() const {
    double seconds = cpu_seconds_of(std::to_string(process_));
    for (const pid_t child : children()) seconds += cpu_seconds_of(std::to_string(child));
    return seconds;
}

double Glint::waited_seconds() const {
    double seconds = time_of(process_).waited;
    for (const pid_t child : children()) seconds += time_of(child).waited;
    return seconds;
}

double Glint::resident_mib() const {
    std::istringstream stream(read(fmt::format("/proc/{}/statm", process_)));
    double total = 0.0, resident = 0.0, shared = 0.0;
    stream >> total >> resident >> shared;
    return (resident - shared) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

void Window::SetUp() {
    folder_ = std::make_unique<Folder>();
    fs::create_directories(memory_of_resolutions().parent_path());
    try {
        screen_ = std::make_unique<Screen>(screen_size_, screen_has_glx_);
    } catch (const std::runtime_error& error) {
        GTEST_SKIP() << error.what();
    }
}

void Window::TearDown() {
    if (!glint_) return;
    const std::string errors = glint_->errors();
    EXPECT_EQ(errors.find("GL_"), std::string::npos) << errors;
    if (!HasFailure()) return;
    const std::size_t from = errors.size() > 4000 ? errors.size() - 4000 : 0;
    std::cerr << "--- stderr of glint, its end\n" << errors.substr(from) << "---\n";
}

void Window::remember_full_size(const std::vector<std::string>& files) const {
    const fs::path memory = memory_of_resolutions();
    std::string lines = fs::exists(memory) ? read(memory) : "";
    for (const std::string& name : files) {
        const fs::path file = folder_->path() / name;
        if (!fs::is_regular_file(file)) continue;  // a word of the command line
        const std::string place = " " + fs::canonical(file).string() + "\n";
        if (lines.find(place) == std::string::npos) lines += "full plain 1" + place;
    }
    write(memory, lines);
}

void Window::start(const std::vector<std::string>& arguments) {
    if (counts_pixels_) remember_full_size(arguments);
    glint_ = std::make_unique<Glint>(screen_->name(), folder_->path(), arguments, environment_);
    ASSERT_TRUE(eventually([&] { return screen_->window() != 0 || !glint_->runs(); }));
}

void Window::open(std::string_view scene_text, const std::vector<std::string>& arguments) {
    write(scene(), scene_text);
    std::vector<std::string> all = {scene().string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    start(all);
    ASSERT_TRUE(glint_->says("scene.frag: shown")) << glint_->errors();
}

::testing::AssertionResult Window::shows(const Colour& colour, glm::ivec2 at,
                                         double seconds) const {
    if (eventually([&] { return screen_->pixel(at) == colour; }, seconds))
        return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "the screen has " << screen_->pixel(at);
}

void Window::settle() const {
    constexpr int kLooks = 50, kMostLooks = 80;
    constexpr double kMostWaited = 0.02;  // s between two looks
    auto before = screen_->picture({0, 0}, screen_size_);
    double waited = glint_ ? glint_->waited_seconds() : 0.0;
    for (int still = 0, i = 0, all = 0; still < 3 && i < kLooks && all < kMostLooks; ++all) {
        std::this_thread::sleep_for(std::chrono::milliseconds(70));
        auto now = screen_->picture({0, 0}, screen_size_);
        const double waited_before = waited;
        waited = glint_ ? glint_->waited_seconds() : 0.0;
        // What is not let run changes nothing, and is not settled.
        const bool had_its_turn = waited - waited_before < kMostWaited;
        if (had_its_turn) ++i;
        still = now == before ? still + had_its_turn : 0;
        before = std::move(now);
    }
}

fs::path Window::still(const std::vector<std::string>& arguments, fs::path file) const {
    const fs::path picture = folder_->path() / "expected.png";
    if (file.empty()) file = scene();
    std::vector<std::string> all = {"still", file.string(), "-o", picture.string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    Glint process(screen_->name(), folder_->path(), all);
    EXPECT_EQ(process.wait(kPatience).code, 0) << process.errors();
    return picture;
}

int Window::largest_difference(const Image& wanted, int rows) const {
    int largest = 0;
    const auto width = static_cast<std::size_t>(wanted.size.x);
    const auto seen = screen_->picture({0, 0}, {wanted.size.x, rows});
    for (std::size_t i = 0; i < seen.size(); ++i) {
        // Rows of files run bottom up.
        const std::size_t row = static_cast<std::size_t>(wanted.size.y) - 1 - i / width;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto value =
                std::to_integer<int>(wanted.pixels[(row * width + i % width) * 3 + c]);
            const int shown = static_cast<int>(seen[i] >> (16 - 8 * c) & 255u);
            largest = std::max(largest, std::abs(value - shown));
        }
    }
    return largest;
}

}  // namespace glint::window
