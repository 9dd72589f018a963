// `glint check` finds what was planted (planted_faults.h,
// outside_faults.h), and nothing in the sound twins.
#include "honest_scenes.h"
#include "outside_faults.h"
#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

namespace glint::cli {
namespace {

using Json = nlohmann::json;

class PlantedFaults : public InAFolder {
protected:
    std::string written(const std::string& name, const std::string& text) const {
        std::string file = name + ".frag";
        std::ranges::replace(file, '/', '-');
        write(file, text);
        return file;
    }

    // "CASE: NOTE" of each failure, by file.
    std::map<std::string, std::vector<std::string>> failures(
        std::vector<std::string> files, const std::vector<std::string>& more = {}) const {
        files.insert(files.begin(), "check");
        files.insert(files.end(), more.begin(), more.end());
        files.insert(files.end(), {"--json", "--size", "64x36", "-o", "pictures"});
        const Outcome outcome = glint(files);
        const Json report = Json::parse(outcome.out, nullptr, false);
        std::map<std::string, std::vector<std::string>> found;
        if (!report.is_object()) {
            ADD_FAILURE() << outcome.err;
            return found;
        }
        for (const Json& file : report["files"])
            if (file["code"] != 0) ADD_FAILURE() << file << outcome.err;
        for (const Json& c : report["cases"])
            if (c["verdict"] == "fail")
                found[c["scene"]].push_back(c["case"].get<std::string>() + ": " +
                                            c["note"].get<std::string>());
        return found;
    }

