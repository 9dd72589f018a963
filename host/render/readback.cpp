#include "render/readback.h"

#include <utility>

namespace glint {
namespace {

constexpr GLuint64 kLongestWaitNs = 1'000'000'000;

PixelBuffer make_pixel_buffer(std::size_t bytes) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    // Client storage: the program's own memory, which the GPU writes and we read fast.
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), nullptr,
                         GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
    return PixelBuffer(id);
}

}  // namespace

Readback::Readback(const Renderer& renderer, bool floats, int ahead)
    : renderer_(renderer), floats_(floats), ahead_(static_cast<std::size_t>(ahead)) {}

void Readback::send() {
    const glm::ivec2 size = renderer_.root_size();
    const std::size_t bytes = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                              4 * (floats_ ? sizeof(float) : 1);
    Picture picture{.buffer = {}, .written = nullptr, .pixels = std::vector<std::byte>(bytes)};
    if (ahead_ == 0) {
        renderer_.read_picture(floats_, picture.pixels.data());
    } else {
        if (unused_.empty()) unused_.push_back(make_pixel_buffer(bytes));
        picture.buffer = std::move(unused_.back());
        unused_.pop_back();
        glBindBuffer(GL_PIXEL_PACK_BUFFER, picture.buffer.id());
        renderer_.read_picture(floats_, nullptr);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        picture.written.reset(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
        glFlush();
    }
    on_the_way_.push_back(std::move(picture));
}

std::vector<std::byte> Readback::take() {
    Picture picture = std::move(on_the_way_.front());
    on_the_way_.pop_front();
    if (!picture.buffer) return std::move(picture.pixels);
    // A GPU that was lost passes its fences too; Context::check() then tells.
    while (glClientWaitSync(picture.written.get(), 0, kLongestWaitNs) == GL_TIMEOUT_EXPIRED) {
    }
    glGetNamedBufferSubData(picture.buffer.id(), 0, static_cast<GLsizeiptr>(picture.pixels.size()),
                            picture.pixels.data());
    unused_.push_back(std::move(picture.buffer));
    return std::move(picture.pixels);
}

}  // namespace glint
