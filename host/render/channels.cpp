#include "render/channels.h"

#include "base/loop_place.h"
#include "gl/resample.h"
#include "render/room.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace glint {
namespace {

constexpr int kSoundBins = 512;

struct Formats {
    GLenum internal, external;
};

Formats formats(int channels, bool floats) {
    switch (channels) {
        case 1:
            return {static_cast<GLenum>(floats ? GL_R32F : GL_R8), GL_RED};
        case 2:
            return {static_cast<GLenum>(floats ? GL_RG32F : GL_RG8), GL_RG};
        case 3:
            return {static_cast<GLenum>(floats ? GL_RGB32F : GL_RGB8), GL_RGB};
        default:
            return {static_cast<GLenum>(floats ? GL_RGBA32F : GL_RGBA8), GL_RGBA};
    }
}

GLenum value_type(const PixelView& pixels) {
    return pixels.floats ? GL_FLOAT : GL_UNSIGNED_BYTE;
}

Channel make_picture(const PixelView& pixels, bool mipmaps) {
    PictureUpload upload(pixels, mipmaps);
    upload.send(pixels, pixels.size.y);
    return upload.take();
}

Channel make_volume(const PixelView& slices, bool mipmaps) {
    const auto [internal, external] = formats(slices.channels, slices.floats);
    const glm::ivec3 size(slices.size, slices.slices);
    const int levels = mipmaps ? mipmap_levels({std::max(size.x, size.z), size.y}) : 1;
    Channel channel{.texture = make_texture_3d(internal, size.x, size.y, size.z, levels),
                    .size = size,
                    .version = 1};
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(channel.texture.id(), 0, 0, 0, 0, size.x, size.y, size.z, external,
                        value_type(slices), slices.data.data());
    if (mipmaps) make_mipmaps(channel.texture.id());
    return channel;
}

Channel make_cube(const PixelView& faces, bool mipmaps) {
    const auto [internal, external] = formats(faces.channels, faces.floats);
    const int side = faces.size.x;
    Channel channel{
        .texture = make_texture_cube(internal, side, mipmaps ? mipmap_levels(faces.size) : 1),
        .size = {side, side, 1},
        .version = 1};
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(channel.texture.id(), 0, 0, 0, 0, side, side, 6, external,
                        value_type(faces), faces.data.data());
    if (mipmaps) make_mipmaps(channel.texture.id());
    return channel;
}

Channel make_channel(SamplerType type, const PixelView& pixels, bool mipmaps) {
    switch (type) {
        case SamplerType::sampler2D:
            break;
        case SamplerType::samplerCube:
            return make_cube(pixels, mipmaps);
        case SamplerType::sampler3D:
            return make_volume(pixels, mipmaps);
    }
    return make_picture(pixels, mipmaps);
}

Channel make_noise(const Sampler& sampler) {
    const bool is_cube = sampler.type == SamplerType::samplerCube;
    const glm::ivec3 size(glm::ivec2(sampler.noise_size), is_cube ? 6 : sampler.noise_size.z);
    const auto texels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                        static_cast<std::size_t>(size.z);
    const WantedMemory wanted{"the noise of " + sampler.name, texels * (4 + 4) / 3 * 4};
    require_memory({&wanted, 1}, "Make the noise smaller, such as 256.");
    const std::vector<std::byte> bytes = noise_bytes(size, sampler.noise_channels);
    const PixelView pixels{.size = glm::ivec2(size),
                           .slices = size.z,
                           .channels = sampler.noise_channels,
                           .data = bytes};
    return make_channel(sampler.type, pixels, sampler.filter == Filter::mipmap);
}

// pcg3d (Jarzynski and Olano 2020).
glm::uvec3 hash(glm::uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    return v;
}

}  // namespace

PictureUpload::PictureUpload(const PixelView& form, bool mipmaps)
    : channel_{.texture =
                   make_unfilled_texture_2d(formats(form.channels, form.floats).internal, form.size,
                                            mipmaps ? mipmap_levels(form.size) : 1),
               .size = glm::ivec3(form.size, 1),
               .version = 1},
      mipmaps_(mipmaps) {}

