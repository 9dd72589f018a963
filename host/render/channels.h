// What samplers read besides buffers (images, noise, the keyboard), and how they filter and wrap.
#pragma once

#include "gl/objects.h"
#include "render/program.h"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace glint {

// Pixels in memory, rows bottom up, channels interleaved. A volume has slices, a cube six of them:
// +X -X +Y -Y +Z -Z.
struct PixelView {
    glm::ivec2 size{0};
    int slices = 1;
    int channels = 4;
    bool floats = false;  // 32-bit floats; bytes otherwise
    std::span<const std::byte> data;
};

// A sound as shaders see it: 512x2 bytes at a time.
class SoundTexture {
public:
    virtual ~SoundTexture() = default;
    virtual std::span<const std::byte> rows_at(double time) = 0;  // valid until the next call
    virtual double seconds() const = 0;                           // its length; it plays in a loop
};

// A texture that does not come from a pass.
struct Channel {
    Texture texture;
    glm::ivec3 size{1};              // as iChannelResolution tells it
    std::size_t version = 0;         // counts changes
    std::vector<std::byte> bytes{};  // of a sound: what the texture holds
};

// A picture on its way to the driver, some rows at a time, for whoever must not wait for a large
// one. It belongs to no scene until Channels::set_image.
class PictureUpload {
public:
    // Makes room for a picture of this form.
    PictureUpload(const PixelView& form, bool mipmaps);
    // Sends the next rows of it, or makes as much of its mipmaps. True once all are there.
    bool send(const PixelView& pixels, int rows);
    Channel take() { return std::move(channel_); }

private:
    bool add_mipmaps(int rows);

    Channel channel_;
    bool mipmaps_;
    int sent_ = 0;              // rows
    int level_ = 1, made_ = 0;  // of the mipmaps: which one is made, and its rows that are
};

class Channels {
public:
    explicit Channels(const Preset& preset);

    // The texture of a sampler (as in sampler_at) that reads no buffer. Noise and the keyboard are
    // made on first use; what comes from a file reads 0 until set_image.
    const Channel& channel(std::size_t sampler);

    // Reads 0.
    GLuint empty(SamplerType type) const {
        return empty_[static_cast<std::size_t>(type)].texture.id();
    }

    bool has(std::size_t sampler) const { return channels_.contains(sampler); }
    void set_image(std::size_t sampler, const PixelView& pixels);
    void set_image(std::size_t sampler, PictureUpload& sent);
    void set_sound(std::size_t sampler, std::unique_ptr<SoundTexture> sound);
    void set_keyboard(const Input& input);
    // Brings the textures of the sounds to this time.
    void set_time(double time);

    // How far what a sampler reads has played at this time; 0 for what does not play.
    double time_of(std::size_t sampler, double time) const;

    // Takes over what a sampler here would read from the same files. The others are empty
    // until set_image.
    void adopt(Channels& previous);

    // The GL sampler object for a reader's filter and wrap.
    GLuint sampler_object(const Sampler& sampler);

private:
    const Preset& preset_;
    std::map<std::size_t, Channel> channels_;                      // by sampler; images and noise
    std::map<std::size_t, std::unique_ptr<SoundTexture>> sounds_;  // by sampler
    Channel keyboard_;
    std::array<Channel, 3> empty_;  // reads 0; one for each sampler type
    Input keys_;                    // what the keyboard texture holds
    std::map<std::pair<Filter, Wrap>, SamplerObject> sampler_objects_;
};

// Uniform random bytes: the same for the same size on every machine (pcg3d, Jarzynski and Olano
// 2020).
std::vector<std::byte> noise_bytes(glm::ivec3 size, int channels);

}  // namespace glint
