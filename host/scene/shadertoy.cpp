// Reading shaders of the site.
#include "scene/shadertoy.h"

#include "base/canonical_name.h"
#include "base/words.h"
#include "glsl/raw_text.h"
#include "glsl/sampler_use.h"
#include "scene/scene_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct KnownId {
    int number;
    std::string_view word, tab;
};
constexpr std::array<KnownId, 5> kKnownIds = {{{257, "4dXGR8", "bufferA"},
                                               {258, "XsXGR8", "bufferB"},
                                               {259, "4sXGR8", "bufferC"},
                                               {260, "XdfGR8", "bufferD"},
                                               {41, "4dX3Rr", "cubeA"}}};

// Buffers that no picture reads are for nothing.
bool draws_or_sounds(const Shadertoy& shader) {
    return std::ranges::any_of(shader.tabs, [](const ShadertoyTab& tab) {
        return tab.name == "image" || tab.name == "sound";
    });
}

// A member as text, whether it is written as a string, a number or a truth value. Lists and objects
// are none: they may be nested deeper than a stack holds.
std::string word(const Json& object, std::string_view key) {
    if (!object.is_object()) return {};
    const auto found = object.find(key);
    if (found == object.end() || found->is_null() || found->is_structured()) return {};
    return found->is_string() ? found->get<std::string>() : found->dump();
}

const Json& member(const Json& object, std::string_view key) {
    static const Json kNothing;
    if (!object.is_object()) return kNothing;
    const auto found = object.find(key);
    return found == object.end() ? kNothing : *found;
}

// The first of several spellings that the object has.
std::string word(const Json& object, std::string_view key, std::string_view other) {
    const std::string first = word(object, key);
    return first.empty() ? word(object, other) : first;
}

std::string known_tab(std::string_view id) {
    for (const KnownId& known : kKnownIds)
        if (id == fmt::to_string(known.number) || id == known.word) return std::string(known.tab);
    return {};
}

// "Buffer A", "Buf A", "buf_a", "BufferA" → bufferA; empty for other names.
std::string tab_of_name(std::string_view name) {
    std::string letters;
    for (const char c : in_small_letters(name))
        if (c >= 'a' && c <= 'z') letters += c;
    if (letters == "common" || letters == "image" || letters == "sound") return letters;
    if (letters == "main") return "image";
    if (letters == "cube" || letters == "cubea" || letters == "cubemap" || letters == "cubemapa")
        return "cubeA";
    const char last = letters.empty() ? ' ' : letters.back();
    const std::string_view front = std::string_view(letters).substr(0, letters.size() - 1);
    if (last >= 'a' && last <= 'd' && (front == "buf" || front == "buffer"))
        return std::string("buffer") + static_cast<char>(last - 'a' + 'A');
    return {};
}

// By what it puts out where that is known, then by its name.
std::string tab_name(const Json& pass) {
    const std::string kind = in_small_letters(word(pass, "type"));
    if (kind == "common" || kind == "sound" || kind == "image") return kind;
    if (kind == "cubemap") return "cubeA";
    const Json& outputs = member(pass, "outputs");
    if (outputs.is_array() && !outputs.empty()) {
        const Json& output = outputs.front();
        const std::string id = output.is_object()   ? word(output, "id")
                               : output.is_string() ? output.get<std::string>()
                               : output.is_array()  ? ""
                                                    : output.dump();
        if (const std::string known = known_tab(id); !known.empty()) return known;
    }
    return tab_of_name(word(pass, "name"));
}