bool PictureUpload::send(const PixelView& pixels, int rows) {
    const glm::ivec2 size = pixels.size;
    if (sent_ == size.y) return add_mipmaps(rows);
    const bool is_at_once = rows >= size.y;
    rows = std::min(rows, size.y - sent_);
    const std::size_t row_bytes = pixels.data.size() / static_cast<std::size_t>(size.y);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(channel_.texture.id(), 0, 0, sent_, size.x, rows,
                        formats(pixels.channels, pixels.floats).external, value_type(pixels),
                        pixels.data.data() + row_bytes * static_cast<std::size_t>(sent_));
    sent_ += rows;
    if (mipmaps_ && is_at_once) make_mipmaps(channel_.texture.id());
    return sent_ == size.y && (is_at_once || !mipmaps_);
}

// The next rows of a level, each the mean of two of the level above. Where a side is odd a mean
// takes three, and small levels are quick: the driver makes those that are left.
bool PictureUpload::add_mipmaps(int rows) {
    constexpr int kQuick = 1 << 20;  // pixels
    const GLuint texture = channel_.texture.id();
    const glm::ivec2 above = glm::ivec2(channel_.size) >> (level_ - 1);
    const Framebuffer to = make_framebuffer();
    glNamedFramebufferTexture(to.id(), GL_COLOR_ATTACHMENT0, texture, level_);
    const bool is_drawable =
        glCheckNamedFramebufferStatus(to.id(), GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (above.x % 2 != 0 || above.y % 2 != 0 || above.x * above.y < kQuick || !is_drawable) {
        glTextureParameteri(texture, GL_TEXTURE_BASE_LEVEL, level_ - 1);
        make_mipmaps(texture);
        glTextureParameteri(texture, GL_TEXTURE_BASE_LEVEL, 0);
        return true;
    }
    const glm::ivec2 size = above / 2;
    const int end = std::min(made_ + rows, size.y);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, made_, size.x, end - made_);
    resample({.texture = texture, .level = level_ - 1, .framebuffer = to.id(), .size = size});
    glDisable(GL_SCISSOR_TEST);
    made_ = end;
    if (made_ == size.y) ++level_, made_ = 0;
    return false;
}

std::vector<std::byte> noise_bytes(glm::ivec3 size, int channels) {
    std::vector<std::byte> bytes;
    bytes.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                  static_cast<std::size_t>(size.z) * static_cast<std::size_t>(channels));
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const glm::uvec3 h = hash(glm::uvec3(x, y, z));
                // The high bits are the well-mixed ones; the fourth channel takes other bits.
                const std::uint32_t values[4] = {h.x >> 24, h.y >> 24, h.z >> 24,
                                                 (h.x ^ h.y ^ h.z) >> 12 & 0xffu};
                for (int c = 0; c < channels; ++c)
                    bytes.push_back(static_cast<std::byte>(values[c]));
            }
        }
    }
    return bytes;
}

Channels::Channels(const Preset& preset) : preset_(preset) {
    empty_[0].texture = make_texture_2d(GL_RGBA8, {1, 1});
    empty_[1].texture = make_texture_cube(GL_RGBA8, 1);
    empty_[2].texture = make_texture_3d(GL_RGBA8, 1, 1, 1);
    glClearTexImage(empty_[2].texture.id(), 0, GL_RGBA, GL_FLOAT, nullptr);
}

const Channel& Channels::channel(std::size_t index) {
    const Sampler& sampler = sampler_at(preset_, index);
    if (sampler.source == Source::keyboard) {
        if (!keyboard_.texture) set_keyboard({});
        return keyboard_;
    }
    if (const auto known = channels_.find(index); known != channels_.end()) return known->second;
    if (sampler.source == Source::noise) {
        return channels_.emplace(index, make_noise(sampler)).first->second;
    }
    return empty_[static_cast<std::size_t>(sampler.type)];
}

void Channels::set_image(std::size_t index, const PixelView& pixels) {
    const Sampler& sampler = sampler_at(preset_, index);
    const std::size_t version = channel(index).version;
    Channel& channel = channels_[index];
    channel = make_channel(sampler.type, pixels, sampler.filter == Filter::mipmap);
    channel.version = version + 1;
}

