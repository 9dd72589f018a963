// `glint manual`: the pages of `man`, glint.1 and one a verb, into a folder. The build asks for
// them. Hidden, for no person needs them twice.
#include "offline/common.h"
#include "verbs/commit.h"
#include "verbs/tree.h"
#include "verbs/verb.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace glint {
namespace {

// Text that roff prints as it stands.
std::string plain(std::string_view text) {
    std::string line;
    for (const char c : text) {
        if (line.empty() && (c == '.' || c == '\'')) line += "\\&";
        if (c == '\\')
            line += "\\e";
        else if (c == '-')
            line += "\\-";
        else if (c == '`' || c == '\'')
            line += c == '`' ? "\\(ga" : "\\(aq";
        else
            line += c;
    }
    return line;
}

std::string bold(std::string_view text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string slanted(std::string_view text) {
    return "\\fI" + plain(text) + "\\fR";
}

// "FILE"; of a menu its words, and of a number its bounds.
std::string value_of(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return {};
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    if (colon == std::string::npos) return " " + slanted(type);
    return fmt::format(" {} ({})", slanted(type.substr(0, colon)), plain(type.substr(colon + 1)));
}

std::string entry(const std::string& head, const std::string& description) {
    return fmt::format(".TP\n{}\n{}\n", head, plain(description));
}

std::string options(CLI::App& of) {
    std::string text = ".SH OPTIONS\n";
    for (const CLI::Option* argument : listed_arguments(of))
        text += entry(slanted(argument->get_name(true)), argument->get_description());
    for (const CLI::Option* option : listed_options(of)) {
        std::string head;
        for (const std::string& name : names_of(*option))
            head += (head.empty() ? "" : ", ") + bold(name);
        text += entry(head + value_of(*option), option->get_description());
    }
    return text;
}

std::string synopsis(CLI::App& verb) {
    std::string line = bold("glint " + verb.get_name());
    for (const CLI::Option* argument : listed_arguments(verb)) {
        const std::string name = slanted(argument->get_name(true)) +
                                 (argument->get_items_expected_max() > 1 ? " ..." : "");
        line += argument->get_required() ? " " + name : " [" + name + "]";
    }
    for (const CLI::Option* option : listed_options(verb))
        if (option->get_required())
            line += " " + bold(names_of(*option).front()) + value_of(*option);
    return line + " [" + slanted("option") + " ...]";
}

std::string examples(const CLI::App& of) {
    std::string text = ".SH EXAMPLES\n.EX\n";
    for (const std::string& line : examples_of(of)) text += plain(line) + "\n";
    return text + ".EE\n";
}

std::string exit_status() {
    std::string text = ".SH EXIT STATUS\n";
    for (const ExitMeaning& exit : kExitMeanings)
        text += entry(bold(std::to_string(exit.code)), exit.meaning);
    return text;
}

std::string head(const std::string& name, const std::string& what, const std::string& line) {
    std::string title = name;
    for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return fmt::format(
        ".TH {} 1 {} \"glint {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}\n",
        title, kCommitDate, GLINT_VERSION, name, plain(what), line);
}

std::string page_name(const CLI::App& verb) {
    return "glint-" + verb.get_name();
}

std::string verb_page(CLI::App& verb) {
    return head(page_name(verb), verb.get_description(), synopsis(verb)) + options(verb) +
           exit_status() + examples(verb) + ".SH SEE ALSO\n.BR glint (1)\n";
}

// "glint: what it is. A sentence more."
std::string root_page(CLI::App& root) {
    const std::string description = root.get_description();
    const std::size_t colon = description.find(": "), stop = description.find(". ");
    std::string text =
        head("glint", description.substr(colon + 2, stop - colon - 2),
             fmt::format("{} [{}]\n.br\n{} {} [{} ...]", bold("glint"), slanted("file"),
                         bold("glint"), slanted("verb"), slanted("option")));
    text += fmt::format(".SH DESCRIPTION\n{}\n.SH VERBS\n", plain(description.substr(stop + 2)));
    std::string others = ".SH SEE ALSO\n";
    const std::vector<CLI::App*> verbs = listed_verbs(root);
    for (const CLI::App* verb : verbs) {
        text += entry(bold(page_name(*verb)) + "(1)", verb->get_description());
        others += fmt::format(".BR {} (1){}\n", page_name(*verb), verb == verbs.back() ? "" : ",");
    }
    return text + options(root) + exit_status() + examples(root) + others;
}

void write_page(const std::filesystem::path& folder, const std::string& name,
                const std::string& text) {
    const std::filesystem::path file = folder / (name + ".1");
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(fmt::format("Cannot write {}.", file.string()));
}

class ManualVerb : public Verb {
public:
    void declare(CLI::App& app) override {
        root_ = app.get_parent();
        app.add_option("folder", folder_, "made where it is missing")->required();
    }
    void run(const Stopwatch&) override {
        std::filesystem::create_directories(folder_);
        write_page(folder_, "glint", root_page(*root_));
        for (CLI::App* verb : listed_verbs(*root_))
            write_page(folder_, page_name(*verb), verb_page(*verb));
    }

private:
    CLI::App* root_ = nullptr;
    std::filesystem::path folder_;
};

}  // namespace

std::unique_ptr<Verb> manual_verb() {
    return std::make_unique<ManualVerb>();
}

}  // namespace glint
