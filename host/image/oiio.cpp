// Finds and loads glint-oiio.so on another thread, and speaks with it.
//
// OpenImageIO pulls in some 260 shared libraries, 0.2 s of work for the dynamic linker. A program
// that only writes PNG never pays it; any other loads them while the GPU draws.
#include "image/codecs.h"
#include "image/module.h"
#include "image/oiio_module.h"

#include <array>
#include <cerrno>
#include <exception>
#include <future>
#include <string>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

struct Module {
    GlintOiioBegin* begin = nullptr;
    GlintOiioWrite* write = nullptr;
    GlintOiioEnd* end = nullptr;
    GlintOiioRead* read = nullptr;
};

Module load_module() {
    void* module = open_module("glint-oiio.so", "image");
    return {.begin = find_function<GlintOiioBegin>(module, "glint_oiio_begin"),
            .write = find_function<GlintOiioWrite>(module, "glint_oiio_write"),
            .end = find_function<GlintOiioEnd>(module, "glint_oiio_end"),
            .read = find_function<GlintOiioRead>(module, "glint_oiio_read")};
}

// The dynamic linker loads a library once a process; so does this. At exit it is waited for.
std::shared_future<Module> module_loading() {
    static const std::shared_future<Module> loading =
        std::async(std::launch::async, load_module).share();
    return loading;
}

// What the module asks for room, and what went wrong while it did.
struct Room {
    const fs::path& file;
    Image image;
    std::exception_ptr refusal;
};

void* allocate(void* user, const GlintOiioPicture* picture) {
    Room& room = *static_cast<Room*>(user);
    try {
        room.image = make_image(room.file, {picture->width, picture->height}, picture->channels,
                                picture->is_float ? ChannelType::f32 : ChannelType::u8);
        return room.image.pixels.data();
    } catch (...) {
        room.refusal = std::current_exception();
        return nullptr;
    }
}

GlintOiioPicture picture_of(const Image& image) {
    return {.width = image.size.x,
            .height = image.size.y,
            .channels = image.channels,
            .is_float = image.type == ChannelType::f32,
            .pixels = const_cast<std::byte*>(image.pixels.data())};
}

class OiioEncoder final : public BandEncoder {
public:
    OiioEncoder(TemporaryFile& out, const fs::path& file, const char* codec, const Image& shape,
                const Metadata& metadata, const FileFormat& format)
        : out_(out), file_(file), module_(module_loading().get()) {
        const GlintOiioFormat chosen{.codec = codec,
                                     .compression = format.compression.c_str(),
                                     .half = format.values == "half",
                                     .quality = format.quality,
                                     .tile = format.tiled ? kFileTile : 0};
        const GlintOiioPicture picture = picture_of(shape);
        std::vector<GlintOiioText> texts;
        for (const auto& [name, value] : metadata) texts.push_back({name.c_str(), value.c_str()});
        open_ = module_.begin(out.descriptor(), &chosen, &picture, texts.data(), texts.size(),
                              &error_, cause_.data(), cause_.size());
        if (!open_) refuse();
    }
    ~OiioEncoder() override {
        if (open_) module_.end(open_, &error_, cause_.data(), cause_.size());
    }
    OiioEncoder(const OiioEncoder&) = delete;
    OiioEncoder& operator=(const OiioEncoder&) = delete;

    void write(const Image& band) override {
        const GlintOiioPicture picture = picture_of(band);
        if (!open_) return;
        if (!module_.write(open_, &picture, &error_, cause_.data(), cause_.size())) refuse();
    }
    void finish() override {
        if (!open_) return;
        void* const open = std::exchange(open_, nullptr);
        if (!module_.end(open, &error_, cause_.data(), cause_.size())) refuse();
    }

private:
    // What the system refused is told by commit(), in its own words.
    void refuse() {
        if (error_ == 0) throw cannot_write(file_, cause_.data());
        out_.fail(error_);
        if (open_)
            module_.end(std::exchange(open_, nullptr), &error_, cause_.data(), cause_.size());
        out_.commit();
    }

    TemporaryFile& out_;
    fs::path file_;
    Module module_;
    void* open_ = nullptr;
    int error_ = 0;
    std::array<char, 512> cause_{};
};

}  // namespace

void prepare_oiio() {
    module_loading();
}

std::unique_ptr<BandEncoder> encode_by_oiio(TemporaryFile& out, const fs::path& file,
                                            const char* codec, const Image& shape,
                                            const Metadata& metadata, const FileFormat& format) {
    return std::make_unique<OiioEncoder>(out, file, codec, shape, metadata, format);
}

Image read_by_oiio(const fs::path& file, const char* format) {
    Room room{.file = file, .image = {}, .refusal = {}};
    GlintOiioPicture picture{};
    std::array<char, 512> cause{};
    if (module_loading().get().read(file.c_str(), format, &picture, allocate, &room, cause.data(),
                                    cause.size())) {
        return std::move(room.image);
    }
    if (room.refusal) std::rethrow_exception(room.refusal);
    throw cannot_read(file, cause[0] ? cause.data() : "The picture is damaged");
}

}  // namespace glint
