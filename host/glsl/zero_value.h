// Constructors of values: 0 of any type, or a mark that shows in a picture.
#pragma once

#include "glsl/reading.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace glint {

// A type with its lengths, as it is spelled for one name.
struct SpelledType {
    std::uint32_t type = kNone;       // token; kNone of a struct without a name
    std::uint32_t structure = kNone;  // that is defined there
    TokenRange array, type_array;
};

// What a variable begins with: NaN, in integers 0x7FC0DEAD; max() and min() may leave a NaN out,
// and then 1e9 shows, or -1e9. Bools are true where it is not zero.
enum class FirstValue { zero, nan, large, negative };

// Of a number, a vector or a matrix; empty for other types.
std::string basic_value(std::string_view type, FirstValue first);

class ZeroValues {
public:
    // `reading` must outlive this.
    explicit ZeroValues(const Reading& reading);

    // `vec3(0)`, `Hit(0.,vec3(0))`, `float[2](0.,0.)`; nothing where there is no such constructor,
    // or it would have more than a thousand numbers.
    std::optional<std::string> value(const SpelledType& type, FirstValue first) const;
    // Whether that is better given part by part, where it can be.
    bool is_long(const SpelledType& type) const;

    // Statements that give it this value part by part, `for (…) w[i] = 0.;`, whatever its lengths
    // are; nothing where there are none. `what` is how it is called there.
    std::optional<std::string> statements(const std::string& what, const SpelledType& type,
                                          FirstValue first) const;

    // What a struct without a name is called in these constructors.
    static std::string made_name(std::uint32_t structure);

private:
    // `room`: how many numbers may still be written.
    std::optional<std::string> element(const SpelledType& type, FirstValue first, int& room) const;
    std::optional<std::string> whole(const SpelledType& type, FirstValue first, int& room) const;
    std::optional<std::string> of_struct(std::uint32_t structure, FirstValue first,
                                         int& room) const;
    bool set_parts(std::string& words, const std::string& what, const SpelledType& type,
                   FirstValue first, int depth) const;
    std::uint32_t struct_of(const SpelledType& type) const;
    std::uint32_t find_struct(std::string_view name, std::uint32_t from) const;
    std::uint32_t brace_round(std::uint32_t token) const;
    std::optional<std::int64_t> length(TokenRange array) const;
    std::optional<std::int64_t> constant(std::string_view name, int depth) const;
    bool may_be_written(std::string_view word) const;
    static SpelledType type_of(const Declaration& member, const Declarator& declarator);

    struct Constant {
        TokenRange value;
        bool is_only = true;  // of that name
    };
    const Reading& reading_;
    std::unordered_map<std::string_view, int> struct_names_;  // how many have it
    std::unordered_map<std::string_view, Constant> constants_;
    std::unordered_map<std::string_view, bool> taken_;  // names of macros and variables
};

}  // namespace glint
