#include "scene/toml_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {

std::optional<double> any_number(const toml::node& node) {
    if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
    if (const auto* real = node.as_floating_point()) return real->get();
    return std::nullopt;
}

std::optional<double> finite_number(const toml::node& node) {
    const auto value = any_number(node);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<TweakValue> tweak_value(const Tweak& tweak, const toml::node& node) {
    if (const auto* text = node.as_string()) return parse_value(tweak, text->get());
    const auto components = static_cast<std::size_t>(component_count(tweak.type));
    TweakValue value{};
    if (const toml::array* array = node.as_array()) {
        if (components == 1 || array->size() != components) return std::nullopt;
        for (std::size_t i = 0; i < components; ++i) {
            const auto component = any_number((*array)[i]);
            if (!component || std::isnan(*component)) return std::nullopt;
            value[i] = *component;
        }
        return value;
    }
    if (components != 1) return std::nullopt;
    if (tweak.type == TweakType::bool1) {
        const auto* on = node.as_boolean();
        return on ? std::optional(TweakValue{on->get() ? 1.0 : 0.0}) : std::nullopt;
    }
    const auto one = any_number(node);
    if (!one || std::isnan(*one)) return std::nullopt;
    // A menu of numbers means its names, as everywhere.
    const std::string name = fmt::format("{}", *one);
    if (std::ranges::find(tweak.names, name) != tweak.names.end()) return parse_value(tweak, name);
    if (tweak.type == TweakType::int1 && std::isfinite(*one) && *one != std::floor(*one))
        return std::nullopt;
    return TweakValue{*one};
}

}  // namespace glint
