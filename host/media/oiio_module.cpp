// glint-oiio.so: the files that only OpenImageIO knows. Loaded when the first of them is met.
#include "media/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

// Writes where it is told and remembers every refusal; OpenImageIO's own files forget those that
// come at close.
class CheckedFile : public OIIO::Filesystem::IOProxy {
public:
    explicit CheckedFile(int descriptor) : IOProxy("", Write), descriptor_(descriptor) {}

    const char* proxytype() const override { return "checked"; }

    size_t read(void* buffer, size_t size) override {
        const size_t got = pread(buffer, size, m_pos);
        m_pos += static_cast<int64_t>(got);
        return got;
    }

    size_t write(const void* buffer, size_t size) override {
        const std::string_view bytes(static_cast<const char*>(buffer), size);
        const size_t line = comments_.empty() ? bytes.npos : bytes.find('\n');
        if (line == bytes.npos) return put(bytes);
        const size_t head = put(bytes.substr(0, line + 1));
        put(std::exchange(comments_, {}));
        return head + put(bytes.substr(line + 1));
    }

    // Lines that go behind the first one: those of an HDR, for which OpenImageIO has no words.
    void comment(std::string lines) { comments_ = std::move(lines); }

    size_t pread(void* buffer, size_t size, int64_t offset) override {
        const ssize_t got = ::pread(descriptor_, buffer, size, offset);
        if (got < 0) error_ = errno;
        return got < 0 ? 0 : static_cast<size_t>(got);
    }

    size_t pwrite(const void* buffer, size_t size, int64_t offset) override {
        const char* from = static_cast<const char*>(buffer);
        size_t done = 0;
        while (done < size) {
            const ssize_t put = ::pwrite(descriptor_, from + done, size - done,
                                         offset + static_cast<int64_t>(done));
            if (put < 0 && errno == EINTR) continue;
            if (put <= 0) {
                error_ = put < 0 ? errno : ENOSPC;
                break;
            }
            done += static_cast<size_t>(put);
        }
        return done;
    }

    size_t size() const override {
        struct stat status {};
        return ::fstat(descriptor_, &status) == 0 ? static_cast<size_t>(status.st_size) : 0;
    }

    int refused() const { return error_; }

private:
    size_t put(std::string_view bytes) {
        const size_t done = pwrite(bytes.data(), bytes.size(), m_pos);
        m_pos += static_cast<int64_t>(done);
        return done;
    }

    int descriptor_;
    int error_ = 0;
    std::string comments_;
};

// OpenImageIO keeps a whole JPEG in memory unless it goes to a stream of C's. libjpeg would end the
// program where that refuses a write; so it is told that all went well, and the file remembers.
std::FILE* stream_to(CheckedFile& file) {
    cookie_io_functions_t functions{};
    functions.write = [](void* to, const char* bytes, size_t size) {
        static_cast<CheckedFile*>(to)->write(bytes, size);
        return static_cast<ssize_t>(size);
    };
    return ::fopencookie(&file, "wb", functions);
}

struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};

// Readers of Radiance's files, OpenImageIO's among them, know lines of 127 letters at most.
std::string hdr_comments(const GlintOiioText* texts, size_t text_count) {
    constexpr size_t kLongest = 120;
    std::string comments;
    for (size_t i = 0; i < text_count; ++i) {
        const std::string line = std::string("# ") + texts[i].name + "=" + texts[i].value;
        const bool fits = line.size() <= kLongest && line.find_first_of("\r\n") == line.npos;
        if (line.starts_with("# glint:") && fits) comments += line + "\n";
    }
    return comments;
}

OIIO::TypeDesc type_of(const GlintOiioPicture& picture) {
    return picture.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
}

OIIO::stride_t row_bytes(const GlintOiioPicture& picture) {
    return static_cast<OIIO::stride_t>(picture.width) * picture.channels *
           static_cast<OIIO::stride_t>(type_of(picture).size());
}

// The file's first row is the picture's last.
char* top_row(const GlintOiioPicture& picture) {
    return static_cast<char*>(picture.pixels) + (picture.height - 1) * row_bytes(picture);
}

int give_up(std::string message, char* cause, size_t cause_size) {
    message.resize(std::min(message.find('\n'), message.size()));  // the first of many
    while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
    std::snprintf(cause, cause_size, "%s", message.c_str());
    return 0;
}

