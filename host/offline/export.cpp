#include "offline/export.h"

#include "base/json_text.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "gl/context.h"
#include "glsl/raw_text.h"
#include "offline/common.h"
#include "offline/named_files.h"
#include "offline/page.h"
#include "offline/site_names.h"
#include "offline/site_text.h"
#include "render/own_main_text.h"
#include "scene/builtin.h"
#include "scene/scene_text.h"
#include "scene/shadertoy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <ranges>
#include <set>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// By channel, what it has: into the samplers, as in sampler_at.
using Channels = std::array<std::optional<std::size_t>, 4>;

// One output of one pass.
struct Tab {
    std::string name;  // "bufferA", "cubeA", "image", "sound"
    std::size_t pass = kImagePass, output = 0;
};

class Exporter {
public:
    explicit Exporter(const Preset& preset) : preset_(preset), scene_(preset.scene) {
        compile(kImagePass);
        if (draws_by_main(scene_))
            throw UsageError(
                "The site takes no text with a main() of its own. Write void mainImage(out vec4 "
                "fragColor, in vec2 fragCoord), and these two for gl_FragColor and gl_FragCoord.");
        if (scene_.has_sound) sound_ = compile_or_stop(preset, {.root = kSoundPass, .program = {}});
        compile_told_of();
        find_tabs();
    }

    void write(const fs::path& folder);

private:
    void compile(std::size_t pass) {
        pictures_.push_back(compile_or_stop(preset_, {.root = pass, .program = {}}));
    }
    void compile_told_of();
    std::array<bool, 4> channels_named(std::size_t pass) const;
    const PassProgram* drawn(std::size_t pass) const;
    std::vector<GraphPass> drawn_passes() const;
    void write_all(const fs::path& folder, const std::vector<std::string>& texts);
    void warn_of_others(const fs::path& folder);
    void require_unedited(const std::vector<NamedFile>& outputs,
                          const std::vector<std::string>& texts) const;
    void find_tabs();
    void warn_of_order();
    void warn_of_files();
    const PassProgram& program_of(const Tab& tab) const;
    Channels channels_of(const Tab& tab) const;
    std::optional<std::size_t> filled_channel(std::size_t pass, std::size_t channel) const;
    std::string tab_text(const Tab& tab);
    std::vector<SiteName> names_there(const Tab& tab, const Reading& body,
                                      const Channels& channels);
    void name_unread(const Channels& channels, std::vector<SiteName>& names) const;
    void name_unfilled(const Tab& tab, const Channels& channels, std::vector<SiteName>& names);
    std::string entry_text(const Tab& tab, const Reading& body) const;
    void warn_of_limits(const Tab& tab);
    std::optional<glm::ivec2> own_size(const Tab& tab) const;
    std::string source_words(const Tab& tab, const Sampler& sampler);
    Json input_json(const Sampler& sampler, int channel) const;
    Json tab_json(const Tab& tab, const std::string& text) const;
    const Tab& tab_of(const Sampler& sampler) const;
    void warn(const std::string& text) {
        say("{}: warning: {}\n", scene_.files.front().string(), text);
    }

    const Preset& preset_;
    const Scene& scene_;
    std::vector<CompiledScene> pictures_;  // the image's, and those of compile_told_of()
    std::optional<CompiledScene> sound_;
    std::vector<Tab> tabs_;
};

const PassProgram* Exporter::drawn(std::size_t pass) const {
    for (const CompiledScene& picture : pictures_)
        for (const PassProgram& program : picture.programs)
            if (program.pass == pass) return &program;
    return nullptr;
}

// Those that fill buffers, each once, in drawing order.
std::vector<GraphPass> Exporter::drawn_passes() const {
    std::map<std::size_t, GraphPass> passes;
    for (const CompiledScene& picture : pictures_)
        for (const GraphPass& pass : picture.graph.passes)
            if (fills_a_buffer(pass.pass)) passes.emplace(pass.pass, pass);
    const auto values = passes | std::views::values;
    return {values.begin(), values.end()};
}

// A buffer of which nothing but the size is asked is not drawn here; the site tells the sizes of
// those alone that it draws.
void Exporter::compile_told_of() {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        for (std::size_t k = 0; k < pictures_[i].programs.size(); ++k) {
            const std::array<bool, 4> named = channels_named(pictures_[i].programs[k].pass);
            for (const std::size_t told : channels_told_of(preset_, pictures_[i].programs[k])) {
                const Sampler& sampler = sampler_at(preset_, told);
                const bool is_named = named[static_cast<std::size_t>(sampler.name.back() - '0')];
                if (is_named && sampler.source == Source::buffer && !drawn(sampler.pass))
                    compile(sampler.pass);
            }
        }
    }
}

