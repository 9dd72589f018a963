// The least program that draws a wrapped fragment shader: what any host must spend, and no more.
//
//   glint-floor SHADER.glsl OUT.png WIDTH HEIGHT        one picture
//   glint-floor SHADER.glsl - WIDTH HEIGHT --frames N   the median frame in milliseconds, on stdout
//   glint-floor SHADER.glsl OUT.png WIDTH HEIGHT --export N   N pictures, each over the last
//   ... --feedback BUFFER.glsl                          and a buffer that both texts read
//
// Bare EGL on Mesa's surfaceless platform, one RGBA8 picture, one triangle, libpng. No error but a
// shader's is told in words; every other ends the program.
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace {

void require(bool fine, const char* what) {
    if (fine) return;
    std::fprintf(stderr, "glint-floor: %s\n", what);
    std::exit(1);
}

void make_context() {
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(eglInitialize(display, nullptr, nullptr) && eglBindAPI(EGL_OPENGL_API), "no EGL");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                                 EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    require(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), "no OpenGL 4.5");
}

GLuint compile(GLenum kind, const std::string& text) {
    const GLuint shader = glCreateShader(kind);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint fine = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
    char log[4096] = "";
    if (!fine) glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    require(fine, log);
    return shader;
}

// What is set before each draw; -1 where the shader does not ask.
struct Program {
    GLuint id = 0;
    GLint time, time_delta, frame, tick;
};

Program make_program(const char* file, int width, int height) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    require(!text.empty(), "no shader text");
    Program program{.id = glCreateProgram(), .time = 0, .time_delta = 0, .frame = 0, .tick = 0};
    glAttachShader(program.id, compile(GL_VERTEX_SHADER, R"(#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }
)"));
    glAttachShader(program.id, compile(GL_FRAGMENT_SHADER, text));
    glLinkProgram(program.id);
    GLint fine = 0;
    glGetProgramiv(program.id, GL_LINK_STATUS, &fine);
    require(fine, "the program does not link");

    const auto location = [&](const char* name) { return glGetUniformLocation(program.id, name); };
    program.time = location("iTime");
    program.time_delta = location("iTimeDelta");
    program.frame = location("iFrame");
    program.tick = location("iTick");
    glProgramUniform3f(program.id, location("iResolution"), static_cast<float>(width),
                       static_cast<float>(height), 1.0F);
    return program;
}

GLuint make_texture(GLenum format, int width, int height) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    const float zero[4] = {};
    glClearTexImage(texture, 0, GL_RGBA, GL_FLOAT, zero);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

struct Target {
    GLuint texture = 0, framebuffer = 0;
};

Target make_target(GLenum format, int width, int height) {
    Target target{.texture = make_texture(format, width, height), .framebuffer = 0};
    glCreateFramebuffers(1, &target.framebuffer);
    glNamedFramebufferTexture(target.framebuffer, GL_COLOR_ATTACHMENT0, target.texture, 0);
    return target;
}

void draw(const Program& program, const Target& target, int frame) {
    glUseProgram(program.id);
    glUniform1f(program.time, static_cast<float>(frame) / 60.0F);
    glUniform1f(program.time_delta, 1.0F / 60.0F);
    glUniform1i(program.frame, frame);
    glUniform1ui(program.tick, static_cast<GLuint>(frame * 65536 / 60));
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void write_png(const char* file, int width, int height) {
    std::vector<png_byte> pixels(static_cast<std::size_t>(width * height) * 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    std::FILE* out = std::fopen(file, "wb");
    require(out, "the picture cannot be written");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, Z_RLE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);
    for (int y = height - 1; y >= 0; --y) png_write_row(png, &pixels[4 * std::size_t(y * width)]);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    require(std::fclose(out) == 0, "the picture cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
    require(argc >= 5,
            "usage: SHADER OUT.png WIDTH HEIGHT [--frames N | --export N] [--feedback BUFFER]");
    const int width = std::atoi(argv[3]), height = std::atoi(argv[4]);
    int frames = 0, pictures = 0;
    const char* buffer_file = nullptr;
    for (int i = 5; i + 1 < argc; i += 2) {
        if (std::string(argv[i]) == "--frames") frames = std::atoi(argv[i + 1]);
        if (std::string(argv[i]) == "--export") pictures = std::atoi(argv[i + 1]);
        if (std::string(argv[i]) == "--feedback") buffer_file = argv[i + 1];
    }

    make_context();
    GLuint triangle = 0;
    glCreateVertexArrays(1, &triangle);
    glBindVertexArray(triangle);
    glViewport(0, 0, width, height);
    const Program image = make_program(argv[1], width, height);
    const Target picture = make_target(GL_RGBA8, width, height);
    Program buffer;
    Target now, before;
    if (buffer_file) {
        buffer = make_program(buffer_file, width, height);
        now = make_target(GL_RGBA32F, width, height);
        before = make_target(GL_RGBA32F, width, height);
    }
    const auto draw_frame = [&](int frame) {
        if (buffer_file) {
            // The only sampler of either text stands at unit 0.
            glBindTextureUnit(0, before.texture);
            draw(buffer, now, frame);
            glBindTextureUnit(0, now.texture);
            std::swap(now, before);
        }
        draw(image, picture, frame);
    };

    for (int frame = 0; frame < pictures; ++frame) {
        draw_frame(frame);
        write_png(argv[2], width, height);
    }
    if (pictures > 0) return 0;

    // The driver compiles to machine code at the first draws.
    for (int frame = 0; frames > 0 && frame < 3; ++frame) draw_frame(frame);
    std::vector<double> ms;
    for (int frame = 0; frame < std::max(frames, 1); ++frame) {
        glFinish();
        const auto start = std::chrono::steady_clock::now();
        draw_frame(frame);
        glFinish();
        ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count());
    }
    if (frames == 0) {
        write_png(argv[2], width, height);
    } else {
        std::nth_element(ms.begin(), ms.begin() + frames / 2, ms.end());
        std::printf("%.4f\n", ms[static_cast<std::size_t>(frames / 2)]);
    }
}
