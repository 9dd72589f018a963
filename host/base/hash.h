// A short digest of texts: equal texts give equal digests, and others all but never do.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace glint {

// FNV-1a (Fowler, Noll and Vo 1991), 64 bits.
class Hash {
public:
    void add(std::string_view text) {
        add_part(text);
        value_ = (value_ ^ 0xffu) * 1099511628211u;  // "ab", "c" is not "a", "bc"
    }
    // The front of what the next add() ends.
    void add_part(std::string_view text) {
        for (const char c : text)
            value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211u;
    }
    std::string text() const { return fmt::format("{:016x}", value_); }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace glint
