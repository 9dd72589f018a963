// What to do about a driver's complaint, where it does not say so itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace glint {

// What is said where a driver tells of two types and of nothing else.
inline constexpr const char* kTypeForAnother = "a value of type {} cannot stand for one of type {}";
// What is said of a defined() without a name.
inline constexpr std::string_view kNoName = "'defined' takes one name: write defined(A)";
// What is written in place of a whole number follows.
inline constexpr std::string_view kNoChange = "; GLSL ES makes no int a float by itself: write ";

// A complaint of Mesa's, without advice that is none for GLSL ES.
std::string said_better(std::string complaint);

// A complaint that names the function that stands for `%` (glsl/remainder.h), as Mesa has it of the
// operator; nothing for one that only lists that function's types.
std::optional<std::string> said_of_remainder(std::string complaint);

// "; write 1.0 for 1", to be put behind a complaint of Mesa's about types, or "".
std::string advice_on_types(std::string_view complaint);

// "; GLSL's is mix" of a function that other languages have by this name, or "".
std::string advice_on_foreign_name(std::string_view name);

// "; GLSL's is vec3" of a type of other languages, or "".
std::string advice_on_foreign_type(std::string_view name);

}  // namespace glint