ShadertoyInput read_input(const Json& json, const std::map<std::string, std::string>& tab_of_id) {
    ShadertoyInput input;
    const std::string channel = word(json, "channel");
    input.channel = channel.size() == 1 ? channel[0] - '0' : -1;
    input.kind = in_small_letters(word(json, "ctype", "type"));
    input.file = word(json, "src", "filepath");
    for (const Json& face : member(json, "faces"))
        if (face.is_string()) input.faces.push_back(face.get<std::string>());
    const std::string id = word(json, "id");
    if (input.kind == "buffer" || input.kind == "cubemap") {
        const auto named = tab_of_id.find(id);
        input.buffer = named != tab_of_id.end() ? named->second : known_tab(id);
        // Older exports number the buffer in its file: /media/previz/buffer00.png.
        const std::size_t at = input.file.find("/buffer0");
        if (input.buffer.empty() && at != std::string::npos && at + 8 < input.file.size())
            input.buffer =
                std::string("buffer") + static_cast<char>('A' + (input.file[at + 8] - '0') % 4);
    }
    const Json& sampler = member(json, "sampler");
    input.filter = in_small_letters(word(sampler, "filter"));
    input.wrap = in_small_letters(word(sampler, "wrap"));
    if (const std::string vflip = in_small_letters(word(sampler, "vflip")); !vflip.empty())
        input.vflip = vflip == "true";
    return input;
}

// A tab that is there already, word for word, is taken once: some exports write one twice.
void add_tab(Shadertoy& shader, ShadertoyTab tab, const fs::path& file, Diagnostics& diagnostics) {
    const auto same = std::ranges::find(shader.tabs, tab.name, &ShadertoyTab::name);
    if (same == shader.tabs.end())
        shader.tabs.push_back(std::move(tab));
    else if (*same == tab)
        diagnostics.push_back({Severity::warning,
                               {file.string()},
                               fmt::format("the tab {} is there twice, word for word; one is taken",
                                           in_quotes(tab.name))});
    else
        diagnostics.push_back(
            {Severity::error,
             {file.string()},
             fmt::format("two tabs are {} and differ; rename one of them, or take it out",
                         in_quotes(tab.name)),
             true});
}

bool is_beyond_channels(const ShadertoyInput& input) {
    return input.channel < 0 || input.channel > 3;
}

// The site's own dialect wraps it once more.
const Json& shader_of(const Json& outer) {
    return outer.is_object() && outer.contains("Shader") ? outer["Shader"] : outer;
}

class JsonReader {
public:
    JsonReader(const fs::path& file, Diagnostics& diagnostics)
        : file_(file), diagnostics_(diagnostics) {}

    std::optional<Shadertoy> shader(const Json& outer);

private:
    std::vector<std::string> tab_names(const Json& passes);
    std::optional<ShadertoyTab> tab(const std::string& name, const Json& pass,
                                    const std::map<std::string, std::string>& tab_of_id);
    void warn_of(const ShadertoyInput& input, const std::string& tab);
    void warn(const std::string& tab, const std::string& what) {
        diagnostics_.push_back({Severity::warning,
                                {file_.string()},
                                fmt::format("the tab {}: {}", in_quotes(tab), what)});
    }
    void error(const std::string& text) {
        diagnostics_.push_back({Severity::error, {file_.string()}, text, true});
    }

    const fs::path& file_;
    Diagnostics& diagnostics_;
};

// A buffer whose id and name are strange takes the next letter that is free.
std::vector<std::string> JsonReader::tab_names(const Json& passes) {
    std::vector<std::string> names, types;
    for (const Json& pass : passes) {
        names.push_back(tab_name(pass));
        types.push_back(in_small_letters(word(pass, "type")));
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool is_buffer = types[i].empty() || types[i].starts_with("buf");
        for (char letter = 'A'; letter <= 'D' && is_buffer && names[i].empty(); ++letter) {
            const std::string free = std::string("buffer") + letter;
            if (std::ranges::find(names, free) == names.end()) names[i] = free;
        }
    }
    return names;
}

