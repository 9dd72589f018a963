// A still that is stopped half-way leaves everything as it was.
#include "command.h"
#include "media/image.h"

#include <thread>

namespace glint::cli::interrupted_test {
namespace {

using namespace std::chrono_literals;

class Interrupted : public InAFolder {
protected:
    Interrupted() {
        // Hard to compress, and hard to draw.
        write("scene.frag",
              "void mainImage(out vec4 c, in vec2 p) {\n"
              "    uvec3 v = uvec3(p, 1);\n"
              "    for (int i = 0; i < 40; ++i) {\n"
              "        v = v * 1664525u + 1013904223u; v.x += v.y * v.z; v.y += v.z * v.x; v.z += "
              "v.x * "
              "v.y; v ^= v >> 16u;\n"
              "    }\n"
              "    c = vec4(vec3(v >> 8u) / 16777216.0, 1);\n"
              "}\n");
    }
};

// Whether the process holds an open file in this folder, of so many bytes at least: it has begun to
// write its picture.
bool writes_into(pid_t process, const fs::path& folder, std::uintmax_t bytes = 0) {
    std::error_code error;
    const fs::path open_files = "/proc/" + std::to_string(process) + "/fd";
    for (fs::directory_iterator entry(open_files, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code gone;
        if (fs::read_symlink(entry->path(), gone).string().starts_with(folder.string())) {
            return fs::file_size(entry->path(), gone) >= bytes && !gone;
        }
    }
    return false;
}

TEST_F(Interrupted, WhileItDrawsItLeavesTheOldPictureAlone) {
    for (const int signal : {SIGTERM, SIGINT, SIGKILL, SIGHUP}) {
        SCOPED_TRACE(signal);
        write("out.png", "precious");
        const auto before = names();
        Process process(command(
            {"still", "scene.frag", "-o", "out.png", "--size", "640x360", "--samples", "4096"}));
        std::this_thread::sleep_for(400ms);
        ASSERT_TRUE(process.runs()) << process.wait().err;
        process.signal(signal);
        const Outcome outcome = process.wait();
        EXPECT_FALSE(outcome.timed_out);
        EXPECT_EQ(outcome.signal, signal);
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(bytes("out.png"), "precious");
        EXPECT_EQ(names(), before);
    }
}

TEST_F(Interrupted, WhileItWritesItLeavesNoHalfPicture) {
    for (const std::string name : {"out.png", "out.exr"}) {
        for (const int signal : {SIGTERM, SIGKILL}) {
            SCOPED_TRACE(name);
            bool was_cut = false;  // or the picture was whole before the signal came
            for (int i = 0; i < 20 && !was_cut; ++i) {
                write(name, "precious");
                const auto before = names();
                Process process(
                    command({"still", "scene.frag", "-o", name, "--size", "2048x1024"}));
                while (process.runs() && !writes_into(process.id(), folder())) {
                    std::this_thread::sleep_for(1ms);
                }
                process.signal(signal);
                const Outcome outcome = process.wait();
                was_cut = outcome.signal == signal;
                if (was_cut) {
                    EXPECT_EQ(bytes(name), "precious");
                } else {
                    EXPECT_EQ(read_image(folder() / name).size, glm::ivec2(2048, 1024));
                }
                EXPECT_EQ(names(), before);
            }
            EXPECT_TRUE(was_cut);
        }
    }
}

// A huge picture is written in bands while the next are drawn; tiles make a small one do the same.
TEST_F(Interrupted, BetweenTheBandsOfAPictureItLeavesNoHalfPicture) {
    for (const std::string name : {"out.png", "out.exr", "out.tif"}) {
        for (const int signal : {SIGINT, SIGKILL}) {
            SCOPED_TRACE(name);
            write(name, "precious");
            const auto before = names();
            Process process(command({"still", "scene.frag", "-o", name, "--size", "512x16384",
                                     "--tile", "64", "--samples", "64"}));
            while (process.runs() && !writes_into(process.id(), folder(), 100'000)) {
                std::this_thread::sleep_for(1ms);
            }
            process.signal(signal);
            EXPECT_EQ(process.wait().signal, signal);
            EXPECT_EQ(bytes(name), "precious");
            EXPECT_EQ(names(), before);
        }
    }
}

TEST_F(Interrupted, AFolderThatVanishesMeanwhileIsAFailure) {
    fs::create_directory(folder() / "gone");
    const auto expect_failure = [&](std::vector<std::string> words) {
        Process process(command(std::move(words)));
        while (process.runs() && !writes_into(process.id(), folder() / "gone")) {
            std::this_thread::sleep_for(1ms);
        }
        fs::remove_all(folder() / "gone");
        const Outcome outcome = process.wait();
        EXPECT_EQ(outcome.code, 1);
        EXPECT_TRUE(outcome.err.starts_with("error: Cannot write gone/")) << outcome.err;
        EXPECT_NE(outcome.err.find("No such file or directory"), std::string::npos) << outcome.err;
        EXPECT_EQ(names(), std::set<std::string>{"scene.frag"});
        fs::create_directory(folder() / "gone");
    };
    for (const std::string name : {"gone/out.png", "gone/out.exr"}) {
        expect_failure({"still", "scene.frag", "-o", name, "--size", "512x4096", "--tile", "64",
                        "--samples", "4"});
    }
    expect_failure(
        {"sequence", "scene.frag", "-o", "gone/film.mp4", "--frames", "0:99", "--size", "256x144"});
}

TEST_F(Interrupted, CtrlCEndsALongSimulationAtOnce) {
    write("count.frag",
          "uniform sampler2D count; //@ pass mainCount\n"
          "void mainCount(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(p), 0) + 1.0; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(p), 0); }\n");
    Process process(command({"still", "count.frag", "-o", "out.png", "--time", "1e6"}));
    std::this_thread::sleep_for(400ms);
    ASSERT_TRUE(process.runs());
    process.signal(SIGINT);
    EXPECT_EQ(process.wait().signal, SIGINT);
    EXPECT_EQ(names(), (std::set<std::string>{"count.frag", "scene.frag"}));
}

}  // namespace
}  // namespace glint::cli::interrupted_test
