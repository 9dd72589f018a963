// What toml++ must not be given. (From version 3.4 on it refuses this by itself.)
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace glint {

constexpr int kMostKeyParts = 16;  // those of a preset have two

// Where the first key of more parts begins, `a.b.c` or `[a.b.c]`, as an offset. Each part is a
// table in a table, and toml++ takes stack for each.
std::optional<std::size_t> find_deep_key(std::string_view toml);

}  // namespace glint
