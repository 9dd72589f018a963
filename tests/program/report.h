// What verbs tell with --json, and the scenes that check and study are held against.
#pragma once

#include "command.h"

#include <nlohmann/json.hpp>

namespace glint::cli {

// The object on stdout of a call with --json that ends with this code.
inline nlohmann::json report_of(const Outcome& outcome, int code = 0) {
    EXPECT_EQ(outcome.code, code) << outcome.out << outcome.err;
    nlohmann::json json = nlohmann::json::parse(outcome.out, nullptr, false);
    EXPECT_TRUE(json.is_object()) << outcome.out;
    return json;
}

// A scene of tests/scenes.
inline fs::path known_scene(const std::string& name) {
    return fs::path(GLINT_REPOSITORY) / "tests/scenes" / (name + ".frag");
}

}  // namespace glint::cli
