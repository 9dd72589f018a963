// `glint study`: error against run time.
#include "measure/study/study.h"

#include "verbs/options.h"
#include "verbs/verb.h"

namespace glint {
namespace {

// What all quality tweaks are chosen by together.
void declare_budget(CLI::App& verb, StudyOptions& study) {
    CLI::Option* ms = verb.add_option("--ms", study.ms_budget,
                                      "find the best joint setting of all quality tweaks within so "
                                      "many milliseconds a frame; or own: what the preset takes");
    CLI::Option* rmse = verb.add_option("--rmse", study.rmse_budget,
                                        "find the fastest with at most this error, or own")
                            ->excludes(ms);
    verb.add_option("--flip", study.flip_budget,
                    "find the fastest with at most this FLIP, or own: the difference that a person "
                    "sees, from 0 to 1")
        ->excludes(ms)
        ->excludes(rmse);
    verb.add_option("--name", study.name,
                    "what the setting that is found is called in the preset of -o; best otherwise");
}

void declare(CLI::App& verb, StudyOptions& study) {
    add_views(
        verb, study.files, study.view, "pixels; 640x360 otherwise",
        "presets (.toml), scenes (.frag), or Shadertoys (.json), whose tweaks are studied; two "
        "of them, or pictures (.png, .exr, .jpg, .tif, .hdr), are compared");
    verb.add_flag("--each", study.each, "study the tweaks of two files, too, instead of comparing");
    add_off_switch(verb, "--no-specialise", study.view.specialise,
                   "feed tweaks as uniforms instead of writing them in as constants");
    verb.add_option("--vary", study.vary,
                    "name, name=a,b,c or name=a,...,z: instead of all quality tweaks")
        ->type_name(kVaried)
        ->allow_extra_args(false);
    verb.add_option("--reference", study.reference, "what counts as the truth")
        ->type_name(kTweak)
        ->allow_extra_args(false);
    verb.add_option("--second", study.second, "what to measure the reference by")
        ->type_name(kTweak)
        ->allow_extra_args(false);
    verb.add_option_function<std::string>(
            "--metric", [&study](const std::string& word) { study.time_only = word == "time"; },
            "error against time, or time alone: cost over size")
        ->check(one_of({"error", "time"}));
    verb.add_option("--pass", study.pass, "compare this buffer instead of the picture")
        ->type_name(kPass);
    verb.add_option("--frames", study.frames, "timed frames a row, at least")
        ->check(from(15, 100'000));
    verb.add_option("--seconds", study.seconds,
                    "of timing a tweak, after which no verdict is waited for")
        ->check(from(0.0, 1e6));
    verb.add_option("--over", study.over,
                    "presets: errors over all of the scene's; or time=A:B:STEP: over these");
    declare_budget(verb, study);
    verb.add_option(
            "-o,--output", study.output,
            "a folder for the report; a preset (.toml) for what --ms, --rmse or --flip finds")
        ->type_name(kFolder);
    CLI::Option* csv = verb.add_flag("--csv", study.csv, "comma-separated values on stdout");
    CLI::Option* json =
        verb.add_flag("--json", study.view.json, "one JSON object on stdout")->excludes(csv);
    verb.add_flag("--lines", study.lines, "a JSON object a line, whenever a picture is drawn")
        ->excludes(csv)
        ->excludes(json);
    add_examples(verb,
                 {"glint study presets/christmas.toml -o report",
                  "glint study presets/magic.toml --ms 8 --size 320x180 -o fast.toml",
                  "glint study presets/caustics.toml --vary shaftSamples=4,...,64 --size 320x180",
                  "glint study presets/boat.toml presets/boat-sunset.toml -o looks"});
}

}  // namespace

std::unique_ptr<Verb> study_verb() {
    return make_verb<StudyOptions>(
        declare, [](const StudyOptions& options, const Stopwatch&) { run_study(options); });
}

}  // namespace glint
