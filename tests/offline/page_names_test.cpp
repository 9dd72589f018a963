// An exported page feeds all that the host feeds.
#include "scene/builtin.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace glint::page_names_test {
namespace {

std::string modules_of_the_page() {
    std::string text;
    for (const auto& entry :
         std::filesystem::directory_iterator(GLINT_REPOSITORY "/host/offline/page")) {
        if (entry.path().extension() != ".js") continue;
        std::ifstream file(entry.path());
        text.append(std::istreambuf_iterator<char>(file), {});
    }
    return text;
}

TEST(Page, NamesEveryUniformOfTheHost) {
    const std::string text = modules_of_the_page();
    ASSERT_FALSE(text.empty());
    for (const std::string_view name : builtin_names()) {
        const bool is_channel = name.starts_with("iChannel") && name.size() == 9;
        EXPECT_TRUE(is_channel || text.find(name) != std::string::npos) << name;
    }
}

}  // namespace
}  // namespace glint::page_names_test