    // A twin that fails is a failure here, and a fault that passes.
    void look_at(const Planted& one, const std::vector<std::string>& more = {}) const {
        const std::string fault = written(one.name, one.fault);
        const std::string twin = written(one.name + "-twin", one.twin);
        const auto failed = failures({fault, twin}, more);
        for (const auto& [file, words] : failed)
            for (const std::string& why : words)
                std::cout << (file == twin ? "TWIN   " : "found  ") << one.name << ": " << why
                          << '\n';
        if (!failed.contains(fault)) std::cout << "MISSED " << one.name << '\n';
        EXPECT_TRUE(failed.contains(fault)) << one.name << ": " << one.fault;
        EXPECT_FALSE(failed.contains(twin)) << one.name << ": " << one.twin;
    }
};

// A row of the table each, of one kind. An effort, not seconds: a busy machine finds as much. Loops
// that use up their budget would take minutes in all other cases.
class AllPlantedFaults : public PlantedFaults, public testing::WithParamInterface<std::string> {};

TEST_P(AllPlantedFaults, AreFoundAndTheirTwinsPass) {
    const std::vector<std::string> effort = {"--effort", "1"};
    for (const Planted& one : all_planted_faults()) {
        if (!one.name.starts_with(GetParam() + "/")) continue;
        if (one.name.find("loop_") == std::string::npos) {
            look_at(one, effort);
        } else {
            look_at(one, {"--case", "loop budget"});
            EXPECT_EQ(failures({written(one.name + "-twin", one.twin)}, effort),
                      (decltype(failures({}))()));
        }
    }
    if (GetParam() != "honest") return;
    for (const auto& [name, text] : honest_scenes())
        EXPECT_EQ(failures({written(name, text)}), (decltype(failures({}))()));
}

std::set<std::string> kinds() {
    std::set<std::string> kinds = {"honest"};
    for (const Planted& one : all_planted_faults())
        kinds.insert(one.name.substr(0, one.name.find('/')));
    return kinds;
}
INSTANTIATE_TEST_SUITE_P(Kinds, AllPlantedFaults, testing::ValuesIn(kinds()),
                         [](const auto& kind) { return kind.param; });

Planted planted(const std::string& name) {
    for (const Planted& one : all_planted_faults())
        if (one.name == name) return one;
    ADD_FAILURE() << "no fault " << name;
    return {};
}

// One of each way of finding them.
TEST_F(PlantedFaults, OfEachWayAreFoundAndTheirTwinsPass) {
    const std::pair<const char*, const char*> ways[] = {{"corner/high_low", "search"},
                                                        {"ball/smaller", "search"},
                                                        {"hidden/max", "search"},
                                                        {"fetch/right", "search"},
                                                        {"fetch/level", "search"},
                                                        {"key/up", "keys"},
                                                        {"key/and_tweak", "search"},
                                                        {"growth/at_a_corner", "search"},
                                                        {"size/both_odd", "odd sizes"},
                                                        {"poison/stuck", "healed"},
                                                        {"poison/board_of_cells", "healed"},
                                                        {"growth/behind_a_guard", "search"},
                                                        {"sound/late", "sound"},
                                                        {"sound/loops", "sound"},
                                                        {"loop_budget/nested", "loop budget"},
                                                        {"strobe/of_time", "flashes"},
                                                        {"strobe/at_an_end", "flashes"},
                                                        {"frame_rate/step", "frame rates"}};
    for (const auto& [name, only] : ways) look_at(planted(name), {"--case", only});
}

// A long text is not compiled with all that its tweaks may ask for: the preset's values alone
// count.
TEST_F(PlantedFaults, TheLoopBudgetOfALongTextIsThatOfItsPreset) {
    const auto scene = [&](int turns) {
        return fmt::format(
                   "uniform int turns; //@ {} [1, 70000]\n"
                   "void mainImage(out vec4 c, in vec2 p) {{\n"
                   "    float s = 0.0;\n"
                   "    for (int i = 0; i < turns; i++) s += 1e-5 * fract(p.x * float(i));\n"
                   "    c = vec4(s);\n"
                   "}}\n",
                   turns) +
               std::string(20'000, '/') + "\n";
    };
    look_at({"loop_budget/of_a_long_text", scene(70'000), scene(100)}, {"--case", "loop budget"});
}

// No pixel takes more than 40,100 turns, but eight neighbours share theirs.
TEST_F(PlantedFaults, TheLoopBudgetIsSharedByNeighbours) {
    const auto scene = [&](int turns) {
        return fmt::format(
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    float s = 0.0;\n"
            "    bool odd = (int(p.x) & 1) == 1;\n"
            "    for (int i = 0; i < 100; i++) {{\n"
            "        for (int k = 0; k < (odd ? {0} : 0); k++) s += 2e-5 * fract(0.7 * float(k));\n"
            "        for (int k = 0; k < (odd ? 0 : {0}); k++) s += 2e-5 * fract(0.3 * float(k));\n"
            "    }}\n"
            "    c = vec4(s);\n"
            "}}\n",
            turns);
    };
    look_at({"loop_budget/of_neighbours", scene(400), scene(20)}, {"--case", "loop budget"});
}

// What is added to a clock of a day is lost, and the loop never ends.
TEST_F(PlantedFaults, ALoopThatALateClockKeepsFromItsEndUsesItsBudgetUp) {
    const auto scene = [](const char* from, const char* to, const char* at) {
        return fmt::format(
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    float s = 0.0;\n"
            "    for (float x = {}; x < {}; x += 0.002) s += 1e-3 * sin(9.0 * ({}) + p.x);\n"
            "    c = vec4(0.5 + s);\n"
            "}}\n",
            from, to, at);
    };
    const Planted sticks{"loop_budget/of_a_day", scene("iTime", "iTime + 1.0", "x"),
                         scene("0.0", "1.0", "iTime + x")};
    look_at(sticks, {"--case", "loop budget"});
    const auto longer = [](const char* from, const char* to) {
        return fmt::format(
            "void mainImage(out vec4 c, in vec2 p) {{\n    float s = 0.0;\n"
            "    for (float x = {}; x < {}; x += 0.02) s += 1e-3 * sin(x - iTime + p.x);\n"
            "    c = vec4(0.5 + s);\n}}\n",
            from, to);
    };
    look_at({"loop_budget/of_a_month", longer("iTime", "iTime + 1.0"), longer("0.0", "1.0")},
            {"--case", "loop budget"});
    const std::string file = written("late", sticks.fault);
    const Json found =
        report_of(glint({"check", file, "--json", "--size", "32x18", "--case", "loop budget"}),
                  6)["cases"][0];
    const std::string note = found["note"];
    EXPECT_NE(note.find("at time 8.64e+04: a float of that age"), note.npos) << note;
}

// A preset that opens so late is no reason of its own.
TEST_F(PlantedFaults, ALoopThatIsTooLongAtAnyClockIsNotBlamedOnALateOne) {
    write("long.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float s = 0.0;\n"
          "    for (int i = 0; i < 70000; i++) s += 1e-6 * fract(p.x * float(i) + iTime);\n"
          "    c = vec4(s);\n"
          "}\n");
    write("long.toml", "scene = \"long.frag\"\ntime = 100000\n");
    const Json found = report_of(
        glint({"check", "long.toml", "--json", "--size", "32x18", "--case", "loop budget"}),
        6)["cases"][0];
    const std::string note = found["note"];
    EXPECT_NE(note.find("split the work over passes"), note.npos) << note;
    EXPECT_EQ(note.find("of that age"), note.npos) << note;
}

TEST_F(PlantedFaults, AreLedBackToTheFewestTweaksAndTheirOperation) {
    const std::string file = written("fault", planted("corner/high_low_high").fault);
    const Outcome outcome =
        glint({"check", file, "--json", "--size", "32x18", "--effort", "1", "--case", "search"});
    const Json found = report_of(outcome, 6)["cases"][0];
    EXPECT_EQ(found["where"]["line"], 7) << found;
    EXPECT_EQ(found["where"]["function"], "mainImage");
    EXPECT_EQ(found["where"]["expression"], "sqrt(x)");
    EXPECT_LT(found["where"]["operands"][0].get<double>(), 0.0);
    const std::string again = found["reproduce"];
    EXPECT_TRUE(again.starts_with("glint still ")) << again;
    for (const char* tweak : {"--tweak a=", "--tweak b=", "--tweak d="})
        EXPECT_NE(again.find(tweak), std::string::npos) << again;
    // The same points and verdicts again.
    const Outcome second =
        glint({"check", file, "--json", "--size", "32x18", "--effort", "1", "--case", "search"});
    EXPECT_EQ(report_of(second, 6)["cases"], report_of(outcome, 6)["cases"]);
}

TEST_F(PlantedFaults, HonestScenesPassTheSearch) {
    for (const auto& [name, text] : honest_scenes())
        EXPECT_EQ(failures({written(name, text)}, {"--case", "search"}),
                  (decltype(failures({}))()));
}

}  // namespace
}  // namespace glint::cli