void Exporter::find_tabs() {
    int buffers = 0, cubes = 0;
    for (const GraphPass& graph : drawn_passes()) {
        const Pass& pass = scene_.passes[graph.pass];
        for (std::size_t i = 0; i < pass.outputs.size(); ++i) {
            const int index = pass.cube ? cubes++ : buffers++;
            const std::string letter(1, static_cast<char>('A' + index));
            tabs_.push_back({(pass.cube ? "cube" : "buffer") + letter, graph.pass, i});
        }
    }
    warn_of_order();
    if (buffers > 4 || cubes > 1) {
        throw UsageError(
            fmt::format("The scene fills {} buffers and {} cubemaps; the site has four and one. "
                        "Switch off what needs them with --tweak, or join passes.",
                        buffers, cubes));
    }
    tabs_.push_back({"image", kImagePass, 0});
    if (sound_) tabs_.push_back({"sound", kSoundPass, 0});
}

// The site draws outputs one after the other, buffers before cubes.
void Exporter::warn_of_order() {
    const std::vector<GraphPass> drawn = drawn_passes();
    std::set<std::size_t> cubes;
    for (const GraphPass& graph : drawn) {
        const Pass& pass = scene_.passes[graph.pass];
        const auto reads = [&](std::size_t other) {
            return std::ranges::find(graph.reads, other) != graph.reads.end();
        };
        if (pass.outputs.size() > 1 && reads(graph.pass))
            warn(fmt::format(
                "{}: of several outputs that read each other the site draws the later ones from "
                "the new values of the earlier, which may change them; write one pass for each",
                fmt::join(pass.outputs, ", ")));
        if (pass.cube) cubes.insert(graph.pass);
        const bool reads_later = std::ranges::any_of(drawn, [&](const GraphPass& other) {
            return other.pass > graph.pass && !scene_.passes[other.pass].cube && reads(other.pass);
        });
        if (pass.cube && reads_later)
            warn(fmt::format(
                "{}: the site draws its cube behind the buffers, so that it reads what a buffer "
                "below it holds by now, not that of the frame before",
                pass.outputs.front()));
        if (!pass.cube && std::ranges::any_of(cubes, reads))
            warn(fmt::format(
                "{}: the site draws its cube behind the buffers, so that this one reads that of "
                "the frame before",
                pass.outputs.front()));
    }
}

// Of the first file that fills it, if any.
std::string file_name(const Sampler& sampler) {
    return sampler.files.empty() ? "" : sampler.files.front().filename().string();
}

// The site's inputs have no folders.
void Exporter::warn_of_files() {
    std::map<std::string, std::string> path_of;
    for (const Tab& tab : tabs_)
        for (const auto& channel : channels_of(tab)) {
            if (!channel) continue;
            for (const fs::path& file : sampler_at(preset_, *channel).files) {
                const std::string path = file.lexically_normal().string();
                const auto [known, is_new] = path_of.emplace(file.filename().string(), path);
                if (!is_new && known->second != path)
                    warn(
                        fmt::format("{} and {} have one name, and an import takes one file for "
                                    "both; rename one",
                                    known->second, path));
            }
        }
}

const PassProgram& Exporter::program_of(const Tab& tab) const {
    return tab.pass == kSoundPass ? sound_->programs[sound_->root] : *drawn(tab.pass);
}

const Tab& Exporter::tab_of(const Sampler& sampler) const {
    const auto tab = std::ranges::find_if(tabs_, [&](const Tab& one) {
        return one.pass == sampler.pass && one.output == sampler.output;
    });
    if (tab == tabs_.end())
        throw UsageError(fmt::format("The sound alone reads {}; the site has no buffers for sound.",
                                     sampler.name));
    return *tab;
}

