#include "offline/page_controls.h"

#include "base/markup.h"

#include <fmt/format.h>

#include <cmath>

namespace glint {
namespace {

// "waterTint": "water tint".
std::string in_words(std::string_view name) {
    std::string words;
    bool was_small = false;
    for (const char c : name) {
        const bool is_large = c >= 'A' && c <= 'Z';
        if (is_large && was_small) words += ' ';
        words += is_large ? static_cast<char>(c - 'A' + 'a') : c;
        was_small = !is_large && c != '_';
    }
    return words;
}

std::string menu(const Tweak& tweak) {
    std::string options;
    for (const std::string& name : tweak.names)
        options += fmt::format("<option>{}", markup_escaped(name));
    return fmt::format("<select aria-label=\"{}\">{}</select>", tweak.name, options);
}

std::string input(const Tweak& tweak, std::string_view what) {
    return fmt::format("<input aria-label=\"{}\" {}>", tweak.name, what);
}

// Its ends are those of the tweak, or their logarithms.
std::string slider(const Tweak& tweak) {
    const auto place = [&](double value) { return tweak.log ? std::log(value) : value; };
    const std::string step =
        tweak.step > 0.0 && !tweak.log ? fmt::format("{}", tweak.step) : std::string("any");
    return input(tweak, fmt::format("type=range min={} max={} step={}", place(*tweak.min),
                                    place(*tweak.max), step));
}

std::string controls_of(const Tweak& tweak) {
    if (tweak.type == TweakType::bool1) return input(tweak, "type=checkbox");
    if (!tweak.names.empty()) return menu(tweak);
    const std::string field = input(tweak, "class=field spellcheck=false");
    if (tweak.is_colour) return input(tweak, "type=color") + field;
    if (component_count(tweak.type) > 1 || !tweak.min) return field;
    return slider(tweak) + field;
}

std::string row(const Tweak& tweak) {
    return fmt::format(
        "<div class=row><span title=\"{}: {}\">{}<i>{}</i></span>"
        "<button class=reset title=\"as in the preset\">\u21ba</button>{}</div>\n",
        tweak.name, markup_escaped(tweak.description), in_words(tweak.name),
        markup_escaped(tweak.unit), controls_of(tweak));
}

}  // namespace

std::string page_controls(const Preset& preset) {
    std::string html, group;
    bool is_open = false;
    for (const Tweak& tweak : preset.scene.tweaks) {
        if (!is_open || tweak.group != group) {
            if (is_open) html += "</details>";
            html += fmt::format("<details open><summary>{}</summary>\n",
                                tweak.group.empty() ? "tweaks" : markup_escaped(tweak.group));
            is_open = true;
        }
        group = tweak.group;
        html += row(tweak);
    }
    return is_open ? html + "</details>" : html;
}

}  // namespace glint
