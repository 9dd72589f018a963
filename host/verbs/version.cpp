#include "verbs/version.h"

#include "gl/context.h"
#include "verbs/commit.h"

#include <fmt/format.h>

#include <stdexcept>

namespace glint {
namespace {

std::string renderer_or_why_not() {
    try {
        return make_egl_context()->renderer();
    } catch (const std::runtime_error& error) {
        return fmt::format("none. {}", error.what());
    }
}

}  // namespace

std::string version_text() {
    return fmt::format("glint {} ({}, {})\nrenderer: {}\nbuilt with: {}", GLINT_VERSION, kCommit,
                       kCommitDate, renderer_or_why_not(), GLINT_LIBRARIES);
}

}  // namespace glint
