// Glitter that a scene filters, against many samples of its bare waves.
#pragma once

#include "probe.h"

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace glint {

class Glitter {
public:
    struct Errors {
        double mean = 0.0;    // against the truth's, less 1
        double spread = 0.0;  // RMSE over the truth's mean
        double truth = 0.0;   // its mean, share of the sun's light per unit of solid angle
    };
    // A picture of the scene's glitter in x and the truth in y; iMouse.x has what errors() is
    // given.
    Glitter(std::string text, glm::ivec2 size)
        : text_(std::move(text)), player_(text_, {.size = size, .specialise = false}) {}

    Errors errors(const std::string& tweaks, double mouse, double time) {
        const TestFolder folder;
        const ReadPreset read = read_scene_text(folder, text_, {.preset = "[tweaks]\n" + tweaks});
        if (!read.preset) throw std::runtime_error(to_text(read.diagnostics));
        player_.preset.values = read.preset->values;
        Frame frame = player_.frame(0);
        frame.time = time;
        frame.input.mouse = {static_cast<float>(mouse), 0, 0, 0};
        player_.draw(frame);
        const std::vector<float> floats = player_.floats();
        double got = 0.0, truth = 0.0, squares = 0.0;
        for (std::size_t i = 0; i < floats.size(); i += 4) {
            const double a = floats[i], b = floats[i + 1];
            got += a;
            truth += b;
            squares += (a - b) * (a - b);
        }
        const double count = static_cast<double>(floats.size() / 4);
        return {got / truth - 1.0, std::sqrt(squares / count) / (truth / count), truth / count};
    }

private:
    std::string text_;
    Player player_;
};

}  // namespace glint