std::optional<ShadertoyTab> JsonReader::tab(const std::string& name, const Json& pass,
                                            const std::map<std::string, std::string>& tab_of_id) {
    if (name.empty()) {
        error(fmt::format("the tab {} is none that the site has; name it Buffer A to D",
                          in_quotes(word(pass, "name"))));
        return std::nullopt;
    }
    if (!member(pass, "code").is_string()) {
        error(fmt::format("the tab {} has no \"code\" that is text; export the shader again",
                          in_quotes(name)));
        return std::nullopt;
    }
    ShadertoyTab tab{.name = name, .code = word(pass, "code"), .inputs = {}};
    if (tab.code.find('\0') != tab.code.npos) {
        error(
            fmt::format("the code of the tab {} is no text: there is a NUL in it; export the "
                        "shader again",
                        in_quotes(name)));
        return std::nullopt;
    }
    const Json& inputs = member(pass, "inputs");
    if (inputs.is_array())
        for (const Json& input : inputs) tab.inputs.push_back(read_input(input, tab_of_id));
    std::set<int> channels;
    for (const ShadertoyInput& input : tab.inputs) {
        warn_of(input, name);
        if (is_beyond_channels(input) || channels.insert(input.channel).second) continue;
        warn(name,
             fmt::format("channel {} has more than one input; the first is taken", input.channel));
    }
    std::erase_if(tab.inputs, is_beyond_channels);
    return tab;
}

void JsonReader::warn_of(const ShadertoyInput& input, const std::string& tab) {
    constexpr std::array<std::string_view, 4> kFilters = {"", "nearest", "linear", "mipmap"};
    constexpr std::array<std::string_view, 3> kWraps = {"", "clamp", "repeat"};
    if (is_beyond_channels(input))
        return warn(tab, "an input has no channel from 0 to 3, and is left out");
    if (std::ranges::find(kFilters, input.filter) == kFilters.end())
        warn(tab,
             fmt::format("channel {} has the filter {}, which the site has not; choose nearest, "
                         "linear or mipmap",
                         input.channel, in_quotes(input.filter)));
    if (std::ranges::find(kWraps, input.wrap) == kWraps.end())
        warn(tab, fmt::format("channel {} has the wrap {}, which the site has not; choose clamp or "
                              "repeat",
                              input.channel, in_quotes(input.wrap)));
}

std::optional<Shadertoy> JsonReader::shader(const Json& outer) {
    const Json& json = shader_of(outer);
    const Json& passes = member(json, "renderpass");
    if (!passes.is_array() || passes.empty()) {
        error("there is no shader in it: \"renderpass\" is missing; export the shader again");
        return std::nullopt;
    }
    Shadertoy shader;
    const Json& info = member(json, "info");
    shader.id = word(info, "id");
    shader.title = word(info, "name");
    shader.author = word(info, "username");
    shader.description = word(info, "description");
    const std::vector<std::string> names = tab_names(passes);
    std::map<std::string, std::string> tab_of_id;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Json& outputs = member(passes[i], "outputs");
        if (!outputs.is_array()) continue;
        for (const Json& output : outputs)
            if (const std::string id = word(output, "id"); !id.empty()) tab_of_id[id] = names[i];
    }
    for (std::size_t i = 0; i < names.size(); ++i)
        if (auto read = tab(names[i], passes[i], tab_of_id))
            add_tab(shader, std::move(*read), file_, diagnostics_);
    if (!has_errors(diagnostics_) && !draws_or_sounds(shader))
        error("there is no image tab in it, which draws the picture; export the shader again");
    return shader;
}

