// A compiled scene and a frame become pixels, in textures of our own.
#pragma once

#include "base/stopwatch.h"
#include "render/average.h"
#include "render/buffer.h"
#include "render/channels.h"
#include "render/compile.h"
#include "render/compile_ahead.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace glint {

struct RenderOptions {
    glm::ivec2 size{1280, 720};                       // pixels
    PixelFormat picture_format = PixelFormat::rgba8;  // of the picture; buffers have their own
    int samples = 1;  // sub-pixel positions; needs ProgramOptions::average
    // The picture is drawn in tiles of at most this size; 0: whole. Needs ProgramOptions::tiles.
    glm::ivec2 tile{0};
    // Passes that take long are drawn in strips, each waited for, so that no driver's watchdog sees
    // one long draw.
    bool in_strips = false;
    bool fine_bytes = false;  // see BufferShape; what is saved of a state has bytes
};

// What later frames depend on in one pass.
struct PassState {
    std::string pass;  // its name
    BufferShape shape;
    long steps_done = 0;           // of its simulation
    std::vector<std::byte> bytes;  // as Buffer::bytes() gives them
};

class Renderer {
public:
    // Keeps references: preset must outlive the renderer. Throws std::runtime_error when the
    // buffers do not fit (render/room.h). Adopts the previous one, unless it throws, and makes
    // only what that one does not have.
    Renderer(const Preset& preset, CompiledScene scene, const RenderOptions& options,
             Renderer* previous = nullptr);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // The samplers (as in sampler_at) that something reads and whose files are not here yet; hand
    // each its content.
    std::vector<std::size_t> inputs_needed() const;
    // Which of iChannel0..3 something reads and nothing fills.
    std::vector<std::size_t> empty_channels() const;
    void set_image(std::size_t sampler, const PixelView& pixels) {
        channels_.set_image(sampler, pixels);
    }
    void set_image(std::size_t sampler, PictureUpload& sent) { channels_.set_image(sampler, sent); }
    void set_sound(std::size_t sampler, std::unique_ptr<SoundTexture> sound) {
        channels_.set_sound(sampler, std::move(sound));
    }

    // The tweaks from the next draw on, one for each of the scene's; those of the preset before.
    // They matter where the scene was not specialised.
    void set_values(std::vector<TweakValue> values) { values_ = std::move(values); }

    // Draws only what later frames depend on: how a simulation is brought to a time.
    void advance(const Frame& frame);

    // Draws whatever has changed since it was last drawn. True when the root was drawn anew.
    bool draw(const Frame& frame);

    // Draws the root alone, from the buffers as they stand.
    void draw_root(const Frame& frame);

    // Draws the picture, and the buffers that it is made of, for an instant that has been drawn
    // before, at another size for one: what later frames depend on stays as it is.
    void draw_again(const Frame& frame);

    // What draw() does for an averaged picture, sample by sample, each once and in any order.
    // Between two of them the mean of those so far can be shown.
    void begin_samples(const Frame& frame);
    void add_sample(const Frame& frame, int sample);
    void show_samples(int count);

    // Which rectangle of the picture the root is from now on, where it is drawn in tiles.
    void set_tile(glm::ivec2 origin, glm::ivec2 size);

    // Buffers to 0 and simulations to their start; everything is drawn again.
    void reset();

    // Every pass is drawn in the next frame, also where nothing has changed: for those who look at
    // passes while they are drawn. What frames before have left stays as it is.
    void redraw_all();

    // All that the next frame depends on, bit for bit; waits for the GPU.
    std::vector<PassState> state() const;

    // Goes on from a state of the same scene at the same size; passes that this scene does not draw
    // are left out. Throws std::runtime_error, and changes nothing, where a pass is missing or has
    // another shape.
    void set_state(std::span<const PassState> state);

    // The root is drawn next time even if nothing has changed.
    void redraw() { force_root_ = true; }

    // In which format the picture is kept. A change draws it anew; it needs a draw before it is
    // shown.
    void set_picture_format(PixelFormat format);

    // A new size of the picture; buffers keep their content.
    void resize(glm::ivec2 size);

    // Whether anything that is drawn reads them.
    bool reads_mouse() const;
    bool reads_keyboard() const;

    const PassGraph& graph() const { return scene_.graph; }
    const GiveUp& give_up() const { return scene_.give_up; }
    const Buffer& buffer(std::size_t graph_index) const { return *buffers_[graph_index]; }

    // Takes over the size, the buffers of passes of the same name, their simulation clocks and the
    // images, so that a reload loses nothing. Buffers that this scene does not draw are kept for
    // one that does. `previous` may draw again only after it has adopted them back.
    void adopt(Renderer& previous);
    // Makes a buffer that other programs of the same text fill and those here do not, for a
    // renderer of theirs that takes over from this one. False when there is none left to make.
    // Throws std::runtime_error where there is no room for it.
    bool make_ahead(const CompiledScene& other);

