#include "measure/study/formats.h"

#include "offline/common.h"
#include "render/buffer.h"

#include <fmt/format.h>

namespace glint {
namespace {

constexpr std::string_view kFormatWord = ".format";

PixelFormat parse(const std::string& name, const std::string& word) {
    const auto format = parse_pixel_format(word);
    if (format) return *format;
    const std::string expected = expected_pixel_format(word);
    throw UsageError(fmt::format("{}: '{}' is no format; write {}{}", name, word, expected,
                                 expected.ends_with('?') ? "" : "."));
}

std::size_t pass_of(const Scene& scene, const std::string& name) {
    const std::size_t dot = name.find('.');
    if (name.substr(dot) != kFormatWord) {
        throw UsageError(
            fmt::format("--vary {}: of a buffer its format can be varied, as in "
                        "{}.format=rgba32f,rgba16f.",
                        name, name.substr(0, dot)));
    }
    const std::size_t pass = find_pass(scene, name.substr(0, dot));
    if (pass == kImagePass)
        throw UsageError(fmt::format("--vary {}: the picture is no buffer; name one.", name));
    return pass;
}

// Of all that the pass fills, without mipmaps and what is kept of the frame before.
std::string room_text(const Pass& pass, glm::ivec2 picture, PixelFormat format) {
    BufferShape shape = shape_of(pass, picture, false);
    shape.format = format;
    return fmt::format("{} {:.1f} KiB", name_of(format),
                       static_cast<double>(byte_count(shape)) / 1024.0);
}

}  // namespace

bool names_a_format(const std::string& name) {
    return name.find('.') != std::string::npos;
}

Knob format_knob(const Preset& preset, const std::vector<bool>& drawn, const FormatsAsked& asked) {
    const std::size_t index = pass_of(preset.scene, asked.name);
    const Pass& pass = preset.scene.passes[index];
    if (!drawn[index])
        throw UsageError(fmt::format("--vary {}: nothing reads this buffer.", asked.name));
    const auto value = [&](PixelFormat format) {
        KnobValue result{.text = std::string(name_of(format)),
                         .setting = {.values = preset.values, .settle = preset.settle}};
        result.setting.format = {index, format};
        return result;
    };
    std::vector<PixelFormat> formats;
    for (const std::string& word : asked.formats) formats.push_back(parse(asked.name, word));
    if (formats.empty()) {
        for (const int bytes : {4, 2, 1}) formats.push_back(with_channel_bytes(pass.format, bytes));
    }
    Knob knob{.name = asked.name};
    std::string rooms;
    for (const PixelFormat format : formats) {
        knob.values.push_back(value(format));
        rooms += (rooms.empty() ? "" : ", ") + room_text(pass, preset.size, format);
    }
    knob.reference =
        value(asked.reference ? parse(asked.name, *asked.reference) : PixelFormat::rgba32f);
    if (asked.second) knob.second = value(parse(asked.name, *asked.second));
    if (knob.second && knob.second->setting == knob.reference.setting)
        throw UsageError(
            fmt::format("--second {}={}: that is the reference itself, which tells nothing of its "
                        "own error; name another format.",
                        asked.name, *asked.second));
    knob.notes.push_back(fmt::format("{} takes: {}", pass.name, rooms));
    return knob;
}

}  // namespace glint
