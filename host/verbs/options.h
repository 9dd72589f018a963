// Options that several verbs take, each described in this one place.
#pragma once

#include "offline/options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace glint {

// What an option takes. CLI::Range lets not-a-number pass, and writes its bounds with six zeros.
template <class Number>
CLI::Validator from(Number least, Number most) {
    const std::string bounds = fmt::format("from {} to {}", least, most);
    const auto check = [least, most, bounds](const std::string& text) {
        Number value{};
        const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        const char* kind = std::is_integral_v<Number> ? "whole number" : "number";
        return fits ? std::string() : fmt::format("'{}' is not a {} {}", text, kind, bounds);
    };
    return {check, bounds};
}

// What an option or argument names, as --help shows it behind the option. Completion offers what
// there is of it; the endings of files are those that the help text names.
inline constexpr const char* kFile = "FILE";
inline constexpr const char* kFolder = "FOLDER";
inline constexpr const char* kTweak = "NAME=VALUE";
inline constexpr const char* kVaried = "NAME=VALUES";
inline constexpr const char* kPass = "PASS";
inline constexpr const char* kMenu = "menu";  // not shown: the name of what one_of() makes

// One of a few words.
CLI::Validator one_of(std::vector<std::string> words);

// A switch that turns off what is on: `--no-NAME`.
void add_off_switch(CLI::App& verb, const std::string& name, bool& value, const std::string& help);

// Command lines that stand below a verb's --help. Each is one that works in the repository's
// folder.
void add_examples(CLI::App& verb, std::initializer_list<std::string_view> lines);

// What is opened, and how: the file, --size, --tweak, --device, --no-specialise and, unless the
// verb has no such result, --json.
void add_view(CLI::App& verb, ViewOptions& view, bool takes_json = true);

// Several files instead of one, `size` as the text of --size says it and `which` as that of the
// files; --tweak and --device.
void add_views(CLI::App& verb, std::vector<std::filesystem::path>& files, ViewOptions& view,
               const std::string& size,
               const std::string& which = "presets (.toml), scenes (.frag), or Shadertoys (.json)");

// add_view, how light is gathered over a frame, how a file keeps it, and from which state it goes
// on.
void add_picture(CLI::App& verb, PictureOptions& picture);

}  // namespace glint
