// A scene: one GLSL file, read into plain data that says what it declares. No GL here.
#pragma once

#include "base/diagnostic.h"
#include "base/names.h"
#include "glsl/raw_text.h"
#include "scene/pixel_format.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

enum class TweakType { float1, int1, bool1, vec2, vec3, vec4 };
inline constexpr Names<TweakType, 6> kTweakTypeNames = {{{TweakType::float1, "float"},
                                                         {TweakType::int1, "int"},
                                                         {TweakType::bool1, "bool"},
                                                         {TweakType::vec2, "vec2"},
                                                         {TweakType::vec3, "vec3"},
                                                         {TweakType::vec4, "vec4"}}};

// Components in order; those beyond the type's count are 0. Bools are 0 or 1, menus the index of
// the name.
using TweakValue = std::array<double, 4>;

// A uniform that a person moves: `uniform float choppiness; //@ 0.6 [0, 1] log unit=1/m
// "steepness"`.
struct Tweak {
    std::string name;
    TweakType type = TweakType::float1;
    TweakValue initial{};            // the default
    std::optional<double> min, max;  // both or neither; every component lies between them
    // Where the scene promises to be sound; `glint check` judges nothing beyond it.
    std::optional<std::array<double, 2>> safe;
    std::vector<std::string> names;  // of a menu; empty otherwise
    bool is_colour = false;          // the default was written "#rrggbb" or "#rrggbbaa"
    bool log = false;                // the slider is logarithmic
    double step = 0.0;               // the slider's granularity; 0 is continuous
    bool quality = false;            // trades error for time
    bool no_random = false;          // a random look leaves it alone
    // The value that counts as the truth. It may lie beyond the range: nobody moves a slider there.
    std::optional<TweakValue> reference;
    // What else counts as the truth, "area" or "march=steps"; see turned_values. "": nothing does.
    std::string second;
    std::string unit, group, description;
    Place place;
    // `uniform … ;` in Scene::text, which specialisation replaces by a constant: several where tabs
    // declare it alike.
    std::vector<Span> declarations;
};

// The number of components of a tweak's value: 1 to 4.
int component_count(TweakType type);

inline const char* glsl_name(TweakType type) {  // as GLSL spells it
    return kTweakTypeNames.of(type);
}

// What a value of this tweak looks like, for a message: "a number from 0 to 1", "off, screen-space
// or traced".
std::string expected_value(const Tweak& tweak);

// A value moved into the tweak's range; integers, menus and bools are rounded too. What is not
// a number becomes the default.
TweakValue clamp_to_range(const Tweak& tweak, TweakValue value);

// A value as a person types it: "0.6", "3", "on", "screen-space", "#0b3a53", "0.1,0.2,0.3". Nothing
// if it is not of the type, or not finite. The range is not asked; see clamp_to_range.
std::optional<TweakValue> parse_value(const Tweak& tweak, std::string_view text);

// The inverse of parse_value; parse_value(tweak, format_value(tweak, v)) gives v.
std::string format_value(const Tweak& tweak, const TweakValue& value);

// A list of "VALUE" or "NAME=VALUE" with commas, as `second=` takes it: a value of this tweak, or
// of another. Where it is none, `wrong` says why.
struct Turned {
    std::size_t tweak = 0;  // of the list
    TweakValue value{};
};
std::vector<Turned> turned_values(const std::vector<Tweak>& tweaks, const Tweak& own,
                                  std::string_view list, std::string& wrong);

enum class SamplerType { sampler2D, samplerCube, sampler3D };
inline constexpr Names<SamplerType, 3> kSamplerTypeNames = {
    {{SamplerType::sampler2D, "sampler2D"},
     {SamplerType::samplerCube, "samplerCube"},
     {SamplerType::sampler3D, "sampler3D"}}};
constexpr std::size_t kCubeFaces = 6;

inline const char* glsl_name(SamplerType type) {  // as GLSL spells it
    return kSamplerTypeNames.of(type);
}

enum class Filter { nearest, linear, mipmap };
enum class Wrap { clamp, repeat, mirror };

// As annotations, presets and results spell them.
inline constexpr Names<Filter, 3> kFilterNames = {
    {{Filter::nearest, "nearest"}, {Filter::linear, "linear"}, {Filter::mipmap, "mipmap"}}};
