// Thousands of mixed saves in the window: window_soak [SAVES [EVERY]]. After each EVERY of them it
// prints what glint and its trial process hold, which saves were never shown, and how long they
// took. It judges nothing.
#include "live.h"
#include "media/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <set>

namespace glint::window {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPatience = 30.0;    // s, then a save is lost
constexpr glm::ivec2 kPlace{3, 300};  // which no panel covers

enum class Kind {
    edit,     // valid, in place
    typo,     // told of; the picture stays
    tweak,    // another default
    include,  // an included file
    rename,   // written beside and renamed over
    chunks,   // truncated, and written in two pieces
    image,    // a picture that the scene reads
    preset,   // another value
    heavier,  // more work a pixel
    remove,   // deleted and created again
};
constexpr std::array kKinds = {Kind::edit,    Kind::typo,   Kind::tweak, Kind::include,
                               Kind::rename,  Kind::chunks, Kind::image, Kind::preset,
                               Kind::heavier, Kind::remove};
constexpr std::array kNames = {"edit",   "typo",  "tweak",  "include", "rename",
                               "chunks", "image", "preset", "heavier", "remove"};

// The scene as its files say it now. Each kind of save changes one number, which changes the
// colour.
struct State {
    int red = 0;    // the text: 0 to 99
    int level = 0;  // a tweak that the preset sets: 0 to 99, added to red
    int green = 0;  // the included file: 0 to 99
    int shift = 0;  // a tweak's default: 0 to 99, added to green
    int blue = 0;   // the image: 0 to 199
    int work = 1;   // rounds of a loop

    Colour colour() const { return {20 + red + level, 20 + green + shift, 20 + blue}; }
};

// What is new at the end of a file that only grows.
class Tail {
public:
    explicit Tail(fs::path file) : file_(std::move(file)) {}
    bool says(const std::string& words) {
        std::ifstream in(file_, std::ios::binary);
        in.seekg(read_);
        const std::string fresh{std::istreambuf_iterator<char>(in), {}};
        read_ += static_cast<std::streamoff>(fresh.size());
        kept_ += fresh;
        return kept_.find(words) != std::string::npos;
    }
    void forget() {
        says("");
        kept_.clear();
    }

private:
    fs::path file_;
    std::streamoff read_ = 0;
    std::string kept_;
};

double mib_of(pid_t process, const std::string& field) {
    const std::string text = read("/proc/" + std::to_string(process) + "/status");
    const std::size_t at = text.find(field + ":");
    if (at == std::string::npos) return 0.0;
    return std::strtod(text.c_str() + at + field.size() + 1, nullptr) / 1024.0;
}

class Soak {
public:
    Soak() {
        fs::create_directory(folder_.path() / "heap");
        write_include();
        write_image_file();
        write(scene(), text());
        write_preset();
        glint_ = std::make_unique<Glint>(
            screen_.name(), folder_.path(), std::vector<std::string>{preset().string()},
            Environment{{"LD_PRELOAD", GLINT_HEAP_REPORT},
                        {"GLINT_HEAP_FOLDER", (folder_.path() / "heap").string()}});
        if (!is_shown()) {
            fmt::print("The first picture was not shown.\n{}", glint_->errors());
            std::exit(1);
        }
    }

    void save(std::size_t number);
    void print(std::size_t saves);

private:
    fs::path scene() const { return folder_.path() / "scene.frag"; }
    fs::path preset() const { return folder_.path() / "preset.toml"; }

    std::string text() const {
        return fmt::format(
            "#include \"part.glsl\"\n"
            "uniform int level; //@ 0 [0, 99]\n"
            "uniform int shift; //@ {} [0, 99]\n"
            "uniform sampler2D blot; //@ image blot.png filter=nearest\n"
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    float sum = 0.0;\n"
            "    for (int i = 0; i < {}; ++i) sum += sin(p.x + float(i));\n"
            "    c = vec4({}.0 + float(level), green() + float(shift), 0, 255) / 255.0;\n"
            "    c.b = texelFetch(blot, ivec2(0), 0).r;\n"
            "    if (p.x > 640.0) c.rgb += 0.001 * sum;\n"
            "}}\n",
            state_.shift, state_.work, 20 + state_.red);
    }
    void write_include() const {
        write(folder_.path() / "part.glsl",
              fmt::format("float green() {{ return {}.0; }}\n", 20 + state_.green));
    }
    void write_image_file() const {
        Image image{.size = {1, 1}, .channels = 3, .type = ChannelType::u8, .pixels = {}};
        image.pixels.assign(3, static_cast<std::byte>(20 + state_.blue));
        write_image(folder_.path() / "blot.png", image);
    }
    void write_preset() const {
        write(preset(),
              fmt::format("scene = \"scene.frag\"\n[tweaks]\nlevel = {}\n", state_.level));
    }
    bool is_shown() const {
        const Colour wanted = state_.colour();
        return eventually([&] { return screen_.pixel(kPlace) == wanted; }, kPatience);
    }
    int other(int now, int most) { return (now + 1 + static_cast<int>(random_() % 97)) % most; }
    void change(Kind kind);

