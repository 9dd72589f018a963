// What a person may hand to Glint, broken in every way that libFuzzer finds: scene files, presets,
// and the site's JSON. FUZZ_AS in the environment says which: scene, preset or json.
#include "glsl/zeros.h"
#include "scene/preset.h"
#include "scene/shadertoy.h"

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace {

namespace fs = std::filesystem;

// A folder of this process's own; it is made once, and its files written again for each input.
const fs::path& folder() {
    static const fs::path made = [] {
        const fs::path path =
            fs::temp_directory_path() / ("glint-fuzz-" + std::to_string(getpid()));
        fs::create_directories(path);
        std::ofstream(path / "scene.frag")
            << "uniform float level; //@ 0.5 [0, 1] \"how bright\"\n"
               "uniform int kind; //@ 1 {none, some, all}\nuniform vec3 tint; //@ #0b3a53\n"
               "void mainImage(out vec4 c, in vec2 p) { c = vec4(tint * level, kind); }\n";
        return path;
    }();
    return made;
}

void write_zeros(std::string_view text) {
    glint::write_zeros(glint::read_glsl(text, glint::known_of_driver()));
}

void import_all(const fs::path& file) {
    glint::Diagnostics diagnostics;
    for (const glint::Shadertoy& shader : glint::read_shadertoys(file, diagnostics))
        glint::scene_text(shader, file, folder(), diagnostics);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const char* wanted = std::getenv("FUZZ_AS");
    const std::string_view kind = wanted ? wanted : "scene";
    const fs::path file = folder() / (kind == "preset" ? "input.toml"
                                      : kind == "json" ? "input.json"
                                                       : "input.frag");
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    if (kind == "json")
        import_all(file);
    else
        glint::read_preset(file);
    if (kind == "scene") write_zeros({reinterpret_cast<const char*>(data), size});
    return 0;
}
