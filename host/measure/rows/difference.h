// How far a picture is from another: in light, and as the bytes that a display gets.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace glint {

// What the numbers of an RGBA picture are.
enum class Values {
    display,  // sRGB, of a picture as a screen shows it; alpha means nothing
    light,    // linear light, without an upper end; alpha means nothing
    data,     // as a buffer holds them; alpha counts, too, where the two differ in it
};

// Over the channels that mean something. Pixels where either picture is not finite count in
// `not_finite`, those of the second in `reference_not_finite` as well, and nowhere else.
struct Difference {
    double rmse = 0.0, max = 0.0;
    double relative_mse = 0.0;  // mean of (x - r)^2 / (r^2 + 0.01); r: the second picture
    double psnr = 0.0;          // dB, of 8-bit values; infinite when they are equal
    double share_off = 0.0;     // of pixels with a channel off by more than 1/255, as 8-bit
    std::size_t not_finite = 0;
    std::size_t reference_not_finite = 0;  // no fault of the first picture
    double flip = 0.0;  // the mean of flip_map(), as far as somebody has asked for it
};

// RGBA pictures of the same size. The 8-bit figures are of the values as they are, the others of
// those of a display decoded to light.
Difference difference(std::span<const float> picture, std::span<const float> reference,
                      Values values = Values::display);

// How many pixels of an RGBA picture have a number that means something and is not finite.
std::size_t pixels_not_finite(std::span<const float> picture, Values values = Values::display);

// What the numbers of an RGBA picture reach, but for a tenth of them, whatever their sign; 1 of one
// that is black.
double size_of_values(std::span<const float> picture, Values values = Values::display);

// Which pixel, of those that are finite in both, has the channel that differs most, in light as
// above; 0 of equal pictures.
std::size_t worst_pixel(std::span<const float> picture, std::span<const float> reference,
                        Values values = Values::display);

// How many of the four numbers of a pixel mean something.
std::size_t channels_of(Values values);

// What a number is in light; those of data stay as they are.
double in_light(double value, Values values);

// A picture for a display, made linear light; its alpha stays.
void decode_display(std::span<float> picture);

// The picture as a display is sent it: light is encoded, data shown as it is.
std::vector<float> for_display(std::vector<float> picture, Values values);

// The light that an sRGB value stands for; odd about 0, and without an upper end.
double decode_srgb(double value);

}  // namespace glint
