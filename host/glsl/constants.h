// What constant expressions come to, as far as a few rules of arithmetic tell.
#pragma once

#include "glsl/reading.h"

#include <optional>
#include <string_view>
#include <unordered_map>

namespace glint {

class Constants {
public:
    // `known` are numbers of names that the text does not give itself. `reading` must outlive this.
    Constants(const Reading& reading, const std::unordered_map<std::string_view, double>& known);

    // In reals: 7 / 2 is 3.5. Of min() with one known argument that one, and of a ? b : c the
    // larger: what a loop may come to. Nothing where it is no constant, or hangs on more than is
    // looked at.
    std::optional<double> value(TokenRange range) const;

private:
    struct Cursor {
        std::uint32_t at, end;
        int depth;
    };
    std::optional<double> sum(Cursor& cursor) const;
    std::optional<double> product(Cursor& cursor) const;
    std::optional<double> factor(Cursor& cursor) const;
    std::optional<double> name(Cursor& cursor) const;
    std::optional<double> call(Cursor& cursor, std::string_view name) const;
    // Where this word stands first, not within brackets; the range's end for none.
    std::uint32_t find(std::string_view word, TokenRange range) const;
    std::optional<double> choice(TokenRange range, int depth) const;
    std::optional<double> whole(TokenRange range, int depth) const;

    const Reading& reading_;
    std::unordered_map<std::string_view, double> known_;
    std::unordered_map<std::string_view, TokenRange> written_;  // empty: several of that name
};

}  // namespace glint
