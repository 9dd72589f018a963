#include "measure/second_opinion.h"

#include "base/launch.h"
#include "base/readable_file.h"
#include "base/temporary_file.h"
#include "base/temporary_folder.h"
#include "base/words.h"
#include "base/workers.h"
#include "glsl/finding.h"
#include "offline/site_text.h"
#include "render/compile_watch.h"
#include "render/driver_log.h"
#include "render/own_main_text.h"
#include "render/own_overloads.h"
#include "render/pass_text.h"
#include "scene/builtin.h"
#include "scene/scene_text.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <optional>
#include <regex>
#include <set>
#include <thread>

namespace glint {
namespace {

constexpr std::string_view kBefore = R"(#version 300 es
precision highp float;
precision highp int;
precision mediump sampler3D;
#define HW_PERFORMANCE 1
uniform float iGlobalTime, iTimeDelta, iFrameRate, iSampleRate, iChannelTime[4];
uniform vec4 iDate;
uniform vec3 iChannelResolution[4];
uniform int iFrame;
void st_assert(bool condition, int colour) {}
void st_assert(bool condition) {}
)";
// A sound may use these names for something of its own, as the site has them not there.
constexpr std::pair<std::string_view, std::string_view> kOfPictures[] = {
    {"vec3", "iResolution"}, {"float", "iTime"}, {"vec4", "iMouse"}};
constexpr std::string_view kBehind =
    "\nout vec4 glint_colour;\nvoid main() { glint_colour = vec4(0); }\n";

// What nothing fills is a channel without an input there.
std::string unfilled_samplers(const Preset& preset, std::size_t pass) {
    const Reading whole = read_glsl(preset.scene.text, known_of_pass({}));
    std::string text;
    std::set<std::string_view> names;
    for (const Declaration& declaration : whole.declarations) {
        const std::string_view type = whole.word(declaration.type);
        if (!declaration.is_uniform || !type.starts_with("sampler")) continue;
        for (const Declarator& one : declaration.names) {
            const std::string_view name = whole.word(one.name);
            if (!find_sampler(preset, pass, name) && !find_builtin(name) &&
                names.insert(name).second)
                text += fmt::format("uniform {} {}{};\n", type, name, whole.spelled(one.array));
        }
    }
    return text;
}

// What stands before a pass's text: its samplers by the names that the scene gives them, and what
// Chromium takes beyond the validator.
std::string before(const Preset& preset, std::size_t pass, const Reading& reading) {
    const Scene& scene = preset.scene;
    std::string text(kBefore);
    for (const auto& [type, name] : kOfPictures)
        if (pass != kSoundPass || !means_its_own(reading, name))
            text += fmt::format("uniform {} {};\n", type, name);
    for (const std::string& name : output_names(scene, pass))
        text += fmt::format("#define PASS_{} 1\n", name);
    std::array<SamplerType, 4> channels{};
    for (std::size_t i = 0; i < channels.size(); ++i)
        channels[i] = scene.channel_types[i].value_or(preset.channels[i].type);
    for (const Sampler& sampler : scene.samplers) {
        const auto known = find_sampler(preset, pass, sampler.name);
        if (!known || &sampler_at(preset, *known) != &sampler) continue;
        if (sampler.name.size() == 9 && sampler.name.starts_with("iChannel"))
            channels[static_cast<std::size_t>(sampler.name.back() - '0') % 4] = sampler.type;
        else
            text += fmt::format("uniform {} {};\n", glsl_name(sampler.type), sampler.name);
    }
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const char* type = glsl_name(channels[i]);
        text += fmt::format("uniform {} iChannel{};\n", type, i);
        if (reading.mentions(fmt::format("iCh{}", i)))
            text += fmt::format(
                "uniform struct {{ {} sampler; vec3 size; float time; int loaded; }} iCh{};\n",
                type, i);
    }
    if (!means_its_own(reading, "iTick")) text += "uniform uint iTick;\n";
    return text + unfilled_samplers(preset, pass) + older_names(reading) + own_overloads(reading);
}

