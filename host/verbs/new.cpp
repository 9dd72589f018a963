// `glint new`: a commented scene to begin with, open in the window.
#include "base/say.h"
#include "base/words.h"
#include "offline/new_scene.h"
#include "verbs/options.h"
#include "verbs/show.h"
#include "verbs/verb.h"

namespace glint {
namespace {

struct NewOptions {
    std::filesystem::path name;
    std::string from{scene_templates().front().name};
    bool opens = true;
};

void run_new(const NewOptions& options, const Stopwatch&) {
    const std::filesystem::path scene = write_new_scene(options.name, options.from);
    say_result("{}\n", scene.string());
    flush_results();
    ViewOptions view;
    view.file = scene;
    if (options.opens && show_in_window(view)) return;
    const std::string glint = own_name(), name = shell_file(scene.string());
    say("Written. What to do next:\n"
        "  {0} {1}            # open it in the window, and edit it in an editor\n"
        "  {0} still {1} -o {2}\n"
        "  {0} check {1}\n",
        glint, name, shell_file(scene.stem().string() + ".png"));
}

void declare(CLI::App& verb, NewOptions& options) {
    std::vector<std::string> names;
    for (const SceneTemplate& each : scene_templates()) names.emplace_back(each.name);
    verb.add_option("name", options.name, "the file, such as rings or scenes/rings.frag")
        ->type_name(kFile)
        ->required();
    verb.add_option("--from", options.from, "what it begins with; " + options.from + " otherwise")
        ->check(one_of(names));
    add_off_switch(verb, "--no-open", options.opens, "write the file, and open no window");
    add_examples(verb, {"glint new rings", "glint new pond.frag --from simulation --no-open"});
}

}  // namespace

std::unique_ptr<Verb> new_verb() {
    return make_verb<NewOptions>(declare, run_new);
}

}  // namespace glint
