// The `//@` grammar of samplers: who fills them, and how they are read.
#include "base/words.h"
#include "scene/annotation.h"
#include "scene/annotation_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <numeric>
#include <unordered_set>
#include <utility>

namespace glint {

namespace {

constexpr int kLargestTexture = 16384;  // pixels; what every desktop GL can draw into

bool is_identifier(std::string_view text) {
    const auto letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    return !text.empty() && letter(text[0]) &&
           std::ranges::all_of(text, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

std::optional<int> parse_length(std::string_view text) {
    int length = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if (length < 1 || length > kLargestTexture) return std::nullopt;
    return length;
}

// "256", "256x128", "32x32x32": as many lengths as are written, at most three.
std::optional<std::vector<int>> parse_lengths(std::string_view text) {
    std::vector<int> lengths;
    for (std::size_t begin = 0;;) {
        const std::size_t x = text.find('x', begin);
        const auto length = parse_length(text.substr(begin, x - begin));
        if (!length || lengths.size() == 3) return std::nullopt;
        lengths.push_back(*length);
        if (x == std::string_view::npos) return lengths;
        begin = x + 1;
    }
}

std::optional<int> noise_channels(std::string_view text) {
    if (text == "r" || text == "gray") return 1;
    if (text == "rg") return 2;
    if (text == "rgb") return 3;
    if (text == "rgba") return 4;
    return std::nullopt;
}

// What fills a sampler of this type from a file, for a message.
const char* source_for(SamplerType type) {
    return type == SamplerType::samplerCube ? "cube sky.hdr"
           : type == SamplerType::sampler3D ? "volume clouds.bin"
                                            : "image wood.png";
}

struct SamplerParser {
    SamplerAnnotation result;
    Words words;
    std::unordered_set<std::string_view> options;  // those seen

    void parse();
    void parse_source(std::string_view word, std::size_t at);
    void parse_target(std::string_view what);
    void parse_file(Source source, SamplerType type, std::string_view example);
    void parse_cube();
    bool has_type(SamplerType type, std::string_view what, std::size_t at);
    void parse_noise_words();
    void parse_option(std::string_view key, std::size_t at);
    void parse_pass_option(std::string_view key, std::string_view value, std::size_t at);
    void parse_size(std::string_view value, std::size_t at);
    std::vector<std::string> known_options() const;
    bool is_cube() const { return result.sampler.type == SamplerType::samplerCube; }
};

void SamplerParser::parse() {
    const std::size_t at = words.at();
    const std::string_view source = words.bare("=\"");
    parse_source(source, at);
    if (result.sampler.source == Source::none) return;
    while (!words.done()) {
        const std::size_t option_at = words.at();
        const std::string_view key = words.bare("=\"");
        if (words.accept('=') && !key.empty()) {
            parse_option(key, option_at);
            continue;
        }
        if (key.empty() && words.peek() == '"') {
            words.quoted_text();  // a description; nothing shows it
            continue;
        }
        const auto known = known_options();
        if (std::ranges::find(known, key) != known.end())
            words.complain(option_at,
                           fmt::format("{0} has no value; write {0}= and what it is", key));
        else
            words.warn(option_at, fmt::format("unknown word {}; known here are {}=", in_quotes(key),
                                              fmt::join(known, "=, ")));
    }
    if (result.size && result.scale)
        words.complain(result.scale->at, "size and scale contradict each other; keep one");
}

void SamplerParser::parse_source(std::string_view word, std::size_t at) {
    Sampler& sampler = result.sampler;
    if (word == "pass") {
        if (sampler.type == SamplerType::sampler3D)
            return words.complain(at, "a pass fills a sampler2D or a samplerCube, no sampler3D");
        set_defaults(sampler, Source::buffer);
        return parse_target("function, such as pass mainWaves");
    }
    if (word == "buffer") {
        set_defaults(sampler, Source::buffer);
        result.reads_another = true;
        return parse_target("sampler that has the pass, such as buffer waves");
    }
    if (word == "image") return parse_file(Source::image, SamplerType::sampler2D, "image wood.png");
    if (word == "sound") return parse_file(Source::sound, SamplerType::sampler2D, "sound song.ogg");
    if (word == "volume")
        return parse_file(Source::volume, SamplerType::sampler3D, "volume clouds.bin");
    if (word == "cube") return parse_cube();
    if (word == "noise") {
        set_defaults(sampler, Source::noise);
        return parse_noise_words();
    }
    if (word == "keyboard") {
        if (has_type(SamplerType::sampler2D, "the keyboard", at))
            set_defaults(sampler, Source::keyboard);
        return;
    }
    static const std::vector<std::string> known(kFillers.begin(), kFillers.end());
    words.complain(at, fmt::format("{} fills no sampler; write pass, buffer, image, cube, volume, "
                                   "sound, noise or keyboard{}",
                                   in_quotes(word), did_you_mean(word, known)));
}

void SamplerParser::parse_target(std::string_view what) {
    result.target_at = words.at();
    result.target = words.bare("=\"");
    const bool is_option = words.accept('=');  // and the name is forgotten
    if (is_identifier(result.target) && !is_option) return;
    if (is_option) words.bare("\"");
    words.complain(result.target_at, fmt::format("here stands the name of a {}", what));
}

bool SamplerParser::has_type(SamplerType type, std::string_view what, std::size_t at) {
    if (result.sampler.type == type) return true;
    words.complain(at, fmt::format("{} is a {}; declare it as that, or write {} here", what,
                                   glsl_name(type), source_for(result.sampler.type)));
    return false;
}

void SamplerParser::parse_file(Source source, SamplerType type, std::string_view example) {
    const std::string_view word = example.substr(0, example.find(' '));
    if (!has_type(type, fmt::format("a file behind {}", word), words.at())) return;
    set_defaults(result.sampler, source);
    const std::size_t at = words.at();
    const std::string path = words.text();
    if (path.empty()) words.complain(at, fmt::format("the path is missing; write {}", example));
    result.sampler.files = {path};
}

// One file or six. A quoted text behind them is the description.
void SamplerParser::parse_cube() {
    const std::size_t at = words.at();
    if (!has_type(SamplerType::samplerCube, "a cube", at)) return;
    set_defaults(result.sampler, Source::cube);
    auto& files = result.sampler.files;
    bool ends_quoted = false;
    while (!words.done()) {
        Words ahead = words.ahead();
        if (!ahead.bare("=\"").empty() && ahead.accept('=')) break;
        ends_quoted = words.peek() == '"';
        files.emplace_back(words.text());
    }
    if (ends_quoted && (files.size() == 2 || files.size() == kCubeFaces + 1)) files.pop_back();
    const std::string wrong = check_cube_files(files.size());
    if (!wrong.empty()) words.complain(at, wrong);
}

void SamplerParser::parse_noise_words() {
    const std::size_t at = words.at();
    std::string text(words.bare("=\""));
    Words ahead = words;
    const std::string_view more = ahead.bare("=\"");
    if (noise_channels(text) && !more.empty() && ahead.peek() != '=') {
        text = fmt::format("{} {}", text, more);
        words = ahead;
    }
    const std::string wrong = parse_noise(text, result.sampler);
    if (wrong.empty()) return;
    words.complain(at, wrong);
    if (parse_lengths(more)) words = ahead;  // no second complaint
}

std::vector<std::string> SamplerParser::known_options() const {
    std::vector<std::string> known = {"filter", "wrap"};
    const bool is_pass = result.sampler.source == Source::buffer && !result.reads_another;
    if (is_pass)
        known.insert(known.end(), {"size", "scale", "step", "format", "bounded", "conserves"});
    for (const char* option : {"vflip", "plays"})
        if (takes_option(result.sampler.source, option)) known.push_back(option);
    return known;
}

void SamplerParser::parse_option(std::string_view key, std::size_t at) {
    const auto known = known_options();
    if (!options.insert(key).second) words.complain(at, fmt::format("a second {}=; keep one", key));
    const std::size_t value_at = words.at();
    std::string value;
    if (words.accept('[')) {
        const auto inside = words.list(']', value_at);
        if (!inside) return;
        value = *inside;
    } else {
        value = words.text();
    }
    const auto complain = [&](std::string_view what) {
        words.complain(value_at, fmt::format("{} is {}; write {}", key, in_quotes(value), what));
    };
    if (std::ranges::find(known, key) == known.end()) {
        words.warn(at, fmt::format("unknown word {}; known here are {}={}", in_quotes(key),
                                   fmt::join(known, "=, "), did_you_mean(key, known)));
    } else if (key == "filter") {
        if (const auto filter = kFilterNames.find(value))
            result.sampler.filter = *filter;
        else
            complain("nearest, linear or mipmap");
    } else if (key == "wrap") {
        if (const auto wrap = kWrapNames.find(value))
            result.sampler.wrap = *wrap;
        else
            complain("clamp, repeat or mirror");
    } else if (key == "vflip" || key == "plays") {
        if (const auto on = parse_switch(value))
            (key == "vflip" ? result.sampler.vflip : result.sampler.plays) = *on;
        else
            complain("on or off");
    } else {
        parse_pass_option(key, value, value_at);
    }
}

void SamplerParser::parse_pass_option(std::string_view key, std::string_view value,
                                      std::size_t at) {
    const auto complain = [&](std::string_view what) {
        words.complain(at, fmt::format("{} is {}; write {}", key, in_quotes(value), what));
    };
    if (key == "size") {
        parse_size(value, at);
    } else if (key == "scale") {
        constexpr double kLargestScale = 16.0;
        const auto scale = parse_number(value);
        if (!scale || *scale <= 0.0 || *scale > kLargestScale)
            return complain("a number above 0, at most 16");
        if (is_cube()) return words.complain(at, "a cube has no scale; write size=256");
        result.scale = Option<double>{*scale, at};
    } else if (key == "step") {
        // Shorter steps are below iTick's own, longer ones would never come.
        const auto step = parse_step(value);
        if (!step || step->seconds() < 1.0 / 65536 || step->seconds() > 3600.0)
            return complain("seconds from 1/65536 to 3600, such as 1/240");
        result.step = Option<Step>{*step, at};
    } else if (key == "bounded") {
        result.sampler.bounded = parse_bounds(value);
        if (!result.sampler.bounded)
            complain("two numbers, the smaller first, such as bounded=[-1, 1]");
    } else if (key == "conserves") {
        const auto share = parse_number(value);
        if (!share || *share <= 0.0 || *share > 1.0)
            return complain("the share that may be lost, such as 1e-6");
        result.sampler.conserves = share;
    } else if (key == "format") {
        const auto format = parse_pixel_format(value);
        if (!format) return complain(expected_pixel_format(value));
        result.format = Option<PixelFormat>{*format, at};
    }
}

void SamplerParser::parse_size(std::string_view value, std::size_t at) {
    const auto lengths = parse_lengths(value);
    if (!lengths || lengths->size() > 2)
        return words.complain(at, fmt::format("size is {}; write 256 or 256x128, each from 1 to {}",
                                              in_quotes(value), kLargestTexture));
    if (is_cube() && lengths->front() != lengths->back())
        return words.complain(at, "the faces of a cube are square; write size=256");
    result.size = Option<glm::ivec2>{{lengths->front(), lengths->back()}, at};
}

// A decimal as an exact fraction.
std::optional<Step> parse_rational(std::string_view text) {
    Step step;
    bool after_point = false, any_digit = false;
    constexpr long kLargest = 1'000'000'000;  // products of two stay exact
    for (const char c : text) {
        if (c == '.' && !after_point) {
            after_point = true;
            continue;
        }
        if (c < '0' || c > '9' || step.numerator > kLargest / 10 - 1 ||
            (after_point && step.denominator >= kLargest))
            return std::nullopt;
        any_digit = true;
        step.numerator = step.numerator * 10 + (c - '0');
        if (after_point) step.denominator *= 10;
    }
    return any_digit ? std::optional(step) : std::nullopt;
}

}  // namespace

SamplerAnnotation parse_sampler(Sampler sampler, std::string_view annotation,
                                std::vector<Complaint>& complaints) {
    SamplerParser parser{.result = {}, .words = Words(annotation, complaints), .options = {}};
    parser.result.sampler = std::move(sampler);
    parser.parse();
    return parser.result;
}

std::optional<Step> parse_step(std::string_view text) {
    const std::size_t slash = text.find('/');
    const auto above = parse_rational(text.substr(0, slash));
    auto below = std::optional<Step>(Step{1, 1});
    if (slash != std::string_view::npos) below = parse_rational(text.substr(slash + 1));
    if (!above || !below || below->numerator == 0 || above->numerator == 0) return std::nullopt;
    Step step{above->numerator * below->denominator, above->denominator * below->numerator};
    const long common = std::gcd(step.numerator, step.denominator);
    return Step{step.numerator / common, step.denominator / common};
}

std::string parse_noise(std::string_view text, Sampler& sampler) {
    text = trimmed(text);
    const bool is_volume = sampler.type == SamplerType::sampler3D;
    const bool is_cube = sampler.type == SamplerType::samplerCube;
    const std::string how = is_volume ? "write noise rgba 32 or noise r 32x32x32"
                            : is_cube ? "write noise rgba 64"
                                      : "write noise rgba 256 or noise r 256x128";
    const std::size_t space = text.find(' ');
    std::string_view size = text;
    if (const auto channels = noise_channels(text.substr(0, space))) {
        sampler.noise_channels = *channels;
        size = space == std::string_view::npos ? std::string_view() : trimmed(text.substr(space));
    }
    if (size.empty()) return fmt::format("the size of the noise is missing; {}", how);
    const auto lengths = parse_lengths(size);
    const std::size_t dimensions = is_volume ? 3 : is_cube ? 1 : 2;
    if (!lengths || (lengths->size() != 1 && lengths->size() != dimensions))
        return fmt::format("{} is no noise; {}, each from 1 to {}", in_quotes(text), how,
                           kLargestTexture);
    const bool one = lengths->size() == 1;
    const glm::ivec3 pixels(lengths->front(), (*lengths)[one ? 0 : 1],
                            is_volume ? lengths->back() : 1);
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;
    if (std::int64_t{pixels.x} * pixels.y > kMostPixels / pixels.z)
        return fmt::format("{} is more noise than memory can hold; write less", in_quotes(text));
    sampler.noise_size = pixels;
    return {};
}

std::string check_cube_files(std::size_t count) {
    if (count == 1 || count == kCubeFaces) return {};
    return fmt::format(
        "a cube is one file, or six in the order +X -X +Y -Y +Z -Z, and not {}; write cube sky.hdr "
        "or cube px.png nx.png py.png ny.png pz.png nz.png",
        count);
}

bool takes_option(Source source, std::string_view option) {
    if (option == "vflip") return source == Source::image || source == Source::cube;
    return option != "plays" || source == Source::noise;
}

void set_defaults(Sampler& sampler, Source source) {
    const bool is_cube = sampler.type == SamplerType::samplerCube;
    const bool is_picture = source == Source::image || source == Source::noise ||
                            source == Source::cube || source == Source::volume;
    sampler.source = source;
    sampler.filter = source == Source::keyboard ? Filter::nearest
                     : is_picture               ? Filter::mipmap
                                                : Filter::linear;
    sampler.wrap = is_picture && !is_cube ? Wrap::repeat : Wrap::clamp;
    sampler.vflip = !is_cube;
}

}  // namespace glint
