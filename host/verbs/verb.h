// A verb of the command line: its options, and what it does with them. One file a verb; those that
// only the window calls share one.
#pragma once

#include "offline/common.h"

#include <memory>

namespace CLI {
class App;
}

namespace glint {

class Verb {
public:
    virtual ~Verb() = default;
    // Declares the options on its part of the command line, which must not outlive this.
    virtual void declare(CLI::App& app) = 0;
    // With the options that were parsed. `since_start` runs since the program began. Throws Stop,
    // UsageError, NoContext, ContextLost, or any std::exception with a whole sentence.
    virtual void run(const Stopwatch& since_start) = 0;
};

// A verb whose options are one struct.
template <class Options>
class VerbWith : public Verb {
public:
    using Declare = void (*)(CLI::App&, Options&);
    using Run = void (*)(const Options&, const Stopwatch& since_start);
    VerbWith(Declare declares, Run runs) : declare_(declares), run_(runs) {}
    void declare(CLI::App& app) override { declare_(app, options_); }
    void run(const Stopwatch& since_start) override { run_(options_, since_start); }

private:
    Options options_;
    Declare declare_;
    Run run_;
};

template <class Options>
std::unique_ptr<Verb> make_verb(typename VerbWith<Options>::Declare declare,
                                typename VerbWith<Options>::Run run) {
    return std::make_unique<VerbWith<Options>>(declare, run);
}

std::unique_ptr<Verb> bench_verb();
std::unique_ptr<Verb> check_verb();
std::unique_ptr<Verb> complete_verb();
std::unique_ptr<Verb> export_verb();
std::unique_ptr<Verb> import_verb();
std::unique_ptr<Verb> info_verb();
std::unique_ptr<Verb> manual_verb();
std::unique_ptr<Verb> new_verb();
std::unique_ptr<Verb> open_verb();
std::unique_ptr<Verb> probe_verb();
std::unique_ptr<Verb> refine_verb();
std::unique_ptr<Verb> sketch_verb();
std::unique_ptr<Verb> probing_verb();
std::unique_ptr<Verb> sequence_verb();
std::unique_ptr<Verb> sound_verb();
std::unique_ptr<Verb> still_verb();
std::unique_ptr<Verb> study_verb();
std::unique_ptr<Verb> trial_verb();
std::unique_ptr<Verb> voice_verb();

}  // namespace glint
