// What tests of sequences and of their states share: calls of `glint sequence`.
#pragma once

#include "report.h"

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
        return report_of(sequence(std::move(arguments)));
    }

private:
    std::vector<std::string> words_;
    std::string size_;
};

}  // namespace glint::cli
