#include "media/film.h"

#include "base/canonical_name.h"
#include "base/launch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

// sRGB pictures as BT.709 video, which is what players expect.
constexpr std::string_view kToVideo =
    "-vf scale=in_range=full:out_range=limited:out_color_matrix=bt709,"
    "setparams=colorspace=bt709:color_primaries=bt709:color_trc=bt709";

// A palette for each frame: one for all would keep all in memory until the last.
constexpr std::string_view kToPalettes =
    "-vf split[a][b];[a]palettegen=stats_mode=single[p];"
    "[b][p]paletteuse=new=1:dither=sierra2_4a";

// How FFmpeg is to filter and encode, by the film's extension.
struct Kind {
    std::string_view extension, filter, codec, sound_codec, format;
    int largest_side;             // pixels
    std::size_t bytes_per_pixel;  // of FFmpeg's memory: measured at 0.9 and 67 megapixels
    double most_fps = std::numeric_limits<double>::infinity();  // that players show
};

// By default as many as there are processors, and with another number these encoders write other
// bytes. x264 takes 150 bytes of memory a pixel with eight, and 200 with sixteen.
constexpr int kEncoderThreads = 8;

constexpr double kMostGifFps = 50.0;  // what is shorter is shown for 1/10 s

constexpr Kind kKinds[] = {
    {".mp4", kToVideo, "-c:v libx264 -preset medium -crf 16 -pix_fmt yuv420p -movflags +faststart",
     "-c:a aac -b:a 256k", "-f mp4", 16384, 170},
    {".webm", kToVideo,
     "-c:v libvpx-vp9 -crf 24 -b:v 0 -row-mt 1 -deadline good -cpu-used 4 -pix_fmt yuv420p",
     "-c:a libopus -b:a 192k", "-f webm", 16384, 170},
    {".mov", kToVideo, "-c:v prores_ks -profile:v 3 -pix_fmt yuv422p10le", "-c:a pcm_s16le",
     "-f mov", 65535, 20},
    {".gif", kToPalettes, "", "", "-f gif", 65535, 65, kMostGifFps},
};

const Kind* kind_of(const fs::path& file) {
    const auto* found = std::ranges::find(kKinds, ending_of(file), &Kind::extension);
    return found == std::end(kKinds) ? nullptr : found;
}

// Odd sides get one more pixel, the same as the last, since colour is kept for squares of four.
std::string filter_of(const Kind& kind, glm::ivec2 size, glm::ivec2 kept) {
    const glm::ivec2 more = kept - size;
    if (more == glm::ivec2(0)) return std::string(kind.filter);
    return fmt::format("-vf pad={}:{},format=gbrp,fillborders=right={}:bottom={}:mode=smear,{}",
                       kept.x, kept.y, more.x, more.y, kind.filter.substr(4));
}

// The output has no name yet; FFmpeg opens it, to seek in and read back, through ours.
std::vector<std::string> command_line(const fs::path& file, int out, glm::ivec2 size, double fps,
                                      const TemporaryFile* sound) {
    const Kind& kind = *kind_of(file);
    // Without -xerror a webm that a full disk cut short counts as done.
    std::istringstream line(
        fmt::format("ffmpeg -hide_banner -loglevel error -nostdin -xerror "
                    "-f rawvideo -pixel_format rgb24 -video_size {}x{} -framerate {} -i pipe:0 {} "
                    "{} {} -threads {} {} {} -fflags +bitexact -flags:a +bitexact -flags:v "
                    "+bitexact -y /proc/{}/fd/{}",
                    size.x, size.y, std::min(fps, kind.most_fps),
                    sound ? fmt::format("-i /proc/{}/fd/{}", getpid(), sound->descriptor()) : "",
                    filter_of(kind, size, size_in_film(file, size)), kind.codec, kEncoderThreads,
                    sound ? kind.sound_codec : "", kind.format, getpid(), out));
    return {std::istream_iterator<std::string>(line), {}};
}

}  // namespace

bool is_film(const fs::path& file) {
    return kind_of(file) != nullptr;
}

