#include "measure/second_opinion.h"

#include "base/launch.h"
#include "base/readable_file.h"
#include "base/temporary_file.h"
#include "base/temporary_folder.h"
#include "base/words.h"
#include "base/workers.h"
#include "glsl/finding.h"
#include "glsl/token.h"
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
#include <deque>
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
class NameALine {
public:
    // `whole` must outlive this.
    explicit NameALine(std::string_view whole);

    const std::string& text() const { return text_; }
    // The byte of the text as it was at which a word stands, in a line or before it in the line as
    // it was; or else what stands first there.
    std::size_t place_of(std::size_t line, std::string_view word) const;

private:
    std::string_view whole_;
    std::string text_;
    std::vector<std::size_t> begins_ = {0};  // of each line, in the text as it was
};

NameALine::NameALine(std::string_view whole) : whole_(whole) {
    std::deque<std::string> spellings;
    const ScannedText scanned = scan(whole, spellings);
    std::vector<bool> is_of_directive(scanned.tokens.size());
    for (const DirectiveLine& line : scanned.directives)
        for (std::uint32_t i = line.tokens.begin; i < line.tokens.end; ++i)
            is_of_directive[i] = true;
    std::vector<bool> breaks(whole.size());
    for (std::size_t i = 0; i < scanned.tokens.size(); ++i)
        if (scanned.tokens[i].is_word() && !is_of_directive[i])
            breaks[scanned.tokens[i].begin] = true;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        if (breaks[at]) {
            text_ += '\n';
            begins_.push_back(at);
        }
        text_ += whole[at];
        if (whole[at] == '\n') begins_.push_back(at + 1);
    }
}

// Where a name, or a sign, stands last.
std::size_t last_of(std::string_view words, std::string_view word) {
    const bool is_name =
        !word.empty() && (word[0] == '_' || std::isalnum(static_cast<unsigned char>(word[0])));
    if (!is_name) return word.empty() ? words.npos : words.rfind(word);
    std::size_t last = words.npos;
    for (std::size_t at = 0; (at = find_whole_word(words, word, at)) != words.npos; ++at) last = at;
    return last;
}

std::size_t NameALine::place_of(std::size_t line, std::string_view word) const {
    if (line >= begins_.size()) return whole_.size();
    const std::size_t begin = begins_[line];
    const std::size_t end = line + 1 < begins_.size() ? begins_[line + 1] : whole_.size();
    const std::size_t line_end = begin == 0 ? whole_.npos : whole_.rfind('\n', begin - 1);
    const std::size_t line_begin = line_end == whole_.npos ? 0 : line_end + 1;
    const std::string_view words = whole_.substr(line_begin, end - line_begin);
    // A call is complained of at its end.
    const std::size_t at = last_of(words, word);
    return line_begin +
           std::min(at == words.npos ? words.find_first_not_of(" \t") : at, words.size());
}

std::optional<std::vector<PlacedFinding>> findings_of(const Preset& preset, std::size_t pass) {
    const SiteText site = site_text(preset, pass);
    const Reading reading = read_glsl(site.text, known_of_pass(output_names(preset.scene, pass)));
    const std::string head = before(preset, pass, reading);
    Edits edits(reading);
    rename_overloads(reading, edits);
    const EditedText edited = edits.apply();
    const NameALine lines(edited.text);
    const auto log = log_of(head + lines.text() + std::string(kBehind));
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
            lines.place_of(static_cast<std::size_t>(line - head_lines - 1), word));
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
    if (draws_by_main(preset.scene)) return {{}, "the site takes no text with a main() of its own"};
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
