#include "offline/sequence_output.h"

#include "base/readable_file.h"
#include "base/say.h"
#include "offline/picture.h"
#include "render/room.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>
#include <thread>

namespace glint {
namespace {

// Pictures are files of their own and may overtake each other; a stream may not.
int threads_for(Target target) {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    return target == Target::pictures ? std::clamp(cores, 1, 16) : 1;
}

}  // namespace

std::string Making::of(int frame) const {
    return fmt::format("{}-{}-{};", inputs, frame, drawer);
}

// Pictures tell of their making before their pixels.
bool is_made_from(const std::filesystem::path& file, const std::string& making) {
    try {
        std::string head(64 * 1024, '\0');
        head.resize(ReadableFile(file).read(head, 0));
        if (head.find(making) == std::string::npos) return false;
        read_image(file);
        return true;
    } catch (const std::runtime_error&) {
        return false;  // not there, no picture, or cut short by somebody else
    }
}

void write_to_stdout(const Image& image) {
    try {
        write_all(STDOUT_FILENO, raw_frame(image));
    } catch (const std::system_error& error) {
        result_error() = error.code().value();
        throw std::runtime_error("Cannot write to stdout: " + error.code().message() + ".");
    }
}

SequenceOutput::SequenceOutput(const SequenceOptions& options, Target target, const Preset& preset,
                               std::string gpu, Making making)
    : options_(options),
      target_(target),
      preset_(preset),
      gpu_(std::move(gpu)),
      making_(std::move(making)),
      name_(numbered_name(options.output)),
      workers_(threads_for(target)) {}

void SequenceOutput::begin_film(std::unique_ptr<TemporaryFile> sound) {
    film_.emplace(options_.output, preset_.size, options_.fps, std::move(sound));
}

std::size_t SequenceOutput::pictures_in_memory() const {
    const auto pixels =
        static_cast<std::size_t>(preset_.size.x) * static_cast<std::size_t>(preset_.size.y);
    const Image shape{.size = preset_.size,
                      .channels = 3,
                      .type = floats() ? ChannelType::f32 : ChannelType::u8,
                      .pixels = {}};
    std::vector<WantedMemory> wanted = {
        {"a picture on its way to its file", pixels * (floats() ? 16 : 4)}};
    std::size_t once = 0;
    if (target_ == Target::pictures)
        wanted.push_back({"its encoder", encoder_bytes(options_.output, shape)});
    else
        wanted.push_back({"its copy for the film", pixels * 3});
    const std::size_t one = wanted[0].bytes + wanted[1].bytes;
    if (target_ == Target::film) {
        once = film_encoder_bytes(options_.output, preset_.size);
        wanted.push_back({"FFmpeg", once});
    }
    require_memory(wanted, "Make the pictures smaller with --size.");
    const std::size_t free = free_memory();
    return std::max<std::size_t>((free - std::min(free, once)) / one, 1);
}

bool SequenceOutput::has(int frame) {
    if (!options_.resume || !name_) return false;
    wait_for_room();
    return is_made_from(name_->name(frame), making_.of(frame));
}

void SequenceOutput::write(const Frame& frame, std::vector<std::byte> rgba) {
    workers_.run(
        [this, frame, rgba = std::move(rgba)]() mutable { encode(frame, std::move(rgba)); });
}

void SequenceOutput::finish() {
    wait();
    if (film_) film_->finish();
}

void SequenceOutput::encode(const Frame& frame, std::vector<std::byte> rgba) {
    const Image image = picture_without_alpha(std::move(rgba), preset_.size,
                                              floats() ? ChannelType::f32 : ChannelType::u8);
    if (target_ == Target::film) return film_->write(image);
    if (target_ == Target::raw) return write_to_stdout(image);
    Metadata metadata = metadata_of(options_, preset_, frame, gpu_);
    // Before what may be long: the head of a file is read for it.
    metadata.emplace(metadata.begin(), "glint:inputs", making_.of(frame.frame));
    write_image(name_->name(frame.frame), image, metadata, options_.format);
}

}  // namespace glint