    Folder folder_;
    Screen screen_;
    std::unique_ptr<Glint> glint_;
    State state_;
    Tail errors_{folder_.path() / "stderr.txt"};
    std::minstd_rand random_{1};
    std::array<std::vector<double>, kKinds.size()> ms_;
    std::array<int, kKinds.size()> lost_{};
    std::set<pid_t> trials_;
};

void Soak::change(Kind kind) {
    if (kind == Kind::typo) return write(scene(), text() + "float broken = ;\n");
    if (kind == Kind::include) return state_.green = other(state_.green, 100), write_include();
    if (kind == Kind::image) return state_.blue = other(state_.blue, 200), write_image_file();
    if (kind == Kind::preset) return state_.level = other(state_.level, 100), write_preset();
    if (kind == Kind::tweak)
        state_.shift = other(state_.shift, 100);
    else
        state_.red = other(state_.red, 100);
    if (kind == Kind::heavier) state_.work = 1 + static_cast<int>(random_() % 400);
    const std::string all = text();
    if (kind == Kind::rename) {
        write(folder_.path() / ".scene.frag.new", all);
        fs::rename(folder_.path() / ".scene.frag.new", scene());
    } else if (kind == Kind::chunks) {
        write(scene(), "");
        std::ofstream out(scene(), std::ios::binary | std::ios::app);
        out << all.substr(0, all.size() / 2) << std::flush << all.substr(all.size() / 2);
    } else {
        if (kind == Kind::remove) fs::remove(scene());
        write(scene(), all);
    }
}

// What comes after a typo is a good text, so that the picture moves again.
void Soak::save(std::size_t number) {
    static Kind before = Kind::edit;
    Kind kind = kKinds[random_() % kKinds.size()];
    if (before == Kind::typo && (kind == Kind::typo || kind == Kind::include ||
                                 kind == Kind::image || kind == Kind::preset))
        kind = Kind::edit;
    before = kind;
    errors_.forget();
    const auto start = Clock::now();
    change(kind);
    const bool seen = kind == Kind::typo
                          ? eventually([&] { return errors_.says("error: "); }, kPatience)
                          : is_shown();
    const auto index = static_cast<std::size_t>(kind);
    ms_[index].push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    if (!seen) {
        ++lost_[index];
        fmt::print("save {} ({}) was not shown within {:g} s\n", number, kNames[index], kPatience);
    }
    if (!glint_->runs()) {
        fmt::print("glint has ended at save {}\n{}", number, glint_->errors());
        std::exit(1);
    }
}

void Soak::print(std::size_t saves) {
    const auto heap = [&](pid_t process) {
        return std::strtod(read(folder_.path() / "heap" / std::to_string(process)).c_str(),
                           nullptr) /
               (1 << 20);
    };
    const auto children = glint_->children();
    const pid_t trial = children.empty() ? 0 : children.front();
    for (const pid_t child : children) trials_.insert(child);
    fmt::print(
        "{:6} saves   glint: heap {:6.1f} MiB, resident {:6.1f}   trial: heap {:6.1f}, "
        "resident {:6.1f} (processes so far: {})\n",
        saves, heap(glint_->id()), mib_of(glint_->id(), "VmRSS"), heap(trial),
        mib_of(trial, "VmRSS"), trials_.size());
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
        auto& ms = ms_[i];
        std::sort(ms.begin(), ms.end());
        if (ms.empty()) continue;
        fmt::print("    {:8} {:5} saves, {} lost   median {:7.1f} ms   p95 {:7.1f}   max {:7.1f}\n",
                   kNames[i], ms.size(), lost_[i], ms[ms.size() / 2],
                   ms[(ms.size() - 1) * 95 / 100], ms.back());
        ms.clear();
        lost_[i] = 0;
    }
    std::fflush(stdout);
}

}  // namespace
}  // namespace glint::window

int main(int argc, char** argv) {
    const auto count = static_cast<std::size_t>(argc > 1 ? std::atol(argv[1]) : 10'000);
    const auto every = static_cast<std::size_t>(argc > 2 ? std::atol(argv[2]) : 1000);
    glint::window::Soak soak;
    for (std::size_t i = 1; i <= count; ++i) {
        soak.save(i);
        if (i % std::max<std::size_t>(every, 1) == 0 || i == count) soak.print(i);
    }
    return 0;
}
