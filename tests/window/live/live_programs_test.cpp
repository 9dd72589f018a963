// What stays of the programs of texts that were shown.
#include "window/live/live_programs.h"

#include "../../render/fixture.h"

namespace glint::live_programs_test {
namespace {

class ProgramsAtHand : public GlTest {
protected:
    TestFolder folder_;
};

// A day of saving would fill the driver's memory.
TEST_F(ProgramsAtHand, WithoutConstantsThoseOfTheTextBeforeGo) {
    Trial trial({.device = "", .program = GLINT_BINARY, .at_once = false});
    LivePrograms programs(trial, "", false, KeptVerdicts("", ""));
    for (const char* colour : {"0.25", "0.5", "0.75"}) {
        const std::string text =
            fmt::format("void mainImage(out vec4 c, in vec2 p) {{ c = vec4({}); }}", colour);
        const Preset preset = *read_scene_text(folder_, text, {}).preset;
        CompileResult compiled =
            compile_scene(preset, {.program = programs.options(Programs::uniforms_for_good)},
                          nullptr, nullptr, &programs.shelf());
        const Renderer renderer(preset, std::move(*compiled.scene), {.size = preset.size});
        programs.note_drawn(Programs::uniforms_for_good, true, nullptr, false);
        programs.tidy(renderer);
        EXPECT_EQ(programs.shelf().size(), 1u) << colour;
    }
}

}  // namespace
}  // namespace glint::live_programs_test
