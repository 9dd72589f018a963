// A shader of the site as a scene file.
#include "base/words.h"
#include "glsl/raw_text.h"
#include "glsl/reading.h"
#include "scene/annotation.h"
#include "scene/scene.h"
#include "scene/scene_text.h"
#include "scene/shadertoy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;

// The site's own textures by the start of their file names. Their sizes stand in shaders as
// numbers.
struct Medium {
    std::string_view hash, name, noise;
};
constexpr std::array<Medium, 30> kMedia = {
    {{"52d2a8f514c4fd2d", "Abstract 1", "rgb 512"},
     {"bd6464771e47eed8", "Abstract 2", "rgb 512"},
     {"8979352a182bde7c", "Abstract 3", "rgb 512"},
     {"85a6d68622b36995", "Bayer", "r 8"},
     {"cb49c003b454385a", "Blue Noise", "rgba 1024"},
     {"08b42b43ae9d3c06", "Font 1", "rgba 1024"},
     {"0c7bf5fe9462d5bf", "Gray Noise Medium", "r 256"},
     {"0a40562379b63dfb", "Gray Noise Small", "r 64"},
     {"fb918796edc3d222", "Lichen", "rgb 1024"},
     {"8de3a3924cb95bd0", "London", "rgb 512"},
     {"cbcbb5a6cfb55c36", "Nyancat", "rgba 256x32"},
     {"cd4c518bc6ef165c", "Organic 1", "rgb 1024"},
     {"92d7758c402f0927", "Organic 2", "rgb 1024"},
     {"79520a3d3a0f4d3c", "Organic 3", "rgb 1024"},
     {"3871e838723dd6b1", "Organic 4", "rgb 1024"},
     {"ad56fba948dfba9a", "Pebbles", "r 512"},
     {"f735bee5b64ef988", "RGBA Noise Medium", "rgba 256"},
     {"3083c722c0c738ca", "RGBA Noise Small", "rgba 64"},
     {"10eb4fe0ac8a7dc3", "Rock Tiles", "rgb 512"},
     {"95b90082f799f486", "Rusty Metal", "rgb 512"},
     {"e6e5631ce1237ae4", "Stars", "rgb 512"},
     {"1f7dca9c22f32475", "Wood", "rgb 512"},
     {"94284d43be78f00e", "Forest", "rgb 256"},
     {"0681c014f6c88c35", "Forest Blurred", "rgb 64"},
     {"488bd40303a2e2b9", "St. Peter's Basilica", "rgb 256"},
     {"550a8cce1bf40386", "St. Peter's Blurred", "rgb 64"},
     {"585f9546c092f53d", "Uffizi Gallery", "rgb 512"},
     {"793a105653fbdada", "Uffizi Gallery Blurred", "rgb 64"},
     {"27012b4eadd0c3ce", "Gray Noise 3D", "r 32"},
     {"aea6b99da1d53055", "RGBA Noise 3D", "rgba 32"}}};

std::string stem(const std::string& file) {
    return fs::path(file).stem().string();
}

const Medium* find_medium(const std::string& file) {
    const std::string name = stem(file);
    for (const Medium& medium : kMedia)
        if (name.starts_with(medium.hash)) return &medium;
    return nullptr;
}

bool is_music(const ShadertoyInput& input) {
    return input.kind.starts_with("music");
}

// What has a time of its own, so that its iChannelTime runs.
bool plays(const ShadertoyInput& input) {
    return is_music(input) || input.kind == "video";
}

// Noise that stands in for what the site does not ship.
std::string stand_in(const ShadertoyInput& input) {
    if (const Medium* medium = find_medium(input.file))
        return fmt::format("noise {}", medium->noise);
    if (input.kind == "volume") return "noise r 32";
    if (input.kind == "cubemap") return "noise rgb 64";
    if (input.kind == "webcam") return "noise rgb 640x360";
    if (input.kind == "video") return "noise rgb 640x360 plays=on";
    if (is_music(input)) return "noise r 512x2 plays=on";
    if (input.kind == "mic") return "noise r 512x2";
    return "noise rgba 512";
}

// As what an input is declared.
Sampler read_by(const ShadertoyInput& input) {
    Sampler sampler;
    sampler.type = input.kind == "cubemap"  ? SamplerType::samplerCube
                   : input.kind == "volume" ? SamplerType::sampler3D
                                            : SamplerType::sampler2D;
    return sampler;
}

// How the site reads an input of which its file says nothing.
Sampler defaults_there(const ShadertoyInput& input) {
    const bool is_picture =
        input.buffer.empty() &&
        (input.kind == "texture" || input.kind == "cubemap" || input.kind == "volume");
    Sampler sampler = read_by(input);
    set_defaults(sampler, input.kind == "keyboard" ? Source::keyboard
                          : is_picture             ? Source::image
                                                   : Source::buffer);
    return sampler;
}

