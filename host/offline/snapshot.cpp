#include "offline/snapshot.h"

#include "base/hash.h"
#include "base/json_text.h"
#include "base/memory.h"
#include "base/numbered_name.h"
#include "base/readable_file.h"
#include "base/terminal.h"
#include "media/parts.h"
#include "render/room.h"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <span>
#include <sstream>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The names of the file's texts: a line of JSON, and a digest of it and of all buffers.
constexpr const char* kStateText = "glint:state";
constexpr const char* kDigestText = "glint:digest";

// Of a file of any size, a piece at a time. What cannot be read is told where it is needed.
void add_content(Hash& hash, const fs::path& file) try {
    const ReadableFile in(file);
    std::vector<char> piece(1 << 20);
    std::size_t at = 0;
    for (std::size_t got; (got = in.read(piece, at)) > 0; at += got)
        hash.add_part({piece.data(), got});
    hash.add({});
} catch (const Unreadable&) {
    hash.add({});
}

Json to_json(const Snapshot& snapshot) {
    Json json = {{"frame", snapshot.frame},
                 {"time", snapshot.time},
                 {"renderer", snapshot.renderer},
                 {"provenance", snapshot.provenance},
                 {"passes", Json::array()}};
    for (const PassState& pass : snapshot.passes) {
        json["passes"].push_back({{"name", pass.pass},
                                  {"size", {pass.shape.size.x, pass.shape.size.y}},
                                  {"format", name_of(pass.shape.format)},
                                  {"outputs", pass.shape.outputs},
                                  {"cube", pass.shape.cube},
                                  {"feedback", pass.shape.feedback},
                                  {"steps_done", pass.steps_done}});
    }
    return json;
}

// EXR knows no bytes: k / 255 is kept as a 16-bit float, which tells all of them apart.
std::vector<std::byte> halves_of(std::span<const std::byte> bytes) {
    std::vector<std::byte> halves(bytes.size() * 2);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const glm::uint16 half =
            glm::packHalf1x16(static_cast<float>(std::to_integer<int>(bytes[i])) / 255.0f);
        std::memcpy(halves.data() + 2 * i, &half, sizeof half);
    }
    return halves;
}

std::vector<std::byte> bytes_of(std::span<const std::byte> halves) {
    std::vector<std::byte> bytes(halves.size() / 2);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        glm::uint16 half = 0;
        std::memcpy(&half, halves.data() + 2 * i, sizeof half);
        const float value = glm::unpackHalf1x16(half);
        bytes[i] = static_cast<std::byte>(value > 0.0f ? std::lround(value * 255.0f) & 255 : 0);
    }
    return bytes;
}

// The textures of a pass in the order of its bytes, without pixels; the faces of a cube stand one
// above the other.
std::vector<Part> parts_of(const PassState& pass) {
    std::vector<Part> parts;
    for (int side = 0; side < (pass.shape.feedback ? 2 : 1); ++side) {
        for (int output = 0; output < pass.shape.outputs; ++output) {
            const std::string number = output > 0 ? fmt::format(" {}", output + 1) : "";
            parts.push_back({.name = pass.pass + number + (side > 0 ? " before" : ""),
                             .size = pass.shape.size * glm::ivec2(1, pass.shape.cube ? 6 : 1),
                             .channels = channel_count(pass.shape.format),
                             .half = bytes_a_channel(pass.shape.format) != 4,
                             .pixels = {}});
        }
    }
    return parts;
}

std::vector<Part> parts_with_pixels(const Snapshot& snapshot) {
    std::vector<Part> all;
    for (const PassState& pass : snapshot.passes) {
        std::vector<Part> parts = parts_of(pass);
        std::span<const std::byte> bytes = pass.bytes;
        const std::size_t one = bytes.size() / parts.size();
        for (Part& part : parts) {
            const auto pixels = bytes.first(one);
            if (bytes_a_channel(pass.shape.format) == 1)
                part.pixels = halves_of(pixels);
            else
                part.pixels.assign(pixels.begin(), pixels.end());
            bytes = bytes.subspan(one);
            all.push_back(std::move(part));
        }
    }
    // A file has at least one, a scene without memory has none.
    if (all.empty()) {
        all.push_back(
            {.name = "nothing", .size = {1, 1}, .half = true, .pixels = std::vector<std::byte>(8)});
    }
    return all;
}

