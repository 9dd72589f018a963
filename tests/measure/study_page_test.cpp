// The page of a study, beside its table.
#include "../base/test_folder.h"
#include "glsl/raw_text.h"
#include "measure/study/page.h"
#include "measure/study/result.h"

#include <gtest/gtest.h>

namespace glint::study_page_test {
namespace {

// Its table, and the text of its page.
struct Told {
    std::string table, page;
};

Told told(double order, bool converges) {
    Study study{.scene = "s.frag", .knob = "n", .reference = "64"};
    study.order = order;
    study.converges = converges;
    study.rows = {{.value = "8", .error = Difference{.rmse = 0.1}}};
    const TestFolder folder;
    write_page(folder.path(), {&study, 1});
    std::string why_not;
    return {to_table(study), read_bytes(folder.path() / "index.html", why_not).value_or("")};
}

bool has(const std::string& text, const char* part) {
    return text.find(part) != text.npos;
}

TEST(StudyPage, TellsNoOrderThatTheTableDoesNotTell) {
    const Told falls = told(0.94, true), stays = told(0.02, true);
    EXPECT_TRUE(has(falls.table, "order 0.94"));
    EXPECT_TRUE(has(falls.page, "Observed order: error ~ work<sup>-0.94</sup>"));
    EXPECT_TRUE(has(falls.page, "<td>0.94<td>")) << "among all studies";
    EXPECT_FALSE(has(stays.table, "\norder"));
    EXPECT_FALSE(has(stays.page, "Observed order"));
    EXPECT_FALSE(has(stays.page, "<td>0.02<td>"));
}

TEST(StudyPage, MarksTheRowsOfWhatDoesNotConverge) {
    EXPECT_FALSE(has(told(0.94, true).page, "<td class=text>!"));
    EXPECT_TRUE(has(told(0.94, false).page, "<td class=text>!"));
}

}  // namespace
}  // namespace glint::study_page_test
