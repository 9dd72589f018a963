// The reader and whatever bytes there are.
#include "glsl/edits.h"
#include "glsl/raw_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

namespace glint::reader_test {
namespace {

std::string repeated(const std::string& piece, std::size_t bytes) {
    std::string text;
    while (text.size() < bytes) text += piece;
    return text;
}

// What 300 kB of it do must end soon, and not on the stack.
TEST(Reader, EndsWhateverIsNested) {
    for (const char* piece : {"(",         "{",
                              "[",         ")",
                              "}",         "if(a)",
                              "if(a){",    "else ",
                              "do ",       "for(;;)",
                              "f(",        "#if 1\n",
                              "#if (\n",   "#ifdef GL_x\n",
                              "struct S{", "struct{",
                              "float a[",  "a?",
                              "-",         "!",
                              "/*",        "\\\n",
                              "void f(){", "void f(",
                              "float a=",  "const ",
                              "uniform ",  "uniform float a=",
                              "float ",    "#define A A A\n",
                              "case ",     "layout("}) {
        const std::string text = repeated(piece, 300'000);
        read_glsl(text, known_of_driver());
        read_glsl("void f() {" + text.substr(0, 100'000), known_of_driver());
        read_glsl("#if " + text.substr(0, 100'000) + "\n#endif\n", known_of_driver());
    }
}

TEST(Reader, EndsWhateverMacrosBecome) {
    std::string doubling = "#define A0 x x\n";
    for (int i = 1; i < 60; ++i)
        doubling += "#define A" + std::to_string(i) + " A" + std::to_string(i - 1) + " A" +
                    std::to_string(i - 1) + "\n";
    const Reading doubled = read_glsl(doubling + "A59", {});
    EXPECT_FALSE(doubled.not_understood.empty());
    EXPECT_LT(doubled.tokens.size(), 2'000'000u);

    std::string chain;
    for (int i = 0; i < 20'000; ++i)
        chain += "#define B" + std::to_string(i) + " B" + std::to_string(i + 1) + "\n";
    EXPECT_EQ(read_glsl(chain + "B0", {}).tokens.size(), 1u);

    const std::string calls = repeated("f(", 300'000);
    read_glsl("#define f(x) x\n" + calls, {});
    read_glsl("#define f(x) x x\n" + calls + repeated(")", 150'000), {});
    read_glsl("#define f(x) f(f(x)\n" + calls, {});
}

TEST(Reader, UnderstandsTheScenesAndTheCorpus) {
    namespace fs = std::filesystem;
    std::size_t count = 0;
    for (const char* folder : {"fragments", "tests/corpus/shaders", "tests/scenes"}) {
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(GLINT_REPOSITORY) / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".frag" && extension != ".glsl") continue;
            std::string why_not;
            const std::string text = clean_text(*read_bytes(entry.path(), why_not)).text;
            const Reading reading = read_glsl(text, known_of_driver());
            for (const NotUnderstood& one : reading.not_understood)
                ADD_FAILURE() << entry.path() << ": " << one.why << ": "
                              << text.substr(one.span.begin, one.span.end - one.span.begin);
            EXPECT_EQ(Edits(reading).apply().text, text);
            ++count;
        }
    }
    EXPECT_GT(count, 150u);
}

// The tokens of a text are its bytes, in their order, and nothing stands between but space and
// comments.
TEST(Reader, LosesNoByte) {
    std::mt19937 random(1);
    const std::string_view pieces[] = {"a",  "1.",         "(",       ")",    "{",  "}",     ";",
                                       "\n", "\\\n",       "#if 1\n", "/*",   "*/", "//",    "#",
                                       "\"", "\n#endif\n", ",",       "\xC3", " ",  "float "};
    for (int turn = 0; turn < 300; ++turn) {
        std::string text;
        for (int i = 0; i < 200; ++i) text += pieces[random() % std::size(pieces)];
        const Reading reading = read_glsl(text, known_of_driver());
        std::string rest = text;
        std::size_t end = 0;
        for (const Token& token : reading.written) {
            ASSERT_LE(end, token.begin);
            ASSERT_LT(token.begin, token.end);
            end = token.end;
            rest.replace(token.begin, token.end - token.begin, token.end - token.begin, ' ');
        }
        for (const Comment& comment : reading.comments)
            rest.replace(comment.span.begin, comment.span.end - comment.span.begin,
                         comment.span.end - comment.span.begin, ' ');
        for (std::size_t i = 0; i < rest.size(); ++i)
            if (rest[i] == '\\' && i + 1 < rest.size() && rest[i + 1] == '\n') rest[i] = ' ';
        ASSERT_EQ(rest.find_first_not_of(" \n"), rest.npos) << text;
    }
}

}  // namespace
}  // namespace glint::reader_test
