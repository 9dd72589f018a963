// Finds and loads glint-oiio.so on another thread, and speaks with it.
//
// OpenImageIO pulls in some 260 shared libraries, 0.2 s of work for the dynamic linker. A program
// that only writes PNG never pays it; any other loads them while the GPU draws.
#include "base/module.h"
#include "media/codecs.h"
#include "media/oiio_module.h"
#include "media/parts.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <future>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

struct OiioModule {
    GlintOiioBegin* begin = nullptr;
    GlintOiioWrite* write = nullptr;
    GlintOiioEnd* end = nullptr;
    GlintOiioRead* read = nullptr;
    GlintExrWrite* write_parts = nullptr;
    GlintExrRead* read_parts = nullptr;
};

OiioModule load_module() {
    // Of the 260, GDAL and what it needs look up most symbols. Opened by itself it looks for them
    // among its own libraries and not among all: half of the work. Where it is absent, so be it.
    ::dlopen("libgdal.so.32", RTLD_LAZY | RTLD_LOCAL);
    void* module = open_module("glint-oiio.so", "image");
    return {.begin = find_function<GlintOiioBegin>(module, "glint_oiio_begin"),
            .write = find_function<GlintOiioWrite>(module, "glint_oiio_write"),
            .end = find_function<GlintOiioEnd>(module, "glint_oiio_end"),
            .read = find_function<GlintOiioRead>(module, "glint_oiio_read"),
            .write_parts = find_function<GlintExrWrite>(module, "glint_exr_write"),
            .read_parts = find_function<GlintExrRead>(module, "glint_exr_read")};
}

// The dynamic linker loads a library once a process; so does this. At exit it is waited for.
std::shared_future<OiioModule> module_loading() {
    static const std::shared_future<OiioModule> loading =
        std::async(std::launch::async, load_module).share();
    return loading;
}

// What the module asks for room, and what went wrong while it did.
struct Room {
    const fs::path& file;
    bool shape_only;
    Image image;
    std::exception_ptr refusal;
};

