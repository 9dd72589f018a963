// Arrays that are used as stacks: no place of one is read that was not written before.
//
// That is certain where the array and its counter are declared in one block, the counter as
// `int n = 0`; where all that stands of the array is `a[n]`, and the counter changes by `++n;` and
// `--n;` alone; where each `++n;` follows an `a[n] = …;` of its block, and each reading of `a[n]`
// follows a `--n;`. So all places below n are written at any time.
#pragma once

#include "glsl/reading.h"

#include <span>

namespace glint {

// `mentions`: the tokens where the array is named in its scope, but for its declaration, rising.
class Stack {
public:
    // All must outlive this.
    Stack(const Reading& reading, std::span<const std::uint32_t> mentions, TokenRange scope,
          std::uint32_t block)
        : reading_(reading), mentions_(mentions), scope_(scope), block_(block) {}

    bool is_certain();

private:
    enum class Change : std::uint8_t { none, up, down, unclear };

    bool find_counter();
    bool is_local_from_zero() const;
    bool is_harmless(std::uint32_t mention) const;
    std::uint32_t statement_of(std::uint32_t token) const;
    Change change_of(std::uint32_t statement) const;
    bool is_write(std::uint32_t statement) const;
    bool is_written_before(std::uint32_t up) const;
    bool is_taken_before(std::uint32_t mention) const;

    const Reading& reading_;
    std::span<const std::uint32_t> mentions_;
    TokenRange scope_;     // of the array
    std::uint32_t block_;  // the statement that holds both declarations
    std::string_view counter_;
    std::vector<std::uint32_t> changes_;  // statements that change the counter
};

}  // namespace glint
