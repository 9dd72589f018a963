#include "verbs/tree.h"

#include "verbs/options.h"

#include <sstream>

namespace glint {
namespace {

std::vector<CLI::Option*> listed(CLI::App& verb, bool positional) {
    return verb.get_options([&](const CLI::Option* option) {
        return !option->get_group().empty() && option->get_positional() == positional;
    });
}

}  // namespace

std::vector<CLI::App*> listed_verbs(CLI::App& root) {
    return root.get_subcommands([](CLI::App* verb) { return !verb->get_group().empty(); });
}

std::vector<CLI::Option*> listed_options(CLI::App& verb) {
    return listed(verb, false);
}

std::vector<CLI::Option*> listed_arguments(CLI::App& verb) {
    return listed(verb, true);
}

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> menu_of(CLI::Option& option) {
    std::string words;
    try {
        words = option.get_validator(kMenu)->get_description();
    } catch (const CLI::OptionNotFound&) {
        return {};
    }
    return CLI::detail::split(CLI::detail::find_and_replace(words, ", ", ","), ',');
}

std::vector<std::string> examples_of(const CLI::App& verb) {
    std::vector<std::string> lines;
    std::istringstream footer(verb.get_footer());
    for (std::string line; std::getline(footer, line);)
        if (line.starts_with("  ")) lines.push_back(line.substr(2));
    return lines;
}

}  // namespace glint
