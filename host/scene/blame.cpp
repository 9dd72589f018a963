#include "scene/blame.h"

#include "base/words.h"
#include "glsl/declaration.h"
#include "glsl/raw_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace glint {
namespace {

std::size_t skip_space(std::string_view text, std::size_t at) {
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
    return at;
}

// What stands in the brackets that open at `at`, nested ones included.
std::string_view in_brackets(std::string_view text, std::size_t at, char opening, char closing) {
    int depth = 0;
    for (std::size_t i = at; i < text.size(); ++i) {
        if (text[i] == opening) ++depth;
        if (text[i] == closing && --depth == 0) return text.substr(at + 1, i - at - 1);
    }
    return text.substr(std::min(at + 1, text.size()));
}

double largest_number(std::string_view condition) {
    double largest = 0.0;
    for (std::size_t i = 0; i < condition.size(); ++i) {
        const bool begins = std::isdigit(static_cast<unsigned char>(condition[i])) != 0 &&
                            (i == 0 || !is_word(condition[i - 1]));
        if (begins) {
            largest = std::max(largest, std::strtod(std::string(condition.substr(i)).c_str(), {}));
        }
    }
    return largest;
}

// How suspicious a loop is: its largest constant; more than any without a condition, most of all
// where nothing in it leaves it.
double suspicion(std::string_view code, std::size_t keyword_end, bool is_for) {
    const std::size_t open = skip_space(code, keyword_end);
    if (open >= code.size() || code[open] != '(') return 0.0;
    const std::string_view head = in_brackets(code, open, '(', ')');
    std::string_view condition = head;
    if (is_for) {
        const std::size_t first = head.find(';');
        if (first == head.npos) return 0.0;
        condition = head.substr(first + 1, head.find(';', first + 1) - first - 1);
    }
    const std::string_view bare = trimmed(condition);
    if (!bare.empty() && bare != "true" && bare != "1") return largest_number(condition);
    const std::size_t body = skip_space(code, open + head.size() + 2);
    if (body >= code.size() || code[body] != '{') return 1e30;
    const std::string_view inside = in_brackets(code, body, '{', '}');
    const bool leaves = find_word(inside, "break", 0) != inside.npos ||
                        find_word(inside, "return", 0) != inside.npos;
    return leaves ? 1e20 : 1e30;
}

Place place_of(const Scene& scene, std::size_t at) {
    const auto end = scene.text.begin() + static_cast<std::ptrdiff_t>(at);
    const auto line = 1 + std::count(scene.text.begin(), end, '\n');
    const std::size_t begin = at == 0 ? 0 : scene.text.rfind('\n', at - 1) + 1;
    return scene.place(static_cast<int>(line), static_cast<int>(at - begin) + 1);
}

}  // namespace

std::optional<Place> likely_endless_loop(const Scene& scene) {
    constexpr double kSuspicious = 10'000.0;
    const std::string code = find_comments(scene.text).code;
    double worst = 0.0;
    std::size_t worst_at = 0;
    for (const std::string_view keyword : {"for", "while"}) {
        for (std::size_t at = find_word(code, keyword, 0); at != code.npos;
             at = find_word(code, keyword, at + 1)) {
            const double found = suspicion(code, at + keyword.size(), keyword == "for");
            if (found > worst || (found == worst && at < worst_at)) worst = found, worst_at = at;
        }
    }
    if (worst < kSuspicious) return std::nullopt;
    return place_of(scene, worst_at);
}

Place reading_place(const Scene& scene, const std::string& pass, std::string_view sampler) {
    const std::string code = find_comments(scene.text).code;
    const std::vector<Tab> tabs = find_tabs(code);
    const std::vector<Declaration> uniforms = find_uniforms(code);
    // The site's Image tab may call a channel by its struct.
    const std::string member = sampler.size() == 9 ? fmt::format("iCh{}", sampler.back()) : "";
    for (const std::string_view name : {sampler, std::string_view(member)}) {
        for (std::size_t at = name.empty() ? code.npos : find_word(code, name); at != code.npos;
             at = find_word(code, name, at + 1)) {
            const auto holds = [&](Span span) { return span.begin <= at && at < span.end; };
            const bool is_elsewhere =
                std::any_of(tabs.begin(), tabs.end(),
                            [&](const Tab& tab) { return holds(tab.span) && tab.pass != pass; }) ||
                std::any_of(uniforms.begin(), uniforms.end(),
                            [&](const Declaration& uniform) { return holds(uniform.span); });
            if (!is_elsewhere) return place_of(scene, at);
        }
    }
    return entry_place(scene, pass);
}

Place entry_place(const Scene& scene, const std::string& pass) {
    std::string entry = scene.image_entry;
    for (const Pass& known : scene.passes) {
        if (known.name == pass) entry = known.entry;
    }
    const std::string code = find_comments(scene.text).code;
    for (std::size_t at = find_word(code, entry, 0); at != code.npos;
         at = find_word(code, entry, at + 1)) {
        const std::size_t before = code.find_last_not_of(" \t\n", at - (at > 0));
        const bool defined =
            before != code.npos && before >= 3 && code.compare(before - 3, 4, "void") == 0;
        if (defined) return place_of(scene, at);
    }
    return scene.place(1, 1);
}

}  // namespace glint
