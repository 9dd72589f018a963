// toml++ for those who read and save presets. Slow to compile: for no other file, and no header.
#pragma once

// Debian's shared toml++ throws; the header alone, told so, returns what is wrong. Version 3.3 also
// asserts (or, with NDEBUG, assumes) that a table's name begins with a letter before it checks that
// it does: "[#x]" would end the program. The checks behind its assertions are good ones.
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ASSERT(expression) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
