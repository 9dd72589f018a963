// What the preset itself expects: `[expect]` with a picture and how far its own may be from that.
#include "base/temporary_file.h"
#include "base/words.h"
#include "measure/check/case.h"
#include "measure/rows/difference.h"
#include "measure/rows/flip.h"
#include "measure/rows/heat.h"
#include "offline/picture_file.h"

#include <fmt/format.h>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Draws what `glint still` writes: the preset's time, after all that leads up to it, settled.
std::vector<float> draw_still(CheckSubject& subject, glm::ivec2 size) {
    subject.resize(size);
    Renderer& renderer = subject.renderer();
    const Playback playback{.end = subject.opened().time};
    const int last = playback.last_frame(), settle = subject.opened().settle;
    if (subject.stateful()) {
        renderer.reset();
        renderer.set_values(subject.preset.values);
        for (int k = 0; k < last + settle; ++k) {
            renderer.advance(k <= last ? playback.frame(subject.preset, k)
                                       : settled_frame(subject.preset, playback, k - last));
            subject.context().finish();
            if (subject.after_frame) subject.after_frame();
        }
    }
    subject.draw(settled_frame(subject.preset, playback, settle));
    return subject.picture();
}

// Of a pixel, from the left and from the top, as pictures are looked at.
glm::ivec2 place_of(std::size_t pixel, glm::ivec2 size) {
    const auto width = static_cast<std::size_t>(size.x);
    return {static_cast<int>(pixel % width), size.y - 1 - static_cast<int>(pixel / width)};
}

struct Distance {
    double rmse = 0.0, flip = 0.0, max = 0.0;
    std::vector<float> seen{};  // flip_map()
};

// Why it is too far, "" where it is not.
std::string too_far(const Distance& found, const Expect& expect) {
    std::string why;
    const auto hold = [&](const char* name, double value, std::optional<double> most) {
        if (!most || value <= *most) return;
        why += fmt::format("{}{} {:.3g}, {:.3g} is expected at most", why.empty() ? "" : "; ", name,
                           value, *most);
    };
    hold("RMSE", found.rmse, expect.rmse);
    hold("FLIP", found.flip, expect.flip);
    if (!expect.rmse && !expect.flip && found.max > 0.0)
        why = fmt::format("RMSE {:.3g}, FLIP {:.3g}; without rmse and flip it shall be the same",
                          found.rmse, found.flip);
    return why;
}

Values values_of(const ComparedPicture& expected) {
    return expected.is_light ? Values::light : Values::display;
}

// NAME-expected.png, NAME-difference.png and NAME-flip.png, beside NAME.png of the case.
void write_pictures(const Check& check, const std::string& name, const ComparedPicture& expected,
                    std::span<const float> actual, const Distance& found) {
    const auto file = [&](const char* kind) {
        return check.folder /
               fmt::format("{}-{}.png", case_stem(check.subject.opened(), name), kind);
    };
    make_folder(check.folder);
    write_shown(file("expected"), for_display(expected.rgba, values_of(expected)), expected.size);
    write_rgb(file("difference"), difference_heat(actual, expected.rgba, values_of(expected)),
              expected.size);
    write_rgb(file("flip"), heat(found.seen), expected.size);
}

void check_picture(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const Expect& expect = subject.opened().expect;
    if (is_another_look(subject, result)) return;
    ComparedPicture expected;
    try {
        expected = read_compared_picture(expect.picture);
    } catch (const std::runtime_error& error) {
        std::string why = error.what();
        if (is_picture_file(expect.picture))
            why += fmt::format(" Write it with glint still {} -o {}",
                               shell_file(subject.opened().file.string()),
                               shell_file(expect.picture.string()));
        return result.fail(why);
    }
    if (!expected.buffer.empty())
        return result.fail(fmt::format("{} holds the buffer {}, and no picture",
                                       expect.picture.string(), in_quotes(expected.buffer)));
    if (const std::size_t none = pixels_not_finite(expected.rgba); none > 0)
        return result.fail(
            fmt::format("{}: pixels that are no numbers: {}; nothing can be expected of them, so "
                        "draw it anew",
                        expect.picture.string(), none));
    std::vector<float> actual = draw_still(subject, expected.size);
    if (!subject.observed().is_finite()) return;  // a failure of its own
    if (expected.bytes) round_to_bytes(actual, expected.rgba);
    const Values values = values_of(expected);
    if (values == Values::light) decode_display(actual);
    const Difference difference = glint::difference(actual, expected.rgba, values);
    Distance found{.rmse = difference.rmse,
                   .max = difference.max,
                   .seen = flip_map(actual, expected.rgba, expected.size, {.values = values})};
    found.flip = mean(found.seen);
    const std::string why = too_far(found, expect);
    const glm::ivec2 worst = place_of(worst_pixel(actual, expected.rgba, values), expected.size);
    if (why.empty()) {
        result.note = fmt::format("RMSE {:.3g}, FLIP {:.3g}", found.rmse, found.flip);
        return;
    }
    result.fail(fmt::format("{}; most at {},{}, where it is {:.3g} off; expected was {}", why,
                            worst.x, worst.y, found.max, expect.picture.string()));
    try {
        write_pictures(check, result.name, expected, actual, found);
    } catch (const std::runtime_error& error) {  // the case has failed all the same
        result.note += fmt::format("; no pictures: {}", error.what());
    }
}

}  // namespace

void add_expected_picture_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (!subject.opened().expect.picture.empty())
        list.push_back({.name = "expected picture", .run = check_picture});
}

}  // namespace glint