std::string read_all(int pipe) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (;;) {
        const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        if (text.size() < (1u << 20)) text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    ::close(pipe);
    return text;
}

// What the validator says of a text; nothing where it is not there.
std::optional<std::string> log_of(const std::string& text) {
    const TemporaryFolder folder;  // for each call; several threads may be here
    const std::string file = (folder.path() / "pass.frag").string();
    write_whole_file(file, std::as_bytes(std::span(text)));
    const CompileLimits limits = compile_limits();
    const Launched launched = launch({.words = {"glslangValidator", file},
                                      .output = kPipe,
                                      .core_files = false,
                                      .most_seconds = static_cast<rlim_t>(limits.seconds),
                                      .most_bytes = limits.bytes});
    if (launched.process == 0) return std::nullopt;
    std::string log = read_all(launched.pipe);
    if (wait_for(launched.process) < 0)
        throw std::runtime_error("glslangValidator took more time or memory than a compiler may");
    return log;
}

// What browsers take and the validator alone refuses, after which it is lost: an empty argument of
// a macro that takes none, an odd quote in a branch that is not compiled, a word of later GLSL.
bool is_refused_by_it_alone(std::string_view why) {
    return why.starts_with("Too few args in Macro") || why.starts_with("End of line in string") ||
           why.find("unexpected SHARED") != why.npos;
}

// Browsers take what GLSL's functions make of constants for one, as the driver does (GLSL ES 3.00,
// 4.3.3).
bool is_of_constants(std::string_view why, std::string_view word) {
    return why.starts_with("global const initializers must be constant") ||
           word == "non-constant initializer";
}

// Of a function of GLSL's own by a variable, which browsers take; and what follows from another
// complaint. Whatever else is so, the driver has refused already.
bool is_refused_already(std::string_view why) {
    return why == "redefinition" || why == "missing #endif";
}

// A text whose lines hold one name each, so that the line of a complaint tells which of several it
// means.
struct NameALine {
    std::string text;
    std::vector<std::size_t> begins;  // of each line, in the text as it was

    explicit NameALine(std::string_view whole);

    // The byte of the text as it was at which a word stands, in a line or before it in the line as
    // it was; or else what stands first there.
    std::size_t place_of(std::size_t line, std::string_view word, std::string_view whole) const;
};

bool is_letter(char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c));
}

// Where what is no code ends: a comment, or a directive.
std::size_t end_of_other(std::string_view whole, std::size_t at, bool line_begins) {
    if (whole.substr(at).starts_with("/*")) {
        const std::size_t end = whole.find("*/", at + 2);
        return end == whole.npos ? whole.size() : end + 2;
    }
    if (!whole.substr(at).starts_with("//") && !(line_begins && whole[at] == '#')) return at;
    std::size_t end = whole.find('\n', at);
    while (end != whole.npos && whole[end - 1] == '\\') end = whole.find('\n', end + 1);
    return std::min(whole.size(), end);
}

NameALine::NameALine(std::string_view whole) : begins{0} {
    bool line_begins = true;
    for (std::size_t at = 0; at < whole.size();) {
        const std::size_t end = std::max(end_of_other(whole, at, line_begins), at + 1);
        const bool is_comment = whole.substr(at).starts_with("/*");
        const bool is_name =
            is_letter(whole[at]) && !std::isdigit(static_cast<unsigned char>(whole[at]));
        const bool goes_on = at == 0 || is_letter(whole[at - 1]) || whole[at - 1] == '.' ||
                             (at > 1 && whole.substr(at - 2, 2) == "\\\n");
        if (is_name && !goes_on) {
            text += '\n';
            begins.push_back(at);
        }
        for (const char c : whole.substr(at, end - at)) {
            text += c;
            ++at;
            if (c == '\n') begins.push_back(at);
        }
        if (text.back() == '\n')
            line_begins = true;
        else if (text.back() != ' ' && text.back() != '\t' && !is_comment)
            line_begins = false;
    }
}

