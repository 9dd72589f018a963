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

namespace glint {
namespace {

namespace fs = std::filesystem;

struct Module {
    GlintOiioWrite* write = nullptr;
    GlintOiioRead* read = nullptr;
};

Module load_module() {
    void* module = open_module("glint-oiio.so", "image");
    return {.write = find_function<GlintOiioWrite>(module, "glint_oiio_write"),
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

}  // namespace

void prepare_oiio() {
    module_loading();
}

void write_by_oiio(TemporaryFile& out, const fs::path& file, const char* format, const Image& image,
                   const Metadata& metadata) {
    const GlintOiioPicture picture{.width = image.size.x,
                                   .height = image.size.y,
                                   .channels = image.channels,
                                   .is_float = image.type == ChannelType::f32,
                                   .pixels = const_cast<std::byte*>(image.pixels.data())};
    std::vector<GlintOiioText> texts;
    for (const auto& [name, value] : metadata) texts.push_back({name.c_str(), value.c_str()});

    std::array<char, 512> cause{};
    int error = 0;
    if (module_loading().get().write(out.descriptor(), format, &picture, texts.data(), texts.size(),
                                     &error, cause.data(), cause.size())) {
        return;
    }
    if (error == 0) throw cannot_write(file, cause.data());
    out.fail(error);
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
