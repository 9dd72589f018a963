// What a web page draws, as plain data: passes in drawing order with their texts, what each reads,
// tweaks, events. All that is to be decided is decided here; the page obeys.
#pragma once

#include "render/compile.h"

#include <nlohmann/json.hpp>

namespace glint {

// The plan of a scene that was compiled without constants:
//   title, time, settle, size, date, files          of the preset
//   lines, origins                                  of all texts: each line once; [line of the
//                                                   scene's text, file, line of the file] where
//                                                   the files go over into each other
//   tweaks, events
//   inputs[{type, source, filter, wrap, …}]         what samplers read
//   passes[{name, text, first, format, size, …}]    in drawing order, the picture last; `text` is
//                                                   pairs of first line and count, `first` the
//                                                   line where the scene's own text begins
//   sound                                           passes of mainSound, or none
// Files that are read become bytes, deflated, in base64. Throws Stop where one cannot be read.
nlohmann::ordered_json page_plan(const Preset& preset, const CompiledScene& scene,
                                 const CompiledScene* sound);

}  // namespace glint
