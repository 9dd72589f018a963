// `glint complete`: what may stand next on a command line. The shells' scripts in host/shell/ ask
// it, and know nothing themselves. Hidden, for no person types it.
//
// It prints a word a line, behind a tab what it means; a word that ends with = goes on. A line
// `:files .png .exr` asks the shell for its own files of these endings, `:files` for all of them,
// `:folders` for folders.
#include "base/say.h"
#include "scene/preset.h"
#include "verbs/options.h"
#include "verbs/tree.h"
#include "verbs/verb.h"

#include <algorithm>
#include <regex>

namespace glint {
namespace {

// A line that is being typed, read as far as it goes.
struct Typed {
    CLI::App* verb = nullptr;
    std::vector<std::string> arguments;  // that are no options
    CLI::Option* waits = nullptr;        // the option whose value comes next
    std::string before;                  // what stands before the unfinished word, in that word
    std::string word;                    // the unfinished one
};

CLI::App* verb_named(CLI::App& root, const std::string& name) {
    for (CLI::App* verb : listed_verbs(root))
        if (verb->get_name() == name) return verb;
    return nullptr;
}

CLI::Option* option_named(CLI::App& verb, const std::string& name) {
    for (CLI::Option* option : listed_options(verb))
        if (std::ranges::count(names_of(*option), name) != 0) return option;
    return nullptr;
}

Typed read_line(CLI::App& root, std::vector<std::string> words) {
    Typed typed;
    typed.word = words.back();
    words.pop_back();
    if (words.empty()) return typed;
    typed.verb = verb_named(root, words.front());
    if (typed.verb)
        words.erase(words.begin());
    else
        typed.verb = verb_named(root, "open");
    if (!typed.verb) return typed;
    for (const std::string& word : words) {
        if (typed.waits) {
            typed.waits = nullptr;
        } else if (CLI::Option* option = option_named(*typed.verb, word)) {
            if (option->get_items_expected_max() > 0) typed.waits = option;
        } else if (!word.starts_with('-')) {
            typed.arguments.push_back(word);
        }
    }
    const std::size_t equals = typed.word.find('=');
    if (!typed.waits && typed.word.starts_with("--") && equals != std::string::npos) {
        typed.waits = option_named(*typed.verb, typed.word.substr(0, equals));
        typed.before = typed.word.substr(0, equals + 1);
        typed.word.erase(0, equals + 1);
    }
    return typed;
}

class Answer {
public:
    explicit Answer(const Typed& typed) : typed_(typed) {}

    void offer(const std::string& word, const std::string& meaning = {}) const {
        if (!word.starts_with(typed_.word)) return;
        const std::string line = meaning.substr(0, meaning.find('\n'));
        say_result("{}{}{}{}\n", typed_.before, word, line.empty() ? "" : "\t", line);
    }

    void offer_options() const {
        for (const CLI::Option* option : listed_options(*typed_.verb))
            for (const std::string& name : names_of(*option))
                offer(name, option->get_description());
    }

    void offer_verbs(CLI::App& root) const {
        for (const CLI::App* verb : listed_verbs(root))
            offer(verb->get_name(), verb->get_description());
    }

    // What an option or an argument takes.
    void offer_values(CLI::Option& of) const {
        const std::string kind = of.get_type_name();
        if (kind == kFile) return offer_files(of.get_description());
        if (kind == kFolder) return say_result(":folders\n");
        if (kind == kTweak || kind == kVaried) return offer_tweaks(kind == kVaried);
        if (kind == kPass) return offer_passes();
        if (of.get_name() == "--quality") offer_qualities();
        for (const std::string& word : menu_of(of)) offer(word);
    }

private:
    static void offer_files(const std::string& description) {
        static const std::regex ending("\\.[a-z][a-z0-9]*");
        std::string line = ":files";
        for (std::sregex_iterator at(description.begin(), description.end(), ending), end;
             at != end; ++at)
            line += " " + at->str();
        say_result("{}\n", line);
    }

    // Of the scene that the line names; nothing where it is broken, or not named yet.
    std::optional<Preset> preset() const {
        if (typed_.arguments.empty()) return {};
        return read_preset(typed_.arguments.back()).preset;
    }

    void offer_passes() const {
        const std::optional<Preset> opened = preset();
        if (!opened) return;
        offer("image");
        for (const Pass& pass : opened->scene.passes) offer(pass.name);
    }

    void offer_qualities() const {
        const std::optional<Preset> opened = preset();
        if (!opened) return;
        for (const QualitySet& quality : opened->qualities) offer(quality.name);
    }

    void offer_tweaks(bool varied) const {
        const std::optional<Preset> opened = preset();
        if (!opened) return;
        const std::string name = typed_.word.substr(0, typed_.word.find('='));
        for (const Tweak& tweak : opened->scene.tweaks) {
            if (name.size() == typed_.word.size())
                offer(tweak.name + (varied && tweak.quality ? "" : "="), tweak.description);
            else if (tweak.name == name)
                offer_tweak_values(tweak, varied);
        }
    }

    // Several stand with commas between them.
    void offer_tweak_values(const Tweak& tweak, bool varied) const {
        const std::size_t last = typed_.word.find_last_of(varied ? "=," : "=");
        const std::string before = typed_.word.substr(0, last + 1);
        std::vector<std::string> values = tweak.names;
        if (tweak.type == TweakType::bool1) values = {"on", "off"};
        for (const std::string& value : values) offer(before + value);
    }

    const Typed& typed_;
};

void complete(CLI::App& root, std::vector<std::string> words) {
    if (words.empty()) words.emplace_back();
    Typed typed = read_line(root, words);
    const bool first = !typed.verb;
    if (first) typed.verb = verb_named(root, "open");
    const Answer answer(typed);
    if (typed.waits) return answer.offer_values(*typed.waits);
    if (first) {
        answer.offer_verbs(root);
        Typed at_root = typed;
        at_root.verb = &root;
        if (typed.word.starts_with('-')) return Answer(at_root).offer_options();
    }
    if (!typed.verb) return;
    if (typed.word.starts_with('-')) return answer.offer_options();
    const std::vector<CLI::Option*> arguments = listed_arguments(*typed.verb);
    const bool several = !arguments.empty() && arguments.back()->get_items_expected_max() > 1;
    if (typed.arguments.size() >= arguments.size() && !several) return answer.offer_options();
    answer.offer_values(*arguments[std::min(typed.arguments.size(), arguments.size() - 1)]);
}

class CompleteVerb : public Verb {
public:
    void declare(CLI::App& app) override {
        root_ = app.get_parent();
        app.add_option("words", words_, "behind --: the line as far as it is typed, without glint");
    }
    void run(const Stopwatch&) override { complete(*root_, words_); }

private:
    CLI::App* root_ = nullptr;
    std::vector<std::string> words_;
};

}  // namespace

std::unique_ptr<Verb> complete_verb() {
    return std::make_unique<CompleteVerb>();
}

}  // namespace glint