// What reading a state throws where the file is not what parts_with_pixels() and to_json() made.
struct Damaged {};

// Moves the parts of one pass into its bytes.
void take_pixels(PassState& pass, std::span<Part>& parts) {
    for (const Part& wanted : parts_of(pass)) {
        if (parts.empty()) throw Damaged();
        const Part& part = parts.front();
        if (part.name != wanted.name || part.size != wanted.size ||
            part.channels != wanted.channels || part.half != wanted.half)
            throw Damaged();
        const std::vector<std::byte> bytes =
            bytes_a_channel(pass.shape.format) == 1 ? bytes_of(part.pixels) : part.pixels;
        pass.bytes.insert(pass.bytes.end(), bytes.begin(), bytes.end());
        parts = parts.subspan(1);
    }
}

// Throws Json::exception or Damaged.
Snapshot from_json(const Json& json, std::span<Part> parts) {
    Snapshot snapshot{.frame = json.at("frame"),
                      .time = json.at("time"),
                      .renderer = json.at("renderer"),
                      .provenance = json.at("provenance"),
                      .passes = {}};
    for (const Json& pass : json.at("passes")) {
        const auto format = parse_pixel_format(pass.at("format").get<std::string>());
        if (!format) throw Damaged();
        snapshot.passes.push_back({.pass = pass.at("name"),
                                   .shape = {.size = {pass.at("size").at(0), pass.at("size").at(1)},
                                             .format = *format,
                                             .outputs = pass.at("outputs"),
                                             .cube = pass.at("cube"),
                                             .feedback = pass.at("feedback")},
                                   .steps_done = pass.at("steps_done"),
                                   .bytes = {}});
        take_pixels(snapshot.passes.back(), parts);
    }
    if (snapshot.frame < 0) throw Damaged();
    return snapshot;
}

// Of a state's JSON and buffers.
std::string digest_of(const std::string& json, const Snapshot& snapshot) {
    Hash hash;
    hash.add(json);
    for (const PassState& pass : snapshot.passes) {
        hash.add({reinterpret_cast<const char*>(pass.bytes.data()), pass.bytes.size()});
    }
    return hash.text();
}

std::string text_of(const PartsFile& content, std::string_view name) {
    const auto found = std::ranges::find(content.texts, name, &Metadata::value_type::first);
    return found == content.texts.end() ? "" : found->second;
}

std::string tweak_texts(const Preset& preset) {
    std::string text;
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = preset.scene.tweaks[i];
        text += fmt::format("{}{}={}", i == 0 ? "" : " ", tweak.name,
                            format_value(tweak, preset.values[i]));
    }
    return text;
}

std::string event_digest(const Preset& preset) {
    Hash hash;
    for (const Event& event : preset.events) {
        hash.add(fmt::format("{} {} {} {} {}", event.time, event.key, event.down, event.mouse.x,
                             event.mouse.y));
    }
    return hash.text();
}

// The bytes of files, and what a preset fills channels with: of these the text tells nothing.
std::string input_digest(const Preset& preset) {
    Hash hash;
    for (const Sampler& channel : preset.channels)
        if (channel.source != Source::none) hash.add(sampler_facts(channel));
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        for (const std::filesystem::path& file : sampler.files) add_content(hash, file);
    }
    return hash.text();
}

// The tweaks in a text of tweak_texts; a word without "=" goes on with a vector.
std::vector<std::string> tweaks_in(const std::string& text) {
    std::vector<std::string> tweaks;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (word.find('=') != word.npos || tweaks.empty())
            tweaks.push_back(word);
        else
            tweaks.back() += " " + word;
    }
    return tweaks;
}

// Of a text's tweaks those that the other one has not.
std::string tweaks_apart(const std::string& text, const std::string& other) {
    const std::vector<std::string> others = tweaks_in(other);
    std::vector<std::string> apart = tweaks_in(text);
    std::erase_if(apart, [&](const std::string& tweak) {
        return std::ranges::find(others, tweak) != others.end();
    });
    return fmt::format("{}", fmt::join(apart, " "));
}

