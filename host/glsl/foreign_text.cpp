// VS Code's Shader Toy as a scene of ours.
#include "glsl/foreign_text.h"

#include "base/words.h"
#include "glsl/foreign_file.h"
#include "glsl/raw_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

// JavaScript's key codes under the names that the texts use.
const std::vector<std::pair<std::string, int>>& key_codes() {
    static const auto kCodes = [] {
        std::vector<std::pair<std::string, int>> codes = {
            {"Backspace", 8},   {"Tab", 9},           {"Enter", 13},     {"Shift", 16},
            {"Ctrl", 17},       {"Alt", 18},          {"Pause", 19},     {"Caps", 20},
            {"Escape", 27},     {"Space", 32},        {"PageUp", 33},    {"PageDown", 34},
            {"End", 35},        {"Home", 36},         {"LeftArrow", 37}, {"UpArrow", 38},
            {"RightArrow", 39}, {"DownArrow", 40},    {"Insert", 45},    {"Delete", 46},
            {"SemiColon", 186}, {"Equal", 187},       {"Comma", 188},    {"Dash", 189},
            {"Period", 190},    {"ForwardSlash", 191}};
        for (char c = '0'; c <= '9'; ++c) codes.emplace_back(std::string(1, c), c);
        for (char c = 'A'; c <= 'Z'; ++c) codes.emplace_back(std::string(1, c), c);
        for (int i = 1; i <= 12; ++i) codes.emplace_back(fmt::format("F{}", i), 111 + i);
        return codes;
    }();
    return kCodes;
}

// The buffer that remembers which keys were held.
constexpr const char* kKeyStates = "glintKeyStates";

std::string without_scheme(const std::string& source) {
    return source.starts_with("file://") ? source.substr(7) : source;
}

bool is_shader(const std::string& source) {
    const std::string extension = fs::path(source).extension().string();
    return extension == ".glsl" || extension == ".frag" || extension == ".fs" ||
           extension == ".shader";
}

fs::path path_of(const fs::path& file, const std::string& source) {
    return (file.parent_path() / without_scheme(source)).lexically_normal();
}

bool is_sound(const std::string& source) {
    const std::string extension = fs::path(source).extension().string();
    return extension == ".mp3" || extension == ".wav" || extension == ".ogg" ||
           extension == ".flac";
}

// The six files of `sky_{}.jpg` as they are there: sky_px.jpg and so on, in quotes, each behind a
// space. Empty when they are not all there.
std::string face_names(const fs::path& file, const std::string& source) {
    using FaceNames = std::array<const char*, 6>;  // +X -X +Y -Y +Z -Z
    constexpr std::array<FaceNames, 4> kSpellings = {
        {{"e", "w", "u", "d", "n", "s"},
         {"east", "west", "up", "down", "north", "south"},
         {"px", "nx", "py", "ny", "pz", "nz"},
         {"posx", "negx", "posy", "negy", "posz", "negz"}}};
    const std::string pattern = without_scheme(source);
    const std::size_t at = pattern.find("{}");
    if (at == std::string::npos) return {};
    for (const FaceNames& names : kSpellings) {
        std::string list;
        const bool all = std::ranges::all_of(names, [&](const char* name) {
            const std::string face = std::string(pattern).replace(at, 2, name);
            list += fmt::format(" \"{}\"", face);
            std::error_code error;
            return fs::is_regular_file(file.parent_path() / face, error);
        });
        if (all) return list;
    }
    return {};
}

