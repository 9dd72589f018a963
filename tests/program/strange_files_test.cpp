// A file that is named to be read and is none: a pipe, a device, a hole of 20 GB. Glint says which,
// and waits for nothing.
#include "command.h"

#include <sys/stat.h>

namespace glint::cli::strange_files_test {
namespace {

class StrangeFiles : public InAFolder {
protected:
    StrangeFiles() {
        if (::mkfifo((folder() / "pipe").c_str(), 0600) != 0) throw std::runtime_error("no pipe");
        write("good.frag", kGradient);
    }

    // It must end by itself, with exit code 4 and these words.
    void expect_refused(std::vector<std::string> arguments, const std::string& words) const {
        const std::string what = arguments[0] + " " + arguments[1];
        SCOPED_TRACE(what + ", " + words);
        Command call = command(std::move(arguments));
        call.limit = std::chrono::seconds(20);  // it takes 0.1 s, or never ends
        const Outcome outcome = run(call);
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(folder() / "out.png"));
    }

    void expect_still_refused(const std::string& file, const std::string& words) const {
        expect_refused({"still", file, "-o", "out.png", "--size", "64x36"}, words);
    }

    // A scene that reads a file through one sampler.
    void write_reader(const char* type, const std::string& source) const {
        const bool flat = std::string_view(type) == "sampler2D";
        write("reader.frag", std::string("uniform ") + type + " s; //@ " + source +
                                 "\nvoid mainImage(out vec4 c, in vec2 p) { c = texture(s, " +
                                 (flat ? "p" : "vec3(p, 1.0)") + "); }\n");
    }

