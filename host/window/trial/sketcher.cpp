#include "window/trial/sketcher.h"

#include <algorithm>
#include <functional>

namespace glint {

std::size_t sketch_hash(const std::string& pass_text) {
    return std::hash<std::string>()(pass_text);
}

std::size_t filling_hash(const Preset& drawn, std::size_t pass, const std::string* constants) {
    return sketch_hash(constants ? *constants : pass_text(drawn, pass, kSketched).text);
}

// In drawing order, in which what a map reads comes before it.
void note_known(std::vector<GivenBuffer>& later, const std::vector<GivenBuffer>& before) {
    const auto known = [&](std::size_t pass) {
        const auto at = std::ranges::find(later, pass, &GivenBuffer::pass);
        return at != later.end() && at->is_known;
    };
    for (GivenBuffer& given : later) {
        const auto same = std::ranges::find(before, given.pass, &GivenBuffer::pass);
        given.is_known = same != before.end() && given.text_hash != 0 &&
                         same->text_hash == given.text_hash &&
                         std::ranges::all_of(given.reads, known);
    }
}

Sketcher::Sketcher(const std::string& device, const std::filesystem::path& program)
    : process_(device, program, "sketch", memory_.descriptor()) {}

}  // namespace glint
