#include "window/trial/message.h"

#include <array>
#include <concepts>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace glint {
namespace {

// The members of what is not plain bytes, for both directions. A binding names all of them, so that
// a new one is not forgotten here.
template <class T, class Wanted>
concept Is = std::same_as<std::remove_const_t<T>, Wanted>;

void members(auto& bytes, Is<Place> auto& value) {
    auto& [file, line, column] = value;
    bytes(file, line, column);
}
void members(auto& bytes, Is<Diagnostic> auto& value) {
    auto& [severity, place, text, missing_file] = value;
    bytes(severity, place, text, missing_file);
}
void members(auto& bytes, Is<Tweak> auto& value) {
    auto& [name, type, initial, min, max, names, is_colour, log, step, quality, reference, unit,
           group, description, place, begin, end] = value;
    bytes(name, type, initial, min, max, names, is_colour, log, step, quality, reference, unit,
          group, description, place, begin, end);
}
void members(auto& bytes, Is<Sampler> auto& value) {
    auto& [name, tab, type, source, filter, wrap, vflip, pass, output, files, noise_channels,
           noise_size, place] = value;
    bytes(name, tab, type, source, filter, wrap, vflip, pass, output, files, noise_channels,
          noise_size, place);
}
void members(auto& bytes, Is<Pass> auto& value) {
    auto& [name, entry, outputs, size, scale, format, cube, step, place] = value;
    bytes(name, entry, outputs, size, scale, format, cube, step, place);
}
void members(auto& bytes, Is<Scene> auto& value) {
    auto& [files, text, origins, tweaks, samplers, passes, channel_types, image_entry, has_sound] =
        value;
    bytes(files, text, origins, tweaks, samplers, passes, channel_types, image_entry, has_sound);
}
void members(auto& bytes, Is<Preset> auto& value) {
    auto& [file, scene, title, time, size, has_size, settle, date, values, channels, events] =
        value;
    bytes(file, scene, title, time, size, has_size, settle, date, values, channels, events);
}
void members(auto& bytes, Is<PassTrial> auto& value) {
    auto& [name, compile_ms, first_ms, second_ms, expected_ms] = value;
    bytes(name, compile_ms, first_ms, second_ms, expected_ms);
}
void members(auto& bytes, Is<Verdict> auto& value) {
    auto& [state, passes, expected_ms, total_ms, diagnostics] = value;
    bytes(state, passes, expected_ms, total_ms, diagnostics);
}
void members(auto& bytes, Is<TrialOrder> auto& value) {
    auto& [number, preset, compile, size, picture_format, time, slow_ms, images] = value;
    bytes(number, preset, compile, size, picture_format, time, slow_ms, images);
}
void members(auto& bytes, Is<TrialAnswer> auto& value) {
    auto& [number, stage, text, size, verdict] = value;
    bytes(number, stage, text, size, verdict);
}

void members(auto& bytes, Is<SoundOrder> auto& value) {
    auto& [scene, state] = value;
    bytes(scene, state);
}

template <class T>
concept Plain = std::is_trivially_copyable_v<T>;

class Packer {
public:
    void operator()(const auto&... values) { (put(values), ...); }

    // The length in front tells where the message ends.
    std::string message() && {
        const std::uint64_t length = bytes_.size() - sizeof(std::uint64_t);
        std::memcpy(bytes_.data(), &length, sizeof length);
        return std::move(bytes_);
    }

private:
    void put_bytes(const void* data, std::size_t size) {
        bytes_.append(static_cast<const char*>(data), size);
    }
    void put(const Plain auto& value) { put_bytes(&value, sizeof value); }
    void put(const std::string& value) {
        put(value.size());
        put_bytes(value.data(), value.size());
    }
    void put(const std::filesystem::path& value) { put(value.native()); }
    template <class T>
    void put(const std::vector<T>& list) {
        put(list.size());
        if constexpr (Plain<T>)
            put_bytes(list.data(), list.size() * sizeof(T));
        else
            for (const T& value : list) put(value);
    }
    void put(const std::array<Sampler, 4>& list) {
        for (const Sampler& value : list) put(value);
    }
    template <class T>
    requires requires(Packer& bytes, const T& value) { members(bytes, value); }
    void put(const T& value) { members(*this, value); }

    std::string bytes_ = std::string(sizeof(std::uint64_t), '\0');
};

class Unpacker {
public:
    explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

    void operator()(auto&... values) { (get(values), ...); }

private:
    std::string_view take(std::size_t size) {
        if (size > bytes_.size()) throw std::runtime_error("A message to a trial is cut short.");
        const std::string_view taken = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return taken;
    }
    std::size_t get_count() {
        std::size_t count = 0;
        get(count);
        if (count > bytes_.size()) throw std::runtime_error("A message to a trial is broken.");
        return count;
    }
    void get(Plain auto& value) { std::memcpy(&value, take(sizeof value).data(), sizeof value); }
    void get(std::string& value) { value = take(get_count()); }
    void get(std::filesystem::path& value) { value = take(get_count()); }
    template <class T>
    void get(std::vector<T>& list) {
        list.resize(get_count());
        for (T& value : list) get(value);
    }
    void get(std::array<Sampler, 4>& list) {
        for (Sampler& value : list) get(value);
    }
    template <class T>
    requires requires(Unpacker& bytes, T& value) { members(bytes, value); }
    void get(T& value) { members(*this, value); }

    std::string_view bytes_;
};

template <class Message>
Message unpacked(std::string_view bytes) {
    Unpacker unpack(bytes);
    Message message;
    unpack(message);
    return message;
}

}  // namespace

std::string pack(std::uint64_t number, const Candidate& candidate, double slow_ms) {
    // As the members of TrialOrder, but without a copy of the preset.
    Packer bytes;
    bytes(number, candidate.preset, candidate.compile, candidate.size, candidate.picture_format,
          candidate.time, slow_ms, candidate.images);
    return std::move(bytes).message();
}

std::string pack(const TrialAnswer& answer) {
    Packer bytes;
    bytes(answer);
    return std::move(bytes).message();
}

std::string pack(const SoundOrder& order) {
    Packer bytes;
    bytes(order);
    return std::move(bytes).message();
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

TrialAnswer unpack_answer(std::string_view message) {
    return unpacked<TrialAnswer>(message);
}

}  // namespace glint
