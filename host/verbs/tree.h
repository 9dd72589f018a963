// The command line as a tree of verbs and options, for those who tell of it in other words than
// --help: manuals, and the shells' completion. CLI11 has it whole, and it is told nowhere else.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace glint {

// The verbs that --help lists, in its order.
std::vector<CLI::App*> listed_verbs(CLI::App& root);

// The options or the positional arguments that --help lists, in its order.
std::vector<CLI::Option*> listed_options(CLI::App& verb);
std::vector<CLI::Option*> listed_arguments(CLI::App& verb);

// "-o", "--output": all names of an option, the short ones first.
std::vector<std::string> names_of(const CLI::Option& option);

// The words of one_of(); empty where the option takes others.
std::vector<std::string> menu_of(CLI::Option& option);

// The command lines that stand below a verb's --help.
std::vector<std::string> examples_of(const CLI::App& verb);

}  // namespace glint