void require_same_provenance(const Provenance& saved, const Provenance& here) {
    for (const auto& [name, text] : here) {
        const auto found = std::ranges::find(saved, name, &Provenance::value_type::first);
        const std::string other = found == saved.end() ? "nothing" : found->second;
        if (other == text) continue;
        const bool lists = name == "tweaks" && found != saved.end();
        throw StateRefused(ExitCode::usage,
                           fmt::format("It was saved with {} {}, and this run has {}: give what it "
                                       "was saved with, or save it anew.",
                                       name, lists ? tweaks_apart(other, text) : other,
                                       lists ? tweaks_apart(text, other) : text));
    }
}

void tell(Severity severity, const fs::path& file, const std::string& text) {
    Diagnostic diagnostic;
    diagnostic.severity = severity;
    diagnostic.place.file = file.string();
    diagnostic.text = text;
    say_diagnostic(diagnostic);
}

}  // namespace

Provenance provenance_of(const Preset& preset, double fps, bool specialise) {
    Hash text;
    text.add(preset.scene.text);
    const Date& date = preset.date;
    return {{"glint", GLINT_VERSION},
            {"scene text", text.text()},
            {"--size", fmt::format("{}x{}", preset.size.x, preset.size.y)},
            {"--fps", fmt::format("{}", fps)},
            {"tweaks", tweak_texts(preset)},
            {"events", event_digest(preset)},
            {"images", input_digest(preset)},
            {"date", fmt::format("{}-{}-{} {}", date.year, date.month, date.day, date.seconds)},
            {"specialisation", specialise ? "on" : "off"}};
}

void prepare_states(const StateOptions& options) {
    // A state by the name of a scene would take its place.
    const std::string ending = fs::path(options.save).extension().string();
    if (!ending.empty() && ending != ".exr" && ending.find('%') == ending.npos) {
        throw UsageError(fmt::format("--save-state {}: a state is an OpenEXR file; name it {}",
                                     options.save,
                                     fs::path(options.save).replace_extension(".exr").string()));
    }
    if (!options.from.empty() || !options.save.empty()) prepare_image_library("state.exr");
}

void write_snapshot(const fs::path& file, const Snapshot& snapshot) {
    const std::string json = json_text(to_json(snapshot), -1);
    write_parts(file, {.texts = {{kStateText, json}, {kDigestText, digest_of(json, snapshot)}},
                       .parts = parts_with_pixels(snapshot)});
}

Snapshot read_snapshot(const fs::path& file) {
    const auto cannot_read_it = [](const std::string& cause) {
        return StateRefused(ExitCode::missing_file, fmt::format("Cannot read it: {}{}", cause,
                                                                cause.ends_with('?') ? "" : "."));
    };
    try {
        // Its buffers stand in memory as in the file.
        const std::size_t wanted = ReadableFile(file).size(), free = available_memory();
        if (wanted > free) {
            throw cannot_read_it(fmt::format("it takes {} MB of memory, and {} MB are free",
                                             wanted / 1'000'000, free / 1'000'000));
        }
    } catch (const Unreadable& unreadable) {
        throw cannot_read_it(unreadable.cause);
    }
    try {
        PartsFile content = read_parts(file);
        const std::string json = text_of(content, kStateText);
        Snapshot snapshot = from_json(Json::parse(json), content.parts);
        if (digest_of(json, snapshot) == text_of(content, kDigestText)) return snapshot;
    } catch (const Json::exception&) {
    } catch (const Damaged&) {
    } catch (const std::runtime_error&) {
    } catch (const std::bad_alloc&) {
        throw cannot_read_it("there is not enough memory for it");
    }
    throw StateRefused(ExitCode::missing_file,
                       "It is cut short or damaged, or no state that --save-state wrote.");
}

