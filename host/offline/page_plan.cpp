#include "offline/page_plan.h"

#include "glsl/division.h"
#include "glsl/loops.h"
#include "offline/common.h"
#include "offline/page_inputs.h"
#include "render/buffer.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <unordered_map>
#include <vector>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

// The passes' texts are the scene's with a few words changed: what they share stands there once.
class Lines {
public:
    // Pairs of the first line and the one behind the last.
    Json runs_of(const std::string& text);
    Json list() && { return std::move(list_); }

private:
    Json list_ = Json::array();
    std::unordered_map<std::string, std::size_t> known_;
};

Json Lines::runs_of(const std::string& text) {
    std::vector<std::array<std::size_t, 2>> runs;
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
        end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        // A line that follows in the list as it does here goes on with the run, also where an
        // earlier one is the same.
        const std::size_t next = runs.empty() ? 0 : runs.back()[1];
        if (!runs.empty() && next < list_.size() && list_[next] == line) {
            ++runs.back()[1];
            continue;
        }
        const auto [known, is_new] = known_.try_emplace(line, list_.size());
        // Within a new text the empty and closing lines repeat; a copy costs less than a run.
        const bool is_short = line.size() < 8 && next == list_.size();
        if (is_new || is_short) list_.push_back(line);
        const std::size_t at = is_new || is_short ? list_.size() - 1 : known->second;
        if (!runs.empty() && at == next)
            ++runs.back()[1];
        else
            runs.push_back({at, at + 1});
    }
    return runs;
}

// Numbers of the floats by which the text divides as they are.
std::vector<std::size_t> divisors(const Scene& scene) {
    const Reading reading = read_glsl(scene.text, known_of_scene());
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i) {
        if (scene.tweaks[i].type != TweakType::float1) continue;
        Edits edits(reading);
        name_divisions(reading, {{scene.tweaks[i].name, i}}, edits);
        if (edits.apply().text != scene.text) numbers.push_back(i);
    }
    return numbers;
}

// What name_divisions() (glsl/division.h) writes, by whether the page says that the value is 0.
std::string division_words(const Preset& preset) {
    std::string text;
    for (const std::size_t i : divisors(preset.scene)) {
        text += fmt::format(
            "#if glint_zero{0}\n#define glint_over{0} *\n#define glint_by{0} *=\n"
            "#define glint_divisor{0} 1e39\n#else\n#define glint_over{0} /\n"
            "#define glint_by{0} /=\n#define glint_divisor{0} {1}\n#endif\n",
            i, preset.scene.tweaks[i].name);
    }
    return text;
}

class Planner {
public:
    explicit Planner(const Preset& preset)
        : preset_(preset), limits_(texture_limits()), divisions_(division_words(preset)) {}

    Json passes(const CompiledScene& scene);
    Json plan(const CompiledScene& scene, const CompiledScene* sound);

private:
    Json pass_json(const CompiledScene& scene, std::size_t index);
    void add_shape(Json& json, const CompiledScene& scene, std::size_t index) const;
    Json buffer_json(const CompiledScene& scene, std::size_t index) const;
    void add_unfilled(Json& samplers, const PassProgram& program);
    std::size_t input_of(const CompiledScene& scene, std::size_t sampler);
    std::string for_software(const std::string& text) const;

    const Preset& preset_;
    TextureLimits limits_;
    std::string divisions_;
    Lines lines_;
    Json inputs_ = Json::array();
    std::map<std::pair<const CompiledScene*, std::size_t>, std::size_t> known_inputs_;
    Diagnostics diagnostics_;
};

// The size of a pass's buffer: pixels, or a share of the picture's.
void add_size(Json& json, const Pass& pass) {
    if (pass.size || pass.cube) {
        const glm::ivec2 size = buffer_size(pass, glm::ivec2(1));
        json["size"] = {size.x, size.y};
    } else {
        json["scale"] = pass.scale;
    }
}

std::size_t Planner::input_of(const CompiledScene& scene, std::size_t sampler) {
    const auto [known, is_new] = known_inputs_.try_emplace({&scene, sampler}, inputs_.size());
    if (!is_new) return known->second;
    const Sampler& read = sampler_at(preset_, sampler);
    Json input;
    try {
        input = page_input(read, limits_);
    } catch (const NoRoom&) {
        throw;
    } catch (const std::runtime_error& error) {
        diagnostics_.push_back({Severity::error, read.place, error.what(), true});
    }
    if (read.source == Source::buffer) {
        const auto& passes = scene.graph.passes;
        const auto pass = std::ranges::find(passes, read.pass, &GraphPass::pass);
        if (pass != passes.end()) input["pass"] = pass - passes.begin();
        add_size(input, preset_.scene.passes[read.pass]);
    }
    inputs_.push_back(std::move(input));
    return known->second;
}