// Which channels a pass's text asks for, be it for their size or time alone.
std::array<bool, 4> Exporter::channels_named(std::size_t pass) const {
    const std::string text = site_text(preset_, pass).text;
    const Reading reading = read_glsl(text, known_of_pass(output_names(scene_, pass)));
    std::array<bool, 4> named{};
    for (std::size_t i = 0; i < named.size(); ++i)
        named[i] = reading.mentions(fmt::format("iChannel{}", i));
    for (std::size_t at = 0; at + 2 < reading.tokens.size(); ++at) {
        if (!reading.tokens[at].is("iChannelResolution") && !reading.tokens[at].is("iChannelTime"))
            continue;
        for (std::size_t i = 0; i < named.size(); ++i)
            named[i] = named[i] || !reading.tokens[at + 1].is("[") ||
                       reading.tokens[at + 2].kind != TokenKind::number ||
                       reading.tokens[at + 2].is(fmt::format("{}", i));
    }
    return named;
}

// What fills this channel for a pass that names it, if anything does.
std::optional<std::size_t> Exporter::filled_channel(std::size_t pass, std::size_t channel) const {
    const auto found = find_sampler(preset_, pass, fmt::format("iChannel{}", channel));
    if (!found) return std::nullopt;
    const Sampler& sampler = sampler_at(preset_, *found);
    const bool is_filled = sampler.source == Source::buffer ? drawn(sampler.pass) != nullptr
                                                            : sampler.source != Source::none;
    return is_filled ? found : std::nullopt;
}

// By sampler (as in sampler_at). One that is called iChannel2 keeps its number, and no other takes
// that of one that the text asks for.
Channels Exporter::channels_of(const Tab& tab) const {
    Channels channels;
    std::vector<std::size_t> others;
    for (const SamplerUniform& uniform : program_of(tab).samplers) {
        const std::string& name = sampler_at(preset_, uniform.sampler).name;
        if (name.size() == 9 && name.starts_with("iChannel"))
            channels[static_cast<std::size_t>(name.back() - '0')] = uniform.sampler;
        else
            others.push_back(uniform.sampler);
    }
    const std::array<bool, 4> named = channels_named(tab.pass);
    for (std::size_t i = 0; i < channels.size(); ++i)
        if (named[i] && !channels[i]) channels[i] = filled_channel(tab.pass, i);
    std::ranges::sort(others);
    for (const std::size_t sampler : others) {
        const auto free = std::ranges::find_if(channels, [&](const auto& channel) {
            return !channel && !named[static_cast<std::size_t>(&channel - channels.data())];
        });
        if (free == channels.end()) {
            throw UsageError(fmt::format(
                "Pass {} reads {} samplers; the site has four channels. Switch off what needs them "
                "with --tweak, or join buffers.",
                pass_name(scene_, tab.pass), program_of(tab).samplers.size()));
        }
        *free = sampler;
    }
    return channels;
}

std::string Exporter::source_words(const Tab& tab, const Sampler& sampler) {
    const std::string where = fmt::format("{}, {}", tab.name, sampler.name);
    if (sampler.wrap == Wrap::mirror) warn(where + ": the site cannot mirror; it repeats there");
    switch (sampler.source) {
        case Source::buffer:
            return tab_of(sampler).name;
        case Source::keyboard:
            return "the keyboard";
        case Source::noise:
            warn(where + ": the site's noise has other values than ours");
            return fmt::format("noise of {} pixels", sampler.noise_size.x);
        case Source::image:
        case Source::cube:
        case Source::volume:
        case Source::sound:
            warn(fmt::format("{}: the site takes no files; choose one of its own instead of {}",
                             where, file_name(sampler)));
            return file_name(sampler);
        case Source::none:
            break;
    }
    return "nothing";
}

// Tells of limits that the site's buffers have.
void Exporter::warn_of_limits(const Tab& tab) {
    if (!fills_a_buffer(tab.pass)) return;
    const Pass& pass = scene_.passes[tab.pass];
    if (pass.step) {
        warn(fmt::format("{}: the site runs it once a frame, not every {}/{} s", tab.name,
                         pass.step.numerator, pass.step.denominator));
    }
    if (bytes_a_channel(pass.format) != 4 && !pass.cube)
        warn(fmt::format("{}: the site keeps it in floats of 32 bits", tab.name));
    if (channel_count(pass.format) != 4 && pass.entry == "mainImage")
        warn(fmt::format("{}: the site keeps all four channels", tab.name));
    if (const auto size = own_size(tab))
        warn(fmt::format(
            "{}: it has {}x{} pixels, the site's {}: texelFetch reads the same, texture does "
            "not",
            tab.name, size->x, size->y,
            pass.cube ? "cubes have 1024x1024" : "buffers are as large as the picture"));
}

