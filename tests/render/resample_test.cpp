// Smaller levels and copies at another size, beside what the driver makes of the same texels.
#include "gl/resample.h"

#include "fixture.h"
#include "gl/objects.h"

#include <cmath>
#include <limits>
#include <random>

namespace glint::resample_test {
namespace {

using Resample = GlTest;

std::vector<float> noise(glm::ivec2 size) {
    std::mt19937 random(7);
    std::vector<float> values(static_cast<std::size_t>(size.x * size.y * 4));
    for (float& value : values) value = static_cast<float>(random() % 1000u) / 999.0f;
    return values;
}

Texture filled(GLenum format, glm::ivec2 size, const std::vector<float>& values) {
    Texture texture = make_texture_2d(format, size, mipmap_levels(size));
    glTextureSubImage2D(texture.id(), 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, values.data());
    return texture;
}

std::vector<float> level_of(const Texture& texture, int level, glm::ivec2 size) {
    std::vector<float> values(static_cast<std::size_t>(size.x * size.y * 4));
    glGetTextureImage(texture.id(), level, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
    return values;
}

TEST_F(Resample, SmallerLevelsAreThoseOfTheDriver) {
    const GLenum formats[] = {GL_RGBA8, GL_R8, GL_RG16F, GL_RGBA16F, GL_R32F, GL_RGBA32F};
    for (const GLenum format : formats) {
        // Filters of 8 bits and halves are rounded once more from level to level.
        const float tolerance = format == GL_R32F || format == GL_RGBA32F ? 1e-5f : 3.0f / 255.0f;
        for (const glm::ivec2 size : {glm::ivec2(64, 32), glm::ivec2(37, 21), glm::ivec2(1, 9)}) {
            const std::vector<float> values = noise(size);
            const Texture ours = filled(format, size, values),
                          drivers = filled(format, size, values);
            make_mipmaps(ours.id());
            glGenerateTextureMipmap(drivers.id());
            for (int level = 0; level < mipmap_levels(size); ++level) {
                const glm::ivec2 smaller = glm::max(size >> level, 1);
                const auto a = level_of(ours, level, smaller),
                           b = level_of(drivers, level, smaller);
                for (std::size_t i = 0; i < a.size(); ++i)
                    ASSERT_NEAR(a[i], b[i], tolerance) << format << " " << size.x << " " << level;
            }
        }
    }
}

TEST_F(Resample, ACopyOfTheSameSizeIsExactBesideAnInfinityToo) {
    std::vector<float> values = noise({8, 4});
    values[4] = std::numeric_limits<float>::infinity();
    const Texture from = filled(GL_RGBA32F, {8, 4}, values),
                  to = filled(GL_RGBA32F, {16, 8}, {noise({16, 8})});
    const Framebuffer framebuffer = make_framebuffer();
    glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, to.id(), 0);
    const std::vector<float> before = level_of(to, 0, {16, 8});
    resample(
        {.texture = from.id(), .framebuffer = framebuffer.id(), .origin = {5, 3}, .size = {8, 4}});
    const std::vector<float> after = level_of(to, 0, {16, 8});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto at = static_cast<std::size_t>(y * 64 + x);
            const bool inside = x >= 20 && x < 52 && y >= 3 && y < 7;
            const auto there = static_cast<std::size_t>((y - 3) * 32 + x - 20);
            EXPECT_EQ(after[at], inside ? values[there] : before[at]) << x << " " << y;
        }
}

TEST_F(Resample, WhatIsBoundStaysBoundAndTheScissorCounts) {
    const std::vector<float> values(64, 1.0f), zeros(64, 0.0f);
    const Texture from = filled(GL_RGBA32F, {4, 4}, values), to = filled(GL_RGBA32F, {4, 4}, zeros);
    const Framebuffer framebuffer = make_framebuffer();
    glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, to.id(), 0);
    glBindTextureUnit(0, to.id());
    glViewport(1, 2, 3, 4);
    glEnable(GL_BLEND);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 4, 1);
    resample({.texture = from.id(), .framebuffer = framebuffer.id(), .size = {4, 4}});
    make_mipmaps(from.id());
    EXPECT_EQ(level_of(from, 1, {2, 2})[15], 1.0f);
    GLint texture = 0, viewport[4] = {};
    glGetIntegeri_v(GL_TEXTURE_BINDING_2D, 0, &texture);
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(static_cast<GLuint>(texture), to.id());
    EXPECT_EQ(viewport[3], 4);
    EXPECT_TRUE(glIsEnabled(GL_BLEND));
    EXPECT_TRUE(glIsEnabled(GL_SCISSOR_TEST));
    EXPECT_FALSE(glIsEnabled(GL_COLOR_LOGIC_OP));
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    const std::vector<float> drawn = level_of(to, 0, {4, 4});
    EXPECT_EQ(drawn[0], 1.0f);
    EXPECT_EQ(drawn[16], 0.0f);
}

}  // namespace
}  // namespace glint::resample_test