// Only what is not the default of this source anyway, so that the line stays short.
std::string options_of(const ShadertoyInput& input, const std::string& source) {
    Sampler here = read_by(input);
    set_defaults(here, source.starts_with("noise")      ? Source::noise
                       : source.starts_with("keyboard") ? Source::keyboard
                       : source.starts_with("buffer") || source.starts_with("sound")
                           ? Source::buffer
                           : Source::image);
    const Sampler there = defaults_there(input);
    const Filter filter = kFilterNames.find(input.filter).value_or(there.filter);
    const Wrap wrap = input.wrap == "clamp"    ? Wrap::clamp
                      : input.wrap == "repeat" ? Wrap::repeat
                                               : there.wrap;
    std::string options;
    if (filter != here.filter) options += fmt::format(" filter={}", kFilterNames.of(filter));
    if (wrap != here.wrap) options += fmt::format(" wrap={}", kWrapNames.of(wrap));
    return options;
}

// A line of a comment: no line end in it, and no backslash that would join it with the next.
std::string comment_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\\') c = ' ';
    return std::string(trimmed(text));
}

// What the pass that fills this buffer is called.
std::string filling_function(const std::string& buffer) {
    return "main" + std::string(1, static_cast<char>(buffer[0] - 'a' + 'A')) + buffer.substr(1);
}

// A text may use the names that buffers and their passes get here for something of its own.
Shadertoy with_free_names(Shadertoy shader) {
    std::vector<Reading> texts;
    for (const ShadertoyTab& tab : shader.tabs)
        texts.push_back(read_glsl(tab.code, known_of_scene()));
    const auto is_used = [&](const std::string& name) {
        return std::ranges::any_of(texts, [&](const Reading& text) { return text.mentions(name); });
    };
    for (const char* name : {"bufferA", "bufferB", "bufferC", "bufferD", "cubeA"}) {
        const bool is_there =
            std::ranges::find(shader.tabs, name, &ShadertoyTab::name) != shader.tabs.end();
        if (!is_there || (!is_used(name) && !is_used(filling_function(name)))) continue;
        const std::string free = std::string(name) + "Tab";
        for (ShadertoyTab& tab : shader.tabs) {
            if (tab.name == name) tab.name = free;
            for (ShadertoyInput& input : tab.inputs)
                if (input.buffer == name) input.buffer = free;
        }
    }
    return shader;
}

bool is_cube(const ShadertoyTab& tab) {
    return tab.name.starts_with("cubeA");
}

class Writer {
public:
    Writer(Shadertoy shader, const fs::path& from, const fs::path& folder, Diagnostics& diagnostics,
           bool anywhere)
        : shader_(std::move(shader)),
          from_(from),
          folder_(folder),
          diagnostics_(diagnostics),
          anywhere_(anywhere) {}

    std::string text();

private:
    void write_header();
    void write_passes();
    void write_inputs();
    bool is_never_drawn(const ShadertoyInput& input) const;
    void write_input(const ShadertoyTab& tab, const ShadertoyInput& input);
    void write_tab(const ShadertoyTab& tab);
    std::string source_of(const ShadertoyTab& tab, const ShadertoyInput& input);
    std::string file_beside(const ShadertoyInput& input);
    std::string with_includes_named(const std::string& code);
    std::string quoted(const fs::path& file) const;
    bool may_read(const fs::path& file);
    std::optional<std::string> other_faces(const fs::path& first,
                                           const std::vector<std::string>& names);
    std::string what_is_missing(const ShadertoyInput& input) const;
    bool is_alone(const ShadertoyTab& tab) const;
    void warn(const std::string& text) {
        diagnostics_.push_back({Severity::warning, {from_.string()}, text});
    }

    const Shadertoy shader_;
    const fs::path& from_;
    const fs::path& folder_;
    Diagnostics& diagnostics_;
    bool anywhere_;
    bool leaves_ = false;  // a file of the input that was looked for last is there, but outside
    std::string text_;
};

std::string Writer::text() {
    write_header();
    write_passes();
    write_inputs();
    for (const ShadertoyTab& tab : shader_.tabs) write_tab(tab);
    return std::move(text_);
}

void Writer::write_header() {
    const std::string title = comment_line(shader_.title);
    const std::string author = comment_line(shader_.author);
    if (!title.empty())
        text_ += fmt::format("// {}{}\n", title, author.empty() ? "" : ", by " + author);
    if (!shader_.id.empty())
        text_ += fmt::format("// https://www.shadertoy.com/view/{}\n", comment_line(shader_.id));
    for (std::size_t begin = 0; begin < shader_.description.size();) {
        const std::size_t end =
            std::min(shader_.description.find('\n', begin), shader_.description.size());
        const std::string line = comment_line(shader_.description.substr(begin, end - begin));
        text_ += line.empty() ? "//\n" : fmt::format("// {}\n", line);
        begin = end + 1;
    }
    if (!text_.empty()) text_ += '\n';
}