// Of a buffer that is not as large as the site's.
std::optional<glm::ivec2> Exporter::own_size(const Tab& tab) const {
    if (!fills_a_buffer(tab.pass)) return std::nullopt;
    const Pass& pass = scene_.passes[tab.pass];
    const glm::ivec2 size = buffer_size(pass, preset_.size);
    return size == (pass.cube ? glm::ivec2(1024) : preset_.size) ? std::nullopt
                                                                 : std::optional(size);
}

// mainImage, where the pass's function has another name or several outputs.
std::string Exporter::entry_text(const Tab& tab, const Reading& body) const {
    if (!fills_a_buffer(tab.pass)) return {};
    const Pass& pass = scene_.passes[tab.pass];
    if (pass.entry == "mainImage" || pass.entry == "mainCubemap") return {};
    const std::string colour = free_of_macros(body, "fragColor");
    const std::string place = free_of_macros(body, "fragCoord");
    if (pass.cube) {
        return fmt::format(
            "\nvoid mainCubemap(out vec4 {1}, in vec2 {2}, in vec3 {3}, in vec3 {4}) {{\n"
            "    {0}({1}, {2}, {3}, {4});\n}}\n",
            pass.entry, colour, place, free_of_macros(body, "rayOri"),
            free_of_macros(body, "rayDir"));
    }
    std::string variables, arguments;
    for (std::size_t i = 0; i < pass.outputs.size(); ++i) {
        const std::string unused = free_of_macros(body, pass.outputs[i] + "Unused");
        if (i != tab.output) variables += fmt::format("    vec4 {};\n", unused);
        arguments += (i == tab.output ? colour : unused) + ", ";
    }
    return fmt::format("\nvoid mainImage(out vec4 {}, in vec2 {}) {{\n{}    {}({}{});\n{}}}\n",
                       colour, place, variables, pass.entry, arguments, place,
                       missing_channels_text(pass.format, colour));
}

// Code that is switched off still speaks of samplers; any of their type will do.
void Exporter::name_unread(const Channels& channels, std::vector<SiteName>& names) const {
    for (std::size_t i = 0; i < scene_.samplers.size(); ++i) {
        const Sampler& sampler = scene_.samplers[i];
        if (std::ranges::find(channels, i) != channels.end()) continue;
        if (sampler.name.starts_with("iChannel")) continue;  // the site has all four
        // What is bound to nothing is a sampler2D on the site.
        for (std::size_t channel = 0; channel < channels.size(); ++channel) {
            const SamplerType type = channels[channel]
                                         ? sampler_at(preset_, *channels[channel]).type
                                         : SamplerType::sampler2D;
            if (type != sampler.type) continue;
            names.push_back({sampler.name, fmt::format("iChannel{}", channel), "switched off"});
            break;
        }
    }
}

// What nothing fills is 0 here, and there a channel to which nothing is bound.
void Exporter::name_unfilled(const Tab& tab, const Channels& channels,
                             std::vector<SiteName>& names) {
    for (const UnfilledSampler& unfilled : program_of(tab).unfilled) {
        if (find_builtin(unfilled.name)) continue;
        const auto free = std::ranges::find(channels, std::optional<std::size_t>());
        if (free == channels.end() || unfilled.type != SamplerType::sampler2D)
            throw UsageError(
                fmt::format("Pass {} reads {}, which nothing fills, and the site has no "
                            "channel for it.",
                            pass_name(scene_, tab.pass), unfilled.name));
        warn(fmt::format("{}: nothing fills {}; a channel without an input stands for it", tab.name,
                         unfilled.name));
        names.push_back({unfilled.name, fmt::format("iChannel{}", free - channels.begin())});
    }
}

// What the text calls otherwise than the site.
std::vector<SiteName> Exporter::names_there(const Tab& tab, const Reading& body,
                                            const Channels& channels) {
    std::vector<SiteName> names;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (!channels[i]) continue;
        const std::string& name = sampler_at(preset_, *channels[i]).name;
        if (!name.starts_with("iChannel")) names.push_back({name, fmt::format("iChannel{}", i)});
    }
    name_unread(channels, names);
    name_unfilled(tab, channels, names);
    if (body.mentions("iTick") && !means_its_own(body, "iTick")) {
        // A float's steps are below 1/65536 s for 256 s.
        names.push_back({"iTick", "uint(iTime * 65536.0)"});
        warn(tab.name + ": iTick becomes uint(iTime * 65536.0), exact for the first 256 s");
    }
    names.push_back({"iGlobalTime", "iTime"});
    if (const auto size = own_size(tab))
        names.push_back({"iResolution", fmt::format("vec3({}.0, {}.0, 1.0)", size->x, size->y)});
    return names;
}

