#include "render/pass_zeros.h"

#include "glsl/zeros.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace glint {
namespace {

// Lines and columns of a text, for places that are asked for in rising order.
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}

    struct Place {
        int line = 1, column = 1;  // in characters
    };
    Place place(std::size_t offset) {
        for (; at_ < offset; ++at_) {
            const char c = text_[at_];
            if (c == '\n') place_ = {place_.line + 1, 0};
            place_.column += (c & 0xC0) != 0x80;
        }
        return place_;
    }

private:
    std::string_view text_;
    std::size_t at_ = 0;
    Place place_;
};

// How many characters the place was moved within its line by what is noted already.
int moved(const std::vector<PassText::Widened>& list, Lines::Place place) {
    int by = 0;
    for (const PassText::Widened& widened : list)
        if (widened.line == place.line && widened.column < place.column) by += widened.by;
    return by;
}

// Where lines have become wider, beside where they were so before.
std::vector<PassText::Widened> widened_by(const EditedText& edited, const PassText& before) {
    Lines olds(before.text), news(edited.text);
    std::vector<PassText::Widened> list;
    auto earlier = before.widened.begin();
    int line = 0, by = 0;
    const auto keep_earlier = [&](Lines::Place until) {
        for (; earlier != before.widened.end() &&
               std::pair(earlier->line, earlier->column) < std::pair(until.line, until.column);
             ++earlier) {
            list.push_back(*earlier);
            if (earlier->line == line) list.back().column += by;
        }
    };
    for (const EditedText::Piece& piece : edited.pieces) {
        if (piece.is_own) continue;
        const Lines::Place old = olds.place(piece.from), now = news.place(piece.at);
        keep_earlier(old);
        if (std::exchange(line, old.line) != old.line) by = 0;
        const int wider = now.column - old.column - std::exchange(by, now.column - old.column);
        if (wider != 0) list.push_back({now.line, now.column - std::max(wider, 1), wider});
    }
    keep_earlier({.line = std::numeric_limits<int>::max()});
    return list;
}

}  // namespace

void write_zeros(PassText& pass, const std::optional<UnsetRange>& marked) {
    const Reading reading = read_glsl(pass.text, known_of_driver());
    Lines lines(pass.text);
    UnsetPlace place;
    const auto number = [&](const Unset& unset) {
        const Lines::Place at = lines.place(unset.at);
        const int line = at.line - pass.prologue_lines;
        place = {line, line == place.line ? place.number + 1 : 0};
        pass.unset.push_back(
            {place, at.column - moved(pass.widened, at), unset.name, unset.is_result});
        return marked && marked->begin <= place && place < marked->end;
    };
    Zeroed zeroed = write_zeros(reading, number);
    if (zeroed.unset.empty()) return;
    pass.widened = widened_by(zeroed.edited, pass);
    pass.text = std::move(zeroed.edited.text);
}

}  // namespace glint
