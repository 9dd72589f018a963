// Changing a text by its tokens, and the way back from the changed text to the user's.
//
// A place is named by a token, whether it stands in the text itself or came from a macro. Where a
// change falls within a macro's expansion, the use is written out: the expansion takes its place,
// on as many lines. What cannot be touched is left as it is, and the call says false: a macro that
// is not known for certain, or whose words would be expanded once more.
#pragma once

#include "glsl/reading.h"

#include <string>
#include <vector>

namespace glint {

// The way back from a text that is made of pieces of another one, with words between them.
struct EditMap {
    struct Piece {
        std::size_t at = 0;    // in the new text
        std::size_t from = 0;  // in the old one
        bool is_own = false;   // not of the old text: all of it stands for the byte `from`
    };
    std::vector<Piece> pieces;  // in order; the first begins at 0. None: both texts are the same

    // The place of a byte in the old text.
    std::size_t origin(std::size_t at) const;
};

struct EditedText {
    std::string text;
    EditMap map;
};

class Edits {
public:
    // `reading` must outlive this.
    explicit Edits(const Reading& reading) : reading_(reading) {}

    // Of several at one place the first named stands first. Words have no line ends, which would
    // move all lines behind.
    bool before(std::uint32_t token, std::string words);
    bool after(std::uint32_t token, std::string words);
    // Line ends within what is replaced are kept.
    bool replace(TokenRange range, std::string words);
    // What comes of a macro's use stands in its place, with all that is changed within it.
    void write_out(const MacroUse& use);
    // Bytes of the text itself, whatever they hold.
    void replace_bytes(Span span, std::string words);

    // Whether these would say true: for those whose words need each other.
    bool takes_before(std::uint32_t token) const;
    bool takes_after(std::uint32_t token) const;
    bool takes_replacement(std::uint32_t token) const;

    // Whether words stand instead of any of these bytes.
    bool is_replaced(Span span) const;

    bool empty() const { return changes_.empty() && within_.empty(); }
    // Changes that overlap an earlier place are left out.
    EditedText apply() const;

private:
    struct Change {
        Span span;
        std::string words;
    };
    struct Within {  // a macro's expansion
        enum class Where : std::uint8_t { before, instead, after };
        std::uint32_t token = 0;
        Where where = Where::before;
        std::string words;
    };
    bool add_within(Within change);
    bool may_write_out(const MacroUse& use) const;
    std::string written_out(const MacroUse& use, const Within*& next, const Within* end) const;

    const Reading& reading_;
    std::vector<Change> changes_;
    std::vector<Within> within_;
};

}  // namespace glint