bool has_sound(const fs::path& file) {
    const Kind* kind = kind_of(file);
    return kind && !kind->sound_codec.empty();
}

std::string size_refusal_of_film(const fs::path& file, glm::ivec2 size) {
    const Kind& kind = *kind_of(file);
    constexpr double kMostPixels = 268'435'455.0;  // FFmpeg's own, with 128 more on each side
    const double pixels = (size.x + 128.0) * (size.y + 128.0);
    if (std::max(size.x, size.y) <= kind.largest_side && pixels < kMostPixels) return "";
    return fmt::format(
        "{}: A {} film of {}x{} pixels cannot be: a side has at most {}, and all together 268 "
        "million. Make the picture smaller with --size.",
        file.string(), kind.extension, size.x, size.y, kind.largest_side);
}

glm::ivec2 size_in_film(const fs::path& file, glm::ivec2 size) {
    return kind_of(file)->filter == kToVideo ? (size + 1) / 2 * 2 : size;
}

std::size_t film_encoder_bytes(const fs::path& file, glm::ivec2 size) {
    constexpr std::size_t kProgram = std::size_t{64} << 20;
    return kProgram + static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                          kind_of(file)->bytes_per_pixel;
}

std::vector<std::byte> raw_frame(const Image& image) {
    const auto row = static_cast<std::size_t>(image.size.x) * 3;
    const auto rows = static_cast<std::size_t>(image.size.y);
    std::vector<std::byte> raw(row * rows);
    for (std::size_t y = 0; y < rows; ++y) {
        std::memcpy(raw.data() + y * row, image.pixels.data() + (rows - 1 - y) * row, row);
    }
    return raw;
}

void write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw std::system_error(errno, std::generic_category());
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

Film::Film(const fs::path& file, glm::ivec2 size, double fps, std::unique_ptr<TemporaryFile> sound)
    : file_(file),
      frames_shown_(std::min(kind_of(file)->most_fps / fps, 1.0)),
      sound_(std::move(sound)),
      out_(file) {
    errors_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
    const Launched ffmpeg =
        launch({.words = command_line(file, out_.descriptor(), size, fps, sound_.get()),
                .input = kPipe,
                .output = errors_,
                .messages = errors_});
    process_ = ffmpeg.process;
    input_ = ffmpeg.pipe;
    if (ffmpeg.error == 0) {
        ::fcntl(input_, F_SETPIPE_SZ, 1 << 20);
        return;
    }
    ::close(errors_);
    throw cannot_write(file_,
                       ffmpeg.error == ENOENT
                           ? "There is no ffmpeg, which encodes films; install it"
                           : fmt::format("FFmpeg does not start: {}", std::strerror(ffmpeg.error)));
}

Film::~Film() {
    if (input_ >= 0) ::close(input_);
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        wait_for(process_);
    }
    ::close(errors_);
}

// Closes FFmpeg's input and waits until it has ended; its exit code, or minus a signal.
int Film::end() {
    if (input_ >= 0) ::close(std::exchange(input_, -1));
    return wait_for(std::exchange(process_, 0));
}

std::runtime_error Film::failure() const {
    std::array<char, 1000> text{};
    const ssize_t length = ::pread(errors_, text.data(), text.size(), 0);
    std::string words(text.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
    words.resize(std::min(words.find('\n'), words.size()));
    return cannot_write(file_, words.empty() ? "FFmpeg gave up" : "FFmpeg says: " + words);
}

void Film::write(const Image& image) {
    const auto shown_before = [this](std::int64_t frame) {
        return std::ceil(static_cast<double>(frame) * frames_shown_);
    };
    const std::int64_t frame = frames_++;
    if (shown_before(frame + 1) == shown_before(frame)) return;
    try {
        write_all(input_, raw_frame(image));
    } catch (const std::system_error&) {
        end();
        throw failure();
    }
}

void Film::finish() {
    const int code = end();
    struct stat facts {};
    const bool is_empty = ::fstat(out_.descriptor(), &facts) != 0 || facts.st_size == 0;
    if (code != 0 || is_empty) throw failure();
    out_.commit();
}

}  // namespace glint
