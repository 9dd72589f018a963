// The text as the driver read it, taken apart: where a complaint stands, and what it means.
#pragma once

#include "base/diagnostic.h"
#include "glsl/preprocess.h"
#include "render/pass_text.h"
#include "render/syntax_error.h"
#include "scene/scene.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// Where a complaint stands in the text that the driver read.
struct Spot {
    std::size_t at = 0;  // of what a person wrote: where a macro is used, not where it is defined
    std::uint32_t use = kNone;  // the macro's use that the complaint is of
    std::size_t defined = 0;    // and the place in its definition
    std::size_t token = 0;      // of those that a compiler sees
};

// What a driver says of a place in its text.
struct Said {
    Severity severity = Severity::error;
    int line = 0, column = 0;  // in characters from 1
    bool is_expanded = false;  // it counts behind its preprocessor
    std::string words = {};
    std::optional<std::size_t> token = {};  // that it is about, where that is known instead
};

// The text as the driver read it, taken apart.
class ReadText {
public:
    ReadText(const Scene& scene, const PassText& pass)
        : scene_(scene), pass_(pass), read_(preprocess(pass.text, known_of_driver())) {
        find_lines();
    }

    Diagnostic complaint(Said said) const;
    // The same of what NVIDIA says of a line; nothing where a person has nothing to mend.
    std::optional<Said> from_nvidia(Said said) const;
    // A bracket that nobody closes, if there is one.
    std::optional<Diagnostic> open_bracket() const;
    // The use of a macro whose arguments go on to the text's end, if there is one.
    std::optional<Diagnostic> open_use() const;

    // Where a name stands first; the file alone where it does not.
    Place first(std::string_view name) const;

    // "; did you mean 'density'?" of a name that is not declared, or "". Nor are the `unknown`
    // ones.
    std::string help_with(const Said& said, std::string_view name, bool is_called,
                          const std::set<std::string, std::less<>>& unknown) const;
    // Which of the blocks outside of all others that is in; another for each function.
    std::ptrdiff_t block_of(const Said& said) const;

private:
    std::string help_with_size(const Spot& spot) const;
    std::optional<Diagnostic> mistyped_directive(const Spot& spot) const;
    std::optional<Diagnostic> mistyped_behind(std::size_t at) const;
    std::optional<Diagnostic> spaced_macro(const Spot& spot) const;
    Spot with_macro_of_operator(Spot spot) const;
    std::size_t named_on_line(std::size_t at, std::string_view words) const;
    std::size_t wrong_on_line(std::size_t at) const;
    bool compares_twice(const Spot& spot) const;
    std::string no_variable(const Spot& spot) const;
    Spot second_parameter(const Spot& spot, std::string_view name) const;
    std::string declared_before(std::string_view name, std::size_t at) const;
    std::string help_with_condition(std::string_view words) const;
    std::string help_at(std::string_view words, const Spot& spot) const;
    bool is_declared_below(std::string_view name) const;
    bool is_declared(std::string_view name, bool as_function) const;
    std::size_t token_of(const Said& said) const;
    std::string ended_before(std::string_view name, std::size_t at) const;
    std::string meant_by(std::string_view mistyped, std::size_t at, bool is_called,
                         const std::set<std::string, std::less<>>& unknown) const;
    void find_lines();
    std::size_t offset(int line, int column) const;
    Spot spot_of(std::size_t token) const;
    Spot spot_of(const Said& said) const;
    Spot expanded_spot(int line, int column) const;
    std::string beside_macro(std::size_t token) const;
    std::optional<Diagnostic> end_in_macro(std::size_t token) const;
    Place place_of(const SyntaxError& error) const;
    // Where a token stands: those of a macro where it is used.
    Span written(const Token& token) const {
        return token.use == kNone ? token.span() : read_.uses[token.use].span;
    }
    Place place(std::size_t at) const {
        const auto origin = pass_.origin(at);
        return origin ? scene_.place_at(*origin) : Place{scene_.files.front().string()};
    }

    const Scene& scene_;
    const PassText& pass_;
    Preprocessed read_;
    std::vector<std::size_t> line_begins_;           // by the line's number - 1
    std::vector<std::size_t> expanded_line_begins_;  // the same, as Mesa counts
};

}  // namespace glint