void Writer::write_passes() {
    for (const ShadertoyTab& tab : shader_.tabs) {
        if (!tab.name.starts_with("buffer") && !is_cube(tab)) continue;
        text_ +=
            fmt::format("uniform {} {};  //@ pass {}\n", is_cube(tab) ? "samplerCube" : "sampler2D",
                        tab.name, filling_function(tab.name));
    }
}

// Nothing but the image and what all tabs share: no #ifdef is needed.
bool Writer::is_alone(const ShadertoyTab& tab) const {
    return tab.name == "image" && std::ranges::all_of(shader_.tabs, [](const ShadertoyTab& other) {
               return other.name == "image" || other.name == "common";
           });
}

// Before any code: what all tabs share may read a channel too.
void Writer::write_inputs() {
    for (const ShadertoyTab& tab : shader_.tabs) {
        if (tab.inputs.empty() || tab.name == "common") continue;
        if (!is_alone(tab)) text_ += fmt::format("#ifdef PASS_{}\n", tab.name);
        for (int channel = 0; channel < 4; ++channel) {
            const auto input = std::ranges::find(tab.inputs, channel, &ShadertoyInput::channel);
            if (input != tab.inputs.end()) write_input(tab, *input);
        }
        if (!is_alone(tab)) text_ += "#endif\n";
    }
}

// The site has all of its buffers, and one without a tab is black.
bool Writer::is_never_drawn(const ShadertoyInput& input) const {
    return !input.buffer.empty() &&
           std::ranges::find(shader_.tabs, input.buffer, &ShadertoyTab::name) == shader_.tabs.end();
}

void Writer::write_input(const ShadertoyTab& tab, const ShadertoyInput& input) {
    if (is_never_drawn(input)) {
        warn(fmt::format("{}, iChannel{}: {} is not in this {}; it is black", tab.name,
                         input.channel, in_quotes(input.buffer),
                         from_.has_filename() ? "file" : "folder"));
        if (input.buffer.starts_with("cube"))
            text_ += fmt::format("uniform samplerCube iChannel{};\n", input.channel);
        return;
    }
    const std::string source = source_of(tab, input);
    text_ += fmt::format("uniform {} iChannel{};  //@ {}{}\n", glsl_name(read_by(input).type),
                         input.channel, source, options_of(input, source));
}

std::string Writer::source_of(const ShadertoyTab& tab, const ShadertoyInput& input) {
    if (input.kind == "keyboard") return "keyboard";
    if (!input.buffer.empty()) return "buffer " + input.buffer;
    if (const std::string file = file_beside(input); !file.empty()) return file;
    Sampler noise = read_by(input);
    if (input.file.starts_with("noise ") && parse_noise(input.file.substr(6), noise).empty())
        return input.file + (plays(input) ? " plays=on" : "");  // written by our own export
    const std::string instead = stand_in(input);
    warn(fmt::format("{}, iChannel{}: {}; {} stands in its place{}", tab.name, input.channel,
                     what_is_missing(input), instead,
                     leaves_                  ? ", and --anywhere takes it"
                     : input.kind == "webcam" ? "; a picture of yours does with //@ image FILE"
                     : input.kind == "mic"    ? "; a sound of yours does with //@ sound FILE"
                                              : ""));
    return instead;
}

std::string Writer::what_is_missing(const ShadertoyInput& input) const {
    if (input.kind == "webcam") return "no camera is read here";
    if (input.kind == "mic") return "no microphone is read here";
    const Medium* medium = find_medium(input.file);
    const std::string what = !input.faces.empty() ? fmt::format("{}", fmt::join(input.faces, ", "))
                             : medium             ? std::string(medium->name)
                             : input.file.empty() ? input.kind
                                                  : input.file;
    return fmt::format("{}{} is {}", input.faces.empty() ? "" : "one of ", in_quotes(what),
                       leaves_ ? "outside this file's folder" : "not in this file");
}

// Whether an annotation can name it, between quotes and on one line.
static bool can_be_quoted(const fs::path& file) {
    return std::ranges::none_of(file.string(), [](char c) {
        return c == '"' || static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    });
}

// A stranger's file names only what came with it.
bool Writer::may_read(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    const bool may = anywhere_ || is_within(file, from_.parent_path());
    leaves_ |= !may;
    return may;
}

// As it is called from where the scene is written.
std::string Writer::quoted(const fs::path& file) const {
    std::error_code error;
    const fs::path near = fs::proximate(file, folder_.empty() ? "." : folder_, error);
    return fmt::format("\"{}\"", near.generic_string());
}

