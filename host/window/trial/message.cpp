#include "window/trial/message.h"

#include <nlohmann/json.hpp>

#include <concepts>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace glint {

// The members of what is not plain bytes, for both directions. A binding names all of them, so that
// a new one is not forgotten here.
template <class T, class Wanted>
concept Is = std::same_as<std::remove_const_t<T>, Wanted>;

void members(const auto& all, Is<Place> auto& value) {
    auto& [file, line, column] = value;
    all(file, line, column);
}
void members(const auto& all, Is<Diagnostic> auto& value) {
    auto& [severity, place, text, missing_file] = value;
    all(severity, place, text, missing_file);
}
void members(const auto& all, Is<Tweak> auto& value) {
    auto& [name, type, initial, min, max, safe, names, is_colour, log, step, quality, no_random,
           reference, second, unit, group, description, place, declarations] = value;
    all(name, type, initial, min, max, safe, names, is_colour, log, step, quality, no_random,
        reference, second, unit, group, description, place, declarations);
}
void members(const auto& all, Is<Sampler> auto& value) {
    auto& [name, tab, type, source, filter, wrap, vflip, pass, output, files, noise_channels,
           noise_size, plays, conserves, bounded, place] = value;
    all(name, tab, type, source, filter, wrap, vflip, pass, output, files, noise_channels,
        noise_size, plays, conserves, bounded, place);
}
void members(const auto& all, Is<Pass> auto& value) {
    auto& [name, entry, outputs, size, scale, format, cube, step, place] = value;
    all(name, entry, outputs, size, scale, format, cube, step, place);
}
void members(const auto& all, Is<Scene> auto& value) {
    auto& [files, text, origins, tweaks, samplers, passes, channel_types, image_entry, has_sound] =
        value;
    all(files, text, origins, tweaks, samplers, passes, channel_types, image_entry, has_sound);
}
void members(const auto& all, Is<QualitySet> auto& value) {
    auto& [name, values] = value;
    all(name, values);
}
void members(const auto& all, Is<Expect> auto& value) {
    auto& [picture, rmse, flip, ms_ratio, ms_of] = value;
    all(picture, rmse, flip, ms_ratio, ms_of);
}
void members(const auto& all, Is<Preset> auto& value) {
    auto& [file, scene, title, time, size, has_size, settle, date, values, locked, qualities, watch,
           channels, events, expect] = value;
    all(file, scene, title, time, size, has_size, settle, date, values, locked, qualities, watch,
        channels, events, expect);
}
void members(const auto& all, Is<PassTrial> auto& value) {
    auto& [name, compile_ms, first_ms, second_ms, expected_ms] = value;
    all(name, compile_ms, first_ms, second_ms, expected_ms);
}
void members(const auto& all, Is<Verdict> auto& value) {
    auto& [state, passes, expected_ms, total_ms, diagnostics] = value;
    all(state, passes, expected_ms, total_ms, diagnostics);
}
void members(const auto& all, Is<ProgramOptions> auto& value) {
    auto& [specialise, constants, named, average, tiles, clamp_to_bytes, lean, feed, marked] =
        value;
    all(specialise, constants, named, average, tiles, clamp_to_bytes, lean, feed, marked);
}
void members(const auto& all, Is<CompileOptions> auto& value) {
    auto& [root, program, side_by_side, as_written] = value;
    all(root, program, side_by_side, as_written);
}
void members(const auto& all, Is<TrialOrder> auto& value) {
    auto& [number, preset, compile, size, picture_format, time, slow_ms, images, is_text] = value;
    all(number, preset, compile, size, picture_format, time, slow_ms, images, is_text);
}
void members(const auto& all, Is<TrialAnswer> auto& value) {
    auto& [number, stage, text, size, verdict] = value;
    all(number, stage, text, size, verdict);
}

void members(const auto& all, Is<PassState> auto& value) {
    auto& [pass, shape, steps_done, bytes] = value;
    all(pass, shape, steps_done, bytes);
}
void members(const auto& all, Is<GivenBuffer> auto& value) {
    auto& [pass, feeds_state, text_hash, reads, size, outputs, begin, is_known] = value;
    all(pass, feeds_state, text_hash, reads, size, outputs, begin, is_known);
}
void members(const auto& all, Is<RefineOrder> auto& value) {
    auto& [preset, specialise, samples, time, time_delta, frame_rate, frame, date, input,
           mouse_size, state, given] = value;
    all(preset, specialise, samples, time, time_delta, frame_rate, frame, date, input, mouse_size,
        state, given);
}
void members(const auto& all, Is<ProbeOrder> auto& value) {
    auto& [number, subject, instant, scene, pass, pixel, colour, lines, map, line, column, file,
           name, kind] = value;
    all(number, subject, instant, scene, pass, pixel, colour, lines, map, line, column, file, name,
        kind);
}
void members(const auto& all, Is<ProbeAnswer> auto& value) {
    auto& [number, found, watched, is_whole, ran, problem, compile_ms, map, size, components,
           values, reached] = value;
    all(number, found, watched, is_whole, ran, problem, compile_ms, map, size, components, values,
        reached);
}

