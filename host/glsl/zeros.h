// Zeros for what a text reads before it has given it a value, as browsers have them.
//
// GLSL leaves such values undefined; golfed texts count on 0, and drivers give anything. So the
// zeros are written into the text: a local or global gets a first value, an `out` parameter one at
// the head of its function, and a function that ends without a `return` returns one. What certainly
// has a value before it is read stays as it is (glsl/first_use.h), and so does what no value can be
// written for: samplers, arrays of arrays, what stands within a macro that glsl/edits.h leaves
// alone. Long arrays, and those whose length only a compiler knows, get theirs part by part. A
// variable whose declaration in a `switch` is jumped over has none.
#pragma once

#include "glsl/edits.h"
#include "glsl/zero_value.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct Unset {
    std::string name;        // of the variable
    bool is_result = false;  // the name is that of a function which may end without a `return`
    std::size_t at = 0;      // byte of the text where the name is declared
    bool is_output = false;  // the colour that a pass or a main() writes, which the host sets to 0
    bool has_no_name = false;  // a parameter, whose name is ours
    // Why no value of ours is sure to be there.
    std::string_view why_not{};
};

// What is declared in these bytes begins with a value that shows in a picture.
struct Marked {
    Span bytes;
    FirstValue value = FirstValue::nan;
    bool outputs = false;  // they, or all else

    bool holds(const Unset& unset) const {
        return bytes.begin <= unset.at && unset.at < bytes.end && unset.is_output == outputs;
    }
};

// What a parameter without a name, the how many-th of its function, is called in a driver's text.
std::string unnamed_parameter(std::size_t index);

// What was unset, in the order of the text. Of the outputs of `entry` only marks are written.
std::vector<Unset> write_zeros(const Reading& reading, Edits& edits, std::string_view entry = {},
                               std::optional<Marked> marked = {});

}  // namespace glint
