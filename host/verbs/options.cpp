#include "verbs/options.h"

#include "base/diagnostic.h"
#include "base/words.h"

#include <algorithm>

namespace glint {

CLI::Validator one_of(std::vector<std::string> words) {
    const std::string all = fmt::format("{}", fmt::join(words, ", "));
    const auto check = [words = std::move(words), all](const std::string& text) {
        if (std::ranges::find(words, text) != words.end()) return std::string();
        return fmt::format("{} is none of {}{}", in_quotes(text), all, did_you_mean(text, words));
    };
    return {check, all, kMenu};
}

void add_off_switch(CLI::App& verb, const std::string& name, bool& value, const std::string& help) {
    verb.add_flag_callback(
        name, [&value] { value = false; }, help);
}

void add_examples(CLI::App& verb, std::initializer_list<std::string_view> lines) {
    std::string text = "Examples:";
    for (const std::string_view line : lines) text += fmt::format("\n  {}", line);
    verb.footer(std::move(text));
}

namespace {

void add_looks(CLI::App& verb, ViewOptions& view, const std::string& size) {
    verb.add_option("--size", view.size, size)->type_name("WxH");
    verb.add_option("--quality", view.quality, "values of tweaks that the preset has under a name")
        ->type_name("NAME");
    verb.add_option("--tweak", view.tweaks, "a value of the scene's, as often as needed")
        ->type_name(kTweak)
        ->allow_extra_args(false);
    verb.add_option("--device", view.device,
                    "which GPU: a number, a part of its name, or surfaceless")
        ->type_name("GPU");
}

}  // namespace

void add_view(CLI::App& verb, ViewOptions& view, bool takes_json) {
    verb.add_option("file", view.file, "a preset (.toml), a scene (.frag), or a Shadertoy (.json)")
        ->type_name(kFile)
        ->required();
    add_looks(verb, view, "pixels, such as 1280x720; the preset's otherwise");
    add_off_switch(verb, "--no-specialise", view.specialise,
                   "feed tweaks as uniforms instead of writing them in as constants");
    if (takes_json) verb.add_flag("--json", view.json, "one JSON object on stdout");
}

void add_views(CLI::App& verb, std::vector<std::filesystem::path>& files, ViewOptions& view,
               const std::string& size, const std::string& which) {
    verb.add_option("files", files, which)->type_name(kFile)->required();
    add_looks(verb, view, size);
}

namespace {

void take_quality(PictureOptions& picture, const std::string& word) {
    const auto number = parse_number(word);
    if (!number) {
        picture.view.quality = word;
        return;
    }
    if (*number < 1 || *number > 100 || *number != static_cast<int>(*number))
        throw CLI::ValidationError("--quality", "write a whole number from 1 to 100, or a name");
    picture.format.quality = static_cast<int>(*number);
}

}  // namespace

void add_picture(CLI::App& verb, PictureOptions& picture) {
    add_view(verb, picture.view);
    verb.add_option("--fps", picture.fps,
                    "Hz; frame k stands at k / fps, and simulations are played so")
        ->check(from(0.01, 1e5));
    verb.add_option("--samples", picture.samples, "sub-pixel positions averaged in linear light")
        ->check(from(1, 65536));
    verb.add_option("--shutter", picture.shutter,
                    "degrees of a frame, 360 all of it, over which --samples are spread in time")
        ->check(from(0.0, 360.0));
    verb.add_option("--format", picture.format.values, "of an .exr file: float, or half");
    verb.add_option("--compression", picture.format.compression,
                    "of an .exr file: zips, or none, rle, zip, piz, pxr24, b44, b44a, dwaa, dwab; "
                    "of a .tif file: zip, or none, lzw, packbits");
    verb.remove_option(verb.get_option("--quality"));
    verb.add_option_function<std::string>(
            "--quality", [&picture](const std::string& word) { take_quality(picture, word); },
            "a name: values of tweaks that the preset has under it; or from 1 to 100: of a .jpg "
            "file, 95 otherwise")
        ->type_name("NAME|N");
    verb.add_option("--from-state", picture.state.from,
                    "go on from this state of the simulation; with %06d: from the newest of use")
        ->type_name(kFile);
    verb.add_option("--save-state", picture.state.save,
                    "keep the state that the last frame is drawn from in this file")
        ->type_name(kFile);
}

}  // namespace glint