    // Takes no room on the disk.
    void write_hole(const char* name, std::string_view head = "") const {
        write(name, head);
        fs::resize_file(folder() / name, std::uintmax_t{20} << 30);
    }
};

constexpr const char* kPipe = "it is not a regular file (a pipe)";
constexpr const char* kDevice = "it is not a regular file (a device)";

TEST_F(StrangeFiles, APipeOrADeviceInPlaceOfATextIsRefused) {
    fs::create_symlink("pipe", folder() / "pipe.frag");
    fs::create_symlink("/dev/zero", folder() / "zero.frag");
    fs::create_symlink("pipe", folder() / "pipe.toml");
    fs::create_symlink("/dev/zero", folder() / "pipe.json");
    fs::create_directory(folder() / "tabs");
    fs::create_symlink("../pipe", folder() / "tabs/image.glsl");
    write("includes.frag", "#include \"pipe\"\n" + std::string(kGradient));
    write("of_pipe.toml", "scene = \"pipe\"\n");
    write("foreign.frag", "#iChannel0 \"file://pipe.frag\"\n" + std::string(kGradient));
    expect_still_refused("pipe.frag", kPipe);
    expect_still_refused("zero.frag", kDevice);
    expect_still_refused("pipe.toml", kPipe);
    expect_still_refused("of_pipe.toml", kPipe);
    expect_still_refused("includes.frag", std::string("includes.frag:1:1: error: cannot read "
                                                      "'pipe': ") +
                                              kPipe);
    expect_still_refused("foreign.frag", kPipe);
    expect_refused({"import", "pipe.json", "-o", "a.frag"}, kDevice);
    expect_refused({"import", "tabs", "-o", "a.frag", "--anywhere"}, kPipe);
}

TEST_F(StrangeFiles, APipeOrADeviceInPlaceOfAnInputIsRefused) {
    const struct {
        const char *type, *source;
    } inputs[] = {{"sampler2D", "image"},
                  {"samplerCube", "cube"},
                  {"sampler3D", "volume"},
                  {"sampler2D", "sound"}};
    for (const auto& [type, source] : inputs) {
        write_reader(type, source + std::string(" pipe"));
        expect_still_refused("reader.frag", std::string("reader.frag:1:") +
                                                (std::string_view(type) == "sampler2D"   ? "19"
                                                 : std::string_view(type) == "sampler3D" ? "19"
                                                                                         : "21") +
                                                ": error: Cannot read pipe: " + kPipe);
        write_reader(type, source + std::string(" /dev/zero"));
        expect_still_refused("reader.frag", kDevice);
    }
}

TEST_F(StrangeFiles, APipeInPlaceOfAStateOrAPictureIsRefused) {
    fs::create_symlink("pipe", folder() / "state.exr");
    fs::create_symlink("pipe", folder() / "p000.png");
    expect_refused(
        {"still", "good.frag", "-o", "out.png", "--size", "64x36", "--from-state", "state.exr"},
        std::string("Cannot read it: ") + kPipe);
    // The pictures that are there already: this one is not, and its name cannot be given.
    Command resume = command({"sequence", "good.frag", "-o", "p%03d.png", "--frames", "0:0",
                              "--size", "64x36", "--resume"});
    resume.limit = std::chrono::seconds(20);
    const Outcome resumed = run(resume);
    EXPECT_EQ(resumed.code, 1) << resumed.err;
    EXPECT_NE(resumed.err.find("p000.png: It is not a regular file"), std::string::npos)
        << resumed.err;
    EXPECT_TRUE(fs::is_fifo(folder() / "pipe"));
}

TEST_F(StrangeFiles, AHoleOf20GigabytesIsRefusedByItsName) {
    write_hole("hole.frag");
    write_hole("hole.toml");
    write_hole("hole.json");
    write_hole("hole.exr");
    write_hole("zeros");
    write_hole("hole.wav");

    write_hole("hole.jpg", "\xff\xd8\xff\xe0");
    expect_still_refused("hole.frag", "cannot read 'hole.frag': it is larger than 64 MiB");
    expect_still_refused("hole.toml", "cannot read 'hole.toml': it is larger than 64 MiB");
    expect_refused({"import", "hole.json", "-o", "a.frag"}, "it is larger than 64 MiB");
    const std::vector<std::string> from_hole = {"still",  "good.frag", "-o",           "out.png",
                                                "--size", "64x36",     "--from-state", "hole.exr"};
    expect_refused(from_hole, "hole.exr: error: ");  // for its memory, where so much is not free
    fs::resize_file(folder() / "hole.exr", std::uintmax_t{1} << 24);
    expect_refused(from_hole, "hole.exr: error: It is cut short or damaged");
    std::error_code error;
    fs::resize_file(folder() / "hole.exr", std::uintmax_t{1} << 40, error);
    if (!error) {  // the file system takes a terabyte
        expect_refused(from_hole,
                       "hole.exr: error: Cannot read it: it takes 1099511 MB of memory, and ");
    }
    write_reader("sampler2D", "image zeros");
    expect_still_refused("reader.frag", "Cannot read zeros: It is not a png");
    write_reader("sampler2D", "image hole.jpg");
    expect_still_refused("reader.frag",
                         "Cannot read hole.jpg: It is larger than any jpg of 16384 x 16384");
    write_reader("sampler2D", "sound hole.wav");
    expect_still_refused("reader.frag", "Cannot read hole.wav: ");
    write_reader("sampler3D", "volume zeros");
    expect_still_refused("reader.frag", "Cannot read zeros: Its head tells of 0 x 0 x 0 voxels");
}

// A machine that has the room reads it, and takes too long for a test.
TEST_F(StrangeFiles, AVolumeLargerThanTheMemoryIsRefusedByItsName) {
    constexpr std::uintmax_t kBytes = std::uintmax_t{2048} * 2048 * 2048 * 16;
    std::uintmax_t kib = 0;
    std::ifstream meminfo("/proc/meminfo");
    for (std::string word; meminfo >> word && word != "MemAvailable:";) {
    }
    meminfo >> kib;
    if (kib * 1024 > kBytes) GTEST_SKIP() << "this machine has 137 GB of memory";
    write("huge.bin", std::string("BIN\0\0\x08\0\0\0\x08\0\0\0\x08\0\0\4\0\x0a\0", 20));
    std::error_code error;
    fs::resize_file(folder() / "huge.bin", kBytes + 20, error);
    if (error) GTEST_SKIP() << "this file system takes no such file: " << error.message();
    write_reader("sampler3D", "volume huge.bin");
    // Nothing is wrong with the file, so this is no unreadable one.
    const Outcome outcome = glint({"still", "reader.frag", "-o", "out.png", "--size", "64x36"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find(" of memory is needed, "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("huge.bin"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace glint::cli::strange_files_test
