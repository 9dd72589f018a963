// An input file that takes as long as it likes: a lease on it, as a file server has them, keeps
// glint's reading thread waiting until the test gives it up.
#include "live.h"
#include "media/image.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

namespace glint::window::slow_input_test {
namespace {

void write_picture(const fs::path& file, const Colour& colour) {
    const auto byte = [](int value) { return static_cast<std::byte>(value); };
    write_image(file, {.size = {1, 1},
                       .channels = 3,
                       .type = ChannelType::u8,
                       .pixels = {byte(colour.r), byte(colour.g), byte(colour.b)}});
}

class Lease {
public:
    explicit Lease(const fs::path& file) : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
        ::signal(SIGIO, SIG_IGN);  // as which the system asks for it
        holds_ = ::fcntl(descriptor_, F_SETLEASE, F_WRLCK) == 0;
    }
    ~Lease() { ::close(descriptor_); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    bool holds() const { return holds_; }
    // Whether somebody has asked for the file and waits.
    bool is_wanted() const {
        return eventually([&] { return ::fcntl(descriptor_, F_GETLEASE) != F_WRLCK; });
    }
    void give_up() { ::fcntl(descriptor_, F_SETLEASE, F_UNLCK); }

private:
    int descriptor_;
    bool holds_ = false;
};

// Red and green are the text's own, blue is the picture's.
std::string text_of(int red) {
    return "uniform sampler2D paint; //@ image paint.png\n"
           "void mainImage(out vec4 c, in vec2 p) {\n"
           "    c = vec4(" +
           std::to_string(red) + ".0 / 255.0, 0.2, texture(paint, p / iResolution.xy).b, 1);\n}\n";
}

constexpr glm::ivec2 kMargin{3, 300};  // the border that no panel covers

class SlowInput : public Window {
protected:
    fs::path picture() const { return folder_->path() / "paint.png"; }

    void hold() {
        lease_ = std::make_unique<Lease>(picture());
        if (!lease_->holds()) GTEST_SKIP() << "no leases on the file system of " << picture();
    }

