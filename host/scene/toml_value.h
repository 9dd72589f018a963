// Numbers and tweak values as TOML writes them.
#pragma once

#include "scene/scene.h"
#include "scene/toml.h"

#include <optional>

namespace glint {

// A number, whole or not. toml++ itself gives no double for a whole number beyond 2^53.
std::optional<double> any_number(const toml::node& node);
std::optional<double> finite_number(const toml::node& node);

// Nothing when it is not of the tweak's type; it may lie beyond the range.
std::optional<TweakValue> tweak_value(const Tweak& tweak, const toml::node& node);

}  // namespace glint
