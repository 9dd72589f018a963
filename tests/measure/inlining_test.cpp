// Copies of functions, counted by hand.
#include "measure/inlining.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace glint::inlining_test {
namespace {

const std::string kHead =
    "#version 300 es\nprecision highp float;\nuniform float a;\nuniform sampler2D s;\n"
    "layout(location = 0) out vec4 colour;\n"
    "float leaf(float x) { return sin(x) + a * texture(s, vec2(x)).r; }\n"
    "float branch(float x) { return leaf(x) + leaf(2.0 * x); }\n";

class Inlining : public testing::Test {
protected:
    void SetUp() override {
        const bool found = std::system(
                               "glslangValidator --version >/dev/null 2>&1 && "
                               "spirv-opt --version >/dev/null 2>&1") == 0;
        if (!found) GTEST_SKIP() << "no glslangValidator or spirv-opt";
    }

    static ProgramSize size_of(const std::string& main) {
        std::string why_not;
        const auto size = program_size(kHead + main, why_not);
        EXPECT_TRUE(size) << why_not;
        return size.value_or(ProgramSize{});
    }
    static InlinedFunction named(const ProgramSize& size, const std::string& name) {
        for (const InlinedFunction& function : size.functions)
            if (function.name == name) return function;
        return {};
    }
};

TEST_F(Inlining, CopiesMultiplyAlongTheCalls) {
    const ProgramSize size =
        size_of("void main() { colour = vec4(branch(1.0) + branch(2.0), leaf(3.0), 0, 1); }\n");
    EXPECT_EQ(named(size, "leaf").copies, 5u);
    EXPECT_EQ(named(size, "branch").copies, 2u);
    EXPECT_GT(named(size, "branch").words, 2 * named(size, "leaf").words);
    EXPECT_EQ(size.functions.front().name, "leaf");
    EXPECT_GT(size.words, 5 * named(size, "leaf").words);
}

TEST_F(Inlining, OneCallInALoopIsOneCopy) {
    const ProgramSize once = size_of("void main() { colour = vec4(leaf(1.0)); }\n");
    const ProgramSize loop = size_of(
        "void main() { float t = 0.0; for (int i = 0; i < 9; ++i) t += leaf(t); colour = vec4(t); "
        "}\n");
    EXPECT_EQ(named(once, "leaf").copies, 1u);
    EXPECT_EQ(named(loop, "leaf").copies, 1u);
    EXPECT_EQ(named(loop, "leaf").saved_by_one_call(), 0u);
    EXPECT_EQ(named(loop, "branch").copies, 0u) << "it is never called";
}

TEST_F(Inlining, WhatAConstantSwitchesOffDoesNotCount) {
    const ProgramSize off = size_of(
        "const int kind = 0;\n"
        "void main() { colour = vec4(leaf(1.0)); if (kind == 1) colour.g = branch(2.0); }\n");
    EXPECT_EQ(named(off, "leaf").copies, 1u);
    EXPECT_EQ(named(off, "branch").copies, 0u);
}

TEST_F(Inlining, WordsOfLaterLanguagesAreNamesHere) {
    const ProgramSize size = size_of(
        "void main() { float buffer = leaf(1.0), shared = 2.0; colour = vec4(buffer * shared); "
        "}\n");
    EXPECT_EQ(named(size, "leaf").copies, 1u);
}

TEST_F(Inlining, ATextThatIsNotTakenHasNoSize) {
    std::string why_not;
    EXPECT_FALSE(program_size("#version 300 es\nvoid main() { wrong; }\n", why_not));
    EXPECT_NE(why_not.find("does not take the text"), std::string::npos) << why_not;
    EXPECT_FALSE(program_size("", why_not));
}

TEST(InliningOfNothing, BrokenModulesAreNoTrouble) {
    EXPECT_EQ(inlined_size({}).words, 0u);
    EXPECT_EQ(inlined_size({0x07230203, 0x10000, 0, 9, 0}).words, 0u);
    EXPECT_EQ(inlined_size({0x07230203, 0x10000, 0, 9, 0, 0}).words, 0u);
    EXPECT_EQ(inlined_size({0x07230203, 0x10000, 0, 9, 0, (99u << 16) | 54u, 1}).words, 0u);
}

}  // namespace
}  // namespace glint::inlining_test