void* allocate(void* user, const GlintOiioPicture* picture) {
    Room& room = *static_cast<Room*>(user);
    try {
        room.image = make_shape(room.file, {picture->width, picture->height}, picture->channels,
                                picture->is_float ? ChannelType::f32 : ChannelType::u8);
        if (room.shape_only) return nullptr;
        make_room(room.image);
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

std::vector<GlintOiioText> texts_of(const Metadata& metadata) {
    std::vector<GlintOiioText> texts;
    for (const auto& [name, value] : metadata) texts.push_back({name.c_str(), value.c_str()});
    return texts;
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
        const std::vector<GlintOiioText> texts = texts_of(metadata);
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
        const int step = rows_at_once(band);
        for (int top = band.size.y; top > 0 && open_; top -= step) {
            const int bottom = std::max(top - step, 0);
            GlintOiioPicture rows = picture_of(band);
            rows.height = top - bottom;
            rows.pixels = const_cast<std::byte*>(band.pixels.data()) +
                          bytes_per_row(band) * static_cast<std::size_t>(bottom);
            if (!module_.write(open_, &rows, &error_, cause_.data(), cause_.size())) refuse();
        }
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
    OiioModule module_;
    void* open_ = nullptr;
    int error_ = 0;
    std::array<char, 512> cause_{};
};

// A file without a disk.
class Memory {
public:
    Memory() : descriptor_(::memfd_create("parts", MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "memory");
    }
    ~Memory() { ::close(descriptor_); }
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

    // The limit of files' sizes is that of memory's, too, and what the library writes when it
    // closes a small file fails without a word.
    bool is_cut() const {
        ::rlimit most{};
        ::getrlimit(RLIMIT_FSIZE, &most);
        const ::off_t size = ::lseek(descriptor_, 0, SEEK_END);
        return most.rlim_cur != RLIM_INFINITY && static_cast<::rlim_t>(size) >= most.rlim_cur;
    }

    void copy_to(TemporaryFile& out) const {
        std::vector<std::byte> bytes(std::size_t{1} << 20);
        ::lseek(descriptor_, 0, SEEK_SET);
        for (ssize_t got; (got = ::read(descriptor_, bytes.data(), bytes.size())) > 0;) {
            out.append(std::span(bytes).first(static_cast<std::size_t>(got)));
        }
    }

private:
    int descriptor_;
};

// What the library says of the name that it was given, said of the file's own.
std::string told_of(const fs::path& file, const ReadableFile& in, std::string cause) {
    const std::size_t at = cause.find(in.name());
    if (at != cause.npos) cause.replace(at, in.name().size(), file.string());
    return cause;
}

// Many rooms, and what went wrong in one of them.
struct Rooms {
    const fs::path& file;
    PartsFile content;
    std::exception_ptr refusal;
};

void keep_text(void* user, const GlintOiioText* text) {
    static_cast<Rooms*>(user)->content.texts.emplace_back(text->name, text->value);
}

void* allocate_part(void* user, const GlintExrPart* asked) {
    Rooms& rooms = *static_cast<Rooms*>(user);
    try {
        Part part{.name = asked->name,
                  .size = {asked->width, asked->height},
                  .channels = asked->channels,
                  .half = asked->half != 0,
                  .pixels = {}};
        if (part.size.x > kMaxSide || part.size.y > kMaxSide * 6)
            throw cannot_read(rooms.file, "A part is larger than any texture");
        part.pixels.resize(static_cast<std::size_t>(part.size.x) *
                           static_cast<std::size_t>(part.size.y) *
                           static_cast<std::size_t>(part.channels * (part.half ? 2 : 4)));
        return rooms.content.parts.emplace_back(std::move(part)).pixels.data();
    } catch (...) {
        rooms.refusal = std::current_exception();
        return nullptr;
    }
}

void read_into(Room& room, const ReadableFile& in, const char* format) {
    GlintOiioPicture picture{};
    std::array<char, 512> cause{};
    if (module_loading().get().read(in.name().c_str(), format, &picture, allocate, &room,
                                    cause.data(), cause.size())) {
        return;
    }
    if (room.refusal) std::rethrow_exception(room.refusal);
    const bool has_shape = room.shape_only && room.image.channels > 0;
    if (has_shape) return;
    throw cannot_decode(room.file, told_of(room.file, in, cause.data()));
}

// Of the head of an HDR; nothing where it is none.
std::optional<Metadata> hdr_comments(const ReadableFile& in) {
    std::array<char, 1 << 14> buffer{};
    std::string_view head(buffer.data(), in.read(buffer, 0));
    if (!head.starts_with("#?")) return std::nullopt;
    Metadata texts;
    while (!head.empty() && head.front() != '\n') {  // an empty line ends it
        const std::string_view line = head.substr(0, head.find('\n'));
        head.remove_prefix(std::min(line.size() + 1, head.size()));
        const std::size_t equals = line.find('=');
        if (line.starts_with("# glint:") && equals != line.npos)
            texts.emplace_back(line.substr(2, equals - 2), line.substr(equals + 1));
    }
    return texts;
}

}  // namespace

void prepare_oiio() {
    module_loading();
}

std::unique_ptr<BandEncoder> encode_by_oiio(TemporaryFile& out, const fs::path& file,
                                            const char* codec, const Image& shape,
                                            const Metadata& metadata, const FileFormat& format) {
    return std::make_unique<OiioEncoder>(out, file, codec, shape, metadata, format);
}

Image read_by_oiio(const fs::path& file, const ReadableFile& in, const char* format) {
    Room room{.file = file, .shape_only = false, .image = {}, .refusal = {}};
    read_into(room, in, format);
    return std::move(room.image);
}

Image read_shape_by_oiio(const fs::path& file, const ReadableFile& in, const char* format) {
    Room room{.file = file, .shape_only = true, .image = {}, .refusal = {}};
    read_into(room, in, format);
    return std::move(room.image);
}

void write_parts(const fs::path& file, const PartsFile& content) {
    TemporaryFile out(file);
    const Memory memory;
    const std::vector<GlintOiioText> texts = texts_of(content.texts);
    std::vector<GlintExrPart> parts;
    for (const Part& part : content.parts) {
        parts.push_back({.name = part.name.c_str(),
                         .width = part.size.x,
                         .height = part.size.y,
                         .channels = part.channels,
                         .half = part.half,
                         .pixels = const_cast<std::byte*>(part.pixels.data())});
    }
    std::array<char, 512> cause{};
    if (!module_loading().get().write_parts(memory.name().c_str(), parts.data(), parts.size(),
                                            texts.data(), texts.size(), cause.data(),
                                            cause.size())) {
        throw cannot_write(file, cause.data());
    }
    if (memory.is_cut()) throw cannot_write(file, std::strerror(EFBIG));
    memory.copy_to(out);
    out.commit();
}

PartsFile read_parts(const fs::path& file) {
    const ReadableFile in(file);
    Rooms rooms{.file = file, .content = {}, .refusal = {}};
    std::array<char, 512> cause{};
    if (module_loading().get().read_parts(in.name().c_str(), keep_text, allocate_part, &rooms,
                                          cause.data(), cause.size())) {
        return std::move(rooms.content);
    }
    if (rooms.refusal) std::rethrow_exception(rooms.refusal);
    throw cannot_decode(file, told_of(file, in, cause.data()));
}

Metadata read_texts(const fs::path& file) {
    const ReadableFile in(file);
    if (const auto comments = hdr_comments(in)) return *comments;
    Rooms rooms{.file = file, .content = {}, .refusal = {}};
    const auto no_room = [](void*, const GlintExrPart*) -> void* { return nullptr; };
    std::array<char, 512> cause{};
    module_loading().get().read_parts(in.name().c_str(), keep_text, no_room, &rooms, cause.data(),
                                      cause.size());
    return std::move(rooms.content.texts);
}

}  // namespace glint