void Channels::set_image(std::size_t index, PictureUpload& sent) {
    const std::size_t version = channel(index).version;
    Channel& channel = channels_[index];
    channel = sent.take();
    channel.version = version + 1;
}

void Channels::adopt(Channels& previous) {
    for (std::size_t i = 0; i < sampler_count(preset_); ++i) {
        const Sampler& wanted = sampler_at(preset_, i);
        if (wanted.files.empty()) continue;
        for (auto& [index, channel] : previous.channels_) {
            const Sampler& had = sampler_at(previous.preset_, index);
            const bool same = had.source == wanted.source && had.files == wanted.files &&
                              had.vflip == wanted.vflip &&
                              (had.filter == Filter::mipmap) == (wanted.filter == Filter::mipmap);
            if (!same || !channel.texture) continue;
            channels_[i] = std::move(channel);
            if (had.source == Source::sound) sounds_[i] = std::move(previous.sounds_[index]);
            break;
        }
    }
}

void Channels::set_sound(std::size_t index, std::unique_ptr<SoundTexture> sound) {
    const std::size_t version = channel(index).version;
    channels_[index] = {.texture = make_texture_2d(GL_R8, {kSoundBins, 2}),
                        .size = {kSoundBins, 2, 1},
                        .version = version + 1};
    sounds_[index] = std::move(sound);
}

void Channels::set_time(double time) {
    for (auto& [index, sound] : sounds_) {
        const std::span<const std::byte> rows = sound->rows_at(time);
        Channel& channel = channels_[index];
        if (std::equal(rows.begin(), rows.end(), channel.bytes.begin(), channel.bytes.end()))
            continue;
        channel.bytes.assign(rows.begin(), rows.end());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(channel.texture.id(), 0, 0, 0, kSoundBins, 2, GL_RED, GL_UNSIGNED_BYTE,
                            rows.data());
        ++channel.version;
    }
}

double Channels::time_of(std::size_t index, double time) const {
    const auto sound = sounds_.find(index);
    if (sound != sounds_.end()) return place_in_loop(time, sound->second->seconds()).into;
    return sampler_at(preset_, index).plays ? time : 0.0;
}

void Channels::set_keyboard(const Input& input) {
    const bool same = input.held == keys_.held && input.pressed == keys_.pressed &&
                      input.toggled == keys_.toggled;
    if (keyboard_.texture && same) return;
    keys_ = input;
    if (!keyboard_.texture) {
        keyboard_.texture = make_texture_2d(GL_R8, {kKeyCount, 3});
        keyboard_.size = {kKeyCount, 3, 1};
    }
    std::array<std::uint8_t, kKeyCount * 3> rows{};
    std::memcpy(rows.data(), input.held.data(), kKeyCount);
    std::memcpy(rows.data() + kKeyCount, input.pressed.data(), kKeyCount);
    std::memcpy(rows.data() + 2 * kKeyCount, input.toggled.data(), kKeyCount);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(keyboard_.texture.id(), 0, 0, 0, kKeyCount, 3, GL_RED, GL_UNSIGNED_BYTE,
                        rows.data());
    ++keyboard_.version;
}

GLuint Channels::sampler_object(const Sampler& sampler) {
    SamplerObject& object = sampler_objects_[{sampler.filter, sampler.wrap}];
    if (object) return object.id();
    GLuint id = 0;
    glCreateSamplers(1, &id);
    const GLint wrap = sampler.wrap == Wrap::clamp    ? GL_CLAMP_TO_EDGE
                       : sampler.wrap == Wrap::repeat ? GL_REPEAT
                                                      : GL_MIRRORED_REPEAT;
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glSamplerParameteri(id, axis, wrap);
    }
    const bool nearest = sampler.filter == Filter::nearest;
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER,
                        nearest                            ? GL_NEAREST
                        : sampler.filter == Filter::mipmap ? GL_LINEAR_MIPMAP_LINEAR
                                                           : GL_LINEAR);
    object = SamplerObject(id);
    return id;
}

}  // namespace glint
