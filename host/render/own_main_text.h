// What stands around a text with a main() of its own (scene/own_main.h).
#pragma once

#include "glsl/edits.h"
#include "glsl/zeros.h"

#include <optional>
#include <string>
#include <string_view>

namespace glint {

// gl_FragData[0] is gl_FragColor by another name.
void put_in_place_of_data(const Reading& reading, Edits& edits);

// A pass has outputs of its own, and no inputs: outputs of the text become plain variables, of
// their precision; inputs that are fed stand in before_plain_main().
void make_ends_variables(const Reading& reading, Edits& edits);

// First values of globals that are no constants are set before main() (behind_plain_main()).
void put_off_values(const Reading& reading, Edits& edits);

// What such a text may count on, as GLSL ES 1.00 of the web may. `plain_main`: main() draws the
// picture.
std::string before_own_main(const Reading& reading, bool plain_main);

// `#define texture2DLod textureLod`: what a text calls by names of older GLSL, some of which
// drivers know and browsers do not.
std::string older_names(const Reading& reading);

// Where nothing else draws the picture, main() is called from the site's mainImage.
std::string before_plain_main(const Reading& reading);
// `output`: what it writes, null for gl_FragColor. That begins as 0, or as the mark.
std::string behind_plain_main(const Reading& reading, const Declaration* output,
                              std::optional<FirstValue> mark);

// The output, where main() may end without having set all of it.
std::optional<Unset> unset_colour(const Reading& reading, const Declaration* output);

}  // namespace glint