// What stands behind a cube's first file: the other five, or nothing, where that one is the whole
// cube. The site's are NAME.png, and NAME_1.png to NAME_5.png; our export names six, and none does
// without the others.
std::optional<std::string> Writer::other_faces(const fs::path& first,
                                               const std::vector<std::string>& names) {
    const bool named = names.size() == kCubeFaces;
    std::string text;
    for (std::size_t face = 1; face < kCubeFaces; ++face) {
        const std::string name =
            named ? fs::path(names[face]).filename().string()
                  : fmt::format("{}_{}{}", first.stem().string(), face, first.extension().string());
        const fs::path other = first.parent_path() / name;
        if (!may_read(other) || !can_be_quoted(other))
            return named ? std::nullopt : std::optional("");
        text += " " + quoted(other);
    }
    return text;
}

// What reads this input from the files of its name beside the JSON, or under the site's own folders
// there; empty when there are none.
std::string Writer::file_beside(const ShadertoyInput& input) {
    leaves_ = false;
    const char* source = input.kind == "texture"   ? "image"
                         : input.kind == "cubemap" ? "cube"
                         : input.kind == "volume"  ? "volume"
                         : is_music(input)         ? "sound"
                                                   : "";
    const fs::path file = fs::path(input.file).relative_path();
    if (!*source || !file.has_filename()) return {};
    std::error_code error;
    for (const fs::path& local :
         {from_.parent_path() / file, from_.parent_path() / file.filename()}) {
        if (!may_read(local) || !can_be_quoted(local)) continue;
        std::string text = source + (" " + quoted(local));
        if (input.kind == "cubemap") {
            const auto others = other_faces(local, input.faces);
            if (!others) continue;
            text += *others;
        }
        const bool usual = input.kind != "cubemap";
        if ((input.kind == "texture" || input.kind == "cubemap") &&
            input.vflip.value_or(usual) != usual)
            text += usual ? " vflip=off" : " vflip=on";
        return text;
    }
    return {};
}

// The files that it includes stand beside the tabs, and not beside what is written.
std::string Writer::with_includes_named(const std::string& code) {
    static const std::regex include(R"re((#[ \t]*include[ \t]+)"([^"\n]{1,200})")re");
    std::string named;
    auto behind = code.cbegin();
    for (std::sregex_iterator match(code.begin(), code.end(), include), end; match != end;
         ++match) {
        const fs::path file = from_.parent_path() / (*match)[2].str();
        const bool is_there = may_read(file) && can_be_quoted(file);
        named.append(behind, (*match)[0].first);
        named += is_there ? (*match)[1].str() + quoted(file) : (*match)[0].str();
        behind = (*match)[0].second;
    }
    return named.append(behind, code.cend());
}

void Writer::write_tab(const ShadertoyTab& tab) {
    const std::string code = with_includes_named(clean_text(tab.code).text);
    if (tab.name == "common" || is_alone(tab)) {
        text_ += '\n' + code;
        return;
    }
    // A backslash joins the next line to a comment's.
    const char* const gap = code.ends_with("\\\n") ? "\n" : "";
    text_ += fmt::format("\n#ifdef PASS_{}\n{}{}#endif  // {}\n", tab.name, code, gap, tab.name);
}

}  // namespace

std::string scene_text(const Shadertoy& shader, const fs::path& from, const fs::path& folder,
                       Diagnostics& diagnostics, bool anywhere) {
    return Writer(with_free_names(shader), from, folder, diagnostics, anywhere).text();
}

SourceText imported_source(const fs::path& json, Diagnostics& diagnostics) {
    const std::vector<Shadertoy> shaders = read_shadertoys(json, diagnostics);
    const auto scene = fs::path(json).replace_extension(".frag");
    if (shaders.empty()) {
        SourceText nothing;
        nothing.files = {json, scene};
        return nothing;
    }
    if (shaders.size() > 1) {
        diagnostics.push_back(
            {Severity::warning,
             {json.string()},
             fmt::format("it holds {} shaders, and this is the first; `glint import` writes a "
                         "scene file for each",
                         shaders.size())});
    }
    const std::string text = scene_text(shaders.front(), json, scene.parent_path(), diagnostics);
    return made_source(scene, json, text, known_of_scene(), diagnostics);
}

void refuse_outside(const fs::path& json, ReadScene& read) {
    const auto outside = files_outside(read, json.parent_path());
    if (outside.empty()) return;
    read.diagnostics.push_back(
        {Severity::error,
         {json.string()},
         fmt::format("its code names {}, which is outside its folder; `glint import --anywhere` "
                     "makes a scene of it",
                     in_quotes(outside.front().string())),
         true});
}

}  // namespace glint