// The texture that a pass fills, as those need it who read it.
Json Planner::buffer_json(const CompiledScene& scene, std::size_t index) const {
    const GraphPass& graph = scene.graph.passes[index];
    const Pass& pass = preset_.scene.passes[graph.pass];
    PageTextureUse use{.drawn = true};
    for (const PassProgram& reader : scene.programs) {
        for (const SamplerUniform& uniform : reader.samplers) {
            const Sampler& sampler = sampler_at(preset_, uniform.sampler);
            if (sampler.source != Source::buffer || sampler.pass != graph.pass) continue;
            if (sampler.filter != Filter::nearest) use.filtered = true;
            if (sampler.filter == Filter::mipmap) use.mipmaps = true;
        }
    }
    Json json = page_texture(pass.cube ? SamplerType::samplerCube : SamplerType::sampler2D,
                             std::string(name_of(pass.format)), use);
    json["outputs"] = pass.outputs.size();
    json["sides"] = graph.feedback ? 2 : 1;
    return json;
}

void Planner::add_shape(Json& json, const CompiledScene& scene, std::size_t index) const {
    const std::size_t pass = scene.graph.passes[index].pass;
    if (pass == kSoundPass) {  // its samples are read back
        json.update(page_texture(SamplerType::sampler2D, "rgba32f", {.drawn = true}));
        json.update({{"outputs", 1}, {"sides", 1}, {"size", {kSoundBlockWidth, kSoundBlockRows}}});
    } else if (fills_a_buffer(pass)) {
        add_size(json, preset_.scene.passes[pass]);
        json.update(buffer_json(scene, index));
        const Step& step = preset_.scene.passes[pass].step;
        if (step) json["step"] = {step.numerator, step.denominator};
    } else {
        json["faces"] = 1;
    }
}

// The text with its loops tested at their ends (glsl/loops.h). Definitions like those that the page
// will write tell meanwhile what the names of the tweaks stand for.
std::string Planner::for_software(const std::string& text) const {
    std::string names;
    for (std::size_t i = 0; i < preset_.scene.tweaks.size(); ++i) {
        const Tweak& tweak = preset_.scene.tweaks[i];
        names += fmt::format("#define {} uniform {} {};\n", named_tweak(i), glsl_name(tweak.type),
                             tweak.name);
        names += fmt::format("#define glint_zero{} 0\n", i);
    }
    const std::size_t begin = text.find('\n') + 1;  // behind #version
    std::string changed = text;
    changed = test_loops_at_end(changed.insert(begin, names));
    return changed.erase(begin, names.size());
}

// What nothing fills. GLSL's other kinds of samplers have no texture here.
void Planner::add_unfilled(Json& samplers, const PassProgram& program) {
    for (const UnfilledSampler& unfilled : program.unfilled) {
        if (!unfilled.type) continue;
        samplers[unfilled.name] = inputs_.size();
        inputs_.push_back(page_unfilled(*unfilled.type));
    }
}

Json Planner::pass_json(const CompiledScene& scene, std::size_t index) {
    const PassProgram& program = scene.programs[index];
    PassText text = pass_text(preset_, program.pass, {.specialise = false, .named = true});
    text.text.insert(text.text.find('\n') + 1, divisions_);  // behind #version
    text.user_begin += divisions_.size();
    const auto user = text.text.begin() + static_cast<std::ptrdiff_t>(text.user_begin);
    const std::string soft = for_software(text.text);
    Json json = {{"name", pass_name(preset_.scene, program.pass)},
                 {"text", lines_.runs_of(text.text)},
                 {"first", std::count(text.text.begin(), user, '\n')}};
    if (soft != text.text) json["soft"] = lines_.runs_of(soft);
    add_shape(json, scene, index);
    Json samplers = Json::object(), channels = Json::array({nullptr, nullptr, nullptr, nullptr});
    for (const SamplerUniform& uniform : program.samplers) {
        const std::string& name = sampler_at(preset_, uniform.sampler).name;
        samplers[name] = input_of(scene, uniform.sampler);
    }
    add_unfilled(samplers, program);
    for (char digit = '0'; digit < '4'; ++digit) {  // their other names
        const std::string name = fmt::format("iChannel{}", digit);
        if (samplers.contains(name)) samplers[fmt::format("iCh{}.sampler", digit)] = samplers[name];
    }
    for (const std::size_t sampler : channels_told_of(preset_, program)) {
        if (sampler_at(preset_, sampler).source == Source::none) continue;
        const char digit = sampler_at(preset_, sampler).name.back();  // of iChannel0
        channels[static_cast<std::size_t>(digit - '0')] = input_of(scene, sampler);
    }
    if (!samplers.empty()) json["samplers"] = samplers;
    if (!channels_told_of(preset_, program).empty()) json["channels"] = channels;
    return json;
}