std::string Exporter::tab_text(const Tab& tab) {
    const Known known = known_of_pass(output_names(scene_, tab.pass));
    const std::string body = without_heads(site_text(preset_, tab.pass).text);
    const Reading reading = read_glsl(body, known);
    const Channels channels = channels_of(tab);
    std::string head;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (!channels[i]) continue;
        const Sampler& sampler = sampler_at(preset_, *channels[i]);
        head += fmt::format("// iChannel{}: {}, {}, {}\n", i, source_words(tab, sampler),
                            kFilterNames.of(sampler.filter),
                            sampler.wrap == Wrap::clamp ? "clamp" : "repeat");
    }
    const SiteNamed named = with_site_names(body, known, names_there(tab, reading, channels));
    warn_of_limits(tab);
    head += named.defines + older_names(reading);
    if (std::ranges::any_of(reading.written,
                            [](const Token& token) { return token.text.starts_with(kPassPrefix); }))
        head += fmt::format("#define {}{} 1\n", kPassPrefix, pass_name(scene_, tab.pass));
    return head + named.text + entry_text(tab, reading);
}

// What the site would name a file. Our noise has no file; import reads its words back.
std::string media_name(const Sampler& sampler) {
    if (sampler.source != Source::noise) return file_name(sampler);
    constexpr std::array kChannels = {"r", "rg", "rgb", "rgba"};
    const glm::ivec3 size = sampler.noise_size;
    const std::string lengths = sampler.type == SamplerType::samplerCube ? fmt::format("{}", size.x)
                                : sampler.type == SamplerType::sampler3D
                                    ? fmt::format("{}x{}x{}", size.x, size.y, size.z)
                                    : fmt::format("{}x{}", size.x, size.y);
    return fmt::format("noise {} {}",
                       kChannels[static_cast<std::size_t>(sampler.noise_channels - 1)], lengths);
}

Json Exporter::input_json(const Sampler& sampler, int channel) const {
    const bool is_buffer = sampler.source == Source::buffer;
    const std::string tab = is_buffer ? tab_of(sampler).name : "";
    const char* kind = tab == "cubeA"                                     ? "cubemap"
                       : is_buffer                                        ? "buffer"
                       : sampler.source == Source::keyboard               ? "keyboard"
                       : sampler.source == Source::sound || sampler.plays ? "music"
                       : sampler.type == SamplerType::sampler3D           ? "volume"
                       : sampler.type == SamplerType::samplerCube         ? "cubemap"
                                                                          : "texture";
    Json input = {{"id", is_buffer                            ? output_id(tab)
                         : sampler.source == Source::keyboard ? 33
                                                              : 0},
                  {"src", media_name(sampler)},
                  {"ctype", kind},
                  {"channel", channel},
                  {"sampler",
                   {{"filter", kFilterNames.of(sampler.filter)},
                    {"wrap", sampler.wrap == Wrap::clamp ? "clamp" : "repeat"},
                    {"vflip", sampler.vflip ? "true" : "false"},
                    {"srgb", "false"},
                    {"internal", "byte"}}}};
    // The site names a cube once; an import finds six files by this.
    if (sampler.files.size() > 1)
        for (const fs::path& file : sampler.files)
            input["faces"].push_back(file.filename().string());
    return input;
}

Json Exporter::tab_json(const Tab& tab, const std::string& text) const {
    Json inputs = Json::array();
    const auto channels = channels_of(tab);
    for (std::size_t i = 0; i < channels.size(); ++i)
        if (channels[i])
            inputs.push_back(input_json(sampler_at(preset_, *channels[i]), static_cast<int>(i)));
    const bool is_buffer = tab.name.starts_with("buffer");
    const std::string name = is_buffer             ? fmt::format("Buffer {}", tab.name.back())
                             : tab.name == "cubeA" ? "Cube A"
                             : tab.name == "image" ? "Image"
                                                   : "Sound";
    return {{"inputs", inputs},
            {"outputs", Json::array({{{"id", output_id(tab.name)}, {"channel", 0}}})},
            {"code", text},
            {"name", name},
            {"description", ""},
            {"type", is_buffer ? "buffer" : tab.name == "cubeA" ? "cubemap" : tab.name}};
}

