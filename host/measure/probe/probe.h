// A pass whose text tells what happens in it, compiled beside the plain one and asked at pixels.
//
// What a window, or anybody with a renderer, calls:
//
//     Probe probe(preset, pass, {.specialise = true}, {});     // compiles; throws ProbeRefused
//     renderer.before_pass = [&](std::size_t index) {          // the exact inputs of the frame;
//         if (index == probe.index_in(renderer))               // afterwards only where the pass
//             values = probe.values_at(renderer, frame, place);  // reads nothing of frames before
//     };
//     renderer.draw(frame);
//
// `values` are rows of measure/rows/probe.h. A Probe may be compiled in another process first, to
// warm the driver's cache, and holds for any pixel, frame, and, where it is not specialised, for
// any values of the tweaks. A ProbeWish of some lines (`only`) compiles as fast as the pass.
#pragma once

#include "measure/rows/probe.h"
#include "render/compile_watch.h"
#include "render/renderer.h"

#include <optional>
#include <stdexcept>
#include <vector>

namespace glint {

// It could not be compiled, or the expression is none: a whole sentence.
struct ProbeRefused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct ProbePlace {
    glm::ivec2 pixel{0};  // of the pass's buffer, from the bottom left
    int face = 0;         // of a cube
};

// What one fragment keeps: see glsl/probe.h.
struct ProbeCell {
    std::array<std::uint32_t, 4> kept{}, told{};
    std::array<float, 4> colour{};  // the pass's first output
};

// Where a fragment's answers are drawn.
class ProbeTarget {
public:
    ProbeTarget(glm::ivec2 size, std::size_t outputs);
    GLuint id() const { return framebuffer_.id(); }
    glm::ivec2 size() const { return size_; }
    std::vector<ProbeCell> read() const;  // rows bottom up; waits for the GPU

private:
    glm::ivec2 size_;
    std::size_t outputs_;
    std::vector<Texture> textures_;
    Framebuffer framebuffer_;
};

class Probe {
public:
    // What the driver does not take is left out, and listed in notes(). `preset` must outlive this.
    // `give_up` hears of a text that the driver would never finish, be it at the first question.
    Probe(const Preset& preset, std::size_t pass, ProgramOptions options, ProbeWish wish,
          GiveUp give_up = nullptr);

    const Probed& probed() const { return probed_; }
    std::vector<std::string> notes() const;
    std::size_t index_in(const Renderer& renderer) const;

    // The last value at each site that was reached, in the order of the text; how often each was
    // goes to `hits`.
    std::vector<ProbeValue> values_at(Renderer& renderer, const Frame& frame,
                                      const ProbePlace& place,
                                      std::vector<std::uint32_t>* hits = nullptr);
    // Every value of every site, in the order in which they came, up to `most` of each.
    std::vector<ProbeValue> hits_at(Renderer& renderer, const Frame& frame, const ProbePlace& place,
                                    int most);
    // How often each site was reached.
    std::vector<std::uint32_t> hits_of_sites(Renderer& renderer, const Frame& frame,
                                             const ProbePlace& place);
    // One site's value in every pixel, rows bottom up; hit 0: the last.
    std::vector<ProbeCell> map(Renderer& renderer, const Frame& frame, std::size_t site, int hit,
                               int face = 0);
    // Of ProbeKind::faults: every pixel's, each watching another site, from `first` on; `mend`, 1
    // to kMends: what is undefined gets a result all the same, a usual, a small, a large or a
    // negative one. See probe_declarations.
    static constexpr int kMends = 4;
    std::vector<ProbeCell> survey(Renderer& renderer, const Frame& frame, int first, int mend,
                                  int face = 0);
    // Of ProbeKind::rounding: what is drawn where results of a site, or of those that these stand
    // for, are rounded by chance.
    static constexpr int kEverySite = -1, kNoSite = -2, kPixelsMoved = -3;
    std::vector<ProbeCell> rounded(Renderer& renderer, const Frame& frame, int site, int seed);
    // The colour that the last question at a pixel drew there.
    const std::array<float, 4>& colour() const { return colour_; }
    // Whether that pixel was discarded, which then tells nothing.
    bool is_discarded() const { return is_discarded_; }

    // A site as a row, with no value yet.
    ProbeValue row(std::size_t site) const;

private:
    struct Ask {
        int site = 0, hit = 0, site_step = 0, hit_step = 0;
        int count = 1;
    };
    void compile(const ProgramOptions& options, ProbeWish& wish);
    std::vector<ProbeCell> ask(Renderer& renderer, const Frame& frame, const ProbePlace& place,
                               const Ask& ask);
    void draw(Renderer& renderer, const Frame& frame, const ProbeTarget& target, const Ask& ask,
              glm::ivec4 place, int face);
    void add_leaves(Renderer& renderer, const Frame& frame, const ProbePlace& place,
                    std::size_t site, const Ask& like, std::uint32_t tag,
                    std::vector<ProbeValue>& rows);

    const Preset& preset_;
    std::size_t pass_, outputs_;
    GiveUp give_up_;
    bool is_drawn_ = false;
    Probed probed_;
    std::optional<PassProgram> program_;
    GLint ask_location_ = -1, place_location_ = -1;
    std::array<float, 4> colour_{};
    bool is_discarded_ = false;
};

// What a cell has kept, by its tag.
std::vector<double> value_of(const ProbeCell& cell);

// "bits", "bytes", or what differs, of a colour as the plain program left it in a buffer of this
// format and as the instrumented one drew it.
std::string same_colour(const glm::vec4& plain, const std::array<float, 4>& probed,
                        PixelFormat format);

}  // namespace glint