// The site draws buffers in the order of the file; of a folder's files they are in that of the
// letters already.
void sort_tabs(Shadertoy& shader) {
    const auto rank = [](const ShadertoyTab& tab) {
        return std::ranges::find(kShadertoyTabs,
                                 tab.name.starts_with("buffer") ? "bufferA" : tab.name);
    };
    std::ranges::stable_sort(shader.tabs,
                             [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

// Which of several it is that something is told of.
void name_shader(std::size_t number, const Json& outer, std::span<Diagnostic> diagnostics) {
    const std::string title = word(member(shader_of(outer), "info"), "name");
    for (Diagnostic& diagnostic : diagnostics)
        diagnostic.text =
            fmt::format("shader {}{}: {}", number, title.empty() ? "" : ", " + in_quotes(title),
                        diagnostic.text);
}

std::string read_text(const fs::path& file, Diagnostics& diagnostics) {
    std::string why_not;
    const auto bytes = read_bytes(file, why_not);
    if (!bytes)
        diagnostics.push_back(
            {Severity::error, {file.string()}, fmt::format("cannot read it: {}", why_not), true});
    return bytes ? clean_text(*bytes).text : std::string();
}

// Copies and ends of what is nested deeper would overflow the stack.
constexpr int kDeepest = 100;

// How deep what a text of JSON has opened is nested.
int depth_of(std::string_view text) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') in_string = !in_string;
        if (in_string && c == '\\') ++i;
        if (in_string) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    return deepest;
}

}  // namespace

std::vector<Shadertoy> read_shadertoys(const fs::path& file, Diagnostics& diagnostics) {
    std::vector<Shadertoy> shaders;
    const std::string text = read_text(file, diagnostics);
    if (has_errors(diagnostics)) return {};
    if (depth_of(text) > kDeepest) {
        diagnostics.push_back({Severity::error,
                               {file.string()},
                               "it is nested as no shader is; export the shader again",
                               true});
        return {};
    }
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        const std::string before = text.substr(0, error.byte > 0 ? error.byte - 1 : 0);
        const auto line = std::ranges::count(before, '\n') + 1;
        const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
        diagnostics.push_back(
            {Severity::error,
             {file.string(), static_cast<int>(line), static_cast<int>(column)},
             "this is no JSON; export the shader again, or give a folder of its tabs",
             true});
        return {};
    } catch (const Json::out_of_range&) {
        diagnostics.push_back({Severity::error,
                               {file.string()},
                               "a number in it is too large; export the shader again",
                               true});
        return {};
    }
    JsonReader reader(file, diagnostics);
    const Json& list = json.is_object() && json.contains("shaders") ? json["shaders"] : json;
    const Json one = list.is_array() ? list : Json::array({list});
    for (std::size_t i = 0; i < one.size(); ++i) {
        const std::size_t told = diagnostics.size();
        auto shader = reader.shader(one[i]);
        if (one.size() > 1) name_shader(i + 1, one[i], std::span(diagnostics).subspan(told));
        if (shader) shaders.push_back(std::move(*shader));
    }
    if (one.empty())
        diagnostics.push_back({Severity::error, {file.string()}, "there is no shader in it", true});
    if (has_errors(diagnostics)) return {};
    for (Shadertoy& shader : shaders) sort_tabs(shader);
    return shaders;
}

int output_id(std::string_view tab) {
    const auto* const known = std::ranges::find(kKnownIds, tab, &KnownId::tab);
    return known != kKnownIds.end() ? known->number : tab == "image" ? 37 : 38;
}

bool is_within(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const auto place_of = [&](const fs::path& path) {
        return fs::weakly_canonical(fs::absolute(path.empty() ? "." : path, error), error);
    };
    const fs::path inner = place_of(file), outer = place_of(folder);
    const fs::path way = inner.lexically_relative(outer);
    return !inner.empty() && !outer.empty() && !way.empty() && *way.begin() != "..";
}

