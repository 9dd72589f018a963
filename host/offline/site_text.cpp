#include "offline/site_text.h"

#include "base/words.h"
#include "glsl/lean.h"
#include "glsl/reachable.h"
#include "render/pass_text.h"
#include "scene/builtin.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <regex>
#include <string_view>

namespace glint {
namespace {

// An annotation means nothing there; its words still describe the constant.
void make_notes_plain(const Reading& reading, Edits& edits) {
    for (const Comment& comment : reading.comments) {
        const std::size_t begin = comment.span.begin;
        if (reading.text.substr(begin, 4) == "//@ ")
            edits.replace_bytes({begin, begin + 4}, "// ");
        else if (reading.text.substr(begin, 3) == "//@")
            edits.replace_bytes({begin, begin + 3}, "// ");
    }
}

// What the site's names are for those of other programs, which the text declares.
std::string name_there(std::string_view type, const Declarator& declarator,
                       const Reading& reading) {
    const ForeignName* known = find_foreign_name(type, reading.word(declarator.name));
    if (!known || !declarator.array.empty()) return {};
    const bool is_name = known->words.find('.') == std::string_view::npos;
    return is_name ? std::string(known->words) : fmt::format("({})", known->words);
}

// `uniform Name { float a; };` has members that are names of the text's own, and one with a name
// is a struct otherwise.
void open_block(const Reading& reading, const Declaration& block, Edits& edits) {
    std::uint32_t open = block.tokens.begin;
    while (open < block.tokens.end && !reading.tokens[open].is("{")) ++open;
    if (open == block.tokens.end || reading.close_of(open) == kNone) return;
    const bool has_name = !block.names.empty();
    edits.replace({block.tokens.begin, open + 1}, has_name ? "struct {" : "");
    if (!has_name) edits.replace({reading.close_of(open), block.tokens.end}, "");
}

// Uniforms that nothing fills are 0. So are the site's globals without a value: browsers see to it.
EditedText without_own_uniforms(const Reading& reading) {
    Edits edits(reading);
    for (const Declaration& declaration : reading.declarations) {
        const std::string_view type = reading.word(declaration.type);
        if (declaration.is_uniform && declaration.is_block) open_block(reading, declaration, edits);
        const bool has_names = !declaration.names.empty();  // else it is `layout(std140) uniform;`
        if (!declaration.is_uniform || declaration.is_block || !has_names ||
            type.starts_with("sampler"))
            continue;
        const TokenRange words = declaration.qualifiers;
        for (std::uint32_t at = words.begin; at < words.end; ++at)
            if (reading.tokens[at].is("uniform")) edits.replace({at, at + 1}, "");
        const Span place = reading.place(declaration.tokens);
        for (const Declarator& declarator : declaration.names) {
            const std::string theirs = name_there(type, declarator, reading);
            if (theirs.empty()) continue;
            for (const Token& token : reading.written)
                if (token.is(reading.word(declarator.name)) &&
                    (token.begin < place.begin || token.begin >= place.end))
                    edits.replace_bytes(token.span(), theirs);
        }
    }
    return edits.apply();
}

}  // namespace

SiteText site_text(const Preset& preset, std::size_t pass) {
    const Known known = known_of_pass(output_names(preset.scene, pass));
    const EditedText constant = specialised_text(preset);
    const EditedText own = without_own_uniforms(read_glsl(constant.text, known));
    const EditedText reached =
        reachable_text(read_glsl(own.text, known), entry_of(preset.scene, pass), kPassPrefix);
    const Reading reading = read_glsl(reached.text, known);
    Edits edits(reading);
    make_notes_plain(reading, edits);
    leave_out_semicolons(reading, edits);
    EditedText plain = edits.apply();
    return {std::move(plain.text), {constant.map, own.map, reached.map, std::move(plain.map)}};
}

std::size_t SiteText::origin(std::size_t at) const {
    for (const EditMap& map : maps | std::views::reverse) at = map.origin(at);
    return at;
}

std::string without_heads(const std::string& text) {
    static const std::regex head(
        "// iChannel[0-3]: .{0,200}, (nearest|linear|mipmap), (clamp|repeat)");
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
        if (!line.empty() && !std::regex_match(line.begin(), line.end(), head)) break;
        begin = end + 1;
    }
    begin = std::min(begin, text.size());
    const std::string kept = text.substr(begin, text.find_last_not_of('\n') + 1 - begin);
    return kept + '\n';
}

std::string missing_channels_text(PixelFormat format, const std::string& colour) {
    const int channels = channel_count(format);
    if (channels == 4) return {};
    return fmt::format("    {0} = vec4({0}.{1}, 1.0);\n", colour,
                       channels == 1 ? "r, 0.0, 0.0" : "rg, 0.0");
}

}  // namespace glint
