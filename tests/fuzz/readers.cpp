// What a person may hand to Glint, broken in every way that libFuzzer finds: scene files, presets,
// the site's JSON, and bare texts for the reader of GLSL. FUZZ_AS in the environment says which:
// scene, preset, json or glsl.
#include "../base/test_folder.h"
#include "glsl/division.h"
#include "glsl/finding.h"
#include "glsl/hidden_zero.h"
#include "glsl/lean.h"
#include "glsl/numbers.h"
#include "glsl/raw_text.h"
#include "glsl/reachable.h"
#include "glsl/zeros.h"
#include "render/own_overloads.h"
#include "scene/lint.h"
#include "scene/preset.h"
#include "scene/scene_text.h"
#include "scene/shadertoy.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace {

namespace fs = std::filesystem;

// A folder of this process's own; it is made once, and its files written again for each input.
const fs::path& folder() {
    static const glint::TestFolder made;
    static const fs::path scene =
        made.write("scene.frag",
                   "uniform float level; //@ 0.5 [0, 1] \"how bright\"\n"
                   "uniform int kind; //@ 1 {none, some, all}\nuniform vec3 tint; //@ #0b3a53\n"
                   "void mainImage(out vec4 c, in vec2 p) { c = vec4(tint * level, kind); }\n");
    return made.path();
}

void import_all(const fs::path& file) {
    glint::Diagnostics diagnostics;
    for (const glint::Shadertoy& shader : glint::read_shadertoys(file, diagnostics))
        glint::scene_text(shader, file, folder(), diagnostics);
}

// Everything that is asked of a text, for all passes and for one.
void read_text(std::string_view raw) {
    using namespace glint;
    const std::string text = clean_text(raw).text;
    for (const Known& known :
         {known_of_scene(), known_of_pass(std::vector<std::string>{"image"})}) {
        const Reading reading = read_glsl(text, known);
        find_uniforms(reading);
        find_tabs(reading);
        own_overloads(reading);
        reachable_text(reading, "mainImage", kPassPrefix);
        Edits edits(reading);
        const std::vector<bool> all(reading.functions.size(), true);
        find_shadowed_names(reading, all);
        find_reserved_names(reading, all);
        find_refused_by_browsers(reading, all);
        find_long_loops(reading, all, {{"steps", 100.0}});
        mend_division_by_zero(reading, {}, edits);
        Edits lean(reading);
        const std::vector<bool> reached = reading.reached_from({"mainImage"});
        const bool is_lean = can_be_lean(reading);
        if (is_lean) leave_out_functions(reading, reached, lean);
        if (is_lean) leave_out_constants(reading, unused_constants(reading, reached, {}), lean);
        feed_numbers(reading, reached, "numbers", is_lean, lean);
        without_comments(lean.apply().text);
        hide_zeros(reading,
                   write_zeros(reading, edits, "mainImage", Span{text.size() / 2, text.size()}),
                   {"a", "size"}, edits);
        for (const Declaration& declaration : reading.declarations)
            for (const Declarator& one : declaration.names) edits.after(one.tokens.end - 1, "/**/");
        for (const Statement& statement : reading.statements)
            edits.before(statement.tokens.begin, "/**/");
        for (const Call& call : reading.calls) edits.replace({call.name, call.name + 1}, "f");
        const EditedText edited = edits.apply();
        for (std::size_t at = 0; at <= edited.text.size(); ++at)
            if (edited.map.origin(at) > text.size()) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const char* wanted = std::getenv("FUZZ_AS");
    const std::string_view kind = wanted ? wanted : "scene";
    if (kind == "glsl") {
        read_text({reinterpret_cast<const char*>(data), size});
        return 0;
    }
    const fs::path file = folder() / (kind == "preset" ? "input.toml"
                                      : kind == "json" ? "input.json"
                                                       : "input.frag");
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    if (kind == "json") {
        import_all(file);
    } else if (const glint::ReadPreset read = glint::read_preset(file); read.preset) {
        glint::lint(*read.preset);
    }
    return 0;
}