void members(const auto& all, Is<SoundOrder> auto& value) {
    auto& [scene, state] = value;
    all(scene, state);
}

// What has no members to name goes as its bytes: both ends are copies of one program.
template <class T>
concept Plain = std::is_class_v<T> && std::is_trivially_copyable_v<T>;

template <class T>
concept HasMembers = requires(void (&visit)(...), T& value) {
    members(visit, value);
};

}  // namespace glint

namespace nlohmann {

template <glint::HasMembers T>
struct adl_serializer<T> {
    static void to_json(json& list, const T& value) {
        list = json::array();
        const auto put = [&](const auto&... member) { (list.push_back(member), ...); };
        members(put, value);
    }
    static void from_json(const json& list, T& value) {
        std::size_t index = 0;
        const auto get = [&](auto&... member) { (list.at(index++).get_to(member), ...); };
        members(get, value);
    }
};

template <glint::Plain T>
struct adl_serializer<T> {
    static void to_json(json& bytes, const T& value) {
        std::vector<std::uint8_t> copy(sizeof value);
        std::memcpy(copy.data(), &value, sizeof value);
        bytes = json::binary(std::move(copy));
    }
    static void from_json(const json& bytes, T& value) {
        const auto& binary = bytes.get_binary();
        if (binary.size() != sizeof value) throw std::runtime_error("A message is broken.");
        std::memcpy(&value, binary.data(), sizeof value);
    }
};

template <>
struct adl_serializer<std::vector<std::byte>> {
    static void to_json(json& bytes, const std::vector<std::byte>& value) {
        const auto* first = reinterpret_cast<const std::uint8_t*>(value.data());
        bytes = json::binary({first, first + value.size()});
    }
    static void from_json(const json& bytes, std::vector<std::byte>& value) {
        const auto copied = std::as_bytes(std::span(bytes.get_binary()));
        value.assign(copied.begin(), copied.end());
    }
};

}  // namespace nlohmann

namespace glint {
namespace {

// The length in front tells where the message ends.
std::string packed(const nlohmann::json& content) {
    std::string message(sizeof(std::uint64_t), '\0');
    nlohmann::json::to_cbor(content, nlohmann::detail::output_adapter<char>(message));
    const std::uint64_t length = message.size() - sizeof length;
    std::memcpy(message.data(), &length, sizeof length);
    return message;
}

template <class Message>
Message unpacked(std::string_view bytes) {
    return nlohmann::json::from_cbor(bytes).get<Message>();
}

}  // namespace

std::string pack(std::uint64_t number, const Candidate& candidate, double slow_ms) {
    // As the members of TrialOrder, but without a copy of the preset.
    return packed({number, candidate.preset, candidate.compile, candidate.size,
                   candidate.picture_format, candidate.time, slow_ms, candidate.images,
                   candidate.is_text});
}

std::string pack(const TrialAnswer& answer) {
    return packed(answer);
}

std::string pack(const SoundOrder& order) {
    return packed(order);
}

std::string pack(const RefineOrder& order) {
    return packed(order);
}

std::string pack(const ProbeOrder& order) {
    return packed(order);
}

std::string pack(const ProbeAnswer& answer) {
    return packed(answer);
}

std::optional<std::string> take_message(std::string& arrived) {
    std::uint64_t length = 0;
    if (arrived.size() < sizeof length) return std::nullopt;
    std::memcpy(&length, arrived.data(), sizeof length);
    if (arrived.size() - sizeof length < length) return std::nullopt;
    std::string message = arrived.substr(sizeof length, length);
    arrived.erase(0, sizeof length + length);
    return message;
}

TrialOrder unpack_order(std::string_view message) {
    return unpacked<TrialOrder>(message);
}

SoundOrder unpack_sound_order(std::string_view message) {
    return unpacked<SoundOrder>(message);
}

RefineOrder unpack_refine_order(std::string_view message) {
    return unpacked<RefineOrder>(message);
}

ProbeOrder unpack_probe_order(std::string_view message) {
    return unpacked<ProbeOrder>(message);
}

ProbeAnswer unpack_probe_answer(std::string_view message) {
    return unpacked<ProbeAnswer>(message);
}

TrialAnswer unpack_answer(std::string_view message) {
    return unpacked<TrialAnswer>(message);
}

}  // namespace glint