// Tabs of an earlier export, which would be imported with these.
void Exporter::warn_of_others(const fs::path& folder) {
    for (const std::string_view name : kShadertoyTabs) {
        const fs::path file = folder / (std::string(name) + ".glsl");
        std::error_code error;
        if (std::ranges::find(tabs_, name, &Tab::name) == tabs_.end() && fs::exists(file, error))
            warn(
                fmt::format("{} stands there and is none of this scene's; take it away before the "
                            "folder is imported",
                            file.string()));
    }
}

void Exporter::write(const fs::path& folder) {
    require_folder(folder);
    warn_of_files();
    std::vector<std::string> texts;
    Json passes = Json::array();
    for (const Tab& tab : tabs_) {
        texts.push_back(tab_text(tab));
        passes.push_back(tab_json(tab, texts.back()));
    }
    const Json info = {{"id", ""}, {"name", preset_.title}, {"username", ""}, {"description", ""}};
    const Json shader = {{"Shader", {{"ver", "0.1"}, {"info", info}, {"renderpass", passes}}}};
    std::vector<NamedFile> outputs = {{"-o", (folder / kShadertoyFile).string()}};
    for (const Tab& tab : tabs_)
        outputs.push_back({"-o", (folder / (tab.name + ".glsl")).string()});
    require_apart(outputs, files_read_for(preset_));
    texts.push_back(json_text(shader) + "\n");
    require_unedited(outputs, texts);
    write_all(folder, texts);
}

// What stands there is replaced where an export left it so, as its shadertoy.json tells, or as this
// one would. `texts`: the tabs', and that of shadertoy.json, which is the first of the outputs.
void Exporter::require_unedited(const std::vector<NamedFile>& outputs,
                                const std::vector<std::string>& texts) const {
    const auto text_of = [&](const NamedFile& output) {
        const auto index = static_cast<std::size_t>(&output - outputs.data());
        return index == 0 ? texts.back() : texts[index - 1];
    };
    std::set<std::string> codes;
    std::string why_not;
    try {
        const Json known = Json::parse(read_bytes(outputs.front().name, why_not).value_or(""));
        if (known.at("Shader").at("info").at("id") == "")
            for (const Json& pass : known.at("Shader").at("renderpass"))
                codes.insert(pass.at("code").get<std::string>());
    } catch (const Json::exception&) {  // it is none of an export
    }
    for (const NamedFile& output : outputs) {
        std::error_code unknown;
        if (fs::symlink_status(output.name, unknown).type() != fs::file_type::regular) continue;
        const std::string there = read_bytes(output.name, why_not).value_or("");
        const bool is_left = &output == &outputs.front() ? !codes.empty() : codes.contains(there);
        if (!is_left && there != text_of(output))
            throw cannot_write(output.name,
                               "it is there already, and somebody may have worked on it; name "
                               "another folder, or move it away");
    }
}

// No empty folder stays where the first of them cannot be written.
void Exporter::write_all(const fs::path& folder, const std::vector<std::string>& texts) {
    std::error_code error;
    const bool is_new = !fs::exists(folder, error);
    make_folder(folder);
    try {
        for (std::size_t i = 0; i < texts.size(); ++i) {
            const bool is_tab = i < tabs_.size();
            if (!is_tab) warn_of_others(folder);
            const fs::path file = folder / (is_tab ? tabs_[i].name + ".glsl" : kShadertoyFile);
            write_whole_file(cleared(file), std::as_bytes(std::span(texts[i])));
            say_result("{}\n", file.string());
        }
    } catch (...) {
        if (is_new && fs::is_empty(folder, error)) fs::remove(folder, error);
        throw;
    }
}

}  // namespace

void run_export(const ExportOptions& options) {
    if (options.output.empty())
        throw UsageError("Name with -o a folder for the tabs, or a .html file for a page.");
    if (is_page(options.output)) return write_page(options);
    if (!options.controls)
        throw UsageError("--no-controls is for a page; name one: -o scene.html.");
    const Preset preset = open_preset(options.view);
    const auto context = make_egl_context(options.view.device);
    Exporter(preset).write(options.output);
}

}  // namespace glint
