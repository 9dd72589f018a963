// What is said of keys, and which toml++ must not be given. (From version 3.4 on it refuses those
// by itself.)
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace glint {

constexpr int kMostKeyParts = 16;  // those of a preset have two

// Where the first key of more parts begins, `a.b.c` or `[a.b.c]`, as an offset. Each part is a
// table in a table, and toml++ takes stack for each.
std::optional<std::size_t> find_deep_key(std::string_view toml);

// What is said of a key that is none of these; "" of one that is.
std::string unknown_key(std::string_view key, std::span<const std::string> known);

// What toml++ complains of, and what to do; in its own words where none of ours fit.
std::string better_said(std::string_view complaint);

}  // namespace glint