namespace {

constexpr const char* kTabFiles =
    "a Shadertoy's tabs are image.glsl, common.glsl, bufferA.glsl …, sound.glsl";

// The tab that a file of a folder is; "" for any other file.
std::string tab_of_file(const fs::path& file) {
    const std::string extension = ending_of(file);
    const bool is_text =
        extension == ".glsl" || extension == ".frag" || extension == ".fs" || extension == ".txt";
    return is_text ? tab_of_name(file.stem().string()) : std::string();
}

// What an export says of the tabs that it wrote, of which somebody may have edited the code since.
std::optional<Shadertoy> read_beside_tabs(const fs::path& folder, Diagnostics& diagnostics,
                                          bool anywhere) {
    const fs::path file = folder / kShadertoyFile;
    std::error_code error;
    if (!fs::is_regular_file(file, error) || (!anywhere && !is_within(file, folder)))
        return std::nullopt;
    Diagnostics found;
    std::vector<Shadertoy> shaders = read_shadertoys(file, found);
    if (shaders.size() == 1 && !has_errors(found)) {
        diagnostics.insert(diagnostics.end(), found.begin(), found.end());
        return std::move(shaders.front());
    }
    diagnostics.push_back(
        {Severity::warning, found.empty() ? Place{file.string()} : found.front().place,
         fmt::format("what the tabs read cannot be read from it, so iChannel0 to 3 "
                     "are the buffers A to D that are there{}",
                     found.empty() ? "" : ": " + found.front().text)});
    return std::nullopt;
}

// The buffers A to D that are there, where nothing says what a tab reads, and the cube where it
// reads one.
std::vector<ShadertoyInput> usual_inputs(const ShadertoyTab& tab, const Shadertoy& shader) {
    std::vector<ShadertoyInput> inputs;
    if (tab.name == "common") return inputs;
    const auto add = [&](int channel, const char* kind, const std::string& buffer) {
        inputs.push_back({.channel = channel,
                          .kind = kind,
                          .buffer = buffer,
                          .file = {},
                          .filter = {},
                          .wrap = {},
                          .vflip = {}});
    };
    const auto common = std::ranges::find(shader.tabs, "common", &ShadertoyTab::name);
    const std::string text = (common == shader.tabs.end() ? "" : common->code) + tab.code;
    const Reading reading = read_glsl(text, known_of_scene());
    const bool has_cube =
        std::ranges::find(shader.tabs, "cubeA", &ShadertoyTab::name) != shader.tabs.end();
    for (int channel = 0; channel < 4; ++channel) {
        const std::string buffer = fmt::format("buffer{}", static_cast<char>('A' + channel));
        const auto use = sampler_used_as(reading, fmt::format("iChannel{}", channel));
        if (has_cube && use == "samplerCube")
            add(channel, "cubemap", "cubeA");
        else if (std::ranges::find(shader.tabs, buffer, &ShadertoyTab::name) != shader.tabs.end())
            add(channel, "buffer", buffer);
    }
    return inputs;
}

}  // namespace

bool is_shadertoy_folder(const fs::path& folder) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (tab_of_file(entry.path()) == "image") return true;
    return false;
}

std::optional<Shadertoy> read_shadertoy_folder(const fs::path& folder, Diagnostics& diagnostics,
                                               bool anywhere) {
    Shadertoy shader;
    shader.title = fs::absolute(folder / "").parent_path().filename().string();
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        const std::string name = tab_of_file(file);
        if (name.empty() && ending_of(file) == ".glsl")
            diagnostics.push_back({Severity::warning,
                                   {file.string()},
                                   fmt::format("it is no tab, and is left out; {}", kTabFiles)});
        if (name.empty()) continue;
        if (!anywhere && !is_within(file, folder)) {
            diagnostics.push_back({Severity::warning,
                                   {file.string()},
                                   "it leads out of this folder and is left out; --anywhere takes "
                                   "it"});
            continue;
        }
        add_tab(shader, {.name = name, .code = read_text(file, diagnostics), .inputs = {}}, file,
                diagnostics);
    }
    sort_tabs(shader);
    if (error || !draws_or_sounds(shader))
        diagnostics.push_back({Severity::error,
                               {folder.string()},
                               fmt::format("there is no image.glsl in this folder; {}", kTabFiles),
                               true});
    if (has_errors(diagnostics)) return std::nullopt;
    const std::optional<Shadertoy> exported = read_beside_tabs(folder, diagnostics, anywhere);
    if (exported) {
        shader.id = exported->id;
        if (!exported->title.empty()) shader.title = exported->title;
        shader.author = exported->author;
        shader.description = exported->description;
    }
    for (ShadertoyTab& tab : shader.tabs) tab.inputs = usual_inputs(tab, shader);
    for (const ShadertoyTab& known : exported ? exported->tabs : std::vector<ShadertoyTab>())
        for (ShadertoyTab& tab : shader.tabs)
            if (tab.name == known.name) tab.inputs = known.inputs;
    return shader;
}

}  // namespace glint