inline constexpr Names<Wrap, 3> kWrapNames = {
    {{Wrap::clamp, "clamp"}, {Wrap::repeat, "repeat"}, {Wrap::mirror, "mirror"}}};

// Who fills what a sampler reads.
enum class Source { none, buffer, image, cube, volume, sound, noise, keyboard };

// One `uniform sampler…`, or one iChannel of a preset. Filter and wrap belong to the reader, not to
// the texture.
struct Sampler {
    std::string name;
    // The pass that alone has it, where it is declared within `#ifdef PASS_x`; empty: all have it.
    std::string tab;
    SamplerType type = SamplerType::sampler2D;
    Source source = Source::none;  // none reads 0
    Filter filter = Filter::linear;
    Wrap wrap = Wrap::clamp;
    bool vflip = true;       // images: the first row of the file is the top of the picture;
                             // cubes: the world stands on its head
    std::size_t pass = 0;    // buffer: index into Scene::passes
    std::size_t output = 0;  // buffer: which `out` parameter of that pass
    // What an image, a cube, a volume or a sound is read from, resolved against the file that names
    // it: one file, or the six faces +X -X +Y -Y +Z -Z of a cube.
    std::vector<std::filesystem::path> files;
    int noise_channels = 4;    // noise: 1 to 4
    glm::ivec3 noise_size{0};  // noise: pixels; z is 1 for sampler2D
    bool plays = false;        // noise: its iChannelTime runs with iTime, as a sound's does
    // buffer: what its values keep to, which `glint check` looks after. The sum of the first
    // component stays what it was, to this share of the sum of magnitudes.
    std::optional<double> conserves;
    std::optional<std::array<double, 2>> bounded;  // every component lies between these
    Place place;
};

// A step length as it was written, exact: seconds = numerator / denominator. Zero numerator: once a
// frame.
struct Step {
    long numerator = 0, denominator = 1;
    double seconds() const {
        return static_cast<double>(numerator) / static_cast<double>(denominator);
    }
    explicit operator bool() const { return numerator != 0; }
    bool operator==(const Step&) const = default;
};

// One full-screen draw into a buffer. The picture itself is not in the list; it runs after all of
// these.
struct Pass {
    std::string name;  // of the first sampler that reads it
    // mainWaves; of a tab, which has no function of that name, mainImage (a cube: mainCubemap).
    std::string entry;
    std::vector<std::string>
        outputs;                     // sampler names, in the order of the entry's `out` parameters
    std::optional<glm::ivec2> size;  // pixels; unset: the picture's size times `scale`
    double scale = 1.0;
    PixelFormat format = PixelFormat::rgba32f;
    bool cube = false;  // six faces through mainCubemap's signature
    Step step;
    Place place;
};

struct Scene {
    std::vector<std::filesystem::path>
        files;  // the scene file first, then its includes: what a reload watches
    // The whole text, includes expanded, ready to follow the prologue: `#version`, `#line` and the
    // host's own uniforms are blanked in place, so that every remaining character keeps its line
    // and column.
    std::string text;
    std::vector<Origin> origins;    // one for each line of `text`
    std::vector<Tweak> tweaks;      // in the order of the file
    std::vector<Sampler> samplers;  // declared in the file, in order
    std::vector<Pass> passes;       // in drawing order
    // Where the text declares iChannel0..3 and does not say what fills them: as what.
    std::array<std::optional<SamplerType>, 4> channel_types{};
    std::string image_entry = "mainImage";  // or "main", which writes gl_FragColor
    bool has_sound = false;                 // defines mainSound

    // The user's place of a line (from 1) and column of `text`.
    Place place(int line, int column) const;
    // That of a byte of `text`.
    Place place_at(std::size_t offset) const;
};

struct ReadScene {
    std::optional<Scene> scene;  // empty when there are errors
    Diagnostics diagnostics;
    // Every text that was read or asked for, also when there are errors: what a reload watches.
    std::vector<std::filesystem::path> files;
    // These, and the pictures and sounds that it names.
    std::vector<std::filesystem::path> named{};
};

// Reads a scene file and its includes, or a .json that holds a shader of the site. Never throws for
// what the file says.
ReadScene read_scene(const std::filesystem::path& file);

// Of the files that a scene names, those that stand outside this folder or lead out of it; also
// when there are errors, which somebody may mend.
std::vector<std::filesystem::path> files_outside(const ReadScene& read,
                                                 const std::filesystem::path& folder);

}  // namespace glint