OIIO::ImageSpec spec_of(const GlintOiioPicture& picture, const GlintOiioFormat& format,
                        const GlintOiioText* texts, size_t text_count) {
    OIIO::ImageSpec spec(picture.width, picture.height, picture.channels,
                         format.half ? OIIO::TypeDesc::HALF : type_of(picture));
    for (size_t i = 0; i < text_count; ++i) spec.attribute(texts[i].name, texts[i].value);
    spec.tile_width = spec.tile_height = format.tile;
    spec.tile_depth = 1;

    // Equal pictures shall be equal files: a fixed date keeps the library from asking the clock.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    const std::string codec = format.codec, compression = format.compression;
    if (codec == "jpeg") {
        spec.attribute("CompressionQuality", format.quality ? format.quality : 95);
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    if (codec == "openexr") {  // by default lossless, a row at a time
        spec.attribute("compression", compression.empty() ? "zips" : compression);
    }
    if (codec == "tiff") {
        spec.attribute("compression", compression.empty() ? "zip" : compression);
        spec.attribute("tiff:zipquality", 1);
        // A classic TIFF ends at 4 GiB, and noise does not shrink.
        if (spec.image_bytes() > (std::uint64_t{15} << 28)) spec.attribute("tiff:bigtiff", 1);
    }
    return spec;
}

constexpr int kMostPartChannels = 4;

OIIO::TypeDesc type_of(const GlintExrPart& part) {
    return part.half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

OIIO::stride_t row_bytes(const GlintExrPart& part) {
    return static_cast<OIIO::stride_t>(part.width) * part.channels *
           static_cast<OIIO::stride_t>(type_of(part).size());
}

char* top_row(const GlintExrPart& part) {
    return static_cast<char*>(part.pixels) + (part.height - 1) * row_bytes(part);
}

// All parts of a file share a window.
std::vector<OIIO::ImageSpec> specs_of(const GlintExrPart* parts, size_t count) {
    std::vector<OIIO::ImageSpec> specs;
    int width = 0, height = 0;
    for (const GlintExrPart* part = parts; part != parts + count; ++part) {
        OIIO::ImageSpec& spec =
            specs.emplace_back(part->width, part->height, part->channels, type_of(*part));
        spec.attribute("oiio:subimagename", part->name);
        spec.attribute("compression", "none");
        spec.attribute("DateTime", "1970:01:01 00:00:00");
        spec.attribute("oiio:UnassociatedAlpha", 1);
        width = std::max(width, part->width);
        height = std::max(height, part->height);
    }
    for (OIIO::ImageSpec& spec : specs) {
        spec.full_width = width;
        spec.full_height = height;
    }
    return specs;
}

bool write_parts(OIIO::ImageOutput& output, const char* file, const GlintExrPart* parts,
                 const std::vector<OIIO::ImageSpec>& specs) {
    if (!output.open(file, static_cast<int>(specs.size()), specs.data())) return false;
    for (size_t i = 0; i < specs.size(); ++i) {
        if (i > 0 && !output.open(file, specs[i], OIIO::ImageOutput::AppendSubimage)) return false;
        if (!output.write_image(type_of(parts[i]), top_row(parts[i]), OIIO::AutoStride,
                                -row_bytes(parts[i])))
            return false;
    }
    return output.close();
}

struct OpenFile {
    explicit OpenFile(int descriptor) : file(descriptor) {}

    CheckedFile file;                                     // goes after all that write to it
    std::unique_ptr<std::FILE, Close> stream;             // of a JPEG
    std::unique_ptr<OIIO::Filesystem::IOFile> on_stream;  // and what OpenImageIO knows it as
    std::unique_ptr<OIIO::ImageOutput> output;
    int rows = 0;  // that are written
};

// Runs `step` and turns what it throws, or that it returns false, into a cause and an errno.
template <class Step>
int guarded(OpenFile& open, int* error, char* cause, size_t cause_size, Step step) {
    *error = 0;
    try {
        const bool done = step();
        *error = open.file.refused();
        if (done && *error == 0) return 1;
        return give_up(open.output ? open.output->geterror() : OIIO::geterror(), cause, cause_size);
    } catch (const std::exception& exception) {
        *error = open.file.refused();
        return give_up(exception.what(), cause, cause_size);
    }
}

}  // namespace

void* glint_oiio_begin(int descriptor, const GlintOiioFormat* format, const GlintOiioPicture* shape,
                       const GlintOiioText* texts, size_t text_count, int* error, char* cause,
                       size_t cause_size) {
    auto open = std::make_unique<OpenFile>(descriptor);
    const int begun = guarded(*open, error, cause, cause_size, [&] {
        open->output = OIIO::ImageOutput::create(format->codec);
        if (!open->output) return false;
        if (format->codec == std::string_view("jpeg")) {
            open->stream.reset(stream_to(open->file));
            open->on_stream = std::make_unique<OIIO::Filesystem::IOFile>(
                open->stream.get(), OIIO::Filesystem::IOProxy::Write);
            open->output->set_ioproxy(open->on_stream.get());
        } else {
            if (format->codec == std::string_view("hdr"))
                open->file.comment(hdr_comments(texts, text_count));
            open->output->set_ioproxy(&open->file);
        }
        return open->output->open(format->codec, spec_of(*shape, *format, texts, text_count));
    });
    return begun ? open.release() : nullptr;
}

int glint_oiio_write(void* file, const GlintOiioPicture* band, int* error, char* cause,
                     size_t cause_size) {
    auto& open = *static_cast<OpenFile*>(file);
    return guarded(open, error, cause, cause_size, [&] {
        const int first = open.rows, end = open.rows += band->height;
        const auto type = type_of(*band);
        if (open.output->spec().tile_width == 0) {
            return open.output->write_scanlines(first, end, 0, type, top_row(*band),
                                                OIIO::AutoStride, -row_bytes(*band));
        }
        return open.output->write_tiles(0, band->width, first, end, 0, 1, type, top_row(*band),
                                        OIIO::AutoStride, -row_bytes(*band));
    });
}

int glint_oiio_end(void* file, int* error, char* cause, size_t cause_size) {
    const std::unique_ptr<OpenFile> open(static_cast<OpenFile*>(file));
    return guarded(*open, error, cause, cause_size, [&] { return open->output->close(); });
}

int glint_oiio_read(const char* file, const char* format, GlintOiioPicture* picture,
                    void* (*allocate)(void* user, const GlintOiioPicture*), void* user, char* cause,
                    size_t cause_size) {
    try {
        auto input = OIIO::ImageInput::create(format);
        if (!input) return give_up(OIIO::geterror(), cause, cause_size);

        // Values as they stand in the file: no multiplication by alpha.
        OIIO::ImageSpec wish, spec;
        wish.attribute("oiio:UnassociatedAlpha", 1);
        if (!input->open(file, spec, wish)) return give_up(input->geterror(), cause, cause_size);
        if (spec.deep) return give_up("It holds deep samples", cause, cause_size);

        *picture = {.width = spec.width,
                    .height = spec.height,
                    .channels = std::min(spec.nchannels, 4),
                    .is_float = spec.format.size() > 1,
                    .pixels = nullptr};
        picture->pixels = allocate(user, picture);
        if (!picture->pixels) return 0;

        // A TIFF cut short reads "well" and leaves its errors behind.
        const bool whole =
            input->read_image(0, 0, 0, picture->channels, type_of(*picture), top_row(*picture),
                              OIIO::AutoStride, -row_bytes(*picture));
        if (!whole || input->has_error()) return give_up(input->geterror(), cause, cause_size);
        return 1;
    } catch (const std::exception& exception) {
        return give_up(exception.what(), cause, cause_size);
    }
}

int glint_exr_write(const char* memory, const GlintExrPart* parts, size_t part_count,
                    const GlintOiioText* texts, size_t text_count, char* cause, size_t cause_size) {
    try {
        std::vector<OIIO::ImageSpec> specs = specs_of(parts, part_count);
        for (size_t i = 0; i < text_count; ++i) specs[0].attribute(texts[i].name, texts[i].value);
        const auto output = OIIO::ImageOutput::create("openexr");
        if (output && write_parts(*output, memory, parts, specs)) return 1;
        return give_up(output ? output->geterror() : OIIO::geterror(), cause, cause_size);
    } catch (const std::exception& exception) {
        return give_up(exception.what(), cause, cause_size);
    }
}

int glint_exr_read(const char* file, void (*tell)(void* user, const GlintOiioText*),
                   void* (*allocate)(void* user, const GlintExrPart*), void* user, char* cause,
                   size_t cause_size) {
    try {
        const auto input = OIIO::ImageInput::create("openexr");
        OIIO::ImageSpec spec;
        if (!input || !input->open(file, spec))
            return give_up(input ? input->geterror() : OIIO::geterror(), cause, cause_size);
        for (const OIIO::ParamValue& text : spec.extra_attribs) {
            if (text.type() != OIIO::TypeString) continue;
            const std::string name = text.name().string(), value = text.get_string(0);
            const GlintOiioText told{name.c_str(), value.c_str()};
            tell(user, &told);
        }
        for (int i = 0; input->seek_subimage(i, 0); ++i) {
            spec = input->spec(i);
            const std::string name(spec.get_string_attribute("oiio:subimagename"));
            if (spec.nchannels > kMostPartChannels || spec.deep)
                return give_up("A part has more than four channels", cause, cause_size);
            GlintExrPart part{.name = name.c_str(),
                              .width = spec.width,
                              .height = spec.height,
                              .channels = spec.nchannels,
                              .half = spec.format == OIIO::TypeDesc::HALF,
                              .pixels = nullptr};
            part.pixels = allocate(user, &part);
            if (!part.pixels) return 0;
            const bool whole = input->read_image(i, 0, 0, part.channels, type_of(part),
                                                 top_row(part), OIIO::AutoStride, -row_bytes(part));
            if (!whole || input->has_error()) return give_up(input->geterror(), cause, cause_size);
        }
        return 1;
    } catch (const std::exception& exception) {
        return give_up(exception.what(), cause, cause_size);
    }
}
