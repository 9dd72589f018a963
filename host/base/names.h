// The words of an enumeration: written and read back by one table.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace glint {

// One row a value, each value and each word once.
template <class Value, std::size_t kCount>
struct Names {
    struct Row {
        Value value;
        const char* name;
    };
    Row rows[kCount];

    // "" for a value without a row.
    constexpr const char* of(Value value) const {
        for (const Row& row : rows)
            if (row.value == value) return row.name;
        return "";
    }
    constexpr std::optional<Value> find(std::string_view name) const {
        for (const Row& row : rows)
            if (row.name == name) return row.value;
        return std::nullopt;
    }
};

}  // namespace glint