bool stands_whole(std::string_view words, std::size_t at, std::string_view word) {
    const std::size_t behind = at + word.size();
    return !is_letter(word.front()) || ((at == 0 || !is_letter(words[at - 1])) &&
                                        (behind == words.size() || !is_letter(words[behind])));
}

std::size_t NameALine::place_of(std::size_t line, std::string_view word,
                                std::string_view whole) const {
    if (line >= begins.size()) return whole.size();
    const std::size_t begin = begins[line];
    const std::size_t end = line + 1 < begins.size() ? begins[line + 1] : whole.size();
    const std::size_t line_end = begin == 0 ? whole.npos : whole.rfind('\n', begin - 1);
    const std::size_t line_begin = line_end == whole.npos ? 0 : line_end + 1;
    const std::string_view words = whole.substr(line_begin, end - line_begin);
    // A call is complained of at its end.
    for (std::size_t at = word.empty() ? words.npos : words.rfind(word); at < words.size();
         at = at == 0 ? words.npos : words.rfind(word, at - 1))
        if (stands_whole(words, at, word)) return line_begin + at;
    return line_begin + std::min(words.find_first_not_of(" \t"), words.size());
}

std::optional<std::vector<PlacedFinding>> findings_of(const Preset& preset, std::size_t pass) {
    const SiteText site = site_text(preset, pass);
    const Reading reading = read_glsl(site.text, known_of_pass(output_names(preset.scene, pass)));
    const std::string head = before(preset, pass, reading);
    Edits edits(reading);
    rename_overloads(reading, edits);
    const EditedText edited = edits.apply();
    const NameALine lines(edited.text);
    const auto log = log_of(head + lines.text + std::string(kBehind));
    if (!log) return std::nullopt;
    static const std::regex error(R"(ERROR: [^:]*:(\d+): '(.*)' : (.*))");
    const int head_lines = static_cast<int>(std::ranges::count(head, '\n'));
    std::vector<PlacedFinding> findings;
    for (const std::string& said : lines_of(*log)) {
        std::smatch one;
        if (!std::regex_search(said, one, error)) continue;
        int line = 0;
        const std::string digits = one[1], word = one[2], why = one[3];
        std::from_chars(digits.data(), digits.data() + digits.size(), line);
        if (is_refused_by_it_alone(why)) return std::vector<PlacedFinding>();
        if (why.starts_with("compilation terminated") || line <= head_lines) continue;
        if (is_of_constants(why, word) || is_refused_already(why)) continue;
        const std::size_t at = edited.map.origin(
            lines.place_of(static_cast<std::size_t>(line - head_lines - 1), word, edited.text));
        findings.push_back(
            {std::string(kWebGl),
             preset.scene.place_at(site.origin(std::min(at, site.text.size() - 1))),
             fmt::format("the reference compiler of GLSL ES 3.00 refuses this, and so may "
                         "browsers: {}{}",
                         word.empty() ? "" : in_quotes(word) + ": ", trimmed(why))});
    }
    return findings;
}

}  // namespace

SecondOpinion second_opinion(const Preset& preset, const std::vector<std::size_t>& passes) {
    if (preset.scene.image_entry == "main")
        return {{}, "the site takes no text with a main() of its own"};
    std::vector<std::optional<std::vector<PlacedFinding>>> found(passes.size());
    try {
        Workers workers(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
        for (std::size_t i = 0; i < passes.size(); ++i)
            workers.run([&, i] { found[i] = findings_of(preset, passes[i]); });
        workers.finish();
    } catch (const std::runtime_error& error) {  // no room, or no place, for files
        return {{}, error.what()};
    }
    SecondOpinion opinion;
    for (const auto& list : found) {
        if (!list) return {{}, "glslangValidator is not installed"};
        for (const PlacedFinding& one : *list) {
            const bool is_known = std::ranges::any_of(opinion.findings, [&](const auto& other) {
                return to_string({{}, one.place, one.text}) ==
                       to_string({{}, other.place, other.text});
            });
            if (!is_known) opinion.findings.push_back(one);
        }
    }
    return opinion;
}

}  // namespace glint