    // What it drew, for another one: nothing is drawn here any more.
    CompiledScene take_scene() { return std::move(scene_); }
    const CompiledScene& scene() const { return scene_; }

    // A map is a buffer of a size of its own that follows from the text and the tweaks alone. It is
    // drawn once, and stands in another renderer of a text that says the same of it, too; what
    // constants have drawn is good for fed programs, not the other way round. In the order of the
    // graph.
    std::vector<std::size_t> maps() const;
    // How long, in seconds, one draw may spend on maps: they are drawn in parts from then on, which
    // the picture shows as they come. At 0, as at first, all are drawn whole, for a picture that is
    // right at once.
    void set_map_seconds(double seconds) { map_seconds_ = seconds; }
    // Whether such parts are left for the next draw.
    bool has_maps_left() const { return has_maps_left_; }
    // Whether this is a map that does not stand as a whole, for the same values everywhere.
    bool is_mixed_map(std::size_t graph_index) const;
    // What they hold, one after the other, for a later run; nothing unless each has been drawn with
    // the values of the preset, as constants.
    std::optional<std::vector<std::byte>> map_bytes() const;
    // Takes that back before the first draw of the same texts; false where it has another length.
    bool set_map_bytes(std::span<const std::byte> bytes);

    // Draws a few pixels for nobody with a program for the same preset, reading what it would read:
    // drivers finish compiling inside the first draw.
    void warm_up(const PassProgram& program);

    // Where the driver compiles on the processor inside the first draw, and has not kept what it
    // compiled before: has other threads compile, up to the end of the next draw(), what that has
    // not come to yet. Nothing elsewhere. To be called once the inputs are there. Passes that
    // linked in less than this are not worth a thread, or the driver had them. True where there is
    // such a thread.
    bool compile_ahead(const CompileAhead::WorksOn& works_on = nullptr, double worth_ms = 60.0);
    // Has them compiled now, on this thread too, before anything is drawn. The processor's
    // milliseconds for each (as in graph().passes); none where there is no such thread.
    std::vector<double> finish_compiling();

    // Draws another program for one of the passes into a framebuffer of one's own, of this size in
    // pixels, with all that the pass itself would read: called by before_pass, what it is about to
    // read, and else what stands in the buffers, with this frame. `face` is that of a cube.
    struct Variant {
        const PassProgram& program;
        GLuint framebuffer = 0;
        glm::ivec2 size{0};
        int face = 0;
    };
    void draw_variant(const Variant& variant, const Frame& frame);

    // Where graph().passes has this pass of the scene; their number where it does not.
    std::size_t graph_index(std::size_t pass) const;

    // One output of any pass as RGBA floats, rows bottom up. Waits for the GPU.
    std::vector<float> read_buffer(std::size_t graph_index, std::size_t output) const;

    // One pixel of it.
    glm::vec4 read_pixel(std::size_t graph_index, std::size_t output, glm::ivec2 pixel) const;

    // The wanted pass as RGBA, rows bottom up; `output` chooses among several. Waits for the GPU.
    // `to` is as in glReadPixels: memory, or a place in the pixel buffer that is bound.
    void read_picture(bool floats, void* to) const;
    std::vector<std::byte> read_bytes();
    std::vector<float> read_floats(std::size_t output = 0);
    glm::ivec2 root_size() const;

    // Called round each pass that is drawn, with its index in the graph. For measuring.
    std::function<void(std::size_t)> before_pass, after_pass;
    // Called with the number of pixels of the root that have been drawn, whenever some were waited
    // for. For progress.
    std::function<void(std::int64_t)> after_strip;
    // Seconds spent inside draw calls and on mipmaps, where a software renderer does part of the
    // drawing.
    double draw_call_seconds = 0.0;

private:
    // What one draw of one pass gets.
    struct Inputs {
        const Frame& frame;
        glm::vec2 jitter{0.0f};
        int face = 0;
    };
    // A uniform's value, as words, so that a change is found by comparing.
    struct Value {
        std::array<float, 12> floats{};
        std::array<GLint, 1> ints{};
        bool operator==(const Value&) const = default;
    };
    struct Binding {
        GLuint unit, texture, sampler;
    };
    struct NobodysDraw;
    // What stands in the buffer of a map.
    struct Content {
        std::vector<TweakValue> values;  // it was drawn with these, or some that make it no other
        bool is_exact = true;            // by constants
        bool is_whole = true;            // no part is of other values
        // Drawn here; by somebody else, and not asked for yet; found to hold here, too.
        enum class From { here, offered, held } from = From::here;
    };
    // What a pass was last drawn with. Programs keep their uniforms, so equal values are not sent.
    struct Drawn {
        bool ever = false;
        bool compiled = false;  // to the last: its first draw has been called
        bool is_fed = false;    // with its numbers
        std::vector<std::optional<Value>> builtins;
        std::vector<std::optional<TweakValue>> tweaks;
        std::vector<std::optional<std::size_t>> versions;
        std::optional<Content> content;
        int strip_rows = 32;  // that take about kStripSeconds; the first are a guess
        // Of a map that is drawn in parts: rows from the bottom up that are there, whether it is to
        // be drawn, and whether once more, since something changed on the way.
        int rows = 0;
        bool is_due = false, is_due_again = false;
        double row_seconds = 0.0;  // 0: not known
    };

