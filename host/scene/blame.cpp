#include "scene/blame.h"

#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace glint {
namespace {

double number_of(std::string_view text) {
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

// How suspicious a loop is: the largest constant of its condition; more than any without one, most
// of all where nothing in it leaves it.
double suspicion(const Reading& reading, const Statement& loop) {
    const std::string condition = reading.spelled(loop.condition);
    const auto tokens = std::span(reading.tokens);
    if (!condition.empty() && condition != "true" && condition != "1") {
        double largest = 0.0;
        for (const Token& token : tokens.subspan(loop.condition.begin, loop.condition.size()))
            if (token.kind == TokenKind::number) largest = std::max(largest, number_of(token.text));
        return largest;
    }
    const bool leaves =
        std::ranges::any_of(tokens.subspan(loop.tokens.begin, loop.tokens.size()),
                            [](const Token& t) { return t.is("break") || t.is("return"); });
    return leaves ? 1e20 : 1e30;
}

struct PassReading {
    std::string entry;  // the function that draws it
    Reading reading;    // the text as that pass has it
};

PassReading read_for(const Scene& scene, const std::string& pass) {
    std::string entry = scene.image_entry;
    std::vector<std::string> outputs = {pass};
    for (const Pass& known : scene.passes) {
        if (known.name == pass) entry = known.entry, outputs = known.outputs;
    }
    return {entry, read_glsl(scene.text, known_of_pass(outputs))};
}

Place entry_of(const Scene& scene, const PassReading& pass) {
    for (const std::uint32_t function : pass.reading.functions_named(pass.entry)) {
        if (pass.reading.functions[function].is_defined())
            return scene.place_at(pass.reading.place(pass.reading.functions[function].name).begin);
    }
    return scene.place(1, 1);
}

}  // namespace

std::optional<Place> likely_endless_loop(const Scene& scene) {
    constexpr double kSuspicious = 10'000.0;
    const Reading reading = read_glsl(scene.text, known_of_scene());
    double worst = 0.0;
    std::uint32_t worst_at = 0;
    for (const Statement& statement : reading.statements) {
        const double found = is_loop(statement.kind) ? suspicion(reading, statement) : 0.0;
        if (found > worst) worst = found, worst_at = statement.tokens.begin;
    }
    if (worst < kSuspicious) return std::nullopt;
    return scene.place_at(reading.place(worst_at).begin);
}

Place reading_place(const Scene& scene, const std::string& pass, std::string_view sampler) {
    const PassReading read = read_for(scene, pass);
    const std::vector<Uniform> uniforms = find_uniforms(read.reading);
    // The site's Image tab may call a channel by its struct.
    const std::string member = sampler.size() == 9 ? fmt::format("iCh{}", sampler.back()) : "";
    for (const std::string_view name : {sampler, std::string_view(member)}) {
        for (std::uint32_t token = 0; token < read.reading.tokens.size(); ++token) {
            if (name.empty() || !read.reading.tokens[token].is(name)) continue;
            const std::size_t at = read.reading.place(token).begin;
            const bool is_declared = std::ranges::any_of(uniforms, [&](const Uniform& uniform) {
                return uniform.span.begin <= at && at < uniform.span.end;
            });
            if (!is_declared) return scene.place_at(at);
        }
    }
    return entry_of(scene, read);
}

Place entry_place(const Scene& scene, const std::string& pass) {
    return entry_of(scene, read_for(scene, pass));
}

}  // namespace glint
