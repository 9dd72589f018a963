#include "measure/check/junit.h"

#include "base/markup.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

struct Counts {
    std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
    double seconds = 0.0;
};

bool could_not_be_checked(const CheckedFile& file) {
    return file.code != ExitCode::done;
}

Counts counts_of(const CheckedFile& file) {
    const auto count = [&](CaseVerdict verdict) {
        return static_cast<std::size_t>(
            std::ranges::count(file.cases, verdict, &CaseResult::verdict));
    };
    const std::size_t errors = could_not_be_checked(file) ? 1 : 0;
    return {.tests = file.cases.size() + errors,
            .failures = count(CaseVerdict::fail),
            .errors = errors,
            .skipped = count(CaseVerdict::skip),
            .seconds = file.seconds};
}

std::string attributes(const Counts& counts) {
    return fmt::format(R"(tests="{}" failures="{}" errors="{}" skipped="{}" time="{:.3f}")",
                       counts.tests, counts.failures, counts.errors, counts.skipped,
                       counts.seconds);
}

// What stands within the case.
std::string outcome(const CaseResult& result) {
    const std::string note = markup_escaped(result.note);
    switch (result.verdict) {
        case CaseVerdict::fail: {
            std::string text = note;
            if (!result.reproduce.empty()) text += "\nagain: " + markup_escaped(result.reproduce);
            if (!result.picture.empty()) text += "\npicture: " + markup_escaped(result.picture);
            return fmt::format("      <failure message=\"{}\">{}</failure>\n", note, text);
        }
        case CaseVerdict::skip:
            return fmt::format("      <skipped message=\"{}\"/>\n", note);
        case CaseVerdict::report:
        case CaseVerdict::pass:
            return note.empty() ? "" : fmt::format("      <system-out>{}</system-out>\n", note);
    }
    return {};
}

std::string suite(const CheckedFile& file) {
    const std::string name = markup_escaped(file.scene);
    std::string text =
        fmt::format("  <testsuite name=\"{}\" {}>\n", name, attributes(counts_of(file)));
    text += fmt::format("    <properties><property name=\"renderer\" value=\"{}\"/></properties>\n",
                        markup_escaped(file.renderer));
    for (const CaseResult& result : file.cases) {
        const std::string inside = outcome(result);
        text += fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}\n", name,
                            markup_escaped(result.name),
                            inside.empty() ? "/>" : ">\n" + inside + "    </testcase>");
    }
    if (could_not_be_checked(file))
        text += fmt::format(
            "    <testcase classname=\"{}\" name=\"start\">\n      <error message=\"It could not "
            "be "
            "checked: exit code {}\"/>\n    </testcase>\n",
            name, static_cast<int>(file.code));
    return text + "  </testsuite>\n";
}

}  // namespace

std::string junit_xml(std::span<const CheckedFile> files) {
    Counts all;
    std::string suites;
    for (const CheckedFile& file : files) {
        const Counts counts = counts_of(file);
        all.tests += counts.tests;
        all.failures += counts.failures;
        all.errors += counts.errors;
        all.skipped += counts.skipped;
        all.seconds += counts.seconds;
        suites += suite(file);
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"glint check\" "
        "{}>\n{}</testsuites>\n",
        attributes(all), suites);
}

}  // namespace glint