namespace {

// A state is in memory as the renderer gives it, as the parts of its file, and as that file.
void require_memory_for_state(const Renderer& renderer) {
    std::size_t bytes = 0;
    const std::vector<GraphPass>& passes = renderer.graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (passes[i].carries) bytes += renderer.buffer(i).byte_count();
    }
    const std::vector<WantedMemory> wanted = {
        {"the state on its way to or from its file", 3 * bytes}};
    require_memory(wanted,
                   "Make the picture smaller with --size, or give buffers a size= or scale= of "
                   "their own.");
}

}  // namespace

States::States(const StateOptions& options, const Preset& preset, Renderer& renderer,
               const Playback& playback, int settle, Provenance provenance, std::string gpu,
               bool resume)
    : options_(options),
      preset_(preset),
      renderer_(renderer),
      playback_(playback),
      settle_(settle),
      provenance_(std::move(provenance)),
      gpu_(std::move(gpu)),
      resume_(resume) {
    if (!options.save.empty() || !options.from.empty()) require_memory_for_state(renderer);
}

Frame States::frame(int k) const {
    const int extra = std::max(k - playback_.last_frame(), 0);
    return extra > 0 ? settled_frame(preset_, playback_, extra) : playback_.frame(preset_, k);
}

int States::start(int wanted) {
    if (!options_.from.empty()) {
        if (const auto name = numbered_name(options_.from)) {
            if (wanted > 0 && name->numbers_there().empty())
                tell(Severity::warning, options_.from,
                     "There is no state of such a name; all frames from 0 on are played.");
            return start_from_newest(options_.from, wanted);
        }
        try {
            return start_from(options_.from, wanted);
        } catch (const StateRefused& refused) {
            tell(Severity::error, options_.from, refused.what());
            throw Stop(refused.code);
        }
    }
    return resume_ && !options_.save.empty() ? start_from_newest(options_.save, wanted) : 0;
}

int States::start_from_newest(const std::string& text, int wanted) {
    std::vector<fs::path> files;
    if (const auto name = numbered_name(text)) {
        for (const int number : name->numbers_there()) {
            if (number <= wanted) files.push_back(name->name(number));
        }
    } else if (std::error_code error; fs::exists(text, error)) {
        files.emplace_back(text);
    }
    for (auto file = files.rbegin(); file != files.rend(); ++file) {
        try {
            return start_from(*file, wanted);
        } catch (const StateRefused& refused) {
            tell(Severity::warning, *file,
                 std::string(refused.what()) + " An older one is taken, or the start.");
        }
    }
    return 0;
}

int States::start_from(const fs::path& file, int wanted) {
    const Snapshot snapshot = read_snapshot(file);
    require_same_provenance(snapshot.provenance, provenance_);
    const int last = snapshot.frame - 1;  // of those that were played
    if (snapshot.frame > wanted) {
        throw StateRefused(ExitCode::usage,
                           fmt::format("It stands before frame {}, and frame {} is asked for.",
                                       snapshot.frame, wanted));
    }
    if (last >= 0 && frame(last).time != snapshot.time) {
        throw StateRefused(
            ExitCode::usage,
            fmt::format("It was saved after frame {} at {} s, and in this run that frame stands at "
                        "{} s.",
                        last, snapshot.time, frame(last).time));
    }
    try {
        renderer_.set_state(snapshot.passes);
    } catch (const std::runtime_error& error) {
        throw StateRefused(ExitCode::usage, error.what());
    }
    if (snapshot.renderer != gpu_) {
        tell(Severity::warning, file,
             fmt::format("It was saved with {}; the same frames here, with {}, may differ in "
                         "their last digits.",
                         snapshot.renderer, gpu_));
    }
    return snapshot.frame;
}

bool States::is_due(int k) const {
    if (options_.save.empty()) return false;
    if (options_.save_every > 0) return k > 0 && k % options_.save_every == 0;
    return k == last_frame();
}

void States::save(int k) const {
    const auto name = numbered_name(options_.save);
    write_snapshot(name ? name->name(k) : fs::path(options_.save),
                   {.frame = k,
                    .time = k > 0 ? frame(k - 1).time : 0.0,
                    .renderer = gpu_,
                    .provenance = provenance_,
                    .passes = renderer_.state()});
}

}  // namespace glint
