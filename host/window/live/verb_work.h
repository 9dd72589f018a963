// A verb that works for the window in a process of its own, and says in lines of JSON what it has
// found and how far it is.
#pragma once

#include "base/verb_process.h"
#include "window/ui/findings.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <vector>

namespace glint {

class VerbWork {
public:
    // Runs `glint WORDS…`, instead of what may still run. Throws std::runtime_error.
    void start(std::vector<std::string> words);

    void cancel();  // what is known stays
    void clear();   // and is forgotten

    // Follows the process; does not wait. `hear` gets each line that is JSON; others are passed
    // over. What it says on stderr when it fails becomes the fact's problem. True when something is
    // new.
    bool update(const std::function<void(const nlohmann::ordered_json& line)>& hear);

    // What its problem calls one thing is called another: a copy of a file by the file's name.
    void rename(const std::string& from, const std::string& to);

    // Why it has found nothing, where it has not said so itself.
    void explain(const std::string& problem);

    const VerbProcess& process() const { return process_; }
    const WorkFact& fact() const { return fact_; }

private:
    VerbProcess process_;
    WorkFact fact_;
};

}  // namespace glint
