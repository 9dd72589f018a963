// `glint new`: scenes to begin with.
#include "command.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace glint::cli::new_test {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kTemplates = {"shadertoy", "raymarch", "feedback", "simulation",
                                             "sound"};

class New : public InAFolder {
protected:
    Outcome make(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "new");
        Command command = this->command(std::move(arguments));
        command.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
        return run(command);
    }
};

TEST_F(New, EverySceneIsWrittenCompilesWithoutAWordAndHasASlider) {
    for (const std::string& name : kTemplates) {
        SCOPED_TRACE(name);
        const Outcome outcome = make({name, "--from", name, "--no-open"});
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.out, name + ".frag\n");
        EXPECT_NE(outcome.err.find(" still " + name + ".frag"), std::string::npos) << outcome.err;
        EXPECT_EQ(bytes(name + ".frag"),
                  bytes_of(fs::path(GLINT_REPOSITORY) / "fragments/new" / (name + ".frag")));
        const Outcome info = glint({"info", name + ".frag", "--json"});
        EXPECT_EQ(info.err, "");
        const Json json = Json::parse(info.out, nullptr, false);
        ASSERT_TRUE(json.is_object()) << info.out;
        std::size_t sliders = 0;
        for (const Json& tweak : json["tweaks"]) sliders += tweak["min"].is_number() ? 1 : 0;
        EXPECT_GE(sliders, 1u);
        EXPECT_TRUE(json["left_out"].empty() || json["stateful"]) << json["left_out"];
        EXPECT_EQ(json["sound"], name == "sound");
        EXPECT_EQ(json["stateful"], name == "feedback" || name == "simulation");
    }
}

TEST_F(New, WhatToDoNextIsSpelledForAShell) {
    const Outcome spaced = make({"sp ace", "--no-open"});
    EXPECT_NE(spaced.err.find(" still 'sp ace.frag' -o 'sp ace.png'\n"), std::string::npos)
        << spaced.err;
    const Outcome dashed = make({"--no-open", "--", "-x"});
    EXPECT_NE(dashed.err.find(" still ./-x.frag -o ./-x.png\n"), std::string::npos) << dashed.err;
}

// Whoever reads one of them meets no word of an annotation that it does not explain.
TEST_F(New, EveryWordOfAnAnnotationIsExplainedInAComment) {
    const std::vector<std::string> words = {"log",  "unit",  "quality", "pass",
                                            "size", "step=", "wrap"};
    for (const std::string& name : kTemplates) {
        SCOPED_TRACE(name);
        std::istringstream lines(
            bytes_of(fs::path(GLINT_REPOSITORY) / "fragments/new" / (name + ".frag")));
        std::string annotations, comments;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("uniform")) annotations += line.substr(line.find("//@")) + "\n";
            if (line.starts_with("//")) comments += line + "\n";
        }
        for (const std::string& word : words) {
            const bool is_used = annotations.find(" " + word) != std::string::npos;
            EXPECT_TRUE(!is_used || comments.find("`" + word) != std::string::npos) << word;
        }
        EXPECT_NE(comments.find("begins with //@"), std::string::npos);
    }
}

TEST_F(New, WhatIsThereStays) {
    write("rings.frag", "mine");
    fs::create_symlink("nowhere", folder() / "link.frag");
    for (const char* name : {"rings", "rings.frag", "link", "./rings"}) {
        const Outcome outcome = make({name});
        EXPECT_EQ(outcome.code, 1) << name;
        EXPECT_NE(outcome.err.find("there already"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(bytes("rings.frag"), "mine");
    EXPECT_EQ(names(), (std::set<std::string>{"rings.frag", "link.frag"}));
}

TEST_F(New, TheNameMayBeAPathAndEndsWithFragOnce) {
    fs::create_directory(folder() / "deep");
    EXPECT_EQ(make({"deep/a"}).code, 0);
    EXPECT_EQ(make({"deep/b.frag"}).code, 0);
    EXPECT_EQ(make({"v1.5"}).code, 0);
    EXPECT_TRUE(fs::exists(folder() / "deep/a.frag") && fs::exists(folder() / "deep/b.frag") &&
                fs::exists(folder() / "v1.5.frag"));
    EXPECT_EQ(make({"gone/a"}).code, 1);
    EXPECT_EQ(make({"deep/"}).code, 2);
    EXPECT_EQ(make({}).code, 2);
}

}  // namespace
}  // namespace glint::cli::new_test
