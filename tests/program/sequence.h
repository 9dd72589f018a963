// What tests of sequences and of their states share: calls of `glint sequence`.
#pragma once

#include "command.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace glint::cli {

class SequenceTest : public InAFolder {
protected:
    // `words` begin every call; `size` is the picture's where a call names none.
    SequenceTest(std::vector<std::string> words, std::string size)
        : words_(std::move(words)), size_(std::move(size)) {}

    Outcome sequence(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), words_.begin(), words_.end());
        if (std::find(arguments.begin(), arguments.end(), "--size") == arguments.end()) {
            arguments.insert(arguments.end(), {"--size", size_});
        }
        return glint(std::move(arguments));
    }

    // What --json tells of a call, which must succeed.
    nlohmann::json result(std::vector<std::string> arguments) const {
        arguments.push_back("--json");
        const Outcome outcome = sequence(std::move(arguments));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out, nullptr, false);
    }

private:
    std::vector<std::string> words_;
    std::string size_;
};

}  // namespace glint::cli