    std::unique_ptr<Lease> lease_;
};

TEST_F(SlowInput, SavesAreShownAndPanelsLiveWhileItIsRead) {
    write_picture(picture(), {0, 0, 200});
    hold();
    open(text_of(10));
    ASSERT_TRUE(lease_->is_wanted());
    EXPECT_TRUE(shows({10, 51, 0}, kMargin)) << "what is not there yet reads 0";
    write(scene(), text_of(40));
    EXPECT_TRUE(shows({40, 51, 0}, kMargin));
    const auto panels = [&] { return screen_->picture({0, 0}, {1280, 720}); };
    const auto shown = panels();
    screen_->tap("Tab");  // hides them
    EXPECT_TRUE(eventually([&] { return panels() != shown; }));
    write(scene(), text_of(50));
    EXPECT_TRUE(shows({50, 51, 0}, kMargin));
    lease_->give_up();
    EXPECT_TRUE(shows({50, 51, 200}, kMargin));
    EXPECT_TRUE(glint_->says("paint.png: shown")) << glint_->errors();
}

// 24 MiB: its rows go to the driver between frames. Whether they all arrived, and none twice, the
// sum of the first and the last row tells: blue is 100 in the lower half and 200 in the upper.
TEST_F(SlowInput, ALargePictureIsShownOnceAllOfItIsThere) {
    constexpr glm::ivec2 kSize(4096, 2048);
    Image image{.size = kSize, .channels = 3, .type = ChannelType::u8, .pixels = {}};
    image.pixels.resize(std::size_t{3} * 4096 * 2048);
    for (std::size_t i = 2; i < image.pixels.size(); i += 3)
        image.pixels[i] = static_cast<std::byte>(i < image.pixels.size() / 2 ? 100 : 200);
    write_image(picture(), image);
    open(
        "uniform sampler2D paint; //@ image paint.png filter=mipmap\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float low = texelFetch(paint, ivec2(p.x, 1023), 0).b;\n"
        "    float high = texelFetch(paint, ivec2(p.x / 16.0, 64), 4).b;\n"
        "    float ends = texelFetch(paint, ivec2(4095, 0), 0).b - texelFetch(paint, ivec2(0, "
        "2047), "
        "0).b;\n"
        "    c = vec4(low, high, abs(ends), 1);\n}\n");
    EXPECT_TRUE(shows({100, 200, 100}, kMargin)) << glint_->errors();
    const fs::path beside = folder_->path() / "beside.png";
    for (std::byte& value : image.pixels) value = value == std::byte{100} ? std::byte{50} : value;
    write_image(beside, image);
    fs::rename(beside, picture());
    EXPECT_TRUE(shows({50, 200, 150}, kMargin)) << glint_->errors();
    EXPECT_EQ(glint_->count("error"), 0) << glint_->errors();
}

TEST_F(SlowInput, ThePictureBeforeStaysUntilTheNewOneIsThereAndTheLastOneStays) {
    write_picture(picture(), {0, 0, 100});
    open(text_of(10));
    ASSERT_TRUE(shows({10, 51, 100}, kMargin)) << glint_->errors();
    const fs::path beside = folder_->path() / "beside.png";
    write_picture(beside, {0, 0, 150});
    fs::rename(beside, picture());
    hold();
    write(scene(), text_of(20));
    EXPECT_TRUE(shows({20, 51, 100}, kMargin) || shows({20, 51, 150}, kMargin, 0.0));
    write_picture(beside, {0, 0, 250});
    fs::rename(beside, picture());
    lease_->give_up();
    EXPECT_TRUE(shows({20, 51, 250}, kMargin));
    EXPECT_EQ(glint_->count("error"), 0) << glint_->errors();
}

TEST_F(SlowInput, TheWindowClosesWhileItIsRead) {
    write_picture(picture(), {0, 0, 200});
    hold();
    open(text_of(10));
    ASSERT_TRUE(lease_->is_wanted());
    screen_->tap("Control_L+q");
    const Glint::End end = glint_->wait(40.0);  // the lease would be taken away after 45
    EXPECT_EQ(end.code, 0);
    EXPECT_EQ(end.signal, 0);
}

TEST_F(SlowInput, ASimulationBeginsAgainWithWhatItBeganWithout) {
    write_picture(picture(), {0, 0, 200});
    hold();
    open(
        "uniform sampler2D paint; //@ image paint.png\n"
        "uniform sampler2D kept; //@ pass mainKept\n"
        "void mainKept(out vec4 c, in vec2 p) {\n"
        "    c = iFrame == 0 ? texture(paint, vec2(0)) : texelFetch(kept, ivec2(p), 0);\n"
        "}\n"
        "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(kept, ivec2(p), 0); c.a = 1.0; "
        "}\n");
    ASSERT_TRUE(lease_->is_wanted());
    ASSERT_TRUE(shows({0, 0, 0}, kMargin));
    lease_->give_up();
    EXPECT_TRUE(shows({0, 0, 200}, kMargin));
}

TEST_F(SlowInput, APipeInItsPlaceIsToldAndTheNextSaveIsShown) {
    write_picture(picture(), {0, 0, 200});
    open(text_of(10));
    ASSERT_TRUE(shows({10, 51, 200}, kMargin));
    fs::remove(picture());
    ASSERT_EQ(::mkfifo(picture().c_str(), 0600), 0);
    ASSERT_TRUE(glint_->says("it is not a regular file (a pipe)")) << glint_->errors();
    EXPECT_TRUE(shows({10, 51, 200}, kMargin)) << "what was read before stays";
    write(scene(), text_of(30));
    EXPECT_TRUE(shows({30, 51, 200}, kMargin));
    fs::remove(scene());
    ASSERT_EQ(::mkfifo(scene().c_str(), 0600), 0);
    ASSERT_TRUE(glint_->says("scene.frag: error: cannot read")) << glint_->errors();
    fs::remove(scene());
    fs::remove(picture());
    write_picture(picture(), {0, 0, 100});
    write(scene(), text_of(60));
    EXPECT_TRUE(shows({60, 51, 100}, kMargin)) << glint_->errors();
}

}  // namespace
}  // namespace glint::window::slow_input_test
