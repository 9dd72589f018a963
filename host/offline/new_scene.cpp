#include "offline/new_scene.h"

#include "base/canonical_name.h"
#include "base/temporary_file.h"
#include "offline/common.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {

namespace fs = std::filesystem;

fs::path write_new_scene(const fs::path& file, std::string_view from) {
    const std::span<const SceneTemplate> all = scene_templates();
    const auto chosen = std::ranges::find(all, from, &SceneTemplate::name);
    if (chosen == all.end())
        throw UsageError(fmt::format("There is no scene '{}' to begin with.", from));
    fs::path scene = file;
    if (!file.has_filename() || file.filename() == "." || file.filename() == "..")
        throw UsageError("Name the new scene, such as rings.frag.");
    if (ending_of(scene) != ".frag") scene += ".frag";
    if (is_taken(scene)) throw cannot_write(scene, "it is there already; name another file");
    write_whole_file(scene, std::as_bytes(std::span(chosen->text)));
    return scene;
}

}  // namespace glint
