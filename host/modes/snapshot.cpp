#include "modes/snapshot.h"

#include "image/temporary_file.h"
#include "modes/hash.h"
#include "modes/numbered_name.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A line that says what the file is, a line of JSON, the buffers' bytes, and a digest of all that.
constexpr std::string_view kFirstLine = "glint state 1\n";
constexpr std::size_t kDigestLength = 16;

constexpr std::array<std::pair<PixelFormat, std::string_view>, 3> kFormats = {
    {{PixelFormat::rgba8, "rgba8"},
     {PixelFormat::rgba16f, "rgba16f"},
     {PixelFormat::rgba32f, "rgba32f"}}};

std::string name_of(PixelFormat format) {
    return std::string(
        std::ranges::find(kFormats, format, &decltype(kFormats)::value_type::first)->second);
}

std::string content_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
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
                                  {"steps_done", pass.steps_done},
                                  {"bytes", pass.bytes.size()}});
    }
    return json;
}

// Throws Json::exception or std::out_of_range for what is not there or of another kind.
Snapshot from_json(const Json& json, std::string_view bytes) {
    Snapshot snapshot{.frame = json.at("frame"),
                      .time = json.at("time"),
                      .renderer = json.at("renderer"),
                      .provenance = json.at("provenance"),
                      .passes = {}};
    for (const Json& pass : json.at("passes")) {
        const auto format = std::ranges::find(kFormats, pass.at("format").get<std::string>(),
                                              &decltype(kFormats)::value_type::second);
        if (format == kFormats.end()) throw std::out_of_range("format");
        const std::size_t count = pass.at("bytes");
        if (count > bytes.size()) throw std::out_of_range("bytes");
        const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
        snapshot.passes.push_back({.pass = pass.at("name"),
                                   .shape = {.size = {pass.at("size").at(0), pass.at("size").at(1)},
                                             .format = format->first,
                                             .outputs = pass.at("outputs"),
                                             .cube = pass.at("cube"),
                                             .feedback = pass.at("feedback")},
                                   .steps_done = pass.at("steps_done"),
                                   .bytes = {first, first + count}});
        bytes.remove_prefix(count);
    }
    if (!bytes.empty() || snapshot.frame < 0) throw std::out_of_range("bytes");
    return snapshot;
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

std::string image_digest(const Preset& preset) {
    Hash hash;
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        for (const std::filesystem::path& file : sampler.files) hash.add(content_of(file));
    }
    return hash.text();
}

void require_same_provenance(const Provenance& saved, const Provenance& here) {
    for (const auto& [name, text] : here) {
        const auto found = std::ranges::find(saved, name, &Provenance::value_type::first);
        const std::string other = found == saved.end() ? "nothing" : found->second;
        if (other == text) continue;
        throw StateRefused(ExitCode::usage,
                           fmt::format("It was saved with {} {}, and this run has {}: give what it "
                                       "was saved with, or save it anew.",
                                       name, other, text));
    }
}

void tell(Severity severity, const fs::path& file, const std::string& text) {
    Diagnostic diagnostic;
    diagnostic.severity = severity;
    diagnostic.place.file = file.string();
    diagnostic.text = text;
    fmt::print(stderr, "{}\n", to_string(diagnostic));
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
            {"images", image_digest(preset)},
            {"date", fmt::format("{}-{}-{} {}", date.year, date.month, date.day, date.seconds)},
            {"specialisation", specialise ? "on" : "off"}};
}

void write_snapshot(const fs::path& file, const Snapshot& snapshot) {
    TemporaryFile out(file);
    Hash hash;
    const auto append = [&](std::string_view bytes) {
        hash.add(bytes);
        out.append(std::as_bytes(std::span(bytes)));
    };
    append(kFirstLine);
    append(to_json(snapshot).dump() + "\n");
    for (const PassState& pass : snapshot.passes) {
        append({reinterpret_cast<const char*>(pass.bytes.data()), pass.bytes.size()});
    }
    const std::string digest = hash.text();
    out.append(std::as_bytes(std::span(digest)));
    out.commit();
}

Snapshot read_snapshot(const fs::path& file) {
    std::error_code error;
    std::ifstream in(file, std::ios::binary);
    if (!in || fs::is_directory(file, error)) {
        const std::string cause = std::generic_category().message(error || in ? EISDIR : errno);
        throw StateRefused(ExitCode::missing_file, fmt::format("Cannot read it: {}.", cause));
    }
    std::string first_line(kFirstLine.size(), '\0');
    in.read(first_line.data(), static_cast<std::streamsize>(first_line.size()));
    if (first_line != kFirstLine) {
        throw StateRefused(ExitCode::missing_file, "It is not a state that --save-state wrote.");
    }
    std::string json;
    std::getline(in, json);
    std::string bytes;
    if (const auto here = in.tellg(); in) {
        bytes.resize(static_cast<std::size_t>(in.seekg(0, std::ios::end).tellg() - here));
        in.seekg(here).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    const std::string digest = bytes.substr(bytes.size() - std::min(bytes.size(), kDigestLength));
    bytes.resize(bytes.size() - digest.size());
    try {
        Snapshot snapshot = from_json(Json::parse(json), bytes);
        Hash hash;
        hash.add(kFirstLine);
        hash.add(json + "\n");
        for (const PassState& pass : snapshot.passes) {
            hash.add({reinterpret_cast<const char*>(pass.bytes.data()), pass.bytes.size()});
        }
        if (hash.text() == digest) return snapshot;
    } catch (const Json::exception&) {
    } catch (const std::out_of_range&) {
    }
    throw StateRefused(ExitCode::missing_file, "It is cut short or damaged; save it anew.");
}

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
      resume_(resume) {}

Frame States::frame(int k) const {
    const int extra = std::max(k - playback_.last_frame(), 0);
    return extra > 0 ? settled_frame(preset_, playback_, extra) : playback_.frame(preset_, k);
}

int States::start(int wanted) {
    if (!options_.from.empty()) {
        if (numbered_name(options_.from)) return start_from_newest(options_.from, wanted);
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