// A name for the buffer that a file fills, unlike the functions that the file may have.
std::string buffer_name(const fs::path& file) {
    std::string name = file.stem().string();
    for (char& c : name)
        if (!(c >= 'a' && c <= 'z') && !(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9')) c = 'X';
    if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name.insert(0, "b");
    return name + "Buffer";
}

class Rewriter {
public:
    Rewriter(fs::path file, std::string_view text, const Known& known, Diagnostics& diagnostics)
        : file_(std::move(file)),
          known_(known),
          text_(text, known),
          channels_(text_.channels()),
          diagnostics_(diagnostics) {}

    ForeignText root();
    ForeignText part(const std::string& own_buffer);

private:
    bool reads_itself() const;
    void add(std::string line, int number);
    void add_buffers(const fs::path& file, const ForeignChannels& channels, int line,
                     std::set<fs::path>& known);
    void add_text(const std::string& own_buffer);
    void add_uniform(const Directive& directive, int number);
    void add_uniform(const ForeignUniform& uniform, int number);
    void add_integers(const ForeignUniform& uniform, int number);
    void add_channel(std::size_t index, const std::string& own_buffer);
    void add_keyboard(int number);
    void add_nothing(const Directive& channel, int number);
    void add_key_states();
    std::string source_of(const ForeignChannel& channel, const std::string& own_buffer);
    std::string options_of(const ForeignChannel& channel);
    void error(int line, std::string text) {
        diagnostics_.push_back({Severity::error, {file_.string(), line, 1}, std::move(text)});
    }
    void warning(int line, std::string text) {
        diagnostics_.push_back({Severity::warning, {file_.string(), line, 1}, std::move(text)});
    }

    fs::path file_;
    const Known& known_;
    ForeignFile text_;
    ForeignChannels channels_;
    Diagnostics& diagnostics_;
    ForeignText result_;
    bool asks_for_releases_ = false;
};

void Rewriter::add(std::string line, int number) {
    result_.text += std::move(line) + "\n";
    result_.lines.push_back(number);
}

bool Rewriter::reads_itself() const {
    return std::ranges::any_of(
        channels_, [](const ForeignChannel& channel) { return channel.source == "self"; });
}

// A picture that reads itself becomes a buffer, which the picture shows.
ForeignText Rewriter::root() {
    std::set<fs::path> known = {file_.lexically_normal()};
    asks_for_releases_ = text_.mentions("isKeyReleased");
    add_buffers(file_, channels_, 1, known);
    if (asks_for_releases_) add_key_states();
    const bool is_tab = known.size() > 1 || asks_for_releases_;
    if (reads_itself()) {
        const std::string name = buffer_name(file_);
        add(fmt::format("uniform sampler2D {0};  //@ pass main_{0}", name), 1);
        add("#ifdef PASS_image", 1);
        add(fmt::format("void mainImage(out vec4 color, in vec2 coord) {{ color = texelFetch({}, "
                        "ivec2(coord), 0); }}",
                        name),
            1);
        add("#endif", 1);
        add(fmt::format("#ifdef PASS_{}", name), 1);
        add_text(name);
        add("#endif", text_.line_count());
    } else {
        if (is_tab) add("#ifdef PASS_image", 1);
        add_text({});
        if (is_tab) add("#endif", text_.line_count());
    }
    return std::move(result_);
}

ForeignText Rewriter::part(const std::string& own_buffer) {
    add_text(own_buffer);
    return std::move(result_);
}

// What a file reads is drawn before it.
void Rewriter::add_buffers(const fs::path& file, const ForeignChannels& channels, int line,
                           std::set<fs::path>& known) {
    for (const ForeignChannel& channel : channels) {
        if (channel.line == 0 || !is_shader(channel.source)) continue;
        const fs::path path = path_of(file, channel.source);
        if (!known.insert(path).second) continue;
        const int at = file == file_ ? channel.line : line;
        std::string why_not;
        const auto bytes = read_bytes(path, why_not);
        const ForeignFile other(bytes ? clean_text(*bytes).text : "", known_);
        asks_for_releases_ |= other.mentions("isKeyReleased");
        add_buffers(path, other.channels(), at, known);
        const std::string name = buffer_name(path);
        add(fmt::format("uniform sampler2D {0};  //@ pass main_{0}", name), at);
        add(fmt::format("#ifdef PASS_{}", name), at);
        add(fmt::format("#include \"{}\"",
                        path.lexically_proximate(file_.parent_path()).generic_string()),
            at);
        add("#endif", at);
    }
}

void Rewriter::add_text(const std::string& own_buffer) {
    const auto& directives = text_.directives();
    for (int number = 1; number <= text_.line_count(); ++number) {
        const auto directive = directives.find(number);
        const std::string_view word =
            directive == directives.end() ? std::string_view() : directive->second->word;
        const auto channel = std::ranges::find(channels_, number, &ForeignChannel::line);
        if (channel != channels_.end())
            add_channel(static_cast<std::size_t>(channel - channels_.begin()), own_buffer);
        else if (word == "iUniform")
            add_uniform(*directive->second, number);
        else if (word == "iKeyboard")
            add_keyboard(number);
        else if (is_channel(word))
            add_nothing(*directive->second, number);
        else if (word == "StrictCompatibility")
            add("", number);
        else
            add(text_.line(number), number);
    }
}

// An option is the channel's already.
void Rewriter::add_nothing(const Directive& channel, int number) {
    if (std::string why = text_.why_nothing_is_said(channel); !why.empty())
        warning(number, std::move(why));
    add("", number);
}

// A colour's components as an annotation has them.
std::string hex_colour(const std::vector<std::string>& components) {
    std::string hex = "#";
    for (const std::string& component : components) {
        const double value = std::clamp(parse_number(component).value_or(0), 0.0, 1.0);
        hex += fmt::format("{:02x}", static_cast<int>(std::lround(value * 255)));
    }
    return hex;
}

void Rewriter::add_uniform(const Directive& directive, int number) {
    const auto uniform = text_.uniform(directive);
    if (!uniform) {
        add("", number);
        return error(number,
                     "this #iUniform is not understood; write #iUniform float speed = 1.0 "
                     "in { 0.0, 5.0 }");
    }
    constexpr std::string_view kIntegers[] = {"ivec2", "ivec3", "ivec4"};
    const bool is_integers = std::ranges::find(kIntegers, uniform->type) != std::end(kIntegers);
    is_integers ? add_integers(*uniform, number) : add_uniform(*uniform, number);
}

void Rewriter::add_uniform(const ForeignUniform& uniform, int number) {
    auto [type, name, value, range, step, description] = uniform;
    const bool is_colour = type.starts_with("color");
    const std::string ours = is_colour ? "vec" + type.substr(5) : type;
    const int count = ours.starts_with("vec") && ours.size() == 4 ? ours[3] - '0' : 1;
    if (count > 1 && value.size() == 1)
        value.resize(static_cast<std::size_t>(count), std::string(value.front()));
    std::string annotation =
        is_colour ? hex_colour(value) : fmt::format("{}", fmt::join(value, ", "));
    if (!range.empty()) annotation += fmt::format(" [{}, {}]", range[0], range[1]);
    if (!step.empty()) annotation += " step=" + step;
    std::ranges::replace(description, '"', '\'');
    if (!description.empty()) annotation += fmt::format(" \"{}\"", description);
    add(fmt::format("uniform {} {};  //@ {}", ours, name, annotation), number);
}

// `ivec2`, which no slider has: an `int` for each component.
void Rewriter::add_integers(const ForeignUniform& uniform, int number) {
    const auto count = static_cast<std::size_t>(uniform.type.back() - '0');
    std::string all;
    for (std::size_t i = 0; i < count; ++i) {
        ForeignUniform one = uniform;
        one.type = "int";
        one.name = uniform.name + "_" + "xyzw"[i];
        one.value = {uniform.value[std::min(i, uniform.value.size() - 1)]};
        all += (i > 0 ? ", " : "") + one.name;
        add_uniform(one, number);
    }
    add(fmt::format("#define {} {}({})", uniform.name, uniform.type, all), number);
}

void Rewriter::add_channel(std::size_t index, const std::string& own_buffer) {
    const ForeignChannel& channel = channels_[index];
    const bool is_cube = channel.type == "CubeMap";
    add(fmt::format("uniform {} iChannel{};  //@ {}{}", is_cube ? "samplerCube" : "sampler2D",
                    index, source_of(channel, own_buffer), options_of(channel)),
        channel.line);
}

std::string Rewriter::source_of(const ForeignChannel& channel, const std::string& own_buffer) {
    if (channel.source == "self" && !own_buffer.empty()) return "buffer " + own_buffer;
    if (channel.source == "keyboard") return "keyboard";
    if (is_shader(channel.source)) return "buffer " + buffer_name(path_of(file_, channel.source));
    const bool is_cube = channel.type == "CubeMap";
    const std::string faces = is_cube ? face_names(file_, channel.source) : "";
    if (channel.source.starts_with("http") || channel.source == "self" ||
        (is_cube && faces.empty())) {
        const std::string noise = is_sound(channel.source) ? "noise r 512x2"
                                  : is_cube                ? "noise rgb 64"
                                                           : "noise rgba 256";
        warning(channel.line, fmt::format("{} is not read here; {} stands in its place",
                                          in_quotes(channel.source), noise));
        return noise;
    }
    if (is_cube) return "cube" + faces;
    return fmt::format("{} \"{}\"", is_sound(channel.source) ? "sound" : "image",
                       without_scheme(channel.source));
}

std::string Rewriter::options_of(const ForeignChannel& channel) {
    std::string options;
    if (channel.mag_filter == "Nearest" || channel.min_filter == "Nearest")
        options += " filter=nearest";
    else if (channel.min_filter.find("MipMap") != std::string::npos)
        options += " filter=mipmap";
    else if (!channel.min_filter.empty() || !channel.mag_filter.empty())
        options += " filter=linear";
    if (channel.wrap == "Repeat") options += " wrap=repeat";
    if (channel.wrap == "Clamp") options += " wrap=clamp";
    if (channel.wrap == "Mirror") options += " wrap=mirror";
    return options;
}

// A key was let go in the frame in which it is no longer held: red is held now, green let go now.
void Rewriter::add_key_states() {
    add(fmt::format("uniform sampler2D {0};  //@ pass main_{0} size=256x1", kKeyStates), 1);
    add(fmt::format("#ifdef PASS_{}", kKeyStates), 1);
    add("uniform sampler2D iKeyboard;  //@ keyboard", 1);
    add(fmt::format("void mainImage(out vec4 color, in vec2 coord) {{ "
                    "float held = texelFetch(iKeyboard, ivec2(coord.x, 0), 0).x; "
                    "float before = texelFetch({}, ivec2(coord), 0).x; "
                    "color = vec4(held, before * (1.0 - held), 0, 1); }}",
                    kKeyStates),
        1);
    add("#endif", 1);
}

void Rewriter::add_keyboard(int number) {
    add("uniform sampler2D iKeyboard;  //@ keyboard", number);
    constexpr std::array kRows = {"isKeyDown", "isKeyPressed", "isKeyToggled"};
    for (std::size_t row = 0; row < kRows.size(); ++row)
        if (text_.mentions(kRows[row]))
            add(fmt::format(
                    "bool {}(int key) {{ return texelFetch(iKeyboard, ivec2(key, {}), 0).x > "
                    "0.5; }}",
                    kRows[row], row),
                number);
    for (const auto& [name, code] : key_codes())
        if (text_.mentions("Key_" + name))
            add(fmt::format("const int Key_{} = {};", name, code), number);
    if (text_.mentions("isKeyReleased"))
        add(fmt::format("bool isKeyReleased(int key) {{ return texelFetch({}, ivec2(key, 0), 0).y "
                        "> 0.5; }}",
                        kKeyStates),
            number);
}

}  // namespace

bool is_foreign(const ScannedText& text) {
    return std::ranges::any_of(text.directives, [&](const DirectiveLine& line) {
        if (line.tokens.size() < 2) return false;
        const std::string_view word = text.tokens[line.tokens.begin + 1].text;
        return word == "iUniform" || is_channel(word) || word == "iKeyboard" ||
               word == "StrictCompatibility";
    });
}

ForeignText rewrite_foreign(const fs::path& file, std::string_view text, const Known& known,
                            bool is_root, Diagnostics& diagnostics) {
    // What includes a file may have defined any name.
    Known any = known;
    if (!is_root) any.open.emplace_back();
    Rewriter rewriter(file, text, is_root ? known : any, diagnostics);
    return is_root ? rewriter.root() : rewriter.part(buffer_name(file));
}

}  // namespace glint