    void make_buffers(const Renderer* previous);
    bool has_buffer(const std::string& name, const BufferShape& shape) const;
    NobodysDraw nobodys_draw(std::size_t index);
    void compile_by_drawing(const NobodysDraw& draw, std::size_t pixel_bytes) const;
    std::size_t pixel_bytes() const;
    void run(const Frame& frame, bool state_only);
    void run_steps(const Frame& frame, Step step);
    void run_pass(std::size_t index, const Inputs& inputs, bool force = false);
    void run_averaged(const Frame& frame);
    void set_instant(const Frame& frame);
    bool is_kept(std::size_t index) const;
    bool is_map(std::size_t index) const;
    bool is_fed() const;
    bool is_fed(std::size_t index) const;
    bool has_values_of(std::size_t index, const std::vector<TweakValue>& values) const;
    bool holds(std::size_t index);
    bool goes_in_parts(std::size_t index) const;
    bool is_due(std::size_t index, const Frame& frame);
    void draw_maps(const Frame& frame);
    bool draw_rows(std::size_t index, const Frame& frame, const Stopwatch& clock);
    void note_content(std::size_t index);
    void offer_maps();
    std::optional<Content> content_for(const Renderer& next, std::size_t index) const;
    bool says_the_same(std::size_t index, const Renderer& previous, std::size_t there) const;
    bool update_uniforms(std::size_t index, const Inputs& inputs);
    void send_all(const PassProgram& program, std::size_t index, const Inputs& inputs);
    bool update_versions(std::size_t index);
    std::vector<Binding> bindings_of(const PassProgram& program);
    static void bind(const std::vector<Binding>& bindings);
    GLuint texture_of(std::size_t sampler);
    void draw_calls(std::size_t index, GLuint target);
    void draw_strips(std::size_t index, glm::ivec2 size);
    void draw_once(std::size_t index);
    void forget_drawn(std::size_t index);
    glm::ivec2 drawn_size(std::size_t index) const;
    glm::ivec2 mouse_size(const Frame& frame) const {
        return frame.mouse_size == glm::ivec2(0) ? options_.size : frame.mouse_size;
    }
    bool is_tile(std::size_t index) const;
    Value value_of(const BuiltinUniform& uniform, std::size_t index, const Inputs& inputs) const;
    Value channel_value(const BuiltinUniform& uniform, std::size_t pass, double time) const;
    glm::ivec3 channel_size(std::size_t pass, int channel) const;
    float channel_time(std::size_t pass, int channel, double time) const;
    void clear_picture(std::size_t index) const;
    BufferShape wanted_shape(std::size_t index) const { return wanted_shape(scene_, index); }
    BufferShape wanted_shape(const CompiledScene& scene, std::size_t index) const;

    const Preset& preset_;
    std::vector<TweakValue> built_values_, values_;  // those of the constants; now
    CompiledScene scene_;
    RenderOptions options_;
    mutable Channels channels_;
    // A buffer with the clock of the simulation that fills it.
    struct Parked {
        std::unique_ptr<Buffer> buffer;
        long steps_done = 0;
    };
    std::vector<std::unique_ptr<Buffer>> buffers_;  // in the order of the graph
    std::map<std::string, Parked> parked_;          // by pass name: adopted, but not drawn here
    std::vector<Drawn> drawn_;
    std::vector<long> steps_done_;  // in the order of the graph
    std::unique_ptr<Average> average_;
    VertexArray vertex_array_;
    bool force_root_ = false;
    bool root_drawn_ = false;
    double map_seconds_ = 0.0;
    std::size_t map_at_ = 0;  // whose turn it is; all have theirs, however fast a tweak moves
    bool has_maps_left_ = false;
    const Frame* drawing_ = nullptr;  // within before_pass: the frame, or step of a simulation
    // The tile that is drawn, and where in it the one that was asked for begins: quads of four
    // pixels, in which derivatives are taken, stand where they stand in the whole picture.
    glm::ivec2 tile_origin_{0}, tile_size_{0}, tile_margin_{0};
    std::unique_ptr<CompileAhead> ahead_;  // the last member: its threads use others
};

}  // namespace glint