Json Planner::passes(const CompiledScene& scene) {
    Json list = Json::array();
    for (std::size_t i = 0; i < scene.programs.size(); ++i) list.push_back(pass_json(scene, i));
    return list;
}

// Days from 1970 on.
int day_of(const Date& date) {
    const std::chrono::sys_days first =
        std::chrono::year(date.year) / static_cast<unsigned>(date.month) / 1;
    return static_cast<int>(first.time_since_epoch().count()) + date.day - 1;
}

// As many numbers as the tweak has.
Json numbers(const Tweak& tweak, const TweakValue& value) {
    return std::vector<double>(value.begin(), value.begin() + component_count(tweak.type));
}

Json tweak_json(const Tweak& tweak, const TweakValue& value) {
    Json json = {
        {"name", tweak.name}, {"type", glsl_name(tweak.type)}, {"value", numbers(tweak, value)}};
    std::vector<std::string> names = tweak.names;
    if (tweak.type == TweakType::bool1) names = {"off", "on"};
    if (!names.empty()) {
        json["names"] = names;
        json["range"] = {0, names.size() - 1};
    } else if (tweak.min && tweak.max) {
        json["range"] = {*tweak.min, *tweak.max};
    }
    if (tweak.is_colour) json["colour"] = true;
    if (tweak.log) json["log"] = true;
    return json;
}

Json tweaks_json(const Preset& preset) {
    Json list = Json::array();
    const std::vector<bool> indices =
        index_tweaks(preset.scene, read_glsl(preset.scene.text, known_of_scene()));
    for (std::size_t i = 0; i < preset.values.size(); ++i) {
        list.push_back(tweak_json(preset.scene.tweaks[i], preset.values[i]));
        if (indices[i]) list.back()["index"] = true;
    }
    return list;
}

Json events_json(const Preset& preset) {
    Json list = Json::array();
    for (const Event& event : preset.events) {
        Json json = {{"t", event.time}, {"down", event.down}};
        if (event.key >= 0)
            json["key"] = event.key;
        else
            json["mouse"] = {event.mouse.x, event.mouse.y};
        list.push_back(json);
    }
    return list;
}

// [line, file, line of it], where one does not follow from the line before.
Json origins_json(const Scene& scene) {
    Json list = Json::array();
    for (std::size_t i = 0; i < scene.origins.size(); ++i) {
        const Origin& here = scene.origins[i];
        const bool follows = i > 0 && scene.origins[i - 1].file == here.file &&
                             scene.origins[i - 1].line + 1 == here.line;
        if (!follows) list.push_back({i + 1, here.file, here.line});
    }
    return list;
}

// A triangle that covers all.
constexpr const char* kVertex =
    "#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID % 2 * 4 - 1, gl_VertexID / 2 * "
    "4 "
    "- 1, 0, 1); }";

Json Planner::plan(const CompiledScene& scene, const CompiledScene* sound) {
    Json files = Json::array();
    for (const auto& file : preset_.scene.files) files.push_back(file.filename().string());
    Json json = {{"title", preset_.title.empty() ? preset_.file.stem().string() : preset_.title},
                 {"size", {preset_.size.x, preset_.size.y}},
                 {"time", preset_.time},
                 {"settle", preset_.settle},
                 {"day", day_of(preset_.date)},
                 {"seconds", preset_.date.seconds},
                 {"tweaks", tweaks_json(preset_)},
                 {"events", events_json(preset_)},
                 {"vertex", kVertex},
                 {"passes", passes(scene)}};
    if (sound) json["sound"] = passes(*sound);
    report(diagnostics_);
    json["keyboard"] = std::ranges::any_of(
        inputs_, [](const Json& input) { return input["source"] == "keyboard"; });
    json["inputs"] = std::move(inputs_);
    json["files"] = std::move(files);
    json["origins"] = origins_json(preset_.scene);
    json["lines"] = std::move(lines_).list();
    return json;
}

}  // namespace

Json page_plan(const Preset& preset, const CompiledScene& scene, const CompiledScene* sound) {
    return Planner(preset).plan(scene, sound);
}

}  // namespace glint
