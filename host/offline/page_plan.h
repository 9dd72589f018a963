// What a web page draws, as plain data: passes in drawing order with their texts, what each reads,
// tweaks, events. All that is to be decided is decided here; the page obeys.
#pragma once

#include "render/compile.h"

#include <nlohmann/json.hpp>

namespace glint {

// The plan of a scene that was compiled without constants:
//   title, time, settle, size, files                of the preset; day (from 1970 on) and seconds
//                                                   of its date
//   lines, origins                                  of all texts: each line once; [line of the
//                                                   scene's text, file, line of the file] where
//                                                   the files go over into each other
//   vertex, keyboard                                the vertex shader; whether keys are the scene's
//   tweaks, events
//   inputs[{source, target, modes, …}]              what samplers read, and how: in WebGL's numbers
//   passes[{name, text, first, formats, size, …}]   in drawing order, the picture last; `text` is
//                                                   pairs of first line and the one behind the
//                                                   last, `soft` another
//                                                   one for drivers that draw in software, `first`
//                                                   the line where the scene's own text begins
//   sound                                           passes of mainSound, or none
// Files that are read become bytes, deflated, in base64. Throws Stop where one cannot be read.
nlohmann::ordered_json page_plan(const Preset& preset, const CompiledScene& scene,
                                 const CompiledScene* sound);

}  // namespace glint
