// Indices of stores that a loop steps.
#include "glsl/stored_index.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::stored_index_test {
namespace {

std::string mended(const std::string& body) {
    const std::string head = "void f(inout float w[9], inout int grid[9], int n) { ";
    const std::string text = head + body + " }";
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    mend_stored_indices(reading, edits);
    const std::string now = edits.apply().text;
    return now.substr(head.size(), now.size() - head.size() - 2);
}

TEST(StoredIndex, IsHiddenWhereTheNextOneIsReckonedBeside) {
    EXPECT_EQ(mended("for (int i = 0; i < n; i++) w[i] = w[i + 1];"),
              "for (int i = 0; i < n; i++) w[i+glint_zero_i] = w[i + 1];");
    EXPECT_EQ(mended("for (int i = n; i > 0; --i) w[i] = w[i - 1];"),
              "for (int i = n; i > 0; --i) w[i+glint_zero_i] = w[i - 1];");
    EXPECT_EQ(mended("uint k = 0u; while (k < 4u) { w[k] += float(k + 2u); k += 2u; }"),
              "uint k = 0u; while (k < 4u) { w[k+uint(glint_zero_i)] += float(k + 2u); k += 2u; }");
    EXPECT_EQ(
        mended("int k = 0; do { if (n > k) { float x = float(1 + k); w[k] = x; k++; } } "
               "while (k < n);"),
        "int k = 0; do { if (n > k) { float x = float(1 + k); w[k+glint_zero_i] = x; k++; } } "
        "while (k < n);");
}

TEST(StoredIndex, IsLeftWhereNothingIsLikeTheNextOne) {
    for (const char* body :
         {"for (int i = 0; i < n; i++) w[i] = 1.0;", "for (int i = 0; i < n; i++) w[i] = w[i - 1];",
          "for (int i = 0; i < n; i++) w[i + 1] = w[i];",
          "for (int i = 0; i < n; i++) w[i] = float(4 * i + 1);",
          "for (int i = 0; i < n; i++) { float x = w[i] + w[i + 1]; }",
          "int k = 0; w[k] = float(k + 1); k++;"})
        EXPECT_EQ(mended(body), body);
}

}  // namespace
}  // namespace glint::stored_index_test
